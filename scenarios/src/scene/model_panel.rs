//! Panels of a body, in a resolved scene.

use fsi_coupling::{PanelEnd, PanelSpec};
use serde::{Deserialize, Serialize};
use structure_fe::{Material, Plasticity, Theory};

/// A part of the body's surface that bends.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Panel {
    /// A word that starts its columns in the series.
    pub name: String,
    /// Where it starts, on the outline or a plate's middle line [m, body's frame], shape (2).
    pub from: [f64; 2],
    /// Where it ends; along an outline counter-clockwise from the start [m].
    pub to: [f64; 2],
    /// Number of elements.
    pub elements: usize,
    /// Thickness [m].
    pub thickness: f64,
    /// Young's modulus [Pa].
    pub youngs_modulus: f64,
    /// Poisson's ratio [-].
    pub poissons_ratio: f64,
    /// Density [kg/m³].
    pub density: f64,
    /// How its ends are held.
    pub ends: [PanelEnd; 2],
    /// Beam theory.
    pub theory: TheoryName,
    /// Places that are reported, as shares of its length [-].
    pub watch: Vec<f64>,
    /// Yield stress of the tension test [Pa]; without one it stays elastic.
    pub yield_stress: Option<f64>,
    /// Hardening modulus beyond it [Pa].
    pub hardening_modulus: f64,
    /// Strain of an outer fibre at which an end breaks off [-]; without one neither does.
    pub rupture_strain: Option<f64>,
    /// Stress that it may bear, for the reserve factor [Pa].
    pub allowable_stress: Option<f64>,
}

/// Beam theories.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TheoryName {
    /// Sections stay square to the axis.
    #[default]
    EulerBernoulli,
    /// Sections shear.
    Timoshenko,
}

impl Panel {
    /// As the coupled system takes it.
    pub fn spec(&self) -> PanelSpec {
        PanelSpec {
            name: self.name.clone(),
            span: [self.from, self.to],
            elements: self.elements,
            thickness: self.thickness,
            material: self.material(),
            theory: match self.theory {
                TheoryName::EulerBernoulli => Theory::EulerBernoulli,
                TheoryName::Timoshenko => Theory::TIMOSHENKO,
            },
            ends: self.ends,
            watch: self.watch.clone(),
            plasticity: self.plasticity(),
            rupture_strain: self.rupture_strain,
            allowable_stress: self.allowable_stress,
        }
    }

    /// In plane strain bending yields at σ_y/√(1 − ν + ν²) (von Mises 1913).
    fn plasticity(&self) -> Option<Plasticity> {
        let nu = self.poissons_ratio;
        let yield_stress = self.yield_stress? / (1.0 - nu + nu * nu).sqrt();
        Some(Plasticity { yield_stress, hardening_modulus: self.hardening_modulus })
    }

    /// What it is made of.
    pub fn material(&self) -> Material {
        Material { youngs_modulus: self.youngs_modulus, poissons_ratio: self.poissons_ratio, density: self.density }
    }

    /// Names of its columns in the series.
    pub fn columns(&self) -> Vec<String> {
        let of = |share: &f64| WATCHED.map(|unit| format!("{}.at{}.{unit}", self.name, percent(*share)));
        self.watch.iter().flat_map(of).chain([format!("{}.stress_Pa", self.name)]).collect()
    }
}

/// Columns of a place that is watched.
const WATCHED: [&str; 6] = ["dx_m", "dy_m", "deflection_m", "moment_N", "strain_left", "strain_right"];

/// A share as a whole or broken per cent: 50, 12.5.
fn percent(share: f64) -> f64 {
    (1e6 * share).round() / 1e4
}
