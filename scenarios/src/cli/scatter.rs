//! `splashdown scatter`.

use std::fs::{self, File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use decide::scatter::{Found, Sample, ScatterFile, found, run};
use decide::{EvaluateError, Evaluator};
use settings::{Problem, significant};

use super::decisions::{finish, stop};
use super::shared::{Output, Stop};

/// The samples so far, a line each, after a line with the file.
const SAMPLES: &str = "samples.jsonl";

#[derive(Args)]
pub(super) struct ScatterArgs {
    /// The file: a scene, and how its inputs scatter.
    file: PathBuf,
    /// Folder for the files (default: runs/NAME_scatter).
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Run all samples again. Without it, a folder of the same file goes on where it was cut.
    #[arg(long)]
    force: bool,
}

pub(super) fn run_scatter(output: &Output, args: &ScatterArgs) -> Result<u8, Stop> {
    let file = ScatterFile::read(&args.file).map_err(stop)?;
    let evaluator = Evaluator::new(&file.scene, &file.sets()).map_err(stop)?;
    let name = args.file.file_stem().unwrap_or_default().to_string_lossy();
    let out = args.out.clone().unwrap_or_else(|| PathBuf::from("runs").join(format!("{name}_scatter")));
    for key in file.inputs.keys() {
        let refused = |why: EvaluateError| Problem::new(&format!("inputs.{key}"), key.as_str(), why.to_string());
        evaluator.key(key).map_err(|why| stop(ScatterFile::error(&args.file, refused(why))))?;
    }
    let head = serde_json::to_string(&(env!("CARGO_PKG_VERSION"), &file)).unwrap_or_default();
    let path = out.join(SAMPLES);
    let known = if args.force { Vec::new() } else { known(&path, &head)? };
    fs::create_dir_all(&out).map_err(|e| Stop::Failed(format!("cannot create {}: {e}", out.display())))?;
    let mut lines = kept(&path, &head, &known)?;
    if !known.is_empty() {
        output.progress(format_args!("{} of {} samples are known", known.len(), file.samples));
    }
    let unwritten = |error: std::io::Error| EvaluateError::Key(format!("cannot write {}: {error}", path.display()));
    let samples = run(&file, &evaluator, known, |sample| {
        writeln!(lines, "{}", serde_json::to_string(sample).unwrap_or_default()).map_err(unwritten)
    });
    let samples = samples.map_err(stop)?;
    let found = found(&file, &samples);
    finish(output, &out, "scatter", &found, &words(&found), &[("table.csv", csv(&file, &samples))])
}

/// The samples in a file of the same head; a line that was cut and all after it are not known.
fn known(path: &Path, head: &str) -> Result<Vec<Sample>, Stop> {
    let Ok(text) = fs::read_to_string(path) else { return Ok(Vec::new()) };
    let mut lines = text.lines();
    if lines.next() != Some(head) {
        let folder = path.parent().unwrap_or(Path::new("")).display().to_string();
        return Err(Stop::Input(format!(
            "{folder} holds another scatter: expected another folder, or --force to replace it"
        )));
    }
    Ok(lines.map_while(|line| serde_json::from_str(line).ok()).collect())
}

/// The file with what is known, to go on.
fn kept(path: &Path, head: &str, known: &[Sample]) -> Result<File, Stop> {
    let lines = known.iter().map(|sample| serde_json::to_string(sample).unwrap_or_default());
    let text: String = std::iter::once(head.to_string()).chain(lines).map(|line| line + "\n").collect();
    let unwritten = |error: std::io::Error| Stop::Failed(format!("cannot write {}: {error}", path.display()));
    fs::write(path, text).map_err(unwritten)?;
    OpenOptions::new().append(true).open(path).map_err(unwritten)
}

fn words(found: &Found) -> String {
    let mut lines = vec![format!("{} samples, {} failed", found.samples, found.failed)];
    lines.extend(found.first_failure.iter().map(|why| format!("  NOTE: the first failure: {why}")));
    let inputs: Vec<&String> = found.inputs.keys().collect();
    for (name, of) in &found.results {
        let quantiles = of.quantiles.iter().map(|q| {
            let interval = match q.interval {
                Some([a, b]) => format!(" [{}, {}]", significant(a), significant(b)),
                None => " (no interval: too few samples, or too many missing)".into(),
            };
            format!("P{} {}{interval}", significant(100.0 * q.share), significant(q.value))
        });
        lines.push(format!("{name}: mean {}, {}", significant(of.mean), quantiles.collect::<Vec<_>>().join(", ")));
        if let Some(indices) = &of.indices {
            let of_input = |(key, (first, total)): (&&String, (&f64, &f64))| format!("{key} {first:.2} ({total:.2})");
            let parts: Vec<String> =
                inputs.iter().zip(indices.first.iter().zip(&indices.total)).map(of_input).collect();
            lines.push(format!("  share of the variance (with interactions): {}", parts.join(", ")));
        }
        let halves = of.quantiles.iter().map(|q| significant(q.of_half).to_string());
        lines.push(format!("  by half of the samples: {}", halves.collect::<Vec<_>>().join(", ")));
        let missing = "without this result, as those that failed: mean and quantiles are of the others, intervals hold whatever these would have given";
        for (share, what) in
            [(of.missing, missing), (of.without_band, "without a band"), (of.not_resolved, "not resolved")]
        {
            if share > 0.0 {
                lines.push(format!("  NOTE: {} % of the samples are {what}", significant(100.0 * share)));
            }
        }
    }
    lines.join("\n")
}

/// A row for each sample: inputs, then value and band of each result.
fn csv(file: &ScatterFile, samples: &[Sample]) -> String {
    let mut names: Vec<&String> = samples.iter().flat_map(|sample| sample.numbers.keys()).collect();
    names.sort();
    names.dedup();
    let cell = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:e}"));
    let head =
        file.inputs.keys().cloned().chain(names.iter().flat_map(|name| [(*name).clone(), format!("{name}.band")]));
    let row = |sample: &Sample| {
        let inputs = sample.inputs.iter().map(|value| cell(Some(*value)));
        let numbers = names.iter().flat_map(|name| {
            let number = sample.numbers.get(*name);
            [cell(number.map(|number| number.value)), cell(number.and_then(|number| number.band))]
        });
        inputs.chain(numbers).collect::<Vec<_>>().join(",")
    };
    let rows = std::iter::once(head.collect::<Vec<_>>().join(",")).chain(samples.iter().map(row));
    rows.map(|row| row + "\n").collect()
}
