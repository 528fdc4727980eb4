//! The folder of a run: all that its page is made of.

use std::path::{Path, PathBuf};

use run::log::LogReader;
use scene::vocabulary::{ResultName, Status};
use scene::{Scene, SceneError};

use super::record::Record;
use super::table::Curves;

/// A run as its folder holds it.
pub(crate) struct RunFolder {
    /// The folder.
    pub path: PathBuf,
    /// The scene as run.
    pub scene: Scene,
    /// Warnings about the scene.
    pub warnings: Vec<String>,
    /// The summary; empty where the run was killed.
    pub record: Record,
    /// The sampled curves.
    pub curves: Curves,
    /// The log, where there is one.
    pub log: Option<LogReader>,
    /// What is missing or damaged, in sentences.
    pub gaps: Vec<String>,
}

/// Why a folder holds no run.
#[derive(Debug, thiserror::Error)]
pub enum FolderError {
    /// The folder has no resolved scene.
    #[error("{0}: expected the folder of a run, with scene.resolved.toml in it")]
    NoRun(String),
    /// The scene is not one that this program reads.
    #[error(transparent)]
    Scene(#[from] Box<SceneError>),
    /// The summary is damaged.
    #[error("{0}: expected the summary of a run: {1}")]
    Summary(String, serde_json::Error),
}

/// The interface by which a host moved the body of a run, by its resolved scene.
fn host_of(scene: &Path) -> Option<String> {
    let text = std::fs::read_to_string(scene).ok()?;
    text.lines().next()?.strip_prefix(run::folder::HOST_MARK).map(str::to_string)
}

impl RunFolder {
    /// Read a folder; a run that was killed, and a log that was cut, are read as far as they go.
    ///
    /// # Errors
    /// No resolved scene, one that cannot be read, or a summary that is not JSON.
    pub fn read(path: &Path) -> Result<RunFolder, FolderError> {
        let file = |name: &str| path.join(name);
        let name = file("scene.resolved.toml").display().to_string();
        if !file("scene.resolved.toml").is_file() {
            return Err(FolderError::NoRun(path.display().to_string()));
        }
        let loaded = run::load_beyond_limits(&name, &[]).map_err(Box::new)?;
        let mut gaps = Vec::new();
        let mut record: Record = match std::fs::read_to_string(file("summary.json")) {
            Ok(text) => serde_json::from_str(&text)
                .map_err(|e| FolderError::Summary(file("summary.json").display().to_string(), e))?,
            Err(_) => {
                gaps.push("there is no summary.json: the run was killed, or is still running".into());
                Record::default()
            }
        };
        if record.host.is_none() {
            record.host = host_of(&file("scene.resolved.toml"));
        }
        let curves = Curves::read(&file("series.csv"));
        if curves.times().is_empty() {
            gaps.push("series.csv is missing or empty: there are no curves".into());
        }
        let log = LogReader::open(&file("log.mcap")).filter(|log| !log.times().is_empty());
        if log.is_none() {
            gaps.push("log.mcap is missing or holds no frame: there are no pictures of the flow".into());
        }
        Ok(RunFolder {
            path: path.to_owned(),
            scene: loaded.scene,
            warnings: if record.warnings.is_empty() { loaded.warnings } else { record.warnings.clone() },
            record,
            curves,
            log,
            gaps,
        })
    }

    /// Name of the model that was run.
    pub fn model(&self) -> &str {
        if self.record.model.is_empty() { self.scene.model.name() } else { &self.record.model }
    }

    /// True where the run broke down: what it computed is no result.
    pub fn has_failed(&self) -> bool {
        self.record.status() == Status::Failed
    }

    /// True where the run was ended by its user, or at a rupture: its results are those so far.
    pub fn is_interrupted(&self) -> bool {
        matches!(self.record.status(), Status::Interrupted | Status::Ruptured)
    }

    /// The gauge whose pressure is the peak pressure among the results.
    pub fn gauge_of_peak(&self) -> Option<&String> {
        let raw = self.record.results.get(ResultName::PeakPressure)?.raw;
        let is_it = |peak: f64| (peak - raw).abs() <= 1e-9 * raw.abs();
        self.record.gauges.iter().find(|(_, gauge)| gauge.peak_pa.is_some_and(is_it)).map(|(name, _)| name)
    }

    /// A short name: that of the folder.
    pub fn name(&self) -> String {
        self.path.file_name().map_or_else(|| self.scene.name.clone(), |name| name.to_string_lossy().into_owned())
    }
}
