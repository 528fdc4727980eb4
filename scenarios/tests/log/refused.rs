//! What a log refuses, and in which words.

use std::fs;
use std::path::Path;

use scenarios::log::{LogError, LogWriter};
use tempfile::TempDir;

use super::{METADATA, Row, path_in, stream};

#[test]
fn a_frame_that_is_refused_leaves_no_trace() {
    let folder = TempDir::new().unwrap();
    let path = path_in(&folder);
    let mut log = LogWriter::create(&path, &METADATA).unwrap();
    let (fluid, mut walls) = (Row::new(4, 0), Row::new(3, 0));
    walls.density.pop();
    let error = log.frame(0.0, &fluid.view(), &walls.view(), &[]);
    assert_eq!(error.unwrap_err().to_string(), "/walls: 2 values of density for 3 particles");
    let error = log.frame(f64::NAN, &fluid.view(), &fluid.view(), &[]);
    assert!(matches!(error, Err(LogError::Time { time }) if time.is_nan()));
    log.finish().unwrap();
    assert_eq!(stream(&fs::read(&path).unwrap()).0.len(), 0);
}

#[test]
fn a_sample_must_keep_to_the_schema_of_its_channel() {
    let folder = TempDir::new().unwrap();
    let mut log = LogWriter::create(&path_in(&folder), &METADATA).unwrap();
    log.sample(0.0, "audit", &[("mass_kg", 1.0), ("energy_J", 2.0)]).unwrap();
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

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_is_reported_with_the_file() {
    let path = Path::new("/dev/full");
    let Err(error) = LogWriter::create(path, &METADATA) else {
        panic!("a log on a full disk");
    };
    assert!(matches!(&error, LogError::Write { path: p, .. } if p == path));
}
