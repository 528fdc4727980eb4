//! A wedge whose faces bend, entering at constant speed: dry modes of a plate strip on Wagner's load (THEORY EN12, EN13).

use std::f64::consts::{FRAC_PI_2, PI};

use faer::Mat;
use faer::linalg::solvers::Solve;
use structure_fe::{Material, Section};

/// Points on a quarter of the circle x = c cos θ, for Simpson's rule: even.
const POINTS: usize = 48;
/// Odd orders of sin kθ in the potential.
const ORDERS: usize = 16;

/// How an end of a face is held; its membrane force is zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Held {
    /// Free to turn.
    Pinned,
    /// Not.
    Clamped,
}

/// A symmetric wedge with elastic faces on its way into the water, at constant speed and without gravity.
#[derive(Clone, Debug, PartialEq)]
pub struct ElasticWedge {
    /// Deadrise β [deg].
    pub deadrise_deg: f64,
    /// Downward speed of keel and chines V [m/s].
    pub speed: f64,
    /// Density of the water ρ [kg/m³].
    pub density: f64,
    /// Length of a face L, taken as its half breadth [m].
    pub length: f64,
    /// Thickness of a face [m].
    pub thickness: f64,
    /// Cross-section of a face, one metre wide.
    pub section: Section,
    /// What it is made of.
    pub material: Material,
    /// How it is held, at keel and chine.
    pub held: [Held; 2],
    /// Number of modes.
    pub modes: usize,
    /// Number of steps of c, from touch to chine.
    pub steps: usize,
}

/// The wedge at a moment.
#[derive(Clone, Debug, PartialEq)]
pub struct WedgeState {
    /// Time since the touch [s].
    pub time: f64,
    /// Half width of the wetted bottom c [m].
    pub wetted: f64,
    /// Amplitudes of the modes [m], away from the water.
    pub amplitudes: Vec<f64>,
    /// Their rates [m/s].
    pub rates: Vec<f64>,
}

/// A mode of the face: kL, and 1 − σ where an end is clamped (EN12).
#[derive(Clone, Copy, Debug)]
struct Mode {
    held: [Held; 2],
    root: f64,
    defect: f64,
}

impl Mode {
    fn new(held: [Held; 2], n: usize) -> Mode {
        let order = n as f64;
        // cos kL cosh kL = 1 or tan kL = tanh kL: a function with that zero and its slope, and a start for Newton's method
        type Slope = fn(f64) -> [f64; 2];
        let (start, of): (f64, Slope) = match held {
            [Held::Pinned, Held::Pinned] => return Mode { held, root: order * PI, defect: 0.0 },
            [Held::Clamped, Held::Clamped] => {
                (order + 0.5, |z| [z.cos() - 1.0 / z.cosh(), -z.sin() + z.tanh() / z.cosh()])
            }
            _ => (order + 0.25, |z| [z.sin() - z.cos() * z.tanh(), z.cos() * z.tanh().powi(2) + z.sin() * z.tanh()]),
        };
        let mut root = start * PI;
        for _ in 0..20 {
            let [value, slope] = of(root);
            root -= value / slope;
        }
        Mode { held, root, defect: (root.cos() - root.sin() - (-root).exp()) / (root.sinh() - root.sin()) }
    }

    /// ψ at x/L.
    fn shape(&self, s: f64) -> f64 {
        match self.held {
            [Held::Pinned, Held::Pinned] => (self.root * s).sin(),
            [Held::Pinned, Held::Clamped] => self.clamped_shape(1.0 - s),
            [Held::Clamped, _] => self.clamped_shape(s),
        }
    }

    /// ψ at a distance from a clamped end, over L.
    fn clamped_shape(&self, s: f64) -> f64 {
        let z = self.root * s;
        (-z).exp() + self.defect * z.sinh() - z.cos() + (1.0 - self.defect) * z.sin()
    }

    /// L² d²ψ/dx².
    fn bend(&self, s: f64) -> f64 {
        let over = match self.held {
            [Held::Pinned, Held::Pinned] => -(self.root * s).sin(),
            [Held::Pinned, Held::Clamped] => self.clamped_bend(1.0 - s),
            [Held::Clamped, _] => self.clamped_bend(s),
        };
        self.root * self.root * over
    }

