//! The frames of the flow that the page shows: chosen from the log, thinned to a budget.

use run::log::{LogReader, LoggedFrame, Point};
use scene::vocabulary::ResultName;
use scene::{Scene, Symmetry};

use super::camera::{View, views, whole};
use super::folder::RunFolder;
use super::panels::pieces;
use crate::{FlowFrame, FlowView};

/// Particles of all frames together, at most: they decide the size of the page.
const RECORDS: usize = 900_000;
/// Frames, at most and at least.
const FRAMES: [usize; 2] = [80, 24];
/// Share of the values that the colours cover: a few beyond take the end colours.
const COVERED: f64 = 0.995;

/// A particle that is kept.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kept {
    pub id: u32,
    /// Place [m].
    pub at: [f32; 2],
    /// Pressure [Pa].
    pub pressure: f32,
    /// Speed [m/s].
    pub speed: f32,
    /// Spacing [m]; larger where neighbours were left out.
    pub size: f32,
}

/// A frame that is kept.
pub(super) struct Moment {
    /// Time [s].
    pub time: f64,
    pub particles: Vec<Kept>,
    /// Loops of the outlines of all bodies [m].
    pub outlines: Vec<Vec<[f64; 2]>>,
    /// Pieces of these loops that are panels.
    pub panels: Vec<[usize; 3]>,
    /// Where the picture looks.
    pub view: View,
}

/// The flow as the page shows it.
pub(super) struct Flow {
    pub moments: Vec<Moment>,
    /// Index of the moment that stands for the run: that of the largest force.
    pub still: usize,
    /// What is largest at that moment, in words, and when [s].
    pub peak: Option<(&'static str, f64)>,
    /// Largest pressure [Pa] and speed [m/s] of the colours.
    pub top: [f64; 2],
    /// Largest pressure [Pa] and speed [m/s] of a particle in these moments.
    pub most: [f64; 2],
    /// Share of the particles that is shown, where some were left out.
    pub share: f64,
    /// The whole tank, and its height [m].
    pub whole: (View, f64),
    pub mirror: bool,
}

/// A number between 0 and 1 for a particle: the same in each frame, and without a pattern in space.
fn chance(id: u32) -> f64 {
    f64::from((id ^ 0x5bd1_e995).wrapping_mul(0x9e37_79b1).rotate_left(13).wrapping_mul(0x85eb_ca6b) >> 8)
        / f64::from(1 << 24)
}

/// Corners of the box about the loops of a body [m].
fn bounds(loops: &[Vec<[f64; 2]>]) -> Option<[[f64; 2]; 2]> {
    let points = loops.iter().flatten().filter(|p| p[0].is_finite() && p[1].is_finite());
    points
        .copied()
        .map(|p| [p, p])
        .reduce(|[low, high], [p, _]| [[low[0].min(p[0]), low[1].min(p[1])], [high[0].max(p[0]), high[1].max(p[1])]])
}

/// Indices of at most `most` of `count` frames, evenly, the first, the last and one more among them.
fn evenly(count: usize, most: usize, one_more: usize) -> Vec<usize> {
    if count <= most {
        return (0..count).collect();
    }
    let mut chosen: Vec<usize> = (0..most - 1).map(|k| k * (count - 1) / (most - 2)).chain([one_more]).collect();
    chosen.sort_unstable();
    chosen.dedup();
    chosen
}

impl Flow {
    /// The flow of a run; `None` without a log.
    pub fn read(run: &mut RunFolder) -> Option<Flow> {
        let (scene, peak) = (&run.scene, peak(run));
        let log = run.log.as_mut()?;
        let times: Vec<f64> = log.times().iter().map(|t| t + scene.time.start).collect();
        let nearest = |time: f64| {
            let distance = |k: &usize| (times[*k] - time).abs();
            (0..times.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0)
        };
        let at_peak = nearest(peak.map_or(f64::INFINITY, |(_, time)| time).min(times.last().copied().unwrap_or(0.0)));
        let ends = [log.frame(0), log.frame(times.len() - 1)];
        let most = ends.iter().flatten().map(|f| computed(f).count()).max().unwrap_or(0).max(1);
        let frames = (RECORDS / most).clamp(FRAMES[1], FRAMES[0]);
        let share = (RECORDS as f64 / (frames * most) as f64).min(1.0);
        let chosen = evenly(times.len(), frames, at_peak);
        let mut moments = Vec::new();
        for &k in &chosen {
            let Some(frame) = log.frame(k) else { continue };
            let panels = scene.body.as_ref().map_or(Vec::new(), |body| pieces(body, &frame.bodies));
            moments.push(Moment { panels, ..kept(&frame, times[k], share) });
        }
        let still =
            moments.iter().position(|m| m.time >= times[at_peak] - 1e-12).unwrap_or(moments.len().checked_sub(1)?);
        let (boxes, highest) = {
            let body: Vec<_> = moments.iter().map(|m| bounds(&m.outlines)).collect();
            let over = |m: &Moment| m.particles.iter().map(|p| f64::from(p.at[1])).fold(0.0, f64::max);
            let bodies = body.iter().flatten().map(|[_, high]| high[1]).fold(0.0, f64::max);
            // drops fly higher than what is worth a look
            (body, moments.iter().map(over).fold(0.0, f64::max).min(scene.tank.height - scene.tank.depth).max(bodies))
        };
        for (moment, view) in moments.iter_mut().zip(views(scene, &boxes, highest)) {
            moment.view = view;
        }
        let top = [largest(&moments, |p| p.pressure, 1.0), largest(&moments, |p| p.speed, 1e-3)];
        let of_all = |of: fn(&Kept) -> f32| moments.iter().flat_map(|m| m.particles.iter().map(of)).fold(0.0, f32::max);
        let most = [of_all(|p| p.pressure), of_all(|p| p.speed)].map(f64::from);
        let mirror = scene.symmetry == Symmetry::X;
        Some(Flow { moments, still, peak, top, most, share, whole: whole(scene, highest), mirror })
    }
}

/// When the force on the body, or else a pressure, is largest [s]; nothing where the run failed.
fn peak(run: &RunFolder) -> Option<(&'static str, f64)> {
    if run.has_failed() {
        return None;
    }
    let results = &run.record.results;
    let force = results.get(ResultName::PeakForce).and_then(|force| Some(("peak force", force.time_s?)));
    let pressure = || results.get(ResultName::PeakPressure).and_then(|peak| Some(("peak pressure", peak.time_s?)));
    let sampled = || {
        let name = run.curves.columns.iter().find(|name| name.ends_with(".fy_N_per_m"))?;
        let points = run.curves.points(name, [1.0; 2]);
        points.into_iter().max_by(|a, b| a[1].abs().total_cmp(&b[1].abs())).map(|p| ("largest force", p[0]))
    };
    force.or_else(pressure).or_else(sampled)
}

/// The particles that were computed: the page draws their images itself.
fn computed(frame: &LoggedFrame) -> impl Iterator<Item = Point> + '_ {
    frame.fluid().filter(|point| !point.is_image())
}

