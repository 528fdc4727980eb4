//! The curves of `series.csv`.

use std::path::Path;

/// Named columns of the same length.
#[derive(Clone, Debug, Default)]
pub(crate) struct Curves {
    /// Names; the first is `time_s`.
    pub columns: Vec<String>,
    values: Vec<Vec<f64>>,
}

impl Curves {
    /// The rows of a file that are whole; no columns where it cannot be read.
    pub fn read(path: &Path) -> Curves {
        let text = std::fs::read_to_string(path).unwrap_or_default();
        let mut lines = text.lines();
        let columns: Vec<String> = lines.next().unwrap_or_default().split(',').map(String::from).collect();
        let mut values = vec![Vec::new(); columns.len()];
        for line in lines {
            let row: Vec<f64> = line.split(',').filter_map(|cell| cell.parse().ok()).collect();
            if row.len() == columns.len() {
                values.iter_mut().zip(row).for_each(|(column, value)| column.push(value));
            }
        }
        Curves { columns, values }
    }

    /// A column by its name.
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        let k = self.columns.iter().position(|column| column == name)?;
        Some(&self.values[k])
    }

    /// Sample times [s].
    pub fn times(&self) -> &[f64] {
        self.column("time_s").unwrap_or_default()
    }

    /// Points of a column: times and values, each times its scale.
    pub fn points(&self, name: &str, scales: [f64; 2]) -> Vec<[f64; 2]> {
        let values = self.column(name).unwrap_or_default();
        self.times().iter().zip(values).map(|(t, v)| [scales[0] * t, scales[1] * v]).collect()
    }
}
