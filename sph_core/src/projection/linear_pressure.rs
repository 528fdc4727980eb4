//! The force of a linear pressure on closed bodies, exact in any arrangement of the particles (THEORY PR19).

use std::ops::Range;

use crate::interactions::geometry::pair_geometry;
use crate::interactions::pair::TOUCHED;
use crate::kernel::{Shape, TargetSum};
use crate::projection::lattice::Lattice;
use crate::system::ParticleSystem;
use crate::walls::outline::{closed_owners, turning_forces};
use crate::walls::{OutlineShare, Walls};

/// Weight of the hydrostatic gradient in the fit: that of as many particles at a smoothing length's distance as there are [-].
const STIFFNESS: f64 = 0.01;
/// Mean difference from the pressure of still water, over that pressure [-]: water is still up to the first, and not from the second on.
const STILL: [f64; 2] = [0.25, 0.5];
/// Shares of Σ V W beside a flat wall [-]: from the first on the water near air counts as still water, from the second on in full.
const FEW: f64 = 0.6;
const MANY: f64 = 0.9;

/// What PR19 reads of a wall particle; no more than its outline where no water is near.
#[derive(Clone, Copy, Debug, Default)]
struct Place {
    /// Position at the start of the step [m].
    at: [f64; 2],
    /// Position of the surface above it [m].
    surface: [f64; 2],
    /// Unit normal [-].
    normal: [f64; 2],
    /// Depth below that [m].
    depth: f64,
    /// Its share of the outline, in the frame of the normal.
    outline: OutlineShare,
    /// V_w ΣV∇W/κ [m].
    gradient: [f64; 2],
    /// V_w ΣV r⊗∇W/κ, symmetric [m²].
    second: [f64; 3],
    /// ω: share of the water in its support that is not near air [-].
    covered: f64,
    /// 1 where the water is as thick as beside a flat wall; 0 under a film [-].
    wet: f64,
    /// Share of the pressure that fits best; the same for all of a body [-].
    fits: f64,
    /// Smoothing length [m].
    h: f64,
}

/// The places of all wall particles in one step.
#[derive(Clone, Debug, Default)]
pub(crate) struct LinearPressure {
    places: Vec<Place>,
    /// ρ₀ g [N/m³].
    weight: [f64; 2],
    /// Pressure of still water at the origin (PR11) [Pa].
    head: f64,
    mirrored: bool,
}

/// A linear pressure P(r) = p + G·(r − middle).
#[derive(Clone, Copy, Debug, PartialEq)]
struct Field {
    middle: [f64; 2],
    pressure: f64,
    gradient: [f64; 2],
}

impl Field {
    fn at(&self, r: [f64; 2]) -> f64 {
        self.pressure + self.gradient[0] * (r[0] - self.middle[0]) + self.gradient[1] * (r[1] - self.middle[1])
    }
}

impl LinearPressure {
    /// Find the places of packed walls; `air` is the surface indicator (PR5), `head` as in PR11, `inverse` 1/κ (PR4).
    pub fn place(
        &mut self,
        system: &ParticleSystem,
        walls: &Walls,
        air: &[f64],
        (head, lattice): (f64, &Lattice),
        inverse: f64,
    ) {
        let domain = &system.domain;
        self.head = head;
        self.weight = domain.gravity.map(|g| domain.fluid.density * g);
        self.mirrored = domain.mirror.is_some();
        self.places.clear();
        self.places.resize(walls.len(), Place::default());
        for owner in closed_owners(walls) {
            let sum = Places { system, walls, air, lattice, inverse, first: owner.start };
            domain.fluid.kernel.gather(&sum, &mut self.places[owner.clone()]);
            let fits = self.fits(owner.clone(), &walls.pressure);
            self.places[owner].iter_mut().for_each(|place| place.fits = fits);
        }
    }

    /// Pressure of still water (PR11).
    fn still(&self) -> Field {
        Field { middle: [0.0; 2], pressure: self.head, gradient: self.weight }
    }

    /// 1 for a body that is all under water, and for one in still water: the pressures of the last step differ little from those of
    /// still water. 0 under an impact, whose pressure at the edge of the wetted face is not that of the integral.
    fn fits(&self, owner: Range<usize>, pressure: &[f64]) -> f64 {
        let (still, mut submerged, mut excess, mut sum) = (self.still(), 1.0, 0.0, 0.0);
        for (place, p) in self.places[owner.clone()].iter().zip(&pressure[owner]) {
            if place.outline.area != [0.0; 2] {
                submerged = place.covered.min(submerged);
            }
            let at_rest = still.at(place.at).max(0.0);
            excess += place.weight() * (p - at_rest).abs();
            sum += place.weight() * at_rest;
        }
        let calm = if sum > 0.0 { (STILL[1] - excess / sum) / (STILL[1] - STILL[0]) } else { 0.0 };
        calm.clamp(0.0, 1.0).max(submerged)
    }

