//! A clamped elastic strip as the floor of a tank, of any weight.

use std::f64::consts::TAU;

use fsi_coupling::{BeamBody, BeamSpec, Coupled, CouplingError, Outline, PrescribedBody, Scheme, WettedBody};
use sph_core::Fluid;
use structure_fe::{Beam, Damping, Dynamics, Integration, Material, Section, Supports};

use crate::bare::{lattice, parameters};

/// Density of the water [kg/m³].
pub const WATER: f64 = 1000.0;
/// Length of the strip and depth of the water [m].
pub const LENGTH: f64 = 1.0;
/// Speed of sound [m/s].
pub const SOUND: f64 = 30.0;
/// Gravity [m/s²].
pub const GRAVITY: f64 = 1.0;
/// Period of the strip's first natural vibration in the water [s].
pub const PERIOD: f64 = 16.0 * LENGTH / SOUND;
/// Elements of the strip.
const ELEMENTS: usize = 12;
/// Thickness that bending sees [m].
const THICKNESS: f64 = 0.02;
/// First mode: (βl)² and its added mass over ρL in a tank as deep as the strip is long, whose sides stand at its ends
/// (mean part 0.69 with all of the column, the rest with half a wave's depth).
const FIRST: f64 = 22.3733;
const WATER_OF_FIRST: f64 = 0.74;

/// A strip of `ratio` = ρ_s t/(ρ L), as stiff as gives its first vibration in the water [`PERIOD`].
fn strip(ratio: f64) -> BeamBody {
    let mass = ratio * WATER * LENGTH; // of area [kg/m²]
    let bending = (TAU / PERIOD / FIRST).powi(2) * (mass + WATER_OF_FIRST * WATER * LENGTH) * LENGTH.powi(4); // [N m]
    let youngs_modulus = 12.0 * bending / THICKNESS.powi(3);
    let material = Material { youngs_modulus, poissons_ratio: 0.0, density: mass / THICKNESS };
    let section = Section::strip(THICKNESS);
    let beam = Beam::straight([0.0; 2], [LENGTH, 0.0], ELEMENTS, material, section).expect("a beam");
    let mut supports = Supports::default();
    supports.clamp(0).clamp(ELEMENTS);
    let integration = Integration::GeneralisedAlpha { spectral_radius: 0.8 };
    let dynamics = Dynamics::new(beam, supports, integration, Damping::default()).expect("a clamped strip");
    // wet above only: below, as deep as the rows of boundary particles need
    let (left, right) = (-0.3 * LENGTH, 1.3 * LENGTH);
    let outline = Outline::polygon(&[[left, -0.3], [right, -0.3], [right, 0.0], [left, 0.0]]).expect("a box");
    BeamBody::new(BeamSpec { name: "strip".into(), dynamics, outline, gravity: [0.0; 2] }).expect("a strip")
}

fn side(left: f64) -> Box<dyn WettedBody> {
    let corners = [[left, 0.0], [left + 0.3, 0.0], [left + 0.3, 1.6 * LENGTH], [left, 1.6 * LENGTH]];
    let outline = Outline::polygon(&corners).expect("a box");
    let law = PrescribedBody::steady([0.0; 2], 0.0, [0.0; 2], 0.0);
    Box::new(PrescribedBody::new("side", outline, false, law))
}

/// The strip under still water that it begins to carry at once, `rows` rows of particles deep.
pub fn floor(ratio: f64, rows: u32, scheme: Scheme) -> Result<Coupled, CouplingError> {
    let mut parameters = parameters(SOUND);
    parameters.gravity = [0.0, -GRAVITY];
    let spacing = LENGTH / f64::from(rows);
    let seeds =
        lattice([0.0; 2], [LENGTH; 2], spacing, |at| Some(([0.0; 2], WATER * GRAVITY * (LENGTH - at[1]))));
    let bodies: Vec<Box<dyn WettedBody>> = vec![Box::new(strip(ratio)), side(-0.3), side(LENGTH)];
    Coupled::new(Fluid::new(parameters, &seeds), bodies, scheme, spacing)
}

/// Deflection of the strip's middle [m], downwards.
pub fn deflection(system: &Coupled) -> f64 {
    let strip = system.bodies().next().expect("the strip");
    -strip.surface([0.5 * LENGTH, 0.0]).at[1]
}
