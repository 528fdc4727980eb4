//! `splashdown export`: the frames of a run, its panels with their loads, or a scene as the files of the solver of 2010.

use std::path::{Path, PathBuf};

use clap::Args;

use super::shared::{DONE, Output, SceneArgs, Stop, say};
use super::thesis_files;
use crate::export::{ExportError, FrameFormat, PanelFormat, export_frames, export_modes, export_panels};

#[derive(Args)]
pub(super) struct ExportArgs {
    /// Folder of a run, for frames; or a scene, for INDAT and IPART.
    #[command(flatten)]
    target: SceneArgs,
    /// Write the frames of the run in the folder to DIR/vtk, for ParaView.
    #[arg(long)]
    vtk: bool,
    /// Write them to DIR/csv, as tables: particles per frame, frames.csv (times as in series.csv) and bodies.csv.
    #[arg(long)]
    csv: bool,
    /// Write them to DIR/parquet, as one table of all frames, and bodies.parquet.
    #[arg(long)]
    parquet: bool,
    /// Write the loads on the panels of the run to DIR/loads, as tables: pressure along each panel, forces on its nodes, extremes.
    #[arg(long)]
    loads: bool,
    /// Write its panels and their loads to DIR/nastran, as Nastran bulk data: GRID, CBAR, PBAR, MAT1; loads over time; static loads.
    #[arg(long)]
    nastran: bool,
    /// Write the COUNT lowest natural modes of its panels to DIR/modes, as body.modes_file reads them.
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u32).range(1..=100))]
    modes: Option<u32>,
    /// Write the parameters of the scene to this file.
    #[arg(long, value_name = "FILE", requires = "ipart", conflicts_with_all = ["vtk", "csv", "parquet", "loads", "nastran", "modes"])]
    indat: Option<PathBuf>,
    /// Write its particles at the start to this file.
    #[arg(long, value_name = "FILE", requires = "indat")]
    ipart: Option<PathBuf>,
}

impl From<ExportError> for Stop {
    fn from(error: ExportError) -> Stop {
        match error {
            ExportError::NoFrames(_) | ExportError::NoScene(..) | ExportError::NoLoads(..) => {
                Stop::Input(error.to_string())
            }
            ExportError::Write(..) => Stop::Failed(error.to_string()),
        }
    }
}

pub(super) fn export(output: &Output, args: &ExportArgs) -> Result<u8, Stop> {
    if let (Some(indat), Some(ipart)) = (&args.indat, &args.ipart) {
        return thesis_files::export(output, &args.target, indat, ipart);
    }
    let asked = [(args.vtk, FrameFormat::Vtk), (args.csv, FrameFormat::Csv), (args.parquet, FrameFormat::Parquet)];
    let formats: Vec<FrameFormat> = asked.into_iter().filter(|(asked, _)| *asked).map(|(_, format)| format).collect();
    let asked = [(args.loads, PanelFormat::Tables), (args.nastran, PanelFormat::Nastran)];
    let panels: Vec<PanelFormat> = asked.into_iter().filter(|(asked, _)| *asked).map(|(_, format)| format).collect();
    if formats.is_empty() && panels.is_empty() && args.modes.is_none() {
        let expected =
            "--vtk, --csv, --parquet, --loads, --nastran or --modes with the folder of a run, or --indat and --ipart";
        return Err(Stop::Input(format!("export: expected {expected}")));
    }
    if let Some(set) = args.target.sets.first() {
        return Err(Stop::Input(format!("--set {set}: expected none: a run is exported as it is")));
    }
    let mut written = Vec::new();
    for format in formats {
        let exported = export_frames(Path::new(&args.target.scene), format)?;
        let folder = exported.folder.display().to_string();
        if exported.damaged > 0 {
            output.progress(format_args!("{} frames of the log are damaged: left out", exported.damaged));
        }
        if !output.quiet && !output.json {
            say(format_args!("{} frames in {folder}", exported.frames));
        }
        written.push(serde_json::json!({ "folder": folder, "frames": exported.frames, "damaged": exported.damaged }));
    }
    for format in panels {
        let exported = export_panels(Path::new(&args.target.scene), format)?;
        let folder = exported.folder.display().to_string();
        if !output.quiet && !output.json {
            say(format_args!("{} with {} samples in {folder}", exported.panels.join(", "), exported.samples));
        }
        let (panels, samples) = (exported.panels, exported.samples);
        written.push(serde_json::json!({ "folder": folder, "panels": panels, "samples": samples }));
    }
    if let Some(count) = args.modes {
        let exported = export_modes(Path::new(&args.target.scene), count as usize)?;
        let folder = exported.folder.display().to_string();
        if !output.quiet && !output.json {
            say(format_args!("modes of {} in {folder}", exported.panels.join(", ")));
        }
        written.push(serde_json::json!({ "folder": folder, "panels": exported.panels }));
    }
    if output.json {
        say(serde_json::json!({ "exported": written }));
    }
    Ok(DONE)
}
