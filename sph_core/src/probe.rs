//! Pressure read from the fluid at points (THEORY GE2).

use crate::fluid::Fluid;
use crate::neighbours::cells::{Cells, Point};
use crate::neighbours::visibility::Visibility;

/// A place with less of its kernel filled is dry.
const LEAST_FILLING: f64 = 0.125;
/// Least determinant of the particles' second moments, over that of a ring of radius h.
const LEAST_SPREAD: f64 = 1e-3;

/// What moving least squares find at a point (GE7).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FirstOrder {
    /// Pressure [Pa].
    pub pressure: f64,
    /// Velocity gradient [1/s]: [[∂u/∂x, ∂u/∂y], [∂v/∂x, ∂v/∂y]].
    pub gradient: [[f64; 2]; 2],
}

/// A reader of the fluid as it stands now; make one per moment, read many points.
///
/// ```
/// use sph_core::Probe;
/// use sph_core::{Domain, Fluid, Seed, wcsph};
/// let seed = |k: usize| Seed { at: [0.1 * (k % 9) as f64, 0.1 * (k / 9) as f64], velocity: [0.0; 2], area: 0.01, pressure: 0.0 };
/// let settings = wcsph::Settings { sound_speed: 20.0.into(), ..wcsph::Settings::default() };
/// let fluid = Fluid::new(Domain::default(), &settings, &(0..81).map(seed).collect::<Vec<_>>());
/// assert!((Probe::new(&fluid).filling([0.4, 0.4]) - 1.0).abs() < 0.01);
/// ```
pub struct Probe<'a> {
    fluid: &'a Fluid,
    cells: Cells,
    visibility: Visibility,
    reach: f64,
    /// Range of 2 Σ V W on a face beside a lattice, where water keeps the fillings of one.
    face: Option<[f64; 2]>,
}

/// Particles, and their mirror images next to a plane of symmetry, that count.
fn points(fluid: &Fluid, counts: impl Fn(&Point) -> bool) -> Vec<Point> {
    let p = fluid.particles();
    let all = || (0..p.len()).map(|k| Point::at_rest([p.x[k], p.y[k]], 2.0 * p.h[k], k as u32));
    let mut points: Vec<Point> = all().filter(&counts).collect();
    if let Some(mirror) = fluid.domain().mirror {
        let near = all().filter(|q| q.x - mirror.at < 2.0 * q.reach);
        points.extend(near.map(|q| Point { x: mirror.reflect(q.x), ..q }).filter(&counts));
    }
    points
}

