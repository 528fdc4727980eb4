//! What is written is what is read.

use std::collections::BTreeMap;

use foxglove::Decode;
use foxglove::messages::{FrameTransforms, Log, PointCloud, SceneUpdate, log};
use mcap::{MessageStream, Summary};
use temp_dir::TempDir;

use super::{FRAMES, METADATA, complete_log, path_in, row};

const POINT_SIZE: usize = 40;

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
    messages.iter().map(|(_, data)| M::decode(data.as_slice()).expect("the message matches its type")).collect()
}

#[test]
fn every_message_carries_simulated_time_and_its_place() {
    let folder = TempDir::new().unwrap();
    let log = complete_log(&path_in(&folder));
    let mut counts = BTreeMap::new();
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
    let fields: Vec<(&str, u32)> = cloud.fields.iter().map(|field| (field.name.as_str(), field.offset)).collect();
    let names = ["x", "y", "z", "pressure", "speed", "density", "spacing", "id", "vx", "vy"];
    assert_eq!(fields, names.into_iter().zip((0..).step_by(4)).collect::<Vec<_>>());

    let row = row(50, k);
    assert_eq!(cloud.data.len(), row.len() * POINT_SIZE);
    for (i, point) in cloud.data.chunks_exact(POINT_SIZE).enumerate() {
        let word = |j: usize| <[u8; 4]>::try_from(&point[4 * j..4 * j + 4]).unwrap();
        let floats: Vec<f32> = (0..7).map(|j| f32::from_le_bytes(word(j))).collect();
        let [u, v] = row[i].velocity;
        let speed = (u * u + v * v).sqrt();
        let expected = [row[i].at[0], row[i].at[1], 0.0, row[i].pressure, speed, row[i].density, row[i].spacing];
        assert_eq!(floats, expected.map(|value| value as f32));
        assert_eq!(u32::from_le_bytes(word(7)), row[i].id);
        assert_eq!([8, 9].map(|j| f32::from_le_bytes(word(j))), [u as f32, v as f32]);
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
    assert_eq!(String::from_utf8_lossy(&samples[1].1), r#"{"y_m":0.30000000000000004,"force_y_N":null}"#);

    let summary = Summary::read(&log).unwrap().expect("a summary");
    let channel = summary.channels.values().find(|channel| channel.topic == "/body/wedge").expect("the channel");
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
    assert_eq!(notes[0].level(), log::Level::Warning);
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

    let mut records = summary.metadata_indexes.iter().map(|index| mcap::read::metadata(&log, index).unwrap());
    let program = records.next().expect("the program");
    assert_eq!(program.name, "splashdown");
    assert_eq!(program.metadata["scene"], "wedge");
    assert_eq!(program.metadata["version"], "0.1.0");
    let scene = records.next().expect("the scene");
    assert_eq!(scene.name, "scene.resolved.toml");
    assert_eq!(scene.metadata["toml"], METADATA.scene_toml);
}
