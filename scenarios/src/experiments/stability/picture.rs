//! A map as SVG.

use report::escape;

use super::{Measured, Point, Verdict};

const LEFT: f64 = 170.0;
const TOP: f64 = 14.0;
const CELL: [f64; 2] = [46.0, 30.0];
/// Below the cells: ticks, label, legend.
const BELOW: f64 = 78.0;
const RIGHT: f64 = 20.0;
/// Room for the legend.
const LEAST_WIDTH: f64 = 740.0;

/// A cell for each point, coloured and marked by its verdict, its command in its tooltip; the theory's boundary over them.
///
/// Cells are as wide as each other whatever lies between their values; the boundary is interpolated between their middles.
/// Text takes the colour of the text around; same input, same bytes.
pub fn svg(measured: &Measured) -> String {
    let map = &measured.map;
    let (columns, rows) = (map.x.len(), map.y.len());
    let width = (LEFT + CELL[0] * columns as f64 + RIGHT).max(LEAST_WIDTH);
    let height = TOP + CELL[1] * rows as f64 + BELOW;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" \
         font-size=\"12\" fill=\"currentColor\">\n"
    );
    for j in 0..rows {
        for (i, point) in measured.row(j).iter().enumerate() {
            svg += &cell(measured, i, j, point);
        }
    }
    for (j, name) in map.y.names().iter().enumerate() {
        let y = middle_of_row(rows, j) + 4.0;
        svg += &format!("<text x=\"{}\" y=\"{y}\" text-anchor=\"end\">{}</text>\n", LEFT - 8.0, escape(name));
    }
    let floor = TOP + CELL[1] * rows as f64;
    for (i, name) in map.x.names().iter().enumerate() {
        let x = middle_of_column(i);
        svg += &format!("<text x=\"{x}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", floor + 16.0, escape(name));
    }
    let centre = LEFT + 0.5 * CELL[0] * columns as f64;
    let (x_label, y_label) = (escape(&map.x.label), escape(&map.y.label));
    svg += &format!("<text x=\"{centre}\" y=\"{}\" text-anchor=\"middle\">{x_label}</text>\n", floor + 36.0);
    let upright = TOP + 0.5 * CELL[1] * rows as f64;
    svg += &format!(
        "<text x=\"14\" y=\"{upright}\" text-anchor=\"middle\" transform=\"rotate(-90 14 {upright})\">{y_label}</text>\n"
    );
    svg += &boundary(measured);
    svg += &legend(measured, floor + 62.0);
    svg + "</svg>\n"
}

fn middle_of_column(i: usize) -> f64 {
    LEFT + CELL[0] * (i as f64 + 0.5)
}

/// The first row is at the bottom.
fn middle_of_row(rows: usize, j: usize) -> f64 {
    TOP + CELL[1] * ((rows - 1 - j) as f64 + 0.5)
}

/// Colours of M. Okabe and K. Ito (2008), and a mark for each verdict.
fn look(verdict: Verdict) -> (&'static str, &'static str) {
    match verdict {
        Verdict::Stable => ("#56b4e9", ""),
        Verdict::Inaccurate => ("#f0e442", "~"),
        Verdict::Failed => ("#d55e00", "×"),
    }
}

fn cell(measured: &Measured, i: usize, j: usize, point: &Point) -> String {
    let (x, y) = (middle_of_column(i), middle_of_row(measured.map.y.len(), j));
    let (fill, mark) = look(point.verdict);
    let Point { verdict, why, .. } = point;
    let tooltip = format!("{}: {why}\n{}", verdict.name(), measured.map.command(&point.x, &point.y));
    format!(
        "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{fill}\"><title>{}</title></rect>\n\
         <text x=\"{x}\" y=\"{}\" text-anchor=\"middle\" fill=\"#000000\" pointer-events=\"none\">{mark}</text>\n",
        x - 0.5 * CELL[0] + 0.5,
        y - 0.5 * CELL[1] + 0.5,
        CELL[0] - 1.0,
        CELL[1] - 1.0,
        escape(&tooltip),
        y + 4.0
    )
}

/// Where theory's ratio passes 1 in a row, in columns from the first one's middle: straight in the ratio's logarithm.
fn crossings(row: &[Point]) -> Vec<f64> {
    let ratio = |point: &Point| point.theory.filter(|ratio| *ratio > 0.0).map(f64::ln);
    let between = |(i, pair): (usize, &[Point])| {
        let (a, b) = (ratio(&pair[0])?, ratio(&pair[1])?);
        ((a < 0.0) != (b < 0.0)).then(|| i as f64 + a / (a - b))
    };
    row.windows(2).enumerate().filter_map(between).collect()
}

/// A thick upright stroke in each row where theory puts the boundary.
fn boundary(measured: &Measured) -> String {
    let rows = measured.map.y.len();
    let stroke = |j: usize, column: f64| {
        let (x, y) = (LEFT + CELL[0] * (column + 0.5), middle_of_row(rows, j));
        let [from, to] = [y - 0.5 * CELL[1], y + 0.5 * CELL[1]];
        format!("<path d=\"M{x:.2} {from}V{to}\" stroke=\"#000000\" stroke-width=\"4\" />\n")
    };
    (0..rows).flat_map(|j| crossings(measured.row(j)).into_iter().map(move |column| stroke(j, column))).collect()
}

fn legend(measured: &Measured, y: f64) -> String {
    let mut x = 20.0;
    let mut svg = String::new();
    for verdict in [Verdict::Stable, Verdict::Inaccurate, Verdict::Failed] {
        let (fill, mark) = look(verdict);
        svg += &format!(
            "<rect x=\"{x}\" y=\"{}\" width=\"16\" height=\"14\" fill=\"{fill}\" />\
             <text x=\"{}\" y=\"{y}\" text-anchor=\"middle\" fill=\"#000000\">{mark}</text>\
             <text x=\"{}\" y=\"{y}\">{}</text>\n",
            y - 11.0,
            x + 8.0,
            x + 22.0,
            verdict.name()
        );
        x += 100.0;
    }
    if let Some(theory) = measured.map.theory {
        let (from, to) = (y - 11.0, y + 3.0);
        svg += &format!("<path d=\"M{x} {from}V{to}\" stroke=\"#000000\" stroke-width=\"4\" />");
        svg += &format!("<text x=\"{}\" y=\"{y}\">{}</text>\n", x + 10.0, escape(theory.name()));
    }
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_boundary_is_where_the_ratio_is_one() {
        let point = |theory: Option<f64>| Point {
            x: String::new(),
            y: String::new(),
            verdict: Verdict::Stable,
            why: String::new(),
            theory,
            steps: 0,
        };
        let row = |ratios: &[f64]| crossings(&ratios.iter().map(|&r| point(Some(r))).collect::<Vec<_>>());
        assert_eq!(row(&[0.25, 0.5, 2.0, 4.0]), [1.5]);
        assert_eq!(row(&[2.0, 0.5, 0.5, 2.0]), [0.5, 2.5]);
        assert_eq!(row(&[0.0, 0.0, 0.0]), [0.0; 0]);
        assert_eq!(crossings(&[point(None), point(Some(2.0))]), [0.0; 0]);
    }
}
