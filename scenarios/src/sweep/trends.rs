//! Charts of each quantity against each axis: colours and dashes by the other axes, bands, marks for what is not resolved.

use decide::numbers::{Number, Said};
use report::{Block, CATEGORIES, Chart, Curve, Mark, Paint, Rgb, TrendLine};
use scene::vocabulary::Verdict;
use serde_json::Value;

use super::collect::{Collected, PointResult};
use super::response::extent;
use super::words::{Quantity, axis_label, axis_value};

/// Most quantities and axes that are drawn.
const MOST_QUANTITIES: usize = 8;
const MOST_AXES: usize = 5;
/// Most colours and dashes of a chart; more points stand without lines.
const MOST_COLOURS: usize = CATEGORIES.len();
const MOST_DASHES: usize = 4;
/// A band wider than this share of the values' span is cut off.
const WIDEST_BAND: f64 = 0.6;

/// Colours from the least to the largest value of an axis; they read on white and on black.
const RAMP: [[f64; 3]; 5] =
    [[47.0, 111.0, 214.0], [139.0, 92.0, 214.0], [204.0, 71.0, 148.0], [222.0, 99.0, 66.0], [199.0, 140.0, 0.0]];
const GREY: Rgb = [128, 128, 128];
/// The mark of a number, and its form.
fn mark_of(said: Said) -> (Mark, usize) {
    match said {
        Said::Of(Verdict::Resolved) => (Mark::Points, 0),
        Said::Of(Verdict::NoBand) => (Mark::Hollow, 0),
        Said::Of(Verdict::NotResolved) => (Mark::Hollow, 2),
        Said::Of(Verdict::Acoustic) => (Mark::Hollow, 3),
        Said::Beyond => (Mark::Points, 1),
    }
}

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

/// Different values of some axes together, in their order.
struct Levels {
    axes: Vec<usize>,
    values: Vec<Vec<Value>>,
}

impl Levels {
    fn of(axes: Vec<usize>, points: &[&PointResult]) -> Levels {
        let mut values: Vec<Vec<Value>> = Vec::new();
        for point in points {
            let own = axes.iter().map(|axis| point.values[*axis].clone()).collect();
            if !values.contains(&own) {
                values.push(own);
            }
        }
        let number = |value: &Value| value.as_f64().unwrap_or(0.0);
        let by_number = |a: &Vec<Value>, b: &Vec<Value>| {
            let pairs = a.iter().zip(b).map(|(a, b)| number(a).total_cmp(&number(b)));
            pairs.fold(std::cmp::Ordering::Equal, std::cmp::Ordering::then)
        };
        values.sort_by(by_number);
        Levels { axes, values }
    }

    fn count(&self) -> usize {
        self.values.len()
    }

    /// The level of a point.
    fn at(&self, point: &PointResult) -> usize {
        let is_own = |values: &Vec<Value>| self.axes.iter().zip(values).all(|(k, value)| point.values[*k] == *value);
        self.values.iter().position(is_own).unwrap_or(0)
    }

    fn label(&self, collected: &Collected, level: usize) -> String {
        let words = self.axes.iter().zip(&self.values[level]).map(|(axis, value)| axis_value(collected, *axis, value));
        words.collect::<Vec<_>>().join(", ")
    }

    /// The colour of a level: from a ramp where values are numbers.
    fn colour(&self, level: usize) -> Rgb {
        let numeric = self.values.iter().flatten().all(|value| value.as_f64().is_some());
        match numeric && self.count() > 1 {
            true => ramp(level as f64 / (self.count() - 1) as f64),
            false => CATEGORIES[level % CATEGORIES.len()],
        }
    }
}

/// A colour of the ramp at a share of its length.
fn ramp(share: f64) -> Rgb {
    let place = share.clamp(0.0, 1.0) * (RAMP.len() - 1) as f64;
    let k = (place as usize).min(RAMP.len() - 2);
    let between = |c: usize| RAMP[k][c] + (place - k as f64) * (RAMP[k + 1][c] - RAMP[k][c]);
    [0, 1, 2].map(|c| between(c).round() as u8)
}

