//! Failures at plates thinner than their rows of wall particles, and their remedy: screens (THEORY T1, T2).

use evidence::plates::{DENSITY, GRAVITY, face_forces, fixed, parted, parted_by, sides};
use evidence::statistics::mean;
use evidence::systems::advance;
use fsi_coupling::{Coupled, Outline};

const SPACING: f64 = 0.02;

/// Errors of the force on both faces over ½ρgh², and how many particles are on the wrong side or in the plate in the end.
fn held(mut system: Coupled, rows: [usize; 2]) -> ([f64; 2], usize) {
    let before = sides(&system);
    let mut forces = [vec![], vec![]];
    let ended = advance(&mut system, 1.0, |s| {
        let [left, right] = face_forces(s);
        forces[0].push(left);
        forces[1].push(-right);
    });
    let moved = before.iter().zip(sides(&system)).filter(|(a, b)| *a != b).count();
    let lost = if ended.is_err() { before.len() } else { moved + system.penetration().count };
    let error = |k: usize| {
        let height = rows[k] as f64 * SPACING;
        mean(&forces[k]) / (0.5 * DENSITY * GRAVITY * height * height) - 1.0
    };
    ([error(0), error(1)], lost)
}

/// A plate one spacing thick between waters 24 and 12 spacings deep, sampled as any outline is: the rows of its two faces
/// fall together in its middle and each sees both waters. Failure: the lower water lifts its face by what the higher one weighs. Remedy: a plate, with its own
/// rows for each face, and a screen.
#[test]
fn a_plate_of_one_spacing_shows_each_face_the_other_water() {
    let rows = [24, 12];
    let bare = |outline: Outline| fixed(Outline::polygon(&outline.loops()[0]).expect("the same corners"));
    let (old, through) = held(parted_by(1.0, 16, rows, SPACING, bare), rows);
    let (new, lost) = held(parted(1.0, 16, rows, SPACING), rows);
    println!("filled rows: {old:?}, {through} lost; screen: {new:?}, {lost} lost");
    assert!(old[1].abs() > 0.2 || through > 10, "filled rows hold: {old:?}, {through} particles lost");
    assert!(new.iter().all(|error| error.abs() < 0.01), "{new:?}");
    assert_eq!(lost, 0);
}
