//! The page of a run, made from its folder alone: `report.html`.

mod camera;
mod charts;
mod comparison;
mod doubts;
mod figures;
mod flow;
mod folder;
mod headline;
mod packed;
mod panels;
mod player;
pub mod quantity;
mod record;
mod references;
mod stated;
mod structure;
mod table;
mod tables;
mod theories;
mod waves;

use std::path::Path;

use charts::Figure;
use flow::Flow;
pub use folder::FolderError;
use folder::RunFolder;

use crate::markup::escape;
use crate::{Block, chart_svg::untitled_svg, html::page};

pub use comparison::compare;
pub use figures::{FigureError, write_figures};
pub use headline::two_digits;

/// The page of the run in a folder.
///
/// # Errors
/// The folder holds no run.
pub fn report(dir: &Path) -> Result<String, FolderError> {
    let mut run = RunFolder::read(dir)?;
    let flow = Flow::read(&mut run);
    let hero = flow.as_ref().map_or(String::new(), |flow| player::player(&mut run, flow));
    let lead = headline::lead(&run) + &hero;
    let moments = flow.as_ref().map_or(Vec::new(), |flow| player::moments(&mut run, flow));
    let record = &run.record;
    let toml = std::fs::read_to_string(dir.join("scene.resolved.toml")).unwrap_or_default();
    // a host's motion is not the scene's: neither theories of the scene nor its command say anything about the run
    let hosted = record.host.is_some();
    let theories = run.scene.entry().filter(|_| !hosted && run.scene.bodies.is_empty());
    let repeat = if hosted { Vec::new() } else { again(dir) };
    let sections = [
        ("Curves", figure_blocks(&charts::figures(&run), HINT)),
        ("Structure", [figure_blocks(&structure::figures(&run), ""), structure::tables(&run)].concat()),
        ("Results in detail", [tables::results_section(&run), tables::gauge_section(record)].concat()),
        ("With two free ends", stated::ends_section(record)),
        ("By the rules", stated::rules_section(record)),
        ("In waves", waves::waves_section(record)),
        ("Against references", references::section(&run)),
        ("Error bars", tables::error_bars_section(record)),
        ("Moments", moments),
        ("Theories", theories.map_or(Vec::new(), |_| theories::theories_section(&run.scene))),
        ("Warnings", warnings(&run)),
        ("Audit", tables::audit_section(&run)),
        ("Force by four rules", tables::force_rules_section(record)),
        ("How it was got", [tables::run_section(&run), tables::cost_section(record), repeat].concat()),
        ("Scene as run", vec![Block::Html(folded("scene.resolved.toml", &toml))]),
    ];
    let shown = sections.into_iter().filter(|(_, blocks)| !blocks.is_empty());
    let sections: Vec<_> = shown.map(|(heading, blocks)| (heading.to_string(), blocks)).collect();
    Ok(page(&format!("splashdown: {}", run.scene.name), &lead, &sections))
}

const HINT: &str =
    "Point at a curve to read it, drag to zoom, double-click to reset; a click takes the animation to that time.";

/// Figures side by side, each with its title above.
fn figure_blocks(figures: &[Figure], hint: &str) -> Vec<Block> {
    if figures.is_empty() {
        return Vec::new();
    }
    let figure = |Figure { name, chart }: &Figure| {
        format!(
            "<figure class=\"chart\" data-save=\"{name}\">\n<figcaption><b>{}</b></figcaption>\n{}</figure>\n",
            escape(&chart.title),
            untitled_svg(chart)
        )
    };
    let hint = if hint.is_empty() { String::new() } else { format!("<p class=\"hint\">{hint}</p>\n") };
    let inner: String = figures.iter().map(figure).collect();
    vec![Block::Html(format!("{hint}<div class=\"figures\">\n{inner}</div>\n"))]
}

/// Warnings before the run; doubts stand at the top of the page.
fn warnings(run: &RunFolder) -> Vec<Block> {
    if run.warnings.is_empty() {
        return Vec::new();
    }
    let lines: String = run.warnings.iter().map(|item| format!("<li>{}</li>", doubts::html(item))).collect();
    vec![Block::Html(format!(
        "<h3 id=\"warnings\">About the scene, before the run</h3>\n<ul class=\"reasons\">{lines}</ul>\n"
    ))]
}

/// The command that repeats the run.
fn again(dir: &Path) -> Vec<Block> {
    let scene = dir.join("scene.resolved.toml");
    let path = scene.display().to_string();
    let quoted = if path.contains(|c: char| c.is_whitespace() || "'\"\\$".contains(c)) {
        format!("'{}'", path.replace('\'', "'\\''"))
    } else {
        path
    };
    vec![Block::Code { title: "To repeat this run".into(), text: format!("splashdown run {quoted} --out again") }]
}

/// A long text that opens on demand.
pub fn folded(title: &str, text: &str) -> String {
    format!("<details><summary>{}</summary><pre><code>{}</code></pre></details>\n", escape(title), escape(text))
}