    /// What the force on each particle of an owner changes by, under the wall pressures `pressure` [Pa]: the pairs' force of a
    /// linear pressure is taken off and its integral over the outline is added [N/m]. That pressure is the one that fits best, as far as
    /// the body is under water or the water is still; else it is that of still water. Linear in the pressures.
    pub fn correction(&self, owner: Range<usize>, pressure: &[f64]) -> Vec<[f64; 2]> {
        let places = &self.places[owner];
        let fitted = self.fit(places, pressure);
        let still = self.still();
        let of = |place: &Place| {
            let inside = fitted.map_or([0.0; 2], |field| place.correction(&field));
            let near_air = if still.at(place.at) > 0.0 { place.correction(&still) } else { [0.0; 2] };
            let fits = place.fits * place.covered;
            [0, 1].map(|i| fits * inside[i] + (1.0 - fits) * place.wet * near_air[i])
        };
        let forces = places.iter().map(of).collect();
        if self.mirrored { forces } else { self.turned(places, fitted, forces) }
    }

    /// The same forces with the moment of the pressure on the outline, whose parts act beside the particles that take them.
    fn turned(&self, places: &[Place], fitted: Option<Field>, forces: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
        let still = self.still();
        let of = |place: &Place| {
            let inside = fitted.map_or(0.0, |field| field.at(place.surface));
            let near_air = still.at(place.surface).max(0.0);
            let fits = place.fits * place.covered;
            -(fits * inside + (1.0 - fits) * place.wet * near_air) * place.outline.couple(place.depth)
        };
        let at: Vec<_> = places.iter().map(|place| (place.at, place.wet * place.outline.area[0].abs())).collect();
        let turning = turning_forces(&at, places.iter().map(of).sum());
        forces.into_iter().zip(turning).map(|([x, y], [tx, ty])| [x + tx, y + ty]).collect()
    }

    /// The forces on closed bodies, which act over a step of `dt` [s], take their corrections; returns the sum of these [N/m].
    pub fn correct_bodies(&self, walls: &mut Walls, dt: f64) -> [f64; 2] {
        let owners: Vec<Range<usize>> = closed_owners(walls).collect();
        let mut sum = [0.0; 2];
        for owner in owners {
            let correction = self.correction(owner.clone(), &walls.pressure[owner.clone()]);
            for (k, more) in owner.zip(correction) {
                let force = [walls.fx[k] + more[0], walls.fy[k] + more[1]];
                [walls.fx[k], walls.fy[k]] = force;
                walls.set_mean_force_of(k, -dt, force);
                sum = [sum[0] + more[0], sum[1] + more[1]];
            }
        }
        sum
    }

    /// Least squares over the first row, weighted by ω |∫n ds|; the gradient is held to that of still water where the row does not
    /// tell it. None without water.
    fn fit(&self, places: &[Place], pressure: &[f64]) -> Option<Field> {
        let weighed =
            || places.iter().zip(pressure).map(|(place, p)| (place.weight(), place, p)).filter(|(w, ..)| *w > 0.0);
        let (mut sum, mut middle, mut mean, mut h2) = (0.0, [0.0; 2], 0.0, 0.0);
        for (w, place, p) in weighed() {
            sum += w;
            middle = [0, 1].map(|i| middle[i] + w * place.at[i]);
            mean += w * p;
            h2 += w * place.h * place.h;
        }
        if sum <= 0.0 {
            return None;
        }
        let (middle, mean) = (middle.map(|m| m / sum), mean / sum);
        let (mut xx, mut xy, mut yy, mut bx, mut by) = (STIFFNESS * h2, 0.0, STIFFNESS * h2, 0.0, 0.0);
        for (w, place, p) in weighed() {
            let [dx, dy] = [0, 1].map(|i| place.at[i] - middle[i]);
            let rest = p - mean - self.weight[0] * dx - self.weight[1] * dy;
            let dx = if self.mirrored { 0.0 } else { dx };
            (xx, xy, yy) = (xx + w * dx * dx, xy + w * dx * dy, yy + w * dy * dy);
            (bx, by) = (bx + w * rest * dx, by + w * rest * dy);
        }
        let determinant = xx * yy - xy * xy;
        let more = [(yy * bx - xy * by) / determinant, (xx * by - xy * bx) / determinant];
        let gradient = [self.weight[0] + more[0], self.weight[1] + more[1]];
        Some(Field { middle, pressure: mean, gradient })
    }
}

impl Place {
    /// ∫P n ds over its share of the outline [N/m].
    fn integral(&self, field: &Field) -> [f64; 2] {
        self.outline.integral(self.normal, field.at(self.surface), field.gradient)
    }

    /// Exact less pairs' force of a linear pressure [N/m].
    fn correction(&self, field: &Field) -> [f64; 2] {
        let (p, [gx, gy], [xx, xy, yy]) = (field.at(self.at), field.gradient, self.second);
        let slope = [xx * gx + xy * gy, xy * gx + yy * gy];
        let on_surface = self.integral(field);
        [0, 1].map(|i| 2.0 * p * self.gradient[i] - slope[i] - on_surface[i])
    }

    fn weight(&self) -> f64 {
        self.covered * self.outline.area[0].hypot(self.outline.area[1])
    }
}

