//! What may be said of a result.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// What may be said of a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Right within its band.
    Resolved,
    /// It depends on the speed of sound, or on the averaging time: a spray root above Mach 0.3, single steps far above their mean, a round bottom
    /// averaged too briefly, a start in the water at speed (`validity::{compressibility, first_contact}`), a flat bottom, an echo
    /// (`validity::air`), a panel that resonates with the sound (`validity::wet_period`); `run::results::judge` decides.
    Acoustic,
    /// The spacing is too coarse for it, or something else speaks against it: walls or options without known forces, tension, lost work, a touch,
    /// a run that broke down.
    NotResolved,
    /// Nothing known speaks against it, and nothing gives a band: no theory or chart is of such a flow.
    NoBand,
}

/// Each verdict: its name in files, its words on pages.
const TABLE: [(Verdict, &str, &str); 4] = [
    (Verdict::Resolved, "resolved", "resolved"),
    (Verdict::Acoustic, "acoustic", "depends on the speed of sound"),
    (Verdict::NotResolved, "not_resolved", "not resolved"),
    (Verdict::NoBand, "no_band", "no band known"),
];

impl Verdict {
    /// As in `summary.json`.
    pub fn name(self) -> &'static str {
        TABLE[self as usize].1
    }

    /// On a page.
    pub fn words(self) -> &'static str {
        TABLE[self as usize].2
    }

    /// The verdict with this name; `NotResolved` for an unknown name.
    pub fn of(name: &str) -> Verdict {
        TABLE.iter().find(|row| row.1 == name).map_or(Verdict::NotResolved, |row| row.0)
    }

    /// All verdicts.
    pub fn all() -> impl Iterator<Item = Verdict> {
        TABLE.iter().map(|row| row.0)
    }

    /// False where something speaks against the number.
    pub fn is_sound(self) -> bool {
        matches!(self, Verdict::Resolved | Verdict::NoBand)
    }
}

impl Serialize for Verdict {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

impl<'de> Deserialize<'de> for Verdict {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Verdict, D::Error> {
        String::deserialize(deserializer).map(|name| Verdict::of(&name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_has_each_verdict_in_its_place() {
        for (k, (verdict, name, _)) in TABLE.iter().enumerate() {
            assert_eq!((*verdict as usize, Verdict::of(name)), (k, *verdict));
        }
        assert_eq!(Verdict::of("a word of another version"), Verdict::NotResolved);
    }
}
