//! Where the wall time of a run goes.
//!
//! A run is a sequence of phases: each begins where the one before it ends, so that no time is counted twice. A verb of the
//! step names its phase where its work begins; two readings of the clock an evaluation are all it costs.

use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

/// A part of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// Neighbour lists: whether they hold, and making them.
    Search,
    /// Packing what the sums over pairs read.
    Pack,
    /// Sums of the continuity equation (WC3, WC4); of a projection the assembly of its operators.
    Density,
    /// The pressure equation of a projection, or the thesis's step.
    Pressure,
    /// Sums of the momentum equation (WC5–WC7).
    Momentum,
    /// Pressures of the walls, and forces on them (WA3).
    Walls,
    /// Step limit, kick, drift, shift, equation of state, and the check of the state.
    Integration,
    /// Between fluid and bodies: places, loads, contact, and what schemes repeat.
    Coupling,
    /// The bodies' own step.
    Structure,
    /// Momentum and work of every step.
    Audit,
    /// Samples, gauges, pictures and curves.
    Observers,
    /// Handing over the log, and waiting for the disk.
    Log,
}

impl Phase {
    /// All of them, in the order of a step.
    pub const ALL: [Phase; 12] = [
        Phase::Search,
        Phase::Pack,
        Phase::Density,
        Phase::Pressure,
        Phase::Momentum,
        Phase::Walls,
        Phase::Integration,
        Phase::Coupling,
        Phase::Structure,
        Phase::Audit,
        Phase::Observers,
        Phase::Log,
    ];

    /// Its name in a summary.
    pub fn name(self) -> &'static str {
        match self {
            Phase::Search => "search",
            Phase::Pack => "pack",
            Phase::Density => "density",
            Phase::Pressure => "pressure",
            Phase::Momentum => "momentum",
            Phase::Walls => "walls",
            Phase::Integration => "integration",
            Phase::Coupling => "coupling",
            Phase::Structure => "structure",
            Phase::Audit => "audit",
            Phase::Observers => "observers",
            Phase::Log => "log",
        }
    }
}

/// Wall time by phase.
///
/// ```
/// use sph_core::{Phase, Timers};
/// let mut timers = Timers::default();
/// timers.begin(Phase::Density);
/// timers.end();
/// assert_eq!(timers.seconds(Phase::Density), timers.total());
/// ```
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Timers {
    spent: [Duration; Phase::ALL.len()],
    #[serde(skip)]
    present: Option<(Phase, Instant)>,
}

impl Timers {
    /// From now on the time is `phase`'s; whose it was before.
    pub fn begin(&mut self, phase: Phase) -> Option<Phase> {
        self.resume(Some(phase))
    }

    /// From now on the time is that of `phase`, or of none; the phase before.
    pub fn resume(&mut self, phase: Option<Phase>) -> Option<Phase> {
        let now = Instant::now();
        let before = self.present.take();
        if let Some((phase, since)) = before {
            self.spent[phase as usize] += now - since;
        }
        self.present = phase.map(|phase| (phase, now));
        before.map(|(phase, _)| phase)
    }

    /// From now on the time belongs to no phase.
    pub fn end(&mut self) {
        self.resume(None);
    }

    /// `spent` of the present phase's time is `other`'s.
    pub fn hand_over(&mut self, other: Phase, spent: Duration) {
        let Some((phase, since)) = self.present else { return };
        let now = Instant::now();
        let spent = spent.min(now - since);
        self.spent[other as usize] += spent;
        self.spent[phase as usize] += now - since - spent;
        self.present = Some((phase, now));
    }

    /// Time of `phase` so far [s].
    pub fn seconds(&self, phase: Phase) -> f64 {
        self.spent[phase as usize].as_secs_f64()
    }

    /// Time of all phases so far [s].
    pub fn total(&self) -> f64 {
        self.spent.iter().sum::<Duration>().as_secs_f64()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spin(time: Duration) {
        let start = Instant::now();
        while start.elapsed() < time {
            std::hint::spin_loop();
        }
    }

    #[test]
    fn every_moment_belongs_to_one_phase() {
        let (mut timers, tick) = (Timers::default(), Duration::from_millis(3));
        spin(tick); // no phase's
        let start = Instant::now();
        timers.begin(Phase::Density);
        spin(tick);
        timers.begin(Phase::Momentum);
        spin(2 * tick);
        timers.begin(Phase::Density);
        spin(tick);
        timers.end();
        let all = start.elapsed().as_secs_f64();
        spin(tick);
        timers.end();
        let spun = 4.0 * tick.as_secs_f64(); // within phases; a busy machine may add to it, and between the clocks' readings
        assert!((spun..=all).contains(&timers.total()), "{} of {all} s, {spun} s spun", timers.total());
        for phase in [Phase::Density, Phase::Momentum] {
            assert!(timers.seconds(phase) >= 2.0 * tick.as_secs_f64(), "{phase:?}");
        }
        let parts = timers.seconds(Phase::Density) + timers.seconds(Phase::Momentum);
        assert!((timers.total() - parts).abs() < 1e-12);
    }

    #[test]
    fn a_part_that_interrupts_gives_the_time_back() {
        let mut timers = Timers::default();
        assert_eq!(timers.begin(Phase::Coupling), None);
        let outer = timers.begin(Phase::Density);
        assert_eq!(timers.resume(outer), Some(Phase::Density));
        assert_eq!(timers.resume(None), Some(Phase::Coupling));
    }

    #[test]
    fn a_part_that_is_handed_over_is_counted_once() {
        let (mut timers, tick) = (Timers::default(), Duration::from_millis(2));
        let start = Instant::now();
        timers.begin(Phase::Observers);
        spin(3 * tick);
        timers.hand_over(Phase::Log, tick);
        timers.end();
        let all = start.elapsed().as_secs_f64();
        assert_eq!(timers.seconds(Phase::Log), tick.as_secs_f64());
        let kept = timers.seconds(Phase::Observers);
        assert!(kept >= 2.0 * tick.as_secs_f64() && kept <= all - tick.as_secs_f64() + 1e-9, "{kept} of {all} s");
    }

    #[test]
    fn names_are_distinct_and_in_place() {
        for (k, phase) in Phase::ALL.into_iter().enumerate() {
            assert_eq!(phase as usize, k);
            assert_eq!(Phase::ALL.iter().filter(|other| other.name() == phase.name()).count(), 1);
        }
    }
}
