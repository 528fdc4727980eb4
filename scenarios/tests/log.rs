//! The log of a run: what is written is what is read, whole or cut short.

use std::f64::consts::FRAC_PI_2;
use std::fs;
use std::path::{Path, PathBuf};

use foxglove::Decode;
use foxglove::messages::{FrameTransforms, Log, PointCloud, SceneUpdate};
use mcap::sans_io::LinearReaderOptions;
use mcap::{McapError, MessageStream, Summary};
use scenarios::log::{BodyView, Level, LogError, LogMetadata, LogWriter, ParticleView};
use tempfile::TempDir;

const FRAMES: usize = 20;
const FRAME_INTERVAL: f64 = 0.01;
/// `/fluid`, `/walls`, `/scene`, `/tf`, and the two samples written before each frame.
const MESSAGES_PER_FRAME: usize = 6;
const POINT_SIZE: usize = 32;

const METADATA: LogMetadata<'static> = LogMetadata {
    scene: "wedge",
    scene_toml: "[fluid]\ndensity = 1000.0 # kg/m³\n",
    version: "0.1.0",
};

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

/// Writes frame `k` and the samples that precede it.
fn write_frame(log: &mut LogWriter, k: usize) -> Result<(), LogError> {
    let time = time_of(k);
    log.sample(
        time,
        "body/wedge",
        &[("y_m", 0.1 + 0.2 * k as f64), ("force_y_N", f64::NAN)],
    )?;
    log.sample(time, "audit", &[("mass_kg", 1000.0)])?;
    let wedge = BodyView {
        name: "wedge",
        position: [0.25, 1.5 - time],
        angle: FRAC_PI_2,
        outline: &[[-0.5, 0.5], [0.0, 0.0], [0.5, 0.5]],
    };
    log.frame(
        time,
        &Row::new(50, k).view(),
        &Row::new(7, 0).view(),
        &[wedge],
    )
}

/// Writes a log of [`FRAMES`] frames and one note, and returns its bytes.
fn complete_log(path: &Path) -> Vec<u8> {
    let mut log = LogWriter::create(path, &METADATA).expect("the log is created");
    for k in 0..FRAMES {
        write_frame(&mut log, k).expect("the frame is written");
    }
    log.note(time_of(FRAMES), Level::Warning, "the wedge is submerged")
        .expect("the note is written");
    let length = log.finish().expect("the log is finished");
    let bytes = fs::read(path).expect("the log is read");
    assert_eq!(length, bytes.len() as u64);
    bytes
}

/// The data of every message of `topic`, in file order, with its time [ns].
fn messages_of(log: &[u8], topic: &str) -> Vec<(u64, Vec<u8>)> {
    MessageStream::new(log)
        .expect("the log starts well")
        .map(|message| message.expect("the log is whole"))
        .filter(|message| message.channel.topic == topic)
        .map(|message| (message.log_time, message.data.into_owned()))
        .collect()
}

fn decoded<M: Decode>(log: &[u8], topic: &str) -> Vec<M> {
    let messages = messages_of(log, topic);
    messages
        .iter()
        .map(|(_, data)| M::decode(data.as_slice()).expect("the message matches its type"))
        .collect()
}

/// The messages a streaming reader finds before the end of the bytes, and why it stopped.
fn stream(bytes: &[u8]) -> (Vec<mcap::Message<'static>>, Option<McapError>) {
    let options = LinearReaderOptions::default()
        .with_skip_end_magic(true)
        .with_prevalidate_chunk_crcs(true);
    let mut messages = Vec::new();
    for message in mcap::io::MessageReader::new_with_options(bytes, options) {
        match message {
            Ok(message) => messages.push(message),
            Err(error) => return (messages, Some(error)),
        }
    }
    (messages, None)
}

