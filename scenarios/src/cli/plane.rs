//! `splashdown plane`.

use std::path::PathBuf;

use clap::Args;

use super::shared::{DONE, Output, SceneArgs, Stop, say};
use crate::planing;

#[derive(Args)]
pub(super) struct PlaneArgs {
    #[command(flatten)]
    scene: SceneArgs,
    /// Folder for the hull's files (default: runs/plane_SCENE).
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replace the files of a hull that the folder holds.
    #[arg(long)]
    force: bool,
}

pub(super) fn run_plane(output: &Output, args: &PlaneArgs) -> Result<u8, Stop> {
    let scene = planing::load(&args.scene.scene, &args.scene.sets)?;
    let out = args.out.clone().unwrap_or_else(|| PathBuf::from("runs").join(format!("plane_{}", scene.name)));
    let towed = planing::run(&scene, &out, args.force)?;
    if output.json {
        say(towed.summary.to_json());
    } else if !output.quiet {
        say(towed.summary.to_text());
        say(format_args!("files in {}", out.display()));
    }
    Ok(DONE)
}
