//! Units in values: `"4 mm"` for a key in metres is 0.004.

use serde_json::{Map, Value};

use super::check::joined;
use super::keyword::meaning;
use super::problem::Problem;

/// Most characters of a number before its unit.
const LONGEST_NUMBER: usize = 40;

/// Powers of m, kg, s, K, deg, mol and byte.
type Dimensions = [i32; 7];

/// A unit: `times/over` units of SI, or degrees, of its dimensions.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Unit {
    times: f64,
    over: f64,
    dimensions: Dimensions,
}

const fn base(k: usize) -> Dimensions {
    let mut dimensions = [0; 7];
    dimensions[k] = 1;
    dimensions
}

const PURE: Dimensions = [0; 7];
const LENGTH: Dimensions = base(0);
const MASS: Dimensions = base(1);
const TIME: Dimensions = base(2);
const TEMPERATURE: Dimensions = base(3);
const ANGLE: Dimensions = base(4);
const AMOUNT: Dimensions = base(5);
const MEMORY: Dimensions = base(6);
const SPEED: Dimensions = [1, 0, -1, 0, 0, 0, 0];
const FORCE: Dimensions = [1, 1, -2, 0, 0, 0, 0];
const PRESSURE: Dimensions = [-1, 1, -2, 0, 0, 0, 0];
const ENERGY: Dimensions = [2, 1, -2, 0, 0, 0, 0];
const FREQUENCY: Dimensions = [0, 0, -1, 0, 0, 0, 0];
const TURNS: Dimensions = [0, 0, -1, 0, 1, 0, 0];

/// Names of units, each worth `times/over` of SI: two whole numbers keep 5.7 mm at 0.0057 m. Foot, pound, knot and nautical mile by definition.
const UNITS: [(&str, f64, f64, Dimensions); 62] = [
    ("m", 1.0, 1.0, LENGTH),
    ("km", 1e3, 1.0, LENGTH),
    ("dm", 1.0, 10.0, LENGTH),
    ("cm", 1.0, 100.0, LENGTH),
    ("mm", 1.0, 1e3, LENGTH),
    ("um", 1.0, 1e6, LENGTH),
    ("µm", 1.0, 1e6, LENGTH),
    ("in", 254.0, 1e4, LENGTH),
    ("ft", 3048.0, 1e4, LENGTH),
    ("nmi", 1852.0, 1.0, LENGTH),
    ("kg", 1.0, 1.0, MASS),
    ("g", 1.0, 1e3, MASS),
    ("mg", 1.0, 1e6, MASS),
    ("t", 1e3, 1.0, MASS),
    ("lb", 45_359_237.0, 1e8, MASS),
    ("s", 1.0, 1.0, TIME),
    ("ms", 1.0, 1e3, TIME),
    ("us", 1.0, 1e6, TIME),
    ("µs", 1.0, 1e6, TIME),
    ("min", 60.0, 1.0, TIME),
    ("h", 3600.0, 1.0, TIME),
    ("K", 1.0, 1.0, TEMPERATURE),
    ("deg", 1.0, 1.0, ANGLE),
    ("°", 1.0, 1.0, ANGLE),
    ("rad", 180.0, std::f64::consts::PI, ANGLE),
    ("mrad", 0.18, std::f64::consts::PI, ANGLE),
    ("mol", 1.0, 1.0, AMOUNT),
    ("B", 1.0, 1.0, MEMORY),
    ("kB", 1e3, 1.0, MEMORY),
    ("MB", 1e6, 1.0, MEMORY),
    ("GB", 1e9, 1.0, MEMORY),
    ("kn", 1852.0, 3600.0, SPEED),
    ("kt", 1852.0, 3600.0, SPEED),
    ("knot", 1852.0, 3600.0, SPEED),
    ("knots", 1852.0, 3600.0, SPEED),
    ("mph", 1_609_344.0, 3_600_000.0, SPEED),
    ("N", 1.0, 1.0, FORCE),
    ("kN", 1e3, 1.0, FORCE),
    ("MN", 1e6, 1.0, FORCE),
    ("lbf", 4.448_221_615_260_5, 1.0, FORCE),
    ("Pa", 1.0, 1.0, PRESSURE),
    ("hPa", 100.0, 1.0, PRESSURE),
    ("kPa", 1e3, 1.0, PRESSURE),
    ("MPa", 1e6, 1.0, PRESSURE),
    ("GPa", 1e9, 1.0, PRESSURE),
    ("bar", 1e5, 1.0, PRESSURE),
    ("mbar", 100.0, 1.0, PRESSURE),
    ("psi", 6_894.757_293_168_361, 1.0, PRESSURE),
    ("ksi", 6_894_757.293_168_361, 1.0, PRESSURE),
    ("J", 1.0, 1.0, ENERGY),
    ("kJ", 1e3, 1.0, ENERGY),
    ("MJ", 1e6, 1.0, ENERGY),
    ("Hz", 1.0, 1.0, FREQUENCY),
    ("kHz", 1e3, 1.0, FREQUENCY),
    ("MHz", 1e6, 1.0, FREQUENCY),
    ("rpm", 6.0, 1.0, TURNS),
    ("cSt", 1.0, 1e6, [2, 0, -1, 0, 0, 0, 0]),
    ("ton", 1e3, 1.0, MASS),
    ("%", 1.0, 100.0, PURE),
    ("-", 1.0, 1.0, PURE),
    ("1", 1.0, 1.0, PURE),
    ("", 1.0, 1.0, PURE),
];

