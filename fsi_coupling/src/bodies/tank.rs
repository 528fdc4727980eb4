//! The tank: floor and side walls, sampled at the spacing of the water next to them. They are at rest; the left wall may be a piston.

use std::f64::consts::FRAC_1_SQRT_2;

use serde::{Deserialize, Serialize};
use sph_core::state_bytes::{StateError, decode, encode};
use sph_core::walls::Resultant;
use sph_core::{PlateMidline, WallForces, WallPoint, WallsMut};
use water_entry::waves::piston_motion::PistonMotion;

use crate::bodies::body::{Contact, Inspect, Linked, WettedBody};
use crate::bodies::error::BodyError;
use crate::bodies::state::{ContactImpulse, Energy, Momentum, Solid, SurfacePoint};
use crate::geometry::layout::Layout;
use crate::geometry::plate::Plate;
use crate::geometry::plate_sampling;
use crate::geometry::rows::WallRows;

/// A rectangular open tank. Its particles never move, but for those of a piston.
pub struct Tank {
    layout: Layout,
    x: [f64; 2],
    floor: f64,
    rim: f64,
    half: bool,
    plates: Vec<Plate>,
    /// Depth of the side walls' layers [m].
    thickness: f64,
    points: Vec<WallPoint>,
    piston: Option<PistonMotion>,
    /// Mean force of the step on all of it and along x on its piston [N/m].
    mean: [f64; 2],
    mean_on_piston: f64,
    state: State,
    checkpoint: State,
}

/// What a step changes.
#[derive(Clone, Copy, Default, Serialize, Deserialize)]
struct State {
    time: f64,
    external: [f64; 2],
    work: f64,
    /// Of links, in the first half of the next step [N/m].
    reaction: [f64; 2],
}

impl Tank {
    /// Inner walls at `x` [m], floor and rim at the given heights [m]; with `half`, a plane of symmetry instead of the wall at
    /// x[0].
    pub fn new(layout: Layout, x: [f64; 2], floor: f64, rim: f64, half: bool) -> Tank {
        let (plates, points, mean) = (Vec::new(), Vec::new(), [0.0; 2]);
        let (thickness, piston, state) = (f64::INFINITY, None, State::default());
        let (mean_on_piston, checkpoint) = (0.0, state);
        Tank { layout, x, floor, rim, half, plates, thickness, points, piston, mean, mean_on_piston, state, checkpoint }
    }

    /// The same tank whose left wall is a piston that moves along the floor (THEORY WA14), with a clock that starts at `time` [s].
    /// Not with a plane of symmetry.
    pub fn with_piston(self, motion: PistonMotion, time: f64) -> Tank {
        Tank { piston: Some(motion), state: State { time, ..self.state }, ..self }
    }

    /// Displacement [m], velocity [m/s] and acceleration [m/s²] of the piston `ahead` [s] from now.
    fn piston_at(&self, ahead: f64) -> [f64; 3] {
        self.piston.map_or([0.0; 3], |piston| piston.at(self.state.time + ahead))
    }

    /// x of the left wall now [m].
    fn left_wall(&self) -> f64 {
        self.x[0] + self.piston_at(0.0)[0]
    }

    /// Side walls: x of the inner face [m], 1 to the right or −1 to the left of the water, velocity [m/s].
    fn walls(&self) -> impl Iterator<Item = (f64, f64, f64)> {
        let left = (!self.half).then(|| (self.left_wall(), -1.0, self.piston_at(0.0)[1]));
        std::iter::once((self.x[1], 1.0, 0.0)).chain(left)
    }

    /// True for a particle that moves with the piston: all that are above the floor and left of the water.
    fn is_piston(&self, point: &WallPoint) -> bool {
        self.piston.is_some() && point.at[0] < self.x[0] && point.at[1] > self.floor
    }

    /// Particles of the floor behind the piston, as far as it moves back and its layers are deep.
    fn floor_behind(&self, rows: &WallRows) -> Vec<WallPoint> {
        let Some(piston) = self.piston else { return Vec::new() };
        let s = self.layout.spacing_at([self.x[0], self.floor]);
        let columns = rows.layers + (piston.reach() / s).ceil() as usize;
        let cells = (0..columns).flat_map(|column| (0..rows.layers).map(move |layer| (column, layer)));
        let point = |(column, layer): (usize, usize)| {
            let (depth, shift) = (WallRows::depth(layer, s), if rows.is_shifted(layer) { 0.5 * s } else { 0.0 });
            let at = [self.x[0] - WallRows::depth(column, s) + shift, self.floor - depth];
            WallPoint {
                at,
                normal: [0.0, 1.0],
                area: s * s,
                spacing: s,
                depth,
                outline: Default::default(),
                midline: None,
            }
        };
        cells.map(point).collect()
    }

    /// The same tank with fixed plates [m] whose roots are in its walls (THEORY WA10).
    pub fn with_plates(self, plates: Vec<Plate>) -> Tank {
        Tank { plates, ..self }
    }