    fn clamped_bend(&self, s: f64) -> f64 {
        let z = self.root * s;
        (-z).exp() + self.defect * z.sinh() + z.cos() - (1.0 - self.defect) * z.sin()
    }

    /// ∫ψ² dx/L.
    fn norm(held: [Held; 2]) -> f64 {
        if held == [Held::Pinned; 2] { 0.5 } else { 1.0 }
    }
}

/// EN13: what the modes do to the water at a wetted half width.
struct Wet {
    /// S_mn = ∫₀^c φ_n ψ_m dx [m²].
    added: Mat<f64>,
    /// f_m = ∫₀^c √(c² − x²) ψ_m dx [m²].
    pushed: Vec<f64>,
    /// (2/π) ∫ ψ_m(c sin θ) dθ over a quarter [-].
    lifted: Vec<f64>,
}

impl ElasticWedge {
    /// From the touch until the chine is wet, at steps of equal c: the classical Runge–Kutta method in c (EN13).
    ///
    /// `None` where the face bends so fast that the water does not advance on it, as the wetted width is no measure of time then, and
    /// where steps are too long for the stiffest mode (ω Δt < 2.8).
    pub fn enter(&self) -> Option<Vec<WedgeState>> {
        let modes = self.modes();
        let n = modes.len();
        let dc = self.length / self.steps as f64;
        // time, amplitudes, momenta
        let mut state = vec![0.0; 1 + 2 * n];
        let mut bent = vec![WedgeState { time: 0.0, wetted: 0.0, amplitudes: vec![0.0; n], rates: vec![0.0; n] }];
        for step in 0..self.steps {
            let c = dc * step as f64;
            let ahead = |k: &[f64], by: f64| -> Vec<f64> { state.iter().zip(k).map(|(s, k)| s + by * k).collect() };
            let k1 = self.slope(&modes, c, &state)?;
            let k2 = self.slope(&modes, c + 0.5 * dc, &ahead(&k1, 0.5 * dc))?;
            let k3 = self.slope(&modes, c + 0.5 * dc, &ahead(&k2, 0.5 * dc))?;
            let k4 = self.slope(&modes, c + dc, &ahead(&k3, dc))?;
            for (i, value) in state.iter_mut().enumerate() {
                *value += dc / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]);
            }
            let wet = self.wet(&modes, c + dc);
            let rates = self.rates(&wet, &state[1 + n..]);
            bent.push(WedgeState { time: state[0], wetted: c + dc, amplitudes: state[1..=n].to_vec(), rates });
        }
        Some(bent)
    }

    /// Deflection at x/L, away from the water [m].
    pub fn deflection(&self, bent: &WedgeState, share: f64) -> f64 {
        self.modes().iter().zip(&bent.amplitudes).map(|(m, a)| a * m.shape(share)).sum()
    }

    /// Strain −½ t d²w/dx² of the outer fibre there [-].
    pub fn strain(&self, bent: &WedgeState, share: f64) -> f64 {
        let bend: f64 = self.modes().iter().zip(&bent.amplitudes).map(|(m, a)| a * m.bend(share)).sum();
        -0.5 * self.thickness * bend / (self.length * self.length)
    }

    fn modes(&self) -> Vec<Mode> {
        (1..=self.modes).map(|n| Mode::new(self.held, n)).collect()
    }

    /// EN13: d(t, a, P)/dc.
    fn slope(&self, modes: &[Mode], c: f64, state: &[f64]) -> Option<Vec<f64>> {
        let n = modes.len();
        let (amplitudes, momenta) = state[1..].split_at(n);
        let wet = self.wet(modes, c);
        let rates = self.rates(&wet, momenta);
        // EN13, its derivative: V dt = (2/π) tan β dc + d(Σ a_n lifted_n)
        let small = 1e-5 * self.length;
        let [less, more] = [c - small, c + small].map(|c| self.lifted(modes, c.abs()));
        let steeper: f64 = (0..n).map(|k| amplitudes[k] * (more[k] - less[k]) / (2.0 * small)).sum();
        let rising: f64 = rates.iter().zip(&wet.lifted).map(|(rate, lifted)| rate * lifted).sum();
        let advance = 2.0 / PI * self.deadrise_deg.to_radians().tan() + steeper;
        let dt = advance / (self.speed - rising);
        if !(dt > 0.0 && dt.is_finite()) {
            return None;
        }
        let stiffness = self.section.bending_stiffness(&self.material) * Mode::norm(self.held);
        let sprung = |(m, a): (&Mode, &f64)| -stiffness * m.root.powi(4) / self.length.powi(3) * a * dt;
        let motion = rates.iter().map(|rate| rate * dt);
        Some(std::iter::once(dt).chain(motion).chain(modes.iter().zip(amplitudes).map(sprung)).collect())
    }

    /// EN13: (m G + ρ S) ȧ = P + ρ V f.
    fn rates(&self, wet: &Wet, momenta: &[f64]) -> Vec<f64> {
        let n = momenta.len();
        let mass = self.section.mass_per_length(&self.material) * Mode::norm(self.held) * self.length;
        let matrix = Mat::from_fn(n, n, |i, j| self.density * wet.added[(i, j)] + if i == j { mass } else { 0.0 });
        let right = Mat::from_fn(n, 1, |i, _| momenta[i] + self.density * self.speed * wet.pushed[i]);
        matrix.partial_piv_lu().solve(&right).col(0).iter().copied().collect()
    }

    /// EN13 with x = c cos θ: φ_n = Σ b_k sin kθ over odd k, b_k = (4c/πk) ∫ ψ_n sin θ sin kθ dθ over a quarter.
    fn wet(&self, modes: &[Mode], c: f64) -> Wet {
        let n = modes.len();
        let angles = (0..=POINTS).map(|p| FRAC_PI_2 * p as f64 / POINTS as f64);
        let mut orders = vec![[0.0; ORDERS]; n];
        for (p, angle) in angles.enumerate() {
            let weight = simpson(p) * angle.sin();
            let sines: [f64; ORDERS] = std::array::from_fn(|j| weight * ((2 * j + 1) as f64 * angle).sin());
            for (mode, b) in modes.iter().zip(&mut orders) {
                let shape = mode.shape(c * angle.cos() / self.length);
                (0..ORDERS).for_each(|j| b[j] += shape * sines[j]);
            }
        }
        for b in &mut orders {
            (0..ORDERS).for_each(|j| b[j] *= 4.0 * c / (PI * (2 * j + 1) as f64));
        }
        let between =
            |i: usize, j: usize| (0..ORDERS).map(|k| (2 * k + 1) as f64 * orders[i][k] * orders[j][k]).sum::<f64>();
        Wet {
            added: Mat::from_fn(n, n, |i, j| 0.25 * PI * between(i, j)),
            pushed: orders.iter().map(|b| 0.25 * PI * c * b[0]).collect(),
            lifted: self.lifted(modes, c),
        }
    }

    fn lifted(&self, modes: &[Mode], c: f64) -> Vec<f64> {
        let at = |p: usize| c * (FRAC_PI_2 * p as f64 / POINTS as f64).sin() / self.length;
        let mean = |m: &Mode| 2.0 / PI * (0..=POINTS).map(|p| simpson(p) * m.shape(at(p))).sum::<f64>();
        modes.iter().map(mean).collect()
    }

    /// Momentum of the water on both sides, −ρ∫φ dx [N s/m]: its rate is the force on the wedge. ∫φ_n dx is f_n by reciprocity.
    pub fn momentum(&self, bent: &WedgeState) -> f64 {
        let c = bent.wetted;
        let pushed = self.wet(&self.modes(), c).pushed;
        let bending: f64 = pushed.iter().zip(&bent.rates).map(|(f, rate)| f * rate).sum();
        2.0 * self.density * (0.25 * PI * c * c * self.speed - bending)
    }

    /// EN13: potential on the face at x [m], over which p = −ρ dφ/dt [m²/s].
    pub fn potential(&self, bent: &WedgeState, x: f64) -> f64 {
        let c = bent.wetted;
        if x >= c {
            return 0.0;
        }
        let angle = (x / c).acos();
        let modes = self.modes();
        let bending: f64 = modes.iter().zip(&bent.rates).map(|(m, rate)| rate * self.single(m, c, angle)).sum();
        bending - self.speed * c * angle.sin()
    }

    /// φ of one mode at an angle.
    fn single(&self, mode: &Mode, c: f64, at: f64) -> f64 {
        let order = |j: usize| {
            let k = (2 * j + 1) as f64;
            let part = |p: usize| {
                let angle = FRAC_PI_2 * p as f64 / POINTS as f64;
                simpson(p) * angle.sin() * (k * angle).sin() * mode.shape(c * angle.cos() / self.length)
            };
            4.0 * c / (PI * k) * (0..=POINTS).map(part).sum::<f64>() * (k * at).sin()
        };
        (0..ORDERS).map(order).sum()
    }
}

