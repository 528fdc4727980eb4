//! Quantities and axes of a sweep in the words and units of the page.

use decide::Number;
use report::run_page::quantity::{Unit, digits};
use report::run_page::two_digits;
use report::{COARSE, Tone};
use scene::vocabulary::{ResultId, Status, Verdict, column_title, is_withheld};
use serde_json::Value;
use settings::significant;

use super::collect::{Collected, PointResult};
use super::file::SCENE_AXIS;
use super::plan::Axis;
use super::table::plain;

/// A quantity in words, in a unit that suits its largest value.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Quantity {
    /// Its title, with its panel or station.
    pub title: String,
    /// Its unit; empty for pure numbers and for what has no known one.
    pub unit: String,
    /// Factor from the table's number to the unit.
    pub scale: f64,
}

/// Numbers of a landing.
const OF_LANDING: [(&str, &str, &str); 15] = [
    ("az_g", "Upward acceleration", "g"),
    ("deceleration_g", "Deceleration", "g"),
    ("load_factor", "Load factor", "-"),
    ("fz_n", "Force of the water, upwards", "N"),
    ("moment_nm", "Moment of the water, nose up", "N m"),
    ("line_load_n_per_m", "Load of a metre of keel", "N/m"),
    ("line_load_at_m", "Place of the largest load of a metre of keel, from the nose", "m"),
    ("run_length_m", "Way on the water", "m"),
    ("normal_g", "Acceleration upwards from the body axis", "g"),
    ("longitudinal_g", "Deceleration along the body axis", "g"),
    ("force_n", "Force of the water on a part", "N"),
    ("pressure_pa", "Mean pressure on the breadth", "Pa"),
    ("mean_pressure_pa", "Mean pressure over a window", "Pa"),
    ("shear_n", "Shear force in the fuselage", "N"),
    ("bending_nm", "Bending moment in the fuselage, ends upwards", "N m"),
];

/// Parts of the audit.
const OF_AUDIT: [(&str, &str); 4] = [
    ("audit.momentum", "Audit: momentum"),
    ("audit.energy", "Audit: energy"),
    ("audit.volume", "Audit: volume"),
    ("audit.penetrated", "Audit: particles that penetrated a wall"),
];

/// Title, SI unit and factor to it.
fn known(name: &str) -> Option<(String, &'static str, f64)> {
    if let Some(id) = ResultId::of(name) {
        return Some((id.title(), id.name.si(), 1.0));
    }
    let of_landing = |name: &str| OF_LANDING.into_iter().find(|(key, ..)| *key == name);
    if let Some((_, title, si)) = of_landing(name) {
        return Some((title.into(), si, 1.0));
    }
    if let Some((place, quantity)) = name.rsplit_once('.')
        && let Some((_, title, si)) = of_landing(quantity)
    {
        return Some((format!("{title}, {place}"), si, 1.0));
    }
    if let Some((_, title)) = OF_AUDIT.into_iter().find(|(key, _)| *key == name) {
        return Some((title.into(), "-", 1.0));
    }
    // a path of the summary, such as peaks/wedge.vy_m_per_s
    let (table, name) = name.rsplit_once('/')?;
    let known = column_title(name);
    (known.title != name).then(|| (format!("{} ({table})", known.title), known.si, known.scale))
}

impl Quantity {
    /// The quantity of a name of the table.
    pub fn of(collected: &Collected, name: &str) -> Quantity {
        let numbers = collected.completed().filter_map(|point| point.numbers.get(name));
        let largest = numbers.map(|number| number.value.abs()).filter(|v| v.is_finite()).fold(0.0, f64::max);
        let Some((title, si, factor)) = known(name) else {
            return Quantity { title: name.into(), unit: String::new(), scale: 1.0 };
        };
        let unit = Unit::of(si, factor * largest);
        let shown = if unit.name == "-" { String::new() } else { unit.name };
        Quantity { title, unit: shown, scale: factor * unit.scale }
    }

    /// Title and unit.
    pub fn label(&self) -> String {
        with_unit(&self.title, &self.unit)
    }

    /// A value.
    pub fn value(&self, value: f64) -> String {
        digits(self.scale * value)
    }

    /// A value with its band.
    pub fn banded(&self, number: &Number) -> String {
        if is_withheld(number.value, number.band) {
            return "withheld".into();
        }
        let band = number.band.map_or(String::new(), |band| format!("\u{a0}±\u{a0}{}", two_digits(self.scale * band)));
        format!("{}{band}", self.value(number.value))
    }

    /// A value with its band and its unit.
    pub fn whole(&self, number: &Number) -> String {
        let space = if self.unit.is_empty() { "" } else { "\u{a0}" };
        format!("{}{space}{}", self.banded(number), self.unit)
    }
}

/// What may be said of a number, in words: one with a band above a share of it is coarse.
pub(super) fn verdict(number: &Number) -> Option<(Tone, String)> {
    let verdict = number.verdict?;
    let share = number.band.map(|band| (band / number.value).abs()).filter(|share| share.is_finite());
    let percent = share.map_or(String::new(), |share| format!(", ±\u{a0}{:.0}\u{a0}%", 100.0 * share));
    let (tone, words) = match verdict {
        _ if number.allowed == Some(false) => (Tone::Failed, Status::BeyondAllowable.words()),
        Verdict::Resolved if share.is_some_and(|share| share > COARSE) => (Tone::Doubtful, "coarse"),
        Verdict::Resolved => (Tone::Good, verdict.words()),
        _ => (Tone::Doubtful, verdict.words()),
    };
    Some((tone, words.to_string() + &percent))
}

