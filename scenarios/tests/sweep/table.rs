//! Tables and page; nothing is computed twice.

use super::{Place, csv};

const DROPS: &str = r#"
scene = "wedge"
[set]
model = "wagner"
[grid]
body.deadrise_deg = [20, 30]
"body.velocity[1]" = { from = -6, to = -4, step = 1 }
"#;

/// Points without pages and logs give the same table; a page of one is made later.
#[test]
fn a_lean_sweep_keeps_numbers_and_curves() {
    let (lean, whole) = (Place::new(DROPS), Place::new(DROPS));
    let [few, all] = [(&lean, &["--lean"][..]), (&whole, &[])].map(|(place, options)| {
        let (code, _, message) = place.sweep(options);
        assert_eq!(code, Some(0), "{message}");
        let text = place.text("out/table.csv");
        let (_, rows) = csv(&text);
        rows.iter().map(|row| row[..9].join(" ")).collect::<Vec<_>>()
    });
    assert_eq!(few, all);
    assert_eq!([lean.points_with("report.html").len(), lean.points_with("log.mcap").len()], [0, 0]);
    assert_eq!([lean.points_with("summary.json").len(), lean.points_with("series.csv").len()], [6, 6]);
    assert!(!lean.text("out/sweep.html").contains("report.html"), "no link to a page that is not there");
    let mut page = std::process::Command::new(env!("CARGO_BIN_EXE_splashdown"));
    let made = page.arg("report").arg(&lean.points_with("summary.json")[0]).output().expect("a program");
    assert!(made.status.success() && lean.points_with("report.html").len() == 1, "{made:?}");
    let (code, _, message) = lean.sweep(&["--lean", "--engine", "slurm"]);
    assert!(code == Some(2) && message.contains("--lean: expected with --engine local"), "{message}");
}

/// A row for each point, in the order of the file; the worst case; a page with links to the reports.
#[test]
fn a_grid_gives_a_table_worst_cases_and_a_page() {
    let place = Place::new(DROPS);
    let (code, said, message) = place.sweep(&["--jobs", "2"]);
    assert_eq!(code, Some(0), "{message}");
    assert_eq!(
        (&said["points"], &said["done"], &said["run"], &said["reused"]),
        (&6.into(), &6.into(), &6.into(), &0.into())
    );
    let table = place.text("out/table.csv");
    let (head, rows) = csv(&table);
    let start =
        ["point", "body.deadrise_deg [deg]", "body.velocity[1] [m/s]", "status", "message", "peak_force_N_per_m"];
    assert_eq!(head[..6], start, "{table}");
    assert_eq!(
        rows.iter().map(|row| format!("{} {}", row[1], row[2])).collect::<Vec<_>>(),
        ["20 -6", "20 -5", "20 -4", "30 -6", "30 -5", "30 -4"]
    );
    let force = |row: &[&str]| row[5].parse::<f64>().expect("a number");
    assert!(rows.windows(2).all(|pair| pair[0][1] != pair[1][1] || force(&pair[0]) > force(&pair[1])), "{table}");
    let text = place.text("out/worst.csv");
    let (_, worst) = csv(&text);
    assert!(worst.iter().any(|row| row[0] == "peak_force_N_per_m" && row[7] == "1"), "{worst:?}");
    let page = place.text("out/sweep.html");
    for row in &rows {
        let report = format!("{}/report.html", row.last().expect("a folder"));
        assert!(page.contains(&format!("href=\"{report}\"")) && place.path("out").join(&report).exists(), "{report}");
    }
    assert!(page.contains("Response surfaces") && !page.contains("src=\"http"), "surfaces, no network");
    for part in [
        "6 points: all completed",
        "Largest peak force",
        "Peak force [kN/m]",
        "Vertical velocity [m/s]",
        "<b>Table 3.</b>",
    ] {
        assert!(page.contains(part), "{part}");
    }
    assert!(!page.contains("peak_force_N_per_m") && !page.contains("core-s"), "words, not keys");

    // the same numbers as `splashdown run`
    let run = std::process::Command::new(env!("CARGO_BIN_EXE_splashdown"))
        .args(["run", "wedge", "--json", "--set", "model=wagner", "--set", "body.deadrise_deg=20", "--out"])
        .arg(place.path("alone"))
        .args(["--set", "body.velocity[1]=-6"])
        .output()
        .expect("the command starts");
    let summary: serde_json::Value = serde_json::from_slice(&run.stdout).expect("JSON");
    assert_eq!(summary["results"]["peak_force_N_per_m"]["value"].as_f64(), Some(force(&rows[0])));
}

