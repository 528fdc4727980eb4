//! A chart as SVG: light grid, curves, markers, legend below.

use super::axis::{Axis, decades, extent};
use super::chart::{Chart, Curve, Mark};
use super::colour::hex;
use super::decimate::decimate;
use super::markup::escape;
use super::ticks::proper_range;

const WIDTH: f64 = 640.0;
const PLOT_HEIGHT: f64 = 260.0;
const POINTS_PER_CURVE: usize = 1000;
/// Height of a line [pixels].
const LINE: f64 = 18.0;
/// Width of a digit and of a letter, on average, with room for the larger ones of a phone [pixels].
const DIGIT: f64 = 10.0;
const LETTER: f64 = 7.8;
/// Blank on the right, for half the last number of the x axis [pixels].
const RIGHT: f64 = 20.0;
/// Length of a legend's line, and blank behind an entry [pixels].
const SAMPLE: f64 = 22.0;
const GAP: f64 = 18.0;

/// Colours, in the order of the curves, then from the start again. They are those of M. Okabe and K. Ito, *Color Universal Design*
/// (2008), without yellow and black: they read on white and on black; then two more that do, for charts with many curves.
const COLOURS: [&str; 9] =
    ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#808080", "#8a63d2", "#b5487a"];

/// Dashes, likewise; the first is a full line.
const DASHES: [&str; 4] = ["", "6 4", "1.5 3.5", "10 3 2 3"];

/// Markers, likewise; the first is a circle.
const MARKERS: [&str; 5] = [
    "",
    "M -3.2 -3.2 H 3.2 V 3.2 H -3.2 Z",
    "M 0 -4.2 L 3.9 2.8 H -3.9 Z",
    "M 0 -4.4 L 4.4 0 L 0 4.4 L -4.4 0 Z",
    "M -3.2 3.2 H 3.2 L 0 -3.2 Z",
];

/// Draws `chart` as a stand-alone SVG document.
///
/// Text and axes take the colour of the surrounding text (black when alone) and the background is
/// transparent, so that the chart suits light and dark pages. Of a long curve about a thousand
/// points are drawn, its peaks among them. Same input, same bytes.
pub fn chart_svg(chart: &Chart) -> String {
    draw(chart, &chart.title)
}

/// As [`chart_svg`], with the title left to the caption beside it.
pub(super) fn untitled_svg(chart: &Chart) -> String {
    draw(chart, "")
}

fn draw(chart: &Chart, title: &str) -> String {
    let mut curves: Vec<_> = chart.curves.iter().map(|curve| shown(curve, chart.logarithmic)).collect();
    let has_markers = chart.curves.iter().any(|curve| is_marked(curve.mark));
    let x_margin = if has_markers { 0.03 } else { 0.0 };
    let x_range = match chart.logarithmic {
        true => decades(&curves, 0),
        false => proper_range(chart.x_range.unwrap_or_else(|| extent(&curves, 0, x_margin))),
    };
    for (points, curve) in curves.iter_mut().zip(&chart.curves) {
        *points = within(points, x_range, !is_marked(curve.mark));
    }
    let y_range = match chart.logarithmic {
        true => decades(&curves, 1),
        false => proper_range(chart.y_range.unwrap_or_else(|| extent(&curves, 1, 0.05))),
    };
    let heading = if title.is_empty() { 0.0 } else { LINE + 4.0 };
    let top = heading + if chart.y_label.is_empty() { 8.0 } else { LINE + 8.0 };
    let bottom = top + PLOT_HEIGHT;
    let y = Axis { range: y_range, pixels: [bottom, top], logarithmic: chart.logarithmic };
    let y_ticks = y.ticks(6);
    let widest = y_ticks.iter().map(|(_, label)| label.chars().count()).max().unwrap_or(0);
    let left = (DIGIT * widest as f64 + 10.0).max(24.0);
    let x = Axis { range: x_range, pixels: [left, WIDTH - RIGHT], logarithmic: chart.logarithmic };
    let (legend, legend_height) = legend(chart, left, bottom + 3.0 * LINE);
    let height = bottom + 2.0 * LINE + 8.0 + legend_height;
    let area = [left, top, x.pixels[1] - left, PLOT_HEIGHT];
    let clip = format!("clip-{left:.0}-{top:.0}");
    let trends =
        chart.trends.iter().filter_map(|t| trend([&x, &y], t.ends, &colour(chart.curves.get(t.curve), t.curve)));
    let plots =
        chart.curves.iter().zip(&curves).enumerate().map(|(k, (curve, points))| plot([&x, &y], curve, points, k));
    let data: String = trends.chain(plots).collect();
    let nothing = match curves.iter().all(Vec::is_empty) {
        true => text([left + 0.5 * area[2], top + 0.5 * PLOT_HEIGHT], "middle", "no data"),
        false => String::new(),
    };
    let ranges = [x_range, y_range].concat().iter().map(|v| format!("{v:e}")).collect::<Vec<_>>().join(" ");
    let [l, t, w, h] = area;
    let kind = if chart.logarithmic { "log" } else { "linear" };
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plot\" viewBox=\"0 0 {WIDTH} {height:.0}\" role=\"img\" aria-label=\"{}\" \
         data-range=\"{ranges}\" data-area=\"{l:.2} {t:.2} {w:.2} {h:.2}\" data-scale=\"{kind}\" data-x=\"{}\" \
         font-family=\"system-ui, Helvetica, Arial, sans-serif\" font-size=\"12\" fill=\"currentColor\">\n\
         <defs><clipPath id=\"{clip}\"><rect x=\"{l:.2}\" y=\"{t:.2}\" width=\"{w:.2}\" height=\"{h:.2}\" /></clipPath></defs>\n\
         {}{}<g class=\"axes\">\n{}</g>\n<g clip-path=\"url(#{clip})\"><g class=\"data\" fill=\"none\">\n{data}</g></g>\n{nothing}{}{legend}</svg>\n",
        escape(&said(chart)),
        escape(&chart.x_label),
        if title.is_empty() { String::new() } else { bold([0.0, 15.0], title) },
        if chart.y_label.is_empty() { String::new() } else { text([0.0, top - 13.0], "start", &chart.y_label) },
        grid(&x, &y, area),
        text([WIDTH - RIGHT, bottom + 2.0 * LINE], "end", &chart.x_label),
    )
}

