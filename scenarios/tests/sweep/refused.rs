//! What a sweep refuses: exit code 2, with what was given and what is expected.

use super::Place;

#[test]
fn wrong_input_is_reported_with_its_place() {
    for (sweep, says) in [
        ("scene = \"wedge\"\n[grid]\nbody.deadrise = [20]\n", "unknown key"),
        ("scene = \"wedge\"\n[grid]\nbody.deadrise_deg = 20\n", "drops.toml:3"),
        ("scene = \"nowhere.toml\"\n", "expected a built-in name"),
        ("grid = 3\n", "drops.toml:1"),
        (
            "scene = \"wedge\"\n[grid]\na = { from = 1, to = 2, count = 99999 }\nb = { from = 1, to = 2, count = 99999 }\n",
            "points",
        ),
        ("", "expected `scene = "),
    ] {
        let place = Place::new(sweep);
        let (code, _, message) = place.sweep(&[]);
        assert_eq!(code, Some(2), "{sweep}: {message}");
        let message = message.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(message.contains(says), "{sweep}: {message}");
        assert!(place.points_with("given.json").is_empty());
    }
}

#[test]
fn wrong_arguments_are_reported() {
    let place = Place::new("scene = \"wedge\"\n[set]\nmodel = \"wagner\"\n");
    let refused = |arguments: &[&str], says: &str| {
        let ended = place.command(arguments).output().expect("the command starts");
        let message = String::from_utf8_lossy(&ended.stderr).split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(ended.status.code(), Some(2), "{message}");
        assert!(message.contains(says), "{message}");
    };
    refused(&["nowhere.toml"], "cannot read the sweep file nowhere.toml");
    refused(&["drops.toml", "--jobs", "0"], "0 is not in 1..=1024");
    refused(&["drops.toml", "--resume"], "expected one that was started");
    refused(&["."], "holds no sweep");
    refused(&["drops.toml", "--point", "../x"], "expected the name of a folder");
    refused(&["drops.toml", "--point", "0123"], "expected a point that");
    assert_eq!(place.sweep(&["--quiet"]).0, Some(0));
    place.write("other.toml", "scene = \"wedge\"\n[set]\nmodel = \"mlm\"\n");
    refused(&["other.toml", "--out", "out"], "already holds the sweep of");
    let by_run = std::process::Command::new(env!("CARGO_BIN_EXE_splashdown"))
        .args(["run", "wedge", "--set", "model=wagner", "--quiet", "--out"])
        .arg(place.path("held"))
        .status();
    assert!(by_run.expect("the command starts").success());
    refused(&["drops.toml", "--out", "held"], "already holds a run");
}
