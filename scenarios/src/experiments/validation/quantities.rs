//! The table of quantities: bias, scatter and number (THEORY GE28).

use report::Table;
use run::evidence::{LEAST_POINTS, Nature, Point, Quantity, Statistics};
use settings::significant;

use super::is_particles;

/// Quantities that are asked for and have few points, or none: why.
const FEW: [(Quantity, &str); 3] = [
    (Quantity::Attitude, "no measured roll or trim of a section is in a case"),
    (Quantity::Stress, "the runs that have a reference quote no stress as resolved"),
    (Quantity::Drift, "the mean force of waves is not yet right"),
];

/// The pages' tables as Markdown.
pub fn page(points: &[Point]) -> String {
    let all: Vec<&Point> = points.iter().collect();
    let of_nature = |nature| all.iter().copied().filter(|p| p.reference.nature == nature).collect::<Vec<_>>();
    let (particles, others): (Vec<&Point>, Vec<&Point>) = all.iter().partition(|p| is_particles(&p.model));
    let mut text = String::new();
    for (title, points) in [("Particles", &particles), ("Theories, strips, boundary elements", &others)] {
        text += &format!("## {title}\n\n{}\n", table(points, range_of_validity));
    }
    for nature in Nature::ALL {
        let points = of_nature(nature);
        text += &format!("## References: {}\n\n{}\n", nature.title(), table(&points, |_| Vec::new()));
    }
    let mut models: Vec<&str> = all.iter().map(|p| p.model.as_str()).collect();
    models.sort_unstable();
    models.dedup();
    for model in models {
        let points: Vec<&Point> = all.iter().copied().filter(|p| p.model == model).collect();
        text += &format!("## Model: `{model}`\n\n{}\n", table(&points, |_| Vec::new()));
    }
    let few: Vec<String> = Quantity::all()
        .filter_map(|q| {
            let count = all.iter().filter(|p| p.quantity == q).count();
            let why = FEW.iter().find(|row| row.0 == q).map_or("few cases have such a reference", |row| row.1);
            (count < LEAST_POINTS).then(|| format!("- {}: {count} points; {why}.\n", q.title()))
        })
        .collect();
    text + "## Quantities with fewer than five points\n\n" + &few.concat() + "\n" + &validated(&all)
}

/// GE28: how many errors are within twice the validation uncertainty.
fn validated(points: &[&Point]) -> String {
    let known: Vec<(f64, f64)> =
        points.iter().filter_map(|p| Some(((p.ratio - 1.0).abs(), p.validation_uncertainty()?))).collect();
    let within = known.iter().filter(|(error, u)| *error <= 2.0 * u).count();
    format!(
        "## Validation uncertainty\n\nOf {} points with known u_num and u_D, {within} have an error |E| of at most 2 u_val (ASME V&V 20).\n",
        known.len()
    )
}

/// Deadrises, speeds and spacings in the draught, as cells.
fn range_of_validity(points: &[&Point]) -> Vec<String> {
    let (low, high) = range(points, |p| p.setup.deadrise_deg);
    let deadrise = span(low, high, "°");
    let (low, high) = range(points, |p| p.setup.speed);
    let speed = span(low, high, " m/s");
    let (low, high) = range(points, |p| p.setup.spacings);
    vec![deadrise, speed, span(low, high, "")]
}

fn range(points: &[&Point], of: fn(&Point) -> Option<f64>) -> (f64, f64) {
    let values = points.iter().filter_map(|p| of(p));
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
}

fn span(low: f64, high: f64, unit: &str) -> String {
    match high.is_finite() {
        false => "–".into(),
        true if (high - low).abs() < 1e-9 => format!("{}{unit}", two(low)),
        true => format!("{}–{}{unit}", two(low), two(high)),
    }
}

fn two(value: f64) -> String {
    if value >= 10.0 { format!("{value:.0}") } else { significant((value * 10.0).round() / 10.0) }
}

fn percent(value: f64) -> String {
    format!("{:.1} %", 100.0 * value)
}

/// A row for each quantity, with the further cells of `more`.
fn table(points: &[&Point], more: impl Fn(&[&Point]) -> Vec<String>) -> String {
    let mut rows = Vec::new();
    for quantity in Quantity::all() {
        let own: Vec<&Point> = points.iter().copied().filter(|p| p.quantity == quantity).collect();
        let Some(found) = Statistics::of(&own) else { continue };
        let mut curves: Vec<f64> = own.iter().filter_map(|p| p.waveform).collect();
        curves.sort_by(f64::total_cmp);
        let median = curves.get(curves.len() / 2).map_or("–".into(), |c| format!("{c:.3}"));
        let (worst, at) = found.worst;
        let mut row = vec![
            quantity.title().to_string(),
            found.points.to_string(),
            found.cases.to_string(),
            format!("{:.3}", found.bias),
            found.scatter.map_or("–".into(), percent),
            found.reference.map_or("–".into(), percent),
            format!("{} ({})", signed(worst), own[at].case),
            median,
            found.not_exceeded(0.0).map_or("–".into(), |factor| format!("{factor:.3}")),
        ];
        row.extend(more(&own));
        rows.push(row);
    }
    let mut head =
        vec!["quantity", "points", "cases", "bias", "σ model", "σ reference", "worst", "median C", "95 % factor"];
    if rows.iter().any(|row| row.len() > head.len()) {
        head.extend(["deadrise", "speed", "spacings in the draught"]);
    }
    Table::new("", &head, rows).markdown()
}

fn signed(value: f64) -> String {
    format!("{:+.1} %", 100.0 * value)
}
