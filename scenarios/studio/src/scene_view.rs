//! What the page shows of a scene's text: its keys, its section, its mistake, its warnings, its cost.

use std::collections::hash_map::DefaultHasher;
use std::hash::{Hash, Hasher};
use std::path::Path;

use scene::{Body, GaugeFrame, Loaded, Scene, SceneError, Shape, core_seconds, panel_line, particle_estimate};
use serde::Deserialize;
use serde_json::{Value, json};

use crate::edit::{Edit, apply, written};

/// A scene's text, and what is to be changed in it.
#[derive(Debug, Deserialize)]
pub struct Asked {
    text: String,
    #[serde(default)]
    edits: Vec<Edit>,
}

/// Reads a scene's text; files that it names lie in a folder.
///
/// # Errors
/// A scene that cannot be read.
pub fn load(folder: &Path, text: &str, sets: &[String]) -> Result<Loaded, SceneError> {
    run::load_text(&folder.join("scene.toml").to_string_lossy(), text, sets)
}

/// A mistake, with the key and the line of it where they are known.
pub fn mistake(error: &SceneError) -> Value {
    let mut json = error.to_json();
    // the text has no file that a reader knows, and a range no argument
    if let SceneError::File { problem, .. } | SceneError::Set { problem, .. } = error {
        json["message"] = json!(problem.to_string());
    }
    if let SceneError::File { line, .. } = error {
        json["line"] = json!(line);
    }
    json
}

/// The text with its edits, and what it says.
pub fn view(folder: &Path, Asked { text, edits }: &Asked) -> Value {
    let text = match apply(text, edits) {
        Ok(text) => text,
        Err(error) => {
            let error = json!({"message": error.why, "key": error.key, "line": null});
            return json!({"text": text, "error": error, "written": written(text)});
        }
    };
    let keys = written(&text);
    match load(folder, &text, &[]) {
        Err(error) => json!({"text": text, "error": mistake(&error), "written": keys}),
        Ok(loaded) => {
            let scene = &loaded.scene;
            let resolved = scene.to_toml();
            json!({
                "text": text,
                "error": null,
                "written": keys,
                "resolved": written(&resolved),
                "warnings": loaded.warnings,
                "implausible": loaded.warnings.iter().find(|warning| is_implausible(warning)),
                "section": section(scene),
                "cost": (!scene.model.is_theory()).then(|| json!({"fluid": particle_estimate(scene).0, "core_seconds": core_seconds(scene)})),
                "name": scene.name,
                "fingerprint": fingerprint(&resolved),
            })
        }
    }
}

/// Whether a warning says that the size or the mass of the body is hardly what was meant.
fn is_implausible(warning: &str) -> bool {
    ["the mean density of the body", "may be meant in"].iter().any(|words| warning.contains(words))
}

/// The same for two scenes that are alike once resolved, in one process.
pub fn fingerprint(resolved: &str) -> String {
    let mut hasher = DefaultHasher::new();
    resolved.hash(&mut hasher);
    format!("{:016x}", hasher.finish())
}

/// Bodies, panels, gauges and water at t = 0, in the tank's frame [m].
fn section(scene: &Scene) -> Value {
    let gauge = |gauge: &scene::Gauge| {
        let at = match (&scene.body, gauge.on) {
            (Some(body), GaugeFrame::Body) => body.to_tank(gauge.at),
            _ => gauge.at,
        };
        json!({"name": gauge.name, "at": at})
    };
    json!({
        "bodies": scene.all_bodies().map(body).collect::<Vec<_>>(),
        "gauges": scene.gauges.iter().map(gauge).collect::<Vec<_>>(),
        "tank": {"width": scene.tank.width, "depth": scene.tank.depth, "height": scene.tank.height},
        "own": scene.body.is_some(),
    })
}

fn body(body: &Body) -> Value {
    let panel = |panel: &scene::Panel| {
        let line: Vec<[f64; 2]> = panel_line(body, panel).into_iter().map(|point| body.to_tank(point)).collect();
        json!({"name": panel.name, "line": line})
    };
    let points = match &body.shape {
        Shape::Polygon { points } | Shape::Polyline { points, .. } => points.clone(),
        other => other.outline(),
    };
    json!({
        "name": body.name,
        "shape": body.shape.name(),
        "points": points,
        "outline": body.placed_outline(),
        "position": body.position,
        "angle_deg": body.angle_deg,
        "panels": body.panels.iter().map(panel).collect::<Vec<_>>(),
        "velocity": body.velocity,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_section_of_another_unit_is_implausible() {
        let text = |mass: f64| {
            let body = format!(
                "shape = \"wedge\"\ndeadrise_deg = 20\nfree = [\"y\"]\nbreadth = 0.6\nmass = {mass}\nvelocity = [0, -4]\n"
            );
            format!("name = \"a\"\nmodel = \"wagner\"\n[time]\nend = 0.01\n[body]\n{body}")
        };
        let of = |mass| view(Path::new("."), &Asked { text: text(mass), edits: Vec::new() })["implausible"].clone();
        assert_eq!(of(40.0), Value::Null);
        assert!(of(1e9).is_string() && of(0.04).is_string(), "{} {}", of(1e9), of(0.04));
    }
}
