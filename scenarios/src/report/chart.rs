//! Curves in one coordinate system, as SVG.

use super::decimate::decimate;
use super::markup::{escape, printable};
use super::ticks::{nice_step, proper_range, tick_label};
use kuva::prelude::{
    Layout, LegendEntry, LegendPosition, LegendShape, LinePlot, LineStyle, MarkerShape, Plot, ScatterPlot, SvgBackend,
    TextAnnotation, Theme, TickFormat,
};
use kuva::render::layout::ComputedLayout;
use kuva::render::render::{Primitive, Scene, render_multiple};
use std::sync::Arc;

const WIDTH: f64 = 620.0;
const PLOT_HEIGHT: f64 = 270.0;
const POINTS_PER_CURVE: usize = 1000;
/// Blank that the layout leaves below a legend without a box \[pixels\].
const LEGEND_SLACK: f64 = 16.0;

type Style = (&'static str, MarkerShape);

/// Colours and markers, in the order of the curves, then from the start again. The colours are
/// those of M. Okabe and K. Ito, *Color Universal Design* (2008), without yellow and black: they
/// read on white and on black; then two of P. Tol's (2021), for charts with many curves.
const STYLES: [Style; 9] = [
    ("#0072b2", MarkerShape::Circle),
    ("#d55e00", MarkerShape::Square),
    ("#009e73", MarkerShape::Triangle),
    ("#cc79a7", MarkerShape::Diamond),
    ("#e69f00", MarkerShape::Cross),
    ("#56b4e9", MarkerShape::Plus),
    ("#808080", MarkerShape::Star),
    ("#332288", MarkerShape::Diamond),
    ("#882255", MarkerShape::Square),
];

/// How a curve is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// A full line.
    Line,
    /// A dashed line.
    Dashed,
    /// A marker at each point, no line.
    Points,
    /// The outline of a marker at each point, no line.
    Hollow,
}

/// A thin straight line in the colour of a curve, such as a law fitted to it; it has no entry in the legend.
#[derive(Clone, Copy, Debug)]
pub struct TrendLine {
    /// Index of the curve.
    pub curve: usize,
    /// Both ends (x, y).
    pub ends: [[f64; 2]; 2],
}

/// A sequence of points (x, y). If the two arrays differ in length, the longer one's surplus is
/// left out; points with a non-finite coordinate are left out too.
#[derive(Clone, Debug)]
pub struct Curve {
    /// Name in the legend; unnamed curves have no entry there.
    pub label: String,
    /// How it is drawn.
    pub mark: Mark,
    /// Abscissae, in the unit that [`Chart::x_label`] states.
    pub x: Vec<f64>,
    /// Ordinates, in the unit that [`Chart::y_label`] states.
    pub y: Vec<f64>,
}

impl Curve {
    /// A named curve through points (x, y).
    pub fn new(label: impl Into<String>, mark: Mark, points: impl IntoIterator<Item = [f64; 2]>) -> Curve {
        let (x, y) = points.into_iter().map(|[x, y]| (x, y)).unzip();
        Curve { label: label.into(), mark, x, y }
    }
}

/// Curves that share two axes.
#[derive(Clone, Debug, Default)]
pub struct Chart {
    /// Title; empty for none.
    pub title: String,
    /// What is plotted along x, with its unit in brackets.
    pub x_label: String,
    /// What is plotted along y, with its unit in brackets.
    pub y_label: String,
    /// The curves, first at the bottom.
    pub curves: Vec<Curve>,
    /// Straight lines that belong to curves, drawn where the axes that follow from the curves show them.
    pub trends: Vec<TrendLine>,
    /// Ends of the x axis; absent, they follow from the curves.
    pub x_range: Option<[f64; 2]>,
    /// Ends of the y axis; absent, they follow from what the x axis shows of the curves.
    pub y_range: Option<[f64; 2]>,
    /// Both axes in powers of ten; ranges are not used, and values ≤ 0 are left out.
    pub logarithmic: bool,
}

