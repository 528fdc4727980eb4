//! A chart as SVG, as a page and as a table.

use super::{Measured, Point};
use crate::report::{Block, Chart, Curve, Mark, Report, Status, Table, chart_svg, render};

const HEAD: [&str; 9] =
    ["family", "at", "value", "bias [%]", "scatter [%]", "error [%]", "particles", "steps", "core-s"];

/// Error against cost, both logarithmic, with the front of what nothing beats.
pub fn svg(measured: &Measured) -> String {
    chart_svg(&chart(measured))
}

/// The chart with its table.
pub fn page(measured: &Measured) -> String {
    let case = &measured.case;
    let runs = Table {
        title: format!("{}: {} is {} ({})", case.scene, case.quantity, case.reference, case.source),
        head: HEAD.map(String::from).to_vec(),
        rows: measured.points.iter().map(|p| cells(measured, p).to_vec()).collect(),
    };
    render(&Report {
        title: format!("splashdown chart: {}", case.name),
        subtitle: format!("{}; {} threads, version {}", case.about, measured.threads, measured.version),
        status: Status::Completed,
        sections: vec![
            ("Error against cost".into(), vec![Block::Chart(chart(measured))]),
            ("Runs".into(), vec![Block::Table(runs)]),
        ],
    })
}

/// The runs as Markdown.
pub fn table(measured: &Measured) -> String {
    let case = &measured.case;
    let mut text = format!("{}. `{}`, reference {} ({}).\n\n", case.about, case.quantity, case.reference, case.source);
    text += &format!("| {} |\n|{}\n", HEAD.join(" | "), "---|".repeat(HEAD.len()));
    for p in &measured.points {
        text += &format!("| {} |\n", cells(measured, p).join(" | "));
    }
    text
}

fn chart(measured: &Measured) -> Chart {
    let mut curves: Vec<Curve> = Vec::new();
    for family in &measured.case.family {
        let of: Vec<&Point> = measured.points.iter().filter(|p| p.family == family.name).collect();
        curves.push(curve(&family.name, Mark::Points, &of));
    }
    let mut front: Vec<&Point> = measured.points.iter().filter(|p| measured.is_on_front(p)).collect();
    front.sort_by(|a, b| a.core_seconds.total_cmp(&b.core_seconds));
    curves.push(curve("nothing is cheaper and more exact", Mark::Dashed, &front));
    Chart {
        title: measured.case.about.clone(),
        x_label: "cost [core-s]".into(),
        y_label: "error [%]".into(),
        curves,
        logarithmic: true,
        ..Chart::default()
    }
}

fn curve(label: &str, mark: Mark, points: &[&Point]) -> Curve {
    let (x, y) = points.iter().map(|p| (p.core_seconds, 100.0 * p.error)).unzip();
    Curve { label: label.into(), mark, x, y }
}

fn cells(measured: &Measured, p: &Point) -> [String; 9] {
    let mark = if measured.is_on_front(p) { " (front)" } else { "" };
    [
        format!("{}{mark}", p.family),
        p.at.to_string(),
        format!("{:.6}", p.value),
        format!("{:+.2}", 100.0 * p.bias),
        format!("{:.2}", 100.0 * p.scatter),
        format!("{:.2}", 100.0 * p.error),
        p.particles.to_string(),
        p.steps.to_string(),
        format!("{:.1}", p.core_seconds),
    ]
}