#[test]
fn every_message_carries_simulated_time_and_its_place() {
    let folder = TempDir::new().unwrap();
    let log = complete_log(&path_in(&folder));
    let mut counts = std::collections::BTreeMap::new();
    for message in MessageStream::new(&log).unwrap() {
        let message = message.unwrap();
        let count: &mut u32 = counts.entry(message.channel.topic.clone()).or_default();
        assert_eq!(message.sequence, *count);
        assert_eq!(message.publish_time, message.log_time);
        if message.channel.topic != "/log" {
            assert_eq!(message.log_time, u64::from(*count) * 10_000_000);
        }
        *count += 1;
    }
    let frames = FRAMES as u32;
    let expected = [
        ("/audit", frames),
        ("/body/wedge", frames),
        ("/fluid", frames),
        ("/log", 1),
        ("/scene", frames),
        ("/tf", frames),
        ("/walls", frames),
    ];
    assert_eq!(counts, expected.map(|(t, n)| (t.to_owned(), n)).into());
}

#[test]
fn point_clouds_unpack_to_the_particles() {
    let folder = TempDir::new().unwrap();
    let log = complete_log(&path_in(&folder));
    let clouds: Vec<PointCloud> = decoded(&log, "/fluid");
    let walls: Vec<PointCloud> = decoded(&log, "/walls");
    assert_eq!(walls[0].data.len(), 7 * POINT_SIZE);

    let k = 3;
    let cloud = &clouds[k];
    assert_eq!(cloud.frame_id, "world");
    assert_eq!(cloud.timestamp.unwrap().total_nanos(), 30_000_000);
    assert_eq!(cloud.point_stride as usize, POINT_SIZE);
    let fields: Vec<(&str, u32)> = cloud
        .fields
        .iter()
        .map(|field| (field.name.as_str(), field.offset))
        .collect();
    let names = [
        "x", "y", "z", "pressure", "speed", "density", "spacing", "id",
    ];
    assert_eq!(
        fields,
        names.into_iter().zip((0..).step_by(4)).collect::<Vec<_>>()
    );

    let row = Row::new(50, k);
    assert_eq!(cloud.data.len(), row.x.len() * POINT_SIZE);
    for (i, point) in cloud.data.chunks_exact(POINT_SIZE).enumerate() {
        let word = |j: usize| <[u8; 4]>::try_from(&point[4 * j..4 * j + 4]).unwrap();
        let floats: Vec<f32> = (0..7).map(|j| f32::from_le_bytes(word(j))).collect();
        let expected = [
            row.x[i],
            row.y[i],
            0.0,
            row.pressure[i],
            5.0,
            row.density[i],
            row.spacing[i],
        ];
        assert_eq!(floats, expected.map(|value| value as f32));
        assert_eq!(u32::from_le_bytes(word(7)), row.id[i]);
    }
}

#[test]
fn an_outline_moves_with_the_frame_of_its_body() {
    let folder = TempDir::new().unwrap();
    let log = complete_log(&path_in(&folder));
    let scenes: Vec<SceneUpdate> = decoded(&log, "/scene");
    let transforms: Vec<FrameTransforms> = decoded(&log, "/tf");

    let entity = &scenes[5].entities[0];
    assert!(entity.frame_locked);
    assert_eq!(entity.id, scenes[0].entities[0].id);
    let corner = entity.lines[0].points[2];

    let transform = &transforms[5].transforms[0];
    assert_eq!(transform.parent_frame_id, "world");
    assert_eq!(transform.child_frame_id, entity.frame_id);
    let (origin, rotation) = (transform.translation.unwrap(), transform.rotation.unwrap());
    // Rotation of (x, y) by the quaternion (0, 0, z, w).
    let (z, w) = (rotation.z, rotation.w);
    let (cos, sin) = (w * w - z * z, 2.0 * w * z);
    let x = origin.x + cos * corner.x - sin * corner.y;
    let y = origin.y + sin * corner.x + cos * corner.y;
    // The corner (0.5, 0.5), turned by a quarter, is (-0.5, 0.5) from (0.25, 1.45).
    assert!((x + 0.25).abs() < 1e-15, "x = {x}");
    assert!((y - 1.95).abs() < 1e-15, "y = {y}");
}

