//! The projection of Pilorget's (2010) thesis, with its choices (THEORY J1–J16).
//!
//! Read in this order: `step`, [`settings`], `prepare` (once), `mass`, `limit` (walls), `surface`, `poisson`, `bicgstab`,
//! `gradient`; `stage`, `cast` and `pairs` hold who plays where, and who meets whom.

mod bicgstab;
mod cast;
mod gradient;
mod limit;
mod mass;
mod pairs;
mod poisson;
mod prepare;
pub mod settings;
mod stage;
mod step_limit;
mod surface;

use crate::error::Breakdown;
use crate::fluid::Fluid;
use crate::parallel;
use crate::timers::Phase;
use crate::walls::Walls;

use cast::{Cast, Reflection};
use limit::Limits;
use pairs::Pairs;
use poisson::Assembly;
use settings::Predictor;

pub use settings::ThesisSettings;

/// What the thesis's projection keeps from step to step, and what it counts.
#[derive(Clone, Debug, Default)]
pub struct Thesis {
    limits: Limits,
    /// Masses of the wall particles [kg/m]; 0 for those that play no part.
    pub wall_mass: Vec<f64>,
    /// ρ₀ − Σ m W at the start [kg/m³] (J2), by identity.
    lack: Vec<f64>,
    /// The same of the limit particles.
    limit_lack: Vec<f64>,
    /// ∇·r inside [-] (J7).
    inside: f64,
    /// Gradient correction inside [-] (J9).
    correction: f64,
    /// Particles now (r_n) and predicted (r*).
    cast: Cast,
    here: Pairs,
    there: Pairs,
    density: Vec<f64>,
    at_surface: Vec<bool>,
    reflections: Vec<Reflection>,
    /// Iterations of all solutions.
    pub iterations: u64,
    /// Solutions, one a pass of the inner loop.
    pub solutions: u64,
    /// Largest |ρ* − ρ₀|/ρ₀ that the last step's inner loop left [-] (J11).
    pub density_error: f64,
}

/// Motion of one step before it is taken: r_n, v_n and the velocity found so far.
pub(crate) struct Trial {
    from: Vec<[f64; 2]>,
    before: Vec<[f64; 2]>,
    velocity: Vec<[f64; 2]>,
    dt: f64,
}

/// One step. Before: the walls' kinematics are those of the step's end.
pub(crate) fn step(fluid: &mut Fluid, walls: &mut Walls, dt: f64) -> Result<(), Breakdown> {
    fluid.pack(walls, -dt); //                        who is near whom at r_n
    fluid.gather_viscosity(walls);
    fluid.phases.begin(Phase::Pressure);
    let mut thesis = std::mem::take(&mut fluid.thesis);
    let found = thesis.advance(fluid, walls, dt);
    fluid.thesis = thesis;
    found
}

impl Thesis {
    fn advance(&mut self, fluid: &mut Fluid, walls: &mut Walls, dt: f64) -> Result<(), Breakdown> {
        let settings = fluid.parameters.thesis;
        self.assign(fluid, walls, -dt, None);
        self.find_surface(fluid); //                  J7, J8
        let mut pressure = self.known_pressures(fluid, walls);
        let mut trial = self.predict(fluid, dt); //   J4: v* = v_n + (g + ν∇²v) Δt
        let carried = settings.predictor == Predictor::OldPressure;
        if carried {
            self.assign(fluid, walls, -dt, Some(&trial.standing()));
            self.sum_densities(fluid);
            let push = self.accelerations(fluid, &pressure);
            trial.kick(&push, -dt); //                J14: v* ← v* − Δt ∇P_n/ρ
        }
        let mut scale = 0.0;
        for pass in 0..=settings.inner_passes {
            self.assign(fluid, walls, 0.0, Some(&trial)); // r* = r_n + v* Δt, J10
            self.sum_densities(fluid); //             J2
            if pass > 0 && (self.density_error < settings.density_tolerance || pass == settings.inner_passes) {
                break;
            }
            // the first pass finds the pressure, from the last one; the others what it lacks (J11)
            let first = pass == 0 && !carried;
            let mut change = if first { pressure.clone() } else { vec![0.0; pressure.len()] };
            self.solve(fluid, walls, dt, &mut change, &mut scale)?; // J6
            let push = self.accelerations(fluid, &change); // J9
            trial.kick(&push, -dt); //                v ← v* − Δt ∇P/ρ*
            pressure = if first { change } else { pressure.iter().zip(&change).map(|(p, d)| p + d).collect() };
        }
        self.hand_over(fluid, walls, &pressure, &trial); // r = r_n + ½(v_n + v) Δt
        Ok(())
    }

