//! A study as a page, `study.html`, and as text.

use report::{Block, Chart, Column, Curve, Mark, Report, Status, Table, render};

use super::{Point, Study};

/// Points of a fitted curve.
const POINTS: usize = 60;

/// The runs, from the coarsest.
fn runs(study: &Study) -> Table {
    let columns: &[Column<&Point>] = &[
        ("spacing [m]", |p| format!("{:.6}", p.spacing_m)),
        ("sound speed [m/s]", |p| format!("{:.2}", p.sound_speed_m_per_s)),
        ("Mach", |p| format!("{:.4}", p.mach)),
        ("value", |p| format!("{:.6e}", p.value)),
        ("error [%]", |p| p.error.map_or("–".into(), |e| format!("{:+.2}", 100.0 * e))),
        ("particles", |p| p.particles.to_string()),
        ("steps", |p| p.steps.to_string()),
        ("core-s", |p| format!("{:.1}", p.core_seconds)),
    ];
    Table::of("Runs", &study.points, columns)
}

/// Name and value of each result.
fn results(study: &Study) -> Vec<[String; 2]> {
    let f = &study.fit;
    let percent = |x: f64| format!("{:+.2} %", 100.0 * x);
    let order = match f.order {
        Some(p) if p == f.order_used => format!("{p:.2}"),
        Some(p) => format!("{p:.2}; {} is used", f.order_used),
        None => format!("none; {} is used", f.order_used),
    };
    let unknown = || "unknown: one sound speed".to_string();
    let share = f.sound_speed_share.map_or_else(unknown, |s| format!("{:.0} %", 100.0 * s));
    [
        ("extrapolated", format!("{:.6e}, within {:.2} %", f.extrapolated, 100.0 * f.uncertainty)),
        ("observed order", order),
        ("finest run, error of its spacing", percent(f.discretisation_error)),
        ("finest run, error of its sound speed", f.sound_speed_error.map_or_else(unknown, percent)),
        ("share of the sound speed in both", share),
        ("scatter about the fit", f.scatter.map_or("unknown: no runs to spare".into(), percent)),
        ("law of the sound speed", study.sound_speed_law.to_string()),
        ("cost of all runs", format!("{:.1} core-s", study.core_seconds)),
        ("verdict", f.verdict()),
    ]
    .map(|(name, value)| [name.to_string(), value])
    .to_vec()
}

/// Runs and results in aligned columns.
pub fn text(study: &Study) -> String {
    let Table { head, rows, .. } = runs(study);
    let width = |k: usize| rows.iter().chain([&head]).map(|r| r[k].chars().count()).max().unwrap_or(0);
    let aligned = |row: &Vec<String>| {
        let cells = row.iter().enumerate().map(|(k, cell)| format!("{cell:>width$}", width = width(k)));
        cells.collect::<Vec<_>>().join("  ")
    };
    let mut lines = vec![format!("{}: {}", study.scene, study.quantity), aligned(&head)];
    lines.extend(rows.iter().map(aligned));
    lines.extend(results(study).into_iter().map(|[name, value]| format!("{name:<38} {value}")));
    lines.join("\n")
}

/// The page of a study.
pub fn page(study: &Study) -> String {
    let results = results(study).into_iter().map(Vec::from).collect();
    let answer = Table::new("q = q₀ + A Δxᵖ + B f(M)", &["quantity", "value"], results);
    render(&Report {
        title: format!("splashdown study: {}", study.scene),
        subtitle: format!("{}: {}", study.quantity, study.fit.verdict()),
        status: Status::Completed,
        sections: vec![
            (
                "Answer".into(),
                vec![Block::Table(answer), Block::Chart(against_spacing(study)), Block::Chart(against_cost(study))],
            ),
            ("Runs".into(), vec![Block::Table(runs(study))]),
        ],
    })
}

/// The runs of each sound speed.
fn by_sound_speed(study: &Study) -> Vec<(f64, Vec<&Point>)> {
    let mut groups: Vec<(f64, Vec<&Point>)> = Vec::new();
    for p in &study.points {
        match groups.iter_mut().find(|(c, _)| *c == p.sound_speed_m_per_s) {
            Some((_, group)) => group.push(p),
            None => groups.push((p.sound_speed_m_per_s, vec![p])),
        }
    }
    groups
}

fn against_spacing(study: &Study) -> Chart {
    let fit = &study.fit;
    let finest = study.points.iter().map(|p| p.spacing_m).fold(f64::INFINITY, f64::min);
    let coarsest = study.points.iter().map(|p| p.spacing_m).fold(0.0, f64::max);
    let least = study.points.iter().map(|p| p.law).fold(f64::INFINITY, f64::min);
    let mut curves = Vec::new();
    for (c, group) in by_sound_speed(study) {
        let points = group.iter().map(|p| [p.spacing_m, p.value]);
        curves.push(Curve::new(format!("c₀ = {c:.1} m/s"), Mark::Points, points));
        let sound = fit.sound_speed_error.unwrap_or(0.0) * group[0].law / least;
        let x = (0..=POINTS).map(|k| coarsest * k as f64 / POINTS as f64);
        let share = |dx: f64| fit.discretisation_error * (dx / finest).powf(fit.order_used) + sound;
        let points = x.map(|dx| [dx, fit.extrapolated + fit.extrapolated.abs() * share(dx)]);
        curves.push(Curve::new("fit", Mark::Dashed, points));
    }
    curves.push(Curve::new("extrapolated", Mark::Points, [[0.0, fit.extrapolated]]));
    Chart::new(format!("{} against the spacing", study.quantity), "spacing [m]", &study.quantity, curves)
}

fn against_cost(study: &Study) -> Chart {
    let curve = |(c, group): (f64, Vec<&Point>)| {
        let points = group.iter().filter_map(|p| Some([p.core_seconds.log10(), 100.0 * p.error?.abs()]));
        Curve::new(format!("c₀ = {c:.1} m/s"), Mark::Points, points)
    };
    let curves = by_sound_speed(study).into_iter().map(curve).collect();
    Chart::new("Error against cost", "log₁₀ of cost [core-s]", "difference from the extrapolated value [%]", curves)
}
