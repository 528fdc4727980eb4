//! Four pictures of the flow at equal intervals, for the report.

use sph_core::state_bytes::{StateError, decode, encode};

use super::{Frame, ObserveError, Observer, gauges};
use crate::report::FlowFrame;
use crate::scene::Scene;

/// Pictures kept in a run.
const PICTURES: usize = 4;

/// Keeps particle frames for the report.
pub struct FlowPictures {
    due: Vec<f64>,
    frames: Vec<FlowFrame>,
    spacing: f64,
}

impl FlowPictures {
    /// Pictures at equal intervals up to the scene's end.
    pub fn new(scene: &Scene) -> FlowPictures {
        let due = (1..=PICTURES).rev().map(|k| scene.time.end * k as f64 / PICTURES as f64).collect();
        FlowPictures { due, frames: Vec::new(), spacing: scene.resolution.spacing }
    }

    /// Keep the present state, whether due or not.
    pub fn keep(&mut self, frame: &Frame<'_>) {
        let (p, d, w) = (frame.system.fluid.particles(), frame.system.fluid.fields(), &frame.system.walls);
        let narrow = |v: &[f64]| v.iter().map(|x| *x as f32).collect::<Vec<f32>>();
        let bodies = frame.system.bodies().filter_map(|b| Some((b.motion()?, b.outline()?)));
        self.frames.push(FlowFrame {
            time: frame.time(),
            x: narrow(&p.x),
            y: narrow(&p.y),
            value: d.pressure.iter().map(|v| (*v / 1000.0) as f32).collect(),
            size: (0..p.len()).map(|k| (p.mass[k] / p.rho[k]).sqrt() as f32).collect(),
            outlines: bodies
                .flat_map(|(m, o)| o.loops().iter().map(move |l| l.iter().map(|v| gauges::on(&m, *v)).collect()))
                .collect(),
            walls: frame
                .system
                .bodies()
                .enumerate()
                .filter(|(_, b)| b.outline().is_none())
                .flat_map(|(k, _)| frame.system.range(k))
                .map(|k| [w.x[k], w.y[k]])
                .collect(),
            wall_size: self.spacing,
        });
    }

    /// Frames and times that are due, as bytes.
    pub fn to_bytes(&self) -> Vec<u8> {
        encode(&(&self.due, &self.frames))
    }

    /// Take frames kept up to `time` [s]; with another end of the run, later ones are due at its intervals.
    pub fn restore_bytes(&mut self, bytes: &[u8], time: f64) -> Result<(), StateError> {
        let due: Vec<f64>;
        (due, self.frames) = decode("the pictures of the flow", bytes)?;
        match due.first() == self.due.first() {
            true => self.due = due,
            false => self.due.retain(|due| *due > time),
        }
        Ok(())
    }

    /// The frames kept.
    pub fn frames(&self) -> &[FlowFrame] {
        &self.frames
    }
}

impl Observer for FlowPictures {
    fn observe(&mut self, frame: &Frame<'_>) -> Result<(), ObserveError> {
        let due = self.due.last().is_some_and(|t| frame.time() >= *t * (1.0 - 1e-9));
        if due {
            self.due.pop();
            self.keep(frame);
        }
        Ok(())
    }
}
