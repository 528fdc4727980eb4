//! The log on a thread of its own.

use std::io::Read;
use std::path::Path;
use std::sync::Barrier;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};
use std::{fs, thread};

use run::log::{BackgroundLog, Budget, Frame, Level, LogError, Logged};
use temp_dir::TempDir;

use super::{FRAMES, METADATA, complete_log, path_in, picture, row, samples, stream, time_of};

fn create(path: &Path, budget: Option<Budget>) -> BackgroundLog {
    BackgroundLog::create(path, &METADATA, budget).expect("the log is created")
}

fn write_frame(log: &mut BackgroundLog, k: usize) -> Result<(), LogError> {
    samples(k, |time, channel, values| log.sample(time, channel, values))?;
    log.frame(picture(k, 50)?, k + 1 == FRAMES)
}

fn complete(path: &Path, particles: usize, budget: Option<Budget>) -> Logged {
    let mut log = create(path, budget);
    for k in 0..FRAMES {
        samples(k, |time, channel, values| log.sample(time, channel, values)).expect("the samples are taken");
        log.frame(picture(k, particles).expect("a frame"), k + 1 == FRAMES).expect("the frame is taken");
    }
    log.note(time_of(FRAMES), Level::Warning, "the wedge is submerged").expect("the note is taken");
    log.finish().expect("the log is finished")
}

#[test]
fn both_writers_write_the_same_bytes() {
    let folder = TempDir::new().unwrap();
    let (at_once, meanwhile) = (folder.path().join("at_once.mcap"), folder.path().join("meanwhile.mcap"));
    let logged = complete(&meanwhile, 50, None);
    let bytes = complete_log(&at_once);
    assert!(bytes == fs::read(&meanwhile).unwrap());
    assert_eq!(logged, Logged { bytes: bytes.len() as u64, frames: FRAMES as u64, left_out: 0 });
}

#[test]
fn a_dropped_log_is_complete() {
    let folder = TempDir::new().unwrap();
    let path = path_in(&folder);
    let mut log = create(&path, None);
    write_frame(&mut log, 0).unwrap();
    drop(log);
    assert!(mcap::Summary::read(&fs::read(&path).unwrap()).unwrap().is_some());
}

/// Curves and notes are all there, frames only as many as there is room for, and the file keeps below the budget.
#[test]
fn a_budget_leaves_out_frames_and_nothing_else() {
    let folder = TempDir::new().unwrap();
    let path = path_in(&folder);
    let particles = 4000;
    let whole = complete(&path, particles, None).bytes;
    let budget = whole * 3 / 4;
    let logged = complete(&path, particles, Some(Budget { bytes: budget, end: time_of(FRAMES - 1) }));
    assert!(logged.bytes < whole && logged.bytes <= budget, "{} of {budget} bytes", logged.bytes);
    assert_eq!(logged.frames + logged.left_out, FRAMES as u64);
    assert!(logged.frames >= 2 && logged.left_out >= 2, "{logged:?}");
    let (messages, error) = stream(&fs::read(&path).unwrap());
    assert!(error.is_none(), "{error:?}");
    let on = |topic: &str| messages.iter().filter(|m| m.channel.topic == topic).count();
    assert_eq!(on("/fluid"), logged.frames as usize);
    assert_eq!([on("/audit"), on("/body/wedge"), on("/log")], [FRAMES, FRAMES, 1]);
    let last = messages.iter().filter(|m| m.channel.topic == "/fluid").map(|m| m.log_time).max();
    assert_eq!(last, Some((1e9 * time_of(FRAMES - 1)).round() as u64));
}

/// What goes wrong on the other thread is reported by one of the next calls, in its words, and by the end at the latest.
#[test]
fn an_error_of_the_other_thread_comes_back() {
    let folder = TempDir::new().unwrap();
    let wrong = |log: &mut BackgroundLog| log.sample(0.0, "/audit", &[("mass_kg", 1.0)]);
    let mut log = create(&path_in(&folder), None);
    wrong(&mut log).expect("it is not known yet");
    let error = log.finish().expect_err("a channel that is refused");
    assert!(matches!(error, LogError::Channel { .. }), "{error}");

    let mut log = create(&path_in(&folder), None);
    wrong(&mut log).expect("it is not known yet");
    let said = (0..FRAMES).find_map(|k| write_frame(&mut log, k).err()).expect("the thread has ended");
    assert!(matches!(said, LogError::Channel { .. }), "{said}");
    let after = log.note(1.0, Level::Warning, "late").expect_err("the log has ended");
    assert!(matches!(after, LogError::Ended { .. }), "{after}");
}

/// Frames that may be on their way at a time: one in work, one that waits, one that is handed over.
const ON_THEIR_WAY: usize = 3;
/// Of these the two before the one that is handed over are taken for certain.
const AT_LEAST: usize = 2;

/// A disk that takes nothing (a pipe without a reader) lets a run hand over a few frames and then makes it wait; once it takes
/// more, every frame arrives.
#[cfg(unix)]
#[test]
fn a_run_that_is_ahead_of_the_disk_waits_for_it() {
    let folder = TempDir::new().unwrap();
    let path = path_in(&folder);
    let made = std::process::Command::new("mkfifo").arg(&path).status().expect("the command mkfifo");
    assert!(made.success(), "no pipe");
    let (taken, go_on) = (AtomicUsize::new(0), Barrier::new(2));
    let read = thread::scope(|scope| {
        let reader = scope.spawn(|| {
            let mut pipe = fs::File::open(&path).unwrap();
            go_on.wait();
            let mut bytes = Vec::new();
            pipe.read_to_end(&mut bytes).unwrap();
            bytes
        });
        scope.spawn(|| {
            let mut log = create(&path, None);
            let (many, walls) = (row(20_000, 0), row(7, 0)); // far more bytes than a pipe holds
            for k in 0..FRAMES {
                log.frame(Frame::new(time_of(k), &many, &walls, &[]).unwrap(), false).unwrap();
                taken.fetch_add(1, Ordering::Relaxed);
            }
            assert_eq!(log.finish().unwrap().frames, FRAMES as u64);
        });
        let start = Instant::now();
        while taken.load(Ordering::Relaxed) < AT_LEAST && start.elapsed() < Duration::from_secs(60) {
            thread::sleep(Duration::from_millis(1));
        }
        thread::sleep(Duration::from_millis(100)); // to be ahead, if it can
        let ahead = taken.load(Ordering::Relaxed);
        go_on.wait();
        assert!((AT_LEAST..=ON_THEIR_WAY).contains(&ahead), "{ahead} frames were taken and not written");
        reader.join().unwrap()
    });
    let frames = stream(&read).0.iter().filter(|m| m.channel.topic == "/fluid").count();
    assert_eq!(frames, FRAMES);
}
