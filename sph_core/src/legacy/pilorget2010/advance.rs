//! One step of the thesis's projection (THEORY LE19–LE28).

use crate::error::Breakdown;
use crate::forces::Forces;
use crate::legacy::pilorget2010::poisson::Assembly;
use crate::legacy::pilorget2010::settings::Predictor;
use crate::legacy::pilorget2010::state::{Thesis, Trial};
use crate::legacy::pilorget2010::sums::*;
use crate::parallel;
use crate::system::ParticleSystem;
use crate::walls::Walls;

impl Thesis {
    pub(crate) fn advance(
        &mut self,
        system: &mut ParticleSystem,
        walls: &mut Walls,
        mut trial: Trial,
    ) -> Result<(), Breakdown> {
        let (settings, dt) = (self.settings, trial.dt);
        self.assign(system, walls, -dt, None);
        self.find_surface(system); //                  LE23, LE25
        let mut pressure = self.known_pressures(system, walls);
        let carried = settings.predictor == Predictor::OldPressure;
        if carried {
            self.assign(system, walls, -dt, Some(&trial.standing()));
            self.sum_densities(system);
            let push = self.accelerations(system, &pressure);
            trial.kick(&push, -dt); //                LE28: v* ← v* − Δt ∇P_n/ρ
        }
        let mut scale = 0.0;
        for pass in 0..=settings.inner_passes {
            self.assign(system, walls, 0.0, Some(&trial)); // r* = r_n + v* Δt, LE21
            self.sum_densities(system); //             LE19
            if pass > 0 && (self.density_error < settings.density_tolerance || pass == settings.inner_passes) {
                break;
            }
            // the first pass finds the pressure, from the last one; the others its correction (LE27)
            let first = pass == 0 && !carried;
            let mut change = if first { pressure.clone() } else { vec![0.0; pressure.len()] };
            self.solve(system, walls, dt, &mut change, &mut scale)?; // LE22
            let push = self.accelerations(system, &change); // LE26
            trial.kick(&push, -dt); //                v ← v* − Δt ∇P/ρ*
            pressure = if first { change } else { pressure.iter().zip(&change).map(|(p, d)| p + d).collect() };
        }
        self.hand_over(system, walls, &pressure, &trial); // r = r_n + ½(v_n + v) Δt
        Ok(())
    }

    /// LE23, LE25, at r_n.
    fn find_surface(&mut self, system: &ParticleSystem) {
        let least = self.settings.surface_ratio * self.inside;
        let rho0 = system.domain.fluid.density;
        let below = |i: usize| divergence_of_place(&self.cast, &self.here, i, rho0) < least;
        self.at_surface = (0..self.cast.rows).map(below).collect();
        self.reflections = reflections(&self.cast, &self.here, &self.at_surface, system.particles.len());
    }

    /// The last step's pressures, a row each.
    fn known_pressures(&self, system: &ParticleSystem, walls: &Walls) -> Vec<f64> {
        let of_limits = self.limits.walls.iter().map(|&w| walls.pressure[w as usize]);
        let all = system.fields.pressure.iter().copied().chain(of_limits);
        all.zip(&self.at_surface).map(|(p, &at_surface)| if at_surface { 0.0 } else { p }).collect()
    }

    /// LE20: v* = v_n + (g + ν∇²v) Δt, under the viscous forces of pairs.
    pub(crate) fn predict(&self, system: &ParticleSystem, forces: &Forces, dt: f64) -> Trial {
        let (p, g) = (&system.particles, system.domain.gravity);
        let before: Vec<[f64; 2]> = (0..p.len()).map(|k| [p.u[k], p.v[k]]).collect();
        let velocity = (0..p.len()).map(|k| {
            let viscous = [forces.x[k], forces.y[k]].map(|force| force / p.mass[k]);
            [0, 1].map(|axis| before[k][axis] + dt * (g[axis] + viscous[axis]))
        });
        let velocity = velocity.collect();
        Trial { from: (0..p.len()).map(|k| [p.x[k], p.y[k]]).collect(), before, velocity, dt }
    }

