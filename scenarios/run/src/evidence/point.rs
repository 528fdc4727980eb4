//! A number of the program beside a reference, and where the reference comes from.

use scene::reference::about;
use scene::{Bottom, Scene};
use serde::{Deserialize, Serialize};

use super::quantity::Quantity;

/// What a reference is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Nature {
    /// An exact solution, to rounding or to a stated number of digits.
    #[default]
    Exact,
    /// Another computation: boundary elements, another program, an approximate theory.
    Computation,
    /// A measurement.
    Experiment,
}

impl Nature {
    /// All.
    pub const ALL: [Nature; 3] = [Nature::Exact, Nature::Computation, Nature::Experiment];

    /// On a page.
    pub fn title(self) -> &'static str {
        match self {
            Nature::Exact => "exact",
            Nature::Computation => "computation",
            Nature::Experiment => "experiment",
        }
    }
}

/// What is known of a reference.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Pedigree {
    /// What it is.
    pub nature: Nature,
    /// Its relative standard uncertainty u_D [-]; absent where it is not known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub uncertainty: Option<f64>,
}

impl Pedigree {
    /// Of a table, from the lines `nature:` and `uncertainty:` of its header; of a source that is no table, as of an exact solution.
    pub fn of(source: &str) -> Pedigree {
        let path = source.split([',', ';', ' ']).next().unwrap_or_default();
        let about = about(path);
        let line = |key: &str| about.iter().find_map(|line| line.strip_prefix(key)).map(str::trim);
        let nature = match line("nature:") {
            Some(words) if words.starts_with("experiment") => Nature::Experiment,
            Some(words) if words.starts_with("exact") => Nature::Exact,
            Some(_) => Nature::Computation,
            None => Nature::Exact,
        };
        let given = line("uncertainty:").and_then(|words| words.split(' ').next()?.parse().ok());
        Pedigree { nature, uncertainty: given.or((nature == Nature::Exact).then_some(0.0)) }
    }
}

/// Where a point lies: what its run was.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Setup {
    /// Deadrise [deg], of bodies with straight faces that enter, and of planing hulls.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub deadrise_deg: Option<f64>,
    /// Speed at contact [m/s], of bodies that enter; speed of a planing hull.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub speed: Option<f64>,
    /// Spacings in the draught at the peak, or at the end of the run where that is less, of bodies that enter a water of particles [-].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spacings: Option<f64>,
}

impl Setup {
    /// Of a scene; empty without a body that enters.
    pub fn of(scene: &Scene) -> Setup {
        let Some(entry) = scene.entry() else { return Setup::default() };
        let deadrise = match entry.bottom {
            Bottom::Wedge { slope } => Some(slope.atan().to_degrees()),
            Bottom::Arc { .. } => None,
        };
        let draught = entry.peak_draught.min(entry.final_draught);
        let spacings = (!scene.model.is_theory() && draught > 0.0).then(|| draught / scene.resolution.spacing);
        Setup { deadrise_deg: deadrise, speed: Some(entry.speed), spacings }
    }
}

/// A number of the program beside a reference.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// What is compared.
    pub quantity: Quantity,
    /// The case: points of a case are not independent.
    pub case: String,
    /// The number's path, or the comparison's text.
    pub number: String,
    /// The model that was run.
    pub model: String,
    /// Ours over theirs; of a curve 1 + M (THEORY GE27) [-].
    pub ratio: f64,
    /// Score C of a curve (GE27) [-].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub waveform: Option<f64>,
    /// Relative numerical uncertainty u_num of the run, where it states one [-].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub numerical: Option<f64>,
    /// Where it lies.
    #[serde(default)]
    pub setup: Setup,
    /// The reference.
    #[serde(flatten)]
    pub reference: Pedigree,
}

impl Point {
    /// GE28: u_val, from u_num and u_D; the input is that of the reference, without uncertainty (ASME V&V 20-2009) [-].
    pub fn validation_uncertainty(&self) -> Option<f64> {
        Some(self.numerical?.hypot(self.reference.uncertainty?))
    }
}
