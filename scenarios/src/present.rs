//! `report.html`: what was run, pictures of the flow, curves over references, audit, cost.

mod error_bars;
mod ladder;
mod panels;

use sph_core::{Phase, parallel};

use crate::compare::{self, Comparison};
use crate::observe::{GaugeResult, RuleResult};
use crate::report::{
    Bar, Block, Chart, Curve, FlowFrame, FlowView, Mark, Part, Report, Status as PageStatus, Table, flow_png, render,
};
use crate::run::Outcome;
use crate::scene::{Scene, Symmetry};
use crate::summary::{Compressibility, Log, Projection, Status, Summary};
use ladder::Theories;

/// References of more points than this are drawn as lines.
const MANY: usize = 60;

/// The page of a run.
pub fn report(scene: &Scene, outcome: &Outcome, warnings: &[String]) -> String {
    let summary = &outcome.summary;
    let mut sections = vec![("Run".to_string(), run_section(scene, summary, warnings))];
    if !summary.comparison.is_empty() {
        sections.push(("Against references".into(), vec![comparison_table(&summary.comparison)]));
    }
    if !summary.error_bars.is_empty() {
        sections.push(("Error bars".into(), error_bars::error_bars_section(summary)));
    }
    if !scene.model.is_theory() {
        sections.push(("Flow".into(), pictures(scene, outcome.pictures.frames())));
    }
    sections.push(("Curves".into(), charts(scene, outcome)));
    if scene.entry().is_some() {
        sections.push(("Ladder".into(), ladder::ladder_table(scene)));
    }
    if !summary.panels.is_empty() {
        sections.push(("Panels".into(), panels::panels_section(summary)));
    }
    if !summary.force_rules.is_empty() {
        sections.push(("Force by four rules".into(), force_rules_section(summary)));
    }
    if !scene.model.is_theory() {
        sections.push(("Audit".into(), vec![audit_table(summary)]));
        sections.push(("Cost".into(), vec![cost_bar(summary)]));
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

fn row(cells: &[&str]) -> Vec<String> {
    cells.iter().map(|c| c.to_string()).collect()
}

fn run_section(scene: &Scene, s: &Summary, warnings: &[String]) -> Vec<Block> {
    let mut rows = vec![row(&["model", s.model, ""])];
    if !scene.model.is_theory() {
        rows.extend([
            row(&["fluid particles", &s.particles.fluid.to_string(), ""]),
            row(&["wall particles", &s.particles.wall.to_string(), ""]),
            row(&["finest spacing", &format!("{:.4}", 1e3 * scene.resolution.spacing), "mm"]),
            row(&["steps", &s.steps.to_string(), ""]),
            row(&["particle updates", &format!("{:.2}", 1e-6 * s.particle_updates_per_s), "million/s"]),
        ]);
    }
    rows.extend([
        row(&["time reached", &format!("{:.6}", s.time_end_s), "s"]),
        row(&["wall time", &format!("{:.3}", s.wall_time_s), "s"]),
        row(&["threads", &s.threads.to_string(), ""]),
    ]);
    rows.extend(s.log.iter().flat_map(log_rows));
    rows.extend(s.compressibility.iter().flat_map(compressibility_rows));
    rows.extend(s.projection.iter().flat_map(projection_rows));
    let head = row(&["quantity", "value", "unit"]);
    let mut blocks = Vec::new();
    if !scene.source.is_empty() {
        blocks.push(Block::Text(format!("Source: {}.", scene.source)));
    }
    if !warnings.is_empty() {
        blocks.push(Block::Text(format!("Doubts before the run: {}.", warnings.join("; "))));
    }
    blocks.push(Block::Table(Table { title: "Size and cost".into(), head, rows }));
    blocks.extend(s.compressibility.as_ref().map(|c| Block::Text(compressibility_in_words(c))));
    blocks.extend(gauge_table(s));
    blocks
}

fn log_rows(log: &Log) -> Vec<Vec<String>> {
    let mut rows = vec![
        row(&["log", &format!("{:.1}", 1e-6 * log.bytes as f64), "MB"]),
        row(&["frames of particles in the log", &log.frames.to_string(), ""]),
    ];
    if let Some(budget) = log.budget_megabytes {
        rows.push(row(&["size that the log was to stay below", &format!("{budget:.1}"), "MB"]));
        rows.push(row(&["frames left out for that", &log.frames_left_out.to_string(), ""]));
    }
    rows
}

fn compressibility_rows(c: &Compressibility) -> Vec<Vec<String>> {
    let mut rows = vec![
        row(&["sound speed", &format!("{:.1}", c.sound_speed_m_per_s), "m/s"]),
        row(&["Mach number reached", &format!("{:.4}", c.mach_reached), ""]),
    ];
    if let Some(error) = c.force_error_estimate {
        rows.push(row(&["share of force lost to compressibility, estimated", &format!("{:.2}", 100.0 * error), "%"]));
    }
    if let Some(factor) = c.force_corrected {
        rows.push(row(&["factor on the force that takes it back", &format!("{factor:.4}"), ""]));
    }
    rows
}

fn projection_rows(p: &Projection) -> Vec<Vec<String>> {
    let mut rows = vec![
        row(&["pressure equations solved", &p.solves.to_string(), ""]),
        row(&["iterations of them a step", &format!("{:.1}", p.iterations_mean), ""]),
    ];
    if let Some(pinned) = p.pinned_last {
        rows.push(row(&["rows pinned at p = 0 in the last step", &pinned.to_string(), ""]));
    }
    rows
}

/// What weak compressibility did to the run, in a sentence.
fn compressibility_in_words(c: &Compressibility) -> String {
    let reached = format!("The water is weakly compressible; its fastest particle reached Mach {:.3}", c.mach_reached);
    match (c.force_error_estimate, c.force_corrected) {
        (Some(share), Some(factor)) => format!(
            "{reached}. By a law fitted to wedges, this takes {:.2} % of the force: incompressible water would give \
             {factor:.4} times the forces shown, which are not corrected. To extrapolate it away, with the spacing: \
             splashdown study.",
            100.0 * share
        ),
        _ => format!("{reached}; without an impact there is no estimate of what this costs."),
    }
}

fn gauge_table(s: &Summary) -> Option<Block> {
    let known = |value: Option<f64>, digits: usize| value.map_or("–".to_string(), |v| format!("{v:.digits$}"));
    let line = |(name, g): (&String, &GaugeResult)| {
        row(&[
            name,
            &format!("{:.1}", g.peak_pa),
            &format!("{:.6}", g.peak_time_s),
            &known(g.rise_time_s.map(|t| 1e3 * t), 3),
            &format!("{:.4}", g.impulse_pa_s),
            &format!("{:.2}", 1e3 * g.length_m),
            &known(g.bandwidth_hz, 0),
        ])
    };
    let head = ["gauge", "peak [Pa]", "at [s]", "rise 10–90 % [ms]", "impulse [Pa s]", "length [mm]", "bandwidth [Hz]"];
    (!s.gauges.is_empty()).then(|| {
        Block::Table(Table { title: "Gauges".into(), head: row(&head), rows: s.gauges.iter().map(line).collect() })
    })
}

fn comparison_table(comparisons: &[Comparison]) -> Block {
    let line = |c: &Comparison| {
        let verdict = match (c.tolerance, c.passes()) {
            (None, _) => "drawn only",
            (_, true) => "within",
            (_, false) => "outside",
        };
        let tolerance = c.tolerance.map_or(String::new(), |t| format!("{t:.3}"));
        row(&[
            &c.reference,
            &c.quantity,
            &format!("{:.5}", c.ours),
            &format!("{:.5}", c.theirs),
            &format!("{:.4}", c.error),
            &tolerance,
            verdict,
        ])
    };
    Block::Table(Table {
        title: "Errors against references".into(),
        head: row(&["reference", "quantity", "ours", "theirs", "error", "tolerance", "verdict"]),
        rows: comparisons.iter().map(line).collect(),
    })
}

fn force_rules_section(s: &Summary) -> Vec<Block> {
    let text = "The check: the integral of p dA against the body's force. Reaction: sum of the pair forces, which moves \
                the body. First row: pressure of the boundary particles. Gauss: pressure as a gauge reads it, at Gauss \
                points. Gauss, viscous: pressure by moving least squares, with viscous traction. Means over the last \
                fifth of the run; differences from the reaction.";
    let line = |r: &RuleResult| {
        let [fx, fy] = r.force_n_per_m;
        let percent = |share: f64| format!("{:.2}", 100.0 * share);
        let cells = [fx, fy, r.force_y_sd_n_per_m, r.moment_n, r.impulse_n_s_per_m[1]].map(|v| format!("{v:.5e}"));
        let mut line = vec![r.rule.to_string()];
        line.extend(cells);
        line.extend([percent(r.force_difference), percent(r.impulse_difference)]);
        line
    };
    let head = [
        "rule",
        "Fx [N/m]",
        "Fy [N/m]",
        "sd of Fy [N/m]",
        "moment [N]",
        "impulse y [N s/m]",
        "force [%]",
        "impulse [%]",
    ];
    let table =
        Table { title: "Force by four rules".into(), head: row(&head), rows: s.force_rules.iter().map(line).collect() };
    vec![Block::Text(text.into()), Block::Table(table)]
}

fn audit_table(s: &Summary) -> Block {
    let rows = vec![
        row(&["momentum: worst gap of a step, relative", &format!("{:.2e}", s.audit.momentum)]),
        row(&["energy: drift over the largest exchanged (negative: dissipated)", &format!("{:.4}", s.audit.energy)]),
        row(&["work of the water that did not arrive at the body, relative", &format!("{:.2e}", s.audit.work)]),
        row(&["work that an elastic body lost, relative", &format!("{:.2e}", s.audit.structure)]),
        row(&["volume: relative change", &format!("{:.2e}", s.audit.volume)]),
        row(&["particles found beyond a wall", &s.audit.penetrated.to_string()]),
    ];
    let worst = s.audit.worst_penetration.iter().map(|worst| row(&["not tight", &worst.to_string()]));
    let rows = rows.into_iter().chain(worst).collect();
    Block::Table(Table { title: "Conservation".into(), head: row(&["quantity", "value"]), rows })
}

/// Where the wall time went, in the order of a step.
fn cost_bar(s: &Summary) -> Block {
    let known = Phase::ALL.into_iter().filter_map(|phase| Some((phase, s.phases.get(phase.name())?)));
    let parts = known.map(|(phase, time)| Part { label: phase.name().into(), size: time.seconds }).collect();
    Block::Bar(Bar { title: format!("Wall time by part of the run, {} threads", s.threads), unit: "s".into(), parts })
}

fn pictures(scene: &Scene, frames: &[FlowFrame]) -> Vec<Block> {
    let mirror_x = scene.symmetry == Symmetry::X;
    let (x, y) = window(scene);
    let inside = |f: &FlowFrame, k: usize| {
        let at = if mirror_x { f.x[k].abs() } else { f.x[k] } as f64;
        at > x[0] && at < x[1] && (f.y[k] as f64) > y[0] && (f.y[k] as f64) < y[1]
    };
    let mut values: Vec<f32> =
        frames.iter().flat_map(|f| (0..f.x.len()).filter(|&k| inside(f, k)).map(|k| f.value[k])).collect();
    values.sort_by(f32::total_cmp);
    let top = values.get(values.len().saturating_sub(1) * 995 / 1000).map_or(1.0, |v| f64::from(*v).max(1e-6));
    let view = FlowView { x, y, value: [0.0, top], width_px: 1100, label: "pressure [kPa]".into(), mirror_x };
    let mut drawn = vec![Vec::new(); frames.len()];
    parallel::update_pieces(&mut drawn, 1, |k, png| png[0] = flow_png(&frames[k], &view));
    let picture =
        |(f, png): (&FlowFrame, _)| Block::Picture { png, caption: format!("Pressure at t = {:.5} s", f.time) };
    frames.iter().zip(drawn).map(picture).collect()
}

/// The part of the flow worth looking at [m]: the fine zone and as much again, or the whole tank.
fn window(scene: &Scene) -> ([f64; 2], [f64; 2]) {
    let (half, depth) = (0.5 * scene.tank.width, scene.tank.depth);
    let [fine, _] = scene.resolution.fine_zone;
    let graded = scene.resolution.growth > 1.0 && fine < 0.8 * half;
    match &scene.body {
        Some(body) if graded => {
            let (w, middle) = (1.3 * fine, body.middle());
            ([middle - w, middle + w], [-0.55 * w, 0.55 * w])
        }
        _ => {
            let margin = 0.03 * half;
            let top = (scene.tank.height - depth).min(2.0 * half - depth).max(0.1 * half);
            ([-half - margin, half + margin], [-depth - margin, top])
        }
    }
}

fn charts(scene: &Scene, outcome: &Outcome) -> Vec<Block> {
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
