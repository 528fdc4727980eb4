//! The boundary between values that are allowed and others.

use super::trial::Trial;

/// Relative width at which the boundary is known [-].
const NEAR: f64 = 2e-3;

/// Trials by value, and values that could not be run.
pub(super) struct Search {
    pub trials: Vec<Trial>,
    pub untried: Vec<Untried>,
}

/// A value that cannot be run.
#[derive(Clone, Debug)]
pub(super) struct Untried {
    pub value: f64,
    pub why: String,
}

/// The boundary.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Found {
    /// The value on its allowed side.
    pub allowed: f64,
    /// Its margin [-].
    margin: f64,
    /// The value on the other side, and its margin unless it cannot be run; `None` where all are allowed.
    other: Option<(f64, Option<f64>)>,
    /// Are values below it allowed?
    pub is_largest: bool,
    /// The smallest value above that is not allowed any more, of a smallest one.
    pub until: Option<f64>,
}

/// What is known of a value: its margin, unless it cannot be run.
type Point = (f64, Option<f64>);

impl Search {
    pub fn of(mut trials: Vec<Trial>, untried: Vec<Untried>) -> Search {
        trials.sort_by(|a, b| a.value.total_cmp(&b.value));
        Search { trials, untried }
    }

    pub fn add(&mut self, trial: Result<Trial, Untried>) {
        match trial {
            Ok(trial) => {
                let at = self.trials.partition_point(|other| other.value < trial.value);
                self.trials.insert(at, trial);
            }
            Err(untried) => self.untried.push(untried),
        }
    }

    pub fn at(&self, value: f64) -> &Trial {
        let near = |trial: &&Trial| (trial.value - value).abs();
        self.trials.iter().min_by(|a, b| near(a).total_cmp(&near(b))).unwrap_or(&self.trials[0])
    }

    /// The trial with the largest margin.
    pub fn best(&self) -> &Trial {
        self.trials.iter().max_by(|a, b| a.margin.share.total_cmp(&b.margin.share)).unwrap_or(&self.trials[0])
    }

    /// All values in their order, to the largest that can be run.
    fn points(&self) -> Vec<Point> {
        let tried = self.trials.iter().map(|trial| (trial.value, Some(trial.margin.share)));
        let mut points: Vec<Point> = tried.chain(self.untried.iter().map(|one| (one.value, None))).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        while points.last().is_some_and(|(_, margin)| margin.is_none()) {
            points.pop();
        }
        points
    }

    /// The smallest value from which on all larger ones are allowed; where the largest is not allowed, the largest up to which all are; where
    /// neither end is, the smallest that is allowed.
    pub fn boundary(&self) -> Option<Found> {
        let points = self.points();
        let is_allowed = |k: &usize| points[*k].1.is_some_and(|margin| margin >= 0.0);
        let is_refused = |k: &usize| points[*k].1.is_some_and(|margin| margin < 0.0);
        let at = |k: usize, other: Option<usize>, is_largest: bool| Found {
            allowed: points[k].0,
            margin: points[k].1.unwrap_or_default(),
            other: other.map(|k| points[k]),
            is_largest,
            until: (k..points.len()).find(is_refused).map(|k| points[k].0).filter(|_| !is_largest),
        };
        let last = points.len().checked_sub(1)?;
        if is_allowed(&last) {
            let first = (0..=last).rev().take_while(is_allowed).last()?;
            return Some(at(first, first.checked_sub(1), false));
        }
        let first = (0..=last).find(is_allowed)?;
        if (0..first).any(|k| is_refused(&k)) {
            return Some(at(first, Some(first - 1), false));
        }
        let end = (first..=last).take_while(is_allowed).last()?;
        Some(at(end, Some(end + 1), true))
    }

