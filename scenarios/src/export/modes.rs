//! The panels of a run as files of natural modes, which `body.modes_file` reads.

use std::path::{Path, PathBuf};

use fsi_coupling::PanelModes;
use scene::{MILLIMETRE, Modes, NaturalMode, line};
use structure_fe::Damping;

use super::panels::scene_of;
use super::structure::PanelModel;
use super::{ExportError, loads_missing};

/// What was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExportedModes {
    /// The folder of the files.
    pub folder: PathBuf,
    /// Names of the panels.
    pub panels: Vec<String>,
}

/// Writes the `count` lowest modes of each panel of the run in `dir` to `dir/modes/NAME.toml`, which is replaced.
///
/// # Errors
/// [`ExportError::NoScene`], [`ExportError::NoLoads`], [`ExportError::Write`].
pub fn export_modes(dir: &Path, count: usize) -> Result<ExportedModes, ExportError> {
    let scene = scene_of(dir)?;
    let models = PanelModel::of(&scene);
    let body = scene.body.as_ref().filter(|_| !models.is_empty());
    let body = body.ok_or_else(|| loads_missing(dir, "its body has no panels, which have modes"))?;
    let folder = dir.join("modes");
    let wrong = |error| ExportError::Write(folder.display().to_string(), error);
    std::fs::create_dir_all(&folder).map_err(wrong)?;
    let damping = Damping { mass: body.damping[0], stiffness: body.damping[1] };
    let mut panels = Vec::new();
    for model in &models {
        let name = &model.panel.name;
        let found = PanelModes::of(&line(&body.shape), &model.panel.spec(), count, damping);
        let found = found.map_err(|why| loads_missing(dir, &format!("the modes of `{name}`: {why}")))?;
        let mode = |m: &fsi_coupling::SurfaceMode| NaturalMode {
            frequency: m.mode.frequency,
            mass: m.mode.mass,
            damping_ratio: m.mode.damping_ratio,
            shape: m.mode.shape.clone(),
            stress: m.stress.iter().map(|stress| MILLIMETRE * stress).collect(),
        };
        let modes = found.modes.iter().map(mode).collect();
        let modes = Modes { nodes: found.nodes, masses: found.masses, modes };
        let mut text: String = model.heading("natural modes in air").iter().map(|line| format!("# {line}\n")).collect();
        text +=
            "# Of a metre of span; shapes with a largest displacement of 1, stress of the wet fibre at 1 mm [Pa].\n";
        text += &toml::to_string(&modes).expect("modes have a TOML form");
        std::fs::write(folder.join(format!("{name}.toml")), text).map_err(wrong)?;
        panels.push(name.clone());
    }
    Ok(ExportedModes { folder, panels })
}