/// A chart in words: what is drawn over what, and its curves.
fn said(chart: &Chart) -> String {
    let mut words = chart.title.clone();
    if !chart.y_label.is_empty() || !chart.x_label.is_empty() {
        words += &format!(": {} over {}", chart.y_label, chart.x_label);
    }
    let named: Vec<&str> = chart.curves.iter().map(|c| c.label.as_str()).filter(|label| !label.is_empty()).collect();
    if named.is_empty() { words } else { words + "; " + &named.join(", ") }
}

/// Grid lines and tick labels.
fn grid(x: &Axis, y: &Axis, [left, top, width, height]: [f64; 4]) -> String {
    let (right, bottom) = (left + width, top + height);
    let rule = |ends: String, strength: f64| {
        format!("<path d=\"{ends}\" stroke=\"currentColor\" stroke-opacity=\"{strength}\" fill=\"none\" />\n")
    };
    let mut svg = String::new();
    for (value, label) in y.ticks(6) {
        let at = y.at(value);
        svg += &rule(format!("M {left:.2} {at:.2} H {right:.2}"), if value == 0.0 { 0.45 } else { 0.13 });
        svg += &text([left - 6.0, at + 4.0], "end", &label);
    }
    for (value, label) in x.ticks(7) {
        let (at, end) = (x.at(value), bottom + 4.0);
        svg += &rule(format!("M {at:.2} {bottom:.2} V {end:.2}"), 0.6);
        svg += &text([at, bottom + LINE - 1.0], "middle", &label);
    }
    svg + &rule(format!("M {left:.2} {bottom:.2} H {right:.2}"), 0.6)
}

/// A curve as a path, or a marker for each point.
fn plot(axes: [&Axis; 2], curve: &Curve, points: &[[f64; 2]], index: usize) -> String {
    let colour = colour(Some(curve), index);
    let places = decimate(points, POINTS_PER_CURVE).into_iter().map(|[x, y]| [axes[0].at(x), axes[1].at(y)]);
    let places: Vec<[f64; 2]> = places.collect();
    let label = escape(&curve.label);
    if is_marked(curve.mark) || places.len() == 1 {
        // a line needs two points; a single one is a result too
        let marks: String = places.iter().map(|at| marker(*at, curve, index, &colour)).collect();
        return format!("<g class=\"curve\" data-label=\"{label}\" data-colour=\"{colour}\">{marks}</g>\n");
    }
    let dashes = dashes(curve);
    let [width, opacity] = if curve.paint.pale { ["1.1", " stroke-opacity=\"0.45\""] } else { ["1.8", ""] };
    let path: Vec<String> = places.iter().map(|[x, y]| format!("{x:.2} {y:.2}")).collect();
    let path = if path.is_empty() { String::new() } else { format!("M {}", path.join("L ")) };
    format!(
        "<path d=\"{path}\" class=\"curve\" data-label=\"{label}\" data-colour=\"{colour}\" stroke=\"{colour}\" \
         stroke-width=\"{width}\" stroke-linejoin=\"round\"{opacity}{dashes} />\n"
    )
}

/// The colour of a curve.
fn colour(curve: Option<&Curve>, index: usize) -> String {
    let own = curve.and_then(|curve| curve.paint.colour);
    own.map_or_else(|| COLOURS[index % COLOURS.len()].to_string(), hex)
}

