//! Values of an axis of a sweep or of a map: a list, or a range.

use schemars::JsonSchema;
use serde::de::{Deserializer, Error};
use serde::{Deserialize, Serialize};
use serde_json::{Number, Value, json};

/// Most values of an axis, samples of a hypercube, and points of a sweep.
pub const MOST_POINTS: usize = 100_000;

/// Values of an axis; of a hypercube two ends, [100, 400] or { from = 100, to = 400 }.
#[derive(Deserialize, JsonSchema)]
#[serde(untagged, expecting = "expected a list of values, or a range { from = a, to = b, count = n }")]
#[schemars(extend("x-takes" = "a list of values, or a range { from = a, to = b, count = n }; a fixed value belongs to [set]"))]
pub enum Values {
    /// One by one.
    List(Vec<Value>),
    /// From one end to another.
    Range(Range),
}

/// Numbers from one end to another.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Range {
    /// First value.
    #[schemars(with = "f64")]
    from: Number,
    /// Last value; with a step, the bound of the last one.
    #[schemars(with = "f64")]
    to: Number,
    /// Number of values.
    #[schemars(range(min = 2, max = MOST_POINTS))]
    count: Option<usize>,
    /// Difference of two values, instead of their number.
    step: Option<f64>,
    /// Equal differences, or equal ratios.
    #[serde(default)]
    scale: Scale,
}

/// Scale of a range.
#[derive(Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum Scale {
    #[default]
    Linear,
    Log,
}

fn float(number: &Number) -> f64 {
    number.as_f64().unwrap_or_default()
}

impl Range {
    /// The number at a share of the way, to 12 digits: decimal fractions stay short.
    pub fn at(&self, share: f64) -> f64 {
        self.towards(float(&self.to), share)
    }

    fn towards(&self, to: f64, share: f64) -> f64 {
        let from = float(&self.from);
        let value = match self.scale {
            Scale::Log => from * (to / from).powf(share),
            Scale::Linear => from + (to - from) * share,
        };
        format!("{value:.11e}").parse().unwrap_or(value)
    }

    fn has_ratio(&self) -> Result<(), String> {
        match self.scale == Scale::Log && float(&self.from) * float(&self.to) <= 0.0 {
            true => Err("ends of the same sign and not 0 with scale = \"log\"".into()),
            false => Ok(()),
        }
    }

    fn values(&self) -> Result<Vec<Value>, String> {
        self.has_ratio()?;
        let [from, to] = [&self.from, &self.to].map(float);
        let (last, to) = match (self.count, self.step) {
            (Some(count @ 2..=MOST_POINTS), None) => (count - 1, to),
            (None, Some(step)) => {
                let steps = (to - from) / step;
                if self.scale == Scale::Log || !(0.0..MOST_POINTS as f64).contains(&steps) {
                    return Err(format!("a linear step from `from` to `to`, with at most {MOST_POINTS} values"));
                }
                let last = (steps + 1e-9).floor();
                (last as usize, from + last * step)
            }
            (None, None) => return Err(format!("`count` or `step` beside its ends, a count from 2 to {MOST_POINTS}")),
            (Some(_), Some(_)) => return Err("`count` or `step`, not both".into()),
            (Some(_), None) => return Err(format!("a count from 2 to {MOST_POINTS}")),
        };
        let whole = !self.from.is_f64() && !self.to.is_f64() && self.step.is_none_or(|step| step.fract() == 0.0);
        let value = |k: usize| {
            let value = self.towards(to, k as f64 / last.max(1) as f64);
            if whole && value.fract() == 0.0 { json!(value as i64) } else { json!(value) }
        };
        Ok((0..=last).map(value).collect())
    }
}

impl Values {
    /// All values; else what is expected.
    pub fn all(self) -> Result<Vec<Value>, String> {
        match self {
            Values::List(items) if items.is_empty() => Err("at least one value".into()),
            Values::List(items) => Ok(items),
            Values::Range(range) => range.values(),
        }
    }

    /// The two ends of a key of a hypercube; else what is expected.
    pub fn ends(self) -> Result<Range, String> {
        let range = match self {
            Values::List(items) => match &items[..] {
                [Value::Number(from), Value::Number(to)] => {
                    Some(Range { from: from.clone(), to: to.clone(), count: None, step: None, scale: Scale::Linear })
                }
                _ => None,
            },
            Values::Range(range) => Some(range),
        };
        let fits = |range: &Range| float(&range.from) != float(&range.to) && (range.count, range.step) == (None, None);
        let expected = || "two different ends, [a, b] or { from = a, to = b, scale = \"log\" }".to_string();
        let range = range.filter(fits).ok_or_else(expected)?;
        range.has_ratio().map(|()| range)
    }
}

/// Reads values that are numbers.
pub fn numbers<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<f64>, D::Error> {
    let values = match Values::deserialize(deserializer)? {
        Values::List(items) => items,
        Values::Range(range) => range.values().map_err(|expected| D::Error::custom(format!("expected {expected}")))?,
    };
    values.iter().map(|value| value.as_f64().ok_or_else(|| D::Error::custom("expected numbers"))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_of_a_map_is_a_list_or_a_range_of_numbers() {
        #[derive(Debug, Deserialize)]
        struct Axis {
            #[serde(deserialize_with = "numbers")]
            values: Vec<f64>,
        }
        let read = |text: &str| toml::from_str::<Axis>(text).map(|axis| axis.values).map_err(|e| e.to_string());
        assert_eq!(read("values = [1, 2.5]"), Ok(vec![1.0, 2.5]));
        assert_eq!(read("values = { from = 0.1, to = 10, count = 3, scale = \"log\" }"), Ok(vec![0.1, 1.0, 10.0]));
        for (text, part) in [
            ("values = 3", "expected a list of values, or a range"),
            ("values = [\"a\"]", "expected numbers"),
            ("values = { from = 1, to = 2 }", "expected `count` or `step`"),
            ("values = { from = 1, to = 2, count = 1 }", "a count from 2 to 100000"),
        ] {
            assert!(read(text).is_err_and(|said| said.contains(part)), "{text}");
        }
    }
}
