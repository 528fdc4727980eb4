//! The frames of a run's log in formats of other programs: VTK for ParaView, CSV and Parquet for tables; and its panels with their loads,
//! as tables and as Nastran bulk data.
//!
//! A frame has the particles of the fluid and of the walls, with pressure, velocity, density, spacing and identity, and the outlines of
//! the bodies. Times are those of `series.csv`: the log counts from the start of the run, which may be before 0.
//!
//! A new format is a file of this folder that implements `FrameWriter`.

mod bodies;
mod csv;
mod frame_writer;
mod loads;
mod modes;
mod nastran;
mod panels;
mod parquet;
mod structure;
mod vtk;

use std::io;
use std::path::{Path, PathBuf};

use frame_writer::FrameWriter;
pub use modes::{ExportedModes, export_modes};
pub use panels::{ExportedPanels, PanelFormat, export_panels};
use run::log::LogReader;
use scene::read_text;

/// A format of frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameFormat {
    /// PolyData files (`.vtp`) and a collection with the times (`.pvd`), for ParaView.
    Vtk,
    /// A table per frame.
    Csv,
    /// A table of all frames (Apache Parquet).
    Parquet,
}

/// What was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Exported {
    /// The folder of the files.
    pub folder: PathBuf,
    /// Frames written.
    pub frames: usize,
    /// Frames of the log that are damaged.
    pub damaged: usize,
}

/// Why frames cannot be exported.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// The folder holds no log with frames.
    #[error("{0}: expected the folder of a run, with frames in its log.mcap")]
    NoFrames(String),
    /// The resolved scene beside the log, which has the start of time, is missing or damaged.
    #[error("{0}: expected the scene of the run, which has the time at which its log starts: {1}")]
    NoScene(String, String),
    /// The run has no panels, or its log no loads on them.
    #[error("{0}: expected the folder of a run with loads on panels: {1}")]
    NoLoads(String, String),
    /// A file cannot be written.
    #[error("cannot write {0}: {1}")]
    Write(String, #[source] io::Error),
}

/// A run without what is to be exported of its panels.
fn loads_missing(dir: &Path, why: &str) -> ExportError {
    ExportError::NoLoads(dir.display().to_string(), why.to_string())
}

/// Writes the frames of the run in `dir` to the folder `dir/vtk`, `dir/csv` or `dir/parquet`, whose files of the same names are replaced.
///
/// # Errors
/// [`ExportError::NoFrames`], [`ExportError::NoScene`], [`ExportError::Write`].
pub fn export_frames(dir: &Path, format: FrameFormat) -> Result<Exported, ExportError> {
    let no_frames = || ExportError::NoFrames(dir.display().to_string());
    let mut log = LogReader::open(&dir.join("log.mcap")).ok_or_else(no_frames)?;
    let count = log.times().len();
    if count == 0 {
        return Err(no_frames());
    }
    let start = start_of_run(dir)?;
    let folder = dir.join(match format {
        FrameFormat::Vtk => "vtk",
        FrameFormat::Csv => "csv",
        FrameFormat::Parquet => "parquet",
    });
    let wrong = |error| ExportError::Write(folder.display().to_string(), error);
    std::fs::create_dir_all(&folder).map_err(wrong)?;
    let mut writer: Box<dyn FrameWriter> = match format {
        FrameFormat::Vtk => Box::new(vtk::VtkWriter::new(&folder)),
        FrameFormat::Csv => Box::new(csv::CsvWriter::new(&folder)),
        FrameFormat::Parquet => Box::new(parquet::ParquetWriter::new(&folder).map_err(wrong)?),
    };
    let mut frames = 0;
    for index in 0..count {
        let Some(mut frame) = log.frame(index) else { continue };
        frame.time = time_of_run(frame.time, start);
        writer.frame(frames, &frame).map_err(wrong)?;
        frames += 1;
    }
    writer.finish().map_err(wrong)?;
    Ok(Exported { folder, frames, damaged: count - frames })
}

/// The time at which the run starts [s]: `time.start` of its resolved scene.
pub fn start_of_run(dir: &Path) -> Result<f64, ExportError> {
    let path = dir.join("scene.resolved.toml");
    let wrong = |why: String| ExportError::NoScene(path.display().to_string(), why);
    let text = read_text(&path).map_err(|why| wrong(why.to_string()))?;
    let scene: toml::Table = text.parse().map_err(|why: toml::de::Error| wrong(why.message().to_string()))?;
    let start = scene.get("time").and_then(|time| time.get("start"));
    Ok(start.and_then(|start| start.as_float().or(start.as_integer().map(|whole| whole as f64))).unwrap_or(0.0))
}

/// A time of the log [s], whole nanoseconds since the start of the run, on the clock of the run.
pub fn time_of_run(logged: f64, start: f64) -> f64 {
    (1e9 * (logged + start)).round() / 1e9 + 0.0 // no -0
}
