//! Measured curves from a CSV file.

use std::path::Path;

/// Why a file has no curves.
#[derive(Debug, thiserror::Error)]
pub enum DataError {
    /// It cannot be read.
    #[error("cannot read {0}: {1}")]
    Read(String, std::io::Error),
    /// A line of it.
    #[error("{file}:{line}: {given}: expected {expected}")]
    Line {
        /// The file.
        file: String,
        /// Its line, from 1.
        line: usize,
        /// What stands there.
        given: String,
        /// What should.
        expected: String,
    },
}

/// A measured curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Name of the column of `series.csv` that it is compared with.
    pub column: String,
    /// Time [s] and value, in the unit of the column, shape (n, 2).
    pub points: Vec<[f64; 2]>,
}

impl Curve {
    /// Largest less smallest value, never 0.
    pub fn range(&self) -> f64 {
        let values = || self.points.iter().map(|p| p[1]);
        let range = values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min);
        if range > 0.0 { range } else { values().next().map_or(1.0, |v| v.abs().max(f64::MIN_POSITIVE)) }
    }
}

/// The curves of a file: `time_s` and columns named as in `series.csv`; empty cells have no value, lines with # are remarks. Rows in any order.
///
/// # Errors
/// A file that cannot be read, without `time_s` or curves, or with a cell that is no number.
pub fn read(path: &Path) -> Result<Vec<Curve>, DataError> {
    let text = std::fs::read_to_string(path).map_err(|error| DataError::Read(path.display().to_string(), error))?;
    parse(&path.display().to_string(), text.trim_start_matches('\u{feff}'))
}

fn parse(file: &str, text: &str) -> Result<Vec<Curve>, DataError> {
    let wrong = |line: usize, given: String, expected: &str| DataError::Line {
        file: file.into(),
        line,
        given,
        expected: expected.into(),
    };
    let mut lines = (1..).zip(text.lines()).filter(|(_, line)| !line.trim().is_empty() && !line.starts_with('#'));
    let (line, head) =
        lines.next().ok_or_else(|| wrong(1, "no line".into(), "a head such as time_s,wedge.vy_m_per_s"))?;
    let names: Vec<&str> = head.split(',').map(|name| name.trim().trim_matches('"')).collect();
    let Some(time) = names.iter().position(|name| *name == "time_s") else {
        return Err(wrong(line, head.into(), "a column time_s, in seconds"));
    };
    if let Some(twice) = (1..names.len()).find(|k| names[..*k].contains(&names[*k])) {
        return Err(wrong(line, format!("`{}` twice", names[twice]), "each column once"));
    }
    let mut curves: Vec<Curve> =
        names.iter().map(|name| Curve { column: (*name).into(), points: Vec::new() }).collect();
    for (line, row) in lines {
        let cells: Vec<&str> = row.split(',').map(str::trim).collect();
        if cells.len() != names.len() {
            return Err(wrong(line, format!("{} cells", cells.len()), &format!("{}, as in the head", names.len())));
        }
        let number = |k: usize| match cells[k] {
            "" => Ok(None),
            cell => match cell.parse::<f64>() {
                Ok(value) if value.is_finite() => Ok(Some(value)),
                _ => Err(wrong(line, format!("{} = {cell:?}", names[k]), "a number, or nothing")),
            },
        };
        let Some(at) = number(time)? else { return Err(wrong(line, row.into(), "a time")) };
        for k in (0..names.len()).filter(|k| *k != time) {
            curves[k].points.extend(number(k)?.map(|value| [at, value]));
        }
    }
    curves.retain(|curve| !curve.points.is_empty());
    curves.iter_mut().for_each(|curve| curve.points.sort_by(|a, b| a[0].total_cmp(&b[0])));
    if curves.is_empty() {
        return Err(wrong(line, head.into(), "a curve besides time_s, with values"));
    }
    Ok(curves)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_of_a_file() {
        let curves = parse("t.csv", "# test 3\ntime_s, a.vy_m_per_s,b\n1e-3,-3.5,2\n0,-4,\n").expect("curves");
        assert_eq!(curves[0], Curve { column: "a.vy_m_per_s".into(), points: vec![[0.0, -4.0], [1e-3, -3.5]] });
        assert_eq!((curves[1].points.as_slice(), curves[0].range(), curves[1].range()), (&[[1e-3, 2.0]][..], 0.5, 2.0));
        for (text, said) in [
            ("t,a\n0,1", "t.csv:1: t,a: expected a column time_s"),
            ("time_s,a\n0,1,2", "t.csv:2: 3 cells: expected 2"),
            ("time_s,a,a\n0,1,2", "t.csv:1: `a` twice: expected each column once"),
            ("time_s,a\n0,x", "t.csv:2: a = \"x\": expected a number"),
            ("time_s,a\n0,nan", "expected a number"),
            ("time_s,a\n,1", "expected a time"),
            ("time_s,a\n0,", "expected a curve"),
            ("", "t.csv:1: no line"),
        ] {
            let error = parse("t.csv", text).expect_err(text).to_string();
            assert!(error.contains(said), "{text:?}: {error}");
        }
    }
}
