//! Charts of each quantity against each axis, with bands, and marks for what is not resolved.

use super::collect::{Collected, Number, PointResult};
use super::response::extent;
use super::table::plain;
use crate::report::{Block, Chart, Curve, Mark, TrendLine};
use crate::scene::significant;

/// Most quantities and axes that are drawn.
const MOST_QUANTITIES: usize = 8;
const MOST_AXES: usize = 5;
/// Most lines in a chart; more points stand without lines.
const MOST_LINES: usize = 9;
/// A band wider than this share of the values' span is cut off.
const WIDEST_BAND: f64 = 0.6;

/// The quantities that are drawn: all but the audit, the first few.
pub(super) fn charted(collected: &Collected) -> Vec<&str> {
    let names = collected.names.iter().map(String::as_str).filter(|name| !name.starts_with("audit."));
    names.take(MOST_QUANTITIES).collect()
}

/// The axes whose values are numbers, with at least two different ones; the first few.
pub(super) fn numeric_axes(collected: &Collected) -> Vec<usize> {
    let is_numeric = |axis: &usize| {
        let values: Option<Vec<f64>> = collected.points.iter().map(|point| point.values[*axis].as_f64()).collect();
        values.is_some_and(|values| values.iter().any(|value| *value != values[0]))
    };
    (0..collected.axes.len()).filter(is_numeric).take(MOST_AXES).collect()
}

/// A chart for each quantity and axis.
pub(super) fn trends(collected: &Collected) -> Vec<Block> {
    let axes = numeric_axes(collected);
    let charts = charted(collected).into_iter().flat_map(|name| axes.iter().map(move |axis| (name, *axis)));
    charts.filter_map(|(name, axis)| chart(collected, name, axis)).map(Block::Chart).collect()
}

/// A point of a chart.
struct Spot<'a> {
    x: f64,
    number: &'a Number,
    group: String,
}

fn chart(collected: &Collected, name: &str, axis: usize) -> Option<Chart> {
    let spot = |point: &'_ PointResult| -> Option<(f64, String)> {
        Some((point.values[axis].as_f64()?, group(collected, point, axis)))
    };
    let spots = collected.completed().filter_map(|point| {
        let (x, group) = spot(point)?;
        Some(Spot { x, number: point.numbers.get(name)?, group })
    });
    let mut spots: Vec<Spot<'_>> = spots.filter(|spot| spot.number.value.is_finite()).collect();
    if spots.is_empty() {
        return None;
    }
    spots.sort_by(|a, b| a.x.total_cmp(&b.x));
    let mut groups: Vec<&str> = Vec::new();
    for spot in &spots {
        if !groups.contains(&spot.group.as_str()) {
            groups.push(&spot.group);
        }
    }
    let lined = groups.len() <= MOST_LINES && groups.len() < spots.len();
    let of_spots = |label: &str, mark: Mark, wanted: &dyn Fn(&Spot<'_>) -> bool| {
        Curve::new(label, mark, spots.iter().filter(|spot| wanted(spot)).map(|spot| [spot.x, spot.number.value]))
    };
    let mut curves: Vec<Curve> = match lined {
        true => groups.iter().map(|group| of_spots(group, Mark::Line, &|spot| spot.group == *group)).collect(),
        false => Vec::new(),
    };
    let verdict = |spot: &Spot<'_>| spot.number.verdict.clone().unwrap_or_else(|| "resolved".into());
    for (word, mark) in [
        ("resolved", Mark::Points),
        ("no_band", Mark::Points),
        ("acoustic", Mark::Hollow),
        ("not_resolved", Mark::Hollow),
        ("beyond_allowable", Mark::Points),
    ] {
        let curve = of_spots(&word.replace('_', " "), mark, &|spot| verdict(spot) == word);
        if !curve.x.is_empty() {
            curves.push(curve);
        }
    }
    let [low, high] = extent(spots.iter().map(|spot| spot.number.value));
    let reach = WIDEST_BAND * (high - low).max(0.2 * low.abs().max(high.abs()));
    let bands = || spots.iter().filter_map(|spot| Some((spot, spot.number.band?.min(reach))));
    let trends = bands().map(|(spot, band)| TrendLine {
        curve: groups.iter().position(|group| lined && *group == spot.group).unwrap_or(0),
        ends: [-band, band].map(|side| [spot.x, spot.number.value + side]),
    });
    let trends: Vec<TrendLine> = trends.collect();
    let ends = extent(trends.iter().flat_map(|trend| trend.ends.map(|[_, y]| y)).chain([low, high]));
    let cut = spots.iter().any(|spot| spot.number.band.is_some_and(|band| band > reach));
    let margin = 0.05 * (ends[1] - ends[0]);
    Some(Chart {
        title: format!(
            "{name} against {}{}",
            collected.axes[axis].key,
            if cut { "; bands wider than the chart are cut off" } else { "" }
        ),
        x_label: collected.axes[axis].label(),
        y_label: name.into(),
        curves,
        y_range: (margin > 0.0).then(|| [ends[0] - margin, ends[1] + margin]),
        trends,
        ..Chart::default()
    })
}

/// The values of the other axes, as a line of the legend.
fn group(collected: &Collected, point: &PointResult, axis: usize) -> String {
    let others = collected.axes.iter().zip(&point.values).enumerate().filter(|(k, _)| *k != axis);
    let words = others.map(|(_, (axis, value))| {
        let key = axis.key.rsplit('.').next().unwrap_or(&axis.key);
        format!("{key} {}", value.as_f64().map_or_else(|| plain(value), significant))
    });
    words.collect::<Vec<_>>().join(", ")
}
