//! Every key of a [`FluidElementSpec`], declared once: for the parser, for help, for the reference page.

use std::collections::BTreeMap;

use serde::de::IntoDeserializer;
use serde::de::value::Error as Unknown;
use serde::{Deserialize, Serialize};

use super::error::HostError;
use super::spec::FluidElementSpec;

/// A value as any format may hold it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Value {
    /// true or false.
    Flag(bool),
    /// A number.
    Number(f64),
    /// Two numbers.
    Pair([f64; 2]),
    /// A word.
    Word(String),
}

impl std::fmt::Display for Value {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Value::Flag(flag) => write!(f, "{flag}"),
            Value::Number(number) => write!(f, "{number:?}"),
            Value::Pair(pair) => write!(f, "{pair:?}"),
            Value::Word(word) => write!(f, "{word}"),
        }
    }
}

/// What a key takes.
#[derive(Clone, Copy, Debug)]
pub enum Takes {
    /// A finite number above the first and, where there is one, below the second.
    Between(f64, f64),
    /// A finite number of at least this and at most that.
    From(f64, f64),
    /// Two finite numbers.
    Pair,
    /// true or false.
    Flag,
    /// One of these words.
    Word(&'static [&'static str]),
}

impl Takes {
    /// In words, for messages and the page.
    pub fn expected(self) -> String {
        let bound = |low: f64, high: f64, above: &str, below: &str| match (low.is_finite(), high.is_finite()) {
            (true, true) => format!("a number {above} {low} and {below} {high}"),
            (true, false) => format!("a number {above} {low}"),
            _ => "a finite number".into(),
        };
        match self {
            Takes::Between(low, high) => bound(low, high, "above", "below"),
            Takes::From(low, high) => bound(low, high, "of at least", "at most"),
            Takes::Pair => "two finite numbers".into(),
            Takes::Flag => "true or false".into(),
            Takes::Word(words) => words.join(" | "),
        }
    }

    fn takes(self, value: &Value) -> bool {
        match (self, value) {
            (Takes::Between(low, high), Value::Number(x)) => x.is_finite() && *x > low && *x < high,
            (Takes::From(low, high), Value::Number(x)) => x.is_finite() && *x >= low && *x <= high,
            (Takes::Pair, Value::Pair(pair)) => pair.iter().all(|x| x.is_finite()),
            (Takes::Flag, Value::Flag(_)) => true,
            (Takes::Word(words), Value::Word(word)) => words.contains(&word.as_str()),
            _ => false,
        }
    }
}

/// A key.
pub struct Keyword {
    /// Its name, that of the field.
    pub name: &'static str,
    /// Unit of its value, `-` for a pure number, empty for anything else.
    pub unit: &'static str,
    /// What happens where it is absent; empty: the default of [`FluidElementSpec::new`].
    pub absent: &'static str,
    /// What it takes.
    pub takes: Takes,
    /// What it means.
    pub doc: &'static str,
    pub(super) get: fn(&FluidElementSpec) -> Option<Value>,
    set: fn(&mut FluidElementSpec, &Value),
}

impl Keyword {
    /// Its value where nothing is said.
    pub fn default(&self) -> String {
        match (self.get)(&FluidElementSpec::new(f64::NAN, f64::NAN, f64::NAN)) {
            Some(value) if self.absent.is_empty() => value.to_string(),
            _ => self.absent.into(),
        }
    }

    /// The key in one line.
    pub fn help(&self) -> String {
        let unit = if self.unit.is_empty() { String::new() } else { format!(" [{}]", self.unit) };
        format!("{}{unit}: {}; {} (default: {})", self.name, self.doc, self.takes.expected(), self.default())
    }

    /// Refuse a value that is not for this key.
    pub(super) fn check(&self, value: &Value) -> Result<(), HostError> {
        if self.takes.takes(value) {
            return Ok(());
        }
        Err(HostError::Key { key: self.name.into(), given: value.to_string(), expected: self.takes.expected() })
    }
}

/// All keys, in the order in which an element is usually described.
pub fn keywords() -> &'static [Keyword] {
    KEYWORDS
}