impl Chart {
    /// Curves on linear axes whose ends follow from them.
    pub fn new(
        title: impl Into<String>,
        x_label: impl Into<String>,
        y_label: impl Into<String>,
        curves: Vec<Curve>,
    ) -> Chart {
        let (title, x_label, y_label) = (title.into(), x_label.into(), y_label.into());
        Chart { title, x_label, y_label, curves, ..Chart::default() }
    }
}

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

    let mut plots: Vec<Plot> = chart.trends.iter().map(|t| trend(t, STYLES[t.curve % STYLES.len()].0)).collect();
    let mut legend = Vec::new();
    for ((curve, points), style) in chart.curves.iter().zip(&curves).zip(STYLES.into_iter().cycle()) {
        let mut points = decimate(points, POINTS_PER_CURVE);
        for p in &mut points {
            *p = [near(p[0], x_range), near(p[1], y_range)];
        }
        let (plot, entry) = plot(curve, &points, style);
        plots.push(plot);
        legend.extend((!curve.label.is_empty()).then_some(entry));
    }
    let mut layout = axes(chart, title, x_range, y_range, legend);
    if curves.iter().all(Vec::is_empty) {
        let [x, y] = [x_range, y_range].map(|[low, high]| 0.5 * low + 0.5 * high);
        let note = TextAnnotation::new("no data", x, y).with_color("currentColor");
        layout = layout.with_annotation(note);
        // Without any plot there would be no axes either.
        plots.push(LinePlot::new().into());
    }
    let slack = if layout.show_legend { LEGEND_SLACK } else { 0.0 };
    let mut scene = render_multiple(plots, layout);
    scene.height -= slack;
    to_svg(scene, &chart.title)
}

/// The plot of a curve's points, and its entry in the legend.
fn plot(curve: &Curve, points: &[[f64; 2]], (colour, marker): Style) -> (Plot, LegendEntry) {
    let is_hollow = curve.mark == Mark::Hollow;
    let marker = if is_hollow { MarkerShape::Circle } else { marker }; // crosses have no inside
    let data = points.iter().map(|&[x, y]| (x, y));
    let line = LinePlot::new().with_color(colour).with_stroke_width(1.6);
    // A line needs two points; a single one is a result too.
    let (plot, shape, dasharray) = match curve.mark {
        Mark::Line if points.len() != 1 => (line.with_data(data).into(), LegendShape::Line, None),
        Mark::Dashed if points.len() != 1 => {
            let dashes = LineStyle::Custom("6 4".into());
            let dasharray = dashes.dasharray();
            let plot = line.with_data(data).with_line_style(dashes);
            (plot.into(), LegendShape::Line, dasharray)
        }
        _ => {
            let mut plot = ScatterPlot::new().with_data(data).with_color(colour).with_size(4.0);
            if is_hollow {
                plot = plot.with_marker_opacity(0.0).with_marker_stroke_width(1.4);
            }
            (plot.with_marker(marker).into(), LegendShape::Marker(marker), None)
        }
    };
    let (label, color) = (label(&curve.label), colour.into());
    (plot, LegendEntry { label, color, shape, dasharray })
}

fn is_marked(mark: Mark) -> bool {
    matches!(mark, Mark::Points | Mark::Hollow)
}

fn trend(line: &TrendLine, colour: &str) -> Plot {
    let ends = line.ends.into_iter().map(|[x, y]| (x, y));
    LinePlot::new().with_data(ends).with_color(colour).with_stroke_width(0.8).into()
}

/// The points of a curve that can be drawn.
fn shown(curve: &Curve, logarithmic: bool) -> Vec<[f64; 2]> {
    let points = curve.x.iter().zip(&curve.y).map(|(&x, &y)| [x, y]);
    points.filter(|p| p.iter().all(|c| c.is_finite() && (*c > 0.0 || !logarithmic))).collect()
}