    /// LE19: ρ* = Σ m W + what is stored.
    fn sum_densities(&mut self, system: &ParticleSystem) {
        let (n, rho0) = (system.particles.len(), system.domain.fluid.density);
        let (cast, pairs) = (&self.cast, &self.there);
        self.density.resize(cast.rows, rho0);
        let (deficit, limit_deficit, id) = (&self.deficit, &self.limit_deficit, &system.particles.id);
        parallel::gather_into(&mut self.density, |i| {
            let stored = if i < n { deficit[id[i] as usize] } else { limit_deficit[i - n] };
            density_sum(cast, pairs, i) + stored
        });
        let errors = self.density[..n].iter().zip(&self.at_surface).filter(|(_, at_surface)| !**at_surface);
        self.density_error = errors.map(|(rho, _)| (rho / rho0 - 1.0).abs()).fold(0.0, f64::max);
    }

    /// LE22, LE27; `scale` is the first pass's largest right-hand side.
    fn solve(
        &mut self,
        system: &ParticleSystem,
        walls: &Walls,
        dt: f64,
        pressure: &mut [f64],
        scale: &mut f64,
    ) -> Result<(), Breakdown> {
        let (settings, rho0) = (self.settings, system.domain.fluid.density);
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
        let (n, row) = (system.particles.len(), ended.row);
        Err(Breakdown::Poisson {
            iterations: ended.iterations,
            residual: ended.residual * dt * dt,
            tolerance: tolerance * dt * dt,
            id: if row < n { system.particles.id[row] } else { (row - n) as u32 },
            kind: if row < n { "particle" } else { "limit particle" },
            x: at.x,
            y: at.y,
            time: system.time,
        })
    }

    /// LE26: ∇P/ρ* of the fluid at r* [m/s²].
    fn accelerations(&self, system: &ParticleSystem, pressure: &[f64]) -> Vec<[f64; 2]> {
        let (up, corrected) = (system.domain.up(), self.settings.gradient_correction);
        let mut out = vec![[0.0; 2]; system.particles.len()];
        let (cast, pairs) = (&self.cast, &self.there);
        parallel::gather_into(&mut out, |i| {
            let at_surface = self.at_surface[i];
            let factor = match (corrected, at_surface) {
                (false, _) => 1.0,
                (true, true) => self.correction,
                (true, false) => gradient_correction(pairs, i, up),
            };
            let normal = if at_surface { surface_normal(cast, pairs, i) } else { None };
            let push = match (at_surface, normal) {
                (true, Some(n)) => gradient_at_surface(cast, pairs, pressure, self.density[i], i, n), // LE25
                (true, None) => [0.0; 2],
                (false, _) => gradient_inside(cast, pairs, pressure, self.density[i], i),
            };
            push.map(|a| factor * a)
        });
        out
    }

    /// The end of a step: velocities, places, pressures, densities; the walls' forces from the limit particles' pressures.
    fn hand_over(&self, system: &mut ParticleSystem, walls: &mut Walls, pressure: &[f64], trial: &Trial) {
        let n = system.particles.len();
        let p = &mut system.particles;
        for k in 0..n {
            let (from, before, now, dt) = (trial.from[k], trial.before[k], trial.velocity[k], trial.dt);
            [p.u[k], p.v[k]] = now;
            [p.x[k], p.y[k]] = [0, 1].map(|c| from[c] + 0.5 * dt * (before[c] + now[c]));
            [p.ax[k], p.ay[k]] = [0, 1].map(|c| (now[c] - before[c]) / dt);
            p.rho[k] = self.density[k];
        }
        system.fields.pressure.copy_from_slice(&pressure[..n]);
        let ratio = system.domain.fluid.smoothing_ratio;
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
