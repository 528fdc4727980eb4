//! What a run that failed leaves: no results, on the console or on the page.

use std::process::Command;

/// A thin panel with explicit coupling breaks down within a second: neither console nor page shows results of it.
#[test]
fn a_run_that_breaks_down_has_no_results() {
    let folder = temp_dir::TempDir::new().expect("a folder");
    let out = folder.path().join("run");
    let sets = ["resolution.spacing=0.02", "coupling.scheme=weak", "body.panels.0.thickness=0.0003", "body.mass=1"];
    let sets = sets.iter().flat_map(|set| ["--set", set]);
    let mut run = Command::new(env!("CARGO_BIN_EXE_splashdown"));
    let ended = run.args(["run", "flexible_wedge"]).args(sets).arg("--out").arg(&out).output().expect("a run");
    let [said, error] = [ended.stdout, ended.stderr].map(|bytes| String::from_utf8(bytes).expect("text"));
    assert_eq!(ended.status.code(), Some(1), "{said}{error}");
    assert!(said.contains("failed at t = ") && said.contains("no results"), "{said}");
    assert!(!said.contains("peak_") && !said.contains("DOUBT") && error.contains("error: "), "{said}{error}");
    let page = std::fs::read_to_string(out.join("report.html")).expect("a page");
    assert!(page.contains("class=\"status failed\"") && page.contains("The run has no results"));
    for absent in ["class=\"cards\"", "Results in detail", "result: "] {
        assert!(!page.contains(absent), "{absent}");
    }
}
