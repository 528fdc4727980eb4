//! What a format of frames does.

use std::io;

use run::log::LoggedFrame;

/// Writes frames into a folder.
pub(super) trait FrameWriter {
    /// Write the frame of a number.
    fn frame(&mut self, number: usize, frame: &LoggedFrame) -> io::Result<()>;

    /// Write what belongs to all frames.
    fn finish(self: Box<Self>) -> io::Result<()>;
}
