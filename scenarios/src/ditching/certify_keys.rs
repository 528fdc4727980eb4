//! Keys of the list of landings that a rule asks for: table `[certify]`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use settings::{Problem, require};

/// Most cases of a list.
pub const MOST_CASES: usize = 100_000;

/// Table `[certify]`: the landings that a rule asks for, every combination of its lists; `splashdown certify` runs them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct CertifyKeys {
    /// Rule of 14 CFR whose paragraphs are answered; with 25.801 stands 25.563, with 29.563 stands 29.801.
    pub rule: RuleKey,
    /// Masses and centres of mass.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub loadings: Vec<LoadingKeys>,
    /// Pitch of the body axis over the horizon at the first touch, a list [deg].
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-default" = "that of [landing], 2 less and 2 more"))]
    pub pitches_deg: Option<Vec<f64>>,
    /// Speeds downwards at the first touch, over the mean surface of the water, a list [m/s].
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-default" = "that of the rule; without one that of [landing], and 1.5 times that"))]
    pub sink_speeds: Option<Vec<f64>>,
    /// Forward speeds at the first touch, a list [m/s].
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-default" = "those of the rule; without them landing.speed, or where the wing carries the weight"))]
    pub forward_speeds: Option<Vec<f64>>,
    /// Directions of flight from that of the waves, a list: 0 with them, 90 along the crests, 180 against them [deg].
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-default" = "[0, 90, 180]"))]
    pub headings_deg: Option<Vec<f64>>,
    /// Phases of regular waves at the first contact, a list: 0 crest, 90 down slope, 180 trough, 270 up slope [deg].
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-default" = "[0, 90, 180, 270]"))]
    pub phases_deg: Option<Vec<f64>>,
    /// Calm water is one of the seas.
    pub calm: bool,
    /// Seas beside calm water; an empty list: none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seas: Option<Vec<SeaStateKeys>>,
    /// The whole aeroplane is one of the states.
    pub intact: bool,
    /// States with parts lost before the first touch.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub failures: Vec<FailureKeys>,
    /// Number of cases that are run, spread over the list of all combinations.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = MOST_CASES), extend("x-default" = "all"))]
    pub cases: Option<usize>,
}

impl Default for CertifyKeys {
    fn default() -> CertifyKeys {
        CertifyKeys {
            rule: RuleKey::default(),
            loadings: Vec::new(),
            pitches_deg: None,
            sink_speeds: None,
            forward_speeds: None,
            headings_deg: None,
            phases_deg: None,
            calm: true,
            seas: None,
            intact: true,
            failures: Vec::new(),
            cases: None,
        }
    }
}

/// Value of `certify.rule`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum RuleKey {
    /// Transport aeroplanes: ditching.
    #[default]
    #[serde(rename = "25.801")]
    Aeroplane,
    /// Transport rotorcraft: ditching.
    #[serde(rename = "29.563")]
    Rotorcraft,
    /// Rotorcraft with a hull.
    #[serde(rename = "29.519")]
    HullRotorcraft,
}

/// An item of `[[certify.loadings]]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LoadingKeys {
    /// A word that names it.
    pub name: String,
    /// Mass [kg].
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "aeroplane.mass"))]
    pub mass: Option<f64>,
    /// Centre of mass, from the nose and over the body axis [m].
    #[schemars(extend("x-default" = "aeroplane.center_of_mass"))]
    pub center_of_mass: Option<[f64; 2]>,
    /// Radius of gyration in pitch [m].
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "aeroplane.radius_of_gyration"))]
    pub radius_of_gyration: Option<f64>,
}

/// An item of `[[certify.seas]]`: regular waves of a height and a length, or a spectrum with a significant height and a period.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SeaStateKeys {
    /// Height of regular waves, crest to trough [m].
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "required without significant_height"))]
    pub height: Option<f64>,
    /// Length of regular waves, crest to crest [m].
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "required with height"))]
    pub length: Option<f64>,
    /// Significant height of irregular waves, a JONSWAP spectrum [m].
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "required without height"))]
    pub significant_height: Option<f64>,
    /// Period of the peak of their spectrum [s].
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "required with significant_height"))]
    pub peak_period: Option<f64>,
    /// Seeds of irregular waves, a list: each whole number is another sea.
    #[schemars(extend("x-default" = "[1]"))]
    pub seeds: Option<Vec<u32>>,
}

/// An item of `[[certify.failures]]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FailureKeys {
    /// A word that names the state.
    pub name: String,
    /// Names of surfaces, nacelles, panels and struts that are gone, and of openings that are open.
    pub lost: Vec<String>,
    /// Area of each of these openings [m²].
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "openings.area"))]
    pub open_area: Option<f64>,
}

/// A sea of its keys: height and length, or significant height, peak period and seeds.
#[derive(Clone, Debug, PartialEq)]
pub enum SeaForm {
    /// Height and length of regular waves [m].
    Regular(f64, f64),
    /// Significant height [m], period of the peak [s], seeds.
    Irregular(f64, f64, Vec<u32>),
}

impl SeaStateKeys {
    /// Which sea the keys say; `key` is their place.
    pub fn form(&self, key: &str) -> Result<SeaForm, Problem> {
        let needs =
            |name: &str, with: &str| Problem::missing(&format!("{key}.{name}"), format!("a value beside {with}"));
        let both = |name: &str, given: f64| {
            Problem::new(&format!("{key}.{name}"), given, "regular waves (height, length) or a spectrum, not both")
        };
        match (self.height, self.significant_height) {
            (Some(_), Some(given)) => Err(both("significant_height", given)),
            (Some(height), None) => match (self.length, self.peak_period, &self.seeds) {
                (_, Some(given), _) => Err(both("peak_period", given)),
                (_, _, Some(seeds)) => Err(Problem::new(
                    &format!("{key}.seeds"),
                    format!("{seeds:?}"),
                    "none beside height: regular waves have phases",
                )),
                (length, None, None) => Ok(SeaForm::Regular(height, length.ok_or_else(|| needs("length", "height"))?)),
            },
            (None, Some(height)) => {
                if let Some(given) = self.length {
                    return Err(both("length", given));
                }
                let period = self.peak_period.ok_or_else(|| needs("peak_period", "significant_height"))?;
                let seeds = self.seeds.clone().unwrap_or_else(|| vec![1]);
                let expected = "at least one whole number";
                require(!seeds.is_empty(), &format!("{key}.seeds"), "[]", expected)?;
                Ok(SeaForm::Irregular(height, period, seeds))
            }
            (None, None) => Err(Problem::missing(
                &format!("{key}.height"),
                "height and length, or significant_height and peak_period",
            )),
        }
    }
}
