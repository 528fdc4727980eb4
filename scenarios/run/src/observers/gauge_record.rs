//! The results of a gauge: peak, rise time, impulse (THEORY GE5).

use serde::{Deserialize, Serialize};

/// Shares of the peak between which the rise is timed [-].
const RISE: [f64; 2] = [0.1, 0.9];

/// One gauge in `summary.json`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct GaugeResult {
    /// Largest pressure [Pa].
    pub peak_pa: f64,
    /// When [s].
    pub peak_time_s: f64,
    /// From the last rise through 10 % of the peak to the first through 90 % after it [s]; `null` where the run starts
    /// above 10 %, or the peak is not above 0.
    pub rise_time_s: Option<f64>,
    /// ∫ p dt over the run [Pa s].
    pub impulse_pa_s: f64,
    /// Length of the face it averages over [m], beside the kernel's own support; 0: a point.
    pub length_m: f64,
    /// Bandwidth of its low-pass [Hz]; `null`: none.
    pub bandwidth_hz: Option<f64>,
}

/// Times [s] and pressures [Pa] of one gauge, of every step.
#[derive(Default, Serialize, Deserialize)]
pub struct GaugeRecord {
    curve: Vec<[f64; 2]>,
}

impl GaugeRecord {
    /// Add a reading; a second one at the same time is ignored.
    pub fn take(&mut self, time: f64, pressure: f64) {
        if self.curve.last().is_none_or(|last| time > last[0]) {
            self.curve.push([time, pressure]);
        }
    }

    /// The last pressure taken [Pa]; 0 before any.
    pub fn latest(&self) -> f64 {
        self.curve.last().map_or(0.0, |last| last[1])
    }

    /// The numbers, for a gauge of `length` [m] and `bandwidth` [Hz]; `None` without a reading.
    pub fn result(&self, length: f64, bandwidth: Option<f64>) -> Option<GaugeResult> {
        let top = (0..self.curve.len()).max_by(|a, b| self.curve[*a][1].total_cmp(&self.curve[*b][1]))?;
        let [peak_time_s, peak_pa] = self.curve[top];
        let panel = |w: &[[f64; 2]]| 0.5 * (w[0][1] + w[1][1]) * (w[1][0] - w[0][0]);
        Some(GaugeResult {
            peak_pa,
            peak_time_s,
            rise_time_s: self.rise(top),
            impulse_pa_s: self.curve.windows(2).map(panel).sum(),
            length_m: length,
            bandwidth_hz: bandwidth,
        })
    }

    fn rise(&self, top: usize) -> Option<f64> {
        let before = &self.curve[..=top];
        let [low, high] = RISE.map(|share| share * before[top][1]);
        let start = before.iter().rposition(|p| p[1] < low)?;
        let end = start + before[start..].iter().position(|p| p[1] >= high)?;
        let passage = |k: usize, level: f64| {
            let ([t0, p0], [t1, p1]) = (before[k], before[k + 1]);
            t0 + (t1 - t0) * (level - p0) / (p1 - p0)
        };
        (before[top][1] > 0.0).then(|| passage(end - 1, high) - passage(start, low))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(curve: &[[f64; 2]]) -> GaugeResult {
        let mut record = GaugeRecord::default();
        curve.iter().for_each(|[t, p]| record.take(*t, *p));
        record.result(0.02, Some(500.0)).expect("a reading")
    }

    #[test]
    fn a_triangle_has_its_height_area_and_eight_tenths_of_its_flank() {
        // a forerunner of 20 % that dies away, then a flank of 1 s from 2 s on
        let r = record(&[[0.0, 0.0], [0.5, 20.0], [1.0, 0.0], [2.0, 0.0], [3.0, 100.0], [5.0, 0.0], [5.0, 9.0]]);
        assert_eq!([r.peak_pa, r.peak_time_s], [100.0, 3.0]);
        assert!((r.rise_time_s.expect("it rises") - 0.8).abs() < 1e-12, "{r:?}");
        assert!((r.impulse_pa_s - 160.0).abs() < 1e-12);
        assert_eq!((r.length_m, r.bandwidth_hz), (0.02, Some(500.0)));
    }

    #[test]
    fn a_gauge_under_load_from_the_start_has_no_rise_time() {
        assert_eq!(record(&[[0.0, 9.0], [1.0, 10.0], [2.0, 9.5]]).rise_time_s, None);
        assert_eq!(record(&[[0.0, -9.0], [1.0, -1.0]]).rise_time_s, None);
        assert_eq!(GaugeRecord::default().result(0.0, None), None);
    }
}
