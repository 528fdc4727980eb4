//! How far results stay from their limits.

use scene::vocabulary::{Status, Verdict};
use serde::Serialize;

use crate::evaluate::{Answer, EvaluateError};
use crate::numbers::Number;

/// The largest value that a result may have.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    /// Name of the result, as `peak_acceleration_g`.
    pub name: String,
    /// In the unit of the name.
    pub most: f64,
}

/// The least margin.
#[derive(Clone, Debug, Serialize)]
pub struct Margin {
    /// What may still be added before the limit over the reserve is met, over the result with its band [-]; below 0 it is not allowed.
    #[serde(rename = "margin")]
    pub share: f64,
    /// The result that has it.
    pub decided_by: String,
    /// Its value, in the unit of its name, and half its band.
    pub result: f64,
    /// Half its band, where one is known.
    pub band: Option<f64>,
    /// What may be said of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub verdict: Option<Verdict>,
}

impl Margin {
    /// Of an answer: limits over `reserve`, against results with their bands.
    ///
    /// # Errors
    /// A run that failed; a limit of no result; no limit at all.
    pub fn of(answer: &Answer, reserve: f64, limits: &[Limit]) -> Result<Margin, EvaluateError> {
        if answer.status == Status::Failed {
            let why = answer.message.clone().unwrap_or_default();
            return Err(EvaluateError::Key(format!("a run failed: {why}")));
        }
        let of = |name: &str, number: &Number, share: f64| Margin {
            share,
            decided_by: name.into(),
            result: number.value,
            band: number.band,
            verdict: number.verdict,
        };
        let band = |number: &Number| number.band.unwrap_or(0.0);
        let mut margins: Vec<Margin> = Vec::new();
        for limit in limits {
            let Some(number) = answer.numbers.get(&limit.name) else {
                let known = answer.numbers.keys().cloned().collect::<Vec<_>>().join(", ");
                return Err(EvaluateError::Key(format!("no result `{}`: expected one of: {known}", limit.name)));
            };
            margins.push(of(&limit.name, number, limit.most / (reserve * (number.value.abs() + band(number))) - 1.0));
        }
        for (name, number) in &answer.numbers {
            match name.ends_with(".reserve_factor") {
                true => margins.push(of(name, number, (number.value - band(number)) / reserve - 1.0)),
                // a panel that yielded has no reserve
                false if number.allowed == Some(false) => margins.push(of(name, number, -1.0)),
                false => {}
            }
        }
        // a panel without an allowable stress that yields, or one whose reserve is known besides
        let reserved = |margin: &Margin| margins.iter().any(|other| other.decided_by == reserve_of(&margin.decided_by));
        let kept: Vec<Margin> = margins.iter().filter(|m| m.share > -1.0 || !reserved(m)).cloned().collect();
        kept.into_iter().min_by(|a, b| a.share.total_cmp(&b.share)).ok_or_else(|| {
            EvaluateError::Key(
                "no result has a limit: expected body.panels.allowable_stress, or a limit of a result".into(),
            )
        })
    }
}

/// The reserve factor of the panel to which a result belongs.
fn reserve_of(name: &str) -> String {
    format!("{}.reserve_factor", name.split('.').next().unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    fn answer(numbers: &[(&str, Number)]) -> Answer {
        let numbers: BTreeMap<_, _> = numbers.iter().map(|(name, number)| (name.to_string(), number.clone())).collect();
        Answer {
            model: "mlm",
            status: Status::Completed,
            message: None,
            numbers,
            doubts: Default::default(),
            columns: Vec::new(),
            rows: Vec::new(),
            seconds: 0.0,
        }
    }

    #[test]
    fn bands_are_counted_and_the_least_margin_decides() {
        let with =
            |value: f64, band: f64, allowed: Option<bool>| Number { band: Some(band), allowed, ..Number::plain(value) };
        let numbers = [
            ("belly.peak_stress_Pa", with(2e8, 1e7, Some(false))),
            ("belly.reserve_factor", with(1.5, 0.2, Some(true))),
            ("peak_acceleration_g", with(8.0, 2.0, None)),
        ];
        let limit = |name: &str, most: f64| Limit { name: name.into(), most };
        let least = Margin::of(&answer(&numbers), 1.0, &[]).expect("a margin");
        assert_eq!((least.decided_by.as_str(), (least.share - 0.3).abs() < 1e-12), ("belly.reserve_factor", true));
        let least = Margin::of(&answer(&numbers), 1.0, &[limit("peak_acceleration_g", 11.0)]).expect("a margin");
        assert_eq!((least.decided_by.as_str(), (least.share - 0.1).abs() < 1e-12), ("peak_acceleration_g", true));
        let least = Margin::of(&answer(&numbers), 1.3, &[]).expect("a margin");
        assert!(least.share.abs() < 1e-12);
        assert!(Margin::of(&answer(&[]), 1.0, &[]).is_err());
        assert!(Margin::of(&answer(&numbers), 1.0, &[limit("peak_force", 1.0)]).is_err());
        let yielded = Margin::of(&answer(&numbers[..1]), 1.0, &[]).expect("a margin");
        assert_eq!(yielded.share, -1.0);
    }
}
