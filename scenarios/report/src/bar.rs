//! A whole and its parts, as one stacked bar.

use super::colour::{Rgb, hex, viridis};
use super::markup::escape;

/// A part of a whole.
#[derive(Clone, Debug)]
pub struct Part {
    /// What it is.
    pub label: String,
    /// How large, in the bar's unit; parts that are not finite or not above zero are not drawn.
    pub size: f64,
}

/// A whole and its parts, in order.
#[derive(Clone, Debug, Default)]
pub struct Bar {
    /// Title; empty for none.
    pub title: String,
    /// Unit of the parts.
    pub unit: String,
    /// The parts, from the left.
    pub parts: Vec<Part>,
}

const WIDTH: f64 = 1000.0;
const HEIGHT: f64 = 46.0;
const LINE: f64 = 22.0;
const COLUMNS: usize = 4;
/// Width that a letter takes at the font's size below, on average.
const LETTER: f64 = 7.6;

/// Draws `bar` as a stand-alone SVG document: a name on each part with room for it, all parts listed below with size and share.
pub(super) fn bar_svg(bar: &Bar) -> String {
    let parts: Vec<&Part> = bar.parts.iter().filter(|part| part.size.is_finite() && part.size > 0.0).collect();
    let total: f64 = parts.iter().map(|part| part.size).sum();
    let height = HEIGHT + LINE * (parts.len().div_ceil(COLUMNS) as f64 + 0.5);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" font-family=\"sans-serif\" \
         font-size=\"14\" fill=\"currentColor\">\n"
    );
    let mut left = 0.0;
    for (k, part) in parts.iter().enumerate() {
        let (share, width) = (part.size / total, WIDTH * part.size / total);
        let colour = viridis((k as f64 + 0.5) / parts.len() as f64);
        let (label, fill) = (escape(&part.label), hex(colour));
        let said = format!("{label} {:.3} {}, {:.1} %", part.size, escape(&bar.unit), 100.0 * share);
        svg += &format!(
            "<rect x=\"{left:.2}\" y=\"0\" width=\"{width:.2}\" height=\"{HEIGHT}\" fill=\"{fill}\"><title>{said}</title></rect>\n"
        );
        if width > LETTER * (part.label.chars().count() as f64 + 2.0) {
            let (x, y, ink) = (left + 0.5 * width, 0.5 * HEIGHT + 5.0, hex(ink_on(colour)));
            svg += &format!("<text x=\"{x:.2}\" y=\"{y}\" text-anchor=\"middle\" fill=\"{ink}\">{label}</text>\n");
        }
        let (x, y) = (WIDTH / COLUMNS as f64 * (k % COLUMNS) as f64, HEIGHT + LINE * ((k / COLUMNS) as f64 + 1.0));
        let (square, text) = (y - 11.0, x + 18.0);
        svg += &format!("<rect x=\"{x:.2}\" y=\"{square:.2}\" width=\"12\" height=\"12\" fill=\"{fill}\" />\n");
        svg += &format!("<text x=\"{text:.2}\" y=\"{y:.2}\">{said}</text>\n");
        left += width;
    }
    svg + "</svg>\n"
}

/// White or black, whichever reads better on a colour (relative luminance, WCAG 2.1, without its gamma).
fn ink_on([r, g, b]: Rgb) -> Rgb {
    let light = 0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b);
    if light > 127.0 { [0; 3] } else { [255; 3] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_fill_the_bar_in_proportion_and_wide_ones_carry_their_name() {
        let part = |label: &str, size: f64| Part { label: label.into(), size };
        let parts = vec![part("density", 3.0), part("none", 0.0), part("log", 0.01), part("momentum", 6.99)];
        let svg = bar_svg(&Bar { title: String::new(), unit: "s".into(), parts });
        for [left, width] in [["0.00", "300.00"], ["300.00", "1.00"], ["301.00", "699.00"]] {
            assert!(svg.contains(&format!("<rect x=\"{left}\" y=\"0\" width=\"{width}\"")), "{left}, {width}: {svg}");
        }
        assert!(svg.contains(">density</text>") && svg.contains(">momentum</text>") && !svg.contains(">log</text>"));
        assert!(svg.contains(">log 0.010 s, 0.1 %</text>") && !svg.contains("none"));
    }
}