    /// Stations (middle, length) that divide [a, b] at the spacing of the water next to it.
    fn divide(&self, a: f64, b: f64, next_to: impl Fn(f64) -> [f64; 2]) -> Vec<(f64, f64)> {
        let mut parts = vec![(a, 0.0)]; // running coordinate, number of spacings so far
        let mut t = a;
        while t < b {
            let spacing = self.layout.spacing_at(next_to(t));
            let step = (0.02 * spacing).min(b - t);
            t += step.max(1e-12 * (b - a));
            parts.push((t, parts[parts.len() - 1].1 + step / spacing));
        }
        let total = parts[parts.len() - 1].1;
        let count = total.round().max(1.0) as usize;
        let at = |n: f64| {
            let k = parts.partition_point(|(_, m)| *m < n).clamp(1, parts.len() - 1);
            let ((t0, n0), (t1, n1)) = (parts[k - 1], parts[k]);
            if n1 > n0 { t0 + (n - n0) / (n1 - n0) * (t1 - t0) } else { t0 }
        };
        let edge = |k: usize| at(total * k as f64 / count as f64);
        let piece = |k: usize| (0.5 * (edge(k) + edge(k + 1)), edge(k + 1) - edge(k));
        (0..count).map(piece).collect()
    }
}

impl WettedBody for Tank {
    fn sample(&mut self, rows: &WallRows) -> Result<Vec<WallPoint>, BodyError> {
        let (mut points, layers) = (Vec::new(), rows.layers);
        let depth = WallRows::depth;
        let point = |at, normal, s: f64, depth| WallPoint {
            at,
            normal,
            area: s * s,
            spacing: s,
            depth,
            outline: Default::default(),
            midline: None,
        };
        // shifted layers: the floor's towards the plane of symmetry or to the right, the sides' upwards
        let shift = |layer: usize, s: f64| if rows.is_shifted(layer) { 0.5 * s } else { 0.0 };
        let way = if self.half { -1.0 } else { 1.0 };
        for (x, s) in self.divide(self.x[0], self.x[1], |x| [x, self.floor]) {
            for layer in 0..layers {
                let x = x + way * shift(layer, s);
                let on_plane = self.half && x - self.x[0] < 1e-6 * s;
                let at = [if on_plane { self.x[0] } else { x }, self.floor - depth(layer, s)];
                let area = if on_plane { 0.5 * s * s } else { s * s };
                points.push(WallPoint { area, ..point(at, [0.0, 1.0], s, depth(layer, s)) });
            }
        }
        let sides: &[(f64, f64)] = if self.half { &[(1.0, self.x[1])] } else { &[(1.0, self.x[1]), (-1.0, self.x[0])] };
        for &(out, wall) in sides {
            for (y, s) in self.divide(self.floor, self.rim, |y| [wall, y]) {
                for layer in 0..layers {
                    let at = [wall + out * depth(layer, s), y + shift(layer, s)];
                    points.push(point(at, [-out, 0.0], s, depth(layer, s)));
                }
            }
            if out < 0.0 && self.piston.is_some() {
                points.extend(self.floor_behind(rows));
                continue;
            }
            let s = self.layout.spacing_at([wall, self.floor]);
            for (i, j) in (0..layers).flat_map(|i| (0..layers).map(move |j| (i, j))) {
                let at = [wall + out * depth(i, s) + way * shift(j, s), self.floor - depth(j, s) + shift(i, s)];
                // the mirror point is then the corner's own diagonal opposite, in the water
                points.push(point(
                    at,
                    [-out * FRAC_1_SQRT_2, FRAC_1_SQRT_2],
                    s,
                    FRAC_1_SQRT_2 * (depth(i, s) + depth(j, s)),
                ));
            }
        }
        let spacing = sides.iter().map(|&(_, wall)| self.layout.spacing_at([wall, self.rim])).fold(0.0, f64::max);
        self.thickness = layers as f64 * spacing;
        points = self.plates.iter().fold(points, plate_sampling::cut);
        self.points = points.clone();
        Ok(points)
    }

    /// The piston has a constant acceleration in the step and ends where its motion does.
    fn kinematics(&self, ahead: f64, out: WallsMut<'_>) -> Vec<PlateMidline> {
        let ([now, velocity, _], [then, _, acceleration]) = (self.piston_at(0.0), self.piston_at(ahead));
        let mean = if ahead > 0.0 { (then - now) / ahead } else { velocity };
        for (k, p) in self.points.iter().enumerate() {
            [out.x[k], out.y[k]] = p.at;
            if self.is_piston(p) {
                (out.x[k], out.u[k], out.ax[k]) = (p.at[0] + then, mean, acceleration);
            }
        }
        Vec::new()
    }

    fn load(&mut self, force: WallForces<'_>) {
        self.mean = force.mean_resultant([0.0, 0.0]).force;
        if self.piston.is_some() {
            let on_piston = self.points.iter().zip(force.mean_fx).filter(|(p, _)| self.is_piston(p));
            self.mean_on_piston = on_piston.map(|(_, f)| f).sum();
        }
    }

