//! Rows that bear no tension, and air that comes in along walls (THEORY I8).

use crate::neighbours::Search;

use crate::projection::Projection;

/// What a row leaves of the equation is worth a further solve from this share of the strongest source on [-].
const WORTH: f64 = 1e-3;

/// Rows that were pinned in so many steps are taken to be so in the next.
const LASTING: u8 = 2;

impl Projection {
    /// Every row may be under tension.
    pub(crate) fn clear_pins(&mut self, n: usize) {
        self.pinned.clear();
        self.pinned.resize(n, false);
        self.pins = 0;
    }

    /// I8: the rows near air that were pinned in the last steps are so at first, unless the water would press there under
    /// pressures `pressure` [Pa].
    pub(crate) fn keep_pins(&mut self, pressure: &mut [f64], id: &[u32]) {
        self.clear_pins(pressure.len());
        self.kept.resize(id.len(), 0);
        for (k, p) in pressure.iter_mut().enumerate() {
            if self.kept[id[k] as usize] >= LASTING && self.air.exposure[k] > 0.0 {
                self.pinned[k] = true;
                *p = 0.0;
            }
        }
        self.pins = self.pinned.iter().filter(|&&pinned| pinned).count();
        self.release_pins(pressure, 0.0);
    }

    /// By how much row `k`, without pressure, would be over-filled [-]: its residual over the scale (PS3).
    fn pressing(&self, k: usize, pressure: &[f64]) -> f64 {
        (self.source[k] - self.matrix.times(k, pressure)) / self.scale[k]
    }

    /// Let go of pinned rows that press by more than `limit`; returns how many they are.
    fn release_pins(&mut self, pressure: &[f64], limit: f64) -> usize {
        let before = self.pins;
        if before == 0 {
            return 0;
        }
        for k in 0..pressure.len() {
            if self.pinned[k] && self.pressing(k, pressure) > limit {
                self.pinned[k] = false;
                self.pins -= 1;
            }
        }
        before - self.pins
    }

    /// Who is pinned now, and for how many steps.
    pub(crate) fn remember_pins(&mut self, id: &[u32]) {
        for (k, &i) in id.iter().enumerate() {
            let kept = &mut self.kept[i as usize];
            *kept = if self.pinned[k] { kept.saturating_add(1) } else { 0 };
        }
    }

    /// I8: pin the rows under tension that bear none; returns which are new, and their tension [Pa].
    pub(crate) fn pin_slack(&mut self, pressure: &mut [f64], search: &Search, ventilated: bool) -> Vec<(usize, f64)> {
        self.find_slack(pressure, search, ventilated);
        let mut new = Vec::new();
        for (k, p) in pressure.iter_mut().enumerate() {
            if *p < 0.0 && self.slack[k] && !self.pinned[k] {
                self.pinned[k] = true;
                new.push((k, -*p));
                *p = 0.0;
            }
        }
        self.pins += new.len();
        new
    }

    /// I8: pin rows under tension, and in the first round let go of those that lack a pressure; returns whether what that
    /// leaves of the equation is worth a further solve.
    pub(crate) fn revise_pins(&mut self, pressure: &mut [f64], search: &Search, ventilated: bool, first: bool) -> bool {
        let released = if first { self.release_pins(pressure, WORTH) } else { 0 };
        let new = self.pin_slack(pressure, search, ventilated);
        let left = |&(k, tension): &(usize, f64)| self.matrix.diagonal[k] * tension / self.scale[k];
        released > 0 || new.iter().map(left).any(|left| left > WORTH)
    }

    /// I8: rows near air and, where air comes in along walls, those beside one to which others like them, all under tension,
    /// lead from there.
    fn find_slack(&mut self, pressure: &[f64], search: &Search, ventilated: bool) {
        let n = pressure.len();
        let Projection { slack, air, survey, pinned, .. } = self;
        slack.clear();
        slack.extend(air.exposure.iter().map(|&exposure| exposure > 0.0));
        if !ventilated {
            return;
        }
        let beside_wall = |k: usize| survey.around[k].wall_filling > 0.0;
        let mut reached: Vec<usize> = (0..n).filter(|&k| slack[k]).collect();
        while let Some(k) = reached.pop() {
            for j in search.fluid.of(k) {
                let j = search.source(j, n);
                if !slack[j] && beside_wall(j) && (pinned[j] || pressure[j] < 0.0) {
                    slack[j] = true;
                    reached.push(j);
                }
            }
        }
    }
}
