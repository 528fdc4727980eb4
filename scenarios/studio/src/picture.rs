//! A live picture of a run: the newest frame, drawn when the page asks.

use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use report::{FlowFrame, FlowView, flow_png};
use run::log::{Frame, LogError, LoggedFrame, Viewers};
use scene::Scene;

use crate::held::held;

/// Shortest time between two frames.
const INTERVAL: Duration = Duration::from_millis(200);
/// A page that has not asked for this time does not watch.
const WATCHED: Duration = Duration::from_secs(3);
const WIDTH: u32 = 720;
/// Half the width of the window over the body's breadth, and its height over its width.
const REACH: f64 = 1.2;
const ASPECT: f64 = 0.6;
/// Pressures above this share of the largest are not shown apart.
const COVERED: f64 = 0.995;

/// The newest frame of a run.
#[derive(Default)]
pub struct LiveFrame {
    frame: Mutex<Option<LoggedFrame>>,
    /// When a page asked last.
    asked: Mutex<Option<Instant>>,
}

/// Takes the frames of a run.
pub struct Watcher {
    /// Where the page finds them.
    pub live: Arc<LiveFrame>,
    /// When the newest was taken.
    pub taken: Option<Instant>,
}

impl Viewers for Watcher {
    fn is_due(&self) -> bool {
        let watched = held(&self.live.asked).is_some_and(|asked| asked.elapsed() < WATCHED);
        watched && self.taken.is_none_or(|taken| taken.elapsed() >= INTERVAL)
    }

    fn sample(&mut self, _: f64, _: &str, _: &[(&str, f64)]) -> Result<(), LogError> {
        Ok(())
    }

    fn frame(&mut self, frame: &Frame) {
        self.taken = Some(Instant::now());
        *held(&self.live.frame) = Some(LoggedFrame::of(frame));
    }
}

impl LiveFrame {
    /// The newest frame as PNG; `None` before the first.
    pub fn png(&self, scene: &Scene) -> Option<Vec<u8>> {
        *held(&self.asked) = Some(Instant::now());
        let guard = held(&self.frame);
        let logged = guard.as_ref()?;
        let mut frame = FlowFrame { time: logged.time, wall_size: scene.resolution.spacing, ..FlowFrame::default() };
        for point in logged.fluid() {
            frame.x.push(point.at[0] as f32);
            frame.y.push(point.at[1] as f32);
            frame.value.push((1e-3 * point.pressure) as f32);
            frame.size.push(point.spacing as f32);
        }
        frame.outlines = logged.bodies.iter().flat_map(|body| body.loops.iter().cloned()).collect();
        frame.walls = logged.walls().map(|point| point.at).collect();
        drop(guard);
        let mut pressures = frame.value.clone();
        let place = (COVERED * pressures.len().saturating_sub(1) as f64) as usize;
        let top = match pressures.is_empty() {
            true => 1.0,
            false => f64::from(*pressures.select_nth_unstable_by(place, f32::total_cmp).1),
        };
        let [x, y] = window(scene, &frame.outlines);
        let view = FlowView {
            x,
            y,
            value: [0.0, top.max(1e-3)],
            width_px: WIDTH,
            label: "pressure [kPa]".into(),
            mirror_x: false,
        };
        Some(flow_png(&frame, &view))
    }
}

/// The part of the tank that is shown: about the bodies, else all [m].
fn window(scene: &Scene, outlines: &[Vec<[f64; 2]>]) -> [[f64; 2]; 2] {
    let tank = &scene.tank;
    let all = || outlines.iter().flatten().filter(|point| point[0].is_finite() && point[1].is_finite());
    let [low, high] =
        [f64::min as fn(f64, f64) -> f64, f64::max].map(|of| all().map(|p| p[0]).reduce(of).unwrap_or_default());
    if scene.all_bodies().next().is_none() || high <= low {
        return [[-0.5 * tank.width, 0.5 * tank.width], [-tank.depth, tank.height - tank.depth]];
    }
    let lowest = all().map(|point| point[1]).reduce(f64::min).unwrap_or_default();
    let (middle, half) = (0.5 * (low + high), (REACH * (high - low)).min(0.5 * tank.width));
    let bottom = (lowest.min(0.0) - 0.8 * ASPECT * half).max(-tank.depth);
    [[middle - half, middle + half], [bottom, bottom + 2.0 * ASPECT * half]]
}
