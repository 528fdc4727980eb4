//! Linear theory of a heaving box in water of finite depth, as a reference solution. It shares no code with the program.
//!
//! Heave (Black, Mei & Bray, J. Fluid Mech. 46, 1971): half breadth a, draught T, depth h, s = h − T, z from the floor.
//! Outside φ = Σ A_n ψ_n(z) exp(−k_n (x − a)) with ω² = −g k_n tan k_n h (k₀ = −ik); under the box
//! φ = (z² − x²)/(2s) + Σ B_m cosh(mπx/s) cos(mπz/s). φ and ∂φ/∂x are continuous below the edge, ∂φ/∂x = 0 on the side.
//! a₃₃ + i b₃₃/ω = 2ρ ∫₀ᵃ φ dx on the bottom [kg/m].
//!
//! Release from rest (Cummins, Schiffstechnik 9, 1962): [m + a₃₃(∞)] y″ + ∫₀ᵗ K(t − τ) y′(τ) dτ + 2ρga y = 0 with
//! K(t) = (2/π) ∫₀^∞ b₃₃ cos ωt dω.
//!
//! Valid for small motions without viscosity.

use std::f64::consts::PI;

/// Modes under the box; outside as many for the depth.
const MODES: usize = 40;

/// A rectangular section, wall-sided, floating in water of constant depth that reaches to infinity on both sides.
#[derive(Clone, Copy)]
pub struct HeavingBox {
    /// Density of the water ρ [kg/m³].
    pub density: f64,
    /// Acceleration of gravity g [m/s²].
    pub gravity: f64,
    /// Half of the breadth a [m].
    pub half_breadth: f64,
    /// Draught T [m].
    pub draught: f64,
    /// Depth of the water h [m].
    pub depth: f64,
}

/// What the water does to a body that heaves at one frequency.
#[derive(Clone, Copy)]
pub struct Radiation {
    /// Added mass [kg/m].
    pub added_mass: f64,
    /// Damping b from the pressure on the bottom [kg/(m s)].
    pub damping: f64,
    /// The same from the waves that go off to both sides [kg/(m s)].
    pub radiated: f64,
}

/// A mode of the outer water: vertical wave number [1/m], its sign for waves that travel, and its norm.
struct Outer {
    k: f64,
    travels: bool,
    norm: f64,
}

impl Outer {
    /// cos k z for a mode that decays outwards, cosh k z for waves, z from the floor; ∫ ψ² dz over the depth is 1.
    fn new(k: f64, travels: bool, depth: f64) -> Outer {
        let swing = if travels { (2.0 * k * depth).sinh() } else { (2.0 * k * depth).sin() };
        Outer { k, travels, norm: (0.5 * depth + swing / (4.0 * k)).sqrt() }
    }

    /// ∫₀ˢ cos(mπz/s) ψ dz.
    fn overlap(&self, m: usize, s: f64) -> f64 {
        let (alpha, k) = (m as f64 * PI / s, self.k);
        let sign = if m.is_multiple_of(2) { 1.0 } else { -1.0 };
        let whole = match self.travels {
            true => sign * k * (k * s).sinh() / (k * k + alpha * alpha),
            false if ((k - alpha) * s).abs() < 1e-7 => 0.5 * s,
            false => sign * k * (k * s).sin() / (k * k - alpha * alpha),
        };
        whole / self.norm
    }
}

impl HeavingBox {
    /// Radiation at angular frequency ω > 0 [1/s].
    pub fn radiation(&self, omega: f64) -> Radiation {
        let (h, nu) = (self.depth, omega * omega / self.gravity);
        let mut modes = vec![Outer::new(bisect(|k| k * (k * h).tanh() - nu, [0.0, nu + 40.0 / h]), true, h)];
        for n in 1..=self.outer_modes() {
            let (from, to) = ((n as f64 - 0.5) * PI / h, n as f64 * PI / h);
            modes.push(Outer::new(bisect(|k| nu * (k * h).cos() + k * (k * h).sin(), [from, to]), false, h));
        }
        self.solve(&modes, omega)
    }

    /// Added mass where the frequency is without bound [kg/m]: the surface is then one of no potential.
    pub fn added_mass_at_once(&self) -> f64 {
        let h = self.depth;
        let modes: Vec<Outer> =
            (0..=self.outer_modes()).map(|n| Outer::new((n as f64 + 0.5) * PI / h, false, h)).collect();
        self.solve(&modes, 0.0).added_mass
    }

    /// The same fineness outside as under the box.
    fn outer_modes(&self) -> usize {
        (MODES as f64 * self.depth / (self.depth - self.draught)).ceil() as usize
    }

