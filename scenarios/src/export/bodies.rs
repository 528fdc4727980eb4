//! The bodies of all frames as a table: `bodies.csv`, `bodies.parquet`.

use run::log::LoggedFrame;

use crate::data_table::DataTable;

/// Rows of frame, time [s], name, position [m] and angle [deg].
#[derive(Default)]
pub(super) struct BodyRows {
    rows: Vec<(usize, f64, String, [f64; 2], f64)>,
}

impl BodyRows {
    /// Add the bodies of a frame.
    pub fn take(&mut self, number: usize, frame: &LoggedFrame) {
        let row = |body: &run::log::LoggedBody| {
            (number, frame.time, body.name.clone(), body.position, body.angle.to_degrees())
        };
        self.rows.extend(frame.bodies.iter().map(row));
    }

    /// The table. Position and angle are those of `series.csv`.
    pub fn table(&self) -> DataTable {
        let mut table = DataTable::default();
        table.wholes("frame", self.rows.iter().map(|row| Some(row.0)));
        table.numbers("time_s", self.rows.iter().map(|row| Some(row.1)));
        table.texts("body", self.rows.iter().map(|row| Some(row.2.clone())));
        table.numbers("x_m", self.rows.iter().map(|row| Some(row.3[0])));
        table.numbers("y_m", self.rows.iter().map(|row| Some(row.3[1])));
        table.numbers("angle_deg", self.rows.iter().map(|row| Some(row.4)));
        table
    }
}
