//! `splashdown study`, and the coarser runs of `run --converge`.

use std::path::{Path, PathBuf};

use clap::Args;
use run::folder::refuse_occupied;

use super::write_all;
use crate::cli::shared::{DONE, Output, SceneArgs, Stop, load, say};
use crate::experiments::convergence::{self, Plan, Refinement, page, study, text};

#[derive(Args)]
pub struct StudyArgs {
    #[command(flatten)]
    scene: SceneArgs,
    /// Path of a number in summary.json, e.g. similarity/force_coefficient or peaks/wedge.fy_N_per_m/value.
    #[arg(long, value_name = "PATH")]
    quantity: String,
    /// Spacings [m], e.g. 0.04,0.03,0.02 (default: the scene's own, 1.41 and 2 times it).
    #[arg(long, value_name = "A,B,C", value_delimiter = ',')]
    spacings: Vec<f64>,
    /// Sound speeds [m/s] (default: the scene's own and half of it).
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    sound_speeds: Vec<f64>,
    /// Folder for study.json and study.html (default: runs/SCENE_study).
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replace a study that the folder holds.
    #[arg(long)]
    force: bool,
}

/// Files of a study.
const FILES: [&str; 2] = ["study.json", "study.html"];

pub fn run_study(output: &Output, args: &StudyArgs) -> Result<u8, Stop> {
    let name = load(&args.scene)?.scene.name;
    let out = args.out.clone().unwrap_or_else(|| PathBuf::from("runs").join(format!("{name}_study")));
    if let (Some(held), false) = (FILES.iter().find(|file| out.join(file).exists()), args.force) {
        let text = format!("{} already holds a study ({held}): choose another --out, or --force", out.display());
        return Err(Stop::Input(text));
    }
    let plan = Plan {
        scene: args.scene.scene.clone(),
        sets: args.scene.sets.clone(),
        quantity: args.quantity.clone(),
        spacings: args.spacings.clone(),
        sound_speeds: args.sound_speeds.clone(),
    };
    let done = study(&plan, |k, of, dx, c| {
        output.progress(format_args!("run {k} of {of}: spacing {dx:.6} m, sound speed {c:.2} m/s …"));
    })?;
    write_all(&out, &[(FILES[0].into(), done.to_json()), (FILES[1].into(), page(&done))])?;
    match output.json {
        true => say(done.to_json()),
        false => say(text(&done)),
    }
    Ok(DONE)
}

/// The runs of `run --converge` before the scene's own.
pub fn coarser_runs(
    output: &Output,
    given: &SceneArgs,
    quantities: &[String],
    out: &Path,
    force: bool,
) -> Result<Refinement, Stop> {
    refuse_occupied(out, force)?; // before the runs, not after them
    let runs = convergence::coarser_runs(&given.scene, &given.sets, |k, dx| {
        output.progress(format_args!("coarser run {k} of 2: spacing {dx:.6} m …"));
    })?;
    runs.refuse_unknown(quantities)?;
    Ok(runs)
}
