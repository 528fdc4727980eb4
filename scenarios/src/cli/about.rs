//! `splashdown list`, `show`, `new` and `check`: what there is, and what a run would cost.

use std::path::PathBuf;

use clap::Args;
use report::section_picture;
use run::RunError;
use run::model_hierarchy::Theory;
use scene::nearest;

use super::shared::{DONE, Output, SceneArgs, Stop, load, say, write};
use crate::preflight::preflight;
use crate::templates::TEMPLATES;
use crate::{ditching, planing};

pub(super) fn list(output: &Output) -> Result<u8, Stop> {
    let mut scenes = Vec::new();
    for (name, _) in scene::builtin() {
        scenes.push((name, run::load(name, &[])?.scene.description));
    }
    if output.json {
        let names: Vec<_> = scenes.iter().map(|(n, d)| serde_json::json!({"scene": n, "description": d})).collect();
        say(serde_json::Value::from(names));
    } else {
        scenes.iter().for_each(|(name, description)| say(format_args!("{name:<20} {description}")));
    }
    Ok(DONE)
}

#[derive(Args)]
pub(super) struct ShowArgs {
    /// Name of a built-in scene, landing or planing hull.
    scene: String,
}

pub(super) fn show(args: &ShowArgs) -> Result<u8, Stop> {
    let known: Vec<(&str, &str)> =
        scene::builtin().iter().chain(ditching::builtin()).chain(planing::builtin()).copied().collect();
    let text = named("built-in scene", &args.scene, &known)?;
    say(text.trim_end());
    Ok(DONE)
}

#[derive(Args)]
pub(super) struct NewArgs {
    /// wedge, section (an outline of points), panel (a section whose bottom bends) or ditching (a landing).
    template: String,
    /// Write the scene to this file, which must not exist, instead of to stdout.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

pub(super) fn new_scene(output: &Output, args: &NewArgs) -> Result<u8, Stop> {
    let text = named("template", &args.template, &TEMPLATES)?;
    let Some(path) = &args.out else {
        say(text.trim_end());
        return Ok(DONE);
    };
    if path.exists() {
        return Err(Stop::Input(format!("--out {}: expected the name of a new file, this one exists", path.display())));
    }
    write(path, text)?;
    let verb = if args.template == "ditching" { "ditch" } else { "check" };
    output.progress(format_args!("wrote {path}; next: splashdown {verb} {path}", path = path.display()));
    Ok(DONE)
}

/// The text with a name.
fn named<'a>(kind: &str, name: &str, known: &[(&'a str, &'a str)]) -> Result<&'a str, Stop> {
    if let Some((_, text)) = known.iter().find(|(known, _)| *known == name) {
        return Ok(text);
    }
    let names = || known.iter().map(|(name, _)| *name);
    let near = nearest(name, names()).map_or(String::new(), |near| format!(": did you mean `{near}`?"));
    Err(Stop::Input(format!("no {kind} `{name}`{near}\n  expected one of {}", names().collect::<Vec<_>>().join(", "))))
}

#[derive(Args)]
pub(super) struct CheckArgs {
    #[command(flatten)]
    scene: SceneArgs,
    /// Draw the body, its panels and gauges, and the water at the start into this SVG file.
    #[arg(long, value_name = "FILE")]
    picture: Option<PathBuf>,
}

#[derive(Args)]
pub(super) struct ExplainArgs {
    #[command(flatten)]
    scene: SceneArgs,
}

/// `splashdown explain`.
pub(super) fn explain(output: &Output, args: &ExplainArgs) -> Result<u8, Stop> {
    let loaded = load(&args.scene)?;
    let text = crate::explain::explain(&loaded.scene, &preflight(&loaded.scene, &loaded.warnings));
    output.result(&serde_json::json!({"scene": loaded.scene.name, "text": text}), &text);
    Ok(DONE)
}

pub(super) fn check(output: &Output, args: &CheckArgs) -> Result<u8, Stop> {
    if let Some(path) =
        args.picture.as_ref().filter(|path| path.extension().is_none_or(|ending| !ending.eq_ignore_ascii_case("svg")))
    {
        return Err(Stop::Input(format!(
            "--picture {}: expected a file that ends in .svg: the picture is an SVG",
            path.display()
        )));
    }
    let loaded = load(&args.scene)?;
    let (scene, model) = (&loaded.scene, loaded.scene.model);
    if model.is_theory() {
        // whether a flow can be followed is known once it was
        Theory::of(scene, model).map_err(|e| RunError::Theory(model.name(), e))?;
    }
    let mut preflight = preflight(&loaded.scene, &loaded.warnings);
    preflight.outline = loaded.outline.clone();
    if let Some(path) = &args.picture {
        write(path, &section_picture(&loaded.scene))?;
    }
    output.result(&preflight, &preflight.to_text());
    Ok(DONE)
}
