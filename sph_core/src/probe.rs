//! Pressure read from the fluid at points (THEORY E18).

use crate::cells::{Cells, Point};
use crate::fluid::Fluid;

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
        if let Some(periodic) = fluid.parameters.periodic {
            let own = Cells::build(&points);
            for [sx, sy] in periodic.shifts() {
                let moved = (0..p.len()).map(|k| Point { x: p.x[k] + sx, y: p.y[k] + sy, ..points[k] });
                let near: Vec<Point> = moved.filter(|q| own.any_within(q.x, q.y, q.reach)).collect();
                points.extend(near);
            }
        }
        Probe { fluid, cells: Cells::build(&points) }
    }

    /// Call `take` with weight V W and index of every particle around `at` [m], each with its own kernel.
    fn around(&self, at: [f64; 2], mut take: impl FnMut(f64, &Point)) {
        let (p, d, kernel) = (&self.fluid.particles, &self.fluid.derived, self.fluid.parameters.kernel);
        self.cells.for_each_within(at[0], at[1], 0.0, |q| {
            let k = q.index as usize;
            let w = kernel.value((at[0] - q.x).hypot(at[1] - q.y), p.h[k]);
            take(d.volume[k] * w, q);
        });
    }

    /// E18: pressure on a flat face with unit normal `normal` into the fluid [Pa]: 2 Σ V (p − s n·(r_b − r)) W,
    /// where `slope` s = ρ(g − a)·n [Pa/m] is the pressure's slope along the normal that the wall imposes.
    /// It falls to zero by itself where the face is dry. Valid farther than one support 2h from an edge.
    pub fn on_flat_face(&self, at: [f64; 2], normal: [f64; 2], slope: f64) -> f64 {
        let mut sum = 0.0;
        self.around(at, |weight, q| {
            let height = (q.x - at[0]) * normal[0] + (q.y - at[1]) * normal[1];
            sum += weight * (self.fluid.derived.pressure[q.index as usize] - slope * height);
        });
        2.0 * sum
    }

    /// E18: Shepard mean Σ V p W/Σ V W [Pa]: for corners and points inside the fluid; zero where less than an
    /// eighth of the kernel is filled.
    pub fn shepard(&self, at: [f64; 2]) -> f64 {
        let (mut pressure, mut filling) = (0.0, 0.0);
        self.around(at, |weight, q| {
            pressure += weight * self.fluid.derived.pressure[q.index as usize];
            filling += weight;
        });
        if filling < 0.125 { 0.0 } else { pressure / filling }
    }
}
