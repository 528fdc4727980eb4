//! Frames of a run in other formats hold what the log holds.

use std::fs;
use std::path::Path;

use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::RowAccessor;
use run::log::{IMAGE, LogReader};
use run::{RunOptions, run};
use scenarios::export::{ExportError, FrameFormat, export_frames};
use temp_dir::TempDir;

/// A short run of the wedge.
fn folder() -> TempDir {
    let folder = TempDir::new().expect("a folder");
    let sets = ["resolution.spacing=0.02", "time.end=0.004", "time.frame_every=0.002", "compare=[]"].map(String::from);
    let scene = run::load("wedge", &sets).expect("a built-in scene").scene;
    let options = RunOptions { out: Some(folder.path().join("run")), ..RunOptions::default() };
    run(&scene, &options).expect("a run");
    folder
}

/// Values of an array of a PolyData file.
fn array(file: &[u8], name: &str, components: usize) -> Vec<f64> {
    let split = file.windows(2).position(|pair| pair == b"\n_").expect("appended data") + 2;
    let head = std::str::from_utf8(&file[..split]).expect("XML");
    let line = head.lines().find(|line| line.contains(&format!("Name=\"{name}\""))).expect("the array");
    assert!(line.contains("Float32") && line.contains(&format!("NumberOfComponents=\"{components}\"")), "{line}");
    let offset = line.split("offset=\"").nth(1).and_then(|rest| rest.split('"').next()).expect("an offset");
    let start = split + offset.parse::<usize>().expect("a number");
    let length = u64::from_le_bytes(file[start..start + 8].try_into().expect("8 bytes")) as usize;
    let values = file[start + 8..start + 8 + length].chunks_exact(4);
    values.map(|bytes| f64::from(f32::from_le_bytes(bytes.try_into().expect("4 bytes")))).collect()
}

fn frame_of_log(dir: &Path, index: usize) -> (usize, Vec<f64>, Vec<f64>) {
    let mut log = LogReader::open(&dir.join("log.mcap")).expect("a log");
    let frame = log.frame(index).expect("a frame");
    let pressures = frame.fluid().map(|point| point.pressure).collect();
    let velocities = frame.fluid().flat_map(|point| [point.velocity[0], point.velocity[1], 0.0]).collect();
    (log.times().len(), pressures, velocities)
}

#[test]
fn paraview_files_hold_every_frame() {
    let folder = folder();
    let dir = folder.path().join("run");
    let (frames, pressures, velocities) = frame_of_log(&dir, 1);
    let exported = export_frames(&dir, FrameFormat::Vtk).expect("files");
    assert_eq!((exported.frames, exported.damaged), (frames, 0));
    let file = fs::read(dir.join("vtk/fluid_0001.vtp")).expect("a file");
    assert_eq!(array(&file, "pressure_Pa", 1), pressures);
    assert_eq!(array(&file, "velocity_m_per_s", 3), velocities);
    assert!(velocities.iter().any(|v| *v != 0.0));
    let collection = fs::read_to_string(dir.join("vtk/fluid.pvd")).expect("a collection");
    assert_eq!(collection.matches("<DataSet").count(), frames);
    let bodies = fs::read(dir.join("vtk/bodies_0000.vtp")).expect("a file");
    assert!(array(&bodies, "position_m", 3).len() >= 9);
}

/// A symmetric run computes half of the water; its log shows both.
#[test]
fn a_symmetric_run_is_logged_whole() {
    let folder = folder();
    let mut log = LogReader::open(&folder.path().join("run/log.mcap")).expect("a log");
    let frame = log.frame(1).expect("a frame");
    let (images, own): (Vec<_>, Vec<_>) = frame.fluid().partition(|point| point.is_image());
    assert!(own.len() > 100 && own.len() == images.len());
    for (point, image) in own.iter().zip(&images) {
        assert_eq!(
            (image.id & !IMAGE, image.at, image.pressure),
            (point.id, [-point.at[0], point.at[1]], point.pressure)
        );
        assert_eq!(image.velocity, [-point.velocity[0], point.velocity[1]]);
    }
}

#[test]
fn tables_hold_every_particle() {
    let folder = folder();
    let dir = folder.path().join("run");
    let (frames, pressures, _) = frame_of_log(&dir, 1);
    export_frames(&dir, FrameFormat::Csv).expect("files");
    let table = fs::read_to_string(dir.join("csv/fluid_0001.csv")).expect("a table");
    let column =
        table.lines().next().and_then(|head| head.split(',').position(|name| name == "pressure_Pa")).expect("it");
    let read =
        table.lines().skip(1).map(|row| row.split(',').nth(column).expect("a cell").parse::<f64>().expect("a number"));
    let read: Vec<f64> = read.collect();
    assert_eq!(read.len(), pressures.len());
    assert!(read.iter().zip(&pressures).all(|(a, b)| (*a as f32) == (*b as f32)));
    assert_eq!(columns(&dir.join("csv/frames.csv"), &["frame"])[0].len(), frames);
}

