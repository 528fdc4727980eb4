//! What an error is known from.

/// An error that was measured.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Measured {
    /// Its size [-].
    pub error: f64,
    /// In which case, against what.
    pub case: String,
}
