//! The state of a panel from its finite elements.

use structure_fe::{Dynamics, EndEnvelope, Envelope, PlasticStrains, Range, SectionForces, State};

use crate::bodies::bending::frame::in_frame;
use crate::bodies::bending::state::BendingState;
use crate::bodies::bending::surface_map::SurfaceMap;
use crate::bodies::flexible::panel::Panel;
use crate::bodies::panel_state::{PanelState, Station, Watched, Worst};
use crate::bodies::rigid_motion::RigidMotion;
use crate::geometry::vector::rotate;

/// What one panel does.
pub(crate) fn state_of(
    panel: &Panel,
    (dynamics, map): (&Dynamics, &SurfaceMap),
    state: &BendingState<State, Envelope>,
    frame: &RigidMotion,
) -> PanelState {
    let BendingState { motion: nodes, extremes: envelope, .. } = state;
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

/// Extremes of a panel at its nodes.
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