/// A point of a chart.
struct Spot<'a> {
    x: f64,
    number: &'a Number,
    point: &'a PointResult,
}

/// The axes beside the one of a chart: of those with few values the one with most for colours, the others for dashes.
fn coded(axis: usize, points: &[&PointResult], axes: usize) -> [Levels; 2] {
    let count = |k: usize| Levels::of(vec![k], points).count();
    let others: Vec<usize> = (0..axes).filter(|k| *k != axis && count(*k) > 1).collect();
    let few = others.iter().copied().filter(|k| count(*k) <= MOST_COLOURS);
    let coloured = few.min_by_key(|k| (std::cmp::Reverse(count(*k)), *k));
    let dashed = others.into_iter().filter(|k| Some(*k) != coloured).collect();
    [coloured.into_iter().collect(), dashed].map(|axes| Levels::of(axes, points))
}

fn chart(collected: &Collected, name: &str, axis: usize) -> Option<Chart> {
    let quantity = Quantity::of(collected, name);
    let spots = collected.completed().filter_map(|point| {
        let number = point.numbers.get(name).filter(|number| number.value.is_finite())?;
        Some(Spot { x: point.values[axis].as_f64()?, number, point })
    });
    let mut spots: Vec<Spot<'_>> = spots.collect();
    if spots.is_empty() {
        return None;
    }
    spots.sort_by(|a, b| a.x.total_cmp(&b.x));
    let points: Vec<&PointResult> = spots.iter().map(|spot| spot.point).collect();
    let [colours, dashes] = coded(axis, &points, collected.axes.len());
    let lined = dashes.count() <= MOST_DASHES && colours.count() * dashes.count() < spots.len();
    let mut groups: Vec<[usize; 2]> = Vec::new();
    let group = |spot: &Spot<'_>| [colours.at(spot.point), if lined { dashes.at(spot.point) } else { 0 }];
    for spot in &spots {
        if !groups.contains(&group(spot)) {
            groups.push(group(spot));
        }
    }
    groups.sort_unstable();
    let of = |own: [usize; 2], verdict: Option<Said>, mark: Mark, form: usize| {
        let own_spots = spots.iter().filter(|spot| group(spot) == own);
        let shown = own_spots.filter(|spot| verdict.is_none_or(|wanted| verdict_of(spot.number) == wanted));
        let points = shown.map(|spot| [spot.x, quantity.scale * spot.number.value]);
        let notes = [(&colours, own[0]), (&dashes, own[1])].into_iter().take(if lined { 2 } else { 1 });
        let labels = notes.map(|(levels, k)| levels.label(collected, k)).filter(|label| !label.is_empty());
        let label = labels.collect::<Vec<_>>().join(", ");
        Curve::new(label, mark, points).painted(Paint {
            colour: Some(colours.colour(own[0])),
            form: Some(form),
            pale: false,
        })
    };
    let lines = groups.iter().filter(|_| lined).map(|own| of(*own, None, Mark::Line, own[1]));
    // a line needs two points
    let lines = lines.filter(|curve| curve.x.len() > 1);
    let marks = groups.iter().flat_map(|own| {
        let of = &of;
        Said::all().map(move |said| {
            let (mark, form) = mark_of(said);
            of(*own, Some(said), mark, form)
        })
    });
    let curves: Vec<Curve> = lines.chain(marks.filter(|curve| !curve.x.is_empty())).collect();
    let value = |spot: &Spot<'_>| quantity.scale * spot.number.value;
    let [low, high] = extent(spots.iter().map(value));
    let reach = WIDEST_BAND * (high - low).max(0.2 * low.abs().max(high.abs()));
    let band = |spot: &Spot<'_>| Some(quantity.scale.abs() * spot.number.band?);
    let trends = spots.iter().filter_map(|spot| {
        let half = band(spot)?.min(reach);
        let colour = Some(colours.colour(group(spot)[0]));
        let curve = curves.iter().position(|curve| curve.paint.colour == colour).unwrap_or(0);
        Some(TrendLine { curve, ends: [-half, half].map(|side| [spot.x, value(spot) + side]) })
    });
    let trends: Vec<TrendLine> = trends.collect();
    let ends = extent(trends.iter().flat_map(|trend| trend.ends.map(|[_, y]| y)).chain([low, high]));
    let cut = spots.iter().any(|spot| band(spot).is_some_and(|band| band > reach));
    let margin = 0.05 * (ends[1] - ends[0]);
    let [first, last] = extent(spots.iter().map(|spot| spot.x));
    let across = 0.03 * (last - first);
    let x_label = axis_label(collected, &collected.axes[axis]);
    let against = x_label.split(" [").next().unwrap_or(&x_label).to_lowercase();
    Some(Chart {
        title: format!(
            "{} against {against}{}",
            quantity.title,
            if cut { "; bands wider than the chart are cut off" } else { "" }
        ),
        x_label,
        y_label: quantity.label(),
        legend: legend(collected, &colours, Some(&dashes).filter(|_| lined), &spots),
        x_range: Some([first - across, last + across]),
        curves,
        y_range: (margin > 0.0).then(|| [ends[0] - margin, ends[1] + margin]),
        trends,
        ..Chart::default()
    })
}