    /// Where none is allowed: between the best and the better of its neighbours.
    pub fn beside_best(&self) -> Option<f64> {
        let best = self.trials.iter().position(|trial| trial.value == self.best().value)?;
        let neighbours = [best.checked_sub(1), Some(best + 1)].into_iter().flatten().filter_map(|k| self.trials.get(k));
        let better = neighbours.max_by(|a, b| a.margin.share.total_cmp(&b.margin.share))?;
        Some(0.5 * (better.value + self.trials[best].value))
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
    /// Does no limit decide, but the end of the values that can be run?
    pub fn is_at_end(&self) -> bool {
        self.other.is_none_or(|(_, margin)| margin.is_none())
    }

    /// The next value to try: where the line through both sides meets a margin of nothing, kept off both by a tenth; halfway to one that cannot be
    /// run.
    pub fn next(&self) -> Option<f64> {
        let (other, margin) = self.other?;
        let width = self.allowed - other;
        if width.abs() <= NEAR * self.allowed.abs().max(other.abs()) {
            return None;
        }
        let share = margin.map_or(0.5, |short| (short / (short - self.margin)).clamp(0.1, 0.9));
        Some(other + share * width)
    }
}

#[cfg(test)]
mod tests {
    use super::super::margin::Margin;
    use super::*;

    fn trial(value: f64, share: f64) -> Trial {
        let margin = Margin { share, decided_by: "x".into(), result: 0.0, band: None, verdict: None };
        Trial { value, model: "mlm".into(), margin, panel_mass_kg_per_m: 0.0, doubts: Vec::new() }
    }

    #[test]
    fn the_boundary_of_a_margin_is_found_from_either_side() {
        for (margin, is_largest, exact) in [
            ((|x: f64| x * x / 2.0 - 1.0) as fn(f64) -> f64, false, 2.0_f64.sqrt()),
            (|x: f64| 1.0 - (x / 1.3).powi(3), true, 1.3),
        ] {
            let mut search = Search::of([3.0, 0.5, 1.0, 2.0].map(|x| trial(x, margin(x))).to_vec(), Vec::new());
            let mut found = search.boundary().expect("a boundary");
            let mut tries = 0;
            while let Some(next) = found.next() {
                search.add(Ok(trial(next, margin(next))));
                found = search.boundary().expect("a boundary");
                tries += 1;
            }
            assert!((found.allowed / exact - 1.0).abs() < 2.5e-3 && found.is_largest == is_largest, "{found:?}");
            assert!(margin(found.allowed) >= 0.0 && tries < 16, "{tries}");
            assert!(search.is_monotone(is_largest));
        }
        let of = |trials: Vec<Trial>| Search::of(trials, Vec::new());
        assert_eq!(of(vec![trial(1.0, -1.0), trial(2.0, -0.5)]).boundary(), None);
        let all = of(vec![trial(1.0, 0.1), trial(2.0, 0.5)]).boundary().expect("all are allowed");
        assert_eq!((all.allowed, all.is_at_end(), all.next()), (1.0, true, None));
    }

    /// The boundary lies between a value that cannot be run and the first that is allowed.
    #[test]
    fn values_that_cannot_be_run_are_no_end_of_the_search() {
        for (least, allowed, exact) in [(0.5, 1.3, 1.3), (1.5, 1.3, 1.5)] {
            let run = |value: f64| match value < least {
                true => Err(Untried { value, why: "too thin".into() }),
                false => Ok(trial(value, value - allowed)),
            };
            let mut search = Search::of(Vec::new(), Vec::new());
            [0.1, 4.0, 8.0].into_iter().for_each(|value| search.add(run(value)));
            while let Some(next) = search.boundary().and_then(|found| found.next()) {
                search.add(run(next));
            }
            let found = search.boundary().expect("a boundary");
            assert!((found.allowed / exact - 1.0).abs() < 4e-3 && !found.is_largest, "{found:?}");
            assert_eq!(found.is_at_end(), least > allowed);
        }
    }

    /// Between two limits the smallest value is found, also where none of the first is allowed.
    #[test]
    fn a_window_between_two_limits_is_found() {
        let margin = |x: f64| (x - 2.0).min(2.2 - x);
        let mut search = Search::of([1.0, 2.1, 3.0, 4.0].map(|x| trial(x, margin(x))).to_vec(), Vec::new());
        let found = search.boundary().expect("a window");
        assert_eq!((found.allowed, found.until, found.is_largest), (2.1, Some(3.0), false));
        search.trials.remove(1);
        assert_eq!(search.boundary(), None);
        while search.boundary().is_none() {
            let next = search.beside_best().expect("two trials");
            search.add(Ok(trial(next, margin(next))));
        }
        assert!(search.trials.len() < 9);
    }
}
