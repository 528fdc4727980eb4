//! Files that are read as text, up to a size.

use std::fs;
use std::io::{self, ErrorKind, Read};
use std::path::Path;

/// Largest file that is read as text [bytes].
const LARGEST_TEXT: u64 = 16 << 20;

/// The text of a file of at most 16 MiB, or of what stands for one and may not end.
pub(crate) fn read_text(path: impl AsRef<Path>) -> io::Result<String> {
    let mut text = String::new();
    fs::File::open(path)?.take(LARGEST_TEXT + 1).read_to_string(&mut text)?;
    match text.len() as u64 > LARGEST_TEXT {
        true => Err(io::Error::new(ErrorKind::FileTooLarge, "it has more than 16 MiB")),
        false => Ok(text),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(unix)]
    #[test]
    fn what_does_not_end_is_refused() {
        assert_eq!(read_text("/dev/zero").expect_err("no end").kind(), ErrorKind::FileTooLarge);
        assert_eq!(read_text("/nowhere").expect_err("nothing").kind(), ErrorKind::NotFound);
    }
}