/// A theory that was measured nowhere near a point has no band there: its results are not resolved, in the table and on the page.
#[test]
fn a_theory_without_a_band_is_marked() {
    let place = Place::new(
        &DROPS.replace("\"wagner\"", "\"mlm\"\ntime.end = 0.012\nbody.mass = 20").replace("[20, 30]", "[20, 40]"),
    );
    assert_eq!(place.sweep(&[]).0, Some(0));
    let table = place.text("out/table.csv");
    let (head, rows) = csv(&table);
    let column = |name: &str| head.iter().position(|own| *own == name).expect("a column");
    let (band, verdict) = (column("peak_force_N_per_m.band"), column("peak_force_N_per_m.verdict"));
    for row in &rows {
        assert_eq!(row[verdict], if row[band].is_empty() { "no_band" } else { "resolved" }, "{row:?}");
    }
    assert!(
        rows[..3].iter().all(|row| row[verdict] == "resolved") && rows[3..].iter().all(|row| row[verdict] == "no_band")
    );
    let page = place.text("out/sweep.html");
    assert!(
        page.contains("3 of 6 have results that are not resolved or have no band") && page.contains("* no band known")
    );
}

/// The same command runs nothing; a longer axis runs the new points only; `--force` runs all.
#[test]
fn nothing_is_computed_twice() {
    let place = Place::new(DROPS);
    assert_eq!(place.sweep(&[]).0, Some(0));
    let table = place.text("out/table.csv");
    let (code, said, _) = place.sweep(&["--resume"]);
    assert_eq!((code, &said["run"], &said["reused"]), (Some(0), &0.into(), &6.into()));
    assert_eq!(place.text("out/table.csv"), table);
    place.write("drops.toml", &DROPS.replace("[20, 30]", "[20, 25, 30, 20.0]"));
    let (code, said, _) = place.sweep(&[]);
    // 20.0 is 20: the same resolved scene
    assert_eq!((code, &said["points"], &said["run"], &said["reused"]), (Some(0), &12.into(), &3.into(), &6.into()));
    let (_, said, _) = place.sweep(&["--force"]);
    assert_eq!(said["run"], 9);
    let by_folder = place.command(&["out", "--quiet"]).status().expect("the command starts");
    assert_eq!(by_folder.code(), Some(0));
}

/// A point whose results are lost, or whose file of results is cut, runs again, and no other; the table is the same.
#[test]
fn a_point_whose_results_are_lost_or_damaged_runs_again() {
    let place = Place::new(DROPS);
    assert_eq!(place.sweep(&[]).0, Some(0));
    let table = place.text("out/table.csv");
    let without_times = |table: &str| {
        let (head, rows) = csv(table);
        let of = |row: &Vec<&str>| {
            row.iter()
                .zip(&head)
                .filter(|(_, name)| !name.contains("wall"))
                .map(|(cell, _)| cell.to_string())
                .collect::<Vec<_>>()
        };
        rows.iter().map(of).collect::<Vec<_>>()
    };
    let points = place.points_with("summary.json");
    std::fs::remove_file(points[1].join("summary.json")).expect("a summary");
    std::fs::write(points[4].join("summary.json"), "{\"results\": {\"peak_for").expect("a summary");
    let (_, status, _) = place.sweep(&["--status"]);
    assert_eq!((&status["done"], &status["waiting"]), (&4.into(), &2.into()), "{status}");
    let (code, said, message) = place.sweep(&[]);
    assert_eq!((code, &said["run"], &said["reused"]), (Some(0), &2.into(), &4.into()), "{message}");
    assert_eq!(without_times(&place.text("out/table.csv")), without_times(&table));
}

