//! The pressure (THEORY I8–I11).

use crate::error::Breakdown;
use crate::fluid::Fluid;
use crate::sweep;

use super::survey::Survey;

impl Fluid {
    /// I7: rows near air are tied to it.
    pub(super) fn close_surface(&mut self) {
        let lattice = self.projection.lattice.expect("surveyed");
        let (p, rho0) = (&self.particles, self.parameters.eos.rho0);
        let (around, air) = (&self.projection.survey.around, &self.projection.air.exposure);
        let n = p.len();
        self.projection.excess.resize(n, 0.0);
        sweep::gather_into(&mut self.projection.excess, |k| {
            if air[k] == 0.0 {
                return 0.0;
            }
            // V_i · 2 |M|/(ρ d), |M|/d in units of 1/Δx²: V/Δx² = 1
            air[k] * 2.0 * lattice.closure(around[k].filling).link / rho0
        });
    }

    /// I8–I11.
    pub(super) fn solve_pressure(&mut self, dt: f64) -> Result<(), Breakdown> {
        let lattice = self.projection.lattice.expect("surveyed");
        let settings = self.parameters.projecting;
        let n = self.particles.len();
        let p = &self.particles;
        let projection = &mut self.projection;
        let relaxation = settings.relaxation_steps * dt;
        let (survey, air) = (&projection.survey, &projection.air.exposure);
        projection.source.resize(n, 0.0);
        sweep::gather_into(&mut projection.source, |k| {
            let volume = p.mass[k] / p.rho[k];
            let mut crowd = (survey.around[k].filling - p.theta[k]) / lattice.filling;
            if air[k] > 0.0 {
                crowd = crowd.max(0.0);
            }
            lattice.gradient * volume / dt * (crowd / relaxation - survey.divergence[k])
        });
        projection.pinned.clear();
        projection.pinned.resize(n, false);
        let x = &mut self.derived.pressure;
        let mut pins = 0;
        for round in 0..6 {
            let (iterations, residual) = conjugate_gradients(
                survey,
                &projection.excess,
                &projection.source,
                &projection.pinned,
                x,
                settings.tolerance,
                settings.most_iterations,
            );
            projection.iterations += iterations as u64;
            projection.solves += 1;
            if residual > settings.tolerance {
                eprintln!("no convergence: {iterations} {residual:e} at {}", self.time);
            }
            let mut more = 0;
            for k in 0..n {
                if x[k] < 0.0 && air[k] > 0.0 && !projection.pinned[k] {
                    projection.pinned[k] = true;
                    x[k] = 0.0;
                    more += 1;
                }
            }
            pins += more;
            if more == 0 || settings.x[1] > 0.0 && round as f64 >= settings.x[1] {
                break;
            }
        }
        projection.pins = pins;
        Ok(())
    }
}

fn conjugate_gradients(
    a: &Survey,
    excess: &[f64],
    b: &[f64],
    pinned: &[bool],
    x: &mut [f64],
    tolerance: f64,
    most: usize,
) -> (usize, f64) {
    let n = x.len();
    let mut diagonal = vec![0.0; n];
    sweep::gather_into(&mut diagonal, |k| excess[k] + a.row(k).1.iter().sum::<f64>());
    for k in 0..n {
        if pinned[k] || diagonal[k] == 0.0 {
            x[k] = 0.0;
        }
    }
    let apply = |x: &[f64], out: &mut [f64]| {
        sweep::gather_into(out, |k| {
            if pinned[k] {
                return 0.0;
            }
            let (columns, values) = a.row(k);
            let mut sum = diagonal[k] * x[k];
            for (j, v) in columns.iter().zip(values) {
                sum -= v * x[*j as usize];
            }
            sum
        });
    };
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let mut q = vec![0.0; n];
    apply(x, &mut q);
    let mut r: Vec<f64> = (0..n).map(|k| if pinned[k] || diagonal[k] == 0.0 { 0.0 } else { b[k] - q[k] }).collect();
    let z =
        |r: &[f64]| -> Vec<f64> { (0..n).map(|k| if diagonal[k] > 0.0 { r[k] / diagonal[k] } else { 0.0 }).collect() };
    let mut s = z(&r);
    let mut d = s.clone();
    let mut rs = dot(&r, &s);
    let size = dot(b, b).sqrt();
    if size == 0.0 {
        return (0, 0.0);
    }
    for it in 0..most {
        let residual = dot(&r, &r).sqrt() / size;
        if residual < tolerance {
            return (it, residual);
        }
        apply(&d, &mut q);
        let alpha = rs / dot(&d, &q);
        for k in 0..n {
            x[k] += alpha * d[k];
            r[k] -= alpha * q[k];
        }
        s = z(&r);
        let new = dot(&r, &s);
        let beta = new / rs;
        rs = new;
        for k in 0..n {
            d[k] = s[k] + beta * d[k];
        }
    }
    (most, dot(&r, &r).sqrt() / size)
}
