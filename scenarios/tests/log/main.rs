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
use scenarios::log::{BodyView, Level, LogError, LogMetadata, LogWriter, ParticleView};
use tempfile::TempDir;

const FRAMES: usize = 20;
const FRAME_INTERVAL: f64 = 0.01;
/// `/fluid`, `/walls`, `/scene`, `/tf`, and the two samples written before each frame.
const MESSAGES_PER_FRAME: usize = 6;

const METADATA: LogMetadata<'static> =
    LogMetadata { scene: "wedge", scene_toml: "[fluid]\ndensity = 1000.0 # kg/m³\n", version: "0.1.0" };

/// Particles that own their slices: a row at speed 5 m/s, `k` frames into the run.
struct Row {
    x: Vec<f64>,
    y: Vec<f64>,
    vx: Vec<f64>,
    vy: Vec<f64>,
    pressure: Vec<f64>,
    density: Vec<f64>,
    spacing: Vec<f64>,
    id: Vec<u32>,
}

impl Row {
    fn new(count: usize, k: usize) -> Self {
        let spacing = 0.125;
        Self {
            x: (0..count).map(|i| i as f64 * spacing).collect(),
            y: vec![-(k as f64) / 16.0; count],
            vx: vec![3.0; count],
            vy: vec![-4.0; count],
            pressure: (0..count).map(|i| (100 * i + k) as f64).collect(),
            density: vec![1000.5; count],
            spacing: vec![spacing; count],
            id: (0..count as u32).map(|i| u32::MAX - i).collect(),
        }
    }

    fn view(&self) -> ParticleView<'_> {
        ParticleView {
            x: &self.x,
            y: &self.y,
            vx: &self.vx,
            vy: &self.vy,
            pressure: &self.pressure,
            density: &self.density,
            spacing: &self.spacing,
            id: &self.id,
        }
    }
}

fn time_of(k: usize) -> f64 {
    k as f64 * FRAME_INTERVAL
}

fn path_in(folder: &TempDir) -> PathBuf {
    folder.path().join("log.mcap")
}

/// Hands frame `k` to `show`.
fn picture<T>(k: usize, show: impl FnOnce(f64, &ParticleView<'_>, &ParticleView<'_>, &[BodyView<'_>]) -> T) -> T {
    let time = time_of(k);
    let wedge = BodyView {
        name: "wedge",
        position: [0.25, 1.5 - time],
        angle: FRAC_PI_2,
        outline: &[[-0.5, 0.5], [0.0, 0.0], [0.5, 0.5]],
    };
    show(time, &Row::new(50, k).view(), &Row::new(7, 0).view(), &[wedge])
}

/// Hands the samples that precede frame `k` to `take`.
fn samples(k: usize, mut take: impl FnMut(f64, &str, &[(&str, f64)]) -> Result<(), LogError>) -> Result<(), LogError> {
    take(time_of(k), "body/wedge", &[("y_m", 0.1 + 0.2 * k as f64), ("force_y_N", f64::NAN)])?;
    take(time_of(k), "audit", &[("mass_kg", 1000.0)])
}

/// Writes frame `k` and the samples that precede it.
fn write_frame(log: &mut LogWriter, k: usize) -> Result<(), LogError> {
    samples(k, |time, channel, values| log.sample(time, channel, values))?;
    picture(k, |time, fluid, walls, bodies| log.frame(time, fluid, walls, bodies))
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
