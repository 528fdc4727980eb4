//! The table of a sweep, and its worst cases.

use decide::Number;
use scene::vocabulary::{ResultName, Verdict};
use serde::Serialize;
use serde_json::Value;

use super::collect::{Collected, PointResult};
use crate::data_table::DataTable;

/// A value of an axis; texts without quotes.
pub(super) fn plain(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), String::from)
}

/// What stands beside a value, where any point has it.
type Beside<T> = fn(&Number) -> Option<T>;

/// The table: a row for each point; axes, status, numbers, texts, cost, folder.
pub(crate) fn table(collected: &Collected) -> DataTable {
    let points = &collected.points;
    let mut table = DataTable::default();
    table.wholes("point", points.iter().map(|point| Some(point.number)));
    for (k, axis) in collected.axes.iter().enumerate() {
        axis_column(&mut table, axis.label(), points.iter().map(|point| &point.values[k]));
    }
    table.texts("status", points.iter().map(|point| Some(point.status.clone())));
    table.texts("message", points.iter().map(|point| point.message.clone()));
    for name in &collected.names {
        let numbers = points.iter().map(|point| point.numbers.get(name));
        let has = |of: fn(&Number) -> bool| numbers.clone().flatten().any(of);
        let numbers_of = |of: Beside<f64>| numbers.clone().map(move |number| number.and_then(of));
        table.numbers(name, numbers_of(|number| Some(number.value)));
        if has(|number| number.band.is_some()) {
            table.numbers(format!("{name}.band"), numbers_of(|number| number.band));
        }
        if has(|number| number.verdict.is_some()) {
            table.texts(
                format!("{name}.verdict"),
                numbers.clone().map(|number| Some(number?.verdict?.name().to_string())),
            );
        }
        if has(|number| number.allowed.is_some()) {
            let allowed = numbers.clone().map(|number| number?.allowed.map(|is| is.to_string()));
            table.texts(format!("{name}.allowed"), allowed);
        }
        if has(|number| number.time_s.is_some()) {
            table.numbers(format!("{name}.time_s"), numbers_of(|number| number.time_s));
        }
    }
    for name in &collected.texts {
        table.texts(name, points.iter().map(|point| point.texts.get(name).cloned()));
    }
    table.numbers("wall_time_s", points.iter().map(|point| point.wall_time_s));
    table.wholes("threads", points.iter().map(|point| point.threads));
    table.texts("folder", points.iter().map(|point| point.id.as_deref().map(folder_of)));
    table
}

/// Numbers where all values are, else texts.
fn axis_column<'a>(table: &mut DataTable, name: String, values: impl Iterator<Item = &'a Value> + Clone) {
    match values.clone().all(Value::is_number) {
        true => table.numbers(name, values.map(Value::as_f64)),
        false => table.texts(name, values.map(|value| Some(plain(value)))),
    }
}

/// The folder of a point, from that of the sweep.
pub(super) fn folder_of(id: &str) -> String {
    format!("points/{id}")
}

type Found<'a> = (&'a PointResult, &'a Number);

/// The worst case of a quantity.
pub(super) struct Worst<'a> {
    /// The quantity.
    pub quantity: &'a str,
    /// Its panel, or its station of a landing; empty for the body as a whole.
    pub place: &'a str,
    /// Its scene, where the sweep has several.
    pub scene: Option<String>,
    /// The number.
    pub number: &'a Number,
    /// The point that made it.
    pub point: &'a PointResult,
    /// The worst of those that are resolved, where this one is not.
    pub resolved: Option<(&'a Number, &'a PointResult)>,
}

/// The worst case of each quantity at each place, for each scene: the largest magnitude, or the smallest reserve factor.
pub(super) fn worst<'a>(collected: &'a Collected) -> Vec<Worst<'a>> {
    let scene_of = |point: &PointResult| collected.scene_axis().map(|k| plain(&point.values[k]));
    let mut scenes: Vec<Option<String>> = Vec::new();
    for scene in collected.with_numbers().map(scene_of) {
        if !scenes.contains(&scene) {
            scenes.push(scene);
        }
    }
    let mut found = Vec::new();
    for name in &collected.names {
        let (place, quantity) = match name.rsplit_once('.') {
            Some((place, quantity)) if place != "audit" && !name.contains('/') => (place, quantity),
            _ => ("", name.as_str()),
        };
        let severity = |number: &Number| match quantity == ResultName::ReserveFactor.name() {
            true => -number.value,
            false => number.value.abs(),
        };
        for scene in &scenes {
            let points = collected.with_numbers().filter(|point| scene_of(point) == *scene);
            let numbers = points.filter_map(|point| Some((point, point.numbers.get(name)?)));
            let numbers: Vec<Found<'a>> = numbers.collect();
            // of equals the first
            let worse =
                |worst: Found<'a>, next: Found<'a>| if severity(next.1) > severity(worst.1) { next } else { worst };
            let is_resolved = |number: &Number| number.verdict == Some(Verdict::Resolved);
            let resolved = numbers.iter().copied().filter(|(_, number)| is_resolved(number)).reduce(worse);
            let case = |(point, number)| {
                let resolved = resolved.filter(|_| !is_resolved(number)).map(|(point, number)| (number, point));
                Worst { quantity, place, scene: scene.clone(), number, point, resolved }
            };
            found.extend(numbers.into_iter().reduce(worse).map(case));
        }
    }
    found
}

/// The worst case of a quantity, to be printed.
#[derive(Clone, Debug, Serialize)]
pub struct WorstCase {
    /// The quantity.
    pub quantity: String,
    /// Its panel, or its station of a landing; empty for the body as a whole.
    pub place: String,
    /// Its scene, where the sweep has several.
    pub scene: Option<String>,
    /// The value, in the unit of its name.
    pub value: f64,
    /// Half width of its band, where one is known.
    pub band: Option<f64>,
    /// What may be said of it, where it is judged.
    pub verdict: Option<Verdict>,
    /// The number of the point that made it.
    pub point: usize,
}

/// The worst case of each quantity at each place, for each scene: the largest magnitude, or the smallest reserve factor.
pub fn worst_cases(collected: &Collected) -> Vec<WorstCase> {
    let case = |case: Worst<'_>| WorstCase {
        quantity: case.quantity.into(),
        place: case.place.into(),
        scene: case.scene,
        value: case.number.value,
        band: case.number.band,
        verdict: case.number.verdict,
        point: case.point.number,
    };
    worst(collected).into_iter().map(case).collect()
}

/// The worst cases, a row each.
pub(crate) fn worst_table(collected: &Collected) -> DataTable {
    let cases = worst(collected);
    let mut table = DataTable::default();
    table.texts("quantity", cases.iter().map(|case| Some(case.quantity.into())));
    table.texts("place", cases.iter().map(|case| Some(case.place.into())));
    table.texts("scene", cases.iter().map(|case| case.scene.clone()));
    table.numbers("value", cases.iter().map(|case| Some(case.number.value)));
    table.numbers("band", cases.iter().map(|case| case.number.band));
    table.texts("verdict", cases.iter().map(|case| case.number.verdict.map(|verdict| verdict.name().to_string())));
    table.numbers("time_s", cases.iter().map(|case| case.number.time_s));
    table.wholes("point", cases.iter().map(|case| Some(case.point.number)));
    for (k, axis) in collected.axes.iter().enumerate() {
        axis_column(&mut table, axis.label(), cases.iter().map(|case| &case.point.values[k]));
    }
    table.texts("folder", cases.iter().map(|case| case.point.id.as_deref().map(folder_of)));
    table
}
