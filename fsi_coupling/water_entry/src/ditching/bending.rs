//! Bending of a fuselage: its lowest natural modes (THEORY EN28).

use structure_fe::{BarSection, Beam, Dof, Element, Error, Material, Mode, Section, Supports, natural_modes};

use super::attitude::{Attitude, MODES};
use super::masses::Masses;

/// Mass of the beam itself over the masses that it carries [-].
const OWN_MASS: f64 = 1e-9;
/// Motions of a rigid body across the axis: up and pitch.
const RIGID: usize = 2;

/// The lowest bending modes of a free fuselage, each of unit modal mass.
#[derive(Clone, Debug, PartialEq)]
pub struct Bending {
    /// Places from the nose [m].
    pub x: Vec<f64>,
    /// Deflection upwards and its slope there, by mode [1/√kg, 1/(m √kg)], shape (n, modes, 2).
    pub shapes: Vec<[[f64; 2]; MODES]>,
    /// Angular frequencies [rad/s].
    pub frequency: [f64; MODES],
    /// Share of the critical damping [-].
    pub damping: f64,
}

impl Bending {
    /// EN28: of a free Euler–Bernoulli beam that carries `masses` and has the stiffness E I(x) [N m²].
    ///
    /// # Errors
    /// What the beam is refused for, in words.
    pub fn new(masses: &Masses, stiffness: impl Fn(f64) -> f64, damping: f64) -> Result<Bending, String> {
        modes_of(masses, stiffness).map_err(|e| e.to_string()).map(|modes| Bending {
            x: masses.x.clone(),
            shapes: (0..masses.x.len())
                .map(|k| std::array::from_fn(|mode| [modes[mode].shape[k][1], modes[mode].shape[k][2]]))
                .collect(),
            frequency: std::array::from_fn(|mode| modes[mode].angular_frequency),
            damping,
        })
    }

    /// Deflection per amplitude of each mode at a place from the nose [m], its slope and its second derivative, by cubics.
    pub fn at(&self, x: f64) -> [[f64; 3]; MODES] {
        let last = self.x.len() - 1;
        let k = self.x.partition_point(|at| *at <= x).clamp(1, last) - 1;
        let step = self.x[k + 1] - self.x[k];
        let t = ((x - self.x[k]) / step).clamp(0.0, 1.0);
        std::array::from_fn(|mode| {
            let ([y0, from], [y1, to]) = (self.shapes[k][mode], self.shapes[k + 1][mode]);
            let rise = (y1 - y0) / step;
            let (b, c) = (3.0 * rise - 2.0 * from - to, from + to - 2.0 * rise);
            [
                y0 + step * t * (from + t * (b + t * c)),
                from + t * (2.0 * b + 3.0 * t * c),
                (2.0 * b + 6.0 * t * c) / step,
            ]
        })
    }

    /// Elastic and damping forces on the modes.
    pub(super) fn restoring(&self, now: &Attitude) -> [f64; MODES] {
        std::array::from_fn(|k| {
            let frequency = self.frequency[k];
            -frequency * (frequency * now.bend[k] + 2.0 * self.damping * now.bend_rate[k])
        })
    }
}

/// The lowest modes of a free beam that are no motion of a rigid body.
fn modes_of(masses: &Masses, stiffness: impl Fn(f64) -> f64) -> Result<Vec<Mode>, Error> {
    let Masses { x, mass } = masses;
    let length = x[x.len() - 1] - x[0];
    let density = OWN_MASS * mass.iter().sum::<f64>() / length; // of an area of 1 m²
    let element = |k: usize| {
        let stiffness = stiffness(0.5 * (x[k] + x[k + 1]));
        let bar = BarSection { area: 1.0, second_moment: 1.0, shear_modulus: 1.0, fibres: [-1.0, 1.0] };
        let material = Material { youngs_modulus: stiffness, poissons_ratio: 0.0, density };
        Element { nodes: [k, k + 1], material, section: Section::bar(bar) }
    };
    let nodes = x.iter().map(|x| [*x, 0.0]).collect();
    let mut beam = Beam::new(nodes, (0..x.len() - 1).map(element).collect())?;
    let mut supports = Supports::default();
    for (node, mass) in mass.iter().enumerate() {
        supports.fix(node, Dof::U);
        if *mass > 0.0 {
            beam = beam.with_point_mass(node, *mass, 0.0)?;
        }
    }
    Ok(natural_modes(&beam, &supports, RIGID + MODES)?.split_off(RIGID))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A uniform free beam: ω² = k⁴ EI/μ with kL = 4.7300, 7.8532, 10.9956, 14.1372 (Rayleigh 1877).
    #[test]
    fn a_uniform_line_of_masses_has_the_frequencies_of_a_free_beam() {
        let (mass, length, stiffness) = (4e4_f64, 30.0_f64, 2e9_f64);
        let masses = Masses { x: (0..61).map(|k| 0.5 * f64::from(k)).collect(), mass: vec![0.0; 61] };
        let mass_at = |k: usize| mass / 60.0 * if k == 0 || k == 60 { 0.5 } else { 1.0 };
        let masses = Masses { mass: (0..61).map(mass_at).collect(), ..masses };
        let bending = Bending::new(&masses, |_| stiffness, 0.02).expect("modes");
        for (frequency, kl) in bending.frequency.iter().zip([4.7300, 7.8532, 10.9956, 14.1372]) {
            let exact = (kl / length).powi(2) * (stiffness * length / mass).sqrt();
            assert!((frequency / exact - 1.0).abs() < 5e-3, "{frequency}, exact {exact}");
        }
        let push: f64 = (0..61).map(|k| masses.mass[k] * bending.shapes[k][2][0]).sum();
        let turn: f64 = (0..61).map(|k| masses.mass[k] * masses.x[k] * bending.shapes[k][2][0]).sum();
        assert!(push.abs() < 1e-6 * mass.sqrt() && turn.abs() < 1e-5 * mass.sqrt(), "{push} {turn}");
    }
}
