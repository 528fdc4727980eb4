#!/usr/bin/env python3
"""Reads a log of splashdown with the `mcap` package of PyPI, independent of the writer.

    python read_log.py LOG [--truncated]

Every message is decoded and checked: protobuf by the schemas in the file, JSON against the names
in its schema, point clouds unpacked, every number finite (a sample may hold null instead).
Prints one line of JSON about what was read; exits with 1 and a message if anything is wrong.

A log must be complete, unless --truncated says that the run was killed: then the file may end
in the middle of a record, and everything before that record is read and checked all the same.
"""

import argparse
import json
import math
import os
import struct
import sys
import zlib
from collections import Counter
from itertools import chain

from google.protobuf.message import DecodeError
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.reader import SeekingReader
from mcap.records import Attachment, Channel, Chunk, Message, Metadata, Schema
from mcap.stream_reader import MAGIC_SIZE, StreamReader, breakup_chunk
from mcap_protobuf.decoder import DecoderFactory
from zstandard import ZstdError

SCHEMAS = {
    "/fluid": "foxglove.PointCloud",
    "/walls": "foxglove.PointCloud",
    "/scene": "foxglove.SceneUpdate",
    "/tf": "foxglove.FrameTransforms",
    "/log": "foxglove.Log",
}
RESOLVED_SCENE = "scene.resolved.toml"
POINT_FIELDS = ["x", "y", "z", "pressure", "speed", "density", "spacing", "id", "vx", "vy"]
# foxglove.PackedElementField.NumericType, as the struct module writes it.
NUMERIC_TYPES = {1: "B", 2: "b", 3: "H", 4: "h", 5: "I", 6: "i", 7: "f", 8: "d"}
RECORD_HEADER = struct.Struct("<BQ")
# Start of the summary, start of its offsets, CRC-32 of the summary.
FOOTER = struct.Struct("<QQI")
CRC_SIZE = 4


class Defect(Exception):
    """Something in the log is not as it should be."""


def require(condition, defect):
    if not condition:
        raise Defect(defect)


class Log:
    """What a log holds, checked as it is added."""

    def __init__(self):
        self.schemas = {}
        self.channels = {}
        self.decoders = {}
        self.factory = DecoderFactory()
        self.counts = Counter()
        self.nulls = 0
        self.times = []
        self.metadata = {}
        self.attachments = {}

    def add(self, record):
        if isinstance(record, Schema):
            self.schemas[record.id] = record
        elif isinstance(record, Channel):
            self.add_channel(record)
        elif isinstance(record, Message):
            self.add_message(record)
        elif isinstance(record, Metadata):
            self.metadata[record.name] = record.metadata
        elif isinstance(record, Attachment):
            self.attachments[record.name] = record.data

    def add_channel(self, channel):
        schema = self.schemas[channel.schema_id]
        if channel.topic in SCHEMAS:
            require(
                schema.name == SCHEMAS[channel.topic],
                f"{channel.topic}: schema {schema.name}, not {SCHEMAS[channel.topic]}",
            )
            decoder = self.factory.decoder_for(channel.message_encoding, schema)
            require(decoder, f"{channel.topic}: encoding {channel.message_encoding}")
        else:
            require(
                (channel.message_encoding, schema.encoding) == ("json", "jsonschema"),
                f"{channel.topic}: {channel.message_encoding} with {schema.encoding}",
            )
            decoder = sample_decoder(schema)
        self.channels[channel.id] = channel
        self.decoders[channel.id] = decoder

    def add_message(self, message):
        topic = self.channels[message.channel_id].topic
        where = f"{topic} at {message.log_time} ns"
        require(
            message.publish_time == message.log_time,
            f"{where}: published at {message.publish_time} ns",
        )
        require(
            message.sequence == self.counts[topic],
            f"{where}: number {message.sequence}, not {self.counts[topic]}",
        )
        content = self.decoders[message.channel_id](message.data)
        if topic in SCHEMAS:
            CHECKS[SCHEMAS[topic]](content, message.log_time, where)
        else:
            self.nulls += check_sample(content, where)
        self.counts[topic] += 1
        first, last = self.times or (message.log_time, message.log_time)
        self.times = [min(first, message.log_time), max(last, message.log_time)]

    def check_scene(self):
        """The resolved scene is there, twice the same; the program has a version."""
        for key in ("scene", "version"):
            require(key in self.metadata.get("splashdown", {}), f"metadata: no {key}")
        require(RESOLVED_SCENE in self.attachments, f"no attachment {RESOLVED_SCENE}")
        require(
            self.metadata.get(RESOLVED_SCENE, {}).get("toml", "").encode()
            == self.attachments[RESOLVED_SCENE],
            f"{RESOLVED_SCENE}: metadata and attachment differ",
        )


