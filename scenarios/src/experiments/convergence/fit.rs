//! Extrapolation to zero spacing and infinite sound speed, with its order and its uncertainty (THEORY GE16).

use run::power_law::least_squares;
use serde::Serialize;

/// Orders that a convergent sequence may show [-].
const ORDERS: [f64; 2] = [0.5, 3.0];
/// Order taken where none in that range is observed: that of walls and free surface.
const USUAL_ORDER: f64 = 1.0;
/// Orders searched [-].
const SEARCHED: [f64; 2] = [0.02, 12.0];
/// Factor of safety on an estimated error (Roache 1998): with an observed order, and without.
const SAFETY: [f64; 2] = [1.25, 3.0];
/// Widest band that counts as converged [-].
const WIDEST_BAND: f64 = 0.05;

/// One run of a study.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Finest spacing Δx [m].
    pub spacing: f64,
    /// Law f(M) of the error due to the sound speed [-].
    pub law: f64,
    /// The quantity q.
    pub value: f64,
}

/// q = q₀ + A Δxᵖ + B f(M), fitted.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fit {
    /// q₀: the value at zero spacing and infinite sound speed.
    pub extrapolated: f64,
    /// Observed order p [-]; `null` where fewer than three spacings were run, or they are not monotone.
    pub order: Option<f64>,
    /// Order that the extrapolation used [-].
    pub order_used: f64,
    /// Error of the finest run due to its spacing, A Δxᵖ/|q₀| [-].
    pub discretisation_error: f64,
    /// Error of the finest run due to its sound speed, B f(M)/|q₀| [-]; `null` where only one was run.
    pub sound_speed_error: Option<f64>,
    /// Share of the sound speed in the two errors' magnitudes [-].
    pub sound_speed_share: Option<f64>,
    /// Standard deviation of the runs about the fit over |q₀| [-]; `null` where the fit has no runs to spare.
    pub scatter: Option<f64>,
    /// Half width of the band about q₀, over |q₀| [-].
    pub uncertainty: f64,
    /// Monotone, of an order from 0.5 to 3, with a band of 5 % at most.
    pub converged: bool,
    /// Why it is not converged; empty where it is.
    #[serde(rename = "doubts")]
    pub warnings: Vec<String>,
}

/// Fit the runs; `None` where there are none, or their parameters do not determine the terms.
pub fn fit(samples: &[Sample]) -> Option<Fit> {
    let least = |f: fn(&Sample) -> f64| samples.iter().map(f).min_by(f64::total_cmp);
    let finest = Sample { spacing: least(|s| s.spacing)?, law: least(|s| s.law)?, value: 0.0 };
    let spacings = distinct(samples.iter().map(|s| s.spacing));
    let laws = distinct(samples.iter().map(|s| s.law));
    let model = Model { samples, finest, graded: spacings.len() > 1, sounding: laws.len() > 1 };

    let mut warnings = Vec::new();
    let monotone = monotone(samples, &laws);
    if spacings.len() < 3 {
        warnings.push(format!("{} spacings: three are needed to observe an order", spacings.len()));
    } else if !monotone {
        warnings.push("not monotone in the spacing".to_string());
    }
    let order = (spacings.len() >= 3 && monotone).then(|| model.best_order());
    let sound_order = order.filter(|p| (ORDERS[0]..=ORDERS[1]).contains(p));
    if let (Some(p), None) = (order, sound_order) {
        warnings.push(format!("observed order {p:.2}, outside {} to {}", ORDERS[0], ORDERS[1]));
    }
    let order_used = sound_order.unwrap_or(USUAL_ORDER);
    let [q0, by_spacing, by_sound] = model.solve(order_used)?;

    let spare = samples.len() as f64 - 1.0 - f64::from(model.sounding) - if model.graded { 2.0 } else { 0.0 };
    let left = model.residual(order_used);
    let scatter = (spare > 0.0).then(|| (left / spare).sqrt() / q0.abs());
    let at_finest = samples.iter().find(|s| s.spacing == finest.spacing && s.law == finest.law);
    let missed = at_finest.map_or(0.0, |s| (s.value - q0 - by_spacing - by_sound).abs());
    let safety = if sound_order.is_some() { SAFETY[0] } else { SAFETY[1] };
    let found = safety * (by_spacing.abs() + by_sound.abs()) + missed;
    let unordered = spacings.len() >= 3 && sound_order.is_none();
    let band = if unordered { found.max(SAFETY[1] * range(samples, finest.law)) } else { found };
    let uncertainty = band / q0.abs() + scatter.unwrap_or(0.0);
    if uncertainty.is_nan() || uncertainty > WIDEST_BAND {
        warnings.push(format!("uncertainty of {:.1} %, above {:.0} %", 100.0 * uncertainty, 100.0 * WIDEST_BAND));
    }
    let share = by_sound.abs() / (by_spacing.abs() + by_sound.abs());
    Some(Fit {
        extrapolated: q0,
        order,
        order_used,
        discretisation_error: by_spacing / q0.abs(),
        sound_speed_error: model.sounding.then(|| by_sound / q0.abs()),
        sound_speed_share: (model.sounding && share.is_finite()).then_some(share),
        scatter,
        uncertainty,
        converged: warnings.is_empty(),
        warnings,
    })
}

