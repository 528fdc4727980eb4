//! A curve's running integral, taken in every step, and its largest mean over a time (THEORY GE18).

use serde::{Deserialize, Serialize};
use sph_core::state_bytes::{StateError, expect_count};

/// Times [s] and integrals of `N` curves that are read together, and the largest of their values.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(try_from = "Stored", into = "Stored")]
pub struct RunningIntegral<const N: usize> {
    times: Vec<f64>,
    integrals: Vec<[f64; N]>,
    last: Option<[f64; N]>,
    largest: Option<Extreme>,
}

/// Times, integrals and last values one after the other, and the largest.
type Stored = (Vec<f64>, Vec<f64>, Vec<f64>, Option<Extreme>);

impl<const N: usize> From<RunningIntegral<N>> for Stored {
    fn from(curve: RunningIntegral<N>) -> Stored {
        let last = curve.last.map_or(Vec::new(), |values| values.to_vec());
        (curve.times, curve.integrals.into_flattened(), last, curve.largest)
    }
}

impl<const N: usize> TryFrom<Stored> for RunningIntegral<N> {
    type Error = StateError;

    fn try_from((times, integrals, last, largest): Stored) -> Result<RunningIntegral<N>, StateError> {
        let (integrals, rest) = integrals.as_chunks::<N>();
        expect_count("integrals of a curve", integrals.len(), times.len())?;
        expect_count("numbers of a curve", N * integrals.len() + rest.len(), N * times.len())?;
        let last = <[f64; N]>::try_from(last).ok();
        Ok(RunningIntegral { times, integrals: integrals.to_vec(), last, largest })
    }
}

/// An extreme of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Extreme {
    /// Magnitude.
    pub value: f64,
    /// When [s]; of a mean the middle of its time.
    pub time: f64,
}

/// Length of a vector.
fn magnitude<const N: usize>(vector: [f64; N]) -> f64 {
    vector.iter().map(|x| x * x).sum::<f64>().sqrt()
}

impl<const N: usize> RunningIntegral<N> {
    /// Add values at a later time; at the same time they are ignored.
    pub fn take(&mut self, time: f64, values: [f64; N]) {
        let integral = match (self.times.last(), self.last, self.integrals.last()) {
            (Some(last), ..) if time <= *last => return,
            (Some(last), Some(before), Some(integral)) => {
                std::array::from_fn(|k| integral[k] + 0.5 * (time - last) * (before[k] + values[k]))
            }
            _ => [0.0; N],
        };
        self.times.push(time);
        self.integrals.push(integral);
        self.last = Some(values);
        if self.largest.is_none_or(|largest| magnitude(values) > largest.value) {
            self.largest = Some(Extreme { value: magnitude(values), time });
        }
    }

    /// Magnitude of the largest integral, and of what is added to it later: the same as that of the whole where a force does not turn round.
    pub fn largest_and_later(&self) -> f64 {
        let farthest = self.integrals.iter().copied().max_by(|a, b| magnitude(*a).total_cmp(&magnitude(*b)));
        let (farthest, last) = (farthest.unwrap_or([0.0; N]), self.integrals.last().copied().unwrap_or([0.0; N]));
        magnitude(farthest) + magnitude(std::array::from_fn::<f64, N, _>(|k| last[k] - farthest[k]))
    }

    /// The largest magnitude of any step; `None` before any.
    pub fn largest(&self) -> Option<Extreme> {
        self.largest
    }

    /// The largest magnitude of a mean over `window` [s]; `None` where the curve is shorter.
    pub fn largest_mean(&self, window: f64) -> Option<Extreme> {
        let first = *self.times.first()?;
        let (mut from, mut largest) = (0, None::<Extreme>);
        for (k, &time) in self.times.iter().enumerate().filter(|(_, time)| **time - window >= first) {
            let start = time - window;
            while self.times[from + 1] < start {
                from += 1;
            }
            let share = (start - self.times[from]) / (self.times[from + 1] - self.times[from]);
            let [before, after] = [self.integrals[from], self.integrals[from + 1]];
            let mean = std::array::from_fn::<f64, N, _>(|i| {
                (self.integrals[k][i] - before[i] - share * (after[i] - before[i])) / window
            });
            if largest.is_none_or(|l| magnitude(mean) > l.value) {
                largest = Some(Extreme { value: magnitude(mean), time: time - 0.5 * window });
            }
        }
        largest
    }