/// All keys as a page of Markdown.
pub fn reference_page() -> String {
    let mut page = String::from(
        "# Keys of a fluid element\n\n| key | unit | takes | default | meaning |\n|---|---|---|---|---|\n",
    );
    for key in KEYWORDS {
        let takes = key.takes.expected().replace('|', "\\|");
        page += &format!("| `{}` | {} | {takes} | {} | {} |\n", key.name, key.unit, key.default(), key.doc);
    }
    page
}

/// A specification from keys and values.
pub(super) fn parse(given: &BTreeMap<String, Value>) -> Result<FluidElementSpec, HostError> {
    let mut spec = FluidElementSpec::new(f64::NAN, f64::NAN, f64::NAN);
    for (name, value) in given {
        let Some(key) = KEYWORDS.iter().find(|key| key.name == name) else {
            let names: Vec<&str> = KEYWORDS.iter().map(|key| key.name).collect();
            let expected = format!("one of {}", names.join(", "));
            return Err(HostError::Key { key: name.clone(), given: value.to_string(), expected });
        };
        key.check(value)?;
        (key.set)(&mut spec, value);
    }
    spec.check()?;
    Ok(spec)
}

fn number(value: &Value) -> f64 {
    if let Value::Number(number) = value { *number } else { f64::NAN }
}

fn flag(value: &Value) -> bool {
    *value == Value::Flag(true)
}

/// The variant that a word names; the table has refused all other words.
fn variant<'de, T: Deserialize<'de> + Default>(value: &'de Value) -> T {
    let Value::Word(word) = value else { return T::default() };
    T::deserialize(IntoDeserializer::<Unknown>::into_deserializer(word.as_str())).unwrap_or_default()
}

/// The word that names a variant.
fn word(variant: impl std::fmt::Debug) -> Option<Value> {
    let mut word = String::new();
    for c in format!("{variant:?}").chars() {
        if c.is_uppercase() && !word.is_empty() {
            word.push('_');
        }
        word.extend(c.to_lowercase());
    }
    Some(Value::Word(word))
}

const ANY: f64 = f64::INFINITY;
const POSITIVE: Takes = Takes::Between(0.0, ANY);
const KERNELS: Takes = Takes::Word(&["wendland_c2", "wendland_c4", "cubic_spline", "quadratic", "gaussian"]);

