//! Consistent loads: forces on a polygon's sides applied to its corners (THEORY GE9).

use sph_core::walls::Resultant;

use crate::geometry::hermite::hermite;

/// A side of a placed outline, from corner to corner; the fluid is on its right.
#[derive(Clone, Copy, Debug)]
pub struct Side {
    /// Where it starts [m].
    pub from: [f64; 2],
    /// Unit vector along it [-].
    pub along: [f64; 2],
    /// Length [m].
    pub length: f64,
    /// Numbers of the corners at its ends.
    pub corners: [usize; 2],
}

impl Side {
    /// Unit normal into the fluid [-].
    pub fn normal(&self) -> [f64; 2] {
        [self.along[1], -self.along[0]]
    }

    /// The place a share t ∈ [0, 1] along the side [m].
    pub fn at(&self, t: f64) -> [f64; 2] {
        [0, 1].map(|k| self.from[k] + t * self.length * self.along[k])
    }

    /// Share along the side of the place nearest to `at`, and the square of the distance to it [m²].
    pub fn nearest(&self, at: [f64; 2]) -> (f64, f64) {
        let d = [at[0] - self.from[0], at[1] - self.from[1]];
        let t = ((d[0] * self.along[0] + d[1] * self.along[1]) / self.length).clamp(0.0, 1.0);
        let foot = self.at(t);
        (t, (at[0] - foot[0]).powi(2) + (at[1] - foot[1]).powi(2))
    }
}

/// The sides of closed loops of corners; corners are numbered through all loops.
pub fn sides(loops: &[Vec<[f64; 2]>]) -> Vec<Side> {
    let mut sides = Vec::new();
    let mut first = 0;
    for corners in loops {
        let n = corners.len();
        for k in 0..n {
            let (a, b) = (corners[k], corners[(k + 1) % n]);
            let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
            let length = dx.hypot(dy);
            let along = [dx / length, dy / length];
            sides.push(Side { from: a, along, length, corners: [first + k, first + (k + 1) % n] });
        }
        first += n;
    }
    sides
}

/// Load on a corner.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Nodal {
    /// Force [N/m].
    pub force: [f64; 2],
    /// Moment, counter-clockwise [N].
    pub moment: f64,
}

/// GE9: apply a force [N/m] at `at` [m] to the corners of a side: along the side by linear shape functions, across it by Hermite's; the
/// couple of a point off the side by linear ones.
pub fn apply_force(side: &Side, t: f64, at: [f64; 2], force: [f64; 2], corners: &mut [Nodal]) {
    let (a, foot) = (side.along, side.at(t));
    let axial = force[0] * a[0] + force[1] * a[1];
    let across = force[1] * a[0] - force[0] * a[1]; // along (−a_y, a_x), to the left of the side
    let couple = (at[0] - foot[0]) * force[1] - (at[1] - foot[1]) * force[0];
    let [n1, m1, n2, m2] = hermite(t, side.length);
    for (corner, linear, n, m) in [(side.corners[0], 1.0 - t, n1, m1), (side.corners[1], t, n2, m2)] {
        let node = &mut corners[corner];
        node.force[0] += linear * axial * a[0] - n * across * a[1];
        node.force[1] += linear * axial * a[1] + n * across * a[0];
        node.moment += m * across + linear * couple;
    }
}

/// Resultant of loads on corners about `reference` [m].
pub fn resultant(corners: &[[f64; 2]], loads: &[Nodal], reference: [f64; 2]) -> Resultant {
    let mut total = Resultant::default();
    for (at, load) in corners.iter().zip(loads) {
        total.force = [total.force[0] + load.force[0], total.force[1] + load.force[1]];
        total.moment += load.moment + (at[0] - reference[0]) * load.force[1] - (at[1] - reference[1]) * load.force[0];
    }
    total
}

/// Two Gauss points of the unit interval, each of weight ½.
pub const GAUSS: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];

