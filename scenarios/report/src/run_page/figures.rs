//! Each figure of a run as a file: curves as SVG, pictures of the flow as SVG and PNG.

use std::path::{Path, PathBuf};

use super::flow::{Flow, picture};
use super::folder::{FolderError, RunFolder};
use super::{charts, structure};
use crate::{chart_svg, flow_png, flow_svg};

/// Width of a picture of the flow [pixels].
const WIDTH: u32 = 1600;

/// Why figures are not written.
#[derive(Debug, thiserror::Error)]
pub enum FigureError {
    /// The folder holds no run.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// A file could not be written.
    #[error("cannot write {0}: {1}")]
    Write(String, std::io::Error),
}

/// Write the figures of the run in `dir` into its folder `figures`; their paths.
///
/// # Errors
/// The folder holds no run, or a file cannot be written.
pub fn write_figures(dir: &Path) -> Result<Vec<PathBuf>, FigureError> {
    let mut run = RunFolder::read(dir)?;
    let folder = dir.join("figures");
    let wrong = |path: &Path, e| FigureError::Write(path.display().to_string(), e);
    std::fs::create_dir_all(&folder).map_err(|e| wrong(&folder, e))?;
    let mut written = Vec::new();
    let mut write = |name: String, bytes: &[u8]| {
        let path = folder.join(name);
        std::fs::write(&path, bytes).map_err(|e| wrong(&path, e))?;
        written.push(path);
        Ok::<(), FigureError>(())
    };
    for figure in charts::figures(&run).iter().chain(&structure::figures(&run)) {
        write(format!("{}.svg", figure.name), chart_svg(&figure.chart).as_bytes())?;
    }
    if let Some(flow) = Flow::read(&mut run) {
        let last = flow.moments.len() - 1;
        for (name, moment) in [("flow_at_the_peak", flow.still), ("flow_at_the_end", last)] {
            let drawn = run.log.as_mut().and_then(|log| picture(&run.scene, log, &flow, moment, WIDTH));
            let Some((frame, view)) = drawn else { continue };
            write(format!("{name}.png"), &flow_png(&frame, &view))?;
            write(format!("{name}.svg"), flow_svg(&frame, &view).as_bytes())?;
        }
    }
    Ok(written)
}
