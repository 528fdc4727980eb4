//! What a scene is, in plain words: the body, the water, what is modelled, which model and why, its cost, and what the answer will be worth.

use fsi_coupling::Shape;
use scene::{Axis, Body, Motion, Panel, Scene, Symmetry, panel_length};
use settings::significant;

use crate::preflight::Preflight;

/// Lines of text; each section has a heading and sentences.
pub fn explain(scene: &Scene, preflight: &Preflight) -> String {
    let bodies: Vec<String> = scene.body.iter().chain(&scene.bodies).flat_map(|body| of_body(scene, body)).collect();
    let sections = [
        ("What it is", of_scene(scene)),
        ("The body", bodies),
        ("The water", of_water(scene)),
        ("What is modelled", modelled(scene)),
        ("What is not", not_modelled(scene)),
        ("The model", of_model(preflight)),
        ("The cost", vec![of_cost(scene, preflight)]),
        ("What the answer will be worth", worth(scene, preflight)),
    ];
    let filled = sections.into_iter().filter(|(_, sentences)| !sentences.is_empty());
    let of = |(heading, sentences): (&str, Vec<String>)| format!("{heading}\n  {}", sentences.join("\n  "));
    filled.map(of).collect::<Vec<_>>().join("\n\n")
}

fn of_scene(scene: &Scene) -> Vec<String> {
    let described =
        Some(&scene.description).filter(|text| !text.is_empty()).map_or(String::new(), |text| format!(": {text}"));
    let end = significant(scene.time.end);
    let mut lines = vec![format!("{}{described}.", scene.name), format!("The run ends at {end} s.")];
    if !scene.source.is_empty() {
        lines.push(format!("Its numbers are from: {}", scene.source));
    }
    lines
}

fn of_body(scene: &Scene, body: &Body) -> Vec<String> {
    let m = |value: f64| format!("{} m", significant(value));
    let shape = match &body.shape {
        Shape::Wedge { deadrise_deg, breadth, .. } => {
            format!("a wedge of {} degrees, {} wide", significant(*deadrise_deg), m(*breadth))
        }
        Shape::Arc { radius, breadth, .. } => format!("a round bottom of radius {}, {} wide", m(*radius), m(*breadth)),
        Shape::Box { breadth, height } => format!("a box, {} wide and {} high", m(*breadth), m(*height)),
        Shape::Polygon { points } => format!("a section of {} points", points.len()),
        Shape::Polyline { points, thickness } => {
            format!("a bent plate of {} points, {} thick", points.len(), m(*thickness))
        }
    };
    let [u, v] = body.velocity.map(significant);
    let motion = match &body.motion {
        Motion::Free(freedom) => {
            let axis = |axis: &Axis| match axis {
                Axis::X => "sideways",
                Axis::Y => "up and down",
                Axis::Angle => "in roll",
            };
            let free: Vec<&str> = freedom.free.iter().map(axis).collect();
            format!(
                "It has {} kg/m, moves {} by its loads, and begins with [{u}, {v}] m/s",
                significant(freedom.mass),
                free.join(", ")
            )
        }
        Motion::ConstantVelocity => format!("It moves at [{u}, {v}] m/s, whatever the load"),
        Motion::Fixed => "It does not move".into(),
        Motion::Oscillating(_) => "It oscillates as given".into(),
        Motion::Tabulated(_) => "It moves as in the table that is given".into(),
    };
    let draught = match body.draught() {
        draught if draught > 0.0 => format!("Its lowest point is {} below still water at the start.", m(draught)),
        draught => format!("Its lowest point is {} above still water at the start.", m(-draught)),
    };
    let half = match scene.symmetry {
        Symmetry::X => vec!["One half is simulated, with a mirror at x = 0.".to_string()],
        _ => Vec::new(),
    };
    let panels = body.panels.iter().map(|panel| of_panel(body, panel));
    let first = format!("{}: {shape}, per metre of its length.", body.name);
    [first, format!("{motion}."), draught].into_iter().chain(half).chain(panels).collect()
}

fn of_panel(body: &Body, panel: &Panel) -> String {
    let [length, thickness] = [panel_length(body, panel), 1e3 * panel.thickness].map(significant);
    let gpa = significant(1e-9 * panel.youngs_modulus);
    let allowed = match (panel.allowable_stress, panel.yield_stress) {
        (Some(stress), _) => format!("its allowable stress is {} MPa", significant(1e-6 * stress)),
        (None, Some(stress)) => format!("it yields at {} MPa", significant(1e-6 * stress)),
        (None, None) => "nothing says which stress is allowed".into(),
    };
    format!("Its panel {} bends: {length} m long, {thickness} mm thick, E = {gpa} GPa; {allowed}.", panel.name)
}

