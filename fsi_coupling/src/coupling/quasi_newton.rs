//! From an interface residual to better unknowns: Aitken's relaxation and a quasi-Newton step (THEORY C6, C7).

use std::collections::VecDeque;

/// Relaxation before anything is known [-] (C6, C7).
const CAUTIOUS: f64 = 0.5;
/// Bounds of Aitken's factor at the start of a step [-].
const FACTOR: [f64; 2] = [1e-3, 1.0];
/// A column whose part across the newer ones is a smaller share of it says nothing new (C7).
const NEW: f64 = 1e-3;
/// Columns of C7 that are kept, in unknowns, and at most.
const MEMORY: [usize; 2] = [2, 40];

/// A relaxation, with what it has learnt.
#[derive(Clone)]
pub(crate) struct Relaxation {
    method: Method,
    /// Unknowns and residuals of the iteration before, in the same step.
    last: Option<[Vec<f64>; 2]>,
}

#[derive(Clone)]
enum Method {
    Aitken { factor: f64 },
    QuasiNewton { columns: VecDeque<Column> },
}

/// Between two iterations: change of the residual, and of what the step made of the unknowns.
#[derive(Clone)]
struct Column {
    residual: Vec<f64>,
    outcome: Vec<f64>,
}

impl Relaxation {
    pub fn aitken() -> Relaxation {
        Relaxation { method: Method::Aitken { factor: CAUTIOUS }, last: None }
    }

    pub fn quasi_newton() -> Relaxation {
        Relaxation { method: Method::QuasiNewton { columns: VecDeque::new() }, last: None }
    }

    /// A step begins: what was learnt in the last one stays.
    pub fn begin(&mut self) {
        self.last = None;
        if let Method::Aitken { factor } = &mut self.method {
            *factor = factor.clamp(FACTOR[0], FACTOR[1]);
        }
    }

    /// Better unknowns than `x`, whose residual is `r`.
    pub fn next(&mut self, x: &[f64], r: &[f64]) -> Vec<f64> {
        let last = self.last.replace([x.to_vec(), r.to_vec()]);
        match &mut self.method {
            Method::Aitken { factor } => {
                if let Some([_, before]) = last {
                    let change = difference(r, &before);
                    let length = dot(&change, &change);
                    if length > 0.0 {
                        *factor *= -dot(&before, &change) / length; // ω ← −ω r⁻·(r − r⁻)/|r − r⁻|²
                    }
                }
                x.iter().zip(r).map(|(x, r)| x + *factor * r).collect()
            }
            Method::QuasiNewton { columns } => {
                if let Some([x_before, before]) = last {
                    let residual = difference(r, &before);
                    let outcome = difference(x, &x_before).iter().zip(&residual).map(|(x, r)| x + r).collect();
                    columns.push_front(Column { residual, outcome });
                    columns.truncate((MEMORY[0] * r.len()).min(MEMORY[1]));
                }
                quasi_newton(columns, x, r)
            }
        }
    }
}

/// C7: x + r + Σ c_i Δx̃_i, where Σ c_i Δr_i is as near to −r as the columns allow; newer columns first. What they do not
/// span is relaxed cautiously.
fn quasi_newton(columns: &VecDeque<Column>, x: &[f64], r: &[f64]) -> Vec<f64> {
    let mut rest: Vec<f64> = r.iter().map(|r| -r).collect();
    let mut step = vec![0.0; x.len()];
    let mut basis: Vec<Column> = Vec::new(); // orthonormal residuals, by Gram and Schmidt, twice
    for column in columns {
        let (mut residual, mut outcome) = (column.residual.clone(), column.outcome.clone());
        for _ in 0..2 {
            for known in &basis {
                let share = dot(&residual, &known.residual);
                add(&mut residual, -share, &known.residual);
                add(&mut outcome, -share, &known.outcome);
            }
        }
        let length = dot(&residual, &residual).sqrt();
        if length <= NEW * dot(&column.residual, &column.residual).sqrt() {
            continue;
        }
        residual.iter_mut().chain(&mut outcome).for_each(|v| *v /= length);
        let share = dot(&rest, &residual);
        add(&mut rest, -share, &residual);
        add(&mut step, share, &outcome);
        basis.push(Column { residual, outcome });
    }
    // r = −(spanned) − rest: the columns know what becomes of the first, nobody of the second
    let spanned: Vec<f64> = r.iter().zip(&rest).map(|(r, rest)| r + rest).collect();
    (0..x.len()).map(|k| x[k] + spanned[k] + step[k] - CAUTIOUS * rest[k]).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

fn add(sum: &mut [f64], scale: f64, term: &[f64]) {
    sum.iter_mut().zip(term).for_each(|(sum, term)| *sum += scale * term);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// r(x) = b − A x, as a light body's accelerations under their added mass: A = 1 + M⁻¹ A.
    fn residual(x: &[f64]) -> Vec<f64> {
        let (a, b) = ([[6.0, 0.5, -0.2], [0.1, 11.0, 0.4], [0.3, -0.6, 2.0]], [3.0, -9.81, 1.2]);
        (0..3).map(|i| b[i] - dot(&a[i], x)).collect()
    }

    fn iterations(relaxation: &mut Relaxation) -> usize {
        relaxation.begin();
        let mut x = vec![0.0; 3];
        for n in 1..=100 {
            let r = residual(&x);
            if dot(&r, &r).sqrt() < 1e-9 {
                return n;
            }
            x = relaxation.next(&x, &r);
        }
        panic!("no end after 100 iterations: {x:?}");
    }

    /// Three unknowns are known after three differences; in the next step at once.
    #[test]
    fn quasi_newton_is_exact_once_its_columns_span_the_unknowns() {
        let mut relaxation = Relaxation::quasi_newton();
        let first = iterations(&mut relaxation);
        assert!(first <= 6, "{first}");
        let second = iterations(&mut relaxation);
        assert!(second <= 3, "{second}");
    }

    #[test]
    fn aitken_converges_where_plain_repetition_does_not() {
        let n = iterations(&mut Relaxation::aitken());
        assert!(n <= 40, "{n}");
        let mut x = vec![0.0; 3];
        for _ in 0..20 {
            let r = residual(&x);
            add(&mut x, 1.0, &r);
        }
        assert!(dot(&x, &x) > 1e10, "plain repetition stays at {x:?}");
    }
}
