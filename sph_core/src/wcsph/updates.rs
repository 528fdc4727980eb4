//! The verbs of a step that ask each particle only about itself, a line an equation.

use crate::error::Breakdown;
use crate::fluid::Fluid;
use crate::parallel;
use crate::parameters::Parameters;
use crate::timers::Phase;
use crate::walls::Walls;

/// Share of the gap between volume correction and its target closed in a force sweep.
const VOLUME_RELAXATION: f64 = 0.1;
/// Filling is believed within these bounds only.
const FILLING: [f64; 2] = [0.9, 1.12];
/// Longest shift in a step, in smoothing lengths.
const LONGEST_SHIFT: f64 = 0.02;
/// Settled water would be shifted by no more than this [h].
const SETTLED: f64 = 1e-4;
/// Sweeps that settling may take.
const SETTLING_SWEEPS: u32 = 60;
/// Largest |ρ/ρ₀ − 1| that is believed.
const LARGEST_STRAIN: f64 = 0.3;

impl Fluid {
    /// v ← v + Δt a.
    pub(crate) fn kick(&mut self, dt: f64) {
        self.phases.begin(Phase::Integration);
        let p = &mut self.particles;
        parallel::each([&mut p.u, &mut p.v], |at, [u, v]| {
            let (ax, ay) = (&p.ax[at.clone()], &p.ay[at]);
            for k in 0..ax.len() {
                u[k] += dt * ax[k];
                v[k] += dt * ay[k];
            }
        });
    }

    /// x ← x + Δt v.
    pub(crate) fn drift(&mut self, dt: f64) {
        let p = &mut self.particles;
        parallel::each([&mut p.x, &mut p.y], |at, [x, y]| {
            let (u, v) = (&p.u[at.clone()], &p.v[at]);
            for k in 0..u.len() {
                x[k] += dt * u[k];
                y[k] += dt * v[k];
            }
        });
    }

    /// ρ ← ρ + Δt dρ/dt.
    pub(crate) fn compress(&mut self, dt: f64) {
        self.phases.begin(Phase::Integration);
        parallel::each([&mut self.particles.rho], |at, [rho]| {
            let rate = &self.density_rate[at];
            for k in 0..rate.len() {
                rho[k] += dt * rate[k];
            }
        });
        self.dynamic_walls.compress(dt);
    }

    /// ρ ← ρ (2 + ε)/(2 − ε), ε = Δt (dρ/dt)/ρ with the rate about the step's middle: second order.
    pub(crate) fn compress_about_middle(&mut self, dt: f64) {
        self.phases.begin(Phase::Integration);
        parallel::each([&mut self.particles.rho], |at, [rho]| {
            let rate = &self.density_rate[at];
            for k in 0..rate.len() {
                let (twice, change) = (2.0 * rho[k], dt * rate[k]); // ε = change/ρ
                rho[k] *= (twice + change) / (twice - change);
            }
        });
        self.dynamic_walls.compress_about_middle(dt);
    }

    /// E13: δr = −(2h Δt |v| + κ h²) ∇C, at most 0.02 h, where the neighbourhood is full; κ for what is stirred by halving (E26).
    pub(crate) fn shift(&mut self, dt: f64) {
        if self.parameters.shifting {
            self.even_out(dt, false);
        }
    }

    /// `all` that has neither surface nor wall in its neighbourhood settles; else only what is stirred.
    fn even_out(&mut self, dt: f64, all: bool) {
        let (p, d, at_surface) = (&mut self.particles, &self.derived, self.parameters.shift_surface);
        let (stirred, settling) = (&p.stirred, self.parameters.settling);
        parallel::each([&mut p.x, &mut p.y], |at, [x, y]| {
            let (u, v, h) = (&p.u[at.clone()], &p.v[at.clone()], &p.h[at.clone()]);
            let (around, beside) = (&d.surroundings[at.clone()], &d.near_surface[at.clone()]);
            let settles = |k: usize| match all {
                true => !beside[k] && around[k].wall_filling == 0.0,
                false => !beside[k] && stirred.get(at.start + k) == Some(&true),
            };
            for k in 0..u.len() {
                let full = !around[k].at_surface() || at_surface;
                let settling = if settles(k) { settling * h[k] } else { 0.0 };
                let scale = -h[k] * (2.0 * dt * (u[k] * u[k] + v[k] * v[k]).sqrt() + settling);
                let [dx, dy] = around[k].crowding().map(|c| scale * c);
                let (length, limit) = ((dx * dx + dy * dy).sqrt(), LONGEST_SHIFT * h[k]);
                let shrink = if length > limit { limit / length } else { 1.0 };
                let share = if full { shrink } else { 0.0 };
                x[k] += share * dx;
                y[k] += share * dy;
            }
        });
    }

