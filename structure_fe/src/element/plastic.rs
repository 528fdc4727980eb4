//! The constants and the state of an element that yields by force and moment together (THEORY BE25).

use serde::{Deserialize, Serialize};

use crate::material::{LAYERS, Layers, Material, Plasticity, Section, YieldLaw};

/// Plastic strains of an element, of each layer along the element and across the plane \[-\].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PlasticStrains {
    /// Of the layers at both Gauss points.
    pub(super) layers: [[[f64; 2]; LAYERS]; 2],
    /// Of the right and the left outer fibre at both ends.
    pub(super) fibres: [[[f64; 2]; 2]; 2],
}

impl PlasticStrains {
    pub(crate) const NONE: Self = Self { layers: [[[0.0; 2]; LAYERS]; 2], fibres: [[[0.0; 2]; 2]; 2] };

    /// Whether a layer or an outer fibre has yielded.
    pub fn has_yielded(&self) -> bool {
        let all = self.layers.as_flattened().iter().chain(self.fibres.as_flattened());
        all.flatten().any(|strain| *strain != 0.0)
    }
}

/// The constants of an element that yields.
#[derive(Debug, Clone)]
pub(crate) struct PlasticElement {
    pub law: YieldLaw,
    pub layers: Layers,
    pub fibres: [f64; 2],
    /// E I \[N m^2\].
    pub bending_stiffness: f64,
    pub length: f64,
    /// 1, or 0 in an element with an axial release: its layers do not stretch with its axis.
    pub axial: f64,
}

impl PlasticElement {
    /// None for a profile without layers ([`Layers::new`]).
    pub fn new(
        (material, section): (&Material, &Section),
        plasticity: &Plasticity,
        length: f64,
        slides: bool,
    ) -> Option<Self> {
        Some(Self {
            law: YieldLaw::new(material, section, plasticity),
            layers: Layers::new(section)?,
            fibres: section.fibres(),
            bending_stiffness: section.bending_stiffness(material),
            length,
            axial: if slides { 0.0 } else { 1.0 },
        })
    }
}
