//! Why no force on a body can be relied on, whatever the run gives: known before it.

use settings::significant;
use sph_core::Solver;

use super::gaps::gap_limit;
use crate::impact::{Entry, middle_of_wet};
use crate::keys::{Body, Motion, Scene};
use crate::legacy::{extrapolates, repulsive_walls};

/// Largest g D/V² of a body at a given speed in graded, incompressible water, of its draught D at the end [-].
const LARGEST_GAIN: f64 = 0.3;

/// The reason why no force of this scene can be trusted, where one is known before the run. `check` shows it as a warning; results take their
/// verdict from it.
pub fn limit_of_forces(scene: &Scene) -> Option<String> {
    if scene.body.is_none() || scene.model.is_theory() {
        return None;
    }
    pushed(scene)
        .or_else(|| planing(scene))
        .or_else(|| outside_fine_zone(scene))
        .or_else(|| sinking(scene))
        .or_else(|| gap_limit(scene))
}

/// False where walls have no pressure to integrate over their surface (THEORY GE8).
pub fn presses_on_walls(scene: &Scene) -> bool {
    let of_options = scene.solver.weakly_compressible().is_none_or(|fluid| extrapolates(&fluid.options));
    of_options && scene.solver.kind() != Solver::IncompressibleThesis
}

/// Repulsive points push each particle that comes near, by contact impulses that no force shows: a wedge of 30 degrees had a third of its force.
fn pushed(scene: &Scene) -> Option<String> {
    let fluid = scene.solver.weakly_compressible()?;
    repulsive_walls(&fluid.options)
        .then(|| "fluid.walls = \"repulsive\": the force of an impact is up to 70 % too low, for these walls push by contact impulses".to_string())
}

/// A flat face pitched by less than this [deg], beside one that is steeper than the other.
const PITCHED: [f64; 2] = [15.0, 45.0];

/// A flat face that is pitched and moves along: water leaves its lowest edge.
fn planing(scene: &Scene) -> Option<String> {
    let pitched = |(body, _): &(&Body, Entry)| {
        let outline = body.placed_outline();
        let lowest = (0..outline.len()).min_by(|&a, &b| outline[a][1].total_cmp(&outline[b][1]))?;
        let slope = |to: usize| {
            let [dx, dy] = [0, 1].map(|i| outline[to][i] - outline[lowest][i]);
            dy.atan2(dx.abs()).to_degrees()
        };
        let n = outline.len();
        let [a, b] = [slope((lowest + 1) % n), slope((lowest + n - 1) % n)];
        let [flat, steep] = [a.min(b), a.max(b)];
        let is_pitched = flat > 0.1 && flat < PITCHED[0] && steep > PITCHED[1];
        (is_pitched && body.velocity[0] != 0.0).then(|| (scene.about(body), flat))
    };
    scene.entries().iter().find_map(pitched).map(|(about, pitch)| {
        format!(
            "{about}a flat face pitched by {} degrees moves along the water: no exact answer judges its forces, which fell by up to 19 % from \
             one spacing to half of it",
            significant(pitch)
        )
    })
}

/// Graded, incompressible water that does not start level sinks in its coarse rows (THEORY PR18), under a body that is slow beside what
/// gravity adds.
fn sinking(scene: &Scene) -> Option<String> {
    let graded = scene.resolution.growth > 1.0 && scene.solver.is_incompressible() && !scene.starts_level();
    let entries = scene.entries();
    let sinks = |(body, entry): &&(&Body, Entry)| {
        let given = matches!(body.motion, Motion::ConstantVelocity | Motion::Tabulated(_));
        given && graded && scene.gained_by(body, entry) > LARGEST_GAIN
    };
    entries.iter().find(sinks).map(|(body, entry)| {
        let (about, gained) = (scene.about(body), scene.gained_by(body, entry));
        format!(
            "{about}graded incompressible water that does not start level sinks while the body goes down: g D/V^2 is {} at the end, and above {LARGEST_GAIN} the \
             force was 6 to 20 % low; set solver = \"weakly_compressible\", or tank.width and tank.depth to 4 breadths",
            significant(gained)
        )
    })
}

fn outside_fine_zone(scene: &Scene) -> Option<String> {
    let (entries, middle) = (scene.entries(), scene.fine_zone_center());
    let leaves = |(body, entry): &(&Body, Entry)| {
        let root = entry.bottom.wetted_half_width(entry.attached_draught());
        let half =
            scene.resolution.fine_zone[0] - (middle_of_wet(&body.placed_outline(), entry.final_draught) - middle).abs();
        (entry.final_draught > 0.0 && scene.resolution.growth > 1.0 && half < root)
            .then(|| (scene.about(body), root, half))
    };
    entries.iter().find_map(leaves).map(|(about, root, half)| {
        format!(
            "{about}the spray root goes out to {} m and leaves the fine zone, {} m wide on each side (resolution.fine_zone): the peak may be \
             off by half",
            significant(root),
            significant(half.max(0.0))
        )
    })
}

#[cfg(test)]
mod tests {
    use crate::{limit_of_forces, load, load_text};

    #[test]
    fn repulsive_walls_and_a_small_fine_zone_are_known_before_the_run() {
        let limit = |set: &str| limit_of_forces(&load("wedge", &[set.to_string()]).expect("a scene").scene);
        assert_eq!(limit("resolution.spacing=0.006"), None);
        assert!(
            limit("fluid.walls=repulsive")
                .is_some_and(|why| why.contains("fluid.walls") && why.contains("70 % too low"))
        );
        assert!(limit("resolution.fine_zone=[0.03, 0.03]").is_some_and(|why| why.contains("resolution.fine_zone")));
    }

    #[test]
    fn incompressible_water_sinks_where_it_does_not_start_level() {
        let limit = |sets: &[&str]| {
            let sets: Vec<String> = sets.iter().map(|set| set.to_string()).collect();
            limit_of_forces(&load_text("a slow wedge", SLOW, &sets).expect("a scene").scene)
        };
        assert_eq!(limit(&[]), None);
        let waves = ["tank.surface_amplitude=0.001", "tank.surface_mode=2"];
        assert!(limit(&waves).is_some_and(|why| why.contains("level")));
    }

    #[test]
    fn a_pitched_flat_face_that_moves_along_has_no_known_force() {
        let limit = |velocity: &str| {
            let text = format!(
                "name = 'pitched'\n[time]\nend = 0.006\n[resolution]\nspacing = 0.004\n[body]\nname = 'b'\nshape = 'box'\nbreadth = 0.5\n\
                 height = 0.2\nmotion = 'constant_velocity'\nangle_deg = 5\nposition = [0.0, 0.1214]\nvelocity = {velocity}\n"
            );
            limit_of_forces(&load_text("pitched", &text, &[]).expect("a scene").scene)
        };
        assert!(limit("[10.0, -3.0]").is_some_and(|why| why.contains("pitched by 5 degrees")));
        assert_eq!(limit("[0.0, -3.0]"), None);
    }

    const SLOW: &str = "
name = 'slow'
symmetry = 'x'
solver = 'incompressible'
[resolution]
spacing = 0.01
[time]
end = 0.2
[body]
name = 'wedge'
shape = 'wedge'
deadrise_deg = 30.0
breadth = 1.2
side_height = 0.5
motion = 'constant_velocity'
velocity = [0.0, -1.0]
";
}
