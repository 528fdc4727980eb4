//! What `splashdown sweep` prints at the end.

use serde_json::json;
use settings::significant;

use crate::cli::shared::{Output, say, to_json};
use crate::sweep::{Collected, SweepFolder, WorstCase, worst_cases};

/// How the points of this call were run.
pub(super) struct Ended<'a> {
    /// Points that were to run.
    pub left: &'a [&'a str],
    /// Different points.
    pub distinct: usize,
    /// Processes at the same time.
    pub jobs: usize,
    /// Threads of each.
    pub threads: usize,
    /// Wall-clock time of all [s].
    pub wall_time_s: f64,
}

pub(super) fn show(output: &Output, collected: &Collected, folder: &SweepFolder, ended: &Ended<'_>) {
    let worst = worst_cases(collected);
    let (done, failed) = (collected.completed().count(), collected.failed().count());
    let reused = ended.distinct - ended.left.len();
    let ran = collected.points.iter().filter(|p| p.id.as_deref().is_some_and(|id| ended.left.contains(&id)));
    let mut seen = std::collections::HashSet::new();
    let spent: f64 = ran.filter(|p| seen.insert(p.id.clone())).filter_map(|p| p.wall_time_s).sum();
    // a point that an earlier call had begun counts for what it took here, at most
    let busy = (spent / (ended.wall_time_s * ended.jobs as f64).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    if output.json {
        let file = |name: &str| folder.file(name).display().to_string();
        let failures: Vec<_> = collected
            .failed()
            .map(|p| json!({"point": p.number, "status": p.status, "message": p.message, "folder": p.id}))
            .collect();
        say(to_json(&json!({
            "points": collected.points.len(),
            "done": done,
            "failed": failed,
            "reused": reused,
            "run": ended.left.len(),
            "jobs": ended.jobs,
            "threads": ended.threads,
            "wall_time_s": ended.wall_time_s,
            "busy": busy,
            "worst": worst,
            "failures": failures,
            "table": file("table.csv"),
            "page": file("sweep.html"),
        })));
        return;
    }
    if output.quiet {
        return;
    }
    let of = |case: &WorstCase| {
        let band = case.band.map_or(String::new(), |band| format!(" ± {}", significant(band)));
        let verdict = case.verdict.map_or(String::new(), |verdict| format!(", {}", verdict.name()));
        let name = [case.scene.as_deref().unwrap_or(""), &case.place, &case.quantity];
        let name: Vec<&str> = name.into_iter().filter(|word| !word.is_empty()).collect();
        format!("  worst {}: {}{band}{verdict}, point {}", name.join(" "), significant(case.value), case.point)
    };
    let ran = match ended.left.len() {
        0 => String::new(),
        count => format!(
            "; {count} run now in {:.1} s ({:.0} % of {} processes busy)",
            ended.wall_time_s,
            100.0 * busy,
            ended.jobs
        ),
    };
    let mut lines =
        vec![format!("{} points: {done} done, {failed} failed{ran}; {reused} found", collected.points.len())];
    lines.extend(worst.iter().filter(|case| case.place != "audit" && !case.quantity.starts_with("audit.")).map(of));
    lines.push(format!("files in {}: open sweep.html, table.csv, worst.csv", folder.path().display()));
    say(lines.join("\n"));
}
