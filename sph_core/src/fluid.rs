//! The fluid: its parameters, its state, and the verbs that the integrators are written in.

use serde::{Deserialize, Serialize};

use crate::eos::Tait;
use crate::error::Breakdown;
use crate::images::Mirror;
use crate::integrator::{self, Integrator};
use crate::kernel::{Kernel, Shape, WithKernel};
use crate::pair::{self, Constants, Extrapolated, Face, Gathered, Row};
use crate::particles::{Derived, Particles, SPRAY_FILLING, SURFACE_LAMBDA, Seed};
use crate::search::{Search, WallKinematics};
use crate::sweep;
use crate::walls::Walls;

/// What the fluid does along a wall.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Slip {
    /// No viscous traction: the wall is felt along its normal only.
    #[default]
    Free,
    /// The fluid sticks: the wall shows it the velocity 2V_w − ũ (E11, Adami et al. 2012).
    None,
}

/// Everything about the fluid that does not change during a run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Parameters {
    /// Equation of state: ρ₀, c₀, γ.
    pub eos: Tait,
    /// Smoothing kernel.
    pub kernel: Kernel,
    /// Smoothing length over particle spacing h/Δx [-].
    pub smoothing_ratio: f64,
    /// Gravity [m/s²].
    pub gravity: [f64; 2],
    /// Artificial viscosity α [-] (E7).
    pub alpha: f64,
    /// Kinematic viscosity ν [m²/s] (E8).
    pub nu: f64,
    /// Density diffusion δ [-] (E5).
    pub delta: f64,
    /// Shift particles towards an even spread (E13).
    pub shifting: bool,
    /// Correct the volumes by the filling ΣVW (E12).
    pub volume_correction: bool,
    /// What the fluid does along a wall.
    pub slip: Slip,
    /// Time integration.
    pub integrator: Integrator,
    /// Courant number of the acoustic step limit (E17).
    pub cfl: f64,
    /// Plane of symmetry, if the scene has one.
    pub mirror: Option<Mirror>,
}

/// A weakly compressible fluid.
pub struct Fluid {
    /// What does not change.
    pub parameters: Parameters,
    /// What a restart needs.
    pub particles: Particles,
    /// What a step recomputes.
    pub derived: Derived,
    /// Time [s].
    pub time: f64,
    /// Steps taken.
    pub steps: u64,
    /// Neighbour lists.
    pub search: Search,
    rows: Vec<Row>,
    wall_rows: Vec<Row>,
    faces: Vec<Face>,
    pub(crate) density_rate: Vec<f64>,
    gathered: Vec<Gathered>,
    extrapolated: Vec<Extrapolated>,
    wall_force: Vec<[f64; 2]>,
}

/// Steps that a neighbour list is made to last.
const LIST_LIFE: f64 = 12.0;
/// Share of the gap between volume correction and its target closed in a step.
const VOLUME_RELAXATION: f64 = 0.1;
/// Filling is believed within these bounds only.
const FILLING: [f64; 2] = [0.9, 1.12];
/// Longest shift in a step, in smoothing lengths.
const LONGEST_SHIFT: f64 = 0.02;

impl Fluid {
    /// A fluid from seeds; densities follow from the seeds' pressures.
    pub fn new(parameters: Parameters, seeds: &[Seed]) -> Fluid {
        let mut particles = Particles::default();
        for seed in seeds {
            particles.push(seed, parameters.eos.density(seed.pressure), parameters.smoothing_ratio);
        }
        let mut fluid = Fluid {
            parameters,
            particles,
            derived: Derived::default(),
            time: 0.0,
            steps: 0,
            search: Search::default(),
            rows: Vec::new(),
            wall_rows: Vec::new(),
            faces: Vec::new(),
            density_rate: Vec::new(),
            gathered: Vec::new(),
            extrapolated: Vec::new(),
            wall_force: Vec::new(),
        };
        let n = fluid.particles.len();
        fluid.derived.resize(n);
        fluid.density_rate.resize(n, 0.0);
        fluid.gathered.resize(n, Gathered::default());
        fluid
    }

    /// Forces at the start: once, when the walls stand where they start.
    pub fn initialise(&mut self, walls: &mut Walls) -> Result<(), Breakdown> {
        self.evaluate_forces(walls, 0.0);
        self.search.flag_surface(&mut self.derived);
        let now = (walls.fx.clone(), walls.fy.clone());
        (walls.mean_fx, walls.mean_fy) = now;
        self.check()
    }

