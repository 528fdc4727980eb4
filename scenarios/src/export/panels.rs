//! The panels of a run with their loads, from its folder.

use std::path::{Path, PathBuf};

use run::load;
use run::log::read_samples;
use run::observers::{LOADS, load_names};
use scene::{Scene, read_text};
use serde_json::Value;

use super::loads::PanelLoads;
use super::structure::PanelModel;
use super::{ExportError, loads_missing, time_of_run};

/// A form of the loads on panels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PanelFormat {
    /// Tables (CSV).
    Tables,
    /// Nastran bulk data.
    Nastran,
}

/// What was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExportedPanels {
    /// The folder of the files.
    pub folder: PathBuf,
    /// Names of the panels.
    pub panels: Vec<String>,
    /// Samples of each.
    pub samples: usize,
}

/// Writes the panels of the run in `dir` with their loads to the folder `dir/loads` or `dir/nastran`, whose files of the same names are
/// replaced.
///
/// # Errors
/// [`ExportError::NoScene`], [`ExportError::NoLoads`], [`ExportError::Write`].
pub fn export_panels(dir: &Path, format: PanelFormat) -> Result<ExportedPanels, ExportError> {
    let scene = scene_of(dir)?;
    let no_loads = |why: &str| loads_missing(dir, why);
    let models = PanelModel::of(&scene);
    if models.is_empty() {
        return Err(no_loads("its body has no panels, whose nodes have loads"));
    }
    let summary: Value =
        read_text(dir.join("summary.json")).ok().and_then(|text| serde_json::from_str(&text).ok()).unwrap_or_default();
    let mut found = Vec::new();
    for model in models {
        let name = model.panel.name.clone();
        let names = load_names(model.nodes.len());
        let samples = read_samples(&dir.join("log.mcap"), &format!("{LOADS}/{name}"), &names);
        let samples = samples.map_err(|why| no_loads(&format!("log.mcap cannot be read: {why}")))?;
        if samples.times.is_empty() {
            return Err(no_loads(&format!("its log has no loads of `{name}`: an earlier version wrote it")));
        }
        let number = |value: &f64| if value.is_finite() { *value } else { 0.0 };
        let row = |row: &Vec<f64>| row.chunks_exact(3).map(|l| [number(&l[0]), number(&l[1]), number(&l[2])]).collect();
        found.push(PanelLoads {
            model,
            times: samples.times.iter().map(|time| time_of_run(*time, scene.time.start)).collect(),
            loads: samples.rows.iter().map(row).collect(),
            envelope: summary.pointer(&format!("/panels/{name}/envelope")).cloned(),
        });
    }
    let folder = dir.join(match format {
        PanelFormat::Tables => "loads",
        PanelFormat::Nastran => "nastran",
    });
    let wrong = |error| ExportError::Write(folder.display().to_string(), error);
    std::fs::create_dir_all(&folder).map_err(wrong)?;
    for panel in &found {
        match format {
            PanelFormat::Tables => panel.write_tables(&folder),
            PanelFormat::Nastran => panel.write_nastran(&folder),
        }
        .map_err(wrong)?;
    }
    let samples = found.first().map_or(0, |panel| panel.times.len());
    Ok(ExportedPanels {
        panels: found.into_iter().map(|panel| panel.model.panel.name.clone()).collect(),
        folder,
        samples,
    })
}

/// The scene of the run in a folder.
pub(super) fn scene_of(dir: &Path) -> Result<Scene, ExportError> {
    let path = dir.join("scene.resolved.toml");
    let no_scene = |why: String| ExportError::NoScene(path.display().to_string(), why);
    read_text(&path).map_err(|why| no_scene(why.to_string()))?;
    Ok(load(&path.to_string_lossy(), &[]).map_err(|why| no_scene(why.to_string()))?.scene)
}
