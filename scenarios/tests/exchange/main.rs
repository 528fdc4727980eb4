//! Panels go to FE codes as Nastran bulk data, and come back.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use scene::nastran::model::BeamModel;
use serde_json::Value;
use temp_dir::TempDir;

fn splashdown(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_splashdown"));
    let output = command.args(arguments).current_dir(folder).output().expect("the program runs");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments:?}: {said}");
    output
}

fn json(folder: &Path, arguments: &[&str]) -> Value {
    let output = splashdown(folder, &[arguments, &["--json"]].concat());
    serde_json::from_slice(&output.stdout).expect("JSON")
}

const SHORT: [&str; 6] =
    ["--set", "resolution.spacing=0.02", "--set", "time.end=0.006", "--set", "time.sample_every=0.0002"];

const THICK: &str = "body.panels[0].thickness=0.012";

/// A short run of a scene into `run`.
fn run(folder: &Path, scene: &str, out: &str) {
    splashdown(folder, &[&["run", scene, "--out", out, "--quiet"][..], &SHORT].concat());
}

/// A folder with a short run of the flexible wedge in `plate`, exported as bulk data, and the scene `bars.toml`, whose panel is that model.
fn exported() -> TempDir {
    let folder = TempDir::new().expect("a folder");
    let at = folder.path();
    run(at, "flexible_wedge", "plate");
    splashdown(at, &["export", "plate", "--nastran", "--loads", "--quiet"]);
    fs::copy(at.join("plate/nastran/plate.bdf"), at.join("plate.bdf")).expect("a copy");
    fs::write(at.join("bars.toml"), scene_of_bars("structure_file = \"plate.bdf\"")).expect("a scene");
    folder
}

fn scene_of_bars(keys: &str) -> String {
    let scene = include_str!("../../scene/scenes/flexible_wedge.toml");
    let (start, end) = (scene.find("from = ").expect("a panel"), scene.find("watch = ").expect("places"));
    format!("{}{keys}\n{}", &scene[..start], &scene[end..])
}

fn frequencies(folder: &Path, scene: &str) -> Vec<f64> {
    let said = json(folder, &[&["check", scene][..], &SHORT].concat());
    let list = said["panels"][0]["natural_frequencies_hz"].as_array().expect("frequencies");
    list.iter().map(|f| f.as_f64().expect("a number")).collect()
}

/// A column of a table.
fn column(table: &str, name: &str) -> Vec<f64> {
    let mut lines = table.lines();
    let k = lines.next().and_then(|head| head.split(',').position(|own| own == name)).expect(name);
    lines.map(|line| line.split(',').nth(k).and_then(|cell| cell.parse().ok()).unwrap_or(f64::NAN)).collect()
}

fn read(path: impl AsRef<Path>) -> String {
    fs::read_to_string(path).expect("a file")
}

#[track_caller]
fn same(a: &[f64], b: &[f64], within: f64) {
    assert_eq!(a.len(), b.len());
    let most = a.iter().fold(0.0, |most, x| f64::max(most, x.abs()));
    let worst = a.iter().zip(b).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
    assert!(most > 0.0 && worst <= within * most, "{worst} of {most}");
    println!("{} within {:e}", a.len(), worst / most);
}

/// The panel that comes back has the frequencies and the deflection of the plate that was written.
#[test]
fn a_panel_that_comes_back_is_the_one_that_went() {
    let folder = exported();
    let at = folder.path();
    same(&frequencies(at, "flexible_wedge"), &frequencies(at, "bars.toml"), 1e-9);
    run(at, "bars.toml", "bars");
    let [plate, bars] = ["plate", "bars"].map(|run| read(at.join(run).join("series.csv")));
    for name in ["plate.at50.deflection_m", "plate.at25.moment_N", "plate.stress_Pa", "wedge.fy_N_per_m"] {
        same(&column(&plate, name), &column(&bars, name), 1e-3);
    }
    // the resolved scene stands without the file, and its structure is written the same again
    fs::remove_file(at.join("plate.bdf")).expect("removed");
    splashdown(at, &["check", "bars/scene.resolved.toml"]);
    splashdown(at, &["export", "bars", "--nastran", "--quiet"]);
    let [first, second] = ["plate", "bars"].map(|run| read(at.join(run).join("nastran/plate.bdf")));
    let cards = |text: &str| text.lines().filter(|line| !line.starts_with('$')).map(String::from).collect::<Vec<_>>();
    assert_eq!(cards(&first), cards(&second));
    assert_eq!(BeamModel::read(&first).expect("a model").written(), first);
}