/// Simpson's weights on a quarter of the circle.
fn simpson(point: usize) -> f64 {
    let step = FRAC_PI_2 / POINTS as f64 / 3.0;
    match point {
        0 | POINTS => step,
        odd if odd % 2 == 1 => 4.0 * step,
        _ => 2.0 * step,
    }
}

#[cfg(test)]
mod tests {
    use structure_fe::{Beam, Dof, Supports, natural_modes};

    use super::*;

    /// EN12: the modes of each pair of ends are those of a beam of finite elements, and G is their norm.
    #[test]
    fn modes_of_mixed_ends_are_those_of_a_beam() {
        const ELEMENTS: usize = 60;
        let material = Material { youngs_modulus: 1.0, poissons_ratio: 0.0, density: 1.0 };
        let section = Section::strip(1e-2);
        let omega_of_one = (section.bending_stiffness(&material) / section.mass_per_length(&material)).sqrt();
        for held in [
            [Held::Pinned, Held::Pinned],
            [Held::Clamped, Held::Clamped],
            [Held::Clamped, Held::Pinned],
            [Held::Pinned, Held::Clamped],
        ] {
            let beam = Beam::straight([0.0; 2], [1.0, 0.0], ELEMENTS, material, section).expect("a beam");
            let mut supports = Supports::default();
            for (node, end) in [0, ELEMENTS].into_iter().zip(held) {
                supports.pin(node);
                if end == Held::Clamped {
                    supports.fix(node, Dof::Theta);
                }
            }
            let exact = natural_modes(&beam, &supports, 4).expect("modes");
            for (n, exact) in (1..=4).zip(&exact) {
                let mode = Mode::new(held, n);
                let (found, wanted) = (mode.root.powi(2) * omega_of_one, exact.angular_frequency);
                assert!((found / wanted - 1.0).abs() < 1e-4, "{held:?} {n}: {found} {wanted}");
                let at = |node: usize| mode.shape(node as f64 / ELEMENTS as f64);
                let norm = (1..ELEMENTS).map(|node| at(node).powi(2)).sum::<f64>() / ELEMENTS as f64;
                assert!((norm / Mode::norm(held) - 1.0).abs() < 1e-3, "{held:?} {n}: {norm}");
                // the same shape: its angle to the other in the space of nodes
                let along: f64 = (0..=ELEMENTS).map(|node| at(node) * exact.shape[node][1]).sum();
                let own: f64 = (0..=ELEMENTS).map(|node| at(node).powi(2)).sum();
                let other: f64 = exact.shape.iter().map(|q| q[1].powi(2)).sum();
                assert!((along.powi(2) / (own * other) - 1.0).abs() < 1e-6, "{held:?} {n}");
                let h = 1e-3;
                let bend = (mode.shape(0.3 + h) - 2.0 * mode.shape(0.3) + mode.shape(0.3 - h)) / (h * h);
                assert!((bend - mode.bend(0.3)).abs() < 1e-4 * mode.root.powi(2), "{held:?} {n}: {bend}");
            }
        }
    }
}
