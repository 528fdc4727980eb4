//! The volume of the water by the place of its surface (THEORY GE11).

use scene::{Scene, Symmetry};
use serde::Serialize;
use sph_core::{Fluid, Probe};

use crate::observers::source::{Reader, Source};

/// The column.
pub(in crate::observers) const VOLUME: &str = "volume_m2";

/// Volume of the water below its surface (THEORY GE11).
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Water {
    /// Volume per metre of span at the start [m²].
    pub volume_start_m2: f64,
    /// Change of the volume to its mean over the last fifth of the run, over the start's [-].
    pub volume_drift: f64,
    /// Largest change at any sample, over the start's [-].
    pub volume_drift_worst: f64,
}

/// Columns and steps downwards, per spacing.
const CELLS: f64 = 2.0;
/// Kernel sum at a flat surface [-].
const SURFACE: f64 = 0.5;

pub(super) const SOURCE: Source = Source { names, reader };

/// The column, if the scene asks for it.
fn names(scene: &Scene) -> Vec<String> {
    scene.observe.volume.then(|| VOLUME.to_string()).into_iter().collect()
}

fn reader(scene: &Scene) -> Reader {
    let volume = scene.observe.volume.then(|| VolumeReader::new(scene));
    Box::new(move |frame| volume.iter().map(|v| v.read(&frame.system.fluid)).collect())
}

/// Finds the surface from above.
pub struct VolumeReader {
    walls: [f64; 2],
    floor: f64,
}

impl VolumeReader {
    /// The tank of a scene.
    pub fn new(scene: &Scene) -> VolumeReader {
        let half = 0.5 * scene.tank.width;
        let left = if scene.symmetry == Symmetry::X { 0.0 } else { -half };
        VolumeReader { walls: [left, half], floor: -scene.tank.depth }
    }

    /// GE11: area between floor, side walls and surface [m²].
    pub fn read(&self, fluid: &Fluid) -> f64 {
        let p = fluid.particles();
        let finest = p.h.iter().copied().fold(f64::INFINITY, f64::min) / fluid.domain().fluid.smoothing_ratio;
        let [left, right] = self.walls;
        let columns = (CELLS * (right - left) / finest).round().max(1.0);
        let width = (right - left) / columns;
        let mut tops = vec![self.floor; columns as usize];
        for k in 0..p.len() {
            let column = |x: f64| ((x - left) / width).floor().clamp(0.0, columns - 1.0) as usize;
            let reach = 2.0 * p.h[k];
            for top in &mut tops[column(p.x[k] - reach)..=column(p.x[k] + reach)] {
                *top = top.max(p.y[k] + reach);
            }
        }
        let probe = Probe::new(fluid);
        let filling = |x: f64, y: f64| [x, 2.0 * left - x, 2.0 * right - x].map(|x| probe.filling([x, y])).iter().sum();
        let height = |(k, &top): (usize, &f64)| {
            let x = left + (k as f64 + 0.5) * width;
            surface(|y| filling(x, y), top, self.floor, finest / CELLS) - self.floor
        };
        width * tops.iter().enumerate().map(height).sum::<f64>()
    }
}

/// Where `filling` first reaches that of a surface on the way down from `top`, in steps of `step`; the floor, if nowhere.
fn surface(filling: impl Fn(f64) -> f64, top: f64, floor: f64, step: f64) -> f64 {
    let (mut y, mut above) = (top, 0.0);
    while y > floor {
        let here = filling(y);
        if here >= SURFACE {
            return y + step * (here - SURFACE) / (here - above);
        }
        (y, above) = (y - step, here);
    }
    floor
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::build;

    /// Level or in waves, square metres are counted; water that takes up a hundredth more shows a hundredth more.
    #[test]
    fn volume_is_read_where_the_surface_is() {
        for set in ["tank.surface_amplitude=0.0", "tank.surface_amplitude=0.05", "tank.surface_tilt_deg=5.0"] {
            let sets = [set, "resolution.spacing=0.02"].map(String::from);
            let scene = crate::load("hydrostatic_tank", &sets).expect("a built-in scene").scene;
            let mut system = build::build(&scene).expect("a tank");
            let reader = VolumeReader::new(&scene);
            let volume = reader.read(&system.fluid);
            assert!((volume - 1.0).abs() < 2e-3, "{set}: {volume} m²");
            system.fluid.particles_mut().y.iter_mut().for_each(|y| *y = 1.01 * (*y + 1.0) - 1.0);
            let more = reader.read(&system.fluid) / volume - 1.0;
            assert!((more - 0.01).abs() < 1e-3, "{set}: {more}");
        }
    }
}
