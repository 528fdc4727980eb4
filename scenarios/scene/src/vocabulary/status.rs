//! How a run ended.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::results::Results;

/// How a run ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Status {
    /// Reached its end time; nothing speaks against its results.
    #[default]
    Completed,
    /// Reached its end time; `doubts`, or of a landing `message`, says which results are not to be relied on.
    CompletedWithDoubts,
    /// Reached its end time; a panel is beyond its limits.
    BeyondAllowable,
    /// Ended where the first end of a panel broke off; `message` has panel, place, time and strain.
    Ruptured,
    /// Broke down; `message` has cause, place and time.
    Failed,
    /// Ended by the user.
    Interrupted,
    /// It has no summary: it goes on, or was killed.
    NotFinished,
}

/// Each status: its name in files, its words on pages.
const TABLE: [(Status, &str, &str); 7] = [
    (Status::Completed, "completed", "completed"),
    (Status::CompletedWithDoubts, "completed_with_doubts", "completed with doubts"),
    (Status::BeyondAllowable, "beyond_allowable", "beyond the allowable"),
    (Status::Ruptured, "ruptured", "ended at a rupture"),
    (Status::Failed, "failed", "failed"),
    (Status::Interrupted, "interrupted", "interrupted"),
    (Status::NotFinished, "not_finished", "not finished"),
];

impl Status {
    /// As in `summary.json`.
    pub fn name(self) -> &'static str {
        TABLE[self as usize].1
    }

    /// On a page.
    pub fn words(self) -> &'static str {
        TABLE[self as usize].2
    }

    /// The status of a name; an unknown one is that of a run that has not finished.
    pub fn of(name: &str) -> Status {
        TABLE.iter().find(|row| row.1 == name).map_or(Status::NotFinished, |row| row.0)
    }

    /// True for a run that reached its end time.
    pub fn is_completed(self) -> bool {
        matches!(self, Status::Completed | Status::CompletedWithDoubts | Status::BeyondAllowable)
    }

    /// True for a run whose results count: it reached its end time, or a panel broke.
    pub fn has_results(self) -> bool {
        self.is_completed() || self == Status::Ruptured
    }

    /// The status of a run that ended so, with its results and whether there are doubts about them.
    pub fn with(self, results: &Results, doubted: bool) -> Status {
        let beyond = results.named().any(|(_, quantity)| quantity.allowed == Some(false));
        match self {
            Status::Completed if beyond => Status::BeyondAllowable,
            Status::Completed if doubted => Status::CompletedWithDoubts,
            other => other,
        }
    }
}

impl Serialize for Status {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

impl<'de> Deserialize<'de> for Status {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Status, D::Error> {
        String::deserialize(deserializer).map(|name| Status::of(&name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_has_each_status_in_its_place() {
        for (k, (status, name, _)) in TABLE.iter().enumerate() {
            assert_eq!((*status as usize, Status::of(name)), (k, *status));
        }
    }
}
