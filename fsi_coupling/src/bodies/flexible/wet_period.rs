//! The first wet period of a panel, known before the run (THEORY CO33).

use std::f64::consts::TAU;

use structure_fe::{Beam, Supports, natural_modes};

use crate::bodies::flexible::panel::{Panel, PanelSpec};
use crate::geometry::polyline::Polyline;

/// Elements with which the mode is found, at most: its period is then exact to 1e-5.
const ELEMENTS: usize = 24;

/// CO33: period of the first mode of a panel along a body's line, in water of a density [kg/m³] on so many of its faces [s].
///
/// Its ends are held by a frame at rest. The added mass ρ/k per face is that below a standing wave with the mode's wave number in
/// deep water (Lamb 1932, art. 228): walls, a floor, and a net volume that the mode displaces add to it, so that the period is a lower
/// bound.
pub fn first_wet_period(
    line: &Polyline,
    spec: &PanelSpec,
    (faces, density): (f64, f64),
) -> Result<f64, structure_fe::Error> {
    let (mut nodes, mut elements, mut supports) = (Vec::new(), Vec::new(), Supports::default());
    let spec = PanelSpec { elements: spec.elements.min(ELEMENTS), rupture_strain: None, ..spec.clone() };
    let panel = Panel::along(line, &spec, &mut nodes, &mut elements);
    let beam = panel.formulate(Beam::new(nodes, elements)?)?;
    let (beam, frame) = beam.with_rigid_body(spec.span[0], 0.0, 0.0)?;
    supports.clamp(frame);
    panel.hold(frame, &mut supports);
    let omega = natural_modes(&beam, &supports, 1)?[0].angular_frequency;
    let section = spec.section();
    let (stiffness, mass) = (section.bending_stiffness(&spec.material), section.mass_per_length(&spec.material));
    let wave_number = (mass * omega * omega / stiffness).powf(0.25);
    Ok(TAU / omega * (1.0 + faces * density / (wave_number * mass)).sqrt())
}

#[cfg(test)]
mod tests {
    use structure_fe::{Material, Theory};

    use crate::bodies::flexible::panel::{PanelEnd, Plane};

    use super::*;

    /// T = (2π/k²) √((m + n ρ/k)/D) with kL of the textbooks' beams, for every pair of ends, and E for E/(1 − ν²) in plane stress.
    #[test]
    fn a_straight_panel_has_the_period_of_its_mode() {
        use PanelEnd::{Clamped, Free, Guided, Mirror, Pinned, Sliding};
        let pi = std::f64::consts::PI;
        for (ends, root) in [
            ([Clamped, Clamped], 4.730_041),
            ([Clamped, Guided], 4.730_041),
            ([Guided, Clamped], 4.730_041),
            ([Sliding, Pinned], pi),
            ([Clamped, Pinned], 3.926_602),
            ([Pinned, Guided], 3.926_602),
            ([Clamped, Free], 1.875_104),
            ([Mirror, Sliding], 0.5 * pi),
        ] {
            for (plane, modulus) in [(Plane::Strain, 70e9 / 0.91), (Plane::Stress, 70e9)] {
                let line = Polyline::open(vec![[0.0, 0.0], [0.8, 0.0]]);
                let material = Material { youngs_modulus: 70e9, poissons_ratio: 0.3, density: 2700.0 };
                let spec = PanelSpec {
                    name: "plate".into(),
                    span: [[0.0, 0.0], [0.8, 0.0]],
                    elements: 100,
                    thickness: 0.01,
                    plane,
                    material,
                    theory: Theory::EulerBernoulli,
                    plasticity: None,
                    rupture_strain: Some(0.1),
                    allowable_stress: None,
                    ends,
                    watch: vec![0.5],
                };
                let k = root / 0.8;
                let exact = TAU / (k * k) * ((27.0 + 2.0 * 1000.0 / k) * 12.0 / (modulus * 1e-6)).sqrt();
                let found = first_wet_period(&line, &spec, (2.0, 1000.0)).expect("a period");
                assert!((found / exact - 1.0).abs() < 1e-4, "{ends:?} {plane:?}: {found} s instead of {exact} s");
            }
        }
    }
}
