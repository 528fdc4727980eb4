//! The tank: floor and side walls at rest, sampled at the spacing of the water beside them.

use sph_core::{WallForces, WallPoint, WallsMut};

use crate::bodies::body::{BodyError, Energy, Ledger, Motion, Surface, WettedBody};
use crate::geometry::layout::Tiling;
use crate::geometry::outline::Outline;
use crate::geometry::rows::Arrangement;
use crate::geometry::thin_plate::{self, Plate};

/// A rectangular open tank. Its particles never move.
pub struct Tank {
    tiling: Tiling,
    x: [f64; 2],
    floor: f64,
    rim: f64,
    half: bool,
    arrangement: Arrangement,
    thickness: f64,
    points: Vec<WallPoint>,
    mean: [f64; 2],
    external: [f64; 2],
    saved: [f64; 2],
    plates: Vec<Plate>,
}

impl Tank {
    /// Inner walls at `x` [m], floor and rim at the given heights [m]; with `half`, no wall at x[0]: a
    /// plane of symmetry stands there.
    pub fn new(tiling: Tiling, x: [f64; 2], floor: f64, rim: f64, half: bool) -> Tank {
        let (thickness, points, none) = (f64::INFINITY, Vec::new(), [0.0; 2]);
        let arrangement = Arrangement::default();
        let plates = Vec::new();
        Tank {
            tiling,
            x,
            floor,
            rim,
            half,
            arrangement,
            thickness,
            points,
            mean: none,
            external: none,
            saved: none,
            plates,
        }
    }

    /// The same tank with fixed plates, where they stand [m], whose roots are in its walls (THEORY T3).
    pub fn carrying(self, plates: Vec<Plate>) -> Tank {
        Tank { plates, ..self }
    }

    /// Stations (middle, length) that divide [a, b] at the spacing of the water beside it.
    fn divide(&self, a: f64, b: f64, beside: impl Fn(f64) -> [f64; 2]) -> Vec<(f64, f64)> {
        let mut parts = vec![(a, 0.0)]; // running coordinate, number of spacings so far
        let mut t = a;
        while t < b {
            let spacing = self.tiling.spacing_at(beside(t));
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
    fn name(&self) -> &str {
        "tank"
    }

    fn arrange(&mut self, arrangement: Arrangement) {
        self.arrangement = arrangement;
    }

    fn sample(&mut self, _spacing: f64, layers: usize) -> Result<Vec<WallPoint>, BodyError> {
        let mut points = Vec::new();
        let arrangement = self.arrangement;
        let depth = |layer: usize, s: f64| (layer as f64 + 0.5) * s;
        // rows aside: the floor's towards the plane of symmetry or to the right, the sides' upwards
        let aside = |layer: usize, s: f64| if arrangement.aside(layer) { 0.5 * s } else { 0.0 };
        let way = if self.half { -1.0 } else { 1.0 };
        for (x, s) in self.divide(self.x[0], self.x[1], |x| [x, self.floor]) {
            for layer in 0..layers {
                let x = x + way * aside(layer, s);
                let on_plane = self.half && x - self.x[0] < 1e-6 * s;
                points.push(WallPoint {
                    at: [if on_plane { self.x[0] } else { x }, self.floor - depth(layer, s)],
                    normal: [0.0, 1.0],
                    area: if on_plane { 0.5 * s * s } else { s * s },
                    spacing: s,
                    depth: depth(layer, s),
                    screen: None,
                });
            }
        }
        let sides: &[(f64, f64)] = if self.half { &[(1.0, self.x[1])] } else { &[(1.0, self.x[1]), (-1.0, self.x[0])] };
        for &(out, wall) in sides {
            for (y, s) in self.divide(self.floor, self.rim, |y| [wall, y]) {
                for layer in 0..layers {
                    points.push(WallPoint {
                        at: [wall + out * depth(layer, s), y + aside(layer, s)],
                        normal: [-out, 0.0],
                        area: s * s,
                        spacing: s,
                        depth: depth(layer, s),
                        screen: None,
                    });
                }
            }
            let s = self.tiling.spacing_at([wall, self.floor]);
            for i in 0..layers {
                for j in 0..layers {
                    let normal = [-out * std::f64::consts::FRAC_1_SQRT_2, std::f64::consts::FRAC_1_SQRT_2];
                    points.push(WallPoint {
                        at: [wall + out * depth(i, s) + way * aside(j, s), self.floor - depth(j, s) + aside(i, s)],
                        normal,
                        area: s * s,
                        spacing: s,
                        // its mirror point is then the corner's own diagonal opposite, in the water
                        depth: std::f64::consts::FRAC_1_SQRT_2 * (depth(i, s) + depth(j, s)),
                        screen: None,
                    });
                }
            }
        }
        let spacing = sides.iter().map(|&(_, wall)| self.tiling.spacing_at([wall, self.rim])).fold(0.0, f64::max);
        self.thickness = layers as f64 * spacing;
        points = self.plates.iter().fold(points, thin_plate::cut);
        self.points = points.clone();
        Ok(points)
    }

    fn place(&self, _ahead: f64, out: WallsMut<'_>) {
        for (k, p) in self.points.iter().enumerate() {
            [out.x[k], out.y[k]] = p.at;
        }
    }

    fn load(&mut self, force: WallForces<'_>) {
        self.mean = force.mean_resultant([0.0, 0.0]).force;
    }

    fn advance(&mut self, dt: f64) -> Result<(), BodyError> {
        for k in 0..2 {
            self.external[k] -= dt * self.mean[k];
        }
        Ok(())
    }

    fn save(&mut self) {
        self.saved = self.external;
    }

    fn restore(&mut self) {
        self.external = self.saved;
    }

    fn energy(&self) -> Energy {
        Energy::default()
    }

    fn ledger(&self) -> Ledger {
        Ledger { momentum: [0.0; 2], external: self.external }
    }

    fn motion(&self) -> Option<Motion> {
        None
    }

    fn outline(&self) -> Option<&Outline> {
        None
    }

    /// Water that went over the rim, and lies outside the thickness of a side wall, is not in a wall.
    fn clearance(&self, at: [f64; 2]) -> f64 {
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

    fn surface(&self, at: [f64; 2]) -> Surface {
        let left = if self.half { f64::INFINITY } else { at[0] - self.x[0] };
        let planes = [
            (at[1] - self.floor, Surface { at: [at[0], self.floor], normal: [0.0, 1.0], velocity: [0.0; 2] }),
            (self.x[1] - at[0], Surface { at: [self.x[1], at[1]], normal: [-1.0, 0.0], velocity: [0.0; 2] }),
            (left, Surface { at: [self.x[0], at[1]], normal: [1.0, 0.0], velocity: [0.0; 2] }),
        ];
        let mut nearest = planes[0];
        for plane in planes {
            // beyond two walls, in a corner, out through the one that is deeper
            if plane.0 < nearest.0 {
                nearest = plane;
            }
        }
        nearest.1
    }

    fn strike(&mut self, _at: [f64; 2], impulse: [f64; 2]) {
        self.external = [0, 1].map(|k| self.external[k] - impulse[k]);
    }

    fn prescribed(&self) -> bool {
        true
    }
}
