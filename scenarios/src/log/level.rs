//! Severity of a note.

use foxglove::messages::log;

/// Severity of a note, as `foxglove.Log` names it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// For developers of the program.
    Debug,
    /// The run goes as expected.
    Info,
    /// The run continues; its result needs a check.
    Warning,
    /// A part of the result is missing or wrong.
    Error,
    /// The run stops here.
    Fatal,
}

impl Level {
    /// The number of this level in `foxglove.Log`.
    pub(super) fn code(self) -> i32 {
        let level = match self {
            Self::Debug => log::Level::Debug,
            Self::Info => log::Level::Info,
            Self::Warning => log::Level::Warning,
            Self::Error => log::Level::Error,
            Self::Fatal => log::Level::Fatal,
        };
        level.into()
    }
}