    fn advance(&mut self, dt: f64) -> Result<(), BodyError> {
        self.state.work += self.mean_on_piston * (self.piston_at(dt)[0] - self.piston_at(0.0)[0]);
        for k in 0..2 {
            self.state.external[k] -= dt * (self.mean[k] + 0.5 * self.state.reaction[k]);
        }
        self.state.time += dt;
        Ok(())
    }

    fn checkpoint(&mut self) {
        self.checkpoint = self.state;
    }

    fn restore(&mut self) {
        self.state = self.checkpoint;
    }

    fn to_bytes(&self) -> Vec<u8> {
        encode(&self.state)
    }

    fn restore_bytes(&mut self, bytes: &[u8]) -> Result<(), StateError> {
        self.state = decode("the tank", bytes)?;
        Ok(())
    }
}

impl Contact for Tank {
    /// Water that went over the rim and is outside the thickness of a side wall is not in a wall.
    fn signed_distance(&self, at: [f64; 2]) -> f64 {
        let left = if self.half { f64::INFINITY } else { at[0] - self.left_wall() };
        let side = left.min(self.x[1] - at[0]);
        let past_side = side < -self.thickness;
        let above = at[1] - self.rim;
        match (side >= 0.0, past_side || above > 0.0) {
            (true, _) => side.min(at[1] - self.floor),
            (false, true) => f64::INFINITY,
            (false, false) => side.max(above).min(at[1] - self.floor),
        }
    }

    /// Of two walls that a point is behind, in a corner, the one that is further from it.
    fn surface(&self, at: [f64; 2]) -> SurfacePoint {
        let wall = self.left_wall();
        let left = if self.half { f64::INFINITY } else { at[0] - wall };
        let fixed = |at, normal| SurfacePoint { at, normal, velocity: [0.0; 2] };
        let piston = SurfacePoint { at: [wall, at[1]], normal: [1.0, 0.0], velocity: [self.piston_at(0.0)[1], 0.0] };
        let planes = [
            (at[1] - self.floor, fixed([at[0], self.floor], [0.0, 1.0])),
            (self.x[1] - at[0], fixed([self.x[1], at[1]], [-1.0, 0.0])),
            (left, piston),
        ];
        let nearer = |a: (f64, SurfacePoint), b: (f64, SurfacePoint)| if b.0 < a.0 { b } else { a };
        planes.into_iter().reduce(nearer).unwrap_or(planes[0]).1
    }

    /// CO37: the floor, and walls that end at the rim and are as thick as their layers.
    fn met_by_solid(&self, at: [f64; 2]) -> (f64, SurfacePoint) {
        let [x, y] = at;
        let fixed = |at, normal| SurfacePoint { at, normal, velocity: [0.0; 2] };
        let mut met = vec![(y - self.floor, fixed([x, self.floor], [0.0, 1.0]))];
        for (wall, out, speed) in self.walls() {
            let (inside, above) = (out * (wall - x), y - self.rim);
            let beyond = -inside - self.thickness;
            if beyond > 0.0 {
                return (f64::INFINITY, fixed(at, [out, 0.0])); // outside the tank
            }
            met.push(if inside > 0.0 && above > 0.0 {
                let away = inside.hypot(above);
                let surface = fixed([wall, self.rim], [-out * inside / away, above / away]);
                (away, SurfacePoint { velocity: [speed, 0.0], ..surface })
            } else if above > inside {
                (above, fixed([x, self.rim], [0.0, 1.0]))
            } else {
                (inside, SurfacePoint { velocity: [speed, 0.0], ..fixed([wall, y], [-out, 0.0]) })
            });
        }
        met.into_iter().reduce(|a, b| if b.0 < a.0 { b } else { a }).unwrap_or((f64::INFINITY, fixed(at, [0.0, 1.0])))
    }

    fn rims(&self) -> Vec<[f64; 2]> {
        let ends = self.walls().flat_map(|(wall, out, _)| [wall, wall + out * self.thickness]);
        ends.filter(|x| x.is_finite()).map(|x| [x, self.rim]).collect()
    }

    fn apply_impulse(&mut self, contact: &ContactImpulse) {
        let (at, impulse) = contact.resultant();
        if at[0] <= self.left_wall() {
            self.state.work += impulse[0] * self.piston_at(0.0)[1];
        }
        self.state.external = [0, 1].map(|k| self.state.external[k] - impulse[k]);
    }
}

impl Linked for Tank {
    fn solid(&self) -> Option<Solid> {
        Some(Solid { halves: if self.half { 2.0 } else { 1.0 }, ..Solid::default() })
    }

    fn apply_link_impulse(&mut self, impulse: Resultant) {
        self.state.external = [0, 1].map(|k| self.state.external[k] - impulse.force[k]);
    }

    fn set_reaction(&mut self, reaction: Resultant) {
        self.state.reaction = reaction.force;
    }
}

impl Inspect for Tank {
    fn name(&self) -> &str {
        "tank"
    }

    fn energy(&self) -> Energy {
        Energy { work: self.state.work, ..Energy::default() }
    }

    fn momentum(&self) -> Momentum {
        Momentum { momentum: [0.0; 2], external: self.state.external }
    }

    fn is_prescribed(&self) -> bool {
        true
    }
}
