//! `splashdown ditch`.

use std::path::{Path, PathBuf};

use clap::Args;

use super::shared::{DONE, Output, SceneArgs, Stop, say};
use crate::ditching::{self, Landed, SectionError, SectionResult};

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
    /// Write scenes of particles of sections, as they are when the load of the water is largest, into this folder for `splashdown run`.
    #[arg(long, value_name = "DIR")]
    export_sections: Option<PathBuf>,
    /// Run them too, each in a folder beside its scene, and say their forces beside the theory's (minutes).
    #[arg(long, requires = "export_sections")]
    run_sections: bool,
    /// How many of them.
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..))]
    sections: u32,
}

pub(super) fn run_ditch(output: &Output, args: &DitchArgs) -> Result<u8, Stop> {
    let scene = ditching::load(&args.scene.scene, &args.scene.sets)?;
    let out = args.out.clone().unwrap_or_else(|| PathBuf::from("runs").join(format!("ditch_{}", scene.name)));
    let landed = ditching::run(&scene, &out, args.force)?;
    let sections = match &args.export_sections {
        Some(folder) => export(&scene, &landed, args, folder)?,
        None => Vec::new(),
    };
    if output.json && !sections.is_empty() {
        let both = serde_json::json!({"landing": landed.summary, "sections": sections});
        say(serde_json::to_string_pretty(&both).unwrap_or_default());
    } else if output.json {
        say(landed.summary.to_json());
    } else if !output.quiet {
        say(landed.summary.to_text());
        for s in &sections {
            let ours =
                format!("{:.0} N/m by theory, {:.0} N/m by particles", s.by_theory_n_per_m, s.by_particles_n_per_m);
            say(format_args!("  {}: {ours} at {:.5} s ({:.0} s of wall time)", s.name, s.time_s, s.wall_time_s));
        }
        say(format_args!("files in {}: open report.html", out.display()));
    }
    match landed.summary.status {
        status if status.is_completed() => Ok(DONE),
        _ => Err(Stop::Failed(landed.summary.message.unwrap_or_default())),
    }
}

/// Write the sections' scenes, and run them if that is asked for.
fn export(
    scene: &ditching::Scene,
    landed: &Landed,
    args: &DitchArgs,
    folder: &Path,
) -> Result<Vec<SectionResult>, Stop> {
    let wrong = |e: std::io::Error| Stop::Failed(format!("cannot write to {}: {e}", folder.display()));
    std::fs::create_dir_all(folder).map_err(wrong)?;
    let mut results = Vec::new();
    for section in ditching::section_scenes(scene, landed, args.sections as usize) {
        std::fs::write(folder.join(format!("{}.toml", section.name)), &section.text).map_err(wrong)?;
        if args.run_sections {
            results.push(section.run(folder.join(&section.name), args.force)?);
        }
    }
    Ok(results)
}

impl From<SectionError> for Stop {
    fn from(error: SectionError) -> Stop {
        match error {
            SectionError::Scene(e) => e.into(),
            SectionError::Run(e) => e.into(),
            SectionError::Ended(..) => Stop::Failed(error.to_string()),
        }
    }
}
