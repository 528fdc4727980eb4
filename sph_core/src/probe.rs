//! Pressure read from the fluid at points (THEORY E18).

use crate::cells::{Cells, Point};
use crate::fluid::Fluid;
use crate::kernel::Kernel;

/// A reader of the fluid as it stands now; make one per moment, read many points.
pub struct Probe<'a> {
    fluid: &'a Fluid,
    cells: Cells,
}

impl<'a> Probe<'a> {
    /// Sort the fluid, and its images, for reading.
    pub fn new(fluid: &'a Fluid) -> Probe<'a> {
        let p = &fluid.particles;
        let mut points: Vec<Point> =
            (0..p.len()).map(|k| Point { x: p.x[k], y: p.y[k], reach: 2.0 * p.h[k], index: k as u32 }).collect();
        if let Some(mirror) = fluid.parameters.mirror {
            let near: Vec<Point> = points.iter().filter(|q| q.x - mirror.at < 2.0 * q.reach).copied().collect();
            points.extend(near.iter().map(|q| Point { x: mirror.reflect(q.x), ..*q }));
        }
        Probe { fluid, cells: Cells::build(&points) }
    }

    /// Σ V p W and Σ V W over the fluid around `at` [m], each particle with its own kernel.
    fn sums(&self, at: [f64; 2]) -> (f64, f64) {
        let (p, d, kernel) = (&self.fluid.particles, &self.fluid.derived, self.fluid.parameters.kernel);
        let (mut pressure, mut filling) = (0.0, 0.0);
        self.cells.for_each_within(at[0], at[1], 0.0, |q| {
            let k = q.index as usize;
            let w = d.volume[k] * weight(kernel, (at[0] - q.x).hypot(at[1] - q.y), p.h[k]);
            pressure += w * d.pressure[k];
            filling += w;
        });
        (pressure, filling)
    }

    /// Pressure on a flat face [Pa]: 2 Σ V p W, which falls to zero by itself where the face is dry.
    /// Valid farther than one support 2h from an edge of the face.
    pub fn on_flat_face(&self, at: [f64; 2]) -> f64 {
        2.0 * self.sums(at).0
    }

    /// Shepard mean Σ V p W/Σ V W [Pa]: for corners and points inside the fluid; zero where fewer than a
    /// quarter of the half space in front of a face is filled.
    pub fn shepard(&self, at: [f64; 2]) -> f64 {
        let (pressure, filling) = self.sums(at);
        if filling < 0.125 { 0.0 } else { pressure / filling }
    }
}

fn weight(kernel: Kernel, r: f64, h: f64) -> f64 {
    kernel.value(r, h)
}