/// A product of named units: `kN/m`, `kg m²/m`, `N s/m^2`. A stroke divides by the one unit behind it. `Err` is the name that is
/// not known.
fn unit(text: &str) -> Result<Unit, String> {
    let mut product = Unit { times: 1.0, over: 1.0, dimensions: PURE };
    let (mut rest, mut divides) = (text.trim(), false);
    while !rest.is_empty() {
        let end = rest.find(['/', ' ', '*', '·']).unwrap_or(rest.len());
        let (name, power) = power_of(&rest[..end]);
        let found = UNITS.iter().find(|(known, ..)| *known == name);
        let (_, times, over, dimensions) = found.filter(|_| !name.is_empty() && power.abs() <= 9).ok_or(name)?;
        let power = if divides { -power } else { power };
        let [up, down] = if power < 0 { [over, times] } else { [times, over] };
        product.times *= up.powi(power.abs());
        product.over *= down.powi(power.abs());
        (0..dimensions.len()).for_each(|k| product.dimensions[k] += power * dimensions[k]);
        let behind = rest[end..].trim_start();
        divides = behind.starts_with('/');
        rest = behind.trim_start_matches(['/', '*', '·']).trim_start();
        if rest.is_empty() && divides {
            return Err("/".into());
        }
    }
    Ok(product)
}

/// A name and its power: `m²`, `m^2`, `m2`, `s-1`.
fn power_of(word: &str) -> (&str, i32) {
    for (mark, power) in [("²", 2), ("³", 3), ("⁴", 4)] {
        if let Some(name) = word.strip_suffix(mark) {
            return (name, power);
        }
    }
    let digits = word.trim_end_matches(|c: char| c.is_ascii_digit());
    let name = digits.strip_suffix(['-', '+']).filter(|name| !name.is_empty()).unwrap_or(digits);
    let bare = name.strip_suffix('^').unwrap_or(name);
    match word[name.len()..].parse() {
        Ok(power) if !bare.is_empty() => (bare, power),
        _ => (word, 1),
    }
}

/// A number and what stands behind it; `None` for what does not start as a number.
fn number(text: &str) -> Option<(f64, &str)> {
    let text = text.trim();
    let bare = text.trim_start_matches(['+', '-']);
    let starts = bare.strip_prefix('.').unwrap_or(bare).starts_with(|c: char| c.is_ascii_digit());
    let ends = (1..=text.len().min(LONGEST_NUMBER)).rev().filter(|end| text.is_char_boundary(*end));
    let parsed = |end: usize| text[..end].parse().ok().map(|value: f64| (value, text[end..].trim()));
    starts.then(|| ends.into_iter().find_map(parsed)).flatten()
}

/// True for text such as `900 kg/m`: a number with something behind it.
pub fn is_quantity(text: &str) -> bool {
    number(text).is_some_and(|(_, unit)| !unit.is_empty())
}

/// A number in SI, or degrees, of text such as `4 mm`, for a value in `wanted`; `Err` says what is wrong with it.
///
/// ```
/// use settings::convert;
///
/// assert_eq!(convert("2 t/m", "kg/m"), Ok(2000.0));
/// assert!(convert("2 t", "kg/m").is_err());
/// ```
pub fn convert(text: &str, wanted: &str) -> Result<f64, String> {
    let (value, name) = number(text).ok_or("no number")?;
    if name.is_empty() {
        return Err("no unit behind the number".into());
    }
    if let Some(digits) = name.strip_prefix(',').filter(|rest| rest.starts_with(|c: char| c.is_ascii_digit())) {
        return Err(format!("a decimal point instead of the comma: \"{value}.{digits}\""));
    }
    let unknown = |name: String| format!("the unit `{name}` is not known");
    let (given, wanted_unit) = (unit(name).map_err(unknown)?, unit(wanted).map_err(unknown)?);
    if given.dimensions != wanted_unit.dimensions {
        return Err(format!("`{name}` is a unit of another quantity"));
    }
    Ok(value * (given.times * wanted_unit.over) / (given.over * wanted_unit.times))
}

/// The change of strings with units to numbers.
pub(super) struct Conversion<'a> {
    /// The unit of the key at a path; several, with commas, of an array's items.
    pub unit_of: &'a dyn Fn(&str) -> Option<&'a str>,
    pub largest: f64,
}