    /// J7, J8, at r_n.
    fn find_surface(&mut self, fluid: &Fluid) {
        let least = fluid.parameters.thesis.surface_ratio * self.inside;
        self.at_surface = surface::find(&self.cast, &self.here, fluid.parameters.eos.rho0, least);
        self.reflections = surface::reflections(&self.cast, &self.here, &self.at_surface, fluid.particles.len());
    }

    /// The last step's pressures, a row each.
    fn known_pressures(&self, fluid: &Fluid, walls: &Walls) -> Vec<f64> {
        let of_limits = self.limits.walls.iter().map(|&w| walls.pressure[w as usize]);
        let all = fluid.derived.pressure.iter().copied().chain(of_limits);
        all.zip(&self.at_surface).map(|(p, &at_surface)| if at_surface { 0.0 } else { p }).collect()
    }

    /// J4.
    fn predict(&self, fluid: &Fluid, dt: f64) -> Trial {
        let (p, g) = (&fluid.particles, fluid.parameters.gravity);
        let before: Vec<[f64; 2]> = (0..p.len()).map(|k| [p.u[k], p.v[k]]).collect();
        let velocity = (0..p.len()).map(|k| {
            let viscous = [p.ax[k], p.ay[k]].map(|force| force / p.mass[k]);
            [0, 1].map(|axis| before[k][axis] + dt * (g[axis] + viscous[axis]))
        });
        let velocity = velocity.collect();
        Trial { from: (0..p.len()).map(|k| [p.x[k], p.y[k]]).collect(), before, velocity, dt }
    }

    /// J2: ρ* = Σ m W + what is stored.
    fn sum_densities(&mut self, fluid: &Fluid) {
        let (n, rho0) = (fluid.particles.len(), fluid.parameters.eos.rho0);
        let (cast, pairs) = (&self.cast, &self.there);
        self.density.resize(cast.rows, rho0);
        let (lack, limit_lack, id) = (&self.lack, &self.limit_lack, &fluid.particles.id);
        parallel::gather_into(&mut self.density, |i| {
            let stored = if i < n { lack[id[i] as usize] } else { limit_lack[i - n] };
            mass::density_sum(cast, pairs, i) + stored
        });
        let errors = self.density[..n].iter().zip(&self.at_surface).filter(|(_, at_surface)| !**at_surface);
        self.density_error = errors.map(|(rho, _)| (rho / rho0 - 1.0).abs()).fold(0.0, f64::max);
    }

    /// J6, J12; `scale` is the first pass's largest right-hand side.
    fn solve(
        &mut self,
        fluid: &Fluid,
        walls: &Walls,
        dt: f64,
        pressure: &mut [f64],
        scale: &mut f64,
    ) -> Result<(), Breakdown> {
        let (settings, rho0) = (fluid.parameters.thesis, fluid.parameters.eos.rho0);
        let normal = |&w: &u32| [walls.nx[w as usize], walls.ny[w as usize]];
        let normals: Vec<[f64; 2]> = self.limits.walls.iter().map(normal).collect();
        let Thesis { cast, there: pairs, density, at_surface, .. } = self;
        let limit_rows = settings.limit_rows;
        let (a, b) = Assembly { cast, pairs, density, at_surface, normals: &normals, limit_rows, rho0, dt }.rows();
        let size = b.iter().fold(0.0_f64, |size, b| size.max(b.abs()));
        *scale = scale.max(size);
        let tolerance = settings.residual * *scale;
        let ended = a.solve(&b, pressure, tolerance, settings.most_iterations);
        self.iterations += ended.iterations as u64;
        self.solutions += 1;
        if ended.residual <= tolerance {
            return Ok(());
        }
        let at = &self.cast.players[ended.row];
        let (n, row) = (fluid.particles.len(), ended.row);
        Err(Breakdown::Poisson {
            iterations: ended.iterations,
            residual: ended.residual * dt * dt,
            tolerance: tolerance * dt * dt,
            id: if row < n { fluid.particles.id[row] } else { (row - n) as u32 },
            kind: if row < n { "particle" } else { "limit particle" },
            x: at.x,
            y: at.y,
            time: fluid.time,
        })
    }

