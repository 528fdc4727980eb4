//! Response surfaces of a sweep over two axes or more.

use report::run_page::quantity::digits;
use report::{Block, Table};

use super::collect::{Collected, PointResult};
use super::heat_map::{HeatMap, heat_map_svg};
use super::response::Response;
use super::table::plain;
use super::trends::{charted, numeric_axes};
use super::words::{Quantity, axis_label, axis_value, inside};

/// Most pairs of axes that are drawn.
const MOST_PAIRS: usize = 3;
/// Points this near the middle of the other axes are drawn on a map, as a share of the half range [-].
const NEAR: f64 = 0.3;
/// Most sets of other values for which surfaces are fitted.
const MOST_GROUPS: usize = 4;

/// Surfaces of each quantity over all numeric axes: residuals in a table, maps over pairs of axes.
pub(super) fn surfaces(collected: &Collected) -> Vec<Block> {
    let axes = numeric_axes(collected);
    if axes.len() < 2 {
        return Vec::new();
    }
    let mut maps = Vec::new();
    let mut rows = Vec::new();
    for name in charted(collected) {
        let quantity = Quantity::of(collected, name);
        for (group, points) in groups(collected, &axes).into_iter().take(MOST_GROUPS) {
            let of = |p: &&PointResult| {
                let value = quantity.scale * p.numbers.get(name)?.value;
                Some((place(p, &axes)?, value)).filter(|(_, v)| v.is_finite())
            };
            let (places, values): (Vec<Vec<f64>>, Vec<f64>) = points.iter().filter_map(of).unzip();
            let with_group = |words: String| if group.is_empty() { words } else { format!("{words}, {group}") };
            let Some(surface) = Response::fit(&places, &values) else {
                let known = [with_group(quantity.label()), values.len().to_string()];
                rows.push(known.into_iter().chain(std::iter::repeat_n("–".to_string(), 4)).collect());
                continue;
            };
            let percent = if surface.span > 0.0 { 100.0 * surface.residual / surface.span } else { 0.0 };
            rows.push(vec![
                with_group(quantity.label()),
                values.len().to_string(),
                surface.coefficients().to_string(),
                digits(surface.residual),
                digits(surface.largest),
                format!("{percent:.1}"),
            ]);
            let pairs = (0..axes.len()).flat_map(|i| (i + 1..axes.len()).map(move |j| [i, j])).take(MOST_PAIRS);
            let titled = Quantity { title: with_group(quantity.title.clone()), ..quantity.clone() };
            maps.extend(pairs.map(|pair| map(collected, &axes, pair, &titled, &surface, &places, &values)));
        }
    }
    let head = ["quantity", "points", "coefficients", "residual (rms)", "largest residual", "rms / span [%]"];
    let words = "Quadratic surfaces by least squares over all numeric axes. The residual says what a surface leaves out; bands are not \
                 in it. A dash: the points do not outnumber the coefficients.";
    let mut blocks =
        vec![Block::Text(words.into()), Block::Table(Table::new("Residuals of the surfaces", &head, rows))];
    blocks.extend(maps);
    blocks
}

fn place(point: &PointResult, axes: &[usize]) -> Option<Vec<f64>> {
    axes.iter().map(|axis| point.values[*axis].as_f64()).collect()
}

/// Points with results, by the values of the axes that are not numbers.
fn groups<'a>(collected: &'a Collected, axes: &[usize]) -> Vec<(String, Vec<&'a PointResult>)> {
    let mut groups: Vec<(String, Vec<&PointResult>)> = Vec::new();
    for point in collected.completed() {
        let others = point.values.iter().enumerate().filter(|(k, v)| !axes.contains(k) && v.as_f64().is_none());
        let group = others.map(|(_, value)| plain(value)).collect::<Vec<_>>().join(", ");
        match groups.iter_mut().find(|(name, _)| *name == group) {
            Some((_, points)) => points.push(point),
            None => groups.push((group, vec![point])),
        }
    }
    groups
}

/// The surface over two axes, at the middle of the others.
fn map(
    collected: &Collected,
    axes: &[usize],
    [i, j]: [usize; 2],
    quantity: &Quantity,
    surface: &Response,
    places: &[Vec<f64>],
    values: &[f64],
) -> Block {
    let middle = surface.middle();
    let value = |x: f64, y: f64| {
        let mut place = middle.clone();
        (place[i], place[j]) = (x, y);
        surface.at(&place)
    };
    let is_near =
        |place: &&Vec<f64>| (0..axes.len()).all(|k| k == i || k == j || surface.unit(k, place[k]).abs() <= NEAR);
    let with_values = places.iter().zip(values);
    let points = with_values.filter(|(place, _)| is_near(place)).map(|(place, value)| [place[i], place[j], *value]);
    let label = |k: usize| axis_label(collected, &collected.axes[axes[k]]);
    let others = (0..axes.len()).filter(|&k| k != i && k != j);
    let others: Vec<String> = others.map(|k| inside(&axis_value(collected, axes[k], &middle[k].into()))).collect();
    let at = if others.is_empty() { String::new() } else { format!(" at {}", others.join(", ")) };
    let svg = heat_map_svg(&HeatMap {
        x_label: label(i),
        y_label: label(j),
        x: surface.ends(i),
        y: surface.ends(j),
        value: &value,
        points: points.collect(),
        label: quantity.label(),
    });
    let (title, residual) = (&quantity.title, digits(surface.residual));
    let unit = &quantity.unit;
    Block::Drawing {
        svg,
        caption: format!(
            "{title}: quadratic surface{at}, rms residual {residual} {unit}. Circles: the points near it."
        ),
    }
}
