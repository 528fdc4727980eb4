//! What panels do now, and the extremes of a run so far.

use structure_fe::{Break, Range, SectionForces};

/// What a panel does at a place that is watched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Watched {
    /// The place: share of the panel's length [-].
    pub share: f64,
    /// Displacement against the rigid frame, in its axes [m].
    pub displacement: [f64; 2],
    /// Its part across the undeformed panel, to the left: away from the water along an outline [m].
    pub deflection: f64,
    /// Section forces of the element, between its ends' [N/m, N/m, N].
    pub section: SectionForces,
    /// Strain of the fibres at the left and right face, plastic strain included [-].
    pub strain: [f64; 2],
}

/// What a panel does now.
#[derive(Clone, Debug, PartialEq)]
pub struct PanelState {
    /// Its name.
    pub name: String,
    /// At the places that are watched.
    pub watched: Vec<Watched>,
    /// Load of the fluid on its nodes, in the axes of the rigid frame `[F_x, F_y, M]` [N/m, N/m, N].
    pub load: Vec<[f64; 3]>,
    /// Largest stress along it in an outer fibre at an element's end, by magnitude [Pa].
    pub stress: f64,
    /// Its extremes so far.
    pub worst: Worst,
    /// Its extremes so far at each of its nodes, from its start to its end.
    pub stations: Vec<Station>,
    /// Allowable stress [Pa]; `None` where none is given.
    pub allowable_stress: Option<f64>,
    /// Strain at which an end breaks off [-]; `None` where none is given.
    pub rupture_strain: Option<f64>,
    /// What has broken of it, in the order in which it did.
    pub ruptures: Vec<Break>,
}

/// Smallest and largest values at a node of a panel over the steps so far; of a node between two elements, in both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// Distance from the panel's start along its middle line [m].
    pub along: f64,
    /// Normal force [N/m].
    pub normal: Range,
    /// Shear force [N/m].
    pub shear: Range,
    /// Bending moment [N].
    pub moment: Range,
    /// Stress of outer fibres [Pa].
    pub stress: Range,
}

/// Smallest and largest values over a panel and over the steps so far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Worst {
    /// Normal force [N/m].
    pub normal: Range,
    /// Shear force [N/m].
    pub shear: Range,
    /// Bending moment [N].
    pub moment: Range,
    /// Stress of outer fibres [Pa].
    pub stress: Range,
    /// Their strain, plastic strain included [-].
    pub strain: Range,
    /// Allowable stress over the largest, or less by the rupture strain over the largest strain [-]. Of a panel that has yielded the rupture strain over the largest strain, or less by an allowable
    /// stress below its yield stress. `None` where no limit is given.
    pub reserve_factor: Option<f64>,
    /// Whether it has yielded anywhere.
    pub yielded: bool,
    /// Largest strain at the other end of the element of the largest, over it [-]: small where one element holds the whole hinge.
    pub strain_across: f64,
    /// Whether it stays within its limits; a panel that has yielded without a rupture strain does not. `None` where no limit is given.
    pub allowed: Option<bool>,
    /// Largest plastic curvature left in it now, by magnitude [1/m].
    pub plastic_curvature: f64,
}
