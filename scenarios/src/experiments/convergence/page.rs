//! `study.html`: a study as a page.

use super::table::{HEAD, cells, results};
use super::{Point, Study};
use crate::report::{Block, Chart, Curve, Mark, Report, Status, Table, render};

/// Points of a fitted curve.
const POINTS: usize = 60;

/// The page of a study.
pub fn page(study: &Study) -> String {
    let strings = |cells: &[&str]| cells.iter().map(|c| c.to_string()).collect::<Vec<_>>();
    let answer = Table {
        title: "q = q₀ + A Δxᵖ + B f(M)".into(),
        head: strings(&["quantity", "value"]),
        rows: results(study).into_iter().map(Vec::from).collect(),
    };
    let runs = Table {
        title: "Runs".into(),
        head: strings(&HEAD),
        rows: study.points.iter().map(|p| cells(p).into()).collect(),
    };
    render(&Report {
        title: format!("splashdown study: {}", study.scene),
        subtitle: format!("{}: {}", study.quantity, study.fit.verdict()),
        status: Status::Completed,
        sections: vec![
            (
                "Answer".into(),
                vec![Block::Table(answer), Block::Chart(against_spacing(study)), Block::Chart(against_cost(study))],
            ),
            ("Runs".into(), vec![Block::Table(runs)]),
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
        let mark = Mark::Points;
        let (x, y) = group.iter().map(|p| (p.spacing_m, p.value)).unzip();
        curves.push(Curve { label: format!("c₀ = {c:.1} m/s"), mark, x, y });
        let sound = fit.sound_speed_error.unwrap_or(0.0) * group[0].law / least;
        let x: Vec<f64> = (0..=POINTS).map(|k| coarsest * k as f64 / POINTS as f64).collect();
        let share = |dx: f64| fit.discretisation_error * (dx / finest).powf(fit.order_used) + sound;
        let y = x.iter().map(|dx| fit.extrapolated + fit.extrapolated.abs() * share(*dx)).collect();
        curves.push(Curve { label: "fit".into(), mark: Mark::Dashed, x, y });
    }
    curves.push(Curve { label: "extrapolated".into(), mark: Mark::Points, x: vec![0.0], y: vec![fit.extrapolated] });
    chart(&format!("{} against the spacing", study.quantity), "spacing [m]", &study.quantity, curves)
}

fn against_cost(study: &Study) -> Chart {
    let curve = |(c, group): (f64, Vec<&Point>)| {
        let (x, y) = group.iter().filter_map(|p| Some((p.core_seconds.log10(), 100.0 * p.error?.abs()))).unzip();
        Curve { label: format!("c₀ = {c:.1} m/s"), mark: Mark::Points, x, y }
    };
    let curves = by_sound_speed(study).into_iter().map(curve).collect();
    chart("Error against cost", "log₁₀ of cost [core-s]", "difference from the extrapolated value [%]", curves)
}

fn chart(title: &str, x: &str, y: &str, curves: Vec<Curve>) -> Chart {
    let (title, x_label, y_label) = (title.into(), x.into(), y.into());
    Chart { title, x_label, y_label, curves, ..Chart::default() }
}