/// Columns of a table of numbers.
fn columns(path: &Path, names: &[&str]) -> Vec<Vec<f64>> {
    let text = fs::read_to_string(path).expect("a table");
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    let column = |name: &&str| {
        let at = rows[0].iter().position(|head| head == name).unwrap_or_else(|| panic!("{name} in {:?}", rows[0]));
        rows[1..].iter().map(|row| row[at].parse().expect("a number")).collect()
    };
    names.iter().map(column).collect()
}

/// The wedge touches the water at 0 and starts before: frames and bodies of every format have the times of `series.csv`.
#[test]
fn a_run_that_starts_before_0_is_exported_on_its_own_clock() {
    let folder = folder();
    let dir = folder.path().join("run");
    for format in [FrameFormat::Vtk, FrameFormat::Csv, FrameFormat::Parquet] {
        export_frames(&dir, format).expect("files");
    }
    let series = columns(&dir.join("series.csv"), &["time_s", "wedge.x_m", "wedge.y_m", "wedge.angle_deg"]);
    let times = columns(&dir.join("csv/frames.csv"), &["time_s"]).remove(0);
    let close = |a: f64, b: f64, most: f64| (a - b).abs() <= most;
    let ends = [series[0][0], series[0][series[0].len() - 1]];
    assert!(ends[0] < -1e-3, "{ends:?}");
    assert!(close(times[0], ends[0], 2e-9) && close(times[times.len() - 1], ends[1], 2e-9), "{times:?}");
    let bodies = columns(&dir.join("csv/bodies.csv"), &["time_s", "x_m", "y_m", "angle_deg"]);
    assert_eq!(bodies[0], times);
    for row in [0, times.len() - 1] {
        let sampled = if row == 0 { 0 } else { series[0].len() - 1 };
        assert!((1..4).all(|k| close(bodies[k][row], series[k][sampled], 1e-9)), "{row}: {bodies:?}");
    }
    let collection = fs::read_to_string(dir.join("vtk/fluid.pvd")).expect("a collection");
    let step = collection.split("timestep=\"").nth(1).and_then(|rest| rest.split('"').next()).expect("a time");
    assert_eq!(step.parse::<f64>().expect("a number"), times[0]);
    let file = fs::File::open(dir.join("parquet/bodies.parquet")).expect("a file");
    let rows = SerializedFileReader::new(file).expect("Parquet").get_row_iter(None).expect("rows").count();
    assert_eq!(rows, times.len());
    let file = fs::File::open(dir.join("parquet/fluid.parquet")).expect("a file");
    let reader = SerializedFileReader::new(file).expect("Parquet");
    let mut rows = reader.get_row_iter(None).expect("rows");
    let first = rows.next().and_then(Result::ok).and_then(|row| row.get_double(1).ok()).expect("a time");
    assert_eq!(first, times[0]);
}

#[test]
fn parquet_holds_every_particle_of_every_frame() {
    let folder = folder();
    let dir = folder.path().join("run");
    let (frames, pressures, _) = frame_of_log(&dir, 1);
    export_frames(&dir, FrameFormat::Parquet).expect("files");
    let file = fs::File::open(dir.join("parquet/fluid.parquet")).expect("a file");
    let reader = SerializedFileReader::new(file).expect("Parquet");
    assert_eq!(reader.num_row_groups(), frames);
    let rows = reader.get_row_iter(None).expect("rows").map(|row| row.expect("a row"));
    let read: Vec<f32> = rows
        .filter(|row| row.get_long(0).expect("a frame") == 1)
        .map(|row| {
            let (name, value) = row.get_column_iter().nth(7).expect("a cell");
            assert_eq!(name, "pressure_Pa");
            value.to_string().parse().expect("a number")
        })
        .collect();
    assert_eq!(read, pressures.iter().map(|pressure| *pressure as f32).collect::<Vec<_>>());
}

#[test]
fn a_folder_without_frames_is_refused_by_name() {
    let folder = TempDir::new().expect("a folder");
    let error = export_frames(folder.path(), FrameFormat::Vtk).expect_err("no log");
    assert!(matches!(error, ExportError::NoFrames(_)));
    assert!(error.to_string().contains(&folder.path().display().to_string()));
}

#[test]
fn a_log_without_its_scene_is_refused_because_its_clock_is_not_known() {
    let folder = folder();
    let dir = folder.path().join("run");
    fs::remove_file(dir.join("scene.resolved.toml")).expect("a file");
    let error = export_frames(&dir, FrameFormat::Csv).expect_err("no scene");
    assert!(error.to_string().contains("scene.resolved.toml"), "{error}");
}