/// What may be said of a number; one that is not judged is drawn as one that is resolved.
fn verdict_of(number: &Number) -> Said {
    number.said().next().unwrap_or(Said::Of(Verdict::Resolved))
}

/// Entries for colours, for dashes, and for marks where not all points are resolved.
fn legend(collected: &Collected, colours: &Levels, dashes: Option<&Levels>, spots: &[Spot<'_>]) -> Vec<Curve> {
    let entry = |label: String, mark: Mark, colour: Rgb, form: usize| {
        Curve::new(label, mark, []).painted(Paint { colour: Some(colour), form: Some(form), pale: false })
    };
    let of = |levels: &Levels| if levels.axes.is_empty() { 0 } else { levels.count() };
    let mark = if dashes.is_some() { Mark::Line } else { Mark::Points };
    let coloured = (0..of(colours)).map(|k| entry(colours.label(collected, k), mark, colours.colour(k), 0));
    let mut entries: Vec<Curve> = coloured.collect();
    if let Some(dashes) = dashes {
        entries.extend((0..of(dashes)).map(|k| entry(dashes.label(collected, k), Mark::Line, GREY, k)));
    }
    let has = |verdict: Said| spots.iter().any(|spot| verdict_of(spot.number) == verdict);
    let present = || Said::all().filter(|said| has(*said));
    if present().any(|said| said != Said::Of(Verdict::Resolved)) {
        entries.extend(present().map(|said| {
            let (mark, form) = mark_of(said);
            entry(said.words().into(), mark, GREY, form)
        }));
    }
    match entries.is_empty() {
        // one entry without a name: no legend
        true => vec![Curve::default()],
        false => entries,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ramp_has_its_ends_and_each_colour_reads_on_white_and_on_black() {
        assert_eq!([ramp(0.0), ramp(1.0)], [[47, 111, 214], [199, 140, 0]]);
        let linear = |c: u8| (f64::from(c) / 255.0).powf(2.2);
        for k in 0..=20 {
            let [r, g, b] = ramp(f64::from(k) / 20.0).map(linear);
            let light = 0.2126 * r + 0.7152 * g + 0.0722 * b;
            assert!(1.05 / (light + 0.05) > 2.8 && (light + 0.05) / 0.06 > 2.8, "{k}: {light}");
        }
    }
}
