//! A way down that is given as a function of time.

use std::sync::Arc;

/// Steps in which contact is searched for.
const STEPS: usize = 1000;

/// A motion that the water does not change.
#[derive(Clone)]
pub struct GivenMotion {
    at: Arc<dyn Fn(f64) -> [f64; 3] + Send + Sync>,
    end: f64,
}

impl std::fmt::Debug for GivenMotion {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("GivenMotion").field("end", &self.end).finish_non_exhaustive()
    }
}

impl GivenMotion {
    /// By draught [m], downward speed [m/s] and acceleration [m/s²] at a time [s], shape (3), from 0 to an `end` [s].
    pub fn new(end: f64, at: impl Fn(f64) -> [f64; 3] + Send + Sync + 'static) -> GivenMotion {
        GivenMotion { at: Arc::new(at), end }
    }

    /// Draught [m], downward speed [m/s] and acceleration [m/s²] at a time [s], shape (3).
    pub fn at(&self, time: f64) -> [f64; 3] {
        (self.at)(time)
    }

    /// Times from 0 to the end, at equal distances.
    fn times(&self) -> impl Iterator<Item = f64> + '_ {
        (0..=STEPS).map(|k| self.end * k as f64 / STEPS as f64)
    }

    /// When the keel touches the water [s]; the end where it does not.
    pub(crate) fn contact(&self) -> f64 {
        let above = |time: f64| self.at(time)[0] < 0.0;
        let Some(k) = self.times().position(|time| !above(time)) else { return self.end };
        let [mut before, mut after] =
            [self.end * k.saturating_sub(1) as f64 / STEPS as f64, self.end * k as f64 / STEPS as f64];
        for _ in 0..60 {
            let middle = 0.5 * (before + after);
            if above(middle) { before = middle } else { after = middle }
        }
        after
    }

    /// Largest draught up to the end [m].
    pub(crate) fn deepest(&self) -> f64 {
        self.times().map(|time| self.at(time)[0]).fold(f64::NEG_INFINITY, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A keel that hangs 0.1 m over the water for a second and then comes down at 2 m/s touches it after 1.05 s.
    #[test]
    fn contact_is_where_the_keel_comes_to_the_water() {
        let way =
            GivenMotion::new(2.0, |t: f64| [2.0 * (t - 1.0).max(0.0) - 0.1, if t > 1.0 { 2.0 } else { 0.0 }, 0.0]);
        assert!((way.contact() - 1.05).abs() < 1e-12, "{}", way.contact());
        assert!((way.deepest() - 1.9).abs() < 1e-12);
        assert_eq!(GivenMotion::new(2.0, |_| [-0.1, 0.0, 0.0]).contact(), 2.0);
    }
}