/// The places of the wall particles from `first` on.
struct Places<'a> {
    system: &'a ParticleSystem,
    walls: &'a Walls,
    air: &'a [f64],
    lattice: &'a Lattice,
    inverse: f64,
    first: usize,
}

impl TargetSum for Places<'_> {
    type Sum = Place;
    #[inline(always)]
    fn of<K: Shape>(&self, k: usize) -> Place {
        let (Places { system, walls, air, lattice, inverse, .. }, k) = (self, self.first + k);
        let ParticleSystem { packed, neighbours, domain, .. } = system;
        let wall = &packed.walls[k];
        let (mut weight, mut inside, mut gradient, mut second) = (0.0, 0.0, [0.0; 2], [0.0; 3]);
        for j in neighbours.fluid_of_wall.of(k) {
            let b = &packed.fluid[j as usize];
            let Some(wb) = pair_geometry::<K>(wall.x, wall.y, wall.h, b.x, b.y, b.h) else { continue };
            let (share, pull) = (b.volume * wb.w::<K>(), b.volume * wb.grad_factor);
            weight += share;
            inside += share * (1.0 - air[neighbours.source(j, air.len())]);
            gradient = [gradient[0] + pull * wb.dx, gradient[1] + pull * wb.dy];
            let [xx, xy, yy] = second;
            second = [xx + pull * wb.dx * wb.dx, xy + pull * wb.dx * wb.dy, yy + pull * wb.dy * wb.dy];
        }
        let (outline, [nx, ny]) = (walls.outline[k], [walls.nx[k], walls.ny[k]]);
        if weight < TOUCHED || wall.volume == 0.0 {
            return Place { outline, ..Place::default() };
        }
        let beside = lattice.beside_wall(walls.depth[k] * domain.fluid.smoothing_ratio / wall.h);
        let (scale, at) = (inverse * wall.volume, [wall.x, wall.y]);
        Place {
            at,
            surface: [at[0] + walls.depth[k] * nx, at[1] + walls.depth[k] * ny],
            depth: walls.depth[k],
            normal: [nx, ny],
            outline,
            gradient: gradient.map(|g| scale * g),
            second: second.map(|m| scale * m),
            covered: inside / weight,
            wet: ((weight / beside - FEW) / (MANY - FEW)).clamp(0.0, 1.0),
            fits: 0.0,
            h: wall.h,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square of side 1 whose pairs give a wrong force.
    fn square() -> LinearPressure {
        let side = |n: [f64; 2], k: usize| {
            let along = (k as f64 + 0.5) / 4.0 - 0.5;
            let surface = [0.5 * n[0] - along * n[1], 0.5 * n[1] + along * n[0]];
            Place {
                at: [0, 1].map(|i| surface[i] - 0.1 * n[i]),
                surface,
                depth: 0.1,
                normal: n,
                outline: OutlineShare { area: [0.25, 0.0], moment: [[0.0; 2]; 2] },
                gradient: [0.11 * n[0] + 0.01, 0.13 * n[1] - 0.02],
                second: [-0.01, 0.002, -0.012],
                covered: 1.0,
                wet: 1.0,
                fits: 1.0,
                h: 0.3,
            }
        };
        let sides = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
        let places = sides.into_iter().flat_map(|n| (0..4).map(move |k| side(n, k))).collect();
        LinearPressure { places, weight: [0.0, -9810.0], head: 0.0, mirrored: false }
    }

    fn pair_force(place: &Place, field: &Field) -> [f64; 2] {
        let ([xx, xy, yy], [gx, gy], p) = (place.second, field.gradient, field.at(place.at));
        [-(2.0 * p * place.gradient[0] - xx * gx - xy * gy), -(2.0 * p * place.gradient[1] - xy * gx - yy * gy)]
    }

    #[test]
    fn a_linear_pressure_has_archimedes_force_whatever_the_pairs_say() {
        let square = square();
        let force = |field: Field| {
            let pressure: Vec<f64> = square.places.iter().map(|place| field.at(place.at)).collect();
            let correction = square.correction(0..square.places.len(), &pressure);
            square.places.iter().zip(correction).fold([0.0; 2], |sum, (place, more)| {
                let pairs = pair_force(place, &field);
                [0, 1].map(|i| sum[i] + pairs[i] + more[i])
            })
        };
        let still = Field { middle: [0.3, -2.0], pressure: 5e4, gradient: square.weight };
        let [x, y] = force(still);
        assert!(x.abs() < 1e-9 * 5e4 && (y / 9810.0 - 1.0).abs() < 1e-9, "{x}, {y}");
        let [x1, y1] = force(Field { pressure: 1.05e6, ..still });
        assert!((x1 - x).abs() < 1e-9 * 1e6 && (y1 - y).abs() < 1e-9 * 1e6, "{x1}, {y1}");
        let other = Field { gradient: [300.0, -9000.0], ..still };
        let [x, y] = force(other);
        assert!((x + 300.0).abs() < 90.0 && (y - 9000.0).abs() < 90.0, "but for what holds the fit: {x}, {y}");
    }
}
