//! Frames as tables of all times: `fluid.parquet` and `walls.parquet`, a row group per frame, and `bodies.parquet`.

use std::io;
use std::path::{Path, PathBuf};

use run::log::{LoggedFrame, Point};

use super::bodies::BodyRows;
use super::frame_writer::FrameWriter;
use crate::data_table::{Cells, DataTable, ParquetFile};

pub(super) struct ParquetWriter {
    fluid: ParquetFile,
    walls: ParquetFile,
    bodies: BodyRows,
    bodies_file: PathBuf,
}

impl ParquetWriter {
    pub fn new(folder: &Path) -> io::Result<ParquetWriter> {
        let file = |name: &str| ParquetFile::create(&folder.join(name));
        let (fluid, walls) = (file("fluid.parquet")?, file("walls.parquet")?);
        let bodies_file = folder.join("bodies.parquet");
        Ok(ParquetWriter { fluid, walls, bodies: BodyRows::default(), bodies_file })
    }
}

/// The columns of `csv/fluid_0000.csv`, after the frame and its time.
fn table(number: usize, time: f64, points: impl Iterator<Item = Point>) -> DataTable {
    let points: Vec<Point> = points.collect();
    let mut table = DataTable::default();
    table.wholes("frame", points.iter().map(|_| Some(number)));
    table.numbers("time_s", points.iter().map(|_| Some(time)));
    table.wholes("id", points.iter().map(|point| Some(point.id as usize)));
    // logged in single precision
    let mut column = |name: &str, of: fn(&Point) -> f64| {
        table.push(name, Cells::Single(points.iter().map(|point| of(point) as f32).collect()));
    };
    column("x_m", |point| point.at[0]);
    column("y_m", |point| point.at[1]);
    column("vx_m_per_s", |point| point.velocity[0]);
    column("vy_m_per_s", |point| point.velocity[1]);
    column("pressure_Pa", |point| point.pressure);
    column("density_kg_per_m3", |point| point.density);
    column("spacing_m", |point| point.spacing);
    table
}

impl FrameWriter for ParquetWriter {
    fn frame(&mut self, number: usize, frame: &LoggedFrame) -> io::Result<()> {
        self.bodies.take(number, frame);
        self.fluid.append(&table(number, frame.time, frame.fluid()))?;
        self.walls.append(&table(number, frame.time, frame.walls()))
    }

    fn finish(self: Box<Self>) -> io::Result<()> {
        self.fluid.finish()?;
        self.walls.finish()?;
        self.bodies.table().write_parquet(&self.bodies_file)
    }
}