def sample_decoder(schema):
    names = set(json.loads(schema.data)["properties"])

    def refuse(word):
        raise Defect(f"{schema.name}: {word} is not JSON")

    def decode(data):
        sample = json.loads(data, parse_constant=refuse)
        require(
            set(sample) == names,
            f"{schema.name}: names {sorted(sample)}, not {sorted(names)}",
        )
        return sample

    return decode


def check_sample(sample, where):
    """Numbers are finite; returns how many are null in their place."""
    for name, value in sample.items():
        is_number = type(value) in (int, float) and math.isfinite(value)
        require(value is None or is_number, f"{where}: {name} = {value!r}")
    return list(sample.values()).count(None)


def check_timestamp(content, time, where):
    stamp = content.timestamp.ToNanoseconds()
    require(stamp == time, f"{where}: timestamp {stamp} ns")


def check_cloud(cloud, time, where):
    check_timestamp(cloud, time, where)
    require(cloud.frame_id == "world", f"{where}: frame {cloud.frame_id}")
    names = [field.name for field in cloud.fields]
    require(names == POINT_FIELDS, f"{where}: fields {names}, not {POINT_FIELDS}")
    point = struct.Struct("<")
    for field in cloud.fields:
        require(
            field.offset == point.size,
            f"{where}: {field.name} at byte {field.offset}, not {point.size}",
        )
        point = struct.Struct(point.format + NUMERIC_TYPES[field.type])
    require(
        cloud.point_stride == point.size,
        f"{where}: stride {cloud.point_stride}, not {point.size}",
    )
    require(
        len(cloud.data) % point.size == 0,
        f"{where}: {len(cloud.data)} bytes are no whole number of points",
    )
    if all(map(math.isfinite, chain.from_iterable(point.iter_unpack(cloud.data)))):
        return
    for i, values in enumerate(point.iter_unpack(cloud.data)):
        for name, value in zip(names, values):
            require(math.isfinite(value), f"{where}: {name} of point {i} is {value}")


def check_scene_update(scene, time, where):
    for entity in scene.entities:
        check_timestamp(entity, time, where)
        require(entity.lines, f"{where}: {entity.id} has no outline")
        for point in chain.from_iterable(line.points for line in entity.lines):
            require(
                all(map(math.isfinite, (point.x, point.y, point.z))),
                f"{where}: {entity.id} has a corner at ({point.x}, {point.y}, {point.z})",
            )


def check_transforms(transforms, time, where):
    for transform in transforms.transforms:
        check_timestamp(transform, time, where)
        name, at, turn = transform.child_frame_id, transform.translation, transform.rotation
        require(
            transform.parent_frame_id == "world",
            f"{where}: {name} in {transform.parent_frame_id}",
        )
        require(
            all(map(math.isfinite, (at.x, at.y, at.z))),
            f"{where}: {name} at ({at.x}, {at.y}, {at.z})",
        )
        norm = math.hypot(turn.x, turn.y, turn.z, turn.w)
        require(abs(norm - 1.0) < 1e-12, f"{where}: {name} turned by a quaternion of norm {norm}")


def check_note(note, time, where):
    check_timestamp(note, time, where)
    require(note.level != 0, f"{where}: no level")
    require(note.message, f"{where}: no text")


CHECKS = {
    "foxglove.PointCloud": check_cloud,
    "foxglove.SceneUpdate": check_scene_update,
    "foxglove.FrameTransforms": check_transforms,
    "foxglove.Log": check_note,
}