    /// Advance by `dt` [s]. Before: the walls' kinematics are those of the step's end. After: the walls
    /// carry the force now and the mean force of the step.
    pub fn step(&mut self, walls: &mut Walls, dt: f64) -> Result<(), Breakdown> {
        walls.dt = dt;
        sweep::within_pool(|| match self.parameters.integrator {
            Integrator::Symplectic => integrator::symplectic(self, walls, dt),
            Integrator::PredictorCorrector => integrator::predictor_corrector(self, walls, dt),
        });
        self.time += dt;
        self.steps += 1;
        self.check()
    }

    /// v ← v + Δt a.
    pub(crate) fn kick(&mut self, dt: f64) {
        let p = &mut self.particles;
        for k in 0..p.x.len() {
            p.u[k] += dt * p.ax[k];
            p.v[k] += dt * p.ay[k];
        }
    }

    /// x ← x + Δt v.
    pub(crate) fn drift(&mut self, dt: f64) {
        let p = &mut self.particles;
        for k in 0..p.x.len() {
            p.x[k] += dt * p.u[k];
            p.y[k] += dt * p.v[k];
        }
    }

    /// ρ ← ρ + Δt dρ/dt.
    pub(crate) fn compress(&mut self, dt: f64) {
        let p = &mut self.particles;
        for k in 0..p.x.len() {
            p.rho[k] += dt * self.density_rate[k];
        }
    }

    /// E13: δr = −2h Δt |v| ∇C, at most 0.02 h, where the neighbourhood is full.
    pub(crate) fn shift(&mut self, dt: f64) {
        if !self.parameters.shifting {
            return;
        }
        let p = &mut self.particles;
        for k in 0..p.x.len() {
            let around = &self.derived.surroundings[k];
            if around.lambda < SURFACE_LAMBDA {
                continue;
            }
            let speed = (p.u[k] * p.u[k] + p.v[k] * p.v[k]).sqrt();
            let scale = -2.0 * p.h[k] * dt * speed;
            let [dx, dy] = around.crowding.map(|c| scale * c);
            let limit = LONGEST_SHIFT * p.h[k];
            let shrink = limit / (dx * dx + dy * dy).sqrt().max(limit);
            p.x[k] += shrink * dx;
            p.y[k] += shrink * dy;
        }
    }

    /// E12: relax θ towards 1/S inside the fluid, towards 1 near its surface.
    fn correct_volumes(&mut self) {
        if !self.parameters.volume_correction {
            return;
        }
        for k in 0..self.particles.len() {
            let target = if self.derived.near_surface[k] {
                1.0
            } else {
                1.0 / self.derived.surroundings[k].filling.clamp(FILLING[0], FILLING[1])
            };
            self.particles.theta[k] += VOLUME_RELAXATION * (target - self.particles.theta[k]);
        }
    }

    /// E3: pressures and volumes from densities. Spray is never thinner than water at rest, so it holds no tension.
    pub(crate) fn equation_of_state(&mut self) {
        let (eos, p, d) = (self.parameters.eos, &mut self.particles, &mut self.derived);
        for k in 0..p.x.len() {
            if d.surroundings[k].fluid_filling < SPRAY_FILLING {
                p.rho[k] = p.rho[k].max(eos.rho0);
            }
            d.pressure[k] = eos.pressure(p.rho[k]);
            d.volume[k] = p.theta[k] * p.mass[k] / p.rho[k];
        }
    }

    /// E4 + E5: dρ/dt at the present positions, walls taken `offset` seconds from the step's end.
    pub(crate) fn evaluate_density_rate(&mut self, walls: &Walls, offset: f64) {
        self.pack(walls, offset);
        let task = DensityRate {
            fluid: &self.rows,
            faces: &self.faces,
            rho: &self.particles.rho,
            search: &self.search,
            constants: self.constants(),
            out: &mut self.density_rate,
        };
        self.parameters.kernel.run(task);
    }

