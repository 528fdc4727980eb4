//! Four rules for the force on the body, compared over a run (THEORY GE8): the check ∫ p dA = the body's force.

use fsi_coupling::coupling::force_rules::{RULES, force_rules};
use scene::Scene;
use serde::Serialize;
use sph_core::state_bytes::{StateError, decode, encode, expect_count};

use super::{Frame, ObserveError, Observer, mean_and_deviation};

/// A rule's numbers over a run.
#[derive(Clone, Debug, Serialize)]
pub struct RuleResult {
    /// The rule: `reaction`, `first_row`, `gauss`, `gauss_viscous`.
    pub rule: &'static str,
    /// Mean force over the last fifth of the run [N/m].
    pub force_n_per_m: [f64; 2],
    /// Standard deviation of the vertical force over the last fifth [N/m].
    pub force_y_sd_n_per_m: f64,
    /// Mean moment about the body frame's origin over the last fifth [N].
    pub moment_n: f64,
    /// ∫F dt over the run [N s/m].
    pub impulse_n_s_per_m: [f64; 2],
    /// |mean force − that of the reactions| over the latter [-].
    pub force_difference: f64,
    /// |impulse − that of the reactions| over the latter [-].
    pub impulse_difference: f64,
}

/// Samples the rules' resultants.
pub struct ForceRules {
    panel: f64,
    times: Vec<f64>,
    /// Fx [N/m], Fy [N/m], moment [N] of each rule.
    loads: Vec<[[f64; 3]; 4]>,
}

impl ForceRules {
    /// For a scene with a body and `report.force_rules`.
    pub fn new(scene: &Scene) -> Option<ForceRules> {
        let asked = scene.report.force_rules && scene.body.is_some();
        asked.then(|| ForceRules { panel: scene.resolution.spacing, times: Vec::new(), loads: Vec::new() })
    }

    /// The samples, as bytes.
    pub fn to_bytes(&self) -> Vec<u8> {
        encode(&(&self.times, &self.loads))
    }

    /// Take samples.
    pub fn restore_bytes(&mut self, bytes: &[u8]) -> Result<(), StateError> {
        (self.times, self.loads) = decode("the force rules", bytes)?;
        expect_count("loads of force rules", self.loads.len(), self.times.len())
    }

    /// The numbers of each rule, means from `since` [s] on; empty before the first sample.
    pub fn result(&self, since: f64) -> Vec<RuleResult> {
        let late: Vec<usize> = (0..self.times.len()).filter(|&k| self.times[k] >= since).collect();
        if late.is_empty() {
            return Vec::new();
        }
        let of = |rule: usize, c: usize| late.iter().map(|&k| self.loads[k][rule][c]).collect::<Vec<f64>>();
        let mean = |rule: usize, c: usize| mean_and_deviation(&of(rule, c))[0];
        let impulse = |rule: usize, c: usize| {
            let step = |k: usize| {
                0.5 * (self.times[k + 1] - self.times[k]) * (self.loads[k][rule][c] + self.loads[k + 1][rule][c])
            };
            (0..self.times.len() - 1).map(step).sum::<f64>()
        };
        let difference = |of: &dyn Fn(usize, usize) -> f64, rule: usize| {
            let [dx, dy] = [0, 1].map(|c| of(rule, c) - of(0, c));
            dx.hypot(dy) / of(0, 0).hypot(of(0, 1))
        };
        let result = |rule: usize| RuleResult {
            rule: RULES[rule].name(),
            force_n_per_m: [mean(rule, 0), mean(rule, 1)],
            force_y_sd_n_per_m: mean_and_deviation(&of(rule, 1))[1],
            moment_n: mean(rule, 2),
            impulse_n_s_per_m: [impulse(rule, 0), impulse(rule, 1)],
            force_difference: difference(&mean, rule),
            impulse_difference: difference(&impulse, rule),
        };
        (0..RULES.len()).map(result).collect()
    }
}

impl Observer for ForceRules {
    fn observe(&mut self, frame: &Frame<'_>) -> Result<(), ObserveError> {
        let body = frame.system.bodies().position(|b| b.motion().is_some() && b.outline().is_some());
        if let Some(loads) = body.and_then(|k| force_rules(frame.system, k, self.panel)) {
            self.times.push(frame.time());
            self.loads.push(loads.map(|load| {
                let r = load.resultant;
                [r.force[0], r.force[1], r.moment]
            }));
        }
        Ok(())
    }
}
