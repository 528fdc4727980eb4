//! `splashdown report`.

use std::path::PathBuf;

use clap::Args;

use super::shared::{DONE, Output, Stop, say, write};
pub use report::run_page::{self, FigureError, FolderError};

#[derive(Args)]
pub(super) struct ReportArgs {
    /// Folders of runs: of one, its page is made again; of several, a page that compares them with the first.
    #[arg(required = true, value_name = "DIR")]
    folders: Vec<PathBuf>,
    /// File of the page (default: DIR/report.html of one run, comparison.html of several).
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Write each figure of each run to DIR/figures, as SVG, and pictures of the flow as PNG too.
    #[arg(long)]
    figures: bool,
}

impl From<FolderError> for Stop {
    fn from(error: FolderError) -> Stop {
        match error {
            FolderError::Scene(error) => (*error).into(),
            other => Stop::Input(other.to_string()),
        }
    }
}

impl From<FigureError> for Stop {
    fn from(error: FigureError) -> Stop {
        match error {
            FigureError::Folder(error) => error.into(),
            other => Stop::Failed(other.to_string()),
        }
    }
}

pub(super) fn make_report(output: &Output, args: &ReportArgs) -> Result<u8, Stop> {
    let (page, usual) = match args.folders.as_slice() {
        [only] => (run_page::report(only)?, only.join("report.html")),
        several => (run_page::compare(several)?, PathBuf::from("comparison.html")),
    };
    let out = args.out.clone().unwrap_or(usual);
    write(&out, &page)?;
    let mut files = vec![out];
    if args.figures {
        for folder in &args.folders {
            files.extend(run_page::write_figures(folder)?);
        }
    }
    let files: Vec<String> = files.iter().map(|file| file.display().to_string()).collect();
    match output.json {
        true => say(serde_json::json!({ "files": files })),
        false if !output.quiet => files.iter().for_each(say),
        false => {}
    }
    Ok(DONE)
}