    /// E3, E9, E6–E8: pressures, wall pressures, accelerations, forces on walls; walls taken `offset`
    /// seconds from the step's end.
    pub(crate) fn evaluate_forces(&mut self, walls: &mut Walls, offset: f64) {
        self.equation_of_state();
        self.pack(walls, offset);
        let constants = self.constants();
        let kernel = self.parameters.kernel;
        self.extrapolated.resize(walls.len(), Extrapolated::default());
        self.wall_force.resize(walls.len(), [0.0; 2]);
        kernel.run(WallState {
            fluid: &self.rows,
            walls: &self.wall_rows,
            acceleration: (&walls.ax, &walls.ay),
            search: &self.search,
            constants,
            out: &mut self.extrapolated,
        });
        self.dress_walls(walls);
        let wall_nu = if self.parameters.slip == Slip::None { self.parameters.nu } else { 0.0 };
        kernel.run(Momentum {
            fluid: &self.rows,
            walls: &self.wall_rows,
            search: &self.search,
            constants,
            wall_nu,
            out: &mut self.gathered,
        });
        kernel.run(WallForce {
            fluid: &self.rows,
            walls: &self.wall_rows,
            search: &self.search,
            constants,
            wall_nu,
            out: &mut self.wall_force,
        });
        for (k, f) in self.wall_force.iter().enumerate() {
            [walls.fx[k], walls.fy[k]] = *f;
        }
        let (p, g) = (&mut self.particles, self.parameters.gravity);
        for (k, sum) in self.gathered.iter().enumerate() {
            p.ax[k] = sum.force[0] / p.mass[k] + g[0];
            p.ay[k] = sum.force[1] / p.mass[k] + g[1];
            self.derived.surroundings[k] = sum.around;
        }
        self.correct_volumes();
    }

    /// Walls show the fluid the pressure they extrapolate and, where it must stick, the velocity of E11.
    fn dress_walls(&mut self, walls: &mut Walls) {
        let (n, stick) = (walls.len(), self.parameters.slip == Slip::None);
        for (k, row) in self.wall_rows.iter_mut().enumerate() {
            let source = if k < n { k } else { self.search.wall_images[k - n] as usize };
            let found = &self.extrapolated[source];
            row.p = found.pressure;
            if stick {
                let side = if k < n { 1.0 } else { -1.0 };
                row.u = 2.0 * row.u - side * found.velocity[0];
                row.v = 2.0 * row.v - found.velocity[1];
            }
            if k < n {
                walls.pressure[k] = found.pressure;
            }
        }
    }

    /// Make the lists if they no longer hold, then pack what the sweeps read.
    fn pack(&mut self, walls: &Walls, offset: f64) {
        let m = walls.len();
        // back along the step from its end, at constant acceleration; u is the step's mean velocity
        let bend = 0.5 * offset * (offset + walls.dt);
        let at = |x: &[f64], u: &[f64], a: &[f64]| -> Vec<f64> {
            (0..m).map(|k| x[k] + offset * u[k] + bend * a[k]).collect()
        };
        let (wx, wy) = (at(&walls.x, &walls.u, &walls.ax), at(&walls.y, &walls.v, &walls.ay));
        let kinematics = WallKinematics { x: &wx, y: &wy, u: &walls.u, v: &walls.v, h: &walls.h };
        if !self.search.holds(&self.particles, &kinematics) {
            let life = LIST_LIFE * self.acoustic_limit();
            self.search.rebuild(&mut self.particles, &mut self.derived, &kinematics, self.parameters.mirror, life);
        }
        let (p, d) = (&self.particles, &self.derived);
        let n = p.len();
        self.rows.resize(n + self.search.fluid_images.len(), Row::default());
        sweep::gather_into(&mut self.rows[..n], |k| Row {
            x: p.x[k],
            y: p.y[k],
            u: p.u[k],
            v: p.v[k],
            p: d.pressure[k],
            volume: d.volume[k],
            fill: p.mass[k] / p.rho[k],
            h: p.h[k],
        });
        self.wall_rows.clear();
        self.faces.clear();
        for k in 0..m {
            let (x, y, u, v, h, volume) = (wx[k], wy[k], walls.u[k], walls.v[k], walls.h[k], walls.volume[k]);
            let (nx, ny) = (walls.nx[k], walls.ny[k]);
            self.wall_rows.push(Row { x, y, u, v, p: walls.pressure[k], volume, fill: volume, h });
            self.faces.push(Face { x, y, nx, ny, vn: u * nx + v * ny, volume, h });
        }
        let Some(mirror) = self.parameters.mirror else {
            return;
        };
        for (k, &source) in self.search.fluid_images.iter().enumerate() {
            let row = self.rows[source as usize];
            self.rows[n + k] = Row { x: mirror.reflect(row.x), u: -row.u, ..row };
        }
        for &source in &self.search.wall_images {
            let (row, face) = (self.wall_rows[source as usize], self.faces[source as usize]);
            self.wall_rows.push(Row { x: mirror.reflect(row.x), u: -row.u, ..row });
            self.faces.push(Face { x: mirror.reflect(face.x), nx: -face.nx, ..face });
        }
    }