/// A point whose scene is wrong is a row with the reason, and so is one whose run fails; the others run; exit code 1.
#[test]
fn a_point_that_fails_is_a_row() {
    let place = Place::new(&DROPS.replace("[20, 30]", "[30, 95]"));
    let (code, said, message) = place.sweep(&[]);
    assert_eq!((code, &said["done"], &said["failed"]), (Some(1), &3.into(), &3.into()), "{message}");
    assert!(message.contains("3 of 6 points failed"), "{message}");
    let table = place.text("out/table.csv");
    assert_eq!(table.matches(",refused,").count(), 3, "{table}");
    assert!(table.contains("body.deadrise_deg=95") && place.text("out/sweep.html").contains("Failures"));

    place
        .write("up.toml", "ditch = \"mercure\"\n[set]\nlanding.strips = 20\n[grid]\nwing.pitch_stiffness = [0, 100]\n");
    let ended = place.command(&["up.toml", "--out", "up", "--quiet"]).output().expect("the command starts");
    assert_eq!(ended.status.code(), Some(1));
    let table = place.text("up/table.csv");
    let (head, rows) = csv(&table);
    assert!(head.contains(&"load_factor") && head.contains(&"load_factor.time_s"), "{head:?}");
    assert!(
        rows[0][2].starts_with("completed") && rows[1][2] == "failed" && rows[1][3].contains("the nose goes under"),
        "{table}"
    );
    let worst = place.text("up/worst.csv");
    assert!(worst.contains("\nline_load_n_per_m,station 24.0 m,,"), "{worst}");
    // the loads of the landing whose nose went under are not forgotten, and is marked
    let cell = |row: &[&str], name: &str| row[head.iter().position(|own| *own == name).expect("a column")].to_string();
    assert_eq!(cell(&rows[1], "load_factor.verdict"), "not_resolved", "{table}");
    let factor = |row: &[&str]| cell(row, "load_factor").parse::<f64>().expect("a number");
    let (_, cases) = csv(&worst);
    let case = cases.iter().find(|row| row[0] == "load_factor").expect("a worst case");
    assert_eq!(case[3].parse::<f64>().expect("a number"), factor(&rows[0]).max(factor(&rows[1])), "{worst}");
    assert!(place.text("up/sweep.html").contains("no band known"), "no load of a landing has a band");
    let again = place.command(&["up.toml", "--out", "up", "--json"]).output().expect("the command starts");
    let said: serde_json::Value = serde_json::from_slice(&again.stdout).expect("JSON");
    assert_eq!((&said["run"], &said["failed"]), (&0.into(), &1.into()), "a failed run is an answer");
}

/// Named paths in place of the results; several scenes are an axis; worst cases for each.
#[test]
fn chosen_numbers_of_several_scenes() {
    let place = Place::new(
        "scene = [\"wedge\", \"own.toml\"]\ntabulate = [\"peaks/wedge.vy_m_per_s/value\", \"model\", \"steps\"]\n[set]\ntime.end = 0.01\n\
         [latin_hypercube]\nsamples = 3\nseed = 4\nkeys.body.mass = [100, 400]\n[zip]\nmodel = [\"mlm\", \"wagner\"]\n\
         \"body.velocity[1]\" = [-5, -6]\n",
    );
    let own = include_str!("../../scene/scenes/wedge.toml");
    place.write("own.toml", own.split("[[compare]]").next().expect("the scene without references"));
    let (code, said, message) = place.sweep(&[]);
    assert_eq!((code, &said["points"]), (Some(0), &12.into()), "{message}");
    let table = place.text("out/table.csv");
    let (head, rows) = csv(&table);
    assert_eq!(head[..5], ["point", "scene", "body.mass [kg/m]", "model", "body.velocity[1] [m/s]"]);
    assert!(head.contains(&"peaks/wedge.vy_m_per_s") && head.contains(&"steps"), "{head:?}");
    assert_eq!(rows.iter().filter(|row| row[1] == "wedge").count(), 6);
    let worst = place.text("out/worst.csv");
    assert_eq!(worst.lines().filter(|line| line.starts_with("peaks/wedge.vy_m_per_s,")).count(), 2, "{worst}");
}