fn kept(frame: &LoggedFrame, time: f64, share: f64) -> Moment {
    let grown = share.powf(-0.5) as f32;
    let keep = |p: Point| {
        let speed = p.velocity[0].hypot(p.velocity[1]);
        let finite = [p.at[0], p.at[1], p.pressure, speed, p.spacing].iter().all(|v| v.is_finite());
        (finite && (share >= 1.0 || chance(p.id) < share)).then_some(Kept {
            id: p.id,
            at: p.at.map(|v| v as f32),
            pressure: p.pressure as f32,
            speed: speed as f32,
            size: grown * p.spacing as f32,
        })
    };
    Moment {
        time,
        particles: computed(frame).filter_map(keep).collect(),
        outlines: frame.bodies.iter().flat_map(|body| body.loops.iter().cloned()).collect(),
        panels: Vec::new(),
        view: View { middle: [0.0; 2], width: 1.0 },
    }
}

/// The value that all but a few of the particles in view stay below, at least `least`.
fn largest(moments: &[Moment], of: fn(&Kept) -> f32, least: f64) -> f64 {
    let seen = |m: &Moment| {
        let [x, y] = m.view.window();
        let inside = move |p: &&Kept| {
            let [px, py] = p.at.map(f64::from);
            (px.abs() < x[1].abs().max(x[0].abs())) && py > y[0] && py < y[1]
        };
        m.particles.iter().filter(inside).map(of).collect::<Vec<f32>>()
    };
    let mut values: Vec<f32> = moments.iter().flat_map(seen).collect();
    let k = (COVERED * values.len().saturating_sub(1) as f64) as usize;
    match values.len() {
        0 => least,
        _ => f64::from(*values.select_nth_unstable_by(k, f32::total_cmp).1).max(least),
    }
}

/// A picture of the frame of a log nearest to a time [s], with all its particles: what [`flow_svg`](crate::flow_svg) draws.
pub(super) fn picture(
    scene: &Scene,
    log: &mut LogReader,
    flow: &Flow,
    moment: usize,
    width_px: u32,
) -> Option<(FlowFrame, FlowView)> {
    let Moment { time, view, outlines, .. } = flow.moments.get(moment)?;
    let times = log.times();
    let distance = |k: &usize| (times[*k] + scene.time.start - time).abs();
    let index = (0..times.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    let logged = log.frame(index)?;
    let wall_size = scene.resolution.spacing;
    let mut frame = FlowFrame { time: *time, outlines: outlines.clone(), wall_size, ..FlowFrame::default() };
    for p in computed(&logged) {
        frame.x.push(p.at[0] as f32);
        frame.y.push(p.at[1] as f32);
        frame.value.push((1e-3 * p.pressure) as f32);
        frame.size.push(p.spacing as f32);
    }
    frame.walls = logged.walls().filter(|p| !p.is_image()).map(|p| p.at).collect();
    let [x, y] = view.window();
    let value = [0.0, 1e-3 * flow.top[0]];
    Some((frame, FlowView { x, y, value, width_px, label: "pressure [kPa]".into(), mirror_x: flow.mirror }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_chosen_evenly_with_both_ends_and_the_peak() {
        assert_eq!(evenly(5, 80, 2), [0, 1, 2, 3, 4]);
        let chosen = evenly(1000, 50, 333);
        assert!(chosen.len() <= 50 && chosen.contains(&0) && chosen.contains(&999) && chosen.contains(&333));
    }

    #[test]
    fn the_particles_that_are_kept_are_a_share_of_all() {
        let share = (0..100_000).filter(|id| chance(*id) < 0.1).count();
        assert!((9_000..11_000).contains(&share), "{share}");
    }
}
