//! The height of the water at a place (THEORY GE10).

use scene::{Scene, Symmetry};
use sph_core::Fluid;

use crate::observers::source::{Reader, Source};

/// Scale of the weight over the spacing below the place: particles of this spacing are counted exactly.
const SCALE: f64 = 2.0;

pub(super) const SOURCE: Source = Source { names, reader };

/// A column for each place that the scene asks for.
fn names(scene: &Scene) -> Vec<String> {
    (1..=scene.observe.level.len()).map(|k| format!("level{k}_m")).collect()
}

fn reader(scene: &Scene) -> Reader {
    let levels = LevelReader::new(scene);
    Box::new(move |frame| levels.read(&frame.system.fluid))
}

/// Counts the water over places.
pub struct LevelReader {
    places: Vec<Place>,
    walls: [f64; 2],
    depth: f64,
}

struct Place {
    x: f64,
    scale: f64,
}

impl LevelReader {
    /// The places of a scene.
    pub fn new(scene: &Scene) -> LevelReader {
        let layout = scene::layout(scene);
        let half = 0.5 * scene.tank.width;
        let place = |x: &f64| Place { x: *x, scale: SCALE * layout.spacing_at([*x, -scene.tank.depth]) };
        let left = if scene.symmetry == Symmetry::X { 0.0 } else { -half };
        LevelReader {
            places: scene.observe.level.iter().map(place).collect(),
            walls: [left, half],
            depth: scene.tank.depth,
        }
    }

    /// GE10: η(x) = Σ V_j M₄((x − x_j)/s)/s − H [m], with the images of the water behind the side walls.
    pub fn read(&self, fluid: &Fluid) -> Vec<f64> {
        let p = fluid.particles();
        let level = |place: &Place| {
            let share = |x: f64| spline((x - place.x) / place.scale) / place.scale;
            let images = |x: f64| share(x) + share(2.0 * self.walls[0] - x) + share(2.0 * self.walls[1] - x);
            (0..p.len()).map(|k| p.mass[k] / p.rho[k] * images(p.x[k])).sum::<f64>() - self.depth
        };
        self.places.iter().map(level).collect()
    }
}

/// The cubic B-spline M₄ (Schoenberg 1946): integral 1, support −2 to 2; its integer translations sum to 1.
fn spline(q: f64) -> f64 {
    let q = q.abs();
    match q {
        _ if q < 1.0 => (4.0 - 6.0 * q * q + 3.0 * q * q * q) / 6.0,
        _ if q < 2.0 => (2.0 - q).powi(3) / 6.0,
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn translations_of_the_spline_sum_to_one() {
        for shift in [0.0, 0.3, 0.77] {
            let sum: f64 = (-3..=3).map(|k| spline(f64::from(k) + shift)).sum();
            assert!((sum - 1.0).abs() < 1e-15, "{shift}: {sum}");
        }
    }

    /// A cosine, flattened by the weight by (sin ½ks/½ks)⁴, is read to rounding of the rows' stretch.
    #[test]
    fn the_level_of_a_wave_is_read_at_walls_and_between() {
        let sets = ["tank.surface_amplitude=0.05", "observe.level=[-0.5, -0.21, 0.5]", "resolution.spacing=0.02"];
        let sets = sets.map(String::from);
        let scene = crate::load("hydrostatic_tank", &sets).expect("a built-in scene").scene;
        let system = crate::build::build(&scene).expect("a tank");
        let levels = LevelReader::new(&scene).read(&system.fluid);
        let half = 0.5 * std::f64::consts::PI * 0.04;
        let flat = (half.sin() / half).powi(4);
        for (level, x) in levels.iter().zip([-0.5_f64, -0.21, 0.5]) {
            let exact = 0.05 * flat * (std::f64::consts::PI * (x + 0.5)).cos();
            assert!((level - exact).abs() < 2e-4 * 0.05 + 1e-4, "{level} m at {x} m, exact {exact} m");
        }
    }
}
