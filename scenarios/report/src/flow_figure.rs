//! A picture of the flow with its legend: time, scale bar and colour bar below the particles.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::colour::{hex, viridis};
use super::flow::{FlowFrame, FlowView, Window, flow_png};
use super::markup::escape;
use super::ticks::{nice_length, nice_step, proper_range, tick_label, ticks};

/// Width of the drawing in its own units; the page scales it.
const WIDTH: f64 = 1000.0;
/// Height of the legend.
const LEGEND: f64 = 84.0;
/// Blank on the left and on the right of the legend.
const MARGIN: f64 = 18.0;
/// Pieces of the colour bar.
const STOPS: usize = 64;

/// `frame` as a stand-alone SVG element: the particles of [`flow_png`], the legend as text and lines.
///
/// Text takes the colour of the page; the same input gives the same bytes.
pub fn flow_svg(frame: &FlowFrame, view: &FlowView) -> String {
    let window = Window::new(view);
    let scale = WIDTH / window.width as f64;
    let top = scale * window.height as f64;
    let png = STANDARD.encode(flow_png(frame, view));
    let (time, height) = (frame.time, top + LEGEND);
    let beyond = frame.value.iter().any(|value| f64::from(*value) > view.value[0].max(view.value[1]));
    let legend = scale_bar(window.scale * scale, top) + &colour_bar(view, top, beyond);
    let said = escape(&format!("{} at t = {time:.4} s, colours up to {:.3}", view.label, view.value[1]));
    format!(
        r##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height:.1}" role="img" aria-label="{said}" font-family="sans-serif" font-size="18" fill="currentColor" stroke-width="1.5">
<image href="data:image/png;base64,{png}" width="{WIDTH}" height="{top:.1}" />
<text x="{MARGIN}" y="{:.1}">t = {time:.4} s</text>
{legend}</svg>
"##,
        top + 26.0
    )
}

/// A line of round length, at most a fifth of the picture, at `scale` units per metre.
fn scale_bar(scale: f64, top: f64) -> String {
    let metres = nice_length(0.2 * WIDTH / scale);
    let (right, y) = (MARGIN + metres * scale, top + 50.0);
    let (low, high) = (y - 7.0, y + 7.0);
    format!(
        "<path d=\"M {MARGIN} {low:.1} V {high:.1} M {MARGIN} {y:.1} H {right:.1} M {right:.1} {low:.1} V {high:.1}\" \
         stroke=\"currentColor\" fill=\"none\" />\n<text x=\"{:.1}\" y=\"{:.1}\">{} m</text>\n",
        right + 10.0,
        y + 6.0,
        tick_label(metres, metres)
    )
}

/// The colour map over the right half, with ticks at round values and the name of the value above; an arrow where values go beyond.
fn colour_bar(view: &FlowView, top: f64, beyond: bool) -> String {
    let ([left, right], [low, high]) = ([0.5 * WIDTH, WIDTH - 2.0 * MARGIN], proper_range(view.value));
    let (bar, foot, width) = (top + 34.0, top + 52.0, right - left);
    // pieces, for a gradient would need a name of its own in a page of many pictures; they overlap, so that no seam shows
    let piece = |k: usize| {
        let (x, long) =
            (left + width * k as f64 / STOPS as f64, width / STOPS as f64 + if k + 1 < STOPS { 0.5 } else { 0.0 });
        let colour = hex(viridis((k as f64 + 0.5) / STOPS as f64));
        format!(
            "<rect x=\"{x:.2}\" y=\"{bar:.1}\" width=\"{long:.2}\" height=\"18\" shape-rendering=\"crispEdges\" fill=\"{colour}\" />"
        )
    };
    let pieces: String = (0..STOPS).map(piece).collect();
    let step = nice_step(high - low, 5);
    let tick = |value: f64| {
        let x = left + (value - low) / (high - low) * width;
        let label = tick_label(value, step);
        let (end, y) = (foot + 5.0, foot + 24.0);
        format!(
            "<path d=\"M {x:.1} {foot:.1} V {end:.1}\" stroke=\"currentColor\" />\n\
             <text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"middle\">{label}</text>\n"
        )
    };
    let marks: String = ticks([low, high], step).map(tick).collect();
    let (label, y, middle) = (escape(&view.label), top + 26.0, bar + 9.0);
    let arrow = match beyond {
        true => {
            let (end, colour) = (right + 12.0, hex(viridis(1.0)));
            format!(
                "<path d=\"M {right:.1} {bar:.1} L {end:.1} {middle:.1} L {right:.1} {foot:.1} Z\" fill=\"{colour}\" />\n"
            )
        }
        false => String::new(),
    };
    format!("<text x=\"{left}\" y=\"{y:.1}\">{label}</text>\n{pieces}\n{arrow}{marks}")
}
