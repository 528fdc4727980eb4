//! `splashdown size`.

use std::path::PathBuf;

use clap::Args;
use decide::Evaluator;
use decide::size::{Limit, Question, Sized, Values};
use settings::significant;

use super::decisions::{finish, folder, number, stop};
use super::shared::{Output, SceneArgs, Stop};

/// Ends of the range that is tried without `--from` and `--to`, over the scene's own value.
const USUAL_RANGE: [f64; 2] = [0.25, 4.0];
/// The model inside, where the scene is one of particles.
const CHEAP: &str = "boundary_element";

#[derive(Args)]
pub(super) struct SizeArgs {
    #[command(flatten)]
    scene: SceneArgs,
    /// Key whose value is looked for, as panels.belly.thickness or body.deadrise_deg.
    #[arg(long = "for", value_name = "KEY")]
    key: String,
    /// Smallest value, as 0.002 or "2 mm" (default: a quarter of the scene's).
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true)]
    from: Option<String>,
    /// Largest value (default: four times the scene's).
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true)]
    to: Option<String>,
    /// Values that can be had, such as gauges of sheet: --values 0.002,0.0025,0.003 or "2 mm, 2.5 mm, 3 mm".
    #[arg(long, value_name = "LIST", value_delimiter = ',', allow_hyphen_values = true, conflicts_with_all = ["from", "to"])]
    values: Vec<String>,
    /// Factor by which allowable stresses and limits are kept away from.
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0)]
    reserve: f64,
    /// Largest value of a result, as peak_acceleration_g=8 (repeatable); stresses have body.panels.allowable_stress.
    #[arg(long = "limit", value_name = "RESULT=VALUE")]
    limits: Vec<String>,
    /// Confirm the value by particles.
    #[arg(long)]
    confirm: bool,
    /// Folder for the files (default: runs/SCENE_size).
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replace the files that the folder holds.
    #[arg(long)]
    force: bool,
}

pub(super) fn run_size(output: &Output, args: &SizeArgs) -> Result<u8, Stop> {
    let SceneArgs { scene, sets } = &args.scene;
    let own = Evaluator::new(scene, sets).map_err(stop)?;
    let key = own.key(&args.key).map_err(stop)?;
    let out = folder(&args.out, &own, "size", args.force)?;
    let (values, reserve) = (values(args, &own, &key)?, args.reserve);
    if !(reserve > 0.0 && reserve.is_finite()) {
        return Err(Stop::Input(format!("--reserve {reserve}: expected a factor above 0")));
    }
    let limits = args.limits.iter().map(|text| limit(text)).collect::<Result<Vec<_>, Stop>>()?;
    let question = Question { key, values, reserve, limits, confirm: args.confirm };
    let cheap = Evaluator::new(scene, &[&sets[..], &[format!("model={CHEAP}")]].concat());
    let is_theory = own.load(&[]).map_err(stop)?.scene.model.is_theory();
    let sized = match cheap {
        Ok(cheap) if !is_theory => question.answer(&cheap, &own),
        _ => question.answer(&own, &own),
    };
    let sized = sized.map_err(stop)?;
    finish(output, &out, "size", &sized, &words(&sized), &[("trials.csv", csv(&sized))])
}

fn values(args: &SizeArgs, own: &Evaluator, key: &str) -> Result<Values, Stop> {
    let read = |text: &String| own.read(key, text).map_err(stop);
    if !args.values.is_empty() {
        let mut values = args.values.iter().map(read).collect::<Result<Vec<f64>, Stop>>()?;
        values.sort_by(f64::total_cmp);
        values.dedup();
        return match values.len() {
            1 => Err(Stop::Input("--values: expected two or more".into())),
            _ => Ok(Values::List(values)),
        };
    }
    let value = own.value(key).map_err(stop)?;
    let usual = USUAL_RANGE.map(|share| share * value);
    let given = |text: &Option<String>, usual: f64| text.as_ref().map_or(Ok(usual), read);
    let [from, to] = [given(&args.from, usual[0].min(usual[1]))?, given(&args.to, usual[0].max(usual[1]))?];
    if from >= to {
        return Err(Stop::Input(format!("--from {from} --to {to}: expected a smaller and a larger value")));
    }
    Ok(Values::Range([from, to]))
}

fn limit(text: &str) -> Result<Limit, Stop> {
    let (name, most) = number("--limit", text, "RESULT=VALUE, as peak_acceleration_g=8")?;
    if most <= 0.0 {
        return Err(Stop::Input(format!("--limit {text}: expected a value above 0")));
    }
    Ok(Limit { name, most })
}

fn words(sized: &Sized) -> String {
    let Sized { key, value, is_largest, decided, confirmed, trials, notes, .. } = sized;
    let end = if *is_largest { "largest" } else { "smallest" };
    let of = |trial: &decide::size::Trial| {
        let band = trial.margin.band.map_or(String::new(), |band| format!(" ± {}", significant(band)));
        let (name, result) = (&trial.margin.decided_by, significant(trial.margin.result));
        format!("margin {:+.1} %, decided by {name} {result}{band} ({})", 100.0 * trial.margin.share, trial.model)
    };
    let mut lines =
        vec![format!("{key} = {}: the {end} value that is allowed", significant(*value)), format!("  {}", of(decided))];
    lines.extend(confirmed.iter().map(|trial| format!("  particles at {}: {}", significant(trial.value), of(trial))));
    if decided.panel_mass_kg_per_m > 0.0 {
        lines.push(format!("  mass of the panels: {} kg/m", significant(decided.panel_mass_kg_per_m)));
    }
    lines.extend(notes.iter().map(|note| format!("  NOTE: {note}")));
    lines.push(format!("  {} values were tried", trials.len()));
    lines.join("\n")
}

fn csv(sized: &Sized) -> String {
    let rows = sized.trials.iter().chain(&sized.confirmed).map(|t| {
        let band = t.margin.band.map_or(String::new(), |band| format!("{band:e}"));
        let (value, mass, margin) = (t.value, t.panel_mass_kg_per_m, &t.margin);
        format!("{value:e},{},{:e},{},{:e},{band},{mass:e}\n", t.model, margin.share, margin.decided_by, margin.result)
    });
    format!("value,model,margin,decided_by,result,band,panel_mass_kg_per_m\n{}", rows.collect::<String>())
}
