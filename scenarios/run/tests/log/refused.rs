//! What a log refuses, and in which words.

use std::path::Path;

use run::log::{Frame, LogError, LogWriter};
use temp_dir::TempDir;

use super::{METADATA, path_in, row};

#[test]
fn a_time_that_the_clock_does_not_have_is_refused() {
    let error = Frame::new(f64::NAN, &row(4, 0), &row(3, 0), &[]);
    assert!(matches!(error, Err(LogError::Time(time)) if time.is_nan()));
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
        assert!(matches!(&refused, Err(LogError::Channel(c, _)) if c == channel), "{channel:?}: {refused:?}");
    }
}

#[test]
fn a_log_that_cannot_be_created_names_the_file() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("missing").join("log.mcap");
    let Err(error) = LogWriter::create(&path, &METADATA) else {
        panic!("a log in a folder that does not exist");
    };
    assert!(matches!(&error, LogError::Create(p, _) if *p == path));
    assert!(error.to_string().contains("missing"), "{error}");
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_is_reported_with_the_file() {
    let path = Path::new("/dev/full");
    let Err(error) = LogWriter::create(path, &METADATA) else {
        panic!("a log on a full disk");
    };
    assert!(matches!(&error, LogError::Write(p, _) if p == path));
}
