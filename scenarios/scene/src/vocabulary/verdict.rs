//! What may be said of a result.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// What may be said of a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Right within its band.
    Resolved,
    /// It depends on the speed of sound, or on the averaging time: no value without both.
    Acoustic,
    /// The spacing is too coarse for it.
    NotResolved,
    /// Nothing known speaks against it, and nothing gives a band: no theory or chart is of such a flow.
    NoBand,
    /// It was found by a formula, not by this run.
    Estimated,
}

/// Each verdict: its name in files, its words on pages.
const TABLE: [(Verdict, &str, &str); 5] = [
    (Verdict::Resolved, "resolved", "resolved"),
    (Verdict::Acoustic, "acoustic", "depends on the speed of sound"),
    (Verdict::NotResolved, "not_resolved", "not resolved"),
    (Verdict::NoBand, "no_band", "no band known"),
    (Verdict::Estimated, "estimated", "estimated by a formula"),
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

    /// The verdict of a name; of a name that this program does not know, that nothing may be said of the number.
    pub fn of(name: &str) -> Verdict {
        TABLE.iter().find(|row| row.1 == name).map_or(Verdict::NotResolved, |row| row.0)
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
