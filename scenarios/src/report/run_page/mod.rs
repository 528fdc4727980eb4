//! `report.html`: what was run, pictures of the flow, curves with references, audit, cost.

mod charts;
mod pictures;
mod tables;
mod theories;

use crate::report::{Block, Report, Status as PageStatus, render};
use crate::run::Outcome;
use crate::run::summary::Status;
use crate::scene::Scene;

/// The page of a run; a section without content is left out.
pub fn report(scene: &Scene, outcome: &Outcome, warnings: &[String]) -> String {
    let summary = &outcome.summary;
    let of_particles = |blocks: &dyn Fn() -> Vec<Block>| if scene.model.is_theory() { Vec::new() } else { blocks() };
    let toml = Block::Code { title: "scene.resolved.toml".into(), text: scene.to_toml() };
    let sections = [
        ("Results", tables::results_section(summary)),
        ("Run", tables::run_section(scene, summary, warnings)),
        ("Against references", tables::comparison_section(summary)),
        ("Error bars", tables::error_bars_section(summary)),
        ("Flow", of_particles(&|| pictures::pictures(scene, outcome.pictures.frames()))),
        ("Curves", charts::charts(scene, outcome)),
        ("Theories", scene.entry().map_or(Vec::new(), |_| theories::theories_section(scene))),
        ("Panels", tables::panels_section(summary)),
        ("Force by four rules", tables::force_rules_section(summary)),
        ("Audit", of_particles(&|| vec![tables::audit_table(summary)])),
        ("Cost", of_particles(&|| vec![tables::cost_bar(summary)])),
        ("Scene as run", vec![toml]),
    ];
    let shown = sections.into_iter().filter(|(_, blocks)| !blocks.is_empty());
    render(&Report {
        title: format!("splashdown: {}", scene.name),
        subtitle: scene.description.clone(),
        status: page_status(summary.status, summary.message.as_deref(), &summary.doubts),
        sections: shown.map(|(heading, blocks)| (heading.to_string(), blocks)).collect(),
    })
}

/// How a run ended, for the head of its page.
pub(crate) fn page_status(status: Status, message: Option<&str>, doubts: &[String]) -> PageStatus {
    match status {
        Status::Completed => PageStatus::Completed,
        Status::CompletedWithDoubts => PageStatus::Doubtful("Completed with doubts.".into(), doubts.to_vec()),
        Status::BeyondAllowable => {
            PageStatus::Doubtful("Completed, beyond an allowable stress.".into(), doubts.to_vec())
        }
        Status::Failed => PageStatus::Failed(message.unwrap_or_default().to_string()),
        Status::Interrupted => PageStatus::Interrupted,
    }
}