    fn solve(&self, modes: &[Outer], omega: f64) -> Radiation {
        let (a, s) = (self.half_breadth, self.depth - self.draught);
        let steep = |m: usize| m as f64 * PI / s * (m as f64 * PI * a / s).tanh();
        let overlaps: Vec<Vec<f64>> =
            modes.iter().map(|mode| (0..MODES).map(|m| mode.overlap(m, s)).collect()).collect();
        // real parts of the unknowns first, imaginary parts after them
        let mut matrix = vec![vec![0.0; 2 * MODES]; 2 * MODES];
        let mut right = vec![0.0; 2 * MODES];
        for m in 0..MODES {
            let own = if m == 0 { s } else { 0.5 * s };
            (matrix[m][m], matrix[MODES + m][MODES + m]) = (own, own);
            right[m] = -self.forced(m);
            for (mode, overlap) in modes.iter().zip(&overlaps) {
                // outside, the potential is −flux/k times the mode; i flux/k · (−1) where it travels
                let row = if mode.travels { MODES + m } else { m };
                right[row] += overlap[m] / mode.k * (a / s) * overlap[0];
                for l in 0..MODES {
                    let given = overlap[m] * overlap[l] * steep(l) / mode.k;
                    match mode.travels {
                        false => {
                            matrix[m][l] += given;
                            matrix[MODES + m][MODES + l] += given;
                        }
                        true => {
                            matrix[m][MODES + l] -= given;
                            matrix[MODES + m][l] += given;
                        }
                    }
                }
            }
        }
        let inner = eliminate(matrix, right);
        let bottom = |part: &[f64]| {
            let of = |m: usize| match m {
                0 => a * part[0],
                _ if m.is_multiple_of(2) => part[m] * steep(m) * (s / (m as f64 * PI)).powi(2),
                _ => -part[m] * steep(m) * (s / (m as f64 * PI)).powi(2),
            };
            (0..MODES).map(of).sum::<f64>()
        };
        let (real, imaginary) = inner.split_at(MODES);
        let radiated = modes.iter().zip(&overlaps).filter(|(mode, _)| mode.travels).map(|(mode, overlap)| {
            let flux = |part: &[f64]| (0..MODES).map(|m| steep(m) * overlap[m] * part[m]).sum::<f64>();
            let (re, im) = (flux(real) - a / s * overlap[0], flux(imaginary));
            2.0 * self.density * omega * (re * re + im * im) / mode.k
        });
        Radiation {
            added_mass: 2.0 * self.density * (0.5 * (s * a - a.powi(3) / (3.0 * s)) + bottom(real)),
            damping: 2.0 * self.density * omega * bottom(imaginary),
            radiated: radiated.sum(),
        }
    }

    /// ∫₀ˢ (z² − a²)/(2s) cos(mπz/s) dz: the part of the potential under the box that moves with its bottom.
    fn forced(&self, m: usize) -> f64 {
        let (a, s) = (self.half_breadth, self.depth - self.draught);
        match m {
            0 => (s * s / 3.0 - a * a) / 2.0,
            _ if m.is_multiple_of(2) => (s / (m as f64 * PI)).powi(2),
            _ => -(s / (m as f64 * PI)).powi(2),
        }
    }

    /// Heave over its start after release from rest [-], at multiples of `dt` [s]: Cummins 1962, by trapezoids.
    pub fn release(&self, dt: f64, steps: usize) -> Vec<f64> {
        let (top, count) = (24.0, 480);
        let step = top / f64::from(count);
        let at_rest = 2.0 * self.density * self.half_breadth.powi(2) * (self.gravity / self.depth).sqrt();
        let mut damping = vec![at_rest];
        damping.extend((1..=count).map(|n| self.radiation(step * f64::from(n)).damping));
        let memory: Vec<f64> = (0..=steps)
            .map(|n| {
                let wave = |k: usize| damping[k] * (step * k as f64 * dt * n as f64).cos();
                let inside: f64 = (1..damping.len() - 1).map(wave).sum();
                2.0 / PI * step * (inside + 0.5 * (wave(0) + wave(damping.len() - 1)))
            })
            .collect();
        let mass = 2.0 * self.density * self.half_breadth * self.draught + self.added_mass_at_once();
        let spring = 2.0 * self.density * self.gravity * self.half_breadth;
        let (mut heave, mut speed, mut past) = (vec![1.0], vec![0.0], 0.0);
        for n in 1..=steps {
            let next: f64 = dt * (1..n).map(|k| memory[n - k] * speed[k]).sum::<f64>();
            let (y, v) = (heave[n - 1], speed[n - 1]);
            let pull = past + next + spring * (2.0 * y + 0.5 * dt * v);
            let own = 0.5 * dt * memory[0];
            let faster = (mass * v - 0.5 * dt * pull) / (mass + 0.5 * dt * (own + 0.5 * dt * spring));
            past = next + own * faster;
            speed.push(faster);
            heave.push(y + 0.5 * dt * (v + faster));
        }
        heave
    }
}

/// The zero of a function that changes its sign once between the ends.
fn bisect(f: impl Fn(f64) -> f64, ends: [f64; 2]) -> f64 {
    let [mut low, mut high] = ends;
    let rising = f(high) > 0.0;
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if (f(middle) > 0.0) == rising { high = middle } else { low = middle }
    }
    0.5 * (low + high)
}

/// The solution of a system of linear equations (Gauss, with the largest pivot of each column).
fn eliminate(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Vec<f64> {
    let n = right.len();
    for c in 0..n {
        let pivot = (c..n).max_by(|&i, &j| matrix[i][c].abs().total_cmp(&matrix[j][c].abs())).unwrap_or(c);
        matrix.swap(c, pivot);
        right.swap(c, pivot);
        let (upper, lower) = matrix.split_at_mut(c + 1);
        for (i, row) in lower.iter_mut().enumerate() {
            let factor = row[c] / upper[c][c];
            row[c..].iter_mut().zip(&upper[c][c..]).for_each(|(x, p)| *x -= factor * p);
            right[c + 1 + i] -= factor * right[c];
        }
    }
    for c in (0..n).rev() {
        let known: f64 = (c + 1..n).map(|k| matrix[c][k] * right[k]).sum();
        right[c] = (right[c] - known) / matrix[c][c];
    }
    right
}
