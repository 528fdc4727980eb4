//! `splashdown run --to`.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};

use report::Table;
use settings::significant;

use super::write_all;
use crate::cli::shared::{DONE, Output, SceneArgs, Stop, load};
use crate::experiments::accuracy::{Achieved, By, Done, Request, refine};

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// File of the outcome.
const FILE: &str = "accuracy.json";

pub fn run_to(
    output: &Output,
    given: &SceneArgs,
    share: f64,
    results: &[String],
    out: Option<PathBuf>,
) -> Result<u8, Stop> {
    let name = load(given)?.scene.name;
    let out = out.unwrap_or_else(|| PathBuf::from("runs").join(format!("{name}_to")));
    let request = Request {
        scene: given.scene.clone(),
        sets: given.sets.clone(),
        share,
        results: results.to_vec(),
        out: out.clone(),
        interrupt: Some(&INTERRUPTED),
    };
    let end = || {
        if INTERRUPTED.swap(true, Ordering::Relaxed) {
            std::process::exit(130); // asked twice
        }
    };
    ctrlc::set_handler(end).map_err(|e| Stop::Failed(format!("cannot listen for Ctrl-C: {e}")))?;
    let done = refine(&request, |text| output.progress(format_args!("{text} …")))?;
    let json = serde_json::to_string_pretty(&done).unwrap_or_default();
    write_all(&out, &[(FILE.into(), json)])?;
    output.result(&done, &text(&done, share));
    match done.within {
        true => Ok(DONE),
        false => Err(Stop::Failed(format!("not all results are within {} %", significant(100.0 * share)))),
    }
}

fn text(done: &Done, share: f64) -> String {
    let percent = |share: f64| format!("{} %", significant(100.0 * share));
    let row = |result: &Achieved| {
        let by = match result.by {
            By::Run => "band of the run",
            By::Study => "study of three spacings",
            By::Nothing => "no band",
        };
        vec![
            result.name.clone(),
            significant(result.value),
            result.share.map_or("–".into(), percent),
            by.into(),
            if result.within { "yes" } else { "no" }.into(),
        ]
    };
    let within = format!("within {}", percent(share));
    let table = Table::new("", &["result", "value", "band", "of", &within], done.results.iter().map(row).collect());
    let spacing = done.spacing_m.map_or(String::new(), |dx| format!(", spacing {} m", significant(dx)));
    format!(
        "{}\nmodel {}{spacing}; {:.1} core-s, {:.1} stated before; {}\n",
        table.markdown(),
        done.model,
        done.core_seconds,
        done.estimated_core_seconds,
        done.folder.display()
    )
}
