//! The tables of `report.html`: size and cost, gauges, comparisons, error bars, force rules, panels, audit.

use sph_core::Phase;

use crate::compare::Comparison;
use crate::report::{Bar, Block, Part, Table, known, row};
use crate::run::summary::{Compressibility, Summary};
use crate::run::{Extremes, PanelResult, Rupture};
use crate::scene::{Scene, significant};

pub(super) fn run_section(scene: &Scene, s: &Summary, warnings: &[String]) -> Vec<Block> {
    let mut rows = vec![row(&["model", s.model, ""])];
    let mut add = |quantity: &str, value: String, unit: &str| rows.push(row(&[quantity, &value, unit]));
    if !scene.model.is_theory() {
        add("fluid particles", s.particles.fluid.to_string(), "");
        add("wall particles", s.particles.wall.to_string(), "");
        add("finest spacing", format!("{:.4}", 1e3 * scene.resolution.spacing), "mm");
        add("steps", s.steps.to_string(), "");
        add("particle updates", format!("{:.2}", 1e-6 * s.particle_updates_per_s), "million/s");
    }
    add("time reached", format!("{:.6}", s.time_end_s), "s");
    add("wall time", format!("{:.3}", s.wall_time_s), "s");
    add("threads", s.threads.to_string(), "");
    if let Some(log) = &s.log {
        add("log", format!("{:.1}", 1e-6 * log.bytes as f64), "MB");
        add("frames of particles in the log", log.frames.to_string(), "");
        if let Some(budget) = log.budget_megabytes {
            add("size budget of the log", format!("{budget:.1}"), "MB");
            add("frames left out to keep it", log.frames_left_out.to_string(), "");
        }
    }
    if let Some(c) = &s.compressibility {
        add("sound speed", format!("{:.1}", c.sound_speed_m_per_s), "m/s");
        add("Mach number reached", format!("{:.4}", c.mach_reached), "");
        if let Some(error) = c.force_error_estimate {
            add("share of the force lost to compressibility, estimated", format!("{:.2}", 100.0 * error), "%");
        }
        if let Some(factor) = c.force_corrected {
            add("factor on the force that corrects for it", format!("{factor:.4}"), "");
        }
    }
    if let Some(p) = &s.projection {
        add("pressure solves", p.solves.to_string(), "");
        add("iterations per step", format!("{:.1}", p.iterations_mean), "");
        if let Some(pinned) = p.pinned_last {
            add("particles held at p = 0 in the last step", pinned.to_string(), "");
        }
    }
    let mut blocks = Vec::new();
    if !scene.source.is_empty() {
        blocks.push(Block::Text(format!("Source: {}.", scene.source)));
    }
    if !warnings.is_empty() {
        blocks.push(Block::Text(format!("Warnings before the run: {}.", warnings.join("; "))));
    }
    blocks.push(Block::Table(Table::new("Size and cost", &["quantity", "value", "unit"], rows)));
    blocks.extend(s.compressibility.as_ref().map(|c| Block::Text(compressibility_in_words(c))));
    blocks.extend(gauge_section(s));
    blocks
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

/// Results, first of all: what a designer takes away.
pub(super) fn results_section(s: &Summary) -> Vec<Block> {
    let named = s.results.named();
    let of_single_steps = "Peaks are means over the time in which the body falls three spacings; raw is the largest value of a single step.";
    let table = Table::of(
        "Results",
        &named,
        &[
            ("result", |(name, _)| name.clone()),
            ("value", |(_, q)| significant(q.value)),
            ("± band", |(_, q)| q.band.map_or(String::new(), significant)),
            ("at [s]", |(_, q)| known(q.time_s, 6)),
            ("cut-off [Hz]", |(_, q)| known(q.cutoff_hz, 0)),
            ("raw", |(_, q)| significant(q.raw)),
            ("verdict", |(_, q)| q.verdict.name().into()),
        ],
    );
    table_section(of_single_steps, table)
}

fn gauge_section(s: &Summary) -> Vec<Block> {
    let table = Table::of(
        "Gauges",
        &s.gauges,
        &[
            ("gauge", |(name, _)| name.to_string()),
            ("peak [Pa]", |(_, g)| format!("{:.1}", g.peak_pa)),
            ("at [s]", |(_, g)| format!("{:.6}", g.peak_time_s)),
            ("rise 10–90 % [ms]", |(_, g)| known(g.rise_time_s.map(|t| 1e3 * t), 3)),
            ("impulse [Pa s]", |(_, g)| format!("{:.4}", g.impulse_pa_s)),
            ("length [mm]", |(_, g)| format!("{:.2}", 1e3 * g.length_m)),
            ("bandwidth [Hz]", |(_, g)| known(g.bandwidth_hz, 0)),
        ],
    );
    table_section("", table)
}

/// Comparisons with references, and those that the run does not reach; nothing without any.
pub(super) fn comparison_section(summary: &Summary) -> Vec<Block> {
    let verdict = |c: &&Comparison| match (c.tolerance, c.passes()) {
        (None, _) => "drawn only".into(),
        (_, true) => "within".into(),
        (_, false) => "outside".into(),
    };
    let table = Table::of(
        "Errors against references",
        &summary.comparison,
        &[
            ("reference", |c| c.reference.clone()),
            ("quantity", |c| c.quantity.clone()),
            ("ours", |c| format!("{:.5}", c.ours)),
            ("theirs", |c| format!("{:.5}", c.theirs)),
            ("error", |c| format!("{:.4}", c.error)),
            ("tolerance", |c| c.tolerance.map_or(String::new(), |t| format!("{t:.3}"))),
            ("verdict", verdict),
        ],
    );
    let missing = summary.not_compared.iter().map(|why| Block::Text(format!("Not compared: {why}.")));
    table_section("", table).into_iter().chain(missing).collect()
}

/// A text and the table that it explains; nothing where the table is empty.
fn table_section(text: &str, table: Table) -> Vec<Block> {
    if table.rows.is_empty() { Vec::new() } else { vec![Block::Text(text.into()), Block::Table(table)] }
}

/// Main numbers with their bands; nothing without any.
pub(super) fn error_bars_section(summary: &Summary) -> Vec<Block> {
    let text = "Error bars of main numbers. The band is centred on the extrapolated value if a convergence study was made, else on \
                the value of the run.";
    let table = Table::of(
        "Error bars",
        &summary.error_bars,
        &[
            ("number", |(path, _)| path.to_string()),
            ("value", |(_, bar)| format!("{:.5e}", bar.value)),
            ("extrapolated", |(_, bar)| bar.extrapolated.map_or("–".into(), |v| format!("{v:.5e}"))),
            ("band ±", |(_, bar)| format!("{:.2e}", bar.band)),
            ("band [%]", |(_, bar)| format!("{:.2}", 100.0 * (bar.band / bar.middle()).abs())),
            ("order", |(_, bar)| known(bar.order, 2)),
            ("verdict", |(_, bar)| bar.verdict.clone()),
            ("method", |(_, bar)| bar.method.clone()),
        ],
    );
    table_section(text, table)
}

/// The force on the body by four rules; nothing where the scene does not ask.
pub(super) fn force_rules_section(s: &Summary) -> Vec<Block> {
    let text = "The check: the integral of p dA against the body's force. Reaction: sum of the pair forces, which moves \
                the body. First row: pressure of the boundary particles. Gauss: pressure as a gauge reads it, at Gauss \
                points. Gauss, viscous: pressure by moving least squares, with viscous traction. Means over the last \
                fifth of the run; differences from the reaction.";
    let table = Table::of(
        "Force by four rules",
        &s.force_rules,
        &[
            ("rule", |r| r.rule.to_string()),
            ("Fx [N/m]", |r| format!("{:.5e}", r.force_n_per_m[0])),
            ("Fy [N/m]", |r| format!("{:.5e}", r.force_n_per_m[1])),
            ("sd of Fy [N/m]", |r| format!("{:.5e}", r.force_y_sd_n_per_m)),
            ("moment [N]", |r| format!("{:.5e}", r.moment_n)),
            ("impulse y [N s/m]", |r| format!("{:.5e}", r.impulse_n_s_per_m[1])),
            ("force [%]", |r| format!("{:.2}", 100.0 * r.force_difference)),
            ("impulse [%]", |r| format!("{:.2}", 100.0 * r.impulse_difference)),
        ],
    );
    table_section(text, table)
}

pub(super) fn audit_table(s: &Summary) -> Block {
    let audit = &s.audit;
    let mut rows: Vec<Vec<String>> = [
        ("momentum: largest gap per step, relative", format!("{:.2e}", audit.momentum)),
        ("energy: drift over the largest exchanged (negative: dissipated)", format!("{:.4}", audit.energy)),
        ("work of the water that did not reach the body, relative", format!("{:.2e}", audit.work)),
        ("work on an elastic body that its energies do not contain, relative", format!("{:.2e}", audit.structure)),
        ("volume: relative change", format!("{:.2e}", audit.volume)),
        ("particles beyond a wall", audit.penetrated.to_string()),
    ]
    .map(|(quantity, value)| row(&[quantity, &value]))
    .to_vec();
    rows.extend(audit.worst_penetration.iter().map(|worst| row(&["penetration", &worst.to_string()])));
    Block::Table(Table::new("Conservation", &["quantity", "value"], rows))
}

/// Extremes of each panel over every step, and its ruptures.
pub(super) fn panels_section(summary: &Summary) -> Vec<Block> {
    let blocks = |(name, panel): (&String, &PanelResult)| {
        std::iter::once(panel_table(name, panel)).chain(ruptures(name, panel)).collect::<Vec<_>>()
    };
    summary.panels.iter().flat_map(blocks).collect()
}

fn panel_table(name: &str, panel: &PanelResult) -> Block {
    let extremes = |what: &str, e: &Extremes| {
        let numbers = [e.least, e.least_at_s, e.most, e.most_at_s].map(|v| format!("{v:.5e}"));
        [vec![what.to_string()], numbers.to_vec()].concat()
    };
    let mut rows = vec![
        extremes("normal force N [N/m]", &panel.normal_n_per_m),
        extremes("shear force Q [N/m]", &panel.shear_n_per_m),
        extremes("bending moment M [N]", &panel.moment_n),
        extremes("stress of outer fibres [Pa]", &panel.stress_pa),
        extremes("their strain [-]", &panel.strain),
    ];
    let single = |what: &str, value: f64| row(&[what, "", "", &format!("{value:.4e}"), ""]);
    rows.extend(panel.reserve_factor.map(|factor| single("reserve factor: allowable over largest stress [-]", factor)));
    if panel.plastic_curvature_per_m > 0.0 {
        rows.push(single("plastic curvature left, largest [1/m]", panel.plastic_curvature_per_m));
    }
    let head = ["quantity", "least", "at [s]", "most", "at [s]"];
    Block::Table(Table::new(format!("{name}: extremes over every step"), &head, rows))
}

/// The ruptures in a sentence.
fn ruptures(name: &str, panel: &PanelResult) -> Option<Block> {
    let one = |r: &Rupture| {
        let (x, y, time, strain) = (r.x_m, r.y_m, r.time_s, r.strain);
        format!("{name} broke off at ({x:.4}, {y:.4}) m, t = {time:.6} s, at a strain of {strain:.4}")
    };
    let all: Vec<String> = panel.ruptures.iter().map(one).collect();
    (!all.is_empty()).then(|| Block::Text(format!("{}.", all.join("; "))))
}

/// Wall time by part, in the order of a step.
pub(super) fn cost_bar(s: &Summary) -> Block {
    let known = Phase::ALL.into_iter().filter_map(|phase| Some((phase, s.phases.get(phase.name())?)));
    let parts = known.map(|(phase, time)| Part { label: phase.name().into(), size: time.seconds }).collect();
    Block::Bar(Bar { title: format!("Wall time by part of the run, {} threads", s.threads), unit: "s".into(), parts })
}
