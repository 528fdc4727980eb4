//! Reference data: tables in CSV with a header of `#` lines that states quantity, units and source.
//!
//! The project's own tables (`scenarios/scene/reference`) are part of the program; a scene may name a file of its own.
//!
//! # Example
//! ```
//! use scene::reference::Table;
//!
//! let name = "wedge_similarity/summary.csv";
//! assert!(!Table::load(name)?.about.is_empty());
//! # Ok::<(), scene::reference::ReferenceError>(())
//! ```

use include_dir::{Dir, include_dir};
use water_entry::SimilarityFlow;

static TABLES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/reference");

/// Largest file of a reference [bytes].
const LARGEST: u64 = 16 << 20;

/// A table of numbers with named columns.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// The header's text, a line a line, without the `#`.
    pub about: Vec<String>,
    columns: Vec<String>,
    rows: Vec<Vec<f64>>,
}

/// A reference that cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ReferenceError {
    /// Neither a built-in table nor a readable file.
    #[error("reference `{0}` is neither a built-in table nor a readable file; built-in: {1}")]
    Missing(String, String),
    /// A file that is larger than any table of a reference.
    #[error("reference `{0}` is larger than {LARGEST} bytes")]
    Large(String),
    /// Fewer than two rows.
    #[error("reference `{0}` has {1} rows of numbers: two are needed")]
    Short(String, usize),
    /// A row with more or fewer cells than there are columns.
    #[error("reference `{name}`, line {line}: {cells} cells, {columns} columns")]
    Row {
        /// The table.
        name: String,
        /// Line in the file, from 1.
        line: usize,
        /// Cells in the line.
        cells: usize,
        /// Columns of the table.
        columns: usize,
    },
    /// A cell that is not a number.
    #[error("reference `{name}`, line {line}: `{given}` is not a finite number")]
    Cell {
        /// The table.
        name: String,
        /// Line in the file, from 1.
        line: usize,
        /// What stands there.
        given: String,
    },
    /// A column that the table has twice.
    #[error("reference `{0}` has the column `{1}` twice")]
    Twice(String, String),
    /// A column that the table does not have.
    #[error("reference `{name}` has no column `{column}`; it has: {known}")]
    Column {
        /// The table.
        name: String,
        /// The column asked for.
        column: String,
        /// The columns there are.
        known: String,
    },
}

impl Table {
    /// A built-in table by its path below `scenarios/scene/reference`, else a file by its path.
    pub fn load(name: &str) -> Result<Table, ReferenceError> {
        let text = match TABLES.get_file(name).and_then(|f| f.contents_utf8()) {
            Some(text) => text.to_string(),
            None => {
                let missing = |_| ReferenceError::Missing(name.into(), builtin_names().join(", "));
                let file = std::fs::metadata(name).map_err(missing)?;
                if file.len() > LARGEST {
                    return Err(ReferenceError::Large(name.into()));
                }
                crate::bounded_text::read_text(name).map_err(missing)?
            }
        };
        Table::parse(name, &text)
    }

    /// True for a table that is part of the program.
    pub fn is_builtin(name: &str) -> bool {
        TABLES.get_file(name).is_some()
    }

    fn parse(name: &str, text: &str) -> Result<Table, ReferenceError> {
        let mut table = Table { about: Vec::new(), columns: Vec::new(), rows: Vec::new() };
        for (k, line) in text.lines().enumerate() {
            if let Some(about) = line.strip_prefix('#') {
                table.about.push(about.trim().to_string());
            } else if table.columns.is_empty() {
                table.columns = line.split(',').map(|c| c.trim().to_string()).collect();
            } else if !line.trim().is_empty() {
                let cell = |c: &str| {
                    let (name, line, given) = (name.into(), k + 1, c.trim());
                    let number = given.parse().ok().filter(|number: &f64| number.is_finite());
                    number.ok_or(ReferenceError::Cell { name, line, given: given.into() })
                };
                let row: Vec<f64> = line.split(',').map(cell).collect::<Result<_, _>>()?;
                let (cells, columns) = (row.len(), table.columns.len());
                if cells != columns {
                    return Err(ReferenceError::Row { name: name.into(), line: k + 1, cells, columns });
                }
                table.rows.push(row);
            }
        }
        match table.rows.len() {
            rows @ ..=1 => Err(ReferenceError::Short(name.into(), rows)),
            _ => Ok(table),
        }
    }

    /// A column by its name.
    pub fn column(&self, table: &str, column: &str) -> Result<Vec<f64>, ReferenceError> {
        let k = self.columns.iter().position(|c| c == column).ok_or_else(|| ReferenceError::Column {
            name: table.into(),
            column: column.into(),
            known: self.columns.join(", "),
        })?;
        if self.columns[k + 1..].iter().any(|c| c == column) {
            return Err(ReferenceError::Twice(table.into(), column.into()));
        }
        Ok(self.rows.iter().map(|row| row[k]).collect())
    }
}

/// Name and header lines of each built-in table, by name.
pub fn builtin() -> Vec<(String, Vec<String>)> {
    let mut names = builtin_names();
    names.sort();
    names.into_iter().map(|name| (name.clone(), about(&name))).collect()
}

/// Header lines of a built-in table, also of one with words in its cells; none of another name.
pub fn about(name: &str) -> Vec<String> {
    let text = TABLES.get_file(name).and_then(|f| f.contents_utf8()).unwrap_or_default();
    text.lines().filter_map(|line| line.strip_prefix('#')).map(|line| line.trim().to_string()).collect()
}

fn builtin_names() -> Vec<String> {
    TABLES.dirs().flat_map(|d| d.files()).map(|f| f.path().display().to_string()).collect()
}