impl Conversion<'_> {
    /// The value at a path, the `item`th of an array.
    pub fn value(&self, given: Value, path: &str, item: Option<usize>) -> Result<Value, Problem> {
        match given {
            Value::Object(table) => {
                let converted = table.into_iter().map(|(key, value)| {
                    let value = self.value(value, &joined(path, &key), None)?;
                    Ok((key, value))
                });
                converted.collect::<Result<Map<_, _>, Problem>>().map(Value::Object)
            }
            Value::Array(items) => {
                let items = items.into_iter().enumerate();
                let converted = items.map(|(i, value)| self.value(value, &format!("{path}[{i}]"), Some(i)));
                converted.collect::<Result<Vec<_>, Problem>>().map(Value::Array)
            }
            Value::String(text) if number(&text).is_some() => self.text(text, path, item),
            other => Ok(other),
        }
    }

    fn text(&self, text: String, path: &str, item: Option<usize>) -> Result<Value, Problem> {
        let units = (self.unit_of)(path).filter(|unit| !unit.is_empty());
        let Some(units) = units else { return Ok(Value::String(text)) };
        let each: Vec<&str> = units.split(", ").collect();
        let wanted = each.get(item.unwrap_or(0)).or(each.first()).copied().unwrap_or(units);
        let expected = |why: String| match wanted {
            "-" => format!("a number without a unit: {why}"),
            unit => format!("a number, or one with a unit such as \"1 {unit}\": {why}"),
        };
        let value = convert(&text, wanted).map_err(|why| Problem::new(path, format!("{text:?}"), expected(why)))?;
        if value.abs() > self.largest {
            let expected = format!("a finite number up to {:e}", self.largest);
            return Err(Problem::new(path, format!("{text:?}"), expected));
        }
        Ok(Value::from(value))
    }
}

/// Lets each number of a schema whose key has a unit be a string too.
pub(super) fn allow_strings(node: &mut Value, has_unit: bool) {
    let own = node.get("description").and_then(Value::as_str).map(|text| !meaning(text).1.is_empty());
    let has_unit = own.unwrap_or(has_unit);
    let Some(table) = node.as_object_mut() else { return };
    let kinds = match table.get("type").filter(|_| has_unit) {
        Some(Value::Array(kinds)) => kinds.clone(),
        Some(kind) => vec![kind.clone()],
        None => Vec::new(),
    };
    if kinds.iter().any(|kind| kind == "number") {
        table.insert("type".into(), kinds.into_iter().chain(["string".into()]).collect());
        table.insert("pattern".into(), r"^\s*[+-]?\.?[0-9]".into());
    }
    for list in ["oneOf", "anyOf", "allOf", "prefixItems"] {
        let parts = table.get_mut(list).and_then(Value::as_array_mut).into_iter().flatten();
        parts.for_each(|part| allow_strings(part, has_unit));
    }
    table.get_mut("items").into_iter().for_each(|items| allow_strings(items, has_unit));
    let properties = table.get_mut("properties").and_then(Value::as_object_mut);
    properties.into_iter().flatten().for_each(|(_, property)| allow_strings(property, false));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_become_those_of_the_key() {
        for (given, wanted, value) in [
            ("4 mm", "m", 0.004),
            ("5.7mm", "m", 0.0057),
            ("900 kg/m", "kg/m", 900.0),
            ("2 t/m", "kg/m", 2000.0),
            ("108 km/h", "m/s", 30.0),
            ("-30 m/s", "m/s", -30.0),
            ("3 deg", "deg", 3.0),
            ("12 MPa", "Pa", 12e6),
            ("50 kN/m2", "Pa", 50e3),
            ("1 N/mm²", "Pa", 1e6),
            ("2.7 g/cm^3", "kg/m³", 2700.0),
            ("1 mm^2 s^-1", "m^2/s", 1e-6),
            ("1 rpm", "deg/s", 6.0),
            ("3 kHz", "Hz", 3000.0),
            ("5 %", "-", 0.05),
            ("1e3 N s/m²", "N s/m²", 1000.0),
        ] {
            let found = convert(given, wanted).expect(given);
            assert!((found - value).abs() <= 1e-15 * value.abs(), "{given}: {found}");
        }
        assert!((convert("1 rad", "deg").expect("an angle") - 57.29577951308232).abs() < 1e-12);
    }

    #[test]
    fn another_quantity_and_an_unknown_unit_are_refused() {
        for (given, wanted, part) in [
            ("900 kg", "kg/m", "another quantity"),
            ("4 mm", "-", "another quantity"),
            ("4 furlong", "m", "`furlong` is not known"),
            ("4,5 mm", "m", "a decimal point instead of the comma: \"4.5 mm\""),
            ("4", "m", "no unit"),
            ("4 m/", "m", "`/` is not known"),
            ("m", "m", "no number"),
        ] {
            let why = convert(given, wanted).expect_err(given);
            assert!(why.contains(part), "{given}: {why}");
        }
    }
}
