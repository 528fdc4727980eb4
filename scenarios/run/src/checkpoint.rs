//! `checkpoint.bin`: the state of a run, to continue it to the same bits.
//!
//! | bytes | content |
//! |---|---|
//! | 8 | `SPLASHCP` |
//! | 4 | format, a number that grows with every change of the content |
//! | 1 + n | version of the program that wrote it: length, text |
//! | 4 | CRC-32 of the resolved scene but for its end |
//! | 8 | length of the content |
//! | … | content |
//! | 4 | CRC-32 of all before |
//!
//! Numbers are little-endian. The file is written under another name and renamed: a kill at any moment leaves the one before.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use scene::{Follower, MOST_ROWS, Scene};
use serde::{Deserialize, Serialize};
use sph_core::state_bytes::{StateError, decode, encode};

use crate::log::StoredLog;

/// Name of the file.
pub const FILE: &str = "checkpoint.bin";
/// Its name while it is written.
pub(super) const PART: &str = "checkpoint.bin.part";

const MAGIC: &[u8; 8] = b"SPLASHCP";
const FORMAT: u32 = 4;
const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Why a run cannot be resumed.
#[derive(Debug, thiserror::Error)]
pub enum CheckpointError {
    /// A file of the run that is not there or cannot be read.
    #[error("cannot read {path}: {1}; expected the folder of a run with --checkpoint-every, or of an interrupted one", path = .0.display())]
    Read(PathBuf, #[source] io::Error),
    /// A file of another kind.
    #[error("{path} is not a checkpoint of splashdown: it starts with {1:?}, expected {magic:?}", path = .0.display(), magic = text(MAGIC))]
    Foreign(PathBuf, String),
    /// A format that this program does not know.
    #[error("{} has format {found}, written by splashdown {by}; expected format {FORMAT}, of splashdown {VERSION}", path.display())]
    Format {
        /// The file.
        path: PathBuf,
        /// Its format.
        found: u32,
        /// The program that wrote it.
        by: String,
    },
    /// A file that is cut short, or longer than it says.
    #[error("{} has {found} bytes, expected {expected}", path.display())]
    Length {
        /// The file.
        path: PathBuf,
        /// Its length [bytes].
        found: usize,
        /// What it says of its length [bytes].
        expected: u64,
    },
    /// A file whose checksum does not fit.
    #[error("{} is damaged: its checksum is {found:08x}, expected {expected:08x}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// The checksum in it.
        found: u32,
        /// That of its bytes.
        expected: u32,
    },
    /// A resolved scene that cannot be read.
    #[error("{path}: {1}; expected the scene as the run wrote it", path = .0.display())]
    Unreadable(PathBuf, String),
    /// Another scene than that of the checkpoint.
    #[error("{path} is not the scene of {FILE}: expected it as the run wrote it, only time.end may differ", path = .0.display())]
    Scene(PathBuf),
    /// A state that does not fit the scene.
    #[error("{path}: {1}", path = .0.display())]
    State(PathBuf, #[source] StateError),
    /// A run that has nothing left to do.
    #[error("the run is at t = {time} s of {end} s: expected --until with a later time")]
    Ended {
        /// Its time [s].
        time: f64,
        /// Its end [s].
        end: f64,
    },
    /// An end that is no end of this run.
    #[error("--until {given}: expected a time after t = {time} s, of at most {MOST_ROWS} samples")]
    Until {
        /// What was given [s].
        given: f64,
        /// Where the run is [s].
        time: f64,
    },
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// The state of a run.
#[derive(Serialize, Deserialize)]
pub(super) struct Checkpoint {
    /// Fluid, walls and bodies.
    pub system: Vec<u8>,
    /// The observers but the log.
    pub recorder: Vec<u8>,
    /// The log; absent in a run without one.
    pub log: Option<StoredLog>,
    /// Interval of the checkpoints in simulated time [s].
    pub every: Option<f64>,
    /// Wall time so far [s].
    pub wall: f64,
    /// Warnings about the scene.
    pub warnings: Vec<String>,
    /// Why the scene's model was chosen, where it was `auto`.
    pub choice: Option<String>,
}

/// CRC-32 of a scene, whatever its end.
pub(crate) fn fingerprint(scene: &Scene) -> u32 {
    let share = Follower::of(scene).map(|follower| follower.share());
    let mut scene = scene.clone();
    scene.time.end = 0.0;
    if let Some(share) = share {
        // of a zone that goes with the end this is the same, but for rounding
        scene.resolution.fine_zone = share.map(|share| f64::from(share as f32));
    }
    crc32fast::hash(scene.to_toml().as_bytes())
}

impl Checkpoint {
    /// As the file's bytes, for a scene of this fingerprint.
    pub fn to_bytes(&self, fingerprint: u32) -> Vec<u8> {
        let content = encode(self);
        let mut bytes = Vec::with_capacity(content.len() + 64);
        bytes.extend_from_slice(MAGIC);
        bytes.extend_from_slice(&FORMAT.to_le_bytes());
        bytes.push(VERSION.len() as u8);
        bytes.extend_from_slice(VERSION.as_bytes());
        bytes.extend_from_slice(&fingerprint.to_le_bytes());
        bytes.extend_from_slice(&(content.len() as u64).to_le_bytes());
        bytes.extend_from_slice(&content);
        bytes.extend_from_slice(&crc32fast::hash(&bytes).to_le_bytes());
        bytes
    }

    /// The checkpoint in a folder, the version of the program that wrote it, and the fingerprint of its scene.
    pub fn read(dir: &Path) -> Result<(Checkpoint, String, u32), CheckpointError> {
        let path = dir.join(FILE);
        let bytes = fs::read(&path).map_err(|error| CheckpointError::Read(path.clone(), error))?;
        let found = bytes.len();
        let short = |expected: usize| CheckpointError::Length { path: path.clone(), found, expected: expected as u64 };
        if !bytes.starts_with(&MAGIC[..found.min(MAGIC.len())]) {
            return Err(CheckpointError::Foreign(path, text(&bytes[..found.min(MAGIC.len())])));
        }
        let mut rest = &bytes[found.min(MAGIC.len())..];
        let mut take = |n: usize| match rest.split_at_checked(n) {
            Some((taken, left)) => {
                rest = left;
                Ok(taken)
            }
            None => Err(short(found - rest.len() + n)),
        };
        let format = u32::from_le_bytes(array(take(4)?));
        let length = take(1)?[0];
        let by = text(take(usize::from(length))?);
        if format != FORMAT {
            return Err(CheckpointError::Format { path, found: format, by });
        }
        let fingerprint = u32::from_le_bytes(array(take(4)?));
        let content = u64::from_le_bytes(array(take(8)?));
        let expected = ((found - rest.len()) as u64).saturating_add(content).saturating_add(4);
        if expected != found as u64 {
            return Err(CheckpointError::Length { path, found, expected });
        }
        let (body, sum) = bytes.split_at(found - 4);
        let (sum, of_body) = (u32::from_le_bytes(array(sum)), crc32fast::hash(body));
        if sum != of_body {
            return Err(CheckpointError::Damaged { path, found: sum, expected: of_body });
        }
        let content = &rest[..rest.len() - 4];
        let checkpoint = decode("the run", content).map_err(|error| CheckpointError::State(path, error))?;
        Ok((checkpoint, by, fingerprint))
    }
}

/// The first N bytes.
fn array<const N: usize>(bytes: &[u8]) -> [u8; N] {
    std::array::from_fn(|k| bytes[k])
}

/// Write `bytes` to a file of a folder in place of the one that is there, whole or not at all.
pub(super) fn write_whole(dir: &Path, name: &str, part: &str, bytes: &[u8]) -> io::Result<()> {
    let part = dir.join(part);
    let mut file = File::create(&part)?;
    file.write_all(bytes)?;
    file.sync_all()?;
    fs::rename(part, dir.join(name))
}
