//! Files that are read as text, up to a size.

use std::fs;
use std::io::{self, ErrorKind, Read};
use std::path::Path;

/// Largest file that is read as text [bytes].
const LARGEST_TEXT: u64 = 16 << 20;

/// The text of a file of at most 16 MiB, or of what stands for one and may not end.
pub fn read_text(path: impl AsRef<Path>) -> io::Result<String> {
    let mut bytes = Vec::new();
    fs::File::open(path)?.take(LARGEST_TEXT + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > LARGEST_TEXT {
        return Err(io::Error::new(ErrorKind::FileTooLarge, "it has more than 16 MiB"));
    }
    String::from_utf8(bytes).map_err(|error| {
        let (before, bytes) = (error.utf8_error().valid_up_to(), error.as_bytes());
        let line = 1 + bytes[..before].iter().filter(|byte| **byte == b'\n').count();
        let text = format!("line {line}: byte 0x{:02x} is not UTF-8: expected the file saved as UTF-8", bytes[before]);
        io::Error::new(ErrorKind::InvalidData, text)
    })
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

    #[test]
    fn other_encodings_are_reported_with_their_line() {
        let folder = temp_dir::TempDir::new().expect("a folder");
        let path = folder.path().join("latin.toml");
        fs::write(&path, b"name = \"a\"\ndescription = \"Aufprall, schr\xe4g\"\n").expect("a file");
        let said = read_text(&path).expect_err("Latin-1").to_string();
        assert_eq!(said, "line 2: byte 0xe4 is not UTF-8: expected the file saved as UTF-8");
    }
}
