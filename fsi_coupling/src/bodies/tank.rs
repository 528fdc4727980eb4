//! The tank: floor and side walls at rest, sampled at the spacing of the water beside them.

use std::f64::consts::FRAC_1_SQRT_2;

use serde::{Deserialize, Serialize};
use sph_core::state_bytes::{StateError, decode, encode};
use sph_core::walls::Resultant;
use sph_core::{PlateMidline, WallForces, WallPoint, WallsMut};

use crate::bodies::body::{Contact, Inspect, Linked, WettedBody};
use crate::bodies::error::BodyError;
use crate::bodies::state::{ContactImpulse, Energy, Momentum, Solid, SurfacePoint};
use crate::geometry::layout::Layout;
use crate::geometry::plate::Plate;
use crate::geometry::plate_sampling;
use crate::geometry::rows::WallRows;

/// A rectangular open tank. Its particles never move.
pub struct Tank {
    layout: Layout,
    x: [f64; 2],
    floor: f64,
    rim: f64,
    half: bool,
    plates: Vec<Plate>,
    /// Depth of the side walls' rows [m].
    thickness: f64,
    points: Vec<WallPoint>,
    mean: [f64; 2],
    state: State,
    checkpoint: State,
}

/// What a step changes.
#[derive(Clone, Copy, Default, Serialize, Deserialize)]
struct State {
    external: [f64; 2],
    /// Of links, in the first half of the next step [N/m].
    reaction: [f64; 2],
}

impl Tank {
    /// Inner walls at `x` [m], floor and rim at the given heights [m]; with `half`, a plane of symmetry instead of the wall at
    /// x[0].
    pub fn new(layout: Layout, x: [f64; 2], floor: f64, rim: f64, half: bool) -> Tank {
        let (plates, points, state) = (Vec::new(), Vec::new(), State::default());
        let (thickness, mean) = (f64::INFINITY, [0.0; 2]);
        Tank { layout, x, floor, rim, half, plates, thickness, points, mean, state, checkpoint: state }
    }

    /// The same tank with fixed plates [m] whose roots are in its walls (THEORY WA10).
    pub fn with_plates(self, plates: Vec<Plate>) -> Tank {
        Tank { plates, ..self }
    }

    /// Stations (middle, length) that divide [a, b] at the spacing of the water beside it.
    fn divide(&self, a: f64, b: f64, beside: impl Fn(f64) -> [f64; 2]) -> Vec<(f64, f64)> {
        let mut parts = vec![(a, 0.0)]; // running coordinate, number of spacings so far
        let mut t = a;
        while t < b {
            let spacing = self.layout.spacing_at(beside(t));
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
        let point = |at, normal, s: f64, depth| WallPoint { at, normal, area: s * s, spacing: s, depth, midline: None };
        // shifted rows: the floor's towards the plane of symmetry or to the right, the sides' upwards
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

    fn kinematics(&self, _ahead: f64, out: WallsMut<'_>) -> Vec<PlateMidline> {
        for (k, p) in self.points.iter().enumerate() {
            [out.x[k], out.y[k]] = p.at;
        }
        Vec::new()
    }

    fn load(&mut self, force: WallForces<'_>) {
        self.mean = force.mean_resultant([0.0, 0.0]).force;
    }

    fn advance(&mut self, dt: f64) -> Result<(), BodyError> {
        for k in 0..2 {
            self.state.external[k] -= dt * (self.mean[k] + 0.5 * self.state.reaction[k]);
        }
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
        let left = if self.half { f64::INFINITY } else { at[0] - self.x[0] };
        let side = left.min(self.x[1] - at[0]);
        let beside = side < -self.thickness;
        let above = at[1] - self.rim;
        match (side >= 0.0, beside || above > 0.0) {
            (true, _) => side.min(at[1] - self.floor),
            (false, true) => f64::INFINITY,
            (false, false) => side.max(above).min(at[1] - self.floor),
        }
    }

    /// Of two walls that a point is behind, in a corner, the one that is further from it.
    fn surface(&self, at: [f64; 2]) -> SurfacePoint {
        let left = if self.half { f64::INFINITY } else { at[0] - self.x[0] };
        let fixed = |at, normal| SurfacePoint { at, normal, velocity: [0.0; 2] };
        let planes = [
            (at[1] - self.floor, fixed([at[0], self.floor], [0.0, 1.0])),
            (self.x[1] - at[0], fixed([self.x[1], at[1]], [-1.0, 0.0])),
            (left, fixed([self.x[0], at[1]], [1.0, 0.0])),
        ];
        let nearer = |a: (f64, SurfacePoint), b: (f64, SurfacePoint)| if b.0 < a.0 { b } else { a };
        planes.into_iter().reduce(nearer).unwrap_or(planes[0]).1
    }

    fn apply_impulse(&mut self, contact: &ContactImpulse) {
        let (_, impulse) = contact.resultant();
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
        Energy::default()
    }

    fn momentum(&self) -> Momentum {
        Momentum { momentum: [0.0; 2], external: self.state.external }
    }

    fn is_prescribed(&self) -> bool {
        true
    }
}
