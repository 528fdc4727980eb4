//! Wrong inputs, each refused with exit code 2, without panic, with words that say what was wrong and what was expected.
//!
//! `mistakes.tsv` holds one mistake per line: its kind, what is given, and words that the message must have. An arrow stands between
//! what is replaced in the scene and its replacement, or between a file's name and its text.

use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

const MISTAKES: &str = include_str!("mistakes.tsv");
const SCENE: &str = include_str!("scene.toml");
const LANDING: &str = include_str!("../../ditching/mercure.toml");
const STRUCTURE: &str = include_str!("structure.bdf");
const OUTLINE: &str = "outline = \"FILE\"";

/// The scene with its points in a file, without panels and gauges.
fn with_outline() -> String {
    let line = SCENE.lines().find(|line| line.starts_with("points =")).expect("a line of points");
    let text = SCENE.replace(line, OUTLINE);
    text[..text.find("[[body.panels]]").expect("a panel")].to_string()
}

/// The scene with other keys of its panel than its place, thickness and material.
fn with_structure(keys: &str) -> String {
    let start = SCENE.find("from_point").expect("a panel");
    let end = SCENE.find("[[gauges]]").expect("a gauge");
    format!("{}{keys}\n\n{}", &SCENE[..start], &SCENE[end..])
}

/// Writes the files of a mistake into a folder; the arguments of the command.
fn arguments(folder: &Path, kind: &str, given: &str) -> Vec<String> {
    let scene = |text: &str, verb: &str| {
        fs::write(folder.join("s.toml"), text).expect("a file");
        vec![verb.to_string(), "s.toml".to_string()]
    };
    let (from, to) = given.split_once(" => ").or(given.split_once(" =>")).unwrap_or((given, ""));
    let edited = |text: &str| {
        assert!(text.contains(from), "{given}: nothing to replace");
        text.replacen(from, to, 1)
    };
    let data = || fs::write(folder.join(from), to).expect("a file");
    match kind {
        "args" => given.replace("{dir}", &folder.to_string_lossy()).split_whitespace().map(String::from).collect(),
        "set" => ["check", "wedge", "--set", given].map(String::from).to_vec(),
        "edit" => scene(&edited(SCENE), "check"),
        "landing" => scene(&edited(LANDING), "ditch"),
        "outline" => {
            data();
            scene(&with_outline().replace("FILE", from), "check")
        }
        "outline_in_m" => {
            data();
            scene(&with_outline().replace(OUTLINE, &format!("outline = {from:?}\noutline_unit = \"m\"")), "check")
        }
        "outline_key" => {
            fs::write(folder.join("a.csv"), "0,0\n1,0\n1,1\n").expect("a file");
            scene(&with_outline().replace(OUTLINE, given), "check")
        }
        "check" | "sweep" | "ditch" => {
            data();
            [kind, from].map(String::from).to_vec()
        }
        "motion" => {
            data();
            let moved = "mass = 80.0\nfree = [\"y\"]\nvelocity = [0.0, -4.0]";
            scene(&SCENE.replace(moved, "motion_file = \"m.csv\""), "check")
        }
        "structure" => {
            fs::write(folder.join("s.bdf"), edited(STRUCTURE)).expect("a file");
            scene(&with_structure("structure_file = \"s.bdf\""), "check")
        }
        "structure_key" => {
            fs::write(folder.join("s.bdf"), STRUCTURE).expect("a file");
            scene(&with_structure(given), "check")
        }
        other => panic!("{other} is no kind of mistake"),
    }
}

/// What is wrong with the answer to a mistake; nothing where it is as it should be.
fn faults(kind: &str, given: &str, words: &str) -> Vec<String> {
    let folder = temp_dir::TempDir::new().expect("a folder");
    let mut command = Command::new(env!("CARGO_BIN_EXE_splashdown"));
    let command = command.args(arguments(folder.path(), kind, given)).arg("--json").current_dir(folder.path());
    let output = command.output().expect("the program runs");
    let [stdout, stderr] = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text));
    let mut faults = Vec::new();
    let mut require = |holds: bool, fault: String| faults.extend((!holds).then_some(fault));
    require(output.status.code() == Some(2), format!("exit code {:?}", output.status.code()));
    require(!stderr.contains("panicked") && !stderr.is_empty(), format!("stderr: {stderr}"));
    let error = serde_json::from_str::<Value>(&stdout).map(|answer| answer["error"].clone()).unwrap_or_default();
    require(error["message"].is_string(), format!("no message in {stdout}"));
    let placed = error["file"].is_string() && error["line"].is_u64();
    let keyed = error["key"].is_string() || error["message"].to_string().contains("not valid TOML");
    let placeless = ["args", "set", "check", "sweep", "ditch"].contains(&kind);
    require(placeless || placed && keyed, format!("no file, line and key in {stdout}"));
    let missing = words.split(" ;; ").filter(|word| !stdout.contains(word));
    faults.extend(missing.map(|word| format!("`{word}` is not in {stdout}")));
    faults
}

#[test]
fn every_mistake_is_refused_in_words_that_help() {
    let mut count = 0;
    let mut wrong = Vec::new();
    for line in MISTAKES.lines().filter(|line| !line.starts_with('#')) {
        let cells: Vec<&str> = line.split('\t').collect();
        let [kind, given, words] = cells[..] else { panic!("{line}: three cells") };
        let given = given.replace("\\n", "\n");
        count += 1;
        wrong.extend(faults(kind, &given, words).into_iter().map(|fault| format!("{kind} {given:?}: {fault}")));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(count >= 200, "{count} mistakes");
}

/// The standard error of a command that is refused.
fn refusal(folder: &Path, arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_splashdown")).args(arguments).current_dir(folder).output();
    let output = output.expect("the program runs");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
    said
}

#[test]
fn a_folder_is_reported_for_what_it_holds() {
    let folder = temp_dir::TempDir::new().expect("a folder");
    for (file, command) in [("scene.resolved.toml", "splashdown resume held"), ("sweep.json", "splashdown sweep held")]
    {
        let held = folder.path().join("held");
        fs::create_dir_all(&held).expect("a folder");
        fs::write(held.join(file), "").expect("a file");
        for verb in ["run", "check"] {
            let said = refusal(folder.path(), &[verb, "held"]);
            assert!(said.contains("`held` is the folder of a") && said.contains(command), "{said}");
        }
    }
}

/// What stops a command comes before what is doubtful about its scene.
#[test]
fn a_folder_that_holds_a_run_is_refused_before_warnings() {
    let folder = temp_dir::TempDir::new().expect("a folder");
    fs::create_dir(folder.path().join("held")).expect("a folder");
    fs::write(folder.path().join("held/summary.json"), "{}").expect("a file");
    let said = refusal(folder.path(), &["run", "wedge", "--set", "resolution.spacing=0.01", "--out", "held"]);
    assert!(said.starts_with("error: held already holds a run") && !said.contains("WARN"), "{said}");
}

/// The parser's advice to pass an unknown option as a value is not repeated.
#[test]
fn a_key_as_an_option_gets_the_tip_to_set_it() {
    let folder = temp_dir::TempDir::new().expect("a folder");
    let said = refusal(folder.path(), &["run", "wedge", "--spacing", "0.01"]);
    assert!(said.contains("tip: a key of the scene is set by `--set resolution.spacing=0.01`"), "{said}");
    assert!(!said.contains("-- --spacing"), "{said}");
    let said = refusal(folder.path(), &["run", "wedge", "--chekpoint-every", "1"]);
    assert!(said.contains("--checkpoint-every"), "{said}");
}
