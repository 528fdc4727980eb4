//! Natural frequencies of a panel in air, and its first wet period, known before the run (THEORY CO33).

use std::f64::consts::TAU;

use structure_fe::{Beam, Supports, natural_modes};

use crate::bodies::flexible::panel::{EndSpring, Panel, PanelSpec};
use crate::geometry::polyline::Polyline;

/// Elements with which the mode is found, at most: its period is then exact to 1e-5.
const ELEMENTS: usize = 24;

/// Wave number times length whose added mass is that of a rigid strip, pi rho L/8 on each face (Lamb 1932, art. 71) [-].
const RIGID: f64 = 8.0 / std::f64::consts::PI;

/// CO33: period of the first mode of a panel along a body's line, in water of a density [kg/m³] on one or both of its faces [s].
///
/// Its ends are held by a frame at rest. A panel on springs has at most the added mass of a rigid strip. The added mass ρ/k per face is that below a standing wave with the mode's wave number in
/// deep water (Lamb 1932, art. 228): walls, a floor, and a net volume that the mode displaces add to it, so that the period is a lower
/// bound.
pub fn first_wet_period(
    line: &Polyline,
    spec: &PanelSpec,
    (faces, density): (f64, f64),
) -> Result<f64, structure_fe::Error> {
    let spec = PanelSpec { elements: spec.elements.min(ELEMENTS), mesh: None, ..spec.clone() };
    let (panel, beam, supports) = held(line, &spec)?;
    let omega = natural_modes(&beam, &supports, 1)?[0].angular_frequency;
    let section = spec.section();
    let (stiffness, mass) = (section.bending_stiffness(&spec.material), section.mass_per_length(&spec.material));
    let of_mode = (mass * omega * omega / stiffness).powf(0.25);
    let sprung = spec.end_springs.iter().any(EndSpring::acts);
    let wave_number =
        if sprung { of_mode.max(RIGID / line.part(panel.reach[0], panel.reach[1]).length()) } else { of_mode };
    Ok(TAU / omega * (1.0 + faces * density / (wave_number * mass)).sqrt())
}

/// The lowest natural frequencies in air of a panel along a body's line, its ends held by a frame at rest, with its own elements [Hz].
pub fn natural_frequencies(line: &Polyline, spec: &PanelSpec, count: usize) -> Result<Vec<f64>, structure_fe::Error> {
    let (_, beam, supports) = held(line, spec)?;
    let modes = natural_modes(&beam, &supports, count)?;
    Ok(modes.iter().map(|mode| mode.angular_frequency / TAU).collect())
}

/// The elements of a panel, and its supports on a frame at rest.
pub(crate) fn held(line: &Polyline, spec: &PanelSpec) -> Result<(Panel, Beam, Supports), structure_fe::Error> {
    let (mut nodes, mut elements, mut supports) = (Vec::new(), Vec::new(), Supports::default());
    let spec = PanelSpec { rupture_strain: None, ..spec.clone() };
    let panel = Panel::along(line, &spec, &mut nodes, &mut elements);
    let beam = panel.formulate(Beam::new(nodes, elements)?)?;
    let (beam, frame) = beam.with_rigid_body(spec.span[0], 0.0, 0.0)?;
    supports.clamp(frame);
    panel.hold(frame, &beam, &mut supports);
    Ok((panel, beam, supports))
}

#[cfg(test)]
mod tests {
    use structure_fe::{Material, Theory};

    use crate::bodies::flexible::panel::{PanelEnd, Plane};

    use super::*;

    /// A rigid plate on springs across its ends: T = 2π √((mL + n πρL²/8)/(2k)).
    #[test]
    fn a_rigid_plate_on_springs_has_the_period_of_its_mass() {
        let line = Polyline::open(vec![[0.0, 0.0], [0.5, 0.0]]);
        let spring = EndSpring { stiffness: [1e7, 3e4, 0.0], damping: [0.0; 3] };
        let spec = PanelSpec {
            name: "plate".into(),
            span: [[0.0, 0.0], [0.5, 0.0]],
            elements: 10,
            mesh: None,
            thickness: 0.05,
            plane: Plane::Strain,
            material: Material { youngs_modulus: 1e13, poissons_ratio: 0.0, density: 2700.0 },
            theory: Theory::EulerBernoulli,
            plasticity: None,
            rupture_strain: None,
            allowable_stress: None,
            ends: [PanelEnd::Free; 2],
            end_springs: [spring; 2],
            watch: vec![0.5],
        };
        let mass = 0.5 * 0.05 * 2700.0 + 1000.0 * std::f64::consts::PI * 0.25 / 8.0;
        let exact = TAU * (mass / 6e4).sqrt();
        let found = first_wet_period(&line, &spec, (1.0, 1000.0)).expect("a period");
        assert!((found / exact - 1.0).abs() < 1e-4, "{found} s instead of {exact} s");
    }

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
                    mesh: None,
                    thickness: 0.01,
                    plane,
                    material,
                    theory: Theory::EulerBernoulli,
                    plasticity: None,
                    rupture_strain: Some(0.1),
                    allowable_stress: None,
                    ends,
                    end_springs: Default::default(),
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
