//! A structure by its natural modes.

use fsi_coupling::SurfaceMode;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use structure_fe::modal::ModalMode;

/// The structure of a body by its natural modes, in place of panels; of a metre of span.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Modes {
    /// Nodes x, y along the outline (a polyline's middle line), counter-clockwise, body's frame [m]. Between the first and the last one
    /// the surface bends.
    pub nodes: Vec<[f64; 2]>,
    /// Mass that moves with each node [kg/m]. It links the modes with the motion of the body. absent: none, for modes of a structure
    /// that is free as a whole.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[schemars(inner(range(min = 0.0)))]
    pub masses: Vec<f64>,
    /// The modes of the structure on a body at rest, or of one that is free as a whole without its rigid motions.
    pub modes: Vec<NaturalMode>,
}

/// A natural mode.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NaturalMode {
    /// Natural frequency in air [Hz].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub frequency: f64,
    /// Generalised mass at the scale of the shape [kg/m].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub mass: f64,
    /// Damping over the critical one [-].
    #[serde(default)]
    #[schemars(range(min = 0.0, max = 1.0))]
    pub damping_ratio: f64,
    /// Displacement x, y and rotation of each node, body's frame [-, -, rad/m].
    pub shape: Vec<[f64; 3]>,
    /// Stress at each node at an amplitude of 1 mm [Pa/mm]. absent: not known.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub stress: Vec<f64>,
}

/// Amplitude at which the stress of a mode is given [m].
pub const MILLIMETRE: f64 = 1e-3;

/// Name of the results of a structure by its modes.
pub const MODES: &str = "modes";

impl Modes {
    /// Masses of all nodes [kg/m].
    pub fn all_masses(&self) -> Vec<f64> {
        if self.masses.is_empty() { vec![0.0; self.nodes.len()] } else { self.masses.clone() }
    }

    /// Whether the modes tell stresses.
    pub fn with_stress(&self) -> bool {
        self.modes.iter().all(|mode| !mode.stress.is_empty())
    }

    /// The modes, as the coupled system takes them.
    pub fn surface_modes(&self) -> Vec<SurfaceMode> {
        let mode = |m: &NaturalMode| SurfaceMode {
            mode: ModalMode {
                frequency: m.frequency,
                mass: m.mass,
                damping_ratio: m.damping_ratio,
                shape: m.shape.clone(),
            },
            stress: m.stress.iter().map(|stress| stress / MILLIMETRE).collect(),
        };
        self.modes.iter().map(mode).collect()
    }

    /// Names of its columns in the series.
    pub fn columns(&self) -> Vec<String> {
        let modes = (1..=self.modes.len()).map(|k| format!("{MODES}.amplitude{k}_m"));
        let stress = self.with_stress().then(|| format!("{MODES}.stress_Pa"));
        modes.chain([format!("{MODES}.displacement_m")]).chain(stress).collect()
    }
}