/// A curved panel with a mirror at the keel, whose bars are not equally long.
#[test]
fn a_curved_panel_comes_back_too() {
    let folder = TempDir::new().expect("a folder");
    let (at, name) = (folder.path(), "fuselage_flexible");
    let sets = ["--set", "resolution.spacing=0.02", "--set", "time.end=0.003", "--set", "compare=[]", "--quiet"];
    splashdown(at, &[&["run", name, "--out", "plate"][..], &sets].concat());
    splashdown(at, &["export", "plate", "--nastran", "--quiet"]);
    fs::copy(at.join("plate/nastran/bottom.bdf"), at.join("bottom.bdf")).expect("a copy");
    let scene = include_str!("../../scene/scenes/fuselage_flexible.toml");
    let (start, end) = (scene.find("from = ").expect("a panel"), scene.find("watch = ").expect("places"));
    let text = format!("{}structure_file = \"bottom.bdf\"\n{}", &scene[..start], &scene[end..]);
    fs::write(at.join("bars.toml"), text).expect("a scene");
    same(&frequencies(at, name), &frequencies(at, "bars.toml"), 1e-9);
    splashdown(at, &[&["run", "bars.toml", "--out", "bars"][..], &sets].concat());
    assert!(read(at.join("bars/scene.resolved.toml")).contains("ends = [\"mirror\", \"clamped\"]"));
    let [plate, bars] = ["plate", "bars"].map(|run| read(at.join(run).join("series.csv")));
    for name in ["bottom.at0.deflection_m", "bottom.at50.deflection_m", "bottom.at50.moment_N", "section.fy_N_per_m"] {
        same(&column(&plate, name), &column(&bars, name), 1e-3);
    }
}

/// Loads on the nodes add up to the force on the body, of which one half is simulated; the pressures to the same.
#[test]
fn loads_on_nodes_add_up_to_the_force_on_the_body() {
    let folder = exported();
    let at = folder.path();
    let (series, nodes) = (read(at.join("plate/series.csv")), read(at.join("plate/loads/plate_nodes.csv")));
    let (pressure, stations) =
        (read(at.join("plate/loads/plate_pressure.csv")), read(at.join("plate/loads/plate_stations.csv")));
    let count = column(&stations, "node").len();
    let times = column(&nodes, "time_s");
    same(&times, &column(&series, "time_s"), 1e-6);
    let sum = |columns: &[Vec<f64>]| -> Vec<f64> {
        (0..times.len()).map(|row| 2.0 * columns.iter().map(|column| column[row]).sum::<f64>()).collect()
    };
    let forces: Vec<Vec<f64>> = (1..=count).map(|n| column(&nodes, &format!("node{n}.fy_N_per_m"))).collect();
    same(&sum(&forces), &column(&series, "wedge.fy_N_per_m"), 1e-6);
    // p ds, and the forces across the bars at a deadrise of 20 degrees
    let head: Vec<&str> = pressure.lines().next().expect("a heading").split(',').skip(1).collect();
    let tributary = column(&stations, "tributary_m");
    let across: Vec<Vec<f64>> = head
        .iter()
        .zip(&tributary)
        .map(|(name, length)| column(&pressure, name).iter().map(|p| p * length).collect())
        .collect();
    let (sin, cos) = 20.0_f64.to_radians().sin_cos();
    let left = |n: usize| {
        let [x, y] = ["fx", "fy"].map(|axis| column(&nodes, &format!("node{n}.{axis}_N_per_m")));
        x.iter().zip(y).map(|(x, y)| cos * y - sin * x).collect::<Vec<f64>>()
    };
    same(&sum(&across), &sum(&(1..=count).map(left).collect::<Vec<_>>()), 1e-4);
    let most = |values: &[f64]| values.iter().fold(0.0, |a, b| f64::max(a, *b));
    for (largest, name) in column(&stations, "p_most_Pa").into_iter().zip(&head) {
        assert_eq!(largest, most(&column(&pressure, name)));
    }
    assert!(column(&stations, "stress_most_Pa").into_iter().all(|stress| stress > 0.0));
}

/// A wedge that falls on a plate of 12 mm, and on its modes from a file: the same force, motion and stress.
#[test]
fn a_panel_comes_back_as_its_modes() {
    let folder = TempDir::new().expect("a folder");
    let at = folder.path();
    splashdown(at, &[&["run", "flexible_wedge", "--out", "plate", "--quiet", "--set", THICK][..], &SHORT].concat());
    splashdown(at, &["export", "plate", "--modes", "30"]);
    let written = read(at.join("plate/modes/plate.toml"));
    fs::write(at.join("modes.toml"), &written).expect("a copy");
    let scene = include_str!("../../scene/scenes/flexible_wedge.toml");
    let body = &scene[..scene.find("[[body.panels]]").expect("a panel")];
    fs::write(at.join("modal.toml"), format!("{body}modes_file = \"modes.toml\"\n")).expect("a scene");
    let said = json(at, &[&["check", "modal.toml"][..], &SHORT].concat());
    let first = said["modes"]["natural_frequencies_hz"][0].as_f64().expect("a frequency");
    assert!(written.contains(&format!("frequency = {first:?}")), "{first}");
    run(at, "modal.toml", "modal");
    let [plate, modal] = ["plate", "modal"].map(|run| read(at.join(run).join("series.csv")));
    let [plate, modal] = [plate, modal].map(|table| column(&table, "wedge.vy_m_per_s"));
    let rows = plate.len().min(modal.len());
    same(&plate[..rows], &modal[..rows], 1e-3);
    let peak = |run: &str, name: &str| {
        let summary: Value = serde_json::from_str(&read(at.join(run).join("summary.json"))).expect("a summary");
        summary["results"]["panels"][name]["peak_stress_Pa"]["value"].as_f64().expect("a stress")
    };
    let [plate, modes] = [peak("plate", "plate"), peak("modal", "modes")];
    assert!((modes / plate - 1.0).abs() < 0.02, "{modes} Pa of modes, {plate} Pa of the plate");
}

