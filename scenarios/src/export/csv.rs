//! Frames as tables: `fluid_0000.csv`, `walls_0000.csv`, `frames.csv` with their times, and `bodies.csv`.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use run::log::{LoggedFrame, Point};

use super::bodies::BodyRows;
use super::frame_writer::FrameWriter;

/// Columns of a table of particles.
const COLUMNS: &str = "id,x_m,y_m,vx_m_per_s,vy_m_per_s,pressure_Pa,density_kg_per_m3,spacing_m";

pub(super) struct CsvWriter {
    folder: PathBuf,
    times: Vec<f64>,
    bodies: BodyRows,
}

impl CsvWriter {
    pub fn new(folder: &Path) -> CsvWriter {
        CsvWriter { folder: folder.to_owned(), times: Vec::new(), bodies: BodyRows::default() }
    }

    fn table(&self, name: &str, points: impl Iterator<Item = Point>) -> io::Result<()> {
        let mut file = BufWriter::new(File::create(self.folder.join(name))?);
        writeln!(file, "{COLUMNS}")?;
        for Point { at: [x, y], velocity: [u, v], pressure, density, spacing, id } in points {
            // the digits of single precision
            writeln!(file, "{id},{x:.8e},{y:.8e},{u:.8e},{v:.8e},{pressure:.8e},{density:.8e},{spacing:.8e}")?;
        }
        file.flush()
    }
}

impl FrameWriter for CsvWriter {
    fn frame(&mut self, number: usize, frame: &LoggedFrame) -> io::Result<()> {
        self.times.push(frame.time);
        self.bodies.take(number, frame);
        self.table(&format!("fluid_{number:04}.csv"), frame.fluid())?;
        self.table(&format!("walls_{number:04}.csv"), frame.walls())
    }

    fn finish(self: Box<Self>) -> io::Result<()> {
        let rows = self.times.iter().enumerate().map(|(number, time)| format!("{number},{time:.9e}\n"));
        let frames = format!("frame,time_s\n{}", rows.collect::<String>());
        std::fs::write(self.folder.join("frames.csv"), frames)?;
        std::fs::write(self.folder.join("bodies.csv"), self.bodies.table().to_csv())
    }
}