#[rustfmt::skip]
static KEYWORDS: &[Keyword] = &[
    Keyword { name: "spacing", unit: "m", absent: "required", takes: POSITIVE,
        doc: "finest particle spacing dx",
        get: |s| Some(Value::Number(s.spacing)), set: |s, v| s.spacing = number(v) },
    Keyword { name: "reach", unit: "m", absent: "required", takes: POSITIVE,
        doc: "half width of the basin, from its middle to either side wall",
        get: |s| Some(Value::Number(s.reach)), set: |s, v| s.reach = number(v) },
    Keyword { name: "depth", unit: "m", absent: "required", takes: POSITIVE,
        doc: "depth of the water at rest",
        get: |s| Some(Value::Number(s.depth)), set: |s, v| s.depth = number(v) },
    Keyword { name: "still_water", unit: "m", absent: "", takes: Takes::From(-ANY, ANY),
        doc: "height of the still-water line in the host's frame",
        get: |s| Some(Value::Number(s.still_water)), set: |s, v| s.still_water = number(v) },
    Keyword { name: "middle", unit: "m", absent: "middle of the wet surface", takes: Takes::From(-ANY, ANY),
        doc: "middle of the basin",
        get: |s| s.middle.map(Value::Number), set: |s, v| s.middle = Some(number(v)) },
    Keyword { name: "rim", unit: "m", absent: "0.25 depth", takes: Takes::From(0.0, ANY),
        doc: "height of the side walls above still water",
        get: |s| s.rim.map(Value::Number), set: |s, v| s.rim = Some(number(v)) },
    Keyword { name: "growth", unit: "-", absent: "", takes: Takes::From(1.0, 1.5),
        doc: "ratio of successive rows outside the fine zone; 1 is uniform",
        get: |s| Some(Value::Number(s.growth)), set: |s, v| s.growth = number(v) },
    Keyword { name: "fine_half_width", unit: "m", absent: "1.6 times half the wet surface's breadth, 10 spacings at least", takes: POSITIVE,
        doc: "half width of the fine zone, about the middle of the wet surface",
        get: |s| s.fine_half_width.map(Value::Number), set: |s, v| s.fine_half_width = Some(number(v)) },
    Keyword { name: "fine_depth", unit: "m", absent: "half the wet surface's breadth, 4 spacings at least", takes: POSITIVE,
        doc: "depth of the fine zone below still water",
        get: |s| s.fine_depth.map(Value::Number), set: |s, v| s.fine_depth = Some(number(v)) },
    Keyword { name: "gravity", unit: "m/s^2", absent: "", takes: Takes::Pair,
        doc: "acceleration of gravity on the water [x, y]; the host's own weight is the host's",
        get: |s| Some(Value::Pair(s.gravity)), set: |s, v| if let Value::Pair(g) = v { s.gravity = *g } },
    Keyword { name: "density", unit: "kg/m^3", absent: "", takes: POSITIVE,
        doc: "density of the undisturbed water",
        get: |s| Some(Value::Number(s.density)), set: |s, v| s.density = number(v) },
    Keyword { name: "fastest_speed", unit: "m/s", absent: "required without sound_speed", takes: POSITIVE,
        doc: "fastest speed that the flow is expected to have, such as the spray root's (pi/2) V/tan(deadrise)",
        get: |s| s.fastest_speed.map(Value::Number), set: |s, v| s.fastest_speed = Some(number(v)) },
    Keyword { name: "sound_speed", unit: "m/s", absent: "10 fastest_speed", takes: POSITIVE,
        doc: "numerical speed of sound (THEORY E3, E19)",
        get: |s| s.sound_speed.map(Value::Number), set: |s, v| s.sound_speed = Some(number(v)) },
    Keyword { name: "eos_exponent", unit: "-", absent: "", takes: Takes::From(1.0, ANY),
        doc: "exponent of Tait's equation of state; 1 is linear",
        get: |s| Some(Value::Number(s.eos_exponent)), set: |s, v| s.eos_exponent = number(v) },
    Keyword { name: "kernel", unit: "", absent: "", takes: KERNELS,
        doc: "smoothing kernel (THEORY E1)",
        get: |s| word(s.kernel), set: |s, v| s.kernel = variant(v) },
    Keyword { name: "smoothing_ratio", unit: "-", absent: "", takes: Takes::Between(1.0, 3.0),
        doc: "smoothing length over spacing h/dx; the kernel's support is 2h",
        get: |s| Some(Value::Number(s.smoothing_ratio)), set: |s, v| s.smoothing_ratio = number(v) },
    Keyword { name: "artificial_viscosity", unit: "-", absent: "", takes: Takes::From(0.0, ANY),
        doc: "coefficient alpha of artificial viscosity (THEORY E7)",
        get: |s| Some(Value::Number(s.artificial_viscosity)), set: |s, v| s.artificial_viscosity = number(v) },
    Keyword { name: "kinematic_viscosity", unit: "m^2/s", absent: "", takes: Takes::From(0.0, ANY),
        doc: "kinematic viscosity (THEORY E8)",
        get: |s| Some(Value::Number(s.kinematic_viscosity)), set: |s, v| s.kinematic_viscosity = number(v) },
    Keyword { name: "density_diffusion", unit: "-", absent: "", takes: Takes::From(0.0, ANY),
        doc: "coefficient delta of density diffusion (THEORY E5)",
        get: |s| Some(Value::Number(s.density_diffusion)), set: |s, v| s.density_diffusion = number(v) },
    Keyword { name: "shifting", unit: "", absent: "", takes: Takes::Flag,
        doc: "particle shifting (THEORY E13)",
        get: |s| Some(Value::Flag(s.shifting)), set: |s, v| s.shifting = flag(v) },
    Keyword { name: "wall_slip", unit: "", absent: "", takes: Takes::Word(&["free", "none"]),
        doc: "free: the water slides along walls | none: it sticks to them (THEORY E11)",
        get: |s| word(s.wall_slip), set: |s, v| s.wall_slip = variant(v) },
    Keyword { name: "wall_stretch", unit: "", absent: "", takes: Takes::Flag,
        doc: "behind walls the water is stretched along them like that in front (THEORY E10)",
        get: |s| Some(Value::Flag(s.wall_stretch)), set: |s, v| s.wall_stretch = flag(v) },
    Keyword { name: "ventilation", unit: "", absent: "", takes: Takes::Flag,
        doc: "air comes in between a wall and water under tension where both touch it (THEORY E3)",
        get: |s| Some(Value::Flag(s.ventilation)), set: |s, v| s.ventilation = flag(v) },
    Keyword { name: "integrator", unit: "", absent: "", takes: Takes::Word(&["symplectic", "predictor_corrector"]),
        doc: "how the water steps (THEORY E15, E16)",
        get: |s| word(s.integrator), set: |s, v| s.integrator = variant(v) },
    Keyword { name: "cfl", unit: "-", absent: "0.6; 0.4 with wall_stretch, 0.3 with predictor_corrector", takes: Takes::Between(0.0, 1.2),
        doc: "the water's step: dt <= cfl h/(c0 + |v|) (THEORY E17)",
        get: |s| s.cfl.map(Value::Number), set: |s, v| s.cfl = Some(number(v)) },
    Keyword { name: "most_substeps", unit: "-", absent: "", takes: Takes::From(1.0, 1e9),
        doc: "a step of the host that would take more steps of the water is refused",
        get: |s| Some(Value::Number(s.most_substeps)), set: |s, v| s.most_substeps = number(v) },
];

