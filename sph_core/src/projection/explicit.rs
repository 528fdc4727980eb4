//! The pressure from one sweep (THEORY EX3–EX5).

use crate::fluid::Fluid;
use crate::parallel;
use crate::solver::Solver;

/// Largest Courant number of a sweep (EX4) [-].
const LARGEST_COURANT: f64 = 0.2;

impl Fluid {
    /// I14, EX4: Courant number of a projection's step [-].
    pub(crate) fn courant(&self) -> f64 {
        let swept = self.parameters.solver == Solver::IncompressibleExplicit;
        if swept { self.parameters.cfl.min(LARGEST_COURANT) } else { self.parameters.cfl }
    }

    /// EX3: one Jacobi sweep of the pressure equation, from the last step's pressures; no tension where I8 forbids it.
    pub(crate) fn sweep_pressure(&mut self, dt: f64) {
        self.gather_source(dt);
        let projection = &mut self.projection;
        projection.clear_pins(self.particles.len());
        projection.before.clone_from(&self.derived.pressure);
        let (survey, search, n) = (&projection.survey, &self.search, self.particles.len());
        let (source, excess, before) = (&projection.source, &projection.excess, &projection.before);
        parallel::gather_into(&mut self.derived.pressure, |k| {
            let (mut sum, mut diagonal) = (source[k], excess[k]);
            let (near, values) = survey.row(k);
            for (&j, value) in near.iter().zip(values) {
                let source = search.source(j, n);
                if source != k {
                    sum += value * before[source];
                    diagonal += value;
                }
            }
            if diagonal > 0.0 { sum / diagonal } else { 0.0 }
        });
        projection.pin_slack(&mut self.derived.pressure, &self.search, self.parameters.ventilation);
    }
}
