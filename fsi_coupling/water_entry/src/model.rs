//! Models of water entry in order of cost.

use serde::{Deserialize, Serialize};

use super::similarity::DEADRISES;

/// Deadrises of wedges for boundary elements [deg].
pub const BOUNDARY_ELEMENT_DEADRISES: [f64; 2] = [10.0, 60.0];

/// A model of a body's entry into water.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum EntryModel {
    /// Added mass of a plate as wide as the body's cut with the still water (von Karman 1929).
    VonKarman,
    /// The same with the water's pile-up (Wagner 1932).
    Wagner,
    /// Modified Logvinovich model: Wagner's flow, the pressure's square terms, the body's shape (Korobkin 2004).
    Mlm,
    /// The exact flow about a wedge at constant speed (Dobrovolskaya 1969), and an added mass where the speed changes.
    Similarity,
    /// Fully nonlinear potential flow about a wedge, an arc of a circle or a polygon by boundary elements (Zhao & Faltinsen 1993): free motion, gravity,
    /// wet chines.
    BoundaryElement,
    /// Weakly compressible particles.
    Wcsph,
    /// Incompressible particles.
    Incompressible,
}

/// A case outside the range of a model.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{range}, not {what}: the next model that holds is \"{}\"", next.name())]
pub struct OutOfRange {
    /// The case.
    pub what: String,
    /// The range of the model.
    pub range: String,
    /// The next model whose range includes the case.
    pub next: EntryModel,
}

impl EntryModel {
    /// All models, the cheapest first.
    pub const ALL: [EntryModel; 7] = [
        EntryModel::VonKarman,
        EntryModel::Wagner,
        EntryModel::Mlm,
        EntryModel::Similarity,
        EntryModel::BoundaryElement,
        EntryModel::Wcsph,
        EntryModel::Incompressible,
    ];

    /// Its name in a scene.
    pub fn name(self) -> &'static str {
        match self {
            EntryModel::VonKarman => "von_karman",
            EntryModel::Wagner => "wagner",
            EntryModel::Mlm => "mlm",
            EntryModel::Similarity => "similarity",
            EntryModel::BoundaryElement => "boundary_element",
            EntryModel::Wcsph => "wcsph",
            EntryModel::Incompressible => "incompressible",
        }
    }

    /// True for a theory, false for a simulation with particles.
    pub fn is_theory(self) -> bool {
        self < EntryModel::Wcsph
    }

    /// True for a theory whose load follows from draught, speed and acceleration alone; false for a flow with a history.
    pub fn is_formula(self) -> bool {
        self < EntryModel::BoundaryElement
    }

    /// Range of the deadrise of a face [deg]; THEORY EN9 has the errors there.
    pub fn deadrises(self) -> [f64; 2] {
        match self {
            EntryModel::VonKarman | EntryModel::Wagner => [4.0, 45.0],
            EntryModel::Mlm => [4.0, 60.0],
            EntryModel::Similarity => DEADRISES,
            EntryModel::BoundaryElement => BOUNDARY_ELEMENT_DEADRISES,
            EntryModel::Wcsph | EntryModel::Incompressible => [4.0, 90.0],
        }
    }
}
