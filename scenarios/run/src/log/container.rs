//! The MCAP file: metadata, attachments, topics, chunks.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::BufWriter;
use std::marker::PhantomData;
use std::path::{Path, PathBuf};

use foxglove::messages::Timestamp;
use foxglove::{Encode, Schema};
use mcap::records::{MessageHeader, Metadata};
use mcap::write::NoSeek;
use mcap::{Attachment, Compression, McapResult, WriteOptions};

use super::error::LogError;

/// Level of compression: at 3, the usual one, packed particles take more than twice the time and come out half a per cent smaller.
const LEVEL: u32 = 1;

/// Nanoseconds of a second.
const NANOSECONDS: u64 = 1_000_000_000;

/// A topic and the number of messages it holds.
pub(super) struct Topic {
    id: u16,
    messages: u32,
}

/// A topic whose messages are all of the Foxglove type `M`.
pub(super) struct TypedTopic<M> {
    topic: Topic,
    message: PhantomData<M>,
}

impl Topic {
    /// Its number in the file: topics are numbered as they are added.
    pub(super) fn id(&self) -> u16 {
        self.id
    }
}

impl<M> TypedTopic<M> {
    /// The topic without its type.
    pub(super) fn untyped(&mut self) -> &mut Topic {
        &mut self.topic
    }
}

/// An MCAP file open for writing, which never seeks: what is in the file stays as it is.
pub(super) struct Container {
    path: PathBuf,
    messages: u64,
    writer: mcap::Writer<NoSeek<BufWriter<File>>>,
}

impl Container {
    /// Creates the file, replacing one that is there, for the program `library`.
    pub(super) fn create(path: &Path, library: &str) -> Result<Self, LogError> {
        let file = File::create(path).map_err(|source| LogError::Create(path.to_owned(), source))?;
        // No chunk size: chunks end with `flush` alone, so that none holds half a frame.
        let writer = WriteOptions::new()
            .library(format!("{library} {}", mcap::LIBRARY_IDENTIFIER))
            .compression(Some(Compression::Zstd))
            .compression_threads(0)
            .compression_level(LEVEL)
            .chunk_size(None)
            .disable_seeking(true)
            .create(NoSeek::new(BufWriter::new(file)));
        Ok(Self { writer: at_path(path, writer)?, messages: 0, path: path.to_owned() })
    }

    /// Writes a metadata record.
    pub(super) fn metadata(&mut self, name: &str, entries: &[(&str, &str)]) -> Result<(), LogError> {
        let metadata = Metadata {
            name: name.to_owned(),
            metadata: entries.iter().map(|&(key, value)| (key.to_owned(), value.to_owned())).collect(),
        };
        at_path(&self.path, self.writer.write_metadata(&metadata))
    }

    /// Attaches a text, dated at the start of simulated time.
    pub(super) fn attach(&mut self, name: &str, media_type: &str, text: &str) -> Result<(), LogError> {
        let attachment = Attachment {
            log_time: 0,
            create_time: 0,
            name: name.to_owned(),
            media_type: media_type.to_owned(),
            data: Cow::Borrowed(text.as_bytes()),
        };
        at_path(&self.path, self.writer.attach(&attachment))
    }

    /// Adds a topic with messages of `encoding`.
    pub(super) fn add(&mut self, topic: &str, encoding: &str, schema: &Schema) -> Result<Topic, LogError> {
        let id = self
            .writer
            .add_schema(&schema.name, &schema.encoding, &schema.data)
            .and_then(|schema| self.writer.add_channel(schema, topic, encoding, &BTreeMap::new()));
        Ok(Topic { id: at_path(&self.path, id)?, messages: 0 })
    }

    /// Adds a topic with messages of the Foxglove type `M`.
    pub(super) fn add_typed<M: Encode>(&mut self, topic: &str) -> Result<TypedTopic<M>, LogError> {
        let schema = M::get_schema().expect("every Foxglove message has a schema");
        Ok(TypedTopic { topic: self.add(topic, &M::get_message_encoding(), &schema)?, message: PhantomData })
    }

    /// Adds an encoded message to the open chunk.
    pub(super) fn write(&mut self, topic: &mut Topic, stamp: Timestamp, message: &[u8]) -> Result<(), LogError> {
        let header = MessageHeader {
            channel_id: topic.id,
            sequence: topic.messages,
            log_time: stamp.total_nanos(),
            publish_time: stamp.total_nanos(),
        };
        at_path(&self.path, self.writer.write_to_known_channel(&header, message))?;
        topic.messages = topic.messages.wrapping_add(1);
        self.messages += 1;
        Ok(())
    }

    /// Adds a message of an earlier file to the open chunk.
    pub(super) fn repeat(&mut self, topic: &mut Topic, time: u64, message: &[u8]) -> Result<(), LogError> {
        let stamp = Timestamp::new((time / NANOSECONDS) as u32, (time % NANOSECONDS) as u32);
        self.write(topic, stamp, message)
    }

    /// Messages so far, those of the open chunk too.
    pub(super) fn messages(&self) -> u64 {
        self.messages
    }

    /// The file takes another name, in place of a file that has it.
    pub(super) fn rename(&mut self, path: &Path) -> Result<(), LogError> {
        at_path(path, std::fs::rename(&self.path, path).map_err(Into::into))?;
        self.path = path.to_owned();
        Ok(())
    }

    /// Adds a Foxglove message to the open chunk.
    pub(super) fn write_typed<M: Encode>(
        &mut self,
        topic: &mut TypedTopic<M>,
        stamp: Timestamp,
        message: &M,
    ) -> Result<(), LogError> {
        let mut bytes = Vec::with_capacity(message.encoded_len().unwrap_or(0));
        message.encode(&mut bytes).expect("a vector has room for any message");
        self.write(&mut topic.topic, stamp, &bytes)
    }

    /// Ends the open chunk and hands it to the operating system.
    pub(super) fn flush(&mut self) -> Result<(), LogError> {
        at_path(&self.path, self.writer.flush())
    }

    /// Ends the file and returns its length [bytes].
    pub(super) fn finish(mut self) -> Result<u64, LogError> {
        at_path(&self.path, self.writer.finish())?;
        let file = self.writer.into_inner().into_inner();
        let length = file.get_ref().metadata().map(|metadata| metadata.len());
        at_path(&self.path, length.map_err(Into::into))
    }
}

/// Says which file refused a write.
fn at_path<T>(path: &Path, result: McapResult<T>) -> Result<T, LogError> {
    result.map_err(|source| LogError::Write(path.to_owned(), source))
}
