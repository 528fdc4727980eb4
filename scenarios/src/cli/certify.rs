//! `splashdown certify`.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use settings::significant;

use super::shared::{DONE, Output, SceneArgs, Stop, say, to_json, write};
use crate::certify::batch::{BatchError, Records};
use crate::certify::{Case, Findings, Plan, cases_csv, dossier, pressure_csv};

#[derive(Args)]
pub(super) struct CertifyArgs {
    #[command(flatten)]
    scene: SceneArgs,
    /// Folder for the files (default: runs/certify_SCENE); a folder of the same cases goes on where it was cut.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Run all cases again, and replace those that the folder holds.
    #[arg(long)]
    force: bool,
    /// Print the cases and what they would cost, without running them.
    #[arg(long, conflicts_with_all = ["out", "force"])]
    list: bool,
    /// Print the command that repeats a case.
    #[arg(long, value_name = "NUMBER", conflicts_with_all = ["out", "force", "list"])]
    case: Option<usize>,
}

pub(super) fn run_certify(output: &Output, args: &CertifyArgs) -> Result<u8, Stop> {
    let plan = Plan::read(&args.scene.scene, &args.scene.sets)?;
    if args.list {
        list(output, &plan);
        return Ok(DONE);
    }
    if let Some(number) = args.case {
        let case = plan.cases.iter().find(|case| case.number == number);
        let expected = || Stop::Input(format!("--case {number}: expected a number of the list, which `--list` prints"));
        say(plan.command(case.ok_or_else(expected)?));
        return Ok(DONE);
    }
    let out = args.out.clone().unwrap_or_else(|| PathBuf::from("runs").join(format!("certify_{}", plan.scene.name)));
    run(output, &plan, &out, args.force)
}

/// Cases and cost.
fn list(output: &Output, plan: &Plan) {
    let (seconds, threads) = (plan.core_seconds(), rayon::current_num_threads());
    if output.json {
        let cost = serde_json::json!({"core_seconds_at_most": seconds, "combinations": plan.combinations, "cases": plan.cases});
        return say(to_json(&cost));
    }
    for case in &plan.cases {
        let outside = case.outside.as_ref().map_or(String::new(), |why| format!(": not run, {why}"));
        say(format_args!("{:>6} {}{outside}", case.number, case.words()));
    }
    say(format_args!(
        "{} cases of {} combinations; at most {} core-seconds, {} minutes on {threads} threads",
        plan.cases.len(),
        plan.combinations,
        significant(seconds),
        significant(seconds / 60.0 / threads as f64)
    ));
}

fn run(output: &Output, plan: &Plan, out: &Path, force: bool) -> Result<u8, Stop> {
    let records = Records::open(out, &plan.head(), &plan.cases, force).map_err(stop)?;
    let (known, all) = (records.known(), plan.cases.len());
    if known > 0 {
        output.progress(format_args!("{known} of {all} cases are known"));
    }
    let (start, threads) = (Instant::now(), rayon::current_num_threads());
    let mut said = known;
    let records = records.run(
        &plan.cases,
        threads,
        |case: &Case| plan.run(case),
        |ended| {
            if 20 * (ended - said) >= all || ended == all {
                said = ended;
                output.progress(format_args!("{ended} of {all} cases"));
            }
        },
    );
    let records = records.map_err(stop)?;
    let found = Findings::new(plan, &records);
    let tables = [
        ("cases.csv", cases_csv(&plan.cases, &records)),
        ("pressure_envelope.csv", pressure_csv(&found)),
        ("certify.html", dossier(plan, &found)),
        ("certify.json", to_json(&found)),
    ];
    tables.iter().try_for_each(|(name, text)| replace(&out.join(name), text))?;
    output.result(&found, &found.words());
    let (ran, seconds) = (all - known, significant(start.elapsed().as_secs_f64()));
    output.progress(format_args!("{ran} cases in {seconds} s of wall time on {threads} threads"));
    if !output.json && !output.quiet {
        say(format_args!("files in {}: open certify.html", out.display()));
    }
    match found.counts.completed + found.counts.doubtful {
        0 => Err(Stop::Failed("no case completed: certify.html has the reasons".into())),
        _ => Ok(DONE),
    }
}

/// Write beside the file, then rename: it is there as a whole or not at all.
fn replace(path: &Path, text: &str) -> Result<(), Stop> {
    let beside = path.with_extension("part");
    write(&beside, text)?;
    fs::rename(&beside, path).map_err(|e| Stop::Failed(format!("cannot write {}: {e}", path.display())))
}

fn stop(error: BatchError) -> Stop {
    match error {
        BatchError::Write(..) => Stop::Failed(error.to_string()),
        BatchError::Other(_) | BatchError::Locked(_) => Stop::Input(error.to_string()),
    }
}
