//! The log of a run: what is in it, what is left of it after a kill, what it refuses.

mod background;
mod content;
mod killed;
mod refused;

use std::f64::consts::FRAC_PI_2;
use std::fs;
use std::path::{Path, PathBuf};

use mcap::McapError;
use mcap::sans_io::LinearReaderOptions;
use run::log::{BodyView, Frame, Level, LogError, LogMetadata, LogWriter, Point};
use temp_dir::TempDir;

const FRAMES: usize = 20;
const FRAME_INTERVAL: f64 = 0.01;
/// `/fluid`, `/walls`, `/scene`, `/tf`, and the two samples written before each frame.
const MESSAGES_PER_FRAME: usize = 6;

const METADATA: LogMetadata<'static> =
    LogMetadata { scene: "wedge", scene_toml: "[fluid]\ndensity = 1000.0 # kg/m³\n", version: "0.1.0" };

/// A row of particles with velocities that do not repeat, `k` frames into the run.
fn row(count: usize, k: usize) -> Vec<Point> {
    let spacing = 0.125;
    let particle = |i: usize| Point {
        at: [i as f64 * spacing, -(k as f64) / 16.0],
        pressure: (100 * i + k) as f64,
        velocity: [3.0 + ((7919 * i + 104_729 * k) % 1000) as f64 / 1024.0, -4.0],
        density: 1000.5,
        spacing,
        id: u32::MAX - i as u32,
    };
    (0..count).map(particle).collect()
}

fn time_of(k: usize) -> f64 {
    k as f64 * FRAME_INTERVAL
}

fn path_in(folder: &TempDir) -> PathBuf {
    folder.path().join("log.mcap")
}

/// Frame `k`.
fn picture(k: usize, particles: usize) -> Result<Frame, LogError> {
    let time = time_of(k);
    let wedge = BodyView {
        name: "wedge",
        position: [0.25, 1.5 - time],
        angle: FRAC_PI_2,
        outline: &[[-0.5, 0.5], [0.0, 0.0], [0.5, 0.5]],
    };
    Frame::new(time, &row(particles, k), &row(7, 0), &[wedge])
}

/// Hands the samples that precede frame `k` to `take`.
fn samples(k: usize, mut take: impl FnMut(f64, &str, &[(&str, f64)]) -> Result<(), LogError>) -> Result<(), LogError> {
    take(time_of(k), "body/wedge", &[("y_m", 0.1 + 0.2 * k as f64), ("force_y_N", f64::NAN)])?;
    take(time_of(k), "audit", &[("mass_kg", 1000.0)])
}

/// Writes frame `k` and the samples that precede it.
fn write_frame(log: &mut LogWriter, k: usize) -> Result<(), LogError> {
    samples(k, |time, channel, values| log.sample(time, channel, values))?;
    log.frame(&picture(k, 50)?)
}

/// Writes a log of [`FRAMES`] frames and one note, and returns its bytes.
fn complete_log(path: &Path) -> Vec<u8> {
    let mut log = LogWriter::create(path, &METADATA).expect("the log is created");
    for k in 0..FRAMES {
        write_frame(&mut log, k).expect("the frame is written");
    }
    log.note(time_of(FRAMES), Level::Warning, "the wedge is submerged").expect("the note is written");
    let length = log.finish().expect("the log is finished");
    let bytes = fs::read(path).expect("the log is read");
    assert_eq!(length, bytes.len() as u64);
    bytes
}

/// The messages a streaming reader finds before the end of the bytes, and why it stopped.
fn stream(bytes: &[u8]) -> (Vec<mcap::Message<'static>>, Option<McapError>) {
    let options = LinearReaderOptions::default().with_skip_end_magic(true).with_prevalidate_chunk_crcs(true);
    let mut messages = Vec::new();
    for message in mcap::io::MessageReader::new_with_options(bytes, options) {
        match message {
            Ok(message) => messages.push(message),
            Err(error) => return (messages, Some(error)),
        }
    }
    (messages, None)
}