#[test]
fn samples_are_exact_and_write_null_for_what_is_not_finite() {
    let folder = TempDir::new().unwrap();
    let log = complete_log(&path_in(&folder));
    let samples = messages_of(&log, "/body/wedge");
    // 0.1 + 0.2 in f64, to the last digit.
    assert_eq!(
        String::from_utf8_lossy(&samples[1].1),
        r#"{"y_m":0.30000000000000004,"force_y_N":null}"#
    );

    let summary = Summary::read(&log).unwrap().expect("a summary");
    let channel = summary
        .channels
        .values()
        .find(|channel| channel.topic == "/body/wedge")
        .expect("the channel");
    let schema = channel.schema.as_ref().expect("a schema");
    assert_eq!(channel.message_encoding, "json");
    assert_eq!(schema.encoding, "jsonschema");
    assert_eq!(schema.name, "splashdown/body/wedge");
    let schema: serde_json::Value = serde_json::from_slice(&schema.data).unwrap();
    assert_eq!(
        schema,
        serde_json::json!({
            "type": "object",
            "properties": { "y_m": { "type": "number" }, "force_y_N": { "type": "number" } }
        })
    );
}

#[test]
fn a_note_keeps_its_level_and_text() {
    let folder = TempDir::new().unwrap();
    let log = complete_log(&path_in(&folder));
    let notes: Vec<Log> = decoded(&log, "/log");
    assert_eq!(notes[0].message, "the wedge is submerged");
    assert_eq!(notes[0].level(), foxglove::messages::log::Level::Warning);
    assert_eq!(notes[0].timestamp.unwrap().total_nanos(), 200_000_000);
}

#[test]
fn the_scene_is_an_attachment_and_metadata() {
    let folder = TempDir::new().unwrap();
    let log = complete_log(&path_in(&folder));
    let summary = Summary::read(&log).unwrap().expect("a summary");

    let attachment = mcap::read::attachment(&log, &summary.attachment_indexes[0]).unwrap();
    assert_eq!(attachment.name, "scene.resolved.toml");
    assert_eq!(attachment.data, METADATA.scene_toml.as_bytes());

    let mut records = summary
        .metadata_indexes
        .iter()
        .map(|index| mcap::read::metadata(&log, index).unwrap());
    let program = records.next().expect("the program");
    assert_eq!(program.name, "splashdown");
    assert_eq!(program.metadata["scene"], "wedge");
    assert_eq!(program.metadata["version"], "0.1.0");
    let scene = records.next().expect("the scene");
    assert_eq!(scene.name, "scene.resolved.toml");
    assert_eq!(scene.metadata["toml"], METADATA.scene_toml);
}

#[test]
fn the_same_run_writes_the_same_bytes() {
    let folder = TempDir::new().unwrap();
    let first = complete_log(&folder.path().join("first.mcap"));
    let second = complete_log(&folder.path().join("second.mcap"));
    assert_eq!(first, second);
}

#[test]
fn a_killed_run_leaves_every_frame_it_returned_from() {
    let folder = TempDir::new().unwrap();
    let path = path_in(&folder);
    let mut log = LogWriter::create(&path, &METADATA).unwrap();
    let mut before = fs::read(&path).unwrap();
    for k in 0..FRAMES {
        write_frame(&mut log, k).unwrap();
        let now = fs::read(&path).unwrap();
        assert!(now.starts_with(&before), "frame {k} rewrote earlier bytes");
        let (messages, _) = stream(&now);
        assert_eq!(messages.len(), (k + 1) * MESSAGES_PER_FRAME);
        before = now;
    }
    log.sample(time_of(FRAMES), "audit", &[("mass_kg", 999.0)])
        .unwrap();
    log.note(time_of(FRAMES), Level::Fatal, "diverged").unwrap();
    log.sample(time_of(FRAMES), "audit", &[("mass_kg", 998.0)])
        .unwrap();

    // A killed process runs no destructor. The last sample had no frame or note to follow it.
    std::mem::forget(log);
    let log = fs::read(&path).unwrap();
    let (messages, error) = stream(&log);
    assert!(error.is_none(), "the file ends within a record: {error:?}");
    assert!(Summary::read(&log).is_err(), "the file has its summary");
    assert_eq!(messages.len(), FRAMES * MESSAGES_PER_FRAME + 2);
}

