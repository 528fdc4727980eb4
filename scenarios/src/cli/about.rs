//! `splashdown list`, `keywords`, `schema` and `check`: what there is, and what a run would cost.

use super::shared::{DONE, Output, SceneArgs, Stop, load, say};
use crate::preflight::preflight;
use crate::reference_page::reference_page;
use crate::scene;

pub(super) fn list(output: &Output) -> Result<u8, Stop> {
    let mut scenes = Vec::new();
    for (name, _) in scene::builtin() {
        scenes.push((name, scene::load(name, &[])?.scene.description));
    }
    if output.json {
        let names: Vec<_> = scenes.iter().map(|(n, d)| serde_json::json!({"scene": n, "description": d})).collect();
        say(serde_json::Value::from(names));
    } else {
        scenes.iter().for_each(|(name, description)| say(format_args!("{name:<20} {description}")));
    }
    Ok(DONE)
}

pub(super) fn keywords(output: &Output, markdown: bool) -> Result<u8, Stop> {
    if markdown {
        say(reference_page().trim_end());
        return Ok(DONE);
    }
    for k in scene::schema().keywords() {
        match output.json {
            true => say(serde_json::json!(k)),
            false => {
                say(format_args!("{}\n    {}; {} (unit: {}; default: {})", k.path, k.doc, k.takes, k.unit, k.default))
            }
        }
    }
    Ok(DONE)
}

pub(super) fn schema() -> Result<u8, Stop> {
    say(format_args!("{:#}", scene::schema().to_json()));
    Ok(DONE)
}

pub(super) fn check(output: &Output, args: &SceneArgs) -> Result<u8, Stop> {
    let loaded = load(args)?;
    let preflight = preflight(&loaded.scene, &loaded.warnings);
    output.result(&preflight, &preflight.to_text());
    Ok(DONE)
}
