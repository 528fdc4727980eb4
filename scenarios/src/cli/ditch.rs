//! `splashdown ditch`.

use std::path::{Path, PathBuf};

use clap::Args;

use super::{Cli, DONE, SceneArgs, Stop, say};
use crate::ditching::{self, Landed};
use crate::summary::Status;

#[derive(Args)]
pub(super) struct DitchArgs {
    #[command(flatten)]
    scene: SceneArgs,
    /// Folder for the landing's files (default: runs/ditch_SCENE).
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replace a landing that the folder holds.
    #[arg(long)]
    force: bool,
    /// Write scenes of particles of sections, as they are when the water bears most, into this folder for `splashdown run`.
    #[arg(long, value_name = "DIR")]
    export_sections: Option<PathBuf>,
    /// How many of them.
    #[arg(long, value_name = "N", default_value_t = 3)]
    sections: usize,
}

pub(super) fn run_ditch(cli: &Cli, args: &DitchArgs) -> Result<u8, Stop> {
    let scene = ditching::load(&args.scene.scene, &args.scene.sets)?;
    let out = args.out.clone().unwrap_or_else(|| PathBuf::from("runs").join(format!("ditch_{}", scene.name)));
    let landed = ditching::run(&scene, &out, args.force)?;
    if let Some(folder) = &args.export_sections {
        export(&scene, &landed, args.sections, folder)?;
    }
    if cli.json {
        say(format_args!("{}", landed.summary.to_json()));
    } else if !cli.quiet {
        say(format_args!("{}", landed.summary.to_text()));
        say(format_args!("files in {}: open report.html", out.display()));
    }
    match landed.summary.status {
        Status::Completed => Ok(DONE),
        _ => Err(Stop::Failed(landed.summary.message.unwrap_or_default())),
    }
}

fn export(scene: &ditching::Scene, landed: &Landed, count: usize, folder: &Path) -> Result<(), Stop> {
    let wrong = |e: std::io::Error| Stop::Failed(format!("cannot write to {}: {e}", folder.display()));
    std::fs::create_dir_all(folder).map_err(wrong)?;
    for section in ditching::section_scenes(scene, landed, count) {
        std::fs::write(folder.join(format!("{}.toml", section.name)), section.text).map_err(wrong)?;
    }
    Ok(())
}