impl Fit {
    /// "converged", or "not converged" and why.
    pub fn verdict(&self) -> String {
        match self.converged {
            true => "converged".to_string(),
            false => format!("not converged: {}", self.warnings.join("; ")),
        }
    }
}

/// The runs, and the terms that they determine.
struct Model<'a> {
    samples: &'a [Sample],
    finest: Sample,
    graded: bool,
    sounding: bool,
}

impl Model<'_> {
    /// [q₀, A Δxᵖ, B f] at the finest spacing and the highest sound speed, for the order p.
    fn solve(&self, order: f64) -> Option<[f64; 3]> {
        let mut columns = vec![vec![1.0; self.samples.len()]];
        if self.graded {
            columns.push(self.samples.iter().map(|s| (s.spacing / self.finest.spacing).powf(order)).collect());
        }
        if self.sounding {
            columns.push(self.samples.iter().map(|s| s.law / self.finest.law).collect());
        }
        let values: Vec<f64> = self.samples.iter().map(|s| s.value).collect();
        let mut terms = least_squares(&columns, &values)?.into_iter();
        let q0 = terms.next()?;
        let by_spacing = if self.graded { terms.next()? } else { 0.0 };
        Some([q0, by_spacing, terms.next().unwrap_or(0.0)])
    }

    /// Sum of squares that the fit of order p leaves.
    fn residual(&self, order: f64) -> f64 {
        let Some([q0, by_spacing, by_sound]) = self.solve(order) else { return f64::INFINITY };
        let squares = self.samples.iter().map(|s| {
            let spacing = (s.spacing / self.finest.spacing).powf(order);
            (s.value - q0 - by_spacing * spacing - by_sound * s.law / self.finest.law).powi(2)
        });
        squares.sum()
    }

    /// The order of the least residual, by a scan and golden sections.
    fn best_order(&self) -> f64 {
        const SCAN: usize = 80;
        let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
        let at = |k: usize| SEARCHED[0] * (SEARCHED[1] / SEARCHED[0]).powf(k as f64 / SCAN as f64);
        let best = (0..=SCAN).min_by(|a, b| self.residual(at(*a)).total_cmp(&self.residual(at(*b)))).unwrap_or(0);
        let (mut low, mut high) = (at(best.saturating_sub(1)), at((best + 1).min(SCAN)));
        while high - low > 1e-12 * high {
            let [left, right] = [high - golden * (high - low), low + golden * (high - low)];
            match self.residual(left) < self.residual(right) {
                true => high = right,
                false => low = left,
            }
            if left >= right {
                break;
            }
        }
        0.5 * (low + high)
    }
}

/// Range of the values at a sound speed: what stands for the error where no order is observed (Eça & Hoekstra 2014).
fn range(samples: &[Sample], law: f64) -> f64 {
    let values = samples.iter().filter(|s| s.law == law).map(|s| s.value);
    let [low, high] = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [l.min(v), h.max(v)]);
    high - low
}

/// True where, at every sound speed, the value goes the same way from each spacing to the next.
fn monotone(samples: &[Sample], laws: &[f64]) -> bool {
    let mut ways = Vec::new();
    for law in laws {
        let mut row: Vec<&Sample> = samples.iter().filter(|s| s.law == *law).collect();
        row.sort_by(|a, b| a.spacing.total_cmp(&b.spacing));
        ways.extend(row.windows(2).map(|w| (w[1].value - w[0].value).partial_cmp(&0.0)));
    }
    let up = ways.iter().all(|way| *way == Some(std::cmp::Ordering::Greater));
    up || ways.iter().all(|way| *way == Some(std::cmp::Ordering::Less))
}