#[cfg(test)]
mod tests {
    use super::*;

    /// Fields as `{:#?}` prints them: of the struct itself, not of what is inside.
    fn fields() -> Vec<String> {
        let printed = format!("{:#?}", FluidElementSpec::new(0.1, 1.0, 1.0));
        let own = printed
            .lines()
            .filter_map(|line| line.strip_prefix("    "))
            .filter(|line| !line.starts_with([' ', '}', ')']));
        let names = own.filter_map(|line| line.split_once(": ")).map(|(name, _)| name.to_string());
        names.filter(|name| name.chars().all(|c| c.is_lowercase() || c == '_')).collect()
    }

    #[test]
    fn every_field_is_a_key_and_every_key_a_field() {
        let (mut keys, mut fields): (Vec<String>, _) =
            (KEYWORDS.iter().map(|k| k.name.to_string()).collect(), fields());
        keys.sort();
        fields.sort();
        assert_eq!(keys, fields);
    }

    /// Each key sets its own field and no other: a value off the default comes back, and alone.
    #[test]
    fn each_key_sets_its_own_field() {
        for key in KEYWORDS {
            let other = match key.takes {
                Takes::Between(_, _) => Value::Number(1.05),
                Takes::From(_, _) => Value::Number(1.25),
                Takes::Pair => Value::Pair([1.0, -2.0]),
                Takes::Flag => Value::Flag(key.name != "shifting"),
                Takes::Word(words) => Value::Word(words[1].into()),
            };
            key.check(&other).expect("a value that the key takes");
            let start = FluidElementSpec::new(0.1, 1.0, 1.0);
            let mut spec = start.clone();
            (key.set)(&mut spec, &other);
            assert_eq!((key.get)(&spec), Some(other), "{}", key.name);
            for third in KEYWORDS.iter().filter(|third| third.name != key.name) {
                assert_eq!((third.get)(&spec), (third.get)(&start), "{} changed {}", key.name, third.name);
            }
        }
    }

    #[test]
    fn words_of_the_table_are_those_of_serde() {
        for key in KEYWORDS {
            let Takes::Word(words) = key.takes else { continue };
            for word in words {
                let mut spec = FluidElementSpec::new(0.1, 1.0, 1.0);
                (key.set)(&mut spec, &Value::Word(word.to_string()));
                assert_eq!((key.get)(&spec), Some(Value::Word(word.to_string())), "{}", key.name);
            }
        }
    }

    #[test]
    fn help_and_page_tell_every_key() {
        let page = reference_page();
        assert_eq!(page.lines().count(), 4 + KEYWORDS.len());
        for key in KEYWORDS {
            assert!(page.contains(&format!("| `{}` | {} |", key.name, key.unit)), "{}", key.name);
            assert!(!key.default().is_empty() && !key.default().contains("NaN"), "{}", key.name);
        }
        let help = |name: &str| KEYWORDS.iter().find(|key| key.name == name).expect("a key").help();
        assert_eq!(
            help("growth"),
            "growth [-]: ratio of successive rows outside the fine zone; 1 is uniform; a number of at least 1 and at most 1.5 (default: 1.1)"
        );
    }
}