    fn constants(&self) -> Constants {
        let p = &self.parameters;
        Constants { gravity: p.gravity, rho0: p.eos.rho0, c0: p.eos.c0, delta: p.delta, alpha: p.alpha, nu: p.nu }
    }

    /// Every state finite, every density believable.
    fn check(&self) -> Result<(), Breakdown> {
        let (p, time, rho0) = (&self.particles, self.time, self.parameters.eos.rho0);
        let sound = |k: usize| {
            let strain = (p.rho[k] / rho0 - 1.0).abs();
            let finite = (p.x[k] + p.y[k] + p.u[k] + p.v[k] + p.ax[k] + p.ay[k]).is_finite();
            if finite && strain < 0.3 { 1.0 } else { -1.0 }
        };
        if sweep::least(p.len(), sound) > 0.0 {
            return Ok(());
        }
        let k = (0..p.len()).find(|&k| sound(k) < 0.0).unwrap_or(0);
        let (id, x, y, rho) = (p.id[k], p.x[k], p.y[k], p.rho[k]);
        Err(if rho.is_finite() && (p.ax[k] + p.ay[k] + p.u[k] + p.v[k] + x + y).is_finite() {
            Breakdown::Density { id, x, y, rho, time }
        } else {
            Breakdown::NotFinite { id, x, y, time }
        })
    }
}

struct DensityRate<'a> {
    fluid: &'a [Row],
    faces: &'a [Face],
    rho: &'a [f64],
    search: &'a Search,
    constants: Constants,
    out: &'a mut [f64],
}

impl WithKernel for DensityRate<'_> {
    type Out = ();
    fn with<K: Shape>(self) {
        let DensityRate { fluid, faces, rho, search, constants, out } = self;
        sweep::gather_into(out, |k| {
            let near = search.fluid.of(k).iter().map(|&j| &fluid[j as usize]);
            let walls = search.walls_of_fluid.of(k).iter().map(|&j| &faces[j as usize]);
            pair::density_rate::<K>(&fluid[k], rho[k], near, walls, &constants)
        });
    }
}

struct WallState<'a> {
    fluid: &'a [Row],
    walls: &'a [Row],
    acceleration: (&'a [f64], &'a [f64]),
    search: &'a Search,
    constants: Constants,
    out: &'a mut [Extrapolated],
}

impl WithKernel for WallState<'_> {
    type Out = ();
    fn with<K: Shape>(self) {
        let WallState { fluid, walls, acceleration: (ax, ay), search, constants, out } = self;
        sweep::gather_into(out, |k| {
            let near = search.fluid_of_wall.of(k).iter().map(|&j| &fluid[j as usize]);
            pair::extrapolate::<K>(&walls[k], [ax[k], ay[k]], near, &constants)
        });
    }
}

struct Momentum<'a> {
    fluid: &'a [Row],
    walls: &'a [Row],
    search: &'a Search,
    constants: Constants,
    wall_nu: f64,
    out: &'a mut [Gathered],
}

impl WithKernel for Momentum<'_> {
    type Out = ();
    fn with<K: Shape>(self) {
        let Momentum { fluid, walls, search, constants, wall_nu, out } = self;
        sweep::gather_into(out, |k| {
            let near = search.fluid.of(k).iter().map(|&j| &fluid[j as usize]);
            let near_walls = search.walls_of_fluid.of(k).iter().map(|&j| &walls[j as usize]);
            pair::momentum::<K>(&fluid[k], near, near_walls, &constants, wall_nu)
        });
    }
}

struct WallForce<'a> {
    fluid: &'a [Row],
    walls: &'a [Row],
    search: &'a Search,
    constants: Constants,
    wall_nu: f64,
    out: &'a mut [[f64; 2]],
}

impl WithKernel for WallForce<'_> {
    type Out = ();
    fn with<K: Shape>(self) {
        let WallForce { fluid, walls, search, constants, wall_nu, out } = self;
        sweep::gather_into(out, |k| {
            let near = search.fluid_of_wall.of(k).iter().map(|&j| &fluid[j as usize]);
            pair::wall_force::<K>(&walls[k], near, &constants, wall_nu)
        });
    }
}
