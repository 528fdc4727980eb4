//! The tables of `report.html`: size and cost, gauges, comparisons, force rules, audit.

use sph_core::Phase;

use crate::compare::Comparison;
use crate::observers::{GaugeResult, RuleResult};
use crate::report::table::row;
use crate::report::{Bar, Block, Part, Table};
use crate::run::summary::{Compressibility, Log, Projection, Summary};
use crate::scene::Scene;

pub(super) fn run_section(scene: &Scene, s: &Summary, warnings: &[String]) -> Vec<Block> {
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
        blocks.push(Block::Text(format!("Warnings before the run: {}.", warnings.join("; "))));
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
        rows.push(row(&["size budget of the log", &format!("{budget:.1}"), "MB"]));
        rows.push(row(&["frames left out to keep it", &log.frames_left_out.to_string(), ""]));
    }
    rows
}

fn compressibility_rows(c: &Compressibility) -> Vec<Vec<String>> {
    let mut rows = vec![
        row(&["sound speed", &format!("{:.1}", c.sound_speed_m_per_s), "m/s"]),
        row(&["Mach number reached", &format!("{:.4}", c.mach_reached), ""]),
    ];
    if let Some(error) = c.force_error_estimate {
        rows.push(row(&[
            "share of the force lost to compressibility, estimated",
            &format!("{:.2}", 100.0 * error),
            "%",
        ]));
    }
    if let Some(factor) = c.force_corrected {
        rows.push(row(&["factor on the force that corrects for it", &format!("{factor:.4}"), ""]));
    }
    rows
}

fn projection_rows(p: &Projection) -> Vec<Vec<String>> {
    let mut rows = vec![
        row(&["pressure solves", &p.solves.to_string(), ""]),
        row(&["iterations per step", &format!("{:.1}", p.iterations_mean), ""]),
    ];
    if let Some(pinned) = p.pinned_last {
        rows.push(row(&["particles held at p = 0 in the last step", &pinned.to_string(), ""]));
    }
    rows
}

/// Effect of weak compressibility.
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

pub(super) fn comparison_table(comparisons: &[Comparison]) -> Block {
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

pub(super) fn force_rules_section(s: &Summary) -> Vec<Block> {
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

pub(super) fn audit_table(s: &Summary) -> Block {
    let rows = vec![
        row(&["momentum: largest gap per step, relative", &format!("{:.2e}", s.audit.momentum)]),
        row(&["energy: drift over the largest exchanged (negative: dissipated)", &format!("{:.4}", s.audit.energy)]),
        row(&["work of the water that did not reach the body, relative", &format!("{:.2e}", s.audit.work)]),
        row(&[
            "work on an elastic body that its energies do not contain, relative",
            &format!("{:.2e}", s.audit.structure),
        ]),
        row(&["volume: relative change", &format!("{:.2e}", s.audit.volume)]),
        row(&["particles beyond a wall", &s.audit.penetrated.to_string()]),
    ];
    let worst = s.audit.worst_penetration.iter().map(|worst| row(&["penetration", &worst.to_string()]));
    let rows = rows.into_iter().chain(worst).collect();
    Block::Table(Table { title: "Conservation".into(), head: row(&["quantity", "value"]), rows })
}

/// Wall time by part, in the order of a step.
pub(super) fn cost_bar(s: &Summary) -> Block {
    let known = Phase::ALL.into_iter().filter_map(|phase| Some((phase, s.phases.get(phase.name())?)));
    let parts = known.map(|(phase, time)| Part { label: phase.name().into(), size: time.seconds }).collect();
    Block::Bar(Bar { title: format!("Wall time by part of the run, {} threads", s.threads), unit: "s".into(), parts })
}
