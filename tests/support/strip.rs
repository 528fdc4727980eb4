//! A clamped elastic strip as the floor of a tank, of any weight.

use std::f64::consts::TAU;

use fsi_coupling::bodies::flexible::body::FlexibleBody;
use fsi_coupling::bodies::flexible::panel::{PanelEnd, PanelSpec, Plane};
use fsi_coupling::{Body, Coupled, CouplingError, FlexibleSpec, Frame, Outline, PrescribedBody, RigidMotion, Scheme};
use structure_fe::{Damping, Material, Theory};

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
fn strip(ratio: f64) -> FlexibleBody {
    let mass = ratio * WATER * LENGTH; // of area [kg/m²]
    let bending = (TAU / PERIOD / FIRST).powi(2) * (mass + WATER_OF_FIRST * WATER * LENGTH) * LENGTH.powi(4); // [N m]
    let youngs_modulus = 12.0 * bending / THICKNESS.powi(3);
    let material = Material { youngs_modulus, poissons_ratio: 0.0, density: mass / THICKNESS };
    // wet above only: below, as deep as the layers of boundary particles need
    let (left, right) = (-0.3 * LENGTH, 1.3 * LENGTH);
    let outline = Outline::polygon(&[[left, -0.3], [right, -0.3], [right, 0.0], [left, 0.0]]).expect("a box");
    let panel = PanelSpec {
        name: "strip".into(),
        span: [[LENGTH, 0.0], [0.0; 2]],
        elements: ELEMENTS,
        mesh: None,
        thickness: THICKNESS,
        plane: Plane::Strain,
        material,
        theory: Theory::EulerBernoulli,
        ends: [PanelEnd::Clamped; 2],
        end_springs: Default::default(),
        watch: vec![0.5],
        plasticity: None,
        rupture_strain: None,
        allowable_stress: None,
    };
    let spec = FlexibleSpec {
        name: "strip".into(),
        outline,
        middle: None,
        panels: vec![panel],
        frame: Frame::Given(PrescribedBody::steady([0.0; 2], 0.0, [0.0; 2], 0.0)),
        start: RigidMotion::default(),
        gravity: [0.0; 2],
        damping: Damping::default(),
        half: false,
    };
    FlexibleBody::new(spec).expect("a strip")
}

fn side(left: f64) -> Box<dyn Body> {
    let corners = [[left, 0.0], [left + 0.3, 0.0], [left + 0.3, 1.6 * LENGTH], [left, 1.6 * LENGTH]];
    let outline = Outline::polygon(&corners).expect("a box");
    let law = PrescribedBody::steady([0.0; 2], 0.0, [0.0; 2], 0.0);
    Box::new(PrescribedBody::new("side", outline, false, law))
}

/// A strip, and the water on it.
#[derive(Clone, Copy, Debug)]
pub struct Floor {
    /// Mass ratio ρ_s t/(ρ L) [-].
    pub ratio: f64,
    /// Layers of particles in the depth of the water.
    pub layers: u32,
    /// Courant number of the fluid [-].
    pub courant: f64,
    /// Speed at which the water falls on the strip at the start [m/s].
    pub fall: f64,
}

impl Floor {
    /// Still water, which the strip begins to carry at once.
    pub fn still(ratio: f64, layers: u32) -> Floor {
        Floor { ratio, layers, courant: 0.6, fall: 0.0 }
    }

    /// Set everything up.
    pub fn build(&self, scheme: Scheme) -> Result<Coupled, CouplingError> {
        let mut parameters = parameters(SOUND);
        (parameters.gravity, parameters.cfl) = ([0.0, -GRAVITY], self.courant);
        let spacing = LENGTH / f64::from(self.layers);
        let still = self.fall == 0.0;
        let pressure = |y: f64| if still { WATER * GRAVITY * (LENGTH - y) } else { 0.0 };
        let seeds = lattice([0.0; 2], [LENGTH; 2], spacing, |at| Some(([0.0, -self.fall], pressure(at[1]))));
        let bodies: Vec<Box<dyn Body>> = vec![Box::new(strip(self.ratio)), side(-0.3), side(LENGTH)];
        Coupled::new(parameters.fluid(&seeds), bodies, scheme, spacing)
    }
}

/// Deflection of the strip's middle [m], downwards.
pub fn deflection(system: &Coupled) -> f64 {
    let strip = system.bodies().next().expect("the strip");
    -strip.panels()[0].watched[0].deflection
}
