//! A log that is cut short keeps what was written before.

use std::fs;

use mcap::{McapError, Summary};
use run::log::{Level, LogWriter};
use temp_dir::TempDir;

use super::{FRAMES, MESSAGES_PER_FRAME, METADATA, complete_log, path_in, stream, time_of, write_frame};

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
    log.sample(time_of(FRAMES), "audit", &[("mass_kg", 999.0)]).unwrap();
    log.note(time_of(FRAMES), Level::Fatal, "diverged").unwrap();
    log.sample(time_of(FRAMES), "audit", &[("mass_kg", 998.0)]).unwrap();

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
