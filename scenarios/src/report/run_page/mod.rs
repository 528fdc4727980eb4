//! `report.html`: what was run, pictures of the flow, curves with references, audit, cost.

mod charts;
mod error_bars;
mod panels;
mod pictures;
mod tables;
mod theories;

use crate::report::{Block, Report, Status as PageStatus, render};
use crate::run::Outcome;
use crate::run::summary::Status;
use crate::scene::Scene;

/// The page of a run.
pub fn report(scene: &Scene, outcome: &Outcome, warnings: &[String]) -> String {
    let summary = &outcome.summary;
    let mut sections = vec![("Run".to_string(), tables::run_section(scene, summary, warnings))];
    if !summary.comparison.is_empty() {
        sections.push(("Against references".into(), vec![tables::comparison_table(&summary.comparison)]));
    }
    if !summary.error_bars.is_empty() {
        sections.push(("Error bars".into(), error_bars::error_bars_section(summary)));
    }
    if !scene.model.is_theory() {
        sections.push(("Flow".into(), pictures::pictures(scene, outcome.pictures.frames())));
    }
    sections.push(("Curves".into(), charts::charts(scene, outcome)));
    if scene.entry().is_some() {
        sections.push(("Theories".into(), theories::theories_section(scene)));
    }
    if !summary.panels.is_empty() {
        sections.push(("Panels".into(), panels::panels_section(summary)));
    }
    if !summary.force_rules.is_empty() {
        sections.push(("Force by four rules".into(), tables::force_rules_section(summary)));
    }
    if !scene.model.is_theory() {
        sections.push(("Audit".into(), vec![tables::audit_table(summary)]));
        sections.push(("Cost".into(), vec![tables::cost_bar(summary)]));
    }
    sections.push((
        "Scene as run".into(),
        vec![Block::Code { title: "scene.resolved.toml".into(), text: scene.to_toml() }],
    ));
    render(&Report {
        title: format!("splashdown: {}", scene.name),
        subtitle: scene.description.clone(),
        status: match summary.status {
            Status::Completed => PageStatus::Completed,
            Status::Failed => PageStatus::Failed(summary.message.clone().unwrap_or_default()),
            Status::Interrupted => PageStatus::Interrupted,
        },
        sections,
    })
}
