//! Failures of the coupling: a body lighter than the water that one step moves with it.

use evidence::systems::{advance, scene, system};

/// Largest vertical acceleration [m/s²] in half a second of a box of 0.4 m, released at its equilibrium draught.
fn wildest(mass: f64, spacing: f64) -> f64 {
    let position = 0.1 - mass / (1000.0 * 0.4); // centre over still water: half the height less the draught
    let sets = [
        format!("body.mass={mass}"),
        format!("body.position=[0.0, {position}]"),
        format!("resolution.spacing={spacing}"),
        "body.free=[\"y\"]".to_string(),
    ];
    let sets: Vec<&str> = sets.iter().map(String::as_str).collect();
    assert_eq!(scene("floating_box", &sets).resolution.spacing, spacing);
    let mut system = system("floating_box", &sets);
    let mut wildest = 0.0_f64;
    advance(&mut system, 0.5, |s| {
        let box_ = s.bodies().find_map(|body| body.motion()).expect("a box");
        wildest = wildest.max(box_.acceleration[1].abs());
    })
    .expect("the run ends, sensibly or not");
    wildest
}

/// Weak coupling moves the body once a step, and wall pressures contain ρ a_wall (THEORY E9) of the step before: the
/// added mass of about half a row of particles, ρ b Δx/2, is explicit. Failure: a box of a twentieth of the water's
/// density, m = 0.4 ρ b Δx, shakes itself at thousands of g, and nothing but the curves says so. Remedy: m ≥ 0.6 ρ b Δx
/// is smooth, so halve the spacing.
#[test]
fn a_box_lighter_than_half_a_row_of_particles_shakes_itself_apart() {
    let (coarse, fine) = (wildest(4.0, 0.025), wildest(4.0, 0.0125));
    assert!(coarse > 1000.0, "4 kg/m at 25 mm: up to {coarse:.1} m/s²");
    assert!(fine < 20.0, "4 kg/m at 12.5 mm: up to {fine:.1} m/s²");
    let heavier = wildest(7.0, 0.025);
    assert!(heavier < 20.0, "7 kg/m at 25 mm: up to {heavier:.1} m/s²");
}
