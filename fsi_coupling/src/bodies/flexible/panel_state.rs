//! What panels do now, and what they have borne so far.

use structure_fe::{Break, Dynamics, EndEnvelope, Envelope, PlasticStrains, Range, SectionForces, State};

use crate::bodies::flexible::panel::Panel;
use crate::bodies::flexible::state::FlexibleState;
use crate::bodies::flexible::surface_map::SurfaceMap;
use crate::bodies::rigid_motion::RigidMotion;
use crate::geometry::vector::rotate;

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
    /// What it has borne so far.
    pub worst: Worst,
    /// What it has borne so far at each of its nodes, from its start to its end.
    pub stations: Vec<Station>,
    /// Stress that it may bear [Pa]; `None` where none is given.
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

/// What one panel does.
pub(crate) fn state_of(
    panel: &Panel,
    (dynamics, map): (&Dynamics, &SurfaceMap),
    state: &FlexibleState,
    frame: &RigidMotion,
) -> PanelState {
    let FlexibleState { nodes, envelope, .. } = state;
    let (sections, fibres) = (dynamics.section_forces(nodes), dynamics.fibres(nodes));
    let still = vec![[0.0; 3]; nodes.displacement.len()];
    let watched = panel.spec.watch.iter().map(|&share| {
        let (element, t) = panel.element_at(share);
        let point = map.surface.on_element(element, t);
        let (at, rest) = (map.surface.place(&point, &nodes.displacement), map.surface.place(&point, &still));
        // the point under the motion of the frame alone
        let rigid = map.place(&map.on_frame(rest.at, rest.normal), &nodes.displacement);
        let moved = [0, 1].map(|k| at.at[k] - rigid.at[k]);
        let [first, second] = [2 * element, 2 * element + 1];
        let [right, left] = [0, 1]
            .map(|side| fibres[first].strain[side] + t * (fibres[second].strain[side] - fibres[first].strain[side]));
        Watched {
            share,
            displacement: rotate(moved, -frame.angle),
            deflection: moved[0] * rigid.normal[0] + moved[1] * rigid.normal[1],
            section: between(&sections[first], &sections[second], t),
            strain: [left, right],
        }
    });
    PanelState {
        name: panel.spec.name.clone(),
        watched: watched.collect(),
        load: state.now[panel.nodes.clone()].iter().map(|load| in_frame(load, frame.angle)).collect(),
        stress: panel.stress(&fibres),
        worst: worst(panel, dynamics, nodes, envelope),
        stations: stations(panel, dynamics, envelope),
        allowable_stress: panel.spec.allowable_stress,
        rupture_strain: panel.spec.rupture_strain,
        ruptures: nodes.ruptures.iter().filter(|rupture| panel.nodes.contains(&rupture.node)).copied().collect(),
    }
}

/// A load in the axes of a frame at an angle.
fn in_frame([x, y, moment]: &[f64; 3], angle: f64) -> [f64; 3] {
    let [x, y] = rotate([*x, *y], -angle);
    [x, y, *moment]
}

fn worst(panel: &Panel, dynamics: &Dynamics, nodes: &State, envelope: &Envelope) -> Worst {
    let ends = &envelope.ends[2 * panel.elements.start..2 * panel.elements.end];
    let over = |of: fn(&EndEnvelope) -> Range| ends[1..].iter().map(of).fold(of(&ends[0]), wider);
    let stress = over(|end| end.fibre_stress);
    let yielded = nodes.plastic.get(panel.elements.clone()).into_iter().flatten().any(PlasticStrains::has_yielded);
    let plastic = dynamics.plastic_curvatures(nodes).into_iter().enumerate();
    let plastic = plastic.filter(|(element, _)| panel.elements.contains(element)).flat_map(|(_, kappa)| kappa);
    let strain = over(|end| end.fibre_strain);
    let spec = &panel.spec;
    let by_stress = spec.allowable_stress.map(|allowable| allowable / stress.largest());
    let by_strain = spec.rupture_strain.map(|limit| limit / strain.largest());
    let reserve_factor = match spec.plasticity.filter(|_| yielded) {
        None => by_stress.into_iter().chain(by_strain).reduce(f64::min),
        // beyond yield a stress is no measure but against a lower limit
        Some(law) => {
            let is_below = |allowable: &f64| *allowable < law.yield_stress;
            let factors = by_stress.filter(|_| spec.allowable_stress.as_ref().is_some_and(is_below)).into_iter();
            factors.chain(by_strain).reduce(f64::min)
        }
    };
    let is_limited = spec.allowable_stress.is_some() || spec.rupture_strain.is_some();
    Worst {
        normal: over(|end| end.normal),
        shear: over(|end| end.shear),
        moment: over(|end| end.moment),
        stress,
        strain,
        strain_across: strain_across(ends),
        reserve_factor,
        allowed: reserve_factor.map(|factor| factor >= 1.0).or((yielded && is_limited).then_some(false)),
        yielded,
        plastic_curvature: plastic.fold(0.0, |most, kappa| f64::max(most, kappa.abs())),
    }
}

/// Largest strain at the other end of the element of the largest, over it [-].
fn strain_across(ends: &[EndEnvelope]) -> f64 {
    let largest = |end: &EndEnvelope| end.fibre_strain.largest();
    let steepest = ends.chunks_exact(2).map(|pair| [largest(&pair[0]), largest(&pair[1])]);
    let steepest = steepest.max_by(|a, b| a[0].max(a[1]).total_cmp(&b[0].max(b[1])));
    steepest.map_or(1.0, |[a, b]| a.min(b) / a.max(b))
}

/// What a panel has borne at its nodes.
fn stations(panel: &Panel, dynamics: &Dynamics, envelope: &Envelope) -> Vec<Station> {
    let nodes = &dynamics.beam().nodes()[panel.nodes.clone()];
    let ends = &envelope.ends[2 * panel.elements.start..2 * panel.elements.end];
    let mut along = 0.0;
    let station = |k: usize| {
        if k > 0 {
            along += (nodes[k][0] - nodes[k - 1][0]).hypot(nodes[k][1] - nodes[k - 1][1]);
        }
        // node k is the second end of element k − 1 and the first of element k
        let sides = &ends[(2 * k).saturating_sub(1)..(2 * k + 1).min(ends.len())];
        let over = |of: fn(&EndEnvelope) -> Range| sides[1..].iter().map(of).fold(of(&sides[0]), wider);
        Station {
            along,
            normal: over(|end| end.normal),
            shear: over(|end| end.shear),
            moment: over(|end| end.moment),
            stress: over(|end| end.fibre_stress),
        }
    };
    (0..nodes.len()).map(station).collect()
}

/// The range that holds two.
fn wider(a: Range, b: Range) -> Range {
    let mut both = a;
    if b.least < a.least {
        (both.least, both.time_of_least) = (b.least, b.time_of_least);
    }
    if b.most > a.most {
        (both.most, both.time_of_most) = (b.most, b.time_of_most);
    }
    both
}

/// Section forces a share t of the way from an element's first end to its second.
fn between(first: &SectionForces, second: &SectionForces, t: f64) -> SectionForces {
    let mix = |a: f64, b: f64| a + t * (b - a);
    SectionForces {
        normal: mix(first.normal, second.normal),
        shear: mix(first.shear, second.shear),
        moment: mix(first.moment, second.moment),
    }
}
