//! The ladder: models of an entry from the cheapest to the dearest, and what each can do.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::section::Section;
use super::similarity::DEADRISES;

/// A model of a body's entry into water.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Rung {
    /// Added mass of a plate as wide as the body's cut with the still water (von Karman 1929).
    VonKarman,
    /// The same with the water's pile-up (Wagner 1932).
    Wagner,
    /// Modified Logvinovich model: Wagner's flow, the pressure's square terms, the body's shape (Korobkin 2004).
    Mlm,
    /// The exact flow about a wedge at constant speed (Dobrovolskaya 1969), and an added mass where the speed changes.
    Similarity,
    /// Weakly compressible particles.
    Wcsph,
    /// Incompressible particles.
    Incompressible,
}

/// A model asked for what it cannot do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OutOfRange {
    /// What was asked.
    pub what: String,
    /// What the model holds for.
    pub range: String,
    /// The next rung that can do it.
    pub next: Rung,
}

impl Rung {
    /// All of them, from the cheapest.
    pub const ALL: [Rung; 6] =
        [Rung::VonKarman, Rung::Wagner, Rung::Mlm, Rung::Similarity, Rung::Wcsph, Rung::Incompressible];

    /// Its name in a scene.
    pub fn name(self) -> &'static str {
        match self {
            Rung::VonKarman => "von_karman",
            Rung::Wagner => "wagner",
            Rung::Mlm => "mlm",
            Rung::Similarity => "similarity",
            Rung::Wcsph => "wcsph",
            Rung::Incompressible => "incompressible",
        }
    }

    /// Is it a formula, not a flow of particles?
    pub fn is_theory(self) -> bool {
        self < Rung::Wcsph
    }

    /// Deadrises of a face that it holds for [deg]; THEORY EN9 has its errors there.
    pub fn deadrises(self) -> [f64; 2] {
        match self {
            Rung::VonKarman | Rung::Wagner => [4.0, 45.0],
            Rung::Mlm => [4.0, 60.0],
            Rung::Similarity => DEADRISES,
            Rung::Wcsph | Rung::Incompressible => [4.0, 90.0],
        }
    }

    /// Can it do this bottom, wetted up to the half width `reach` [m]?
    pub fn covers(self, section: &Section, reach: f64) -> Result<(), OutOfRange> {
        let [_, most] = self.deadrises();
        let steepest = section.steepest_within(reach);
        let refuse = |what: String, range: String| {
            let able = |r: &&Rung| **r > self && r.covers(section, reach).is_ok();
            Err(OutOfRange { what, range, next: *Rung::ALL.iter().find(able).unwrap_or(&Rung::Wcsph) })
        };
        match self {
            _ if !self.is_theory() => Ok(()),
            Rung::Similarity if section.deadrise_deg().is_none() => {
                refuse("a bottom that is no wedge".into(), format!("wedges of 4 to {most} degrees"))
            }
            Rung::Similarity if reach > section.half_breadth() => {
                refuse("a wedge whose chines are wet".into(), "wedges as long as the spray leaves their faces".into())
            }
            _ if steepest > most + 1e-6 => {
                refuse(format!("a face of {steepest:.2} degrees"), format!("faces of 4 to {most} degrees"))
            }
            _ => Ok(()),
        }
    }
}

impl std::fmt::Display for OutOfRange {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}, not {}: the next model that can is \"{}\"", self.range, self.what, self.next.name())
    }
}

impl std::error::Error for OutOfRange {}
