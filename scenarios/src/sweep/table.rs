//! The table of a sweep as CSV, and its worst cases.

use serde::Serialize;
use serde_json::Value;

use super::collect::{Collected, Number, PointResult};

/// A row of CSV (RFC 4180).
fn csv_row(cells: impl IntoIterator<Item = String>) -> String {
    let quoted = |cell: String| match cell.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", cell.replace('"', "\"\"")),
        false => cell,
    };
    cells.into_iter().map(quoted).collect::<Vec<_>>().join(",") + "\n"
}

/// A value of an axis; texts without quotes.
pub(super) fn plain(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), String::from)
}

fn known<T: ToString>(value: Option<T>) -> String {
    value.map_or(String::new(), |value| value.to_string())
}

/// What stands beside a value, where any point has it.
type Beside = (&'static str, fn(&Number) -> Option<String>);

const BESIDE: [Beside; 3] = [
    ("band", |number| number.band.map(|band| band.to_string())),
    ("verdict", |number| number.verdict.clone()),
    ("time_s", |number| number.time_s.map(|time| time.to_string())),
];

/// The table: a row for each point; axes, status, numbers, texts, cost, folder.
pub fn table_csv(collected: &Collected) -> String {
    let beside: Vec<(&String, Vec<&Beside>)> = collected
        .names
        .iter()
        .map(|name| {
            let has = |(_, of): &&Beside| {
                collected.points.iter().filter_map(|p| p.numbers.get(name)).any(|n| of(n).is_some())
            };
            (name, BESIDE.iter().filter(has).collect())
        })
        .collect();
    let mut head = vec!["point".to_string()];
    head.extend(collected.axes.iter().map(|axis| axis.label()));
    head.extend(["status", "message"].map(String::from));
    for (name, more) in &beside {
        head.push(name.to_string());
        head.extend(more.iter().map(|(word, _)| format!("{name}.{word}")));
    }
    head.extend(collected.texts.iter().cloned());
    head.extend(["wall_time_s", "threads", "folder"].map(String::from));
    let row = |point: &PointResult| {
        let mut row = vec![point.number.to_string()];
        row.extend(point.values.iter().map(plain));
        row.extend([point.status.clone(), known(point.message.as_ref())]);
        for (name, more) in &beside {
            let number = point.numbers.get(*name);
            row.push(known(number.map(|number| number.value)));
            row.extend(more.iter().map(|(_, of)| known(number.and_then(of))));
        }
        row.extend(collected.texts.iter().map(|name| known(point.texts.get(name))));
        row.extend([known(point.wall_time_s), known(point.threads), known(point.id.as_deref().map(folder_of))]);
        csv_row(row)
    };
    csv_row(head) + &collected.points.iter().map(row).collect::<String>()
}

/// The folder of a point, from that of the sweep.
pub(super) fn folder_of(id: &str) -> String {
    format!("points/{id}")
}

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
}

/// The worst case of each quantity at each place, for each scene: the largest magnitude, or the smallest reserve factor.
pub(super) fn worst(collected: &Collected) -> Vec<Worst<'_>> {
    let scene_of = |point: &PointResult| collected.scene_axis().map(|k| plain(&point.values[k]));
    let mut scenes: Vec<Option<String>> = Vec::new();
    for scene in collected.completed().map(scene_of) {
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
        let severity = |number: &Number| match quantity == "reserve_factor" {
            true => -number.value,
            false => number.value.abs(),
        };
        for scene in &scenes {
            let points = collected.completed().filter(|point| scene_of(point) == *scene);
            let numbers = points.filter_map(|point| Some((point, point.numbers.get(name)?)));
            // of equals the first
            let worst = numbers.reduce(|worst, next| if severity(next.1) > severity(worst.1) { next } else { worst });
            let case = |(point, number)| Worst { quantity, place, scene: scene.clone(), number, point };
            found.extend(worst.map(case));
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
    pub verdict: Option<String>,
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
        verdict: case.number.verdict.clone(),
        point: case.point.number,
    };
    worst(collected).into_iter().map(case).collect()
}

/// The worst cases, a row each.
pub fn worst_csv(collected: &Collected) -> String {
    let head = ["quantity", "place", "scene", "value", "band", "verdict", "time_s", "point"].map(String::from);
    let axes = collected.axes.iter().map(|axis| axis.label());
    let head = csv_row(head.into_iter().chain(axes).chain(["folder".to_string()]));
    let row = |case: &Worst<'_>| {
        let Worst { quantity, place, scene, number, point } = case;
        let first = [
            quantity.to_string(),
            place.to_string(),
            known(scene.as_ref()),
            number.value.to_string(),
            known(number.band),
            known(number.verdict.as_ref()),
            known(number.time_s),
            point.number.to_string(),
        ];
        let folder = known(point.id.as_deref().map(folder_of));
        csv_row(first.into_iter().chain(point.values.iter().map(plain)).chain([folder]))
    };
    head + &worst(collected).iter().map(row).collect::<String>()
}
