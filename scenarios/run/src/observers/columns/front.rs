//! The length of the water along the floor (THEORY GE12).

use scene::Scene;
use sph_core::Fluid;

use crate::observers::source::{Reader, Source};

pub(super) const SOURCE: Source = Source { names, reader };

/// The column, if the scene asks for it.
fn names(scene: &Scene) -> Vec<String> {
    scene.observe.front.then(|| "front_m".to_string()).into_iter().collect()
}

fn reader(scene: &Scene) -> Reader {
    let asked = scene.observe.front;
    Box::new(move |frame| asked.then(|| front(&frame.system.fluid)).into_iter().collect())
}

/// Height above the lowest particle up to which water counts as running along the floor, in its spacings.
const HEIGHT: f64 = 3.0;
/// A gap wider than this ends the water, in spacings: what lies beyond is spray.
const GAP: f64 = 2.0;

/// GE12: length of the water along the floor [m]: from its left end, through particles within three spacings of the
/// lowest, until two spacings lie empty; half a spacing beyond the middles of the first and the last particle.
pub fn front(fluid: &Fluid) -> f64 {
    let (p, ratio) = (fluid.particles(), fluid.domain().fluid.smoothing_ratio);
    let lowest = p.y.iter().copied().fold(f64::INFINITY, f64::min);
    let spacing = |k: usize| p.h[k] / ratio;
    let mut row: Vec<[f64; 2]> =
        (0..p.len()).filter(|&k| p.y[k] < lowest + HEIGHT * spacing(k)).map(|k| [p.x[k], spacing(k)]).collect();
    row.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let end = row.windows(2).position(|pair| pair[1][0] - pair[0][0] > GAP * pair[0][1]).unwrap_or(row.len() - 1);
    row[end][0] - row[0][0] + 0.5 * (row[0][1] + row[end][1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::build;

    #[test]
    fn the_front_of_a_column_at_rest_is_its_width() {
        let scene = crate::load("dam_break", &["resolution.spacing=0.05".to_string()]).expect("a built-in scene").scene;
        let mut system = build::build(&scene).expect("a dam");
        assert!((front(&system.fluid) - 1.2).abs() < 1e-9, "{}", front(&system.fluid));
        // a drop of spray far ahead does not count
        system.fluid.particles_mut().x[0] += 1.7;
        assert!((front(&system.fluid) - 1.2).abs() < 0.051, "{}", front(&system.fluid));
    }
}
