//! Ditching by 2D+t: landings of aeroplanes on water, from a file to a report (THEORY EN14–EN19, EN25–EN29, EN36–EN38, EN54–EN59).
//!
//! # Example
//! ```
//! use scenarios::ditching;
//!
//! let landed = ditching::follow(&ditching::load("mercure", &[])?);
//! assert!(landed.summary.az_g.value > 0.0);
//! # Ok::<(), scene::SceneError>(())
//! ```
//!
//! A landing is a TOML file of its own kind; [`load`] reads it, [`run`] follows it and writes `series.csv`, `summary.json`,
//! `report.html`, `pressure_map.csv`, `stress_map.csv` and `scene.resolved.toml`, [`section_scenes`] makes scenes of particles of its sections. [`schema`] has the keys.

mod accelerometers;
mod aeroplane;
mod afloat_keys;
mod afloat_page;
mod certify_check;
mod certify_keys;
mod checked;
mod flotation;
mod landed;
mod loads;
mod model;
mod outlines;
mod page;
mod parts;
mod plate_strip;
mod plating;
mod plating_choice;
mod plating_keys;
mod plating_page;
mod plating_run;
mod sea;
mod sea_keys;
mod section_text;
mod sections;
mod series;
mod side_views;
mod stations;
mod struts;
mod windows;

use std::fs;
use std::path::Path;
use std::sync::LazyLock;

use checked::checked;
use include_dir::{Dir, include_dir};
use run::RunError;
use run::folder::{refuse_files, write};
use scene::draft::Draft;
use scene::mistaken_file::Expected;
use scene::source::Source;
use scene::{SceneError, texts};
use settings::Problem;
use water_entry::ditching::Wing;

pub use afloat_keys::{FlotationKeys, OpeningKeys, StrutKeys};
pub use certify_keys::{CertifyKeys, FailureKeys, LoadingKeys, MOST_CASES, RuleKey, SeaForm, SeaStateKeys};
pub use flotation::{Flotation, SillTime};
pub use landed::{Landed, Structure, Summary, follow};
pub use loads::{Accelerometer, PartLoad, StationLoad};
pub use model::{AeroplaneKeys, LandingKeys, Scene, schema};
pub use parts::{AccelerometerKeys, BeamKeys, MassKeys, NacelleKeys, PanelKeys, SurfaceKeys};
pub use plating::{BayStress, PlatingSection, PlatingStress};
pub use plating_keys::{PlateEnd, PlatingKeys};
pub use sea::Sea;
pub use sea_keys::{SeaKeys, SpectrumKey, TouchdownKey, WavePart};
pub use sections::{SectionError, SectionResult, SectionScene, section_scenes};
pub use series::Series;
pub use stations::StationKeys;
pub use windows::{WindowKeys, WindowLoad};

static LANDINGS: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/ditching");

/// Name and text of each built-in landing, by name.
pub fn builtin() -> &'static [(&'static str, &'static str)] {
    static SCENES: LazyLock<Vec<(&str, &str)>> = LazyLock::new(|| texts(&LANDINGS));
    &SCENES
}

/// Loads a built-in landing by its name, or a file by its path, with `--set` arguments applied in their order.
pub fn load(name_or_path: &str, sets: &[String]) -> Result<Scene, SceneError> {
    loaded(&Source::find(Expected::Landing, builtin(), name_or_path, sets, schema())?)
}

/// Loads a landing from its text; `name` stands for the file in messages. What the file leaves out is filled in.
pub fn load_text(name: &str, text: &str, sets: &[String]) -> Result<Scene, SceneError> {
    loaded(&Source { name: name.to_string(), text: text.to_string(), sets: sets.to_vec(), schema: schema() })
}

fn loaded(source: &Source) -> Result<Scene, SceneError> {
    let mut given = source.read()?;
    certify_check::settle(&mut given);
    outlines::settle(&mut given, &source.name).map_err(|problem| source.error(problem))?;
    let scene = Draft::of(&given, schema()).and_then(|draft| read(&draft));
    scene.and_then(checked).map_err(|problem| source.error(problem))
}

/// The landing of a draft: table by table, so that a missing key is found where it belongs.
fn read(draft: &Draft) -> Result<Scene, Problem> {
    draft.read::<LandingKeys>("landing")?;
    draft.read::<AeroplaneKeys>("aeroplane")?;
    draft.read::<Wing>("wing")?;
    let each = |table: &str| (0..draft.count(table)).map(|k| format!("{table}[{k}]")).collect::<Vec<_>>();
    each("stations").iter().try_for_each(|item| draft.read::<StationKeys>(item).map(drop))?;
    each("surfaces").iter().try_for_each(|item| draft.read::<SurfaceKeys>(item).map(drop))?;
    each("nacelles").iter().try_for_each(|item| draft.read::<NacelleKeys>(item).map(drop))?;
    each("panels").iter().try_for_each(|item| draft.read::<PanelKeys>(item).map(drop))?;
    each("struts").iter().try_for_each(|item| draft.read::<StrutKeys>(item).map(drop))?;
    each("windows").iter().try_for_each(|item| draft.read::<WindowKeys>(item).map(drop))?;
    each("plating").iter().try_for_each(|item| draft.read::<PlatingKeys>(item).map(drop))?;
    each("openings").iter().try_for_each(|item| draft.read::<OpeningKeys>(item).map(drop))?;
    draft.is_given("flotation").then(|| draft.read::<FlotationKeys>("flotation")).transpose()?;
    each("accelerometers").iter().try_for_each(|item| draft.read::<AccelerometerKeys>(item).map(drop))?;
    draft.is_given("beam").then(|| draft.read::<BeamKeys>("beam")).transpose()?;
    draft.is_given("sea").then(|| draft.read::<SeaKeys>("sea")).transpose()?;
    each("certify.loadings").iter().try_for_each(|item| draft.read::<LoadingKeys>(item).map(drop))?;
    each("certify.failures").iter().try_for_each(|item| draft.read::<FailureKeys>(item).map(drop))?;
    each("masses").iter().try_for_each(|item| draft.read::<MassKeys>(item).map(drop))?;
    draft.read("")
}

/// Files of a landing; the last only of one with plating.
pub const FILES: [&str; 6] =
    ["series.csv", "summary.json", "scene.resolved.toml", "report.html", "pressure_map.csv", "stress_map.csv"];

/// Follow a landing, then the sections of its plating, and write its files into a folder; `force` replaces those that it holds.
///
/// # Errors
/// The folder is a file, holds a landing, or cannot be written to.
pub fn run(scene: &Scene, out: &Path, force: bool) -> Result<Landed, RunError> {
    refuse_files(out, &FILES, force)?;
    let mut landed = follow(scene);
    landed.add_stresses(scene);
    fs::create_dir_all(out).map_err(|e| RunError::Write(out.display().to_string(), e))?;
    let mut texts = vec![
        landed.series.csv(),
        landed.summary.to_json(),
        scene.to_toml(),
        page::page(scene, &landed),
        landed.map_csv(),
    ];
    if !scene.plating.is_empty() {
        texts.push(plating::csv(&landed.summary.structure.plating));
    }
    for (name, text) in FILES.iter().zip(texts) {
        write(&out.join(name), &text)?;
    }
    if !scene.plating.is_empty() {
        let folder = out.join(plating_run::FOLDER);
        fs::create_dir_all(&folder).map_err(|e| RunError::Write(folder.display().to_string(), e))?;
        for (name, text) in plating::scenes(&landed.summary.structure.plating) {
            write(&out.join(name), text)?;
        }
    }
    Ok(landed)
}