#[test]
fn a_dropped_log_is_complete() {
    let folder = TempDir::new().unwrap();
    let path = path_in(&folder);
    let mut log = LogWriter::create(&path, &METADATA).unwrap();
    write_frame(&mut log, 0).unwrap();
    drop(log);
    let summary = Summary::read(&fs::read(&path).unwrap()).unwrap();
    let statistics = summary.expect("a summary").stats.expect("statistics");
    assert_eq!(statistics.message_count, MESSAGES_PER_FRAME as u64);
}

#[test]
fn a_truncated_log_reads_as_a_prefix_of_whole_frames() {
    let folder = TempDir::new().unwrap();
    let log = complete_log(&path_in(&folder));
    let (all, end) = stream(&log);
    assert!(end.is_none(), "{end:?}");
    for tenth in 1..10 {
        let (messages, error) = stream(&log[..log.len() * tenth / 10]);
        assert_eq!(messages, all[..messages.len()], "{tenth}/10");
        let whole_frames = messages.len().is_multiple_of(MESSAGES_PER_FRAME);
        assert!(whole_frames || messages.len() == all.len(), "{tenth}/10");
        // The summary takes less than the last half of this small file.
        assert!(tenth < 5 || messages.len() > all.len() / 4, "{tenth}/10");
        if messages.len() < all.len() {
            assert!(matches!(error, Some(McapError::UnexpectedEof)), "{error:?}");
        }
    }
}

#[test]
fn a_frame_that_is_refused_leaves_no_trace() {
    let folder = TempDir::new().unwrap();
    let path = path_in(&folder);
    let mut log = LogWriter::create(&path, &METADATA).unwrap();
    let (fluid, mut walls) = (Row::new(4, 0), Row::new(3, 0));
    walls.density.pop();
    let error = log.frame(0.0, &fluid.view(), &walls.view(), &[]);
    assert_eq!(
        error.unwrap_err().to_string(),
        "/walls: 2 values of density for 3 particles"
    );
    let error = log.frame(f64::NAN, &fluid.view(), &fluid.view(), &[]);
    assert!(matches!(error, Err(LogError::Time { time }) if time.is_nan()));
    log.finish().unwrap();
    assert_eq!(stream(&fs::read(&path).unwrap()).0.len(), 0);
}

#[test]
fn a_sample_must_keep_to_the_schema_of_its_channel() {
    let folder = TempDir::new().unwrap();
    let mut log = LogWriter::create(&path_in(&folder), &METADATA).unwrap();
    log.sample(0.0, "audit", &[("mass_kg", 1.0), ("energy_J", 2.0)])
        .unwrap();
    let swapped = log.sample(0.1, "audit", &[("energy_J", 2.0), ("mass_kg", 1.0)]);
    assert_eq!(
        swapped.unwrap_err().to_string(),
        r#"channel "audit": a sample names ["energy_J", "mass_kg"], expected ["mass_kg", "energy_J"]"#
    );
    let doubled = log.sample(0.0, "gauge", &[("p_Pa", 1.0), ("p_Pa", 2.0)]);
    assert!(matches!(doubled, Err(LogError::Names { .. })));
    for channel in ["", "/audit", "fluid", "tf"] {
        let refused = log.sample(0.0, channel, &[("p_Pa", 1.0)]);
        assert!(
            matches!(&refused, Err(LogError::Channel { channel: c, .. }) if c == channel),
            "{channel:?}: {refused:?}"
        );
    }
}

#[test]
fn a_log_that_cannot_be_created_names_the_file() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("missing").join("log.mcap");
    let Err(error) = LogWriter::create(&path, &METADATA) else {
        panic!("a log in a folder that does not exist");
    };
    assert!(matches!(&error, LogError::Create { path: p, .. } if *p == path));
    assert!(error.to_string().contains("missing"), "{error}");
}
