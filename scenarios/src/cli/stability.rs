//! `splashdown stability`.

use std::path::{Path, PathBuf};

use clap::Args;

use super::{Cli, DONE, Stop, say};
use crate::atlas::{self, AtlasError, Map, Measured};

#[derive(Args)]
pub(super) struct StabilityArgs {
    /// Maps to make: names of built-in ones, or TOML files like those in scenarios/cases/maps.
    maps: Vec<String>,
    /// Make every map.
    #[arg(long, conflicts_with = "maps")]
    all: bool,
    /// Draw a map that was made before, from its JSON file, without running it (repeatable).
    #[arg(long, value_name = "FILE", conflicts_with_all = ["maps", "all"])]
    from: Vec<PathBuf>,
    /// Run this point of one map only, and say what became of it and why.
    #[arg(long, value_name = "X,Y", conflicts_with_all = ["all", "from"])]
    point: Option<String>,
    /// Folder for NAME.json, NAME.svg and NAME.html.
    #[arg(long, value_name = "DIR", default_value = "runs/maps")]
    out: PathBuf,
    /// Write the tables to this Markdown file.
    #[arg(long, value_name = "FILE")]
    table: Option<PathBuf>,
}

impl From<AtlasError> for Stop {
    fn from(error: AtlasError) -> Stop {
        match error {
            AtlasError::Scene(e) => e.into(),
            AtlasError::Run(e) => e.into(),
            other => Stop::Input(other.to_string()),
        }
    }
}

pub(super) fn run_maps(cli: &Cli, args: &StabilityArgs) -> Result<u8, Stop> {
    if let Some(at) = &args.point {
        return run_point(cli, &args.maps, at);
    }
    if args.maps.is_empty() && !args.all && args.from.is_empty() {
        for map in atlas::maps()? {
            say(format_args!("{:<28} {}", map.name, map.about));
        }
        return Ok(DONE);
    }
    let mut made = Vec::new();
    for file in &args.from {
        let measured = atlas::stored(file)?;
        keep(&measured, &args.out)?;
        made.push(measured);
    }
    if args.from.is_empty() {
        for map in atlas::select(&args.maps)? {
            let measured = sweep(cli, &map)?;
            keep(&measured, &args.out)?; // each as soon as it is there: the next may fail
            made.push(measured);
        }
    }
    let tables: Vec<String> = made.iter().map(|m| format!("## {}\n\n{}", m.map.name, atlas::table(m))).collect();
    match cli.json {
        true => say(format_args!("{}", serde_json::to_string_pretty(&made).unwrap_or_default())),
        false => say(format_args!("{}", tables.join("\n").trim_end())),
    }
    if let Some(path) = &args.table {
        let text = format!("{HEAD}{}", tables.join("\n"));
        std::fs::write(path, text).map_err(|e| Stop::Failed(format!("cannot write {}: {e}", path.display())))?;
    }
    Ok(DONE)
}

const HEAD: &str = "# Stability atlas\n\nWritten by `splashdown stability --all --table docs/src/validation/stability_maps.md`. · stable, ~ inaccurate, **×** \
                    failed; in brackets where theory says otherwise. The last column counts the cells between the boundary found \
                    and the theory's.\n\n";

fn sweep(cli: &Cli, map: &Map) -> Result<Measured, Stop> {
    let tell = |done: usize, of: usize, point: &atlas::Point| {
        if !cli.quiet {
            eprintln!("{}, {done} of {of}: {}, {}: {}", map.name, point.x, point.y, point.verdict.name());
        }
    };
    Ok(atlas::sweep(map, tell)?)
}

fn run_point(cli: &Cli, maps: &[String], at: &str) -> Result<u8, Stop> {
    let [name] = maps else {
        return Err(Stop::Input(format!("--point {at}: expected one map, {} given", maps.len())));
    };
    for map in atlas::select(std::slice::from_ref(name))? {
        let (point, sets) = atlas::point(&map, at)?;
        if cli.json {
            say(format_args!("{}", serde_json::to_string_pretty(&point).unwrap_or_default()));
            continue;
        }
        say(format_args!("{} at {}, {}: {}: {}", map.name, point.x, point.y, point.verdict.name(), point.why));
        if let (Some(ratio), Some(theory)) = (point.theory, map.theory) {
            say(format_args!("{ratio:.3} of the limit by {}", theory.name()));
        }
        say(format_args!("{} steps of {} with {}", point.steps, map.scene, sets.join(", ")));
    }
    Ok(DONE)
}

fn keep(measured: &Measured, out: &Path) -> Result<(), Stop> {
    let wrong = |e: std::io::Error| Stop::Failed(format!("cannot write to {}: {e}", out.display()));
    let name = Path::new(measured.map.name.trim_end_matches(".toml")).file_name().unwrap_or_default();
    let file = |ending: &str| out.join(name).with_extension(ending);
    std::fs::create_dir_all(out).map_err(wrong)?;
    std::fs::write(file("json"), measured.to_json()).map_err(wrong)?;
    std::fs::write(file("svg"), atlas::svg(measured)).map_err(wrong)?;
    std::fs::write(file("html"), atlas::page(measured)).map_err(wrong)
}
