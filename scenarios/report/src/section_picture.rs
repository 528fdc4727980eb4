//! A drawing of a scene's body as it was understood: outline, panels, gauges, still water.

use std::fmt::Write;

use fsi_coupling::geometry::polygon;
use scene::{Body, GaugeFrame, Scene};
use settings::significant;

use super::markup::escape;

/// Width of the picture, and margin round the body [px].
const WIDTH: f64 = 900.0;
const MARGIN: f64 = 90.0;
/// Points that are numbered, at most.
const NUMBERED: usize = 40;
const PANEL_COLOURS: [&str; 4] = ["#c0392b", "#d68910", "#7d3c98", "#1e8449"];

/// From metres in the tank's frame to the picture's pixels.
struct View {
    low: [f64; 2],
    high: [f64; 2],
    scale: f64,
}

impl View {
    /// A view of points [m].
    fn of(points: &[[f64; 2]]) -> View {
        let [low, high] = polygon::bounding_box(points);
        let across = (high[0] - low[0]).max(0.5 * (high[1] - low[1])).max(f64::MIN_POSITIVE);
        View { low, high, scale: (WIDTH - 2.0 * MARGIN) / across }
    }

    fn height(&self) -> f64 {
        2.0 * MARGIN + self.scale * (self.high[1] - self.low[1])
    }

    fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [MARGIN + self.scale * (x - self.low[0]), MARGIN + self.scale * (self.high[1] - y)]
    }

    fn points(&self, line: &[[f64; 2]]) -> String {
        let pair = |point: &[f64; 2]| {
            let [x, y] = self.at(*point);
            format!("{x:.2},{y:.2}")
        };
        line.iter().map(pair).collect::<Vec<_>>().join(" ")
    }
}

/// The drawing as SVG; without a body only the tank.
pub fn section_picture(scene: &Scene) -> String {
    let tank = &scene.tank;
    let half = 0.5 * tank.width;
    let outlines: Vec<[f64; 2]> = scene.all_bodies().flat_map(Body::placed_outline).collect();
    let shown = match outlines.is_empty() {
        false => outlines,
        true => vec![[-half, -tank.depth], [half, tank.height - tank.depth]],
    };
    let view = View::of(&shown);
    let (mut svg, height) = (String::new(), view.height());
    let _ = write!(
        svg,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height:.0}\" font-family=\"sans-serif\" font-size=\"13\">\n\
         <rect width=\"{WIDTH}\" height=\"{height:.0}\" fill=\"#ffffff\"/>\n"
    );
    let [_, surface] = view.at([0.0, 0.0]);
    if (0.0..=height).contains(&surface) {
        let below = height - surface;
        let _ = write!(
            svg,
            "<rect y=\"{surface:.2}\" width=\"{WIDTH}\" height=\"{below:.2}\" fill=\"#d6eaf8\"/>\n\
             <text x=\"6\" y=\"{:.2}\" fill=\"#2471a3\">still water, y = 0</text>\n",
            surface - 5.0
        );
    }
    scene.all_bodies().for_each(|body| draw_body(&mut svg, &view, body));
    for gauge in &scene.gauges {
        let place = match (&scene.body, gauge.on) {
            (Some(body), GaugeFrame::Body) => body.to_tank(gauge.at),
            _ => gauge.at,
        };
        mark(&mut svg, &view, place, "#2471a3", &gauge.name);
    }
    let size = [view.high[0] - view.low[0], view.high[1] - view.low[1]].map(significant);
    let [x, y] = view.low.map(significant);
    let title = format!("{}: {} m wide, {} m high, from x = {x} m, y = {y} m", scene.name, size[0], size[1]);
    let _ = write!(svg, "<text x=\"6\" y=\"20\" fill=\"#26292e\">{}</text>\n</svg>\n", escape(&title));
    svg
}

/// The outline with its numbered points, the panels and the centre of mass.
fn draw_body(svg: &mut String, view: &View, body: &Body) {
    let outline = body.placed_outline();
    let _ = writeln!(
        svg,
        "<polygon points=\"{}\" fill=\"#c4c8ce\" stroke=\"#26292e\" stroke-width=\"1.5\"/>",
        view.points(&outline)
    );
    let every = outline.len().div_ceil(NUMBERED).max(1);
    for (k, point) in outline.iter().enumerate().filter(|(k, _)| k % every == 0) {
        let [x, y] = view.at(*point);
        let _ = writeln!(
            svg,
            "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"2\"/><text x=\"{:.2}\" y=\"{:.2}\" font-size=\"9\" fill=\"#5d6d7e\">{}</text>",
            x + 3.0,
            y - 3.0,
            k + 1
        );
    }
    for (i, (panel, colour)) in body.panels.iter().zip(PANEL_COLOURS.iter().cycle()).enumerate() {
        let line: Vec<[f64; 2]> = scene::panel_line(body, panel).into_iter().map(|p| body.to_tank(p)).collect();
        let _ = writeln!(
            svg,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"5\"/>\
             <text x=\"6\" y=\"{}\" fill=\"{colour}\">panel {}</text>",
            view.points(&line),
            40 + 18 * i,
            escape(&panel.name)
        );
    }
    mark(svg, view, body.to_tank(body.center_of_mass), "#26292e", "centre of mass");
}

fn mark(svg: &mut String, view: &View, place: [f64; 2], colour: &str, name: &str) {
    let [x, y] = view.at(place);
    let _ = writeln!(
        svg,
        "<path d=\"M{:.2},{y:.2}h12M{x:.2},{:.2}v12\" stroke=\"{colour}\" stroke-width=\"1.5\"/>\
         <text x=\"{:.2}\" y=\"{:.2}\" fill=\"{colour}\">{}</text>",
        x - 6.0,
        y - 6.0,
        x + 8.0,
        y + 14.0,
        escape(name)
    );
}
