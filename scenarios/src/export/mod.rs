//! The frames of a run's log in formats of other programs: VTK for ParaView, CSV and Parquet for tables.
//!
//! A frame has the particles of the fluid and of the walls, with pressure, velocity, density, spacing and identity, and the outlines of
//! the bodies. A new format is a file of this folder that implements `FrameWriter`.

mod csv;
mod frame_writer;
mod parquet;
mod vtk;

use std::io;
use std::path::{Path, PathBuf};

use crate::log::LogReader;
use frame_writer::FrameWriter;

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
    /// A file cannot be written.
    #[error("cannot write {0}: {1}")]
    Write(String, #[source] io::Error),
}

/// Writes the frames of the run in `dir` to the folder `dir/vtk`, `dir/csv` or `dir/parquet`, whose files of the same names are replaced.
///
/// # Errors
/// [`ExportError::NoFrames`], [`ExportError::Write`].
pub fn export_frames(dir: &Path, format: FrameFormat) -> Result<Exported, ExportError> {
    let no_frames = || ExportError::NoFrames(dir.display().to_string());
    let mut log = LogReader::open(&dir.join("log.mcap")).ok_or_else(no_frames)?;
    let count = log.times().len();
    if count == 0 {
        return Err(no_frames());
    }
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
        let Some(frame) = log.frame(index) else { continue };
        writer.frame(frames, &frame).map_err(wrong)?;
        frames += 1;
    }
    writer.finish().map_err(wrong)?;
    Ok(Exported { folder, frames, damaged: count - frames })
}
