//! Reads frames back from a log, also from one that was cut.
//!
//! The file is walked by the lengths of its records, so that only the frames asked for are read and decompressed, one at a time.

use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::Path;

use foxglove::Decode;
use foxglove::messages::{FrameTransforms, PointCloud, SceneUpdate};
use mcap::read::ChunkReader;
use mcap::records::{ChunkHeader, Record};

use super::frame::{Frame, POINT_SIZE, Point, unpack};

/// Bytes before the first record.
pub(super) const MAGIC: u64 = 8;
/// Kinds of records that matter here (MCAP specification, opcodes).
const CHUNK: u8 = 0x06;
const MESSAGE_INDEX: u8 = 0x07;
const DATA_END: u8 = 0x0f;
/// Bytes of a chunk's header, at most: the name of a compression is short.
const HEADER: u64 = 256;

/// A log open for reading.
pub struct LogReader {
    file: BufReader<File>,
    chunks: Vec<Chunk>,
    topics: Vec<(u16, String)>,
}

/// A frame read from a log.
pub struct LoggedFrame {
    /// Time since the start of the run [s].
    pub time: f64,
    fluid: PointCloud,
    walls: PointCloud,
    /// The bodies.
    pub bodies: Vec<LoggedBody>,
}

/// A body in a frame read from a log.
pub struct LoggedBody {
    /// Its name.
    pub name: String,
    /// Origin of its frame in space [m].
    pub position: [f64; 2],
    /// Angle of its frame [rad].
    pub angle: f64,
    /// Its outline in space, closed polygons [m].
    pub loops: Vec<Vec<[f64; 2]>>,
}

impl LoggedBody {
    /// A point of its frame in space: x + R(angle)·p [m].
    pub fn point(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = self.angle.sin_cos();
        [self.position[0] + cos * x - sin * y, self.position[1] + sin * x + cos * y]
    }
}

impl LoggedFrame {
    /// A picture as it would be read back.
    pub fn of(frame: &Frame) -> LoggedFrame {
        let Frame { time, fluid, walls, scene, tf, .. } = frame;
        LoggedFrame { time: *time, fluid: fluid.clone(), walls: walls.clone(), bodies: bodies(scene, tf) }
    }

    /// The particles of the fluid; of a symmetric run with their images.
    pub fn fluid(&self) -> impl Iterator<Item = Point> + '_ {
        points(&self.fluid)
    }

    /// The particles of the walls; of a symmetric run with their images.
    pub fn walls(&self) -> impl Iterator<Item = Point> + '_ {
        points(&self.walls)
    }
}

pub(super) struct Chunk {
    pub header: ChunkHeader,
    /// Where its data begins in the file [bytes].
    pub data: u64,
    channels: Vec<u16>,
}

impl LogReader {
    /// The frames of a log, as many as are whole; `None` where the file is not there, or no log.
    pub fn open(path: &Path) -> Option<LogReader> {
        let mut file = BufReader::new(File::open(path).ok()?);
        let mut magic = [0; MAGIC as usize];
        file.read_exact(&mut magic).ok()?;
        if &magic[1..5] != b"MCAP" {
            return None;
        }
        let chunks = chunks(&mut file).ok()?;
        let mut reader = LogReader { file, chunks, topics: Vec::new() };
        for k in 0..reader.chunks.len() {
            reader.read_topics(k);
            if reader.topics.iter().any(|(_, topic)| topic == "/fluid") {
                break;
            }
        }
        let fluid = reader.topics.iter().find(|(_, topic)| topic == "/fluid").map(|(id, _)| *id);
        reader.chunks.retain(|chunk| fluid.is_some_and(|id| chunk.channels.contains(&id)));
        Some(reader)
    }

    /// Times of the frames since the start of the run [s].
    pub fn times(&self) -> Vec<f64> {
        self.chunks.iter().map(|chunk| 1e-9 * chunk.header.message_end_time as f64).collect()
    }

    /// The frame with an index below the number of times; `None` where it is damaged.
    pub fn frame(&mut self, index: usize) -> Option<LoggedFrame> {
        let time = 1e-9 * self.chunks.get(index)?.header.message_end_time as f64;
        let bytes = self.bytes(index)?;
        let mut found =
            LoggedFrame { time, fluid: PointCloud::default(), walls: PointCloud::default(), bodies: vec![] };
        let (mut scene, mut tf) = (None, None);
        for record in ChunkReader::new(self.chunks[index].header.clone(), &bytes).ok()? {
            match record.ok()? {
                Record::Message { header, data } => match self.topic(header.channel_id) {
                    "/fluid" => found.fluid = PointCloud::decode(data.as_ref()).ok()?,
                    "/walls" => found.walls = PointCloud::decode(data.as_ref()).ok()?,
                    "/scene" => scene = SceneUpdate::decode(data.as_ref()).ok(),
                    "/tf" => tf = FrameTransforms::decode(data.as_ref()).ok(),
                    _ => {}
                },
                Record::Channel(channel) => self.add_topic(channel.id, channel.topic),
                _ => {}
            }
        }
        found.bodies = bodies(&scene?, &tf?);
        Some(found)
    }

    fn topic(&self, id: u16) -> &str {
        self.topics.iter().find(|(own, _)| *own == id).map_or("", |(_, topic)| topic)
    }

    fn add_topic(&mut self, id: u16, topic: String) {
        if self.topic(id).is_empty() {
            self.topics.push((id, topic));
        }
    }