fn with_unit(title: &str, unit: &str) -> String {
    if unit.is_empty() { title.into() } else { format!("{title} [{unit}]") }
}

/// Endings of keys that say a unit.
const UNITS: [&str; 3] = ["_deg_per_s", "_deg", "_hz"];

/// Title of an axis; its key where two axes would have the same one.
fn title(collected: &Collected, axis: &Axis) -> String {
    let words = in_words(&axis.key);
    let others = collected.axes.iter().filter(|other| other.key != axis.key);
    let is_unique = others.map(|other| in_words(&other.key)).all(|other| other != words);
    if is_unique { words } else { axis.key.clone() }
}

/// A key in words: its last part, with the panel that it belongs to.
fn in_words(key: &str) -> String {
    if key == SCENE_AXIS {
        return "Scene".into();
    }
    let (path, index) = match key.strip_suffix(']').and_then(|key| key.rsplit_once('[')) {
        Some((path, index)) => (path, index),
        None => (key, ""),
    };
    let (table, name) = path.rsplit_once('.').unwrap_or(("", path));
    let name = UNITS.iter().find_map(|unit| name.strip_suffix(unit)).unwrap_or(name).replace('_', " ");
    let name = match (name.as_str(), index) {
        ("velocity", "0") => "Horizontal velocity".to_string(),
        ("velocity", "1") => "Vertical velocity".to_string(),
        (_, "") => name,
        (_, "0") => format!("{name}, first"),
        (_, "1") => format!("{name}, second"),
        _ => format!("{name}, {index}"),
    };
    let first = name.chars().next().map(|c| c.to_uppercase().collect::<String>()).unwrap_or_default();
    let rest: String = name.chars().skip(1).collect();
    let of = table.rsplit('.').next().filter(|part| part.ends_with(']'));
    of.map_or(format!("{first}{rest}"), |part| format!("{first}{rest}, {part}"))
}

fn unit_of(axis: &Axis) -> &str {
    match axis.unit.as_str() {
        "-" => "",
        "deg" => "°",
        unit => unit,
    }
}

/// Title and unit of an axis.
pub(super) fn axis_label(collected: &Collected, axis: &Axis) -> String {
    with_unit(&title(collected, axis), unit_of(axis))
}

/// A value of an axis without its unit.
pub(super) fn axis_number(value: &Value) -> String {
    value.as_f64().map_or_else(|| plain(value), |number| significant(number).replace('-', "\u{2212}"))
}

/// A value of an axis with its title and unit, such as "Mass 150 kg/m".
pub(super) fn axis_value(collected: &Collected, axis: usize, value: &Value) -> String {
    let axis = &collected.axes[axis];
    let unit = match unit_of(axis) {
        unit if unit.is_empty() || value.as_f64().is_none() => String::new(),
        "°" => "°".into(),
        unit => format!("\u{a0}{unit}"),
    };
    format!("{} {}{unit}", title(collected, axis), axis_number(value))
}

/// A title within a sentence: a word that is no abbreviation starts small.
pub(super) fn inside(title: &str) -> String {
    let mut letters = title.chars();
    match (letters.next(), letters.clone().next()) {
        (Some(first), Some(second)) if second.is_lowercase() => first.to_lowercase().chain(letters).collect(),
        _ => title.into(),
    }
}

/// The values of a point in words.
pub(super) fn place_of(collected: &Collected, point: &PointResult) -> String {
    let words = point.values.iter().enumerate().map(|(k, value)| inside(&axis_value(collected, k, value)));
    words.collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_and_quantities_are_words_with_units() {
        let words = ["body.deadrise_deg", "body.velocity[1]", "body.mass", "body.panels[0].thickness", "model"];
        let expected = ["Deadrise", "Vertical velocity", "Mass", "Thickness, panels[0]", "Model"];
        assert_eq!(words.map(in_words), expected);
        assert_eq!(["Peak force", "CFC"].map(inside), ["peak force", "CFC"]);
        let unit = |name: &str| known(name).map(|(title, si, _)| format!("{title} [{si}]"));
        assert_eq!(unit("peak_force_N_per_m").as_deref(), Some("Peak force [N/m]"));
        assert_eq!(unit("plate.peak_stress_Pa").as_deref(), Some("Peak stress in plate [Pa]"));
        assert_eq!(
            unit("station 3.5 m.line_load_n_per_m").as_deref(),
            Some("Load of a metre of keel, station 3.5 m [N/m]")
        );
        assert_eq!(unit("peaks/wedge.vy_m_per_s").as_deref(), Some("Vertical velocity of the wedge (peaks) [m/s]"));
        assert_eq!(unit("steps"), None);
    }

    #[test]
    fn a_value_has_two_digits_of_its_band() {
        let force = Quantity { title: "Peak force".into(), unit: "kN/m".into(), scale: 1e-3 };
        let number = Number { band: Some(384.5), ..Number::plain(15330.8) };
        assert_eq!(force.whole(&number), "15.3\u{a0}±\u{a0}0.38\u{a0}kN/m");
        assert_eq!(force.label(), "Peak force [kN/m]");
        let with = |band: f64| Number { band: Some(band), verdict: Some(Verdict::Resolved), ..number.clone() };
        assert_eq!(verdict(&with(384.5)), Some((Tone::Good, "resolved, ±\u{a0}3\u{a0}%".into())));
        assert_eq!(verdict(&with(1e4)), Some((Tone::Doubtful, "coarse, ±\u{a0}65\u{a0}%".into())));
    }
}
