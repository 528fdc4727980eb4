//! Reads the samples of a channel back from a log, also from one that was cut.

use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::path::Path;

use mcap::read::ChunkReader;
use mcap::records::Record;
use serde_json::{Map, Value};

use super::reader::{MAGIC, chunks};

/// Samples of a channel, in order of time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Samples {
    /// Times since the start of the run [s].
    pub times: Vec<f64>,
    /// A row per time, in the order of the names.
    pub rows: Vec<Vec<f64>>,
}

/// The samples of a channel, as far as chunks are whole, with the numbers of these names; a number that was not finite is NaN. Samples
/// with other names are left out.
///
/// # Errors
/// The file cannot be read.
pub fn read_samples(path: &Path, channel: &str, names: &[String]) -> io::Result<Samples> {
    let topic = format!("/{channel}");
    let mut file = BufReader::new(File::open(path)?);
    file.read_exact(&mut [0; MAGIC as usize])?;
    let (mut id, mut found) = (None, Samples::default());
    for chunk in chunks(&mut file)? {
        let Ok(size) = usize::try_from(chunk.header.compressed_size) else { break };
        let mut bytes = vec![0; size];
        file.seek(SeekFrom::Start(chunk.data))?;
        file.read_exact(&mut bytes)?;
        let Ok(records) = ChunkReader::new(chunk.header, &bytes) else { continue };
        for record in records.map_while(Result::ok) {
            match record {
                Record::Channel(channel) if channel.topic == topic => id = Some(channel.id),
                Record::Message { header, data } if Some(header.channel_id) == id => {
                    let Some(row) = row(&data, names) else { continue };
                    found.times.push(1e-9 * header.log_time as f64);
                    found.rows.push(row);
                }
                _ => {}
            }
        }
    }
    Ok(found)
}

fn row(message: &[u8], names: &[String]) -> Option<Vec<f64>> {
    let sample: Map<String, Value> = serde_json::from_slice(message).ok()?;
    let number = |name: &String| sample.get(name).map(|value| value.as_f64().unwrap_or(f64::NAN));
    names.iter().map(number).collect()
}
