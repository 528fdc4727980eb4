//! Viewers of a run in progress.

use super::error::LogError;
use super::frame::Frame;

/// Shows a run while it goes on, with the topics of the log. A viewer that is slow must not delay the run.
pub trait Viewers: Send {
    /// True where a viewer waits for a picture.
    fn is_due(&self) -> bool;

    /// Named numbers at `time` [s] on the topic `/CHANNEL`, as in the log.
    ///
    /// # Errors
    /// [`LogError::Time`].
    fn sample(&mut self, time: f64, channel: &str, values: &[(&str, f64)]) -> Result<(), LogError>;

    /// A picture of the run.
    fn frame(&mut self, frame: &Frame);
}
