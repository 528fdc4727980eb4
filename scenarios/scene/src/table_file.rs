//! Tables of numbers as people write them: commas, semicolons or spaces, with or without a header.

use settings::convert;

use super::data_file::{Fault, shortened};

/// Most rows of a table.
pub const MOST_ROWS: usize = 10_000;

/// Rows of numbers, each with its line in the file.
#[derive(Debug, Default, PartialEq)]
pub(super) struct NumberTable {
    /// Names in the header, without units, in lower case; empty without a header.
    pub names: Vec<String>,
    /// Units in the header; empty text where there is none.
    pub units: Vec<String>,
    pub rows: Vec<(usize, Vec<f64>)>,
    /// Line of the header.
    pub header_line: usize,
    /// True where each row could be numbers with decimal commas between commas.
    pub halves: bool,
}

/// Why a table is refused that has decimal commas where they cannot be distinguished from commas between cells.
const DECIMAL_COMMAS: &str = "; decimal commas? write a decimal point, or semicolons between the cells";

/// A line whose cells, separated by its commas, are twice as many whole numbers as it may have numbers: `1,5,2,25`.
fn may_be_halves(line: &str) -> bool {
    let digits = |cell: &str| !cell.is_empty() && cell.chars().all(|c| c.is_ascii_digit());
    let cells: Vec<&str> = line.split(',').map(str::trim).collect();
    let whole = |cell: &&str| digits(cell.trim_start_matches(['-', '+']));
    !line.contains(';') && cells.len() > 2 && cells.iter().all(whole)
}

/// Numbers with decimal commas between spaces: `1,5 2,25`.
fn has_spaced_decimal_commas(line: &str) -> bool {
    let words = line.split_whitespace().map(|word| word.replacen(',', ".", 1));
    line.contains(',')
        && !line.contains([';', '.'])
        && words.clone().count() > 1
        && words.clone().all(|word| number(&word).is_some())
}

/// Cells of a line. Beside semicolons a comma is a decimal mark.
fn cells(line: &str) -> Vec<String> {
    let trimmed = |cell: &str| cell.trim().trim_matches('"').trim().to_string();
    match line {
        _ if line.contains(';') => line.split(';').map(|cell| trimmed(cell).replace(',', ".")).collect(),
        _ if line.contains(',') => line.split(',').map(trimmed).collect(),
        _ => line.split_whitespace().map(trimmed).collect(),
    }
}

/// A line without what stands behind a comment mark; none for a line that says nothing.
fn content(line: &str) -> Option<&str> {
    let line = line.trim_start_matches('\u{feff}');
    let bare = line.split('#').next().unwrap_or_default().trim();
    let comment = ["%", "!", "//", "\""].iter().any(|mark| bare.starts_with(mark)) && number(&cells(bare)[0]).is_none();
    (!bare.is_empty() && !comment).then_some(bare)
}

fn number(cell: &str) -> Option<f64> {
    cell.parse().ok().filter(|value: &f64| value.is_finite() && value.abs() <= super::source::LARGEST_NUMBER)
}

/// A header's cell as name and unit: `y [mm]`, `y (mm)`, `y_mm`, `body.vy_m_per_s`.
fn header_cell(cell: &str) -> (String, String) {
    let bare = cell.rsplit('.').next().unwrap_or(cell).trim();
    let bracketed = bare.split_once(['[', '(']).map(|(name, unit)| (name, unit.trim_end_matches([']', ')'])));
    let (name, unit) = match bracketed.or(bare.split_once('_')) {
        Some((name, unit)) => (name.trim(), unit.trim().replace("_per_", "/").replace('_', " ")),
        None => (bare, String::new()),
    };
    (name.to_lowercase(), unit)
}