    /// J9: ∇P/ρ* of the fluid at r* [m/s²].
    fn accelerations(&self, fluid: &Fluid, pressure: &[f64]) -> Vec<[f64; 2]> {
        let (up, corrected) = (fluid.up(), fluid.parameters.thesis.gradient_correction);
        let mut out = vec![[0.0; 2]; fluid.particles.len()];
        let (cast, pairs) = (&self.cast, &self.there);
        parallel::gather_into(&mut out, |i| {
            let at_surface = self.at_surface[i];
            let factor = match (corrected, at_surface) {
                (false, _) => 1.0,
                (true, true) => self.correction,
                (true, false) => gradient::correction(pairs, i, up),
            };
            let normal = if at_surface { surface::normal(cast, pairs, i) } else { None };
            let push = match (at_surface, normal) {
                (true, Some(n)) => gradient::at_surface(cast, pairs, pressure, self.density[i], i, n), // J8
                (true, None) => [0.0; 2],
                (false, _) => gradient::inside(cast, pairs, pressure, self.density[i], i),
            };
            push.map(|a| factor * a)
        });
        out
    }

    /// The end of a step: velocities, places, pressures, densities; the walls' forces from the limit particles' pressures.
    fn hand_over(&self, fluid: &mut Fluid, walls: &mut Walls, pressure: &[f64], trial: &Trial) {
        let n = fluid.particles.len();
        let p = &mut fluid.particles;
        for k in 0..n {
            let (from, before, now, dt) = (trial.from[k], trial.before[k], trial.velocity[k], trial.dt);
            [p.u[k], p.v[k]] = now;
            [p.x[k], p.y[k]] = [0, 1].map(|c| from[c] + 0.5 * dt * (before[c] + now[c]));
            [p.ax[k], p.ay[k]] = [0, 1].map(|c| (now[c] - before[c]) / dt);
            p.rho[k] = self.density[k];
        }
        fluid.derived.pressure.copy_from_slice(&pressure[..n]);
        let ratio = fluid.parameters.smoothing_ratio;
        for k in 0..walls.len() {
            let limit = self.limits.of_wall[k];
            walls.pressure[k] = limit.map_or(0.0, |l| pressure[n + l as usize]);
            let spacing = walls.h[k] / ratio;
            let face = limit.is_some_and(|l| self.limits.walls[l as usize] as usize == k);
            if face && walls.depth[k] < 0.6 * spacing {
                walls.fx[k] -= walls.pressure[k] * walls.nx[k] * spacing;
                walls.fy[k] -= walls.pressure[k] * walls.ny[k] * spacing;
            }
            [walls.mean_fx[k], walls.mean_fy[k], walls.mean_swing[k]] = [walls.fx[k], walls.fy[k], 0.0];
        }
    }
}

impl Trial {
    /// r* = r_n + v* Δt.
    fn predicted(&self, k: usize) -> [f64; 2] {
        [0, 1].map(|axis| self.from[k][axis] + self.dt * self.velocity[k][axis])
    }

    /// The same particles where they are.
    fn standing(&self) -> Trial {
        let (from, before) = (self.from.clone(), self.before.clone());
        Trial { velocity: vec![[0.0; 2]; from.len()], from, before, dt: self.dt }
    }

    /// v ← v + `time` a.
    fn kick(&mut self, a: &[[f64; 2]], time: f64) {
        for (v, a) in self.velocity.iter_mut().zip(a) {
            *v = [0, 1].map(|axis| v[axis] + time * a[axis]);
        }
    }
}

impl Fluid {
    /// Against gravity [-]; upwards where there is none.
    pub(crate) fn up(&self) -> [f64; 2] {
        let g = self.parameters.gravity;
        let size = g[0].hypot(g[1]);
        if size > 0.0 { g.map(|c| -c / size) } else { [0.0, 1.0] }
    }

    /// The viscous part of the pair forces (E7, E8), on fluid and walls.
    fn gather_viscosity(&mut self, walls: &mut Walls) {
        self.rows.fluid.iter_mut().chain(&mut self.rows.walls).for_each(|row| row.p = 0.0);
        self.gather_forces(walls);
    }
}
