//! What may be said of peaks under flat and round bottoms, which meet the water all at once, or nearly so.

use scene::{Entry, FLAT_CONTACT, LEAST_GAP, LEAST_HALF_BREADTH, START_GAP};
use settings::significant;

use super::Finding;
use super::judge::{Curves, Judge};
use super::running_integral::Extreme;
use crate::vocabulary::Verdict;

/// A round bottom's peak needs an averaging time of so many R V/c₀² (GE20) [-].
const ACOUSTIC_TIMES: f64 = 10.0;
/// Draught at which the water's mass is a fifth of a round body's, at least (GE22) [spacings].
const LEAST_ROUND: f64 = 1.25;
/// Least band of a round bottom's peak through its window (GE20), and that of a radius of one spacing, shares of the force [-].
const ROUND_BAND: [f64; 2] = [0.05, 5.0];
/// Band of the pressure of the air under a flat bottom (WC27), share of it [-].
const AIR_BAND: f64 = 0.3;

impl Judge {
    /// What may be said of a peak under a flat bottom.
    pub(super) fn flat_finding(&self, curves: &Curves, entry: &Entry, peak: Extreme) -> Finding {
        let spacings = entry.cushion.map_or(0.0, |air| air.half_breadth / self.spacing);
        match self.air {
            None => (Verdict::Acoustic, None, Some(FLAT_CONTACT.into())),
            Some(_) if spacings < LEAST_HALF_BREADTH => {
                let why = format!(
                    "half the flat breadth is {} spacings; {LEAST_HALF_BREADTH} are needed",
                    significant(spacings)
                );
                (Verdict::NotResolved, None, Some(why.into()))
            }
            Some([_, end]) => {
                let contact = curves.draught.iter().find(|[_, draught]| *draught > 0.0).map_or(0.0, |[time, _]| *time);
                if peak.time <= contact + end {
                    return (Verdict::Resolved, Some(AIR_BAND), None);
                }
                let why = "it comes after the pulse of the air under the flat bottom: an echo of the floor or the walls, or another contact";
                (Verdict::Acoustic, None, Some(why.into()))
            }
        }
    }

    /// What may be said of a force on a round bottom of radius R [m], averaged over `window` [s].
    pub(super) fn round_finding(&self, curves: &Curves, entry: &Entry, radius: f64, window: f64) -> Finding {
        let gap = -curves.draught.first().map_or(0.0, |row| row[1]);
        if self.sound_speed.is_some() && gap < LEAST_GAP * self.spacing {
            let why = format!(
                "a round bottom that starts on the water meets a row of particles at once: leave time.start to the program, or \
                 start the body {} m above",
                significant(START_GAP * self.spacing)
            );
            return (Verdict::Acoustic, None, Some(why.into()));
        }
        let least = self.sound_speed.map_or(0.0, |c| ACOUSTIC_TIMES * radius * entry.speed / (c * c));
        if window < least {
            let why = format!(
                "it is averaged over {} s; the numerical speed of sound acts on a round bottom for {} s",
                significant(window),
                significant(least)
            );
            return (Verdict::Acoustic, None, Some(why.into()));
        }
        let spacings = entry.peak_draught / self.spacing;
        if spacings < LEAST_ROUND {
            let why = format!(
                "a light round body loses its speed within {} spacings; {LEAST_ROUND} are needed: {} m would do for \
                 resolution.spacing",
                significant(spacings),
                significant(entry.peak_draught / LEAST_ROUND)
            );
            return (Verdict::NotResolved, None, Some(why.into()));
        }
        let share = ROUND_BAND[0].max(ROUND_BAND[1] * self.spacing / radius);
        (Verdict::Resolved, Some(share), None)
    }
}