/// The similarity solution's numbers that an independent program computed.
const TABLE: &str = "wedge_similarity/summary.csv";

/// The similarity solution's numbers for a wedge at constant speed.
#[derive(Clone, Debug, PartialEq)]
pub struct WedgeSimilarity {
    /// Where it is from.
    pub source: &'static str,
    /// F/(ρV³t), both sides.
    pub force_coefficient: f64,
    /// Largest Cp on the face.
    pub cp_max: f64,
    /// Its height above still water over Vt.
    pub z_max_over_vt: f64,
    /// Face pressure: x/(Vt), Cp.
    pub profile: Vec<[f64; 2]>,
}

impl WedgeSimilarity {
    /// The solution for a deadrise angle [deg]: that of an independent program where it is tabulated, else our own (THEORY
    /// EN8), for 4 to 80 degrees.
    pub fn at(deadrise_deg: f64) -> Option<WedgeSimilarity> {
        WedgeSimilarity::tabulated(deadrise_deg).or_else(|| {
            let flow = SimilarityFlow::solve(deadrise_deg)?;
            Some(WedgeSimilarity {
                source: "similarity solution (THEORY EN8)",
                force_coefficient: flow.force_coefficient,
                cp_max: flow.cp_max,
                z_max_over_vt: flow.z_max,
                profile: flow.profile,
            })
        })
    }

    fn tabulated(deadrise_deg: f64) -> Option<WedgeSimilarity> {
        let summary = Table::load(TABLE).ok()?;
        let row = summary.rows.iter().find(|r| (r[0] - deadrise_deg).abs() < 1e-9)?;
        let name = format!("wedge_similarity/cp_beta{deadrise_deg:.0}.csv");
        let table = Table::load(&name).ok()?;
        let (x, cp) = (table.column(&name, "x_over_Vt").ok()?, table.column(&name, "Cp").ok()?);
        let profile = x.into_iter().zip(cp).map(|(x, cp)| [x, cp]).collect();
        let (force_coefficient, cp_max, z_max_over_vt) = (row[3], row[1], row[2]);
        Some(WedgeSimilarity { source: TABLE, force_coefficient, cp_max, z_max_over_vt, profile })
    }
}

impl WedgeSimilarity {
    /// RMS difference of a profile (x/(Vt), Cp) from this one, from the keel to the pressure peak or to `least`
    /// [x/(Vt)], whichever is farther, over the largest Cp [-].
    pub fn profile_error(&self, profile: &[[f64; 2]], least: f64) -> f64 {
        let peak = self.profile.iter().max_by(|a, b| a[1].total_cmp(&b[1])).map_or(0.0, |p| p[0]);
        let end = peak.max(least);
        let squares: Vec<f64> =
            profile.iter().filter(|p| p[0] <= end).map(|p| (p[1] - self.cp(p[0])).powi(2)).collect();
        (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt() / self.cp_max
    }

    /// Cp at x/(Vt), linear between the table's points.
    fn cp(&self, x: f64) -> f64 {
        let table = &self.profile;
        let k = table.partition_point(|p| p[0] < x).clamp(1, table.len() - 1);
        let ([x0, c0], [x1, c1]) = (table[k - 1], table[k]);
        c0 + (c1 - c0) * ((x - x0) / (x1 - x0)).clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_builtin_table_reads_and_states_its_source() {
        assert!(builtin_names().len() > 5);
        for name in builtin_names() {
            let table = Table::load(&name);
            // tables with words in cells (cases, formulas) are for people and tests, not for curves
            if let Ok(table) = table {
                assert!(!table.about.is_empty(), "{name} has no header");
                assert!(!table.rows.is_empty(), "{name} is empty");
            }
        }
        assert_eq!(WedgeSimilarity::at(30.0).unwrap().force_coefficient, 14.0201);
        assert!(WedgeSimilarity::tabulated(33.0).is_none() && WedgeSimilarity::at(85.0).is_none());
        let between = WedgeSimilarity::at(33.0).unwrap().force_coefficient;
        assert!(between < 14.0201 && between > 8.0, "{between}");
        let exact = WedgeSimilarity::at(45.0).unwrap();
        assert!(exact.profile_error(&exact.profile, 1.25) < 1e-12);
        let tenth_off: Vec<[f64; 2]> = exact.profile.iter().map(|p| [p[0], p[1] + 0.1 * exact.cp_max]).collect();
        assert!((exact.profile_error(&tenth_off, 1.25) - 0.1).abs() < 1e-12);
    }

    #[test]
    fn a_wrong_name_or_column_says_what_there_is() {
        let missing = Table::load("no_such.csv").unwrap_err().to_string();
        assert!(missing.contains("wedge25_yettou2006_velocity_exp.csv"), "{missing}");
        let name = "external/wedge25_yettou2006_velocity_exp.csv";
        let column = Table::load(name).unwrap().column(name, "v").unwrap_err().to_string();
        assert!(column.contains("t_ms, v_m_s"), "{column}");
    }

    #[test]
    fn a_table_that_cannot_be_compared_is_refused_with_its_line() {
        let refused = |text: &str| Table::parse("own.csv", text).unwrap_err().to_string();
        for (text, part) in [
            ("", "0 rows"),
            ("t,v\n", "0 rows"),
            ("t,v\n0,1\n", "1 rows"),
            ("# about\nt,v\n0,1\n1,NaN\n", "line 4: `NaN`"),
            ("t,v\n0,1\n1\n", "line 3: 1 cells, 2 columns"),
            ("t,v\n0,1\n1,inf\n", "line 3: `inf`"),
        ] {
            assert!(refused(text).contains(part), "{text:?}: {}", refused(text));
        }
    }
}
