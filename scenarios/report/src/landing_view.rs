//! A landing seen from the side: the fuselage on the water, to scale, and below it the load along its keel.

use super::axis::Axis;
use super::markup::escape;

/// Width of the drawing; blank on the left and on the right [pixels].
const WIDTH: f64 = 640.0;
const LEFT: f64 = 58.0;
const RIGHT: f64 = 14.0;
/// Height of the load's panel, of a line of text, and of the gap between both panels [pixels].
const LOAD: f64 = 110.0;
const LINE: f64 = 18.0;
const GAP: f64 = 30.0;

/// The ends of both panels' axes, the same for all views of a landing.
#[derive(Clone, Copy, Debug)]
pub struct LandingScales {
    /// Ahead of the centre of mass [m].
    pub ahead: [f64; 2],
    /// Over still water [m].
    pub height: [f64; 2],
    /// Load of a metre of keel, in `unit`.
    pub load: [f64; 2],
}

/// A moment of a landing; points are (ahead of the centre of mass, height over still water) [m].
#[derive(Clone, Debug)]
pub struct LandingView {
    /// What it shows.
    pub title: String,
    /// The keel, from the nose aft.
    pub keel: Vec<[f64; 2]>,
    /// The top of the fuselage, likewise.
    pub top: Vec<[f64; 2]>,
    /// The water's surface, from the left to the right end of the axis.
    pub surface: Vec<[f64; 2]>,
    /// The centre of mass.
    pub centre: [f64; 2],
    /// The load of a metre of keel (ahead [m], load in `unit`), from the nose aft.
    pub load: Vec<[f64; 2]>,
    /// Unit of the load.
    pub unit: String,
}

/// Draws the view as an SVG element.
pub fn landing_view_svg(view: &LandingView, scales: &LandingScales) -> String {
    let LandingScales { ahead, height, load } = *scales;
    let x = Axis { range: ahead, pixels: [LEFT, WIDTH - RIGHT], logarithmic: false };
    let per_metre = (x.pixels[1] - x.pixels[0]) / (ahead[1] - ahead[0]);
    let (top, foot) = (LINE + 6.0, LINE + 6.0 + per_metre * (height[1] - height[0]));
    let z = Axis { range: height, pixels: [foot, top], logarithmic: false };
    let (over, under) = (foot + GAP, foot + GAP + LOAD);
    let q = Axis { range: load, pixels: [under, over], logarithmic: false };
    let whole = under + 2.0 * LINE + 10.0;
    let at = |[px, py]: &[f64; 2], y: &Axis| format!("{:.2} {:.2}", x.at(*px), y.at(*py));
    let path = |points: &[[f64; 2]], y: &Axis| points.iter().map(|p| at(p, y)).collect::<Vec<_>>().join("L ");
    let surface = path(&view.surface, &z);
    let (left, width) = (LEFT, WIDTH - RIGHT - LEFT);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"side\" viewBox=\"0 0 {WIDTH} {whole:.0}\" role=\"img\" aria-label=\"{}\" \
         font-family=\"system-ui, Helvetica, Arial, sans-serif\" font-size=\"12\" fill=\"currentColor\">\n\
         <path d=\"M {surface}V {foot:.2} H {left} Z\" fill=\"#56b4e9\" fill-opacity=\"0.3\" />\n",
        escape(&view.title)
    );
    let outline: Vec<[f64; 2]> = view.keel.iter().chain(view.top.iter().rev()).copied().collect();
    svg += &format!(
        "<path d=\"M {}Z\" fill=\"#8a939e\" fill-opacity=\"0.45\" />\n\
         <path d=\"M {}\" fill=\"none\" stroke=\"currentColor\" stroke-width=\"1.8\" />\n",
        path(&outline, &z),
        path(&view.keel, &z)
    );
    let [cx, cy] = [x.at(view.centre[0]), z.at(view.centre[1])];
    svg += &format!(
        "<path d=\"M {:.2} {cy:.2} h 10 M {cx:.2} {:.2} v 10\" stroke=\"currentColor\" stroke-width=\"1.4\" />\n\
         <path d=\"M {surface}\" fill=\"none\" stroke=\"#0072b2\" stroke-width=\"1.4\" />\n",
        cx - 5.0,
        cy - 5.0
    );
    if let [first, .., last] = view.load.as_slice() {
        let ends = [[first[0], 0.0], [last[0], 0.0]];
        let (line, [from, to]) = (path(&view.load, &q), ends.map(|end| at(&end, &q)));
        svg += &format!(
            "<path d=\"M {from}L {line}L {to}Z\" fill=\"#d55e00\" fill-opacity=\"0.3\" stroke=\"#d55e00\" stroke-width=\"1.4\" />\n"
        );
    } else {
        svg += &text([left + 0.5 * width, over + 0.5 * LOAD], "middle", "no part of the keel is in the water");
    }
    svg += &text([0.0, LINE - 6.0], "start", "height [m]");
    svg += &text([0.0, over - 10.0], "start", &format!("load of a metre of keel [{}]", view.unit));
    for (axis, count) in [(&z, 5), (&q, 4)] {
        for (value, label) in axis.ticks(count) {
            let y = axis.at(value);
            let strength = if value == 0.0 { 0.5 } else { 0.13 };
            svg += &format!(
                "<path d=\"M {left} {y:.2} h {width}\" stroke=\"currentColor\" stroke-opacity=\"{strength}\" />\n"
            );
            svg += &text([left - 6.0, y + 4.0], "end", &label);
        }
    }
    for (value, label) in x.ticks(8) {
        let px = x.at(value);
        for [from, to] in [[top, foot], [over, under]] {
            svg += &format!(
                "<path d=\"M {px:.2} {from:.2} V {to:.2}\" stroke=\"currentColor\" stroke-opacity=\"0.13\" />\n"
            );
        }
        svg += &text([px, under + LINE - 2.0], "middle", &label);
    }
    svg + &text([WIDTH - RIGHT, under + 2.0 * LINE], "end", "ahead of the centre of mass [m]") + "</svg>\n"
}

fn text([x, y]: [f64; 2], anchor: &str, content: &str) -> String {
    format!("<text x=\"{x:.2}\" y=\"{y:.2}\" text-anchor=\"{anchor}\">{}</text>\n", escape(content))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_view_is_to_scale_and_has_water_body_and_load() {
        let (keel, top) = (vec![[10.0, 0.0], [-10.0, -1.0]], vec![[10.0, 2.0], [-10.0, 2.0]]);
        let load = vec![[0.0, 0.2], [-5.0, 1.0]];
        let surface = vec![[-10.0, 1.0], [0.0, 0.0], [10.0, 1.0]];
        let view =
            LandingView { title: "a & b".into(), keel, top, surface, centre: [0.0, 1.0], load, unit: "MN/m".into() };
        let scales = LandingScales { ahead: [-10.0, 10.0], height: [-2.0, 4.0], load: [0.0, 1.0] };
        let svg = landing_view_svg(&view, &scales);
        // 568 pixels are 20 m: 6 m of height are 170.4
        assert!(svg.contains("viewBox=\"0 0 640 380\"") && svg.contains("load of a metre of keel [MN/m]"), "{svg}");
        assert!(svg.contains("M 58.00 109.20L 342.00 137.60L 626.00 109.20V 194.40 H 58 Z"), "{svg}");
        assert!(svg.contains("a &amp; b") && svg.matches("#d55e00").count() == 2 && !svg.contains("NaN"), "{svg}");
        let dry = landing_view_svg(&LandingView { load: Vec::new(), ..view }, &scales);
        assert!(dry.contains("no part of the keel"), "{dry}");
    }
}
