//! The charts of `report.html`: every column of the series, with references and theories.

use super::theories::Theories;
use crate::compare;
use crate::report::{Block, Chart, Curve, Mark};
use crate::run::Outcome;
use crate::scene::Scene;

/// References of more points than this are drawn as lines.
const MANY: usize = 60;

pub(super) fn charts(scene: &Scene, outcome: &Outcome) -> Vec<Block> {
    let mut blocks = Vec::new();
    let series = &outcome.series;
    let times = series.times();
    let ours = |name: &str, scale: f64| {
        let y: Option<Vec<f64>> = series.column(name).map(|c| c.iter().map(|v| scale * v).collect());
        Curve { label: outcome.summary.model.into(), mark: Mark::Line, x: times.clone(), y: y.unwrap_or_default() }
    };
    let theories = Theories::beside(scene);
    let mut drawn: Vec<&str> = Vec::new();
    for compare in &scene.compare {
        if drawn.contains(&compare.quantity.as_str()) {
            continue;
        }
        drawn.push(&compare.quantity);
        let mut curves = vec![ours(&compare.quantity, compare.scale)];
        for (other, reference) in scene.compare.iter().zip(&outcome.references) {
            if other.quantity == compare.quantity {
                let end = outcome.summary.time_end_s.max(scene.time.end);
                let keep = reference.t.iter().zip(&reference.y).filter(|(t, _)| **t <= end);
                let (x, y) = keep.map(|(t, y)| (*t, *y)).unzip();
                let mark = if reference.t.len() > MANY { Mark::Dashed } else { Mark::Points };
                curves.push(Curve { label: short(&other.reference), mark, x, y });
            }
        }
        curves.extend(theories.curves(&compare.quantity, compare.scale));
        blocks.push(chart(&format!("{} against references", compare.quantity), "t [s]", &compare.quantity, curves));
    }
    if let Some(similarity) = &outcome.summary.similarity {
        blocks.push(profile_chart(scene, &similarity.profile, theories.profiles()));
    }
    for name in series.columns().iter().skip(1).filter(|n| !drawn.contains(&n.as_str())) {
        let curve = ours(name, 1.0);
        let moves = curve.y.iter().any(|v| (v - curve.y[0]).abs() > 1e-12);
        if moves {
            let curves = std::iter::once(curve).chain(theories.curves(name, 1.0)).collect();
            blocks.push(chart(name, "t [s]", name, curves));
        }
    }
    blocks
}

fn profile_chart(scene: &Scene, profile: &[[f64; 2]], theories: Vec<Curve>) -> Block {
    let split = |points: &[[f64; 2]]| points.iter().map(|p| (p[0], p[1])).unzip();
    let (x, y): (Vec<f64>, Vec<f64>) = split(profile);
    let end = x.last().copied().unwrap_or(1.0);
    let mut curves = vec![Curve { label: scene.model.name().into(), mark: Mark::Line, x, y }];
    curves.extend(theories);
    if let Some(exact) = compare::similarity_of(scene) {
        let (x, y) = split(&exact.profile);
        curves.push(Curve { label: "similarity solution".into(), mark: Mark::Dashed, x, y });
    }
    Block::Chart(Chart {
        title: "Pressure on the face, mean over the window".into(),
        x_label: "x/(V t)".into(),
        y_label: "Cp".into(),
        curves,
        x_range: Some([0.0, end]),
        ..Chart::default()
    })
}

fn chart(title: &str, x: &str, y: &str, curves: Vec<Curve>) -> Block {
    let (title, x_label, y_label) = (title.into(), x.into(), y.into());
    Block::Chart(Chart { title, x_label, y_label, curves, ..Chart::default() })
}

/// A reference's file name without folder and ending.
fn short(path: &str) -> String {
    let name = path.rsplit('/').next().unwrap_or(path);
    name.trim_end_matches(".csv").into()
}
