//! What withdraws results or their bands, whatever their own verdicts say.

use super::bandwidth::CUTOFF;
use super::doubt::{Doubt, Doubts};
use super::quantity::Quantity;
use super::results::Results;
use super::verdict::Verdict;

/// Share of the run after which a largest value may go on growing [-].
const AT_END: f64 = 0.995;

impl Results {
    /// What is largest at the end of a free body's run from `start` to `end` [s] is not resolved.
    pub fn still_growing(&mut self, [start, end]: [f64; 2]) -> Option<Doubt> {
        let last = start + AT_END * (end - start);
        let reaches_end = |quantity: &Quantity| {
            let window = quantity.cutoff_hz.map_or(0.0, |cutoff| CUTOFF / cutoff);
            quantity.time_s.is_some_and(|time| time + 0.5 * window >= last)
        };
        let mut about = Vec::new();
        for (name, quantity) in self.body.iter_mut().filter(|(_, quantity)| reaches_end(quantity)) {
            if quantity.verdict.is_sound() {
                *quantity = Quantity { band: None, ..quantity.doubted() };
            }
            about.push(name.name().to_string());
        }
        let why = "the largest value comes at the end of the run and may go on growing: a later time.end would show it";
        (!about.is_empty()).then(|| Doubt { about, why: why.into() })
    }

    /// Stresses of panels over most of which the water has not come by the end of the run are not resolved.
    pub fn not_passed(&mut self, panels: &[String]) -> Option<Doubt> {
        let mut about = Vec::new();
        for (panel, of_panel) in self.panels.iter_mut().filter(|(name, _)| panels.contains(name)) {
            of_panel.values_mut().for_each(|quantity| *quantity = quantity.doubted());
            about.push(panel.clone());
        }
        let why = "the water has not come over most of the panel by the end of the run: the stress may go on growing, which a later time.end would show";
        (!about.is_empty()).then(|| Doubt { about, why: why.into() })
    }

    /// The same; where work of the water is lost between fluid and body, results of panels are not resolved.
    pub fn with_work_lost(mut self, lost: bool) -> Results {
        let of_panels = self.panels.values_mut().flat_map(|panel| panel.values_mut());
        of_panels.filter(|_| lost).for_each(|quantity| *quantity = quantity.doubted());
        self
    }

    /// What comes at `from` [s] or later, or belongs to the whole run, is not resolved, and why.
    pub fn unresolve(&mut self, from: f64, why: &str) -> Option<Doubt> {
        let later = |quantity: &&mut Quantity| quantity.time_s.is_none_or(|time| time >= from);
        let mut about = Vec::new();
        for (name, quantity) in self.body.iter_mut().filter(|(_, quantity)| later(quantity)) {
            if quantity.verdict.is_sound() {
                *quantity = Quantity { band: None, ..quantity.doubted() };
            }
            about.push(name.name().to_string());
        }
        (!about.is_empty()).then(|| Doubt { about, why: why.into() })
    }

    /// The same without bands, and why: the flow was computed with keys of the method, in words, with which no band was measured.
    pub fn without_bands(mut self, unusual: &[String], doubts: &mut Doubts) -> Results {
        let why = format!("no band was measured with {}", unusual.join(", "));
        let banded = self.named().filter(|(_, quantity)| quantity.band.is_some());
        doubts.extend(banded.map(|(id, _)| Doubt::about(id, why.clone())).collect::<Vec<_>>());
        for quantity in self.quantities_mut() {
            let verdict = if quantity.verdict == Verdict::Resolved { Verdict::NoBand } else { quantity.verdict };
            *quantity = Quantity { band: None, verdict, ..*quantity };
        }
        self
    }
}
