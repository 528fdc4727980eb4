//! The force of the pressure on a body's outline, to compare with the reactions that move it (THEORY CO39).

use sph_core::Probe;

use crate::coupling::coupled::Coupled;
use crate::coupling::force_rules::placed_outline::{PlacedOutline, PointForce};

/// Wetness from which a place is under water [-].
const WET: f64 = 0.5;
/// Least ratio of a determinant to the product of its diagonal: places on a line have no plane [-].
const SINGULAR: f64 = 1e-9;

/// p = mean + gradient·(r − middle) [Pa].
struct Plane {
    middle: [f64; 2],
    mean: f64,
    gradient: [f64; 2],
}

/// A place [m] and its pressure [Pa].
type Reading = ([f64; 2], f64);

impl Plane {
    /// By least squares of places [m] and pressures [Pa]; level where the places lie on a line.
    fn fit(places: &[Reading]) -> Plane {
        let n = places.len() as f64;
        let mean_of = |of: &dyn Fn(&Reading) -> f64| places.iter().map(of).sum::<f64>() / n;
        let (middle, mean) = ([0, 1].map(|k| mean_of(&|(at, _)| at[k])), mean_of(&|(_, p)| *p));
        let moment = |a: usize, b: usize| mean_of(&|(at, _)| (at[a] - middle[a]) * (at[b] - middle[b]));
        let with_pressure = |a: usize| mean_of(&|(at, p)| (at[a] - middle[a]) * (p - mean));
        let ([xx, xy, yy], [xp, yp]) = ([moment(0, 0), moment(0, 1), moment(1, 1)], [0, 1].map(with_pressure));
        let determinant = xx * yy - xy * xy;
        let gradient = match determinant > SINGULAR * xx * yy {
            true => [(yy * xp - xy * yp) / determinant, (xx * yp - xy * xp) / determinant],
            false => [0.0; 2],
        };
        Plane { middle, mean, gradient }
    }

    fn at(&self, place: [f64; 2]) -> f64 {
        (0..2).fold(self.mean, |p, k| p + self.gradient[k] * (place[k] - self.middle[k]))
    }
}

/// Forces on body `k` [N/m]: the reactions that move it, and the integral of the pressure over the first layer (GE8). Around a body that is
/// all under water the plane that fits the pressures is integrated exactly, −∇p A with the area A: only what is left has the error of the
/// rows' lengths and normals. `None` for a body without an outline or a motion.
pub fn reaction_and_pressure(system: &Coupled, k: usize) -> Option<[[f64; 2]; 2]> {
    let outline_now = PlacedOutline::of(system, system.bodies().nth(k)?)?;
    let probe = Probe::new(&system.fluid);
    let sum = |forces: Vec<PointForce>| forces.iter().fold([0.0; 2], |[x, y], f| [x + f.force[0], y + f.force[1]]);
    let first: Vec<usize> = outline_now.first_particles(k).collect();
    let wet = |&j: &usize| probe.wetness(outline_now.above(j)) > WET;
    let pressed = if first.iter().all(wet) && !first.is_empty() {
        let mut places: Vec<_> =
            first.iter().map(|&j| (outline_now.above(j), outline_now.surface_pressure(j))).collect();
        if let Some(plane) = outline_now.plane() {
            let images: Vec<_> = places.iter().map(|([x, y], p)| ([2.0 * plane - x, *y], *p)).collect();
            places.extend(images);
        }
        let plane = Plane::fit(&places);
        let rest = sum(outline_now.pressed(k, |at, p| p - plane.at(at)));
        [0, 1].map(|c| rest[c] - plane.gradient[c] * outline_now.area())
    } else {
        sum(outline_now.first_layer(k, &probe))
    };
    Some([sum(outline_now.reactions(k)), pressed])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_is_found_again_and_places_on_a_line_have_none() {
        let at = |[x, y]: [f64; 2]| 5.0 + 2.0 * x - 3.0 * y;
        let places = [[0.0, 0.0], [1.0, 0.2], [0.3, 1.0], [-0.5, 0.4]].map(|place| (place, at(place)));
        let plane = Plane::fit(&places);
        assert!((plane.gradient[0] - 2.0).abs() < 1e-12 && (plane.gradient[1] + 3.0).abs() < 1e-12);
        assert!((plane.at([4.0, 7.0]) - at([4.0, 7.0])).abs() < 1e-11);
        let line = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]].map(|place| (place, at(place)));
        assert_eq!(Plane::fit(&line).gradient, [0.0; 2]);
    }
}
