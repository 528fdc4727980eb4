//! `splashdown stability`.

use std::path::{Path, PathBuf};

use clap::Args;

use super::{Selection, list, write_all};
use crate::cli::shared::{DONE, Output, Stop, say, to_json};
use crate::experiments::ExperimentError;
use crate::experiments::stability::{self, MAPS, Map, Measured};

#[derive(Args)]
pub struct StabilityArgs {
    #[command(flatten)]
    selection: Selection,
    /// Draw a map that was made before, from its JSON file, without running it (repeatable).
    #[arg(long, value_name = "FILE", conflicts_with_all = ["cases", "all"])]
    from: Vec<PathBuf>,
    /// Run this point of one map only, and print its verdict and the reason.
    #[arg(long, value_name = "X,Y", conflicts_with_all = ["all", "from"])]
    point: Option<String>,
    /// Folder for NAME.json, NAME.svg and NAME.html.
    #[arg(long, value_name = "DIR", default_value = "runs/maps")]
    out: PathBuf,
}

const HEADING: &str = "# Stability maps\n\nWritten by `splashdown stability --all --table docs/src/validation/stability_maps.md`. \
                       · stable, ~ inaccurate, **×** failed; in brackets where theory says otherwise. The last column counts the \
                       cells between the boundary found and the theory's.";

pub fn run_maps(output: &Output, args: &StabilityArgs) -> Result<u8, Stop> {
    let selection = &args.selection;
    if let Some(at) = &args.point {
        return run_point(output, &selection.cases, at);
    }
    if selection.is_empty() && args.from.is_empty() {
        return list(&MAPS);
    }
    let mut maps = Vec::new();
    for file in &args.from {
        maps.push(stability::stored(file)?);
        keep(&maps[maps.len() - 1], &args.out)?;
    }
    let chosen = if args.from.is_empty() { MAPS.select(&selection.cases)? } else { Vec::new() };
    for map in chosen {
        maps.push(run_map(output, &map)?);
        keep(&maps[maps.len() - 1], &args.out)?; // at once: the next map may fail
    }
    let tables: Vec<String> = maps.iter().map(|m| format!("## {}\n\n{}", m.map.name, stability::table(m))).collect();
    selection.show(output, &maps, HEADING, &tables.join("\n"))?;
    Ok(DONE)
}

fn run_map(output: &Output, map: &Map) -> Result<Measured, ExperimentError> {
    stability::run_map(map, |done, of, point| {
        output.progress(format_args!(
            "{}, {done} of {of}: {}, {}: {}",
            map.name,
            point.x,
            point.y,
            point.verdict.name()
        ));
    })
}

fn run_point(output: &Output, maps: &[String], at: &str) -> Result<u8, Stop> {
    let [_] = maps else {
        return Err(Stop::Input(format!("--point {at}: expected one map, {} given", maps.len())));
    };
    let map = MAPS.select(maps)?.remove(0);
    let (point, sets) = stability::point(&map, at)?;
    if output.json {
        say(to_json(&point));
        return Ok(DONE);
    }
    say(format_args!("{} at {}, {}: {}: {}", map.name, point.x, point.y, point.verdict.name(), point.why));
    if let (Some(ratio), Some(theory)) = (point.theory, map.theory) {
        say(format_args!("{ratio:.3} of the limit by {}", theory.name()));
    }
    say(format_args!("{} steps of {} with {}", point.steps, map.scene, sets.join(", ")));
    Ok(DONE)
}

fn keep(measured: &Measured, out: &Path) -> Result<(), ExperimentError> {
    let path = Path::new(measured.map.name.trim_end_matches(".toml"));
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let texts = [("json", measured.to_json()), ("svg", stability::svg(measured)), ("html", stability::page(measured))];
    write_all(out, &texts.map(|(ending, text)| (format!("{name}.{ending}"), text)))
}