    /// E13 before time starts: shift until the largest shift is 10⁻⁴ h, so that Σ V ∇W of rows that grow is nothing. Equal
    /// particles stay where they are.
    pub(crate) fn settle(&mut self, walls: &mut Walls) {
        let Parameters { shifting, settling, .. } = self.parameters;
        let h = &self.particles.h;
        let alike = h.iter().all(|&one| (one / h[0] - 1.0).abs() < 1e-9);
        for _ in 0..if shifting && !alike { SETTLING_SWEEPS } else { 0 } {
            let (p, d) = (&self.particles, &self.derived);
            let shift = |k: usize| match d.near_surface[k] || d.surroundings[k].wall_filling > 0.0 {
                true => 0.0,
                false => {
                    let [x, y] = d.surroundings[k].crowding();
                    settling * p.h[k] * x.hypot(y)
                }
            };
            if -parallel::least(p.len(), |k| -shift(k)) < SETTLED {
                break;
            }
            self.even_out(0.0, true);
            self.evaluate_forces(walls, 0.0);
            self.search.flag_surface(&mut self.derived);
        }
    }

    /// E12: relax θ towards 1/S inside the fluid, towards 1 near its surface.
    pub(crate) fn relax_volumes(&mut self) {
        if !self.parameters.volume_correction {
            return;
        }
        let derived = &self.derived;
        parallel::update(&mut self.particles.theta, |k, theta| {
            let filling = derived.surroundings[k].filling.clamp(FILLING[0], FILLING[1]);
            let target = if derived.near_surface[k] { 1.0 } else { 1.0 / filling };
            *theta += VOLUME_RELAXATION * (target - *theta);
        });
    }

    /// E3: pressures and volumes from densities. Slack water is never thinner than water at rest: it holds no tension.
    pub(crate) fn equation_of_state(&mut self) {
        self.phases.begin(Phase::Integration);
        if self.derived.pressure.is_empty() {
            self.derived.pressure = std::mem::take(&mut self.density_rate);
        }
        if let Some(gas) = self.parameters.gas {
            return self.gas_state(gas); //           L9
        }
        let (eos, ventilation) = (self.parameters.eos, self.parameters.ventilation);
        let (p, d) = (&mut self.particles, &mut self.derived);
        let (around, beside) = (&d.surroundings, &d.near_surface);
        parallel::each([&mut p.rho, &mut d.pressure], |at, [rho, pressure]| {
            let (around, beside) = (&around[at.clone()], &beside[at]);
            for k in 0..around.len() {
                let slack = around[k].slack(beside[k], ventilation);
                rho[k] = if slack && rho[k] < eos.rho0 { eos.rho0 } else { rho[k] };
                pressure[k] = eos.pressure(rho[k]);
            }
        });
        self.correct_volumes();
    }

    /// V = θ m/ρ, where that is not m/ρ.
    pub(crate) fn correct_volumes(&mut self) {
        let p = &self.particles;
        parallel::update(&mut self.derived.volume, |k, volume| *volume = p.theta[k] * p.mass[k] / p.rho[k]);
    }

    /// F ← F + `more` [N/m].
    pub(crate) fn add_forces(&mut self, more: &[[f64; 2]]) {
        let p = &mut self.particles;
        parallel::update_both(&mut p.ax, &mut p.ay, |k, x, y| {
            *x += more[k][0];
            *y += more[k][1];
        });
    }

    /// a = F/m + g, in place of F.
    pub(crate) fn accelerate(&mut self) {
        self.phases.begin(Phase::Integration);
        let (p, g) = (&mut self.particles, self.parameters.gravity);
        parallel::each([&mut p.ax, &mut p.ay], |at, [ax, ay]| {
            let mass = &p.mass[at];
            for k in 0..mass.len() {
                ax[k] = ax[k] / mass[k] + g[0];
                ay[k] = ay[k] / mass[k] + g[1];
            }
        });
    }

    /// Every state finite, every density believable.
    pub(crate) fn check(&self) -> Result<(), Breakdown> {
        let (p, time, rho0) = (&self.particles, self.time, self.parameters.eos.rho0);
        let gas = self.parameters.gas.is_some();
        let finite = |k: usize| (p.x[k] + p.y[k] + p.u[k] + p.v[k] + p.ax[k] + p.ay[k]).is_finite();
        let strained = |k: usize| (p.rho[k] / rho0 - 1.0).abs();
        let sound =
            |k: usize| finite(k) && (strained(k) < LARGEST_STRAIN || gas && p.rho[k] > 0.0 && p.energy[k] > 0.0);
        if parallel::every(p.len(), sound) {
            return Ok(());
        }
        let k = (0..p.len()).find(|&k| !sound(k)).unwrap_or(0);
        let (id, x, y, rho) = (p.id[k], p.x[k], p.y[k], p.rho[k]);
        Err(match rho.is_finite() && finite(k) {
            true => Breakdown::Density { id, x, y, rho, time },
            false => Breakdown::NotFinite { id, x, y, time },
        })
    }
}