fn distinct(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPACINGS: [f64; 3] = [0.02, 0.014142, 0.01];

    fn law(mach: f64) -> f64 {
        mach * mach * (1.0 / mach).ln()
    }

    fn grid(spacings: &[f64], machs: &[f64], q: impl Fn(f64, f64) -> f64) -> Vec<Sample> {
        let at = |spacing: f64, mach: f64| Sample { spacing, law: law(mach), value: q(spacing, mach) };
        machs.iter().flat_map(|m| spacings.iter().map(move |s| at(*s, *m))).collect()
    }

    #[test]
    fn a_known_order_and_value_come_back() {
        for order in [0.6, 1.0, 1.37, 2.0, 2.9] {
            let q = |dx: f64, m: f64| 14.02 * (1.0 + 0.01 * (dx / 0.01_f64).powf(order) - 1.5 * law(m));
            let f = fit(&grid(&SPACINGS, &[0.05, 0.1], q)).expect("a fit");
            assert!((f.order.expect("an order") - order).abs() < 1e-8, "{order}: {f:?}");
            assert!((f.extrapolated / 14.02 - 1.0).abs() < 1e-10, "{order}: {f:?}");
            assert!((f.discretisation_error - 0.01).abs() < 1e-9, "{f:?}");
            let sound = 1.5 * law(0.05);
            assert!((f.sound_speed_error.expect("two speeds") + sound).abs() < 1e-9, "{f:?}");
            assert!((f.sound_speed_share.expect("two speeds") - sound / (0.01 + sound)).abs() < 1e-7, "{f:?}");
            assert!((f.uncertainty - 1.25 * (0.01 + sound)).abs() < 1e-8, "{f:?}");
            assert!(f.converged && f.warnings.is_empty(), "{f:?}");
        }
    }

    #[test]
    fn one_sound_speed_leaves_its_share_unknown() {
        let f = fit(&grid(&SPACINGS, &[0.05], |dx, _| 3.0 - 40.0 * dx * dx)).expect("a fit");
        assert!((f.order.expect("an order") - 2.0).abs() < 1e-8 && (f.extrapolated - 3.0).abs() < 1e-11, "{f:?}");
        assert_eq!([f.sound_speed_error, f.sound_speed_share, f.scatter], [None; 3]);
        assert!(f.converged);
    }

    #[test]
    fn what_is_not_monotone_is_not_converged() {
        let bump = |dx: f64, m: f64| 14.0 - law(m) + if dx == SPACINGS[1] { 0.02 } else { 0.0 };
        let f = fit(&grid(&SPACINGS, &[0.05, 0.1], bump)).expect("a fit");
        assert!(!f.converged && f.order.is_none(), "{f:?}");
        // three times the range of 0.02 is more than what the line of order 1 leaves
        assert!((f.uncertainty * f.extrapolated - 3.0 * 0.02).abs() < 0.02, "{f:?}");
        assert!(f.warnings.iter().any(|d| d.contains("not monotone")), "{f:?}");
        // monotone at one sound speed only
        let half = |dx: f64, m: f64| 14.0 + dx * if m > 0.07 { 1.0 } else { -1.0 };
        assert!(!fit(&grid(&SPACINGS, &[0.05, 0.1], half)).expect("a fit").converged);
        // the spacing changes nothing
        assert!(!fit(&grid(&SPACINGS, &[0.05, 0.1], |_, _| 7.0)).expect("a fit").converged);
    }

    #[test]
    fn a_strange_order_a_wide_band_and_too_few_spacings_are_not_converged() {
        let warnings = |spacings: &[f64], q: fn(f64, f64) -> f64| {
            let f = fit(&grid(spacings, &[0.05, 0.1], q)).expect("a fit");
            assert!(!f.converged, "{f:?}");
            f.warnings.join("; ")
        };
        let slow = warnings(&SPACINGS, |dx, _| 1.0 + 0.01 * dx.powf(0.2));
        assert!(slow.contains("observed order 0.20"), "{slow}");
        let fast = warnings(&SPACINGS, |dx, _| 1.0 + 0.001 * (dx / 0.01_f64).powf(4.5));
        assert!(fast.contains("observed order 4.50"), "{fast}");
        let wide = warnings(&SPACINGS, |dx, _| 1.0 + 5.0 * dx);
        assert!(wide.contains("uncertainty of 6."), "{wide}");
        let few = warnings(&SPACINGS[1..], |dx, _| 1.0 + 0.1 * dx);
        assert!(few.contains("2 spacings: three are needed"), "{few}");
        assert!(fit(&[]).is_none());
    }
}