/// The dashes of a line, as an attribute.
fn dashes(curve: &Curve) -> String {
    let form = curve.paint.form.unwrap_or(usize::from(curve.mark == Mark::Dashed));
    match DASHES[form % DASHES.len()] {
        "" => String::new(),
        lengths => format!(" stroke-dasharray=\"{lengths}\""),
    }
}

fn marker([x, y]: [f64; 2], curve: &Curve, index: usize, colour: &str) -> String {
    let paint = match curve.mark {
        Mark::Hollow => format!("fill=\"{colour}\" fill-opacity=\"0\" stroke=\"{colour}\" stroke-width=\"1.4\""),
        _ => format!("fill=\"{colour}\""),
    };
    let place = format!("transform=\"translate({x:.2} {y:.2})\"");
    match MARKERS[curve.paint.form.unwrap_or(index) % MARKERS.len()] {
        "" => format!("<circle r=\"3.4\" {place} {paint} />"),
        _ if curve.mark == Mark::Hollow && curve.paint.form.is_none() => {
            format!("<circle r=\"3.4\" {place} {paint} />")
        }
        shape => format!("<path d=\"{shape}\" {place} {paint} />"),
    }
}

fn trend([x, y]: [&Axis; 2], ends: [[f64; 2]; 2], colour: &str) -> Option<String> {
    let drawable = ends.iter().flatten().all(|v| v.is_finite() && (*v > 0.0 || !x.logarithmic));
    let [[x0, y0], [x1, y1]] = ends.map(|[u, v]| [x.at(u), y.at(v)]);
    drawable.then(|| {
        format!("<path d=\"M {x0:.2} {y0:.2} L {x1:.2} {y1:.2}\" class=\"trend\" stroke=\"{colour}\" stroke-width=\"0.8\" />\n")
    })
}

/// The legend from its first line's height on, and its own height; nothing for unnamed curves, or a single one.
fn legend(chart: &Chart, left: f64, top: f64) -> (String, f64) {
    let (mut svg, mut x, mut y) = (String::new(), left, top);
    let named = |curve: &&(usize, &Curve)| !curve.1.label.is_empty();
    let entries = if chart.legend.is_empty() { &chart.curves } else { &chart.legend };
    let curves: Vec<(usize, &Curve)> = entries.iter().enumerate().collect();
    for (index, curve) in curves.iter().filter(named) {
        let width = SAMPLE + 6.0 + LETTER * curve.label.chars().count() as f64 + GAP;
        if x > left && x + width > WIDTH {
            (x, y) = (left, y + LINE);
        }
        let (colour, middle) = (colour(Some(curve), *index), y - 4.0);
        svg += &match curve.mark {
            Mark::Points | Mark::Hollow => marker([x + 0.5 * SAMPLE, middle], curve, *index, &colour),
            _ => {
                let (dashes, end) = (dashes(curve), x + SAMPLE);
                let opacity = if curve.paint.pale { " stroke-opacity=\"0.45\"" } else { "" };
                format!(
                    "<path d=\"M {x:.2} {middle:.2} H {end:.2}\" stroke=\"{colour}\" stroke-width=\"2\"{opacity}{dashes} />"
                )
            }
        };
        svg += &text([x + SAMPLE + 6.0, y], "start", &curve.label);
        x += width;
    }
    let height = if svg.is_empty() { 0.0 } else { y - top + LINE };
    (format!("<g class=\"legend\">{svg}</g>\n"), height)
}

fn text([x, y]: [f64; 2], anchor: &str, content: &str) -> String {
    format!("<text x=\"{x:.2}\" y=\"{y:.2}\" text-anchor=\"{anchor}\">{}</text>\n", escape(content))
}

fn bold([x, y]: [f64; 2], content: &str) -> String {
    format!("<text x=\"{x:.2}\" y=\"{y:.2}\" font-size=\"14\" font-weight=\"600\">{}</text>\n", escape(content))
}

fn is_marked(mark: Mark) -> bool {
    matches!(mark, Mark::Points | Mark::Hollow)
}

/// The points of a curve that can be drawn.
fn shown(curve: &Curve, logarithmic: bool) -> Vec<[f64; 2]> {
    let points = curve.x.iter().zip(&curve.y).map(|(&x, &y)| [x, y]);
    points.filter(|p| p.iter().all(|c| c.is_finite() && (*c > 0.0 || !logarithmic))).collect()
}

/// The points with x in `range`; of a line also those whose segments reach into it.
fn within(points: &[[f64; 2]], [low, high]: [f64; 2], is_line: bool) -> Vec<[f64; 2]> {
    let meets = |a: [f64; 2], b: [f64; 2]| a[0].min(b[0]) <= high && a[0].max(b[0]) >= low;
    let seen = |i: usize| {
        let next_to = |j: usize| is_line && points.get(j).is_some_and(|&q| meets(points[i], q));
        meets(points[i], points[i]) || next_to(i + 1) || next_to(i.wrapping_sub(1))
    };
    (0..points.len()).filter(|&i| seen(i)).map(|i| points[i]).collect()
}