impl NumberTable {
    /// The table of a text; its first line may be a header.
    pub fn parse(text: &str) -> Result<NumberTable, Fault> {
        let mut table = NumberTable::default();
        let mut columns = 0;
        for (k, line) in text.lines().enumerate() {
            let Some(line) = content(line) else { continue };
            let given = cells(line);
            let numbers: Vec<Option<f64>> = given.iter().map(|cell| number(cell)).collect();
            let first = table.rows.is_empty() && table.header_line == 0;
            if first && numbers.iter().all(Option::is_none) {
                (table.names, table.units) = given.iter().map(|cell| header_cell(cell)).unzip();
                table.header_line = k + 1;
                continue;
            }
            if let Some(wrong) = numbers.iter().position(Option::is_none) {
                let cell = format!("`{}`", shortened(&given[wrong]));
                let hint = if has_spaced_decimal_commas(line) { DECIMAL_COMMAS } else { "" };
                return Err(Fault::new(k + 1, cell, format!("a finite number{hint}")));
            }
            if columns == 0 {
                columns = given.len();
            }
            if given.len() != columns {
                let hint = if may_be_halves(line) { DECIMAL_COMMAS } else { "" };
                let expected = format!("{columns} cells, as above{hint}");
                return Err(Fault::new(k + 1, format!("{} cells", given.len()), expected));
            }
            table.halves = may_be_halves(line) && (table.halves || table.rows.is_empty());
            table.rows.push((k + 1, numbers.into_iter().flatten().collect()));
            if table.rows.len() > MOST_ROWS {
                return Err(Fault::new(k + 1, "another row", format!("at most {MOST_ROWS} rows")));
            }
        }
        Ok(table)
    }

    /// A hint where the table may have decimal commas, else nothing.
    pub fn decimal_commas(&self) -> &'static str {
        if self.halves { DECIMAL_COMMAS } else { "" }
    }

    /// Index of the column with one of these names, if the header has as many cells as the rows.
    pub fn column(&self, names: &[&str]) -> Option<usize> {
        let columns = self.rows.first().map_or(0, |(_, row)| row.len());
        let found = self.names.iter().position(|name| names.contains(&name.as_str()));
        found.filter(|_| self.names.len() == columns)
    }

    /// Factor from the unit of a column to `wanted`; 1 where the header has none.
    pub fn factor(&self, column: usize, wanted: &str) -> Result<f64, Fault> {
        let unit = self.units.get(column).map_or("", String::as_str);
        if unit.is_empty() {
            return Ok(1.0);
        }
        let expected = |why: String| {
            Fault::new(
                self.header_line,
                format!("the unit `{}`", shortened(unit)),
                format!("a unit like {wanted}: {why}"),
            )
        };
        convert(&format!("1 {unit}"), wanted).map_err(expected)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn separators_and_headers_are_understood() {
        for text in ["x,y\n1,2\n3,4\n", "1;2\n3;4", "# points\n 1 2\n\n 3\t4 # last\n", "x [m]; y [m]\n1,0;2,0\n3;4"] {
            let table = NumberTable::parse(text).expect(text);
            let rows: Vec<_> = table.rows.iter().map(|(_, row)| row.clone()).collect();
            assert_eq!(rows, [[1.0, 2.0], [3.0, 4.0]], "{text}");
        }
        let table = NumberTable::parse("t_ms,body.vy_m_per_s\n1,2\n").expect("a table");
        assert_eq!((table.column(&["vy"]), table.units[1].as_str()), (Some(1), "m/s"));
        assert_eq!(table.factor(0, "s"), Ok(1e-3));
    }

    #[test]
    fn a_wrong_line_is_reported_with_its_number() {
        for text in ["0,0\n1,5,2,25\n", "0,5,0,25\n1,5\n", "1,5 2,25\n3,5 4\n"] {
            let fault = NumberTable::parse(text).expect_err(text);
            assert!(fault.expected.contains("write a decimal point") || text.starts_with("0,5"), "{text}: {fault:?}");
        }
        assert!(NumberTable::parse("0,5,0,25\n1,5,2,25\n").is_ok_and(|table| !table.decimal_commas().is_empty()));
        assert!(NumberTable::parse("0.5,0,25\n1,5,2\n").is_ok_and(|table| table.decimal_commas().is_empty()));
        for (text, line, given) in
            [("x,y\n1,2\n1,b\n", 3, "`b`"), ("1,2\n1,2,3\n", 2, "3 cells"), ("1,nan\n", 1, "`nan`")]
        {
            let fault = NumberTable::parse(text).expect_err(text);
            assert_eq!((fault.line, fault.given.as_str()), (line, given), "{text}");
        }
        assert!(NumberTable::parse(&"1,2\n".repeat(MOST_ROWS + 1)).is_err());
    }
}