fn of_water(scene: &Scene) -> Vec<String> {
    let density = significant(scene.water().density);
    let gravity = match -scene.gravity[1] {
        0.0 => "There is no gravity.".to_string(),
        g => format!("Gravity is {} m/s².", significant(g)),
    };
    let tank =
        format!("The tank is {} m wide and {} m deep.", significant(scene.tank.width), significant(scene.tank.depth));
    let tank = Some(tank).filter(|_| !scene.model.is_theory());
    [format!("It has {density} kg/m³."), gravity].into_iter().chain(tank).collect()
}

fn modelled(scene: &Scene) -> Vec<String> {
    let mut lines = vec!["A slice of unit length: nothing changes along the body.".to_string()];
    lines.push(match scene.model.is_theory() {
        true => "Water without viscosity, which cannot be compressed, by a theory of entry.".into(),
        false if scene.solver.is_incompressible() => "Water as particles, which cannot be compressed.".into(),
        false => {
            format!("Water as particles, with a sound speed of {} m/s.", significant(scene.sound_speed()))
        }
    });
    if scene.body.as_ref().is_some_and(Body::bends) {
        lines.push("The panels as beams, coupled with the water in each step.".into());
    }
    lines
}

fn not_modelled(scene: &Scene) -> Vec<String> {
    let Some(body) = &scene.body else {
        return vec![
            "The third dimension: the water is the same in every plane.".into(),
            "Air above the water.".into(),
        ];
    };
    let mut lines = vec![
        "Water that escapes at the ends of the body: real forces are lower (report.length shows by how much)."
            .to_string(),
    ];
    lines.push("Air between body and water.".into());
    if scene.model.is_theory() {
        lines.push("Spray after it leaves the body, walls of the tank, and water that comes back.".into());
    }
    if !body.bends() {
        lines.push("Bending of the body.".into());
    }
    lines
}

fn of_model(preflight: &Preflight) -> Vec<String> {
    let why = preflight.choice.clone().unwrap_or_else(|| format!("{}: the scene says so", preflight.model));
    vec![format!("{why}.")]
}

fn of_cost(scene: &Scene, preflight: &Preflight) -> String {
    let theory = preflight.theories.iter().find(|theory| theory.model.name() == preflight.model);
    match theory.and_then(|theory| theory.core_seconds) {
        Some(seconds) if scene.model.is_theory() => format!("About {} core-seconds.", significant(seconds)),
        _ => format!(
            "About {} core-seconds: {} particles, {} steps.",
            significant(preflight.core_seconds),
            preflight.fluid_particles,
            preflight.steps
        ),
    }
}

fn worth(scene: &Scene, preflight: &Preflight) -> Vec<String> {
    let theory = preflight.theories.iter().find(|theory| theory.model.name() == preflight.model);
    let measured = theory.and_then(|theory| theory.measured.as_ref()).map(|measured| {
        format!("For {}: {} % off in {}.", preflight.want, significant(100.0 * measured.error), measured.case)
    });
    let unknown = || match scene.model.is_theory() {
        true => "Its error was not measured near this scene: results will have no band.".to_string(),
        false => "Each result will say whether it is resolved, with its band where the charts have such a flow.".into(),
    };
    let warnings = preflight.warnings.iter().map(|warning| format!("Note: {warning}"));
    std::iter::once(measured.unwrap_or_else(unknown)).chain(warnings).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::preflight::preflight;

    #[test]
    fn a_scene_in_words() {
        for (name, sets, said) in [
            ("wedge", vec![], ["a wedge of 30 degrees", "241 kg/m", "Water as particles", "Air between"]),
            (
                "flexible_wedge",
                vec!["model=boundary_element".to_string()],
                ["Its panel plate bends", "by a theory of entry", "The panels as beams", "% off in"],
            ),
        ] {
            let loaded = run::load(name, &sets).expect("a scene");
            let text = explain(&loaded.scene, &preflight(&loaded.scene, &loaded.warnings));
            said.iter().for_each(|words| assert!(text.contains(words), "no `{words}` in {text}"));
        }
    }
}
