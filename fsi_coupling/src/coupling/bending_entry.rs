//! A body that bends on its way into water that boundary elements follow (THEORY EN51–EN53).

use faer::c64;
use sph_core::{WallForces, WallsMut};
use water_entry::{
    AlongBottom, BendingBottom, BendingStepError, BendingWater, BottomMotion, Deflection, Section, WaterOnBottom,
};

use crate::bodies::body::Body;
use crate::bodies::error::BodyError;
use crate::coupling::quasi_newton::QuasiNewton;
use crate::geometry::rows::WallRows;

/// Boundary particles on half the breadth of the bottom.
const PARTICLES: f64 = 100.0;
/// Residual of the accelerations at which they fit the water's load, over what that causes [-], or over an acceleration of nothing wet [m/s²].
const TOLERANCE: f64 = 1e-6;
const AT_REST: f64 = 1.0;
/// Largest number of iterations per step.
const MOST_ITERATIONS: usize = 60;

/// Why the entry cannot be followed further.
#[derive(Debug, thiserror::Error)]
pub enum BendingEntryError {
    /// The flow or the structure.
    #[error(transparent)]
    Step(#[from] BendingStepError<BodyError>),
    /// The structure.
    #[error(transparent)]
    Body(#[from] BodyError),
    /// The body's bottom is not where the flow's is.
    #[error("no bottom of the body at a draught of {draught} m: its {points} boundary particles begin at {first:?} m")]
    NoBottom {
        /// Draught of the flow [m].
        draught: f64,
        /// Number of boundary particles.
        points: usize,
        /// The first of them [m].
        first: Option<[f64; 2]>,
    },
    /// Accelerations and load did not come to fit each other.
    #[error("accelerations and load of the water do not fit after {MOST_ITERATIONS} iterations, at t = {0} s")]
    NotConverged(f64),
}

/// Half of a symmetric body that bends, and the water about it.
pub struct BendingEntry {
    water: BendingWater,
    bottom: Bottom,
}

/// The body with its boundary particles on the bottom, from the keel outwards.
struct Bottom {
    body: Box<dyn Body>,
    /// Number of boundary particles of the body.
    count: usize,
    /// Those on the bottom, with their distance from the keel along it [m].
    particles: Vec<(usize, f64)>,
    /// Ends of the parts of the bottom that they stand for [m].
    cells: Vec<f64>,
    /// Where they were at the start [m].
    rest: Vec<[f64; 2]>,
    start: [f64; 2],
    draught: f64,
    density: f64,
    time: f64,
    /// Load without accelerations at an earlier time [s].
    earlier: Option<(f64, Vec<f64>)>,
    method: QuasiNewton,
    iterations: usize,
    pressure: BottomPressure,
}

/// Pressure on the right half of the bottom at a time.
#[derive(Clone, Debug, Default)]
pub struct BottomPressure {
    /// Time [s].
    pub time: f64,
    /// Distance from the plane of symmetry [m] and pressure [Pa], from the jet or the chine to the keel, shape (n, 2).
    pub places: Vec<[f64; 2]>,
}

impl BendingEntry {
    /// A body that is symmetric about x = 0 and simulated by half, where its bottom's `section` begins to bend
    /// ([`BendingWater::new`]): at its draught and speed, in water of a density [kg/m³].
    ///
    /// # Errors
    /// A body that cannot be sampled, or whose bottom is elsewhere.
    pub fn new(
        mut body: Box<dyn Body>,
        section: &Section,
        water: BendingWater,
        density: f64,
    ) -> Result<BendingEntry, BendingEntryError> {
        let half_breadth = water.bottom_half_breadth();
        let points = body.sample(&WallRows::filled(half_breadth / PARTICLES, 1))?;
        let motion = body.motion().unwrap_or_default();
        let keel = -water.draught();
        let is_on_bottom = |at: [f64; 2], normal: [f64; 2], depth: f64| {
            let foot = [0, 1].map(|k| at[k] + depth * normal[k]);
            let off = (foot[1] - keel - section.height(foot[0])).abs();
            let below = normal[1] < 0.0 && foot[0] > 0.0 && foot[0] <= half_breadth;
            (below && off < 0.02 * half_breadth).then(|| water.along_bottom(foot[0]))
        };
        let on_bottom = |(k, p): (usize, &sph_core::WallPoint)| Some((k, is_on_bottom(p.at, p.normal, p.depth)?));
        let mut particles: Vec<(usize, f64)> = points.iter().enumerate().filter_map(on_bottom).collect();
        if particles.len() < 3 {
            let first = points.first().map(|point| point.at);
            return Err(BendingEntryError::NoBottom { draught: water.draught(), points: points.len(), first });
        }
        particles.sort_by(|a, b| a.1.total_cmp(&b.1));
        let along: Vec<f64> = particles.iter().map(|particle| particle.1).collect();
        let between = along.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
        let cells = std::iter::once(0.0).chain(between).chain([water.along_bottom(half_breadth)]).collect();
        let bottom = Bottom {
            count: points.len(),
            particles,
            cells,
            rest: points.iter().map(|point| point.at).collect(),
            start: motion.position,
            draught: water.draught(),
            density,
            time: 0.0,
            earlier: None,
            method: QuasiNewton::default(),
            iterations: 0,
            pressure: BottomPressure::default(),
            body,
        };
        Ok(BendingEntry { water, bottom })
    }

    /// The body.
    pub fn body(&self) -> &dyn Body {
        &*self.bottom.body
    }

    /// Time since the start [s].
    pub fn time(&self) -> f64 {
        self.bottom.time
    }

    /// Draught of the undeformed keel [m].
    pub fn draught(&self) -> f64 {
        self.bottom.motion(0.0).draught
    }

    /// Half breadth between the ends of the jets [m].
    pub fn half_width(&self) -> f64 {
        self.water.half_width()
    }

    /// Have the chines become wet?
    pub fn chines_wet(&self) -> bool {
        self.water.chines_wet()
    }

    /// Pressure on the bottom in the last step.
    pub fn pressure(&self) -> &BottomPressure {
        &self.bottom.pressure
    }

    /// Iterations of accelerations and load so far.
    pub fn iterations(&self) -> usize {
        self.bottom.iterations
    }

    /// One step of body and water, to the time `until` [s] at most. Returns the step [s].
    ///
    /// # Errors
    /// A flow that breaks up, or the structure's.
    pub fn step(&mut self, until: f64) -> Result<f64, BendingEntryError> {
        let longest = (until - self.bottom.time).min(self.bottom.body.stable_dt());
        let dt = self.water.step_with(&mut self.bottom, longest)?;
        self.bottom.converged().map(|()| dt)
    }
}

impl Bottom {
    /// Kinematics `ahead` [s] from now: x, y, u, v, ax, ay, nx, ny of all particles.
    fn kinematics(&self, ahead: f64) -> [Vec<f64>; 8] {
        let mut arrays = [(); 8].map(|()| vec![0.0; self.count]);
        let [x, y, u, v, ax, ay, nx, ny] = &mut arrays;
        self.body.kinematics(ahead, WallsMut { x, y, u, v, ax, ay, nx, ny });
        arrays
    }

    /// Values of the particles along the bottom; those at the keel lie on the plane of symmetry.
    fn along(&self, of: impl Fn(usize) -> c64) -> AlongBottom {
        let [a, b] = [0, 1].map(|k| (self.particles[k].1, of(self.particles[k].0).im));
        let keel = c64::new(0.0, a.1 - (b.1 - a.1) * a.0 / (b.0 - a.0));
        let places: Vec<f64> = std::iter::once(0.0).chain(self.particles.iter().map(|particle| particle.1)).collect();
        AlongBottom::new(&places, std::iter::once(keel).chain(self.particles.iter().map(|p| of(p.0))).collect())
    }

    /// Forces [N/m] per normal on the particles of a pressure [Pa] at `nodes` along the bottom, from the jet to the keel.
    fn forces(&self, nodes: &[f64], pressure: &[f64]) -> Vec<f64> {
        let up_to = cumulative(nodes, pressure);
        let ends: Vec<f64> = self.cells.iter().map(|at| up_to(*at)).collect();
        ends.windows(2).map(|pair| pair[1] - pair[0]).collect()
    }

    /// No step was taken whose accelerations do not fit.
    fn converged(&self) -> Result<(), BendingEntryError> {
        match self.pressure.time.is_nan() {
            true => Err(BendingEntryError::NotConverged(self.time)),
            false => Ok(()),
        }
    }
}

/// ∫ p ds from the keel to a distance from it, of a pressure that is linear between `nodes`, the last of which is the keel.
fn cumulative<'a>(nodes: &'a [f64], pressure: &'a [f64]) -> impl Fn(f64) -> f64 + 'a {
    let mut sums = vec![0.0; nodes.len()];
    for k in (0..nodes.len() - 1).rev() {
        sums[k] = sums[k + 1] + 0.5 * (pressure[k] + pressure[k + 1]) * (nodes[k] - nodes[k + 1]);
    }
    move |at| {
        let k = nodes.partition_point(|s| *s > at);
        if k == 0 || k == nodes.len() {
            return if k == 0 { sums[0] } else { 0.0 };
        }
        let share = (at - nodes[k]) / (nodes[k - 1] - nodes[k]);
        let here = pressure[k] + share * (pressure[k - 1] - pressure[k]);
        sums[k] + 0.5 * (pressure[k] + here) * (at - nodes[k])
    }
}

impl BendingBottom for Bottom {
    type Error = BodyError;

    fn motion(&self, ahead: f64) -> BottomMotion {
        let [x, y, u, v, ..] = self.kinematics(0.0);
        let frame = self.body.motion().unwrap_or_default();
        let moved = [0, 1].map(|k| frame.position[k] - self.start[k]);
        let velocity = |k: usize| c64::new(u[k] - frame.velocity[0], v[k] - frame.velocity[1]);
        let displaced = |k: usize| c64::new(x[k] - self.rest[k][0] - moved[0], y[k] - self.rest[k][1] - moved[1]);
        let deflection = Deflection {
            displacement: self.along(|k| displaced(k) + velocity(k) * ahead),
            velocity: self.along(velocity),
        };
        let speed = -frame.velocity[1];
        BottomMotion { draught: self.draught - moved[1] + speed * ahead, speed, deflection }
    }

    fn advance(&mut self, dt: f64, water: &WaterOnBottom<'_>) -> Result<(), BodyError> {
        let [x, y, mut u, mut v, ax, ay, mut nx, mut ny] = self.kinematics(dt);
        let steady: Vec<f64> = water.steady.iter().map(|p| self.density * p).collect();
        let at = if water.in_middle { self.time + 0.5 * dt } else { self.time };
        let loads = self.forces(&water.along, &steady);
        // the load in the middle of the step
        let mean: Vec<f64> = match self.earlier.take() {
            Some((before, earlier)) if !water.in_middle => {
                let share = 0.5 * dt / (at - before);
                loads.iter().zip(&earlier).map(|(now, before)| now + share * (now - before)).collect()
            }
            _ => loads.clone(),
        };
        self.earlier = Some((at, loads));
        let mut owner = self.body.interface(dt)?;
        self.method.begin_step();
        let mut unknowns = owner.as_ref().map_or_else(Vec::new, |owner| owner.unknowns());
        let nothing = vec![0.0; self.count];
        let (mut fx, mut fy) = (nothing.clone(), nothing.clone());
        self.pressure = BottomPressure { time: f64::NAN, places: Vec::new() };
        for _ in 0..MOST_ITERATIONS {
            self.iterations += 1;
            let (mut ax, mut ay) = (ax.clone(), ay.clone());
            if let Some(owner) = &mut owner {
                let (mut x, mut y) = (x.clone(), y.clone());
                let walls = WallsMut {
                    x: &mut x,
                    y: &mut y,
                    u: &mut u,
                    v: &mut v,
                    ax: &mut ax,
                    ay: &mut ay,
                    nx: &mut nx,
                    ny: &mut ny,
                };
                owner.accelerate(&unknowns, walls);
            }
            let acceleration = self.along(|k| c64::new(ax[k], ay[k]));
            let caused: Vec<f64> = water.pressure_of(&acceleration).iter().map(|p| self.density * p).collect();
            let added = self.forces(&water.along, &caused);
            for (k, (particle, _)) in self.particles.iter().enumerate() {
                let push = -(mean[k] + added[k]);
                (fx[*particle], fy[*particle]) = (push * nx[*particle], push * ny[*particle]);
            }
            let forces = WallForces {
                x: &x,
                y: &y,
                fx: &fx,
                fy: &fy,
                mean_fx: &fx,
                mean_fy: &fy,
                mean_swing: &nothing,
                mirrored: true,
            };
            let found = owner.as_ref().map(|owner| owner.residual_in_mean(&forces)).unwrap_or_default();
            let size = |of: &[f64]| of.iter().map(|value| value * value).sum::<f64>().sqrt();
            if size(&found.residual) <= TOLERANCE * size(&found.driving).max(AT_REST) {
                let pressures = steady.iter().zip(&caused).map(|(steady, caused)| steady + caused);
                let places = water.places.iter().zip(pressures).map(|(x, p)| [*x, p]).collect();
                self.pressure = BottomPressure { time: at, places };
                self.body.load(forces);
                break;
            }
            unknowns = self.method.next(&unknowns, &found.residual);
        }
        self.body.advance(dt)?;
        self.time += dt;
        Ok(())
    }
}