/// Every Gauss point of panels no longer than `panel` [m]: share along the side, length it stands for [m].
pub fn gauss_points(side: &Side, panel: f64) -> impl Iterator<Item = (f64, f64)> + use<> {
    let count = (side.length / panel).ceil().max(1.0);
    let weight = 0.5 * side.length / count;
    (0..count as usize).flat_map(move |k| GAUSS.map(|g| ((k as f64 + g) / count, weight)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bent_side() -> Side {
        let loops = [vec![[0.3, 0.1], [1.5, 0.6], [0.2, 1.4]]];
        sides(&loops)[0]
    }

    /// The work of the corners' loads equals that of the pressure, for rigid motion and for bending: a field that is
    /// linear along the side and cubic across it, given by the corners' displacements and rotations.
    #[test]
    fn loads_on_corners_do_the_work_of_the_pressure() {
        let side = bent_side();
        let (a, n) = (side.along, [-side.along[1], side.along[0]]);
        let pressure = |t: f64| 700.0 - 400.0 * t;
        let rigid = |t: f64| {
            let at = side.at(t);
            [0.3 - 0.7 * at[1], -0.2 + 0.7 * at[0]]
        };
        let local = |v: [f64; 2]| [v[0] * a[0] + v[1] * a[1], v[0] * n[0] + v[1] * n[1]];
        // corners' motion: rigid, and then any bending
        let bent = [([0.2, -0.1], 0.9), ([-0.4, 0.5], -1.3)];
        for motion in [[(rigid(0.0), 0.7), (rigid(1.0), 0.7)], bent] {
            let field = |t: f64| {
                let ([u1, w1], [u2, w2]) = (local(motion[0].0), local(motion[1].0));
                let h = hermite(t, side.length);
                let w = h[0] * w1 + h[1] * motion[0].1 + h[2] * w2 + h[3] * motion[1].1;
                let u = (1.0 - t) * u1 + t * u2;
                [u * a[0] + w * n[0], u * a[1] + w * n[1]]
            };
            let (mut loads, mut work, mut scale) = (vec![Nodal::default(); 3], 0.0, 0.0);
            for (t, length) in gauss_points(&side, 0.1) {
                let force = [0, 1].map(|k| -pressure(t) * side.normal()[k] * length + 3.0 * a[k] * length);
                let moved = if motion[0].1 == motion[1].1 { rigid(t) } else { field(t) };
                work += force[0] * moved[0] + force[1] * moved[1];
                scale += force[0].hypot(force[1]) * moved[0].hypot(moved[1]);
                apply_force(&side, t, side.at(t), force, &mut loads);
            }
            let done: f64 = (0..2)
                .map(|k| {
                    let (load, (v, spin)) = (&loads[side.corners[k]], motion[k]);
                    load.force[0] * v[0] + load.force[1] * v[1] + load.moment * spin
                })
                .sum();
            assert!((done - work).abs() < 1e-12 * scale, "{done} at the corners, {work} of the pressure");
        }
    }

    /// A linear pressure gives the beam's consistent loads L(7q₁ + 3q₂)/20, L²(3q₁ + 2q₂)/60 (THEORY BE6) to the
    /// quadrature's error, and forces off the side keep their moment.
    #[test]
    fn a_linear_pressure_gives_a_beams_loads() {
        let side = bent_side();
        let (q1, q2, length) = (700.0, 300.0, side.length);
        let mut loads = vec![Nodal::default(); 3];
        for (t, weight) in gauss_points(&side, length / 64.0) {
            let q = (q1 + (q2 - q1) * t) * weight;
            apply_force(&side, t, side.at(t), [-q * side.along[1], q * side.along[0]], &mut loads);
        }
        let exact = length * length * (3.0 * q1 + 2.0 * q2) / 60.0;
        assert!((loads[0].moment / exact - 1.0).abs() < 1e-6, "{} against {exact}", loads[0].moment);
        let across = loads[0].force[1] * side.along[0] - loads[0].force[0] * side.along[1];
        assert!((across / (length * (7.0 * q1 + 3.0 * q2) / 20.0) - 1.0).abs() < 1e-6, "{across}");

        let (at, force, corners) = ([0.9, 0.6], [3.0, -5.0], [[0.3, 0.1], [1.5, 0.6], [0.2, 1.4]]);
        let mut loads = vec![Nodal::default(); 3];
        apply_force(&side, side.nearest(at).0, at, force, &mut loads);
        let total = resultant(&corners, &loads, [0.0, 0.0]);
        assert!((total.moment - (at[0] * force[1] - at[1] * force[0])).abs() < 1e-12);
        assert!((total.force[0] - 3.0).abs() + (total.force[1] + 5.0).abs() < 1e-12);
    }
}
