//! Numbers of a `summary.json`: a value, its band, and what may be said of it.

use scene::vocabulary::{Status, Verdict};
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// A number of a summary.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Number {
    /// The value, in the unit of its name.
    pub value: f64,
    /// Half width of its band, where one is known.
    pub band: Option<f64>,
    /// What may be said of it, where it is judged.
    pub verdict: Option<Verdict>,
    /// When [s], where it has a time.
    pub time_s: Option<f64>,
    /// Whether it is within its limits, where it has some.
    pub allowed: Option<bool>,
}

impl Number {
    /// A number that is not judged.
    pub fn plain(value: f64) -> Number {
        Number { value, band: None, verdict: None, time_s: None, allowed: None }
    }

    /// What a reader must know: that it is beyond its limits, and what may be said of it.
    pub fn said(&self) -> impl Iterator<Item = Said> {
        let beyond = (self.allowed == Some(false)).then_some(Said::Beyond);
        beyond.into_iter().chain(self.verdict.map(Said::Of))
    }
}

/// What a reader must know of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Said {
    /// It is beyond its limits.
    Beyond,
    /// What may be said of it.
    Of(Verdict),
}

impl Said {
    /// All that may be said.
    pub fn all() -> impl Iterator<Item = Said> {
        Verdict::all().map(Said::Of).chain([Said::Beyond])
    }

    /// On a page.
    pub fn words(self) -> &'static str {
        match self {
            Said::Beyond => Status::BeyondAllowable.words(),
            Said::Of(verdict) => verdict.words(),
        }
    }
}

/// A number, or an object with a value.
pub fn number(value: &Value) -> Option<Number> {
    let of = |key: &str| value.get(key).and_then(Value::as_f64);
    match value.as_f64() {
        Some(value) => Some(Number::plain(value)),
        None => {
            let band = of("band");
            let verdict = value.get("verdict").and_then(Value::as_str);
            // folders of older versions: no value is resolved without a band, and being allowed was part of the verdict
            let of_older = verdict == Some(Status::BeyondAllowable.name());
            let verdict = verdict.map(|own| match Verdict::of(own) {
                _ if of_older => Verdict::NoBand,
                Verdict::Resolved if band.is_none() => Verdict::NoBand,
                own => own,
            });
            let allowed = value.get("allowed").and_then(Value::as_bool).or(of_older.then_some(false));
            Some(Number { value: of("value")?, band, verdict, time_s: of("time_s"), allowed })
        }
    }
}

/// Parts of the audit that are tabulated.
const AUDIT: [&str; 4] = ["momentum", "energy", "volume", "penetrated"];
/// Numbers of a landing that have no time.
const OF_LANDING: [&str; 2] = ["line_load_at_m", "run_length_m"];

/// True for the summary of a landing.
pub fn is_landing(summary: &Value) -> bool {
    summary.get("line_load_n_per_m").is_some()
}

/// Results of a run and its audit, or the extremes of a landing.
pub fn usual(summary: &Value) -> Vec<(String, Number)> {
    let named = |table: &Value, prefix: &str| -> Vec<(String, Number)> {
        let entries = table.as_object().into_iter().flatten();
        let with_value = entries.filter(|(_, value)| value.get("value").is_some());
        with_value.filter_map(|(key, value)| Some((format!("{prefix}{key}"), number(value)?))).collect()
    };
    let plain = |table: &Value, prefix: &str, keys: &[&str]| -> Vec<(String, Number)> {
        keys.iter().filter_map(|key| Some((format!("{prefix}{key}"), number(table.get(key)?)?))).collect()
    };
    let Some(results) = summary.get("results") else {
        let items = |list: &str| summary.get(list).and_then(Value::as_array).cloned().unwrap_or_default();
        let named_items = ["accelerometers", "parts", "windows"].map(items).concat();
        let of_named = named_items.iter().flat_map(|item| {
            let name = item.get("name").and_then(Value::as_str).unwrap_or_default();
            named(item, &format!("{name}."))
        });
        let of_named: Vec<(String, Number)> = of_named.collect();
        let stations = items("stations");
        let stations = stations.iter();
        let loads = stations.flat_map(|station| {
            let place = station.get("x_m").map_or(String::new(), Value::to_string);
            named(station, &format!("station {place} m."))
        });
        // no landing's load has a band
        let without_band =
            |(name, number): (String, Number)| (name, Number { verdict: Some(Verdict::NoBand), ..number });
        let loads: Vec<(String, Number)> = of_named.into_iter().chain(loads).map(without_band).collect();
        let peaks: Vec<(String, Number)> = named(summary, "").into_iter().map(without_band).collect();
        return [peaks, plain(summary, "", &OF_LANDING), loads].concat();
    };
    let mut numbers = named(results, "");
    for (name, panel) in results.get("panels").and_then(Value::as_object).into_iter().flatten() {
        numbers.extend(named(panel, &format!("{name}.")));
    }
    let is_particles = summary.pointer("/particles/fluid").and_then(Value::as_u64).unwrap_or(0) > 0;
    if let Some(audit) = summary.get("audit").filter(|_| is_particles) {
        numbers.extend(plain(audit, "audit.", &AUDIT));
    }
    numbers
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_of_runs_and_of_landings_have_names_with_units() {
        let run = serde_json::json!({
            "results": {
                "peak_force_N_per_m": {"value": 3.0, "band": 0.1, "time_s": 0.2, "verdict": "resolved"},
                "panels": {"plate": {"peak_stress_Pa": {"value": 2e8, "band": null, "verdict": "acoustic"}}}
            },
            "particles": {"fluid": 10},
            "audit": {"momentum": 1e-15, "penetrated": 0}
        });
        let names = |summary: &Value| usual(summary).into_iter().map(|(name, _)| name).collect::<Vec<_>>();
        let of_run = ["peak_force_N_per_m", "plate.peak_stress_Pa", "audit.momentum", "audit.penetrated"];
        assert_eq!(names(&run), of_run);
        assert_eq!(usual(&run)[0].1.band, Some(0.1));
        let station = serde_json::json!({"x_m": 3.5, "line_load_n_per_m": {"value": 2.0, "time_s": 0.2}});
        let cockpit = serde_json::json!({"name": "cockpit", "normal_g": {"value": 1.5, "time_s": 0.2}});
        let landing = serde_json::json!({
            "az_g": {"value": 1.0, "time_s": 0.1}, "line_load_at_m": 20.0, "strips": 20, "stations": [station],
            "accelerometers": [cockpit]
        });
        assert_eq!(names(&landing), ["az_g", "line_load_at_m", "cockpit.normal_g", "station 3.5 m.line_load_n_per_m"]);
    }
}
