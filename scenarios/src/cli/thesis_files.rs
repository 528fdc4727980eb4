//! `splashdown import`, and `export` to INDAT and IPART of the solver of 2010.

use std::path::{Path, PathBuf};

use clap::Args;
use scene::read_text;
use settings::Problem;

use super::shared::{DONE, Output, SceneArgs, Stop, load, say, write};
use crate::thesis_files::{Indat, Ipart, ThesisFileError, files_of, scene_of};

#[derive(Args)]
pub(super) struct ImportArgs {
    /// File of the parameters.
    indat: PathBuf,
    /// File of the particles.
    ipart: PathBuf,
    /// Write the scene to this file, which must not exist, instead of to stdout.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

impl From<ThesisFileError> for Stop {
    fn from(error: ThesisFileError) -> Stop {
        let sentence = error.to_string();
        let ThesisFileError { at, given, expected } = error;
        Stop::Line(Box::new(Problem {
            sentence,
            given: Some(given),
            expected,
            line: Some(Box::new(at)),
            ..Problem::default()
        }))
    }
}

fn text_of(path: &Path) -> Result<String, Stop> {
    read_text(path).map_err(|cause| Stop::Input(format!("cannot read {}: {cause}", path.display())))
}

pub(super) fn import(output: &Output, args: &ImportArgs) -> Result<u8, Stop> {
    let names = [&args.indat, &args.ipart].map(|path| path.display().to_string());
    let indat = Indat::parse(&names[0], &text_of(&args.indat)?)?;
    let ipart = Ipart::parse(&names[1], &text_of(&args.ipart)?)?;
    let stem = args.out.as_ref().and_then(|path| path.file_stem()).map(|stem| stem.to_string_lossy().into_owned());
    let fits = |name: &String| name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-');
    let name = stem.filter(|name| !name.is_empty() && name.len() <= 100 && fits(name)).unwrap_or("imported".into());
    let imported = scene_of(&name, &indat, &ipart, [&names[0], &names[1]])?;
    run::load_text("the imported scene", &imported.text, &[])?;
    match &args.out {
        None => say(imported.text.trim_end()),
        Some(path) if path.exists() => {
            return Err(Stop::Input(format!(
                "--out {}: expected the name of a new file, this one exists",
                path.display()
            )));
        }
        Some(path) => {
            write(path, &imported.text)?;
            imported.notes.iter().for_each(|note| output.progress(format_args!("  {note}")));
            output.progress(format_args!("wrote {path}; next: splashdown check {path}", path = path.display()));
        }
    }
    Ok(DONE)
}

pub(super) fn export(output: &Output, scene: &SceneArgs, indat_file: &Path, ipart_file: &Path) -> Result<u8, Stop> {
    let loaded = load(scene)?;
    if loaded.scene.resolution.growth != 1.0 {
        return Err(Stop::Input(format!(
            "`resolution.growth` = {}: expected 1 for IPART, which has no masses: add --set resolution.growth=1, and a \
             resolution.spacing that all the water can have",
            loaded.scene.resolution.growth
        )));
    }
    let (indat, ipart, notes) = files_of(&loaded.scene).map_err(|error| Stop::Failed(error.to_string()))?;
    write(indat_file, &indat.to_text())?;
    write(ipart_file, &ipart.to_text())?;
    notes.iter().for_each(|note| output.progress(format_args!("  {note}")));
    output.progress(format_args!("wrote {} particles", ipart.particles.len()));
    Ok(DONE)
}
