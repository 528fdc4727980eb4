//! Outlines as tables of points: CSV, and DAT of airfoils.

use super::drawing::Drawing;
use crate::data_file::Fault;
use crate::table_file::NumberTable;

/// Points of a table: its columns x and y, or its two columns. Of a DAT the first line is a name.
pub(super) fn parse(text: &str, is_dat: bool) -> Result<Drawing, Fault> {
    let (text, format) = if is_dat { (without_name(text), "DAT") } else { (text.to_string(), "CSV") };
    let table = NumberTable::parse(&text)?;
    let columns = table.rows.first().map_or(2, |(_, row)| row.len());
    let [x, y] = match (table.column(&["x"]), table.column(&["y"])) {
        (Some(x), Some(y)) => [x, y],
        _ if columns == 2 => [0, 1],
        _ => {
            let line = table.rows.first().map_or(1, |(line, _)| *line);
            let expected = format!("two columns, or a header that names x and y{}", table.decimal_commas());
            return Err(Fault::new(line, format!("{columns} columns"), expected));
        }
    };
    let [unit, other] = [table.factor(x, "m")?, table.factor(y, "m")?];
    let has_unit = [x, y].iter().any(|k| table.units.get(*k).is_some_and(|unit| !unit.is_empty()));
    let point = |(line, row): &(usize, Vec<f64>)| (*line, [row[x], other / unit * row[y]]);
    let mut points: Vec<_> = table.rows.iter().map(point).collect();
    if !is_dat {
        refuse_parts(&text, &points)?;
    }
    if let (true, Some((_, [upper, lower]))) = (is_dat, points.first().copied()) {
        let count = points.len() as f64 - 1.0;
        // two counts of points, then the upper and the lower side, each from the nose (Lednicer)
        if upper > 1.5 && upper.fract() == 0.0 && upper + lower == count {
            points.remove(0);
            points[..upper as usize].reverse();
        }
    }
    let unit_line = has_unit.then_some(table.header_line);
    Ok(Drawing { pieces: vec![points], unit: has_unit.then_some(unit), unit_line, format, ..Drawing::default() })
}

/// A part that is closed, or nearly, ends nearer to its first point than this, over its longest side [-].
const NEARLY_CLOSED: f64 = 1.5;

/// Two lines or more between blank lines, each nearly closed: no order of all points is meant.
fn refuse_parts(text: &str, points: &[(usize, [f64; 2])]) -> Result<(), Fault> {
    let lines: Vec<&str> = text.lines().collect();
    let is_blank = |line: usize| lines.get(line).is_some_and(|line| line.trim().is_empty());
    let parts: Vec<_> = points.chunk_by(|(a, _), (b, _)| !(*a..b - 1).any(is_blank)).collect(); // lines count from 1
    match parts[..] {
        [_, second, ..] if parts.iter().all(|part| is_nearly_closed(part)) => {
            let given = format!("{} lines of points between blank lines", parts.len());
            Err(Fault::new(
                second[0].0,
                given,
                "one line of points; a drawing (DXF, SVG) may have several, as of a hole",
            ))
        }
        _ => Ok(()),
    }
}

fn is_nearly_closed(part: &[(usize, [f64; 2])]) -> bool {
    let side = |a: [f64; 2], b: [f64; 2]| (b[0] - a[0]).hypot(b[1] - a[1]);
    let longest = part.windows(2).map(|two| side(two[0].1, two[1].1)).fold(0.0, f64::max);
    part.len() >= 3 && side(part[part.len() - 1].1, part[0].1) <= NEARLY_CLOSED * longest
}

/// The text with its first line that says something as a comment, unless it is of numbers.
fn without_name(text: &str) -> String {
    let is_name = |line: &&str| line.split_whitespace().any(|cell| cell.parse::<f64>().is_err());
    match text.lines().next().filter(is_name) {
        Some(name) => format!("#{}", &text[name.len()..]),
        None => text.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_found_by_name_and_units_by_the_header() {
        let drawing = parse("n; x [mm]; y [mm]\n1; 0; 0\n2; 1000; 0\n3; 0; 500\n", false).expect("points");
        assert_eq!((drawing.pieces[0][1], drawing.unit), ((3, [1000.0, 0.0]), Some(1e-3)));
        assert!(parse("1,2,3\n1,2,3\n", false).is_err());
    }

    #[test]
    fn two_lines_of_points_are_refused_and_single_blank_lines_are_not() {
        let fault = parse("0 0\n1 0\n0 1\n\n2 0\n3 0\n2 1\n", false).expect_err("two lines of points");
        assert_eq!(fault.line, 5);
        let round = |blank: usize| {
            let point = |k: usize| (k as f64 * std::f64::consts::TAU / 16.0).sin_cos();
            let line = |k: usize| format!("{} {}{}", point(k).0, point(k).1, if k == blank { "\n\n" } else { "\n" });
            parse(&(0..16).map(line).collect::<String>(), false)
        };
        assert!((3..13).all(|blank| round(blank).is_ok_and(|drawing| drawing.pieces[0].len() == 16)));
        assert_eq!(parse("x,y\n\n0,0\n\n1,0\n\n0,1\n\n", false).expect("points").pieces[0].len(), 3);
    }

    #[test]
    fn both_orders_of_airfoils_give_one_line() {
        let selig = parse("NACA 0012 section\n1 0\n0.5 0.1\n0 0\n0.5 -0.1\n1 0\n", true).expect("points");
        assert_eq!(selig.pieces[0].len(), 5);
        let lednicer = parse("Wing 3\n3. 3.\n\n0 0\n0.5 0.1\n1 0\n\n0 0\n0.5 -0.1\n1 0\n", true).expect("points");
        let points: Vec<_> = lednicer.pieces[0].iter().map(|(_, p)| *p).collect();
        assert_eq!(points, [[1.0, 0.0], [0.5, 0.1], [0.0, 0.0], [0.0, 0.0], [0.5, -0.1], [1.0, 0.0]]);
    }
}
