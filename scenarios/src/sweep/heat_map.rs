//! A function of two variables as a field of colours, with the points that it was fitted to.

use report::run_page::quantity::digits;
use report::{Axis, escape, viridis};

/// A field of colours.
pub(super) struct HeatMap<'a> {
    /// What is plotted along x, with its unit.
    pub x_label: String,
    /// What is plotted along y, with its unit.
    pub y_label: String,
    /// Ends of x.
    pub x: [f64; 2],
    /// Ends of y.
    pub y: [f64; 2],
    /// The function.
    pub value: &'a dyn Fn(f64, f64) -> f64,
    /// Points (x, y) with their own values.
    pub points: Vec<[f64; 3]>,
    /// What the colours show, with its unit.
    pub label: String,
}

const COLUMNS: usize = 32;
const ROWS: usize = 24;
const WIDTH: f64 = 620.0;
const HEIGHT: f64 = 396.0;
/// The field: left, top, width, height.
const FIELD: [f64; 4] = [90.0, 28.0, 410.0, 310.0];
/// The bar of colours: left, width.
const BAR: [f64; 2] = [524.0, 16.0];
const TICKS: usize = 5;

/// A range with room about a single value.
fn proper([low, high]: [f64; 2]) -> [f64; 2] {
    if high > low { [low, high] } else { [low - 0.5, low + 0.5] }
}

/// Draws the field as an SVG element.
pub(super) fn heat_map_svg(map: &HeatMap<'_>) -> String {
    let [left, top, width, height] = FIELD;
    let between = |[low, high]: [f64; 2], share: f64| low + (high - low) * share;
    let at = |column: usize, row: usize| {
        let shares = [(column as f64 + 0.5) / COLUMNS as f64, (row as f64 + 0.5) / ROWS as f64];
        (map.value)(between(map.x, shares[0]), between(map.y, shares[1]))
    };
    let field: Vec<f64> = (0..ROWS).flat_map(|row| (0..COLUMNS).map(move |column| at(column, row))).collect();
    let all = field.iter().copied().chain(map.points.iter().map(|point| point[2]));
    let [low, high] = super::response::extent(all);
    let span = if high > low { high - low } else { 1.0 };
    let colour = |value: f64| {
        let [r, g, b] = viridis((value - low) / span);
        format!("#{r:02x}{g:02x}{b:02x}")
    };
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"map\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" font-family=\"sans-serif\" font-size=\"13\" \
         fill=\"currentColor\" role=\"img\" aria-label=\"{}\">\n",
        escape(&map.label)
    );
    let (cell_width, cell_height) = (width / COLUMNS as f64, height / ROWS as f64);
    for (k, value) in field.iter().enumerate() {
        let (column, row) = (k % COLUMNS, k / COLUMNS);
        let (x, y) = (left + cell_width * column as f64, top + height - cell_height * (row + 1) as f64);
        // a little larger than its place: no gaps show
        svg += &format!(
            "<rect x=\"{x:.2}\" y=\"{y:.2}\" width=\"{:.2}\" height=\"{:.2}\" fill=\"{}\" shape-rendering=\"crispEdges\" />\n",
            cell_width + 0.3,
            cell_height + 0.3,
            colour(*value)
        );
    }
    let share = |value: f64, [low, high]: [f64; 2]| if high > low { (value - low) / (high - low) } else { 0.5 };
    for [x, y, value] in &map.points {
        svg += &format!(
            "<circle cx=\"{:.2}\" cy=\"{:.2}\" r=\"6\" fill=\"{}\" stroke=\"white\" stroke-width=\"1.5\"><title>{}</title></circle>\n",
            left + width * share(*x, map.x),
            top + height * (1.0 - share(*y, map.y)),
            colour(*value),
            digits(*value)
        );
    }
    let text = |x: f64, y: f64, anchor: &str, text: &str| {
        format!("<text x=\"{x:.2}\" y=\"{y:.2}\" text-anchor=\"{anchor}\">{}</text>\n", escape(text))
    };
    let axis = |range: [f64; 2], pixels: [f64; 2]| Axis { range: proper(range), pixels, logarithmic: false };
    let (across, up) = (axis(map.x, [left, left + width]), axis(map.y, [top + height, top]));
    for (value, label) in across.ticks(TICKS) {
        svg += &text(across.at(value), top + height + 18.0, "middle", &label);
    }
    for (value, label) in up.ticks(TICKS) {
        svg += &text(left - 9.0, up.at(value) + 4.0, "end", &label);
    }
    let bar = axis([low, low + span], [top + height, top]);
    for (value, label) in bar.ticks(TICKS) {
        svg += &text(BAR[0] + BAR[1] + 6.0, bar.at(value) + 4.0, "start", &label);
    }
    svg += &text(WIDTH - 4.0, top - 12.0, "end", &map.label);
    const SHADES: usize = 50;
    for k in 0..SHADES {
        let step = height / SHADES as f64;
        let (y, value) = (top + height - step * (k + 1) as f64, low + span * (k as f64 + 0.5) / SHADES as f64);
        svg += &format!(
            "<rect x=\"{}\" y=\"{y:.2}\" width=\"{}\" height=\"{:.2}\" fill=\"{}\" />\n",
            BAR[0],
            BAR[1],
            step + 0.3,
            colour(value)
        );
    }
    svg += &text(left + 0.5 * width, HEIGHT - 14.0, "middle", &map.x_label);
    let (x, y) = (16.0, top + 0.5 * height);
    let label = escape(&map.y_label);
    svg += &format!("<text transform=\"translate({x},{y}) rotate(-90)\" text-anchor=\"middle\">{label}</text>\n");
    svg + "</svg>\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_map_has_its_cells_points_and_labels() {
        let (x_label, y_label) = ("a [m]".to_string(), "b < c".to_string());
        let value = |x: f64, y: f64| x + y;
        let points = vec![[0.0, 0.0, 0.5], [1.0, 1.0, 2.0]];
        let label = "c [N]".to_string();
        let svg =
            heat_map_svg(&HeatMap { x_label, y_label, x: [0.0, 1.0], y: [0.0, 1.0], value: &value, points, label });
        assert_eq!((svg.matches("<circle").count(), svg.matches("<rect").count()), (2, COLUMNS * ROWS + 50));
        assert!(
            svg.contains("a [m]")
                && svg.contains(">c [N]</text>")
                && svg.contains(">0.5</text>")
                && svg.contains("b &lt; c")
                && !svg.contains("NaN")
        );
    }
}
