//! What a log needs to be continued: how far its file is, and what is not in it yet; and the way back to there.

use std::collections::HashMap;
use std::fs::File;
use std::io::{self, BufReader, Read};
use std::path::Path;

use mcap::McapError;
use mcap::read::ChunkReader;
use mcap::records::Record;
use mcap::sans_io::linear_reader::{LinearReadEvent, LinearReader, LinearReaderOptions};
use serde::{Deserialize, Serialize};

use super::error::LogError;
use super::writer::LogWriter;

/// A sample on its way to the file.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Sample {
    pub time: f64,
    pub channel: String,
    pub values: Vec<(String, f64)>,
}

/// A log at one moment. Its file may have grown since, or have been finished: what it held then is its beginning.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct StoredLog {
    pub(super) standing: LogStanding,
    /// Samples that no frame or note has taken to the file.
    pub(super) pending: Vec<Sample>,
}

/// How far the file of a log is.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct LogStanding {
    /// Messages in it, whole chunks.
    pub messages: u64,
    /// Size of the file before any frame [bytes], once a budget has asked for it.
    pub start: Option<u64>,
    /// Frames in it.
    pub frames: u64,
    /// Frames left out.
    pub left_out: u64,
    /// Channels of samples with their names, in the order in which they were added.
    pub channels: Vec<(String, Vec<String>)>,
}

/// Writes what the file `path` held at `standing` into a new log, message by message, in the same chunks: with the same scene the new
/// file has the same bytes.
pub(super) fn replay(path: &Path, standing: &LogStanding, log: &mut LogWriter) -> Result<(), LogError> {
    let wrong = |cause: String| LogError::Read(path.to_owned(), cause);
    let failed = |error: io::Error| wrong(error.to_string());
    let file = File::open(path).map_err(failed)?;
    let length = file.metadata().map_err(failed)?.len() as usize;
    let options = LinearReaderOptions::default().with_skip_end_magic(true).with_emit_chunks(true);
    let mut reader = LinearReader::new_with_options(options.with_record_length_limit(length));
    let (mut file, mut topics) = (BufReader::new(file), HashMap::new());
    while log.messages() < standing.messages {
        let Some(event) = reader.next_event() else { break };
        match event.map_err(|error| wrong(error.to_string()))? {
            LinearReadEvent::ReadRequest(need) => {
                let read = file.read(reader.insert(need)).map_err(failed)?;
                if read == 0 {
                    break;
                }
                reader.notify_read(read);
            }
            LinearReadEvent::Record { opcode, data } => {
                let record = mcap::parse_record(opcode, data).map_err(|error| wrong(error.to_string()))?;
                if let Record::Chunk { header, data } = record {
                    let records = ChunkReader::new(header, &data).map_err(|error| wrong(error.to_string()))?;
                    replay_chunk(records, &mut topics, standing, log, &wrong)?;
                }
            }
        }
    }
    match log.messages() {
        found if found == standing.messages => Ok(()),
        found => Err(wrong(format!("it has {found} messages up to the checkpoint, expected {}", standing.messages))),
    }
}

fn replay_chunk<'a>(
    records: impl Iterator<Item = Result<Record<'a>, McapError>>,
    topics: &mut HashMap<u16, String>,
    standing: &LogStanding,
    log: &mut LogWriter,
    wrong: &impl Fn(String) -> LogError,
) -> Result<(), LogError> {
    for record in records {
        match record.map_err(|error| wrong(error.to_string()))? {
            Record::Channel(channel) => {
                topics.insert(channel.id, channel.topic);
            }
            Record::Message { header, data } => {
                let topic = topics.get(&header.channel_id).ok_or_else(|| wrong("a message without a topic".into()))?;
                let channel = topic.strip_prefix('/').unwrap_or(topic);
                let names = standing.channels.iter().find(|(known, _)| known == channel).map(|(_, names)| &names[..]);
                log.repeat(topic, names, header.log_time, &data)?;
            }
            _ => {}
        }
    }
    log.flush()
}