impl<'a> Probe<'a> {
    /// Sort the fluid, and its images, for reading.
    pub fn new(fluid: &'a Fluid) -> Probe<'a> {
        let (p, mut points) = (fluid.particles(), points(fluid, |_| true));
        if let Some(periodic) = fluid.domain().periodic {
            let own = Cells::build(&points);
            for [sx, sy] in periodic.shifts() {
                let moved = (0..p.len()).map(|k| Point { x: p.x[k] + sx, y: p.y[k] + sy, ..points[k] });
                let near: Vec<Point> = moved.filter(|q| own.any_meets(q)).collect();
                points.extend(near);
            }
        }
        Probe::of(fluid, &points)
    }

    /// The same for reading at `places` [m] alone: what is farther from them than its kernel reaches is not sorted.
    pub fn near(fluid: &'a Fluid, places: &[[f64; 2]]) -> Probe<'a> {
        if fluid.domain().periodic.is_some() {
            return Probe::new(fluid);
        }
        let none = [f64::INFINITY, f64::NEG_INFINITY];
        let [x, y] = places
            .iter()
            .fold([none; 2], |all, at| std::array::from_fn(|k| [all[k][0].min(at[k]), all[k][1].max(at[k])]));
        let between = |place: f64, [low, high]: [f64; 2], reach: f64| low - reach <= place && place <= high + reach;
        let reaches = |q: &Point| {
            let beside = |[x, y]: &[f64; 2]| between(q.x, [*x; 2], q.reach) && between(q.y, [*y; 2], q.reach);
            between(q.x, x, q.reach) && between(q.y, y, q.reach) && places.iter().any(beside)
        };
        Probe::of(fluid, &points(fluid, reaches))
    }

    /// Of those of the fluid, and of its images, that count.
    fn of(fluid: &'a Fluid, points: &[Point]) -> Probe<'a> {
        let widest = points.iter().map(|q| q.reach).fold(0.0, f64::max);
        let visibility = Visibility::new(&fluid.system().packed.midlines, fluid.domain().mirror);
        let face = fluid.face_kernel_sum();
        Probe { fluid, cells: Cells::build(points), visibility, reach: 2.0 * widest, face }
    }

    /// Call `take` with weight V W and index of every particle around `at` [m] that is seen from there (WA8), each with its
    /// own kernel.
    fn around(&self, at: [f64; 2], mut take: impl FnMut(f64, &Point)) {
        let (p, d, kernel) = (self.fluid.particles(), self.fluid.fields(), self.fluid.domain().fluid.kernel);
        let view = self.visibility.from(at, self.reach);
        self.cells.for_each_within(at[0], at[1], 0.0, |q| {
            if !view.shows([q.x, q.y]) {
                return;
            }
            let k = q.index as usize;
            let w = kernel.value((at[0] - q.x).hypot(at[1] - q.y), p.h[k]);
            take(d.volume_of(k, p) * w, q);
        });
    }

    /// GE2: pressure on a flat face with unit normal `normal` into the fluid [Pa]: 2 Σ V (p − s n·(r_b − r)) W,
    /// where `slope` s = ρ(g − a)·n [Pa/m] is the pressure's slope along the normal that the wall imposes.
    /// It falls to zero by itself where the face is dry. Valid farther than one support 2h from an edge. Water that a
    /// projection moves keeps the fillings of a lattice: there it is divided by 2 Σ V W as far as that is a lattice's.
    pub fn on_flat_face(&self, at: [f64; 2], normal: [f64; 2], slope: f64) -> f64 {
        let (mut sum, mut filling) = (0.0, 0.0);
        self.around(at, |weight, q| {
            let height = (q.x - at[0]) * normal[0] + (q.y - at[1]) * normal[1];
            sum += weight * (self.fluid.fields().pressure[q.index as usize] - slope * height);
            filling += weight;
        });
        let norm = self.face.map_or(1.0, |[least, most]| (2.0 * filling).clamp(least, most));
        2.0 * sum / norm
    }

    /// Filling Σ V W [-] of a place by water alone.
    pub fn filling(&self, at: [f64; 2]) -> f64 {
        let mut filling = 0.0;
        self.around(at, |weight, _| filling += weight);
        filling
    }

    /// GE8: how wet a place of the surface is [-]: 2 Σ V W, at most 1; 0 on a dry face, ½ under a film a particle thick.
    pub fn wetness(&self, at: [f64; 2]) -> f64 {
        (2.0 * self.filling(at)).min(1.0)
    }

    /// GE6: Shepard mean of the pressure carried to `at` by the field ρ(g − a) [Pa/m], as walls read it (WA3); zero where
    /// less than an eighth of the kernel is filled. Exact for a hydrostatic field, at corners too.
    pub fn carried(&self, at: [f64; 2], field: [f64; 2]) -> f64 {
        let (mut pressure, mut filling) = (0.0, 0.0);
        self.around(at, |weight, q| {
            let carry = field[0] * (at[0] - q.x) + field[1] * (at[1] - q.y);
            pressure += weight * (self.fluid.fields().pressure[q.index as usize] + carry);
            filling += weight;
        });
        if filling < LEAST_FILLING { 0.0 } else { pressure / filling }
    }

    /// GE7: pressure and velocity gradient by first-order moving least squares; `None` where less than an eighth of the
    /// kernel is filled, or where the particles lie in a line.
    pub fn least_squares(&self, at: [f64; 2]) -> Option<FirstOrder> {
        let (mut m, mut moments) = ([0.0; 6], [[0.0; 3]; 3]);
        let (p, d) = (self.fluid.particles(), self.fluid.fields());
        let mut reach = 0.0_f64;
        self.around(at, |weight, q| {
            let k = q.index as usize;
            let (dx, dy) = (q.x - at[0], q.y - at[1]);
            let side = if (q.x - p.x[k]).abs() > 0.0 { -1.0 } else { 1.0 }; // an image goes the other way
            let terms = [1.0, dx, dy, dx * dx, dx * dy, dy * dy];
            for (sum, term) in m.iter_mut().zip(terms) {
                *sum += weight * term;
            }
            for (row, value) in moments.iter_mut().zip([d.pressure[k], side * p.u[k], p.v[k]]) {
                for (sum, term) in row.iter_mut().zip([1.0, dx, dy]) {
                    *sum += weight * value * term;
                }
            }
            reach = reach.max(p.h[k]);
        });
        let [m0, mx, my, mxx, mxy, myy] = m;
        // second moments about the mean place
        let (x, y) = (mx / m0, my / m0);
        let (xx, xy, yy) = (mxx - m0 * x * x, mxy - m0 * x * y, myy - m0 * y * y);
        let determinant = xx * yy - xy * xy;
        if m0 < LEAST_FILLING || determinant < LEAST_SPREAD * (m0 * reach * reach).powi(2) {
            return None;
        }
        let [pressure, u, v] = moments.map(|[value, along_x, along_y]| {
            let (bx, by) = (along_x - value * x, along_y - value * y);
            let gradient = [(yy * bx - xy * by) / determinant, (xx * by - xy * bx) / determinant];
            (value / m0 - gradient[0] * x - gradient[1] * y, gradient)
        });
        Some(FirstOrder { pressure: pressure.0, gradient: [u.1, v.1] })
    }

    /// GE2: Shepard mean Σ V p W/Σ V W [Pa]: for corners and points inside the fluid; zero where less than an
    /// eighth of the kernel is filled.
    pub fn shepard(&self, at: [f64; 2]) -> f64 {
        self.carried(at, [0.0; 2])
    }
}
