//! Experiments on the command line: selection of cases, their list, tables and files.

pub(super) mod convergence;
pub(super) mod coverage;
pub(super) mod stability;
pub(super) mod validation;
pub(super) mod work_precision;

use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;

use super::shared::{DONE, Output, Stop, say};
use crate::experiments::ExperimentError;
use crate::experiments::catalogue::{self, Case, Catalogue};

/// Cases of an experiment, and the file of its table.
#[derive(Args)]
struct Selection {
    /// Cases to run: names of built-in ones, or TOML files like those in scenarios/cases. Without any, they are listed.
    cases: Vec<String>,
    /// Run every built-in case.
    #[arg(long, conflicts_with = "cases")]
    all: bool,
    /// Write the table to this Markdown file.
    #[arg(long, value_name = "FILE")]
    table: Option<PathBuf>,
}

impl Selection {
    fn is_empty(&self) -> bool {
        self.cases.is_empty() && !self.all
    }

    /// Print the result as JSON or as a table; keep the table, below a heading.
    fn show(&self, output: &Output, result: &impl Serialize, heading: &str, table: &str) -> Result<(), Stop> {
        output.result(result, table);
        if let Some(path) = &self.table {
            catalogue::write(path, &format!("{heading}\n\n{table}"))?;
        }
        Ok(())
    }
}

impl From<ExperimentError> for Stop {
    fn from(error: ExperimentError) -> Stop {
        match error {
            ExperimentError::Scene(e) => e.into(),
            ExperimentError::Run(e) => e.into(),
            other if other.is_input() => Stop::Input(other.to_string()),
            other => Stop::Failed(other.to_string()),
        }
    }
}

/// List the built-in cases.
fn list<C: Case>(cases: &Catalogue<C>) -> Result<u8, Stop> {
    for case in cases.all()? {
        let [name, about] = case.title();
        say(format_args!("{name:<24} {about}"));
    }
    Ok(DONE)
}

/// Run cases that give lines of one table, one after another.
fn lines_of<C: Case, Line>(
    output: &Output,
    cases: &[C],
    run: impl Fn(&C) -> Result<Vec<Line>, ExperimentError>,
) -> Result<Vec<Line>, Stop> {
    let mut lines = Vec::new();
    for case in cases {
        output.progress(format_args!("{} …", case.title()[0]));
        lines.extend(run(case)?);
    }
    Ok(lines)
}

/// Write text files into a folder.
fn write_all(folder: &Path, files: &[(String, String)]) -> Result<(), ExperimentError> {
    files.iter().try_for_each(|(name, text)| catalogue::write(&folder.join(name), text))
}
