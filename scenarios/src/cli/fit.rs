//! `splashdown fit`.

use std::path::PathBuf;

use clap::Args;
use decide::Evaluator;
use decide::fit::{DataError, Fitted, fit, read};
use report::{Block, Chart, Curve, Mark, page};
use settings::{DataLine, Problem, significant};

use super::decisions::{finish, folder, stop};
use super::shared::{Output, SceneArgs, Stop};

#[derive(Args)]
pub(super) struct FitArgs {
    #[command(flatten)]
    scene: SceneArgs,
    /// Measured curves: a CSV file with time_s and columns named as in series.csv, such as wedge.vy_m_per_s.
    #[arg(long = "to", value_name = "FILE")]
    data: PathBuf,
    /// Keys whose values are looked for, as body.mass,panels.belly.thickness; shift, or shift=TIME where it begins, is the time of the scene's start in the data.
    #[arg(long = "for", value_name = "KEYS", value_delimiter = ',', required = true)]
    keys: Vec<String>,
    /// Folder for the files (default: runs/SCENE_fit).
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replace the files that the folder holds.
    #[arg(long)]
    force: bool,
}

pub(super) fn run_fit(output: &Output, args: &FitArgs) -> Result<u8, Stop> {
    let evaluator = Evaluator::new(&args.scene.scene, &args.scene.sets).map_err(stop)?;
    let curves = read(&args.data)?;
    let out = folder(&args.out, &evaluator, "fit", args.force)?;
    let fitted = fit(&evaluator, &args.keys, &curves).map_err(stop)?;
    let files = [("curves.csv", csv(&fitted)), ("fit.html", html(&fitted))];
    finish(output, &out, "fit", &fitted, &words(&fitted), &files)
}

impl From<DataError> for Stop {
    fn from(error: DataError) -> Stop {
        let sentence = error.to_string();
        match error {
            DataError::Line { file, line, given, expected } => Stop::Line(Box::new(Problem {
                sentence,
                given: Some(given),
                expected,
                line: Some(Box::new(DataLine { file, line })),
                ..Problem::default()
            })),
            DataError::Read(..) => Stop::Input(sentence),
        }
    }
}

fn words(fitted: &Fitted) -> String {
    let of = |e: &decide::fit::Estimate| {
        format!(
            "{} = {}, {} to {} at 95 %, from {}",
            e.key,
            significant(e.value),
            significant(e.range[0]),
            significant(e.range[1]),
            significant(e.start)
        )
    };
    let residuals =
        fitted.residual.iter().map(|(name, sigma)| format!("  {name}: residual {} (1 σ)", significant(*sigma)));
    let notes = fitted.notes.iter().map(|note| format!("  NOTE: {note}"));
    let runs = format!("  {} runs of {}", fitted.runs, fitted.model);
    fitted.estimates.iter().map(of).chain(residuals).chain(notes).chain([runs]).collect::<Vec<_>>().join("\n")
}

fn csv(fitted: &Fitted) -> String {
    let rows = fitted.curves.iter().flat_map(|(name, rows)| {
        rows.iter().map(move |[time, measured, fitted]| format!("{name},{time:e},{measured:e},{fitted:e}\n"))
    });
    format!("column,time_s,measured,fitted\n{}", rows.collect::<String>())
}

/// The curves and their residuals.
fn html(fitted: &Fitted) -> String {
    let blocks = fitted.curves.iter().flat_map(|(name, rows)| {
        let of = |value: fn(&[f64; 3]) -> f64| rows.iter().map(|row| [row[0], value(row)]).collect::<Vec<_>>();
        let (measured, found, residual) = (of(|r| r[1]), of(|r| r[2]), of(|r| r[1] - r[2]));
        let curves = vec![Curve::new("measured", Mark::Points, measured), Curve::new("fitted", Mark::Line, found)];
        let chart =
            |title: String, curves: Vec<Curve>| Block::Chart(Chart::new(title, "time [s]", name.as_str(), curves));
        [
            chart(format!("{name}: measured and fitted"), curves),
            chart(format!("{name}: measured less fitted"), vec![Curve::new("residual", Mark::Points, residual)]),
        ]
    });
    let found = Block::Code { title: String::new(), text: words(fitted) };
    let sections = [("Values".to_string(), vec![found]), ("Curves".to_string(), blocks.collect())];
    page("splashdown fit", "", &sections)
}