fn axes(chart: &Chart, title: &str, x: [f64; 2], y: [f64; 2], legend: Vec<LegendEntry>) -> Layout {
    let (x_step, y_step) = (nice_step(x[1] - x[0], 8), nice_step(y[1] - y[0], 6));
    let theme = Theme {
        background: "none".into(),
        axis_color: "currentColor".into(),
        tick_color: "currentColor".into(),
        text_color: "currentColor".into(),
        grid_color: "rgba(128,128,128,0.25)".into(),
        font_family: Some("system-ui, Helvetica, Arial, sans-serif".into()),
        ..Theme::light()
    };
    let format = |step| TickFormat::Custom(Arc::new(move |value| tick_label(value, step)));
    let mut layout = Layout::new((x[0], x[1]), (y[0], y[1]))
        .with_width(WIDTH)
        .with_theme(theme)
        .with_x_axis_min(x[0])
        .with_x_axis_max(x[1])
        .with_y_axis_min(y[0])
        .with_y_axis_max(y[1])
        .with_title_size(15)
        .with_title_wrap(70)
        .with_label_size(13)
        .with_x_label(label(&chart.x_label))
        .with_x_label_wrap(80)
        .with_y_label(label(&chart.y_label))
        .with_y_label_wrap(40);
    layout = match chart.logarithmic {
        true => layout.with_log_scale().with_tick_format(TickFormat::Custom(Arc::new(|value| value.to_string()))),
        false => layout
            .with_x_tick_step(x_step)
            .with_y_tick_step(y_step)
            .with_x_tick_format(format(x_step))
            .with_y_tick_format(format(y_step)),
    };
    if !title.is_empty() {
        layout = layout.with_title(label(title));
    }
    if !legend.is_empty() {
        layout = layout
            .with_legend_entries(legend)
            .with_legend_position(LegendPosition::OutsideBottomColumns)
            .with_legend_box(false);
    }
    // Long legends and titles make the chart higher, not the plot lower.
    let margins = ComputedLayout::from_layout(&layout);
    layout.with_height(margins.margin_top + PLOT_HEIGHT + margins.margin_bottom)
}

/// Least and greatest coordinate of all points, with a margin as a fraction of their distance. A
/// quantity that never changes sign and comes near zero is shown from zero.
fn extent(curves: &[Vec<[f64; 2]>], axis: usize, margin: f64) -> [f64; 2] {
    let values = curves.iter().flatten().map(|p| p[axis]);
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
    let [low, high] = proper_range([low, high]);
    let margin = margin * (high - low);
    let end = |end: f64, other: f64, margin: f64| {
        let from_zero = margin != 0.0 && end * other >= 0.0 && end.abs() < 0.25 * other.abs();
        if from_zero { 0.0 } else { end + margin }
    };
    [end(low, high, -margin), end(high, low, margin)]
}

/// Least and greatest coordinate of all points, all above zero, with a margin in powers of ten.
fn decades(curves: &[Vec<[f64; 2]>], axis: usize) -> [f64; 2] {
    let points = curves.iter().flatten().map(|p| p[axis].log10());
    let (low, high) = points.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
    let [low, high] = proper_range([low, high]);
    [low - 0.1, high + 0.1].map(|e| 10f64.powf(e.clamp(-300.0, 300.0)))
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

/// `value`, or a value far outside `range` on the same side: SVG readers calculate in single
/// precision.
fn near(value: f64, [low, high]: [f64; 2]) -> f64 {
    const SPANS: f64 = 1e3;
    value.clamp(low - SPANS * (high - low), high + SPANS * (high - low))
}

/// Text for the plotting crate, which takes `$` as the start of a formula.
fn label(text: &str) -> String {
    printable(text).replace('$', "\\$")
}

/// The scene as SVG that scales, has a label for those who hear it read, and the same bytes each time.
fn to_svg(mut scene: Scene, title: &str) -> String {
    // The crate numbers clip paths with a global counter. Named by their geometry, equal names mean
    // equal paths, also among several charts on one page.
    for element in &mut scene.elements {
        if let Primitive::ClipStart { x, y, width, height, id } = element {
            let name = format!("clip-{x:.2}-{y:.2}-{width:.2}-{height:.2}");
            for definition in &mut scene.defs {
                *definition = definition.replace(&format!("\"{id}\""), &format!("\"{name}\""));
            }
            *id = name;
        }
    }
    let svg = SvgBackend::new().render_scene(&scene);
    let (width, height) = (scene.width, scene.height);
    let opening = format!(r#"<svg viewBox="0 0 {width} {height}" role="img" aria-label="{}" "#, escape(title));
    svg.replacen("<svg ", &opening, 1)
}
