//! `splashdown studio`.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};

use clap::Args;
use scene::SceneError;
use studio::{Options, Studio};

use super::shared::{DONE, Output, Stop};
use crate::templates::TEMPLATES;

/// The scene without a SCENE.
const FIRST: &str = "section";

static ENDED: AtomicBool = AtomicBool::new(false);

#[derive(Args)]
pub(super) struct StudioArgs {
    /// Name of a built-in scene, or path of a TOML file (default: a section to begin with).
    scene: Option<String>,
    /// Folder for files and runs (default: that of the scene's file, else the present one).
    #[arg(long, value_name = "DIR")]
    dir: Option<PathBuf>,
    /// Port of this machine (default: one that is free).
    #[arg(long, value_name = "PORT", default_value_t = 0)]
    port: u16,
    /// Print the address and open no browser.
    #[arg(long)]
    no_browser: bool,
}

pub(super) fn run_studio(output: &Output, args: &StudioArgs, program: &[OsString]) -> Result<u8, Stop> {
    let scenes =
        TEMPLATES.iter().filter(|(name, _)| *name != "ditching").map(|(name, text)| (format!("new {name}"), text));
    let builtin = scene::builtin().iter().map(|(name, text)| ((*name).to_string(), text));
    let examples = scenes.chain(builtin).map(|(name, text)| (name, (*text).to_string())).collect();
    let (text, file, beside) = opened(args.scene.as_deref())?;
    let folder = args.dir.clone().or(beside).unwrap_or_else(|| PathBuf::from("."));
    if !folder.is_dir() {
        return Err(Stop::Input(format!("--dir {}: expected a folder", folder.display())));
    }
    let options = Options { folder, port: args.port, text, file, examples, program: program.to_vec() };
    let studio = Studio::open(options).map_err(|error| Stop::Input(error.to_string()))?;
    ctrlc::set_handler(|| ENDED.store(true, Ordering::Relaxed))
        .map_err(|error| Stop::Failed(format!("cannot listen for Ctrl-C: {error}")))?;
    let address = studio.address();
    output.result(&serde_json::json!({ "address": address }), &format!("{address}\nCtrl-C ends it."));
    if !args.no_browser && !open_browser(&address) {
        output.progress(format_args!("no browser found: open the address above"));
    }
    studio.serve(&ENDED);
    Ok(DONE)
}

/// Text, name of its file, and the folder of its file.
fn opened(scene: Option<&str>) -> Result<(String, String, Option<PathBuf>), Stop> {
    let Some(name) = scene else {
        let text = TEMPLATES.iter().find(|(name, _)| *name == FIRST).map_or("", |(_, text)| text);
        return Ok((text.into(), format!("{FIRST}.toml"), None));
    };
    if let Some((name, text)) = scene::builtin().iter().find(|(own, _)| *own == name) {
        return Ok(((*text).to_string(), format!("{name}.toml"), None));
    }
    let path = Path::new(name);
    match scene::read_text(path) {
        Ok(text) => {
            let file = path.file_name().map(|file| file.to_string_lossy().into_owned());
            let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).map(Path::to_path_buf);
            Ok((text, file.unwrap_or_default(), folder))
        }
        // what is wrong with the path, in the words of all commands
        Err(cause) => match run::load(name, &[]) {
            Err(error @ (SceneError::Unknown { .. } | SceneError::Unreadable { .. } | SceneError::Mistaken { .. })) => {
                Err(error.into())
            }
            _ => Err(Stop::Input(format!("{name}: {cause}"))),
        },
    }
}

/// Opens an address in the user's browser; false where there is none.
fn open_browser(address: &str) -> bool {
    let (program, before): (&str, &[&str]) = match std::env::consts::OS {
        "macos" => ("open", &[]),
        "windows" => ("rundll32", &["url.dll,FileProtocolHandler"]),
        _ => ("xdg-open", &[]),
    };
    let mut command = Command::new(program);
    command.args(before).arg(address).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command.spawn().is_ok()
}
