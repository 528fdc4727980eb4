//! The natural modes of a panel in air, with what a modal model needs of it.

use std::f64::consts::TAU;

use structure_fe::modal::ModalMode;
use structure_fe::{Damping, Dynamics, Integration, Mode, natural_modes};

use crate::bodies::bending::surface_mode::SurfaceMode;
use crate::bodies::flexible::panel::PanelSpec;
use crate::bodies::flexible::wet_period::held;
use crate::geometry::polyline::Polyline;

/// Displacement at which stresses of a shape are taken, over the length of the panel [-]: the element is linear there to about as much.
const SMALL: f64 = 1e-7;

/// What the nodes' masses carry in a mode over its generalised mass, at most: above it the elements are too long for the mode [-].
const RESOLVED: f64 = 1.2;

/// A panel by its modes, of a metre of span.
#[derive(Clone, Debug, PartialEq)]
pub struct PanelModes {
    /// Its nodes [m, body's frame].
    pub nodes: Vec<[f64; 2]>,
    /// Masses that move with them [kg/m]: half of each element next to a node.
    pub masses: Vec<f64>,
    /// Its lowest modes that its elements resolve, scaled to a largest displacement of 1; stress of the outer fibre to the right, which along an outline is wet.
    pub modes: Vec<SurfaceMode>,
}

impl PanelModes {
    /// Of the `count` lowest modes of a panel those that its elements resolve; along a body's line, its ends held by a frame at rest, with Rayleigh
    /// damping.
    ///
    /// # Errors
    /// Those of the panel's finite elements.
    pub fn of(
        line: &Polyline,
        spec: &PanelSpec,
        count: usize,
        damping: Damping,
    ) -> Result<PanelModes, structure_fe::Error> {
        let spec = PanelSpec { plasticity: None, ..spec.clone() };
        let (_, beam, supports) = held(line, &spec)?;
        let found = natural_modes(&beam, &supports, count)?;
        let (nodes, elements) = spec.elements_along(line);
        let mut masses = vec![0.0; nodes.len()];
        for (k, element) in elements.iter().enumerate() {
            let half = 0.5 * beam.length(k) * element.section.mass_per_length(&element.material);
            element.nodes.iter().for_each(|node| masses[*node] += half);
        }
        let rule = Integration::Trapezoidal { spectral_radius: 1.0 };
        let dynamics = Dynamics::new(beam, supports, rule, Damping::default())?;
        let length = line.length();
        let mode = |mode: &Mode| {
            let shape = &mode.shape[..nodes.len()];
            let largest = shape.iter().map(|[u, v, _]| u.hypot(*v)).fold(f64::MIN_POSITIVE, f64::max);
            let omega = mode.angular_frequency;
            let mut state = dynamics.at_rest();
            let small = SMALL * length / largest;
            state.displacement = mode.shape.iter().map(|q| q.map(|q| small * q)).collect();
            let forces = dynamics.section_forces(&state);
            let at_end = |end: usize| {
                let section = &elements[end / 2].section;
                forces[end].fibre_stress(section, section.fibres()[0]) / (SMALL * length)
            };
            // node k is the second end of element k − 1 and the first of element k
            let stress = |k: usize| {
                let ends = (2 * k).saturating_sub(1)..(2 * k + 1).min(2 * elements.len());
                let count = ends.len() as f64;
                ends.map(at_end).sum::<f64>() / count
            };
            SurfaceMode {
                mode: ModalMode {
                    frequency: omega / TAU,
                    mass: largest.powi(-2),
                    damping_ratio: 0.5 * (damping.mass / omega + damping.stiffness * omega),
                    shape: shape.iter().map(|q| q.map(|q| q / largest)).collect(),
                },
                stress: (0..nodes.len()).map(stress).collect(),
            }
        };
        let resolved = |mode: &SurfaceMode| {
            let squares = mode.mode.shape.iter().map(|[u, v, _]| u * u + v * v);
            let carried: f64 = masses.iter().zip(squares).map(|(m, square)| m * square).sum();
            carried <= RESOLVED * mode.mode.mass
        };
        let modes = found.iter().map(mode).filter(resolved).collect();
        Ok(PanelModes { masses, modes, nodes })
    }
}
