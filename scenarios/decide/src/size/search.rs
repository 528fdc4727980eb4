//! The boundary between values that are allowed and others.

use super::trial::Trial;

/// Relative width at which the boundary is known [-].
const NEAR: f64 = 2e-3;

/// Trials by value.
pub(super) struct Search {
    pub trials: Vec<Trial>,
}

/// The boundary.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Found {
    /// The value on its allowed side.
    pub allowed: f64,
    /// Its margin [-].
    margin: f64,
    /// Value and margin on the other side; `None` where all are allowed.
    pub forbidden: Option<[f64; 2]>,
    /// Are values below it allowed?
    pub is_largest: bool,
}

impl Search {
    pub fn of(mut trials: Vec<Trial>) -> Search {
        trials.sort_by(|a, b| a.value.total_cmp(&b.value));
        Search { trials }
    }

    pub fn add(&mut self, trial: Trial) {
        let at = self.trials.partition_point(|other| other.value < trial.value);
        self.trials.insert(at, trial);
    }

    pub fn at(&self, value: f64) -> &Trial {
        let near = |trial: &&Trial| (trial.value - value).abs();
        self.trials.iter().min_by(|a, b| near(a).total_cmp(&near(b))).unwrap_or(&self.trials[0])
    }

    /// The trial with the largest margin.
    pub fn best(&self) -> &Trial {
        self.trials.iter().max_by(|a, b| a.margin.share.total_cmp(&b.margin.share)).unwrap_or(&self.trials[0])
    }

    /// The smallest value from which on all larger ones are allowed; where the largest is not allowed, the largest up to which all are.
    pub fn boundary(&self) -> Option<Found> {
        let is_allowed = |k: usize| self.trials[k].margin.share >= 0.0;
        let last = self.trials.len() - 1;
        let at = |k: usize, other: Option<usize>, is_largest: bool| Found {
            allowed: self.trials[k].value,
            margin: self.trials[k].margin.share,
            forbidden: other.map(|k| [self.trials[k].value, self.trials[k].margin.share]),
            is_largest,
        };
        if is_allowed(last) {
            let first = (0..=last).rev().take_while(|k| is_allowed(*k)).last()?;
            return Some(at(first, first.checked_sub(1), false));
        }
        let end = (0..=last).take_while(|k| is_allowed(*k)).last()?;
        Some(at(end, Some(end + 1), true))
    }

    /// Does the margin grow with the value, or fall where the largest value is looked for?
    pub fn is_monotone(&self, is_largest: bool) -> bool {
        let slack = 0.01;
        let grows = |pair: &[Trial]| pair[1].margin.share - pair[0].margin.share;
        self.trials.windows(2).all(|pair| if is_largest { grows(pair) < slack } else { grows(pair) > -slack })
    }

    /// Growth of the margin per value next to one.
    pub fn slope(&self, value: f64) -> Option<f64> {
        let k = self.trials.partition_point(|trial| trial.value < value).clamp(1, self.trials.len().max(2) - 1);
        let [a, b] = [self.trials.get(k - 1)?, self.trials.get(k)?];
        let slope = (b.margin.share - a.margin.share) / (b.value - a.value);
        (slope != 0.0 && slope.is_finite()).then_some(slope)
    }
}

impl Found {
    /// The next value to try: where the line through both sides meets a margin of nothing, kept off both by a tenth.
    pub fn next(&self) -> Option<f64> {
        let [forbidden, short] = self.forbidden?;
        let width = self.allowed - forbidden;
        if width.abs() <= NEAR * self.allowed.abs().max(forbidden.abs()) {
            return None;
        }
        let share = (short / (short - self.margin)).clamp(0.1, 0.9);
        Some(forbidden + share * width)
    }
}

#[cfg(test)]
mod tests {
    use super::super::margin::Margin;
    use super::*;

    fn trial(value: f64, share: f64) -> Trial {
        let margin = Margin { share, decided_by: "x".into(), result: 0.0, band: None, verdict: None };
        Trial { value, model: "mlm".into(), margin, panel_mass_kg_per_m: 0.0 }
    }

    #[test]
    fn the_boundary_of_a_margin_is_found_from_either_side() {
        for (margin, is_largest, exact) in [
            ((|x: f64| x * x / 2.0 - 1.0) as fn(f64) -> f64, false, 2.0_f64.sqrt()),
            (|x: f64| 1.0 - (x / 1.3).powi(3), true, 1.3),
        ] {
            let mut search = Search::of([3.0, 0.5, 1.0, 2.0].map(|x| trial(x, margin(x))).to_vec());
            let mut found = search.boundary().expect("a boundary");
            let mut tries = 0;
            while let Some(next) = found.next() {
                search.add(trial(next, margin(next)));
                found = search.boundary().expect("a boundary");
                tries += 1;
            }
            assert!((found.allowed / exact - 1.0).abs() < 2.5e-3 && found.is_largest == is_largest, "{found:?}");
            assert!(margin(found.allowed) >= 0.0 && tries < 16, "{tries}");
            assert!(search.is_monotone(is_largest));
        }
        assert_eq!(Search::of(vec![trial(1.0, -1.0), trial(2.0, -0.5)]).boundary(), None);
        let all = Search::of(vec![trial(1.0, 0.1), trial(2.0, 0.5)]).boundary().expect("all are allowed");
        assert_eq!((all.allowed, all.forbidden, all.next()), (1.0, None, None));
    }
}