def whole_records(file):
    """The length of the file up to its last whole record, and whether that one is the footer."""
    size = file.seek(0, os.SEEK_END)
    end, opcode = MAGIC_SIZE, None
    while opcode != Opcode.FOOTER and end + RECORD_HEADER.size <= size:
        file.seek(end)
        next_opcode, length = RECORD_HEADER.unpack(file.read(RECORD_HEADER.size))
        if end + RECORD_HEADER.size + length > size:
            break
        end, opcode = end + RECORD_HEADER.size + length, next_opcode
    return end, opcode == Opcode.FOOTER


def read(file, end, complete):
    """Reads the records before `end` in file order, as a stream; needs no summary."""
    log = Log()
    file.seek(0)
    for record in StreamReader(file, emit_chunks=True, validate_crcs=True).records:
        if isinstance(record, Chunk):
            for inner in breakup_chunk(record, validate_crc=True):
                log.add(inner)
        else:
            log.add(record)
        if not complete and file.tell() >= end:
            break
    return log


def check_summary(file, log):
    """The summary agrees with the stream, and its index leads to every message."""
    file.seek(0)
    reader = SeekingReader(file, validate_crcs=True)
    summary = reader.get_summary()
    require(summary and summary.statistics, "no summary")
    file.seek(-MAGIC_SIZE - RECORD_HEADER.size - FOOTER.size, os.SEEK_END)
    footer = file.tell()
    summary_start, _, crc = FOOTER.unpack(file.read()[RECORD_HEADER.size : -MAGIC_SIZE])
    # The sum covers the summary and the footer up to the sum itself.
    file.seek(summary_start)
    covered = file.read(footer + RECORD_HEADER.size + FOOTER.size - CRC_SIZE - summary_start)
    require(zlib.crc32(covered) == crc, f"summary CRC {zlib.crc32(covered):08x}, not {crc:08x}")
    topics = {channel.id: channel.topic for channel in summary.channels.values()}
    counted = summary.statistics.channel_message_counts
    indexed = Counter(
        channel.topic for _, channel, _ in reader.iter_messages(log_time_order=False)
    )
    for name, counts in (
        ("statistics", {topics[id]: count for id, count in counted.items()}),
        ("indexes", dict(indexed)),
    ):
        require(counts == dict(log.counts), f"{name}: {counts}, not {dict(log.counts)}")
    for kind, indexes, names in (
        ("attachment", summary.attachment_indexes, log.attachments),
        ("metadata", summary.metadata_indexes, log.metadata),
    ):
        found = {index.name for index in indexes}
        require(found == set(names), f"{kind} indexes: {found}, not {set(names)}")


def read_log(path, truncated):
    with open(path, "rb") as file:
        end, has_footer = whole_records(file)
        size = os.fstat(file.fileno()).st_size
        require(end > MAGIC_SIZE, f"no whole record in {size} bytes")
        complete = has_footer and size == end + MAGIC_SIZE
        require(
            complete or truncated,
            f"incomplete: whole records end at byte {end} of {size} (see --truncated)",
        )
        log = read(file, end, complete)
        require(log.counts, f"no whole message in {size} bytes")
        log.check_scene()
        if complete:
            check_summary(file, log)
    first, last = log.times
    return {
        "complete": complete,
        "counts": dict(sorted(log.counts.items())),
        "first_time_s": first / 1e9,
        "last_time_s": last / 1e9,
        "nulls": log.nulls,
        "metadata": sorted(log.metadata),
        "attachments": sorted(log.attachments),
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("log", metavar="LOG")
    parser.add_argument("--truncated", action="store_true", help="the run was killed")
    arguments = parser.parse_args()
    defects = (Defect, McapError, DecodeError, ZstdError, OSError, ValueError, KeyError)
    try:
        report = read_log(arguments.log, arguments.truncated)
    except (*defects, struct.error) as defect:
        kind = "" if isinstance(defect, Defect) else f"{type(defect).__name__}: "
        sys.exit(f"{arguments.log}: {kind}{defect}")
    print(json.dumps(report))


if __name__ == "__main__":
    main()
