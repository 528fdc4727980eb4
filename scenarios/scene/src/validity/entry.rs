//! What is doubtful about the entry of each body of a scene, before the run.

use std::f64::consts::FRAC_PI_2;

use fsi_coupling::Shape;
use settings::significant;

use super::air::{flat_contact, vapour};
use super::compressibility::sound_speed_for;
use super::resolution::{LEAST_DRAUGHT, PEAK_SPACINGS};
use crate::bottom::Bottom;
use crate::impact::{Entry, jet_reach};
use crate::keys::{Body, Motion, Scene};

/// Draught over spacing from which the force of an entry is within 1 %.
const STARTING_DRAUGHT: f64 = 16.0;

/// Warnings about each body that enters the water, or that falls short of it.
pub(crate) fn entry_warnings(scene: &Scene) -> Vec<String> {
    let of = |(body, entry): (&Body, Entry)| {
        let warnings = match entry.final_draught > 0.0 {
            true => of_entry(scene, body, &entry),
            false => vec![short_of_water(&entry)],
        };
        let about = scene.about(body);
        warnings.into_iter().map(move |warning| format!("{about}{warning}")).collect::<Vec<_>>()
    };
    scene.entries().into_iter().flat_map(of).chain(held_entries(scene)).collect()
}

/// Bodies that move down into the water and that joints hold: no automatic value knows of their entry.
fn held_entries(scene: &Scene) -> Vec<String> {
    let warned = |(body, entry): (&Body, Entry)| {
        let wanted = sound_speed_for(scene.solver.water().compressibility_error, entry.root_speed());
        let slow = !scene.solver.is_incompressible() && scene.sound_speed() < wanted;
        (slow && body.velocity[1] < 0.0 && entry.final_draught > 0.0).then(|| {
            format!(
                "{}a joint holds it, and the automatic values leave its entry out: alone it would have fluid.sound_speed = {} m/s",
                scene.about(body),
                significant(wanted)
            )
        })
    };
    scene.held_entries().into_iter().filter_map(warned).collect()
}

/// Bodies that end their run in the air.
pub(crate) fn short_of_water_all(scene: &Scene) -> Vec<String> {
    let entries = scene.entries();
    let dry = entries.iter().filter(|(_, entry)| entry.final_draught <= 0.0);
    dry.map(|(body, entry)| scene.about(body) + &short_of_water(entry) + turning(body)).collect()
}

/// What the draught of a theory leaves out.
fn turning(body: &Body) -> &'static str {
    if body.angular_velocity_deg_per_s == 0.0 { "" } else { ", if it does not turn: its rotation is left out here" }
}

/// A body that ends its run in the air.
fn short_of_water(entry: &Entry) -> String {
    let above = significant(-entry.final_draught);
    format!("the body does not reach the water: at the end of the run it is {above} m above it")
}

fn of_entry(scene: &Scene, body: &Body, entry: &Entry) -> Vec<String> {
    let spacing = scene.resolution.spacing;
    let mut warnings = Vec::new();
    let draught = entry.final_draught;
    if draught < STARTING_DRAUGHT * spacing && !scene.is_cushioned_by(body, entry) {
        warnings.push(format!(
            "the draught at the end is {} spacings; below {STARTING_DRAUGHT} bands are wide: {} m would do",
            significant(draught / spacing),
            significant(0.99 * draught / STARTING_DRAUGHT)
        ));
    }

    warnings.extend(flat_contact(scene, body, entry));
    warnings.extend(vapour(scene, entry));
    let peak = entry.peak_draught / spacing;
    if matches!(entry.bottom, Bottom::Wedge { .. }) && !entry.is_flat() && peak < LEAST_DRAUGHT {
        warnings.push(format!(
            "the largest force comes at a draught of about {} spacings, and the run will not give it as resolved: {} m would do \
             for resolution.spacing",
            significant(peak),
            significant(entry.peak_draught / LEAST_DRAUGHT)
        ));
    }

    let across = entry.peak_length() / spacing;
    if across < PEAK_SPACINGS && !entry.is_flat() {
        warnings.push(format!(
            "peak pressure unreliable: {} spacings across the face near the peak (5 give it to 25 %, {PEAK_SPACINGS} to 2-4 %); \
             {} m would do for resolution.spacing",
            significant(across),
            significant(entry.peak_length() / PEAK_SPACINGS)
        ));
    }

    if draught >= scene.tank.depth {
        warnings.push(format!(
            "the body may reach the floor: draught {} m at the end, depth {} m",
            significant(draught),
            significant(scene.tank.depth)
        ));
    }

    warnings.extend(past_the_chine(scene, body, entry));
    warnings
}

/// The warning about an upright wedge at constant speed whose jet, or spray root, passes the chine before the end.
fn past_the_chine(scene: &Scene, body: &Body, entry: &Entry) -> Option<String> {
    let Shape::Wedge { deadrise_deg, breadth, .. } = body.shape else { return None };
    let upright = body.angle_deg == 0.0 && body.angular_velocity_deg_per_s == 0.0 && body.velocity[0] == 0.0;
    if body.motion != Motion::ConstantVelocity || !upright {
        return None;
    }
    let (end, chine, keel) = (scene.time.end, 0.5 * breadth, body.position[1]);
    let root = FRAC_PI_2 / deadrise_deg.to_radians().tan();
    // the keel meets the water at −keel/V before or after the run's start
    let passes = |reach: f64| (chine / reach + keel) / entry.speed;
    let tip = jet_reach(deadrise_deg).unwrap_or(root);
    let needed = significant(2.0 * tip * entry.final_draught);
    let remedy = format!("body.breadth = {needed} m would keep the jet on the face");
    if passes(root) < end {
        return Some(format!(
            "the spray root passes the chine at {} s and would be at {} m at the end, past the chine at {} m, where the \
             similarity solution ends: the face is wetted to its end, and the force no longer grows with it; {remedy}",
            significant(passes(root)),
            significant(root * entry.final_draught),
            significant(chine),
        ));
    }
    (passes(tip) < end).then(|| {
        format!(
            "the jet's tip passes the chine at {} s and leaves the face: the force falls below the similarity solution's a \
             little (20 deg, breadth 12 m: by 2 % at 1.3 times that time); {remedy}",
            significant(passes(tip))
        )
    })
}