    fn read_topics(&mut self, index: usize) {
        let Some(bytes) = self.bytes(index) else { return };
        let Ok(records) = ChunkReader::new(self.chunks[index].header.clone(), &bytes) else { return };
        for record in records.map_while(Result::ok) {
            if let Record::Channel(channel) = record {
                self.add_topic(channel.id, channel.topic);
            }
        }
    }

    /// Compressed bytes of a chunk.
    fn bytes(&mut self, index: usize) -> Option<Vec<u8>> {
        let Chunk { header, data, .. } = &self.chunks[index];
        let mut bytes = vec![0; usize::try_from(header.compressed_size).ok()?];
        self.file.seek(SeekFrom::Start(*data)).ok()?;
        self.file.read_exact(&mut bytes).ok()?;
        Some(bytes)
    }
}

/// The whole chunks of a file.
pub(super) fn chunks(file: &mut BufReader<File>) -> std::io::Result<Vec<Chunk>> {
    let end = file.get_ref().metadata()?.len();
    let (mut at, mut chunks) = (MAGIC, Vec::<Chunk>::new());
    while at + 9 <= end {
        let mut head = [0; 9];
        file.read_exact(&mut head)?;
        let (kind, body) = (head[0], at + 9);
        let Some(next) = body.checked_add(number(&head[1..])).filter(|next| *next <= end) else { break };
        match kind {
            CHUNK => {
                let mut bytes = vec![0; (next - body).min(HEADER) as usize];
                file.read_exact(&mut bytes)?;
                let header = chunk_header(&bytes).filter(|(header, length)| {
                    length.checked_add(header.compressed_size).is_some_and(|size| size <= next - body)
                });
                chunks.extend(header.map(|(header, length)| Chunk {
                    header,
                    data: body + length,
                    channels: Vec::new(),
                }));
            }
            MESSAGE_INDEX if next - body >= 2 => {
                let mut id = [0; 2];
                file.read_exact(&mut id)?;
                chunks.iter_mut().last().into_iter().for_each(|chunk| chunk.channels.push(u16::from_le_bytes(id)));
            }
            DATA_END => break,
            _ => {}
        }
        let here = file.stream_position()?;
        file.seek_relative((next - here) as i64)?;
        at = next;
    }
    Ok(chunks)
}

/// The header of a chunk, and its length [bytes].
fn chunk_header(bytes: &[u8]) -> Option<(ChunkHeader, u64)> {
    let name = number(bytes.get(28..32)?) as usize;
    let size = bytes.get(32 + name..40 + name)?;
    let header = ChunkHeader {
        message_start_time: number(&bytes[..8]),
        message_end_time: number(&bytes[8..16]),
        uncompressed_size: number(&bytes[16..24]),
        uncompressed_crc: number(&bytes[24..28]) as u32,
        compression: String::from_utf8(bytes[32..32 + name].to_vec()).ok()?,
        compressed_size: number(size),
    };
    Some((header, 40 + name as u64))
}

/// An unsigned number, little-endian.
fn number(bytes: &[u8]) -> u64 {
    bytes.iter().rev().fold(0, |sum, byte| sum << 8 | u64::from(*byte))
}

fn points(cloud: &PointCloud) -> impl Iterator<Item = Point> + '_ {
    let usual = cloud.point_stride as usize == POINT_SIZE;
    cloud.data.chunks_exact(POINT_SIZE).take_while(move |_| usual).map(unpack)
}

/// The bodies in space.
fn bodies(scene: &SceneUpdate, tf: &FrameTransforms) -> Vec<LoggedBody> {
    let of = |entity: &foxglove::messages::SceneEntity| {
        let moved = tf.transforms.iter().find(|t| t.child_frame_id == entity.frame_id)?;
        let mut body = LoggedBody {
            name: entity.id.strip_prefix("body/").unwrap_or(&entity.id).to_string(),
            position: moved.translation.as_ref().map_or([0.0; 2], |t| [t.x, t.y]),
            angle: moved.rotation.as_ref().map_or(0.0, |q| 2.0 * q.z.atan2(q.w)),
            loops: Vec::new(),
        };
        let points: Vec<[f64; 2]> = entity.lines.first()?.points.iter().map(|p| body.point([p.x, p.y])).collect();
        body.loops = loops(&points);
        Some(body)
    };
    scene.entities.iter().filter_map(of).collect()
}

/// The loops of a line that visits each and returns to the first corner of all in between.
fn loops(points: &[[f64; 2]]) -> Vec<Vec<[f64; 2]>> {
    let (mut from, mut loops) = (0, Vec::new());
    while from < points.len() {
        let back = points[from + 1..].iter().position(|p| *p == points[from]).map(|k| from + 1 + k);
        loops.push(points[from..back.unwrap_or(points.len())].to_vec());
        from = back.map_or(points.len(), |back| back + 2);
    }
    loops
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn loops_that_were_joined_come_apart() {
        let (a, b) = ([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], [[5.0, 5.0], [6.0, 5.0], [5.0, 6.0]]);
        let joined = [&a[..], &a[..1], &a[..1], &b[..], &b[..1], &a[..1]].concat();
        assert_eq!(loops(&joined), [a.to_vec(), b.to_vec()]);
        assert_eq!(loops(&a), [a.to_vec()]);
        assert!(loops(&[]).is_empty());
    }
}
