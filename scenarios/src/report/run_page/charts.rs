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
        let values = series.column(name).unwrap_or_default();
        Curve::new(outcome.summary.model, Mark::Line, times.iter().zip(values).map(|(t, v)| [*t, scale * v]))
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
                let points = reference.t.iter().zip(&reference.y).map(|(t, y)| [*t, *y]).filter(|p| p[0] <= end);
                let mark = if reference.t.len() > MANY { Mark::Dashed } else { Mark::Points };
                curves.push(Curve::new(short(&other.reference), mark, points));
            }
        }
        curves.extend(theories.curves(&compare.quantity, compare.scale));
        let title = format!("{} against references", compare.quantity);
        blocks.push(Block::Chart(Chart::new(title, "t [s]", &compare.quantity, curves)));
    }
    if let Some(similarity) = &outcome.summary.similarity {
        blocks.push(profile_chart(scene, &similarity.profile, theories.profiles()));
    }
    for name in series.columns().iter().skip(1).filter(|n| !drawn.contains(&n.as_str())) {
        let curve = ours(name, 1.0);
        let moves = curve.y.iter().any(|v| (v - curve.y[0]).abs() > 1e-12);
        if moves {
            let curves = std::iter::once(curve).chain(theories.curves(name, 1.0)).collect();
            blocks.push(Block::Chart(Chart::new(name, "t [s]", name, curves)));
        }
    }
    blocks
}

fn profile_chart(scene: &Scene, profile: &[[f64; 2]], theories: Vec<Curve>) -> Block {
    let exact = compare::similarity_of(scene);
    let exact = exact.map(|exact| Curve::new("similarity solution", Mark::Dashed, exact.profile));
    let ours = Curve::new(scene.model.name(), Mark::Line, profile.iter().copied());
    let curves = std::iter::once(ours).chain(theories).chain(exact).collect();
    let x_range = Some([0.0, profile.last().map_or(1.0, |p| p[0])]);
    Block::Chart(Chart { x_range, ..Chart::new("Pressure on the face, mean over the window", "x/(V t)", "Cp", curves) })
}

/// A reference's file name without folder and ending.
fn short(path: &str) -> String {
    let name = path.rsplit('/').next().unwrap_or(path);
    name.trim_end_matches(".csv").into()
}
