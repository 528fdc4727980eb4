//! The largest mean force and acceleration of a theory (THEORY GE18), and what is not known of them.

use scene::validity::compressibility::WATER_SOUND;
use scene::validity::first_contact::{ACOUSTIC_TIMES, wet_start};
use scene::vocabulary::{BandwidthBy, CUTOFF, Verdict};
use scene::{Body, Bottom, Motion, Scene};
use settings::significant;

use super::Theory;
use crate::results::{Extreme, RunningIntegral, STANDARD_GRAVITY, time_of_impact};

/// Rows in a time of averaging.
const ROWS: f64 = 50.0;
/// Most rows in a run.
const MOST_ROWS: f64 = 20_000.0;
/// Least time of averaging over that of the impact with which bands were measured [-].
const MEASURED_TIME: f64 = 0.5;

/// Time over which peaks are averaged [s], and what it follows from.
#[derive(Clone, Copy)]
pub(super) struct Averaging {
    pub time: f64,
    pub by: BandwidthBy,
}

impl Averaging {
    /// A key of the scene, and under bottoms that are round or bend, where first contacts and the panels' vibrations give peaks that are
    /// too short to have a meaning, the impact, as of particles. `None` for single rows.
    pub fn of(scene: &Scene, theory: &Theory) -> Option<Averaging> {
        match scene.report.bandwidth {
            Some(bandwidth) => Some(Averaging { time: CUTOFF / bandwidth, by: BandwidthBy::Scene }),
            None => Some(Averaging { time: of_impact(scene, theory)?, by: BandwidthBy::Impact }),
        }
    }

    /// Longest time between rows that shows the mean [s].
    pub fn longest_row(self, end: f64) -> f64 {
        (self.time / ROWS).max(end / MOST_ROWS)
    }

    /// True of a mean as short as was not measured.
    pub fn is_unmeasured(self, scene: &Scene, theory: &Theory) -> bool {
        of_impact(scene, theory).is_some_and(|time| self.time < MEASURED_TIME * time)
    }
}

fn of_impact(scene: &Scene, theory: &Theory) -> Option<f64> {
    let is_short = theory.section.is_round() || theory.bending_flow().is_some();
    scene.entry().filter(|_| is_short).as_ref().and_then(time_of_impact)
}

/// Largest of a curve that is averaged, and of its rows.
#[derive(Clone, Copy)]
pub(super) struct Largest {
    pub mean: Extreme,
    pub row: Extreme,
}

/// The largest force [N/m] and acceleration [g]. Where the run is shorter than the averaging time `over` [s], the largest row stands for the mean.
pub(super) fn largest(scene: &Scene, body: &Body, theory: &Theory, over: Option<f64>) -> Option<[Largest; 2]> {
    let (mut forces, mut accelerations) = (RunningIntegral::<2>::default(), RunningIntegral::<1>::default());
    for (now, motion) in theory.instants.iter().zip(theory.motions(body)) {
        forces.take(now.time, motion.force);
        accelerations.take(now.time, [motion.acceleration[1] / STANDARD_GRAVITY]);
    }
    let rows = [forces.largest()?, accelerations.largest()?];
    let means = match (over, &body.motion) {
        (None, _) => Some(rows),
        (Some(over), Motion::Free(freedom)) if theory.section.is_round() && theory.bending_flow().is_none() => {
            by_momentum(scene, theory, freedom.mass, over)
        }
        (Some(over), _) => forces.largest_mean(over).zip(accelerations.largest_mean(over)).map(<[Extreme; 2]>::from),
    };
    let means = means.unwrap_or(rows);
    Some([0, 1].map(|i| Largest { mean: means[i], row: rows[i] }))
}

/// Means of a free rigid body, F̄ = m(g + ΔV/τ) upwards: exact where the force of the first contact is shorter than a row. Windows begin or end
/// at a row.
fn by_momentum(scene: &Scene, theory: &Theory, mass: f64, over: f64) -> Option<[Extreme; 2]> {
    let (instants, g) = (&theory.instants, -scene.gravity[1]);
    let (first, last) = (instants.first()?.time, instants.last()?.time);
    let speed = |time: f64| {
        let k = instants.partition_point(|now| now.time <= time).clamp(1, instants.len() - 1);
        let (a, b) = (&instants[k - 1], &instants[k]);
        a.speed + (b.speed - a.speed) * (time - a.time) / (b.time - a.time)
    };
    let starts = instants.iter().flat_map(|now| [now.time, now.time - over]);
    let within = starts.filter(|start| *start >= first && start + over <= last);
    let slowed = within.map(|start| (start, (speed(start) - speed(start + over)) / over));
    let (start, rate) = slowed.max_by(|a, b| a.1.total_cmp(&b.1))?;
    let time = start + 0.5 * over;
    let of = |value: f64| Extreme { value: value.abs(), time };
    Some([of(mass * (g + rate)), of(rate / STANDARD_GRAVITY)])
}

/// What is not known of the largest force of a theory, and why; `None` where nothing speaks against it.
pub(super) fn doubt(
    scene: &Scene,
    body: &Body,
    theory: &Theory,
    averaging: Option<Averaging>,
) -> Option<(Verdict, String)> {
    let instants = &theory.instants;
    let Some(contact) = instants.iter().position(|now| now.draught > 0.0) else {
        return Some((Verdict::NotResolved, "the body does not touch the water: set a later time.end".into()));
    };
    let (contact, last) = (instants[contact.saturating_sub(1)].time, instants.last()?.time);
    if let Some(Averaging { time, .. }) = averaging.filter(|averaging| last - contact < averaging.time) {
        let [time, bandwidth] = [time, CUTOFF / (last - contact)].map(significant);
        return Some((
            Verdict::NotResolved,
            format!(
                "the body is wet for less than the time of the mean, {time} s: set a later time.end, or report.bandwidth above {bandwidth} Hz"
            ),
        ));
    }
    if !theory.section.is_round() || theory.bending_flow().is_some() {
        return None;
    }
    if body.draught() > 0.0 && instants[0].draught > 0.0 && body.fastest_point() > 0.0 {
        let (verdict, _, why) = wet_start(body.draught());
        return Some((verdict, why?.text));
    }
    let entry = scene.entry()?;
    let Bottom::Arc { radius } = entry.bottom else { return None };
    let least = ACOUSTIC_TIMES * radius * entry.speed / (WATER_SOUND * WATER_SOUND);
    averaging.filter(|averaging| averaging.time < least).map(|Averaging { time, .. }| {
        let [time, least] = [time, least].map(significant);
        (
            Verdict::Acoustic,
            format!("it is averaged over {time} s; the sound of water acts on a round bottom for {least} s"),
        )
    })
}