/// Places that are watched on a curved panel stay where they were, at any spacing.
#[test]
fn a_curved_panel_is_watched_where_it_was() {
    for spacing in ["0.03", "0.025"] {
        let folder = TempDir::new().expect("a folder");
        let at = folder.path();
        let spacing = format!("resolution.spacing={spacing}");
        let sets = ["--quiet", "--set", &spacing, "--set", "time.end=0.004", "--set", "time.sample_every=0.0002"];
        splashdown(at, &[&["run", "fuselage_flexible", "--out", "own"][..], &sets].concat());
        splashdown(at, &["export", "own", "--nastran"]);
        let scene = include_str!("../../scene/scenes/fuselage_flexible.toml");
        let panel = &scene[scene.find("[[body.panels]]").expect("a panel")..];
        let name = panel.lines().find_map(|line| line.strip_prefix("name = ")).expect("a name").trim_matches('"');
        fs::copy(at.join(format!("own/nastran/{name}.bdf")), at.join("panel.bdf")).expect("a copy");
        let kept =
            |line: &&str| ["[[body", "name", "watch", "from", "to", "ends"].iter().any(|key| line.starts_with(key));
        let keys: Vec<&str> = panel.lines().filter(kept).collect();
        let head = &scene[..scene.len() - panel.len()];
        let text = format!("{head}{}\nstructure_file = \"panel.bdf\"\n", keys.join("\n"));
        fs::write(at.join("bars.toml"), text).expect("a scene");
        splashdown(at, &[&["run", "bars.toml", "--out", "bars"][..], &sets].concat());
        let [own, bars] = ["own", "bars"].map(|run| read(at.join(run).join("series.csv")));
        let watched = format!("{name}.at50.deflection_m");
        same(&column(&own, &watched), &column(&bars, &watched), 1e-3);
    }
}

/// A model in millimetres and tonnes, in another plane, against the order of the line, bars for half a metre: the same frequencies.
#[test]
fn units_plane_direction_and_width_are_those_of_the_file() {
    let folder = exported();
    let at = folder.path();
    let model = BeamModel::read(&read(at.join("plate.bdf"))).expect("a model");
    let mut text = String::from("SOL 103\nCEND\nBEGIN BULK\n");
    for grid in &model.grids {
        let [x, y, _] = grid.at.map(|value| 1e3 * value);
        text += &format!("GRID,{},,{x:.10e},7.,{y:.10e}\n", grid.id);
    }
    // from the other end, the first plane across the model: I2 counts
    for bar in model.bars.iter().rev() {
        let [a, b] = bar.grids;
        text += &format!("CBAR,{},1,{b},{a},0.,1.,0.\n", bar.id);
    }
    let (area, second_moment) = (0.5 * 0.003 * 1e6, 0.5 * 0.003_f64.powi(3) / 12.0 * 1e12);
    text += &format!("PBAR,1,1,{area:.6},1.,{second_moment:.6}\n,,-1.5,,1.5\n");
    let last = model.grids.len();
    text += &format!("MAT1,1,{:.8},,.3,2.7-9\nSPC1,1,135,1,{last}\nENDDATA\n", 70e3 / 0.91);
    fs::write(at.join("frame.bdf"), text).expect("a file");
    let keys = "structure_file = \"frame.bdf\"\nstructure_plane = \"xz\"\nstructure_units = \"mm_t_s\"\nstructure_width = \"500 mm\"";
    fs::write(at.join("frame.toml"), scene_of_bars(keys)).expect("a scene");
    same(&frequencies(at, "flexible_wedge"), &frequencies(at, "frame.toml"), 1e-6);
    run(at, "frame.toml", "frame");
    let [plate, frame] = ["plate", "frame"].map(|run| read(at.join(run).join("series.csv")));
    for name in ["plate.at50.deflection_m", "plate.at25.strain_left", "plate.stress_Pa"] {
        same(&column(&plate, name), &column(&frame, name), 1e-3);
    }
}

#[test]
fn a_run_without_panels_has_no_loads_to_write() {
    let folder = TempDir::new().expect("a folder");
    run(folder.path(), "wedge", "rigid");
    for format in ["--loads", "--nastran"] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_splashdown"));
        let output = command.args(["export", "rigid", format]).current_dir(folder.path()).output().expect("an answer");
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.code() == Some(2) && said.contains("its body has no panels"), "{said}");
    }
}