    /// The mean over `window` [s] about a time; `None` where the curve is shorter.
    pub fn mean_about(&self, time: f64, window: f64) -> Option<[f64; N]> {
        let [from, to] = [-0.5, 0.5].map(|half| self.integral_at(time + half * window));
        let (from, to) = (from?, to?);
        Some(std::array::from_fn(|i| (to[i] - from[i]) / window))
    }

    /// The integral up to a time [s] within the curve, linear between its rows.
    fn integral_at(&self, time: f64) -> Option<[f64; N]> {
        let tolerance = 1e-9 * (self.times.last()? - self.times.first()?);
        let inside = time >= self.times.first()? - tolerance && time <= self.times.last()? + tolerance;
        let after = self.times.partition_point(|t| *t < time).clamp(1, self.times.len().max(2) - 1);
        let (before, [from, to]) = (after - 1, [self.times.get(after - 1)?, self.times.get(after)?]);
        let share = ((time - from) / (to - from)).clamp(0.0, 1.0);
        let [start, end] = [self.integrals[before], self.integrals[after]];
        inside.then(|| std::array::from_fn(|i| start[i] + share * (end[i] - start[i])))
    }

    /// Middles [s] and means of the intervals between its rows.
    pub fn step_means(&self) -> Vec<(f64, [f64; N])> {
        let rows = self.times.windows(2).zip(self.integrals.windows(2));
        let mean = |(t, i): (&[f64], &[[f64; N]])| {
            (0.5 * (t[0] + t[1]), std::array::from_fn(|k| (i[1][k] - i[0][k]) / (t[1] - t[0])))
        };
        rows.map(mean).collect()
    }

    /// The integral over the whole curve.
    pub fn total(&self) -> [f64; N] {
        self.integrals.last().copied().unwrap_or([0.0; N])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1 N s/m upwards, then 0.9 downwards: the parts are 1.9 together, the rest is 0.1.
    #[test]
    fn the_impulse_of_a_force_that_turns_round_has_two_parts() {
        let mut force = RunningIntegral::default();
        for (time, lift) in [(0.0, 1.0), (1.0, 1.0), (1.0 + 1e-9, -0.9), (2.0, -0.9)] {
            force.take(time, [0.0, lift]);
        }
        assert!((force.largest_and_later() - 1.9).abs() < 1e-6 && (force.total()[1] - 0.1).abs() < 1e-6);
    }

    /// The mean about a time, between rows too; outside the curve there is none.
    #[test]
    fn the_mean_about_a_time_is_that_of_a_rising_curve() {
        let mut curve = RunningIntegral::<1>::default();
        for k in 0..=10 {
            curve.take(0.1 * f64::from(k), [f64::from(k)]);
        }
        // the integral of 10 t is exact at the rows, from 0.4 to 0.7 s
        let mean = curve.mean_about(0.55, 0.3).expect("inside");
        assert!((mean[0] - 5.5).abs() < 1e-12, "{mean:?}");
        assert_eq!((curve.mean_about(0.05, 0.22), RunningIntegral::<1>::default().mean_about(0.0, 1.0)), (None, None));
    }

    /// A spike of one step on a slow rise: the largest value is the spike, the largest mean is the rise's, and the integral is exact.
    #[test]
    fn a_mean_is_not_misled_by_a_spike() {
        let mut curve = RunningIntegral::<1>::default();
        for k in 0..=1000 {
            let time = 1e-3 * f64::from(k);
            curve.take(time, [if k == 100 { 50.0 } else { time }]);
        }
        assert_eq!(curve.largest(), Some(Extreme { value: 50.0, time: 0.1 }));
        let mean = curve.largest_mean(0.2).expect("a curve of 1 s");
        assert!((mean.value - 0.9).abs() < 1e-9 && (mean.time - 0.9).abs() < 1e-9, "{mean:?}");
        assert!((curve.total()[0] - (0.5 + 49.9e-3)).abs() < 1e-9);
        assert_eq!(curve.largest_mean(2.0), None);
    }

    #[test]
    fn the_mean_of_a_vector_is_a_vector() {
        let mut curve = RunningIntegral::<2>::default();
        for k in 0..=100 {
            let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
            curve.take(f64::from(k), [3.0, 4.0 * sign]);
        }
        assert_eq!(curve.largest().expect("values").value, 5.0);
        assert!((curve.largest_mean(10.0).expect("long enough").value - 3.0).abs() < 0.1);
    }
}
