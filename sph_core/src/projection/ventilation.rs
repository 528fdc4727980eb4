//! Rows that bear no tension, and air that comes in along walls (THEORY I8).

use crate::search::Search;

use super::Projection;

impl Projection {
    /// Every row may be under tension.
    pub(super) fn clear_pins(&mut self, n: usize) {
        self.pinned.clear();
        self.pinned.resize(n, false);
        self.pins = 0;
    }

    /// I8: pin the rows under tension that bear none, and return how many they are.
    pub(super) fn pin_slack(&mut self, pressure: &mut [f64], search: &Search, ventilated: bool) -> usize {
        self.find_slack(pressure, search, ventilated);
        let before = self.pins;
        for (k, p) in pressure.iter_mut().enumerate() {
            if *p < 0.0 && self.slack[k] && !self.pinned[k] {
                self.pinned[k] = true;
                self.pins += 1;
                *p = 0.0;
            }
        }
        self.pins - before
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
        let beside_wall = |k: usize| survey.around[k].filling > survey.around[k].fluid_filling;
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
