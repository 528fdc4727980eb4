//! The tables of the page: size and cost, gauges, comparisons, error bars, force rules, audit.

use run::evidence::{self, Quantity};
use scene::vocabulary::{self, ResultId};
use sph_core::Phase;

use super::folder::RunFolder;
use super::headline::{title, verdict_of, with_share};
use super::quantity::{digits, five_digits, percent, with_unit};
use super::record::{Compressibility, Record};
use super::references;
use super::theories::model_in_words;
use crate::{Bar, Block, Part, Table, row};

/// Least and largest drift of the energy in bounds [-].
const ENERGY: [f64; 2] = [-0.3, 0.02];

/// A number with three digits; a dash where it is unknown.
fn number(value: Option<f64>) -> String {
    value.map_or("–".into(), digits)
}

/// A number with its unit; a dash where it is unknown.
fn unit(value: Option<f64>, si: &str) -> String {
    value.map_or("–".into(), |v| with_unit(v, si))
}

pub(super) fn run_section(run: &RunFolder) -> Vec<Block> {
    let (scene, s) = (&run.scene, &run.record);
    let mut rows = vec![row(&["Model", model_in_words(run.model())])];
    let mut add = |quantity: &str, value: String| rows.push(row(&[quantity, &value]));
    if !scene.model.is_theory() {
        add("Fluid particles", s.particles.fluid.to_string());
        add("Wall particles", s.particles.wall.to_string());
        add("Finest spacing", with_unit(scene.resolution.spacing, "m"));
        add("Steps", s.steps.to_string());
        add("Particle updates", format!("{} million/s", number(s.particle_updates_per_s.map(|v| 1e-6 * v))));
    }
    add("Time reached", unit(s.time_end_s, "s"));
    add("Wall time", format!("{} s on {} threads", number(s.wall_time_s), s.threads));
    if let Some(log) = &s.log {
        add("Log", format!("{} MB, {} frames", digits(1e-6 * log.bytes as f64), log.frames));
        if let Some(budget) = log.budget_megabytes {
            add("Budget of the log", format!("{} MB, {} frames left out", digits(budget), log.frames_left_out));
        }
    }
    if let Some(c) = &s.compressibility {
        add("Speed of sound", unit(c.sound_speed_m_per_s, "m/s"));
        add("Mach number reached", number(c.mach_reached));
    }
    if let Some(p) = &s.projection {
        add("Pressure solves", p.solves.to_string());
        add("Iterations per step", number(p.iterations_mean));
        if let Some(pinned) = p.pinned_last {
            add("Particles held at p = 0 in the last step", pinned.to_string());
        }
    }
    let mut blocks = Vec::new();
    if !scene.source.is_empty() {
        blocks.push(Block::Text(format!("Source: {}.", scene.source)));
    }
    blocks.extend(s.choice.iter().map(|why| Block::Text(format!("Model chosen: {why}."))));
    blocks.push(Block::Table(Table::new("Size and cost", &["quantity", "value"], rows)));
    blocks.extend(s.compressibility.as_ref().map(|c| Block::Text(compressibility_in_words(c))));
    blocks
}

/// Effect of weak compressibility.
fn compressibility_in_words(c: &Compressibility) -> String {
    let mach = number(c.mach_reached);
    let reached = format!("The water is weakly compressible; its fastest particle reached Mach {mach}");
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

/// Largest share of a value in its band for which a value that is not exceeded is given [-].
const WIDEST: f64 = 0.3;

/// GE28: the value that a result does not exceed with a probability of 95 %, where it has a band and its quantity was judged by enough
/// references.
fn not_exceeded(model: &str, id: &ResultId, q: &vocabulary::Quantity) -> Option<f64> {
    let band = q.share().filter(|share| q.verdict == vocabulary::Verdict::Resolved && *share <= WIDEST)?;
    let known = evidence::known(Quantity::of_result(id.name)?, model)?;
    Some(q.shown()? * known.not_exceeded(band)?)
}

/// Results as a table, with what the cards have no room for; nothing where the run failed.
pub(super) fn results_section(run: &RunFolder) -> Vec<Block> {
    if run.has_failed() {
        return Vec::new();
    }
    let results = &run.record.results;
    let rows = results.named().map(|(id, q)| {
        let si = id.name.si();
        vec![
            title(run, &id),
            with_share(q, si),
            unit(q.time_s, "s"),
            q.cutoff_hz.map_or("–".into(), |f| format!("{f:.0} Hz")),
            verdict_of(run, &id, q),
            // an integral, and a stress, are not averaged
            q.cutoff_hz.map_or("–".into(), |_| with_unit(q.raw, si)),
            not_exceeded(run.model(), &id, q).map_or("–".into(), |value| with_unit(value, si)),
        ]
    });
    let mut rows: Vec<Vec<String>> = rows.collect();
    if let Some(filtered) = &run.record.acceleration_filtered {
        let class = format!("CFC {}", number(filtered.cfc));
        rows.push(row(&[
            "Peak acceleration, filtered",
            &unit(filtered.peak_g, "g"),
            &unit(filtered.time_s, "s"),
            &class,
            "",
            "",
            "",
        ]));
    }
    let mut text = match run.record.results.bandwidth_by {
        Some(by) => format!(
            "Peaks of force, acceleration and pressure are means. The bandwidth of the force is {}. The column of single steps has the \
             largest of all steps.",
            by.words()
        ),
        None => String::new(),
    };
    if !results.panels.is_empty() {
        text += " A stress is the largest of every step, for a structure averages by itself.";
    }
    if results.named().any(|(id, q)| not_exceeded(run.model(), &id, q).is_some()) {
        text += " The true mean over the same time is below the last column with a probability of 95 %, by the band and by bias and scatter of such \
                 numbers against references; what the references do not have, as air, ends and speed of a real body, is not in it.";
    }
    let head = ["result", "value ± band", "at", "averaged below", "verdict", "single step", "below, 95 %"];
    table_section(text.trim(), Table::new("Results", &head, rows))
}

pub(super) fn gauge_section(s: &Record) -> Vec<Block> {
    let rows = s.gauges.iter().map(|(name, g)| {
        vec![
            name.clone(),
            unit(g.peak_pa, "Pa"),
            unit(g.peak_time_s, "s"),
            unit(g.rise_time_s, "s"),
            unit(g.impulse_pa_s, "Pa s"),
            unit(g.length_m, "m"),
            g.bandwidth_hz.map_or("–".into(), |f| format!("{f:.0} Hz")),
        ]
    });
    let head = ["gauge", "peak, single step", "at", "rise 10–90 %", "impulse", "length", "bandwidth"];
    table_section("", Table::new("Gauges", &head, rows.collect()))
}

/// A text and the table that it explains; nothing where the table is empty.
fn table_section(text: &str, table: Table) -> Vec<Block> {
    let text = (!text.is_empty()).then(|| Block::Text(text.into()));
    if table.rows.is_empty() { Vec::new() } else { text.into_iter().chain([Block::Table(table)]).collect() }
}

/// Main numbers with their bands; nothing without any.
pub(super) fn error_bars_section(summary: &Record) -> Vec<Block> {
    let text = "Error bars of main numbers. The band is centred on the extrapolated value if a convergence study was made, else on \
                the value of the run. A band of the results above follows from laws fitted to other runs; one of a study, from this run at \
                three spacings.";
    let exact = |value: Option<f64>| value.map_or("–".into(), five_digits);
    let rows = summary.error_bars.iter().map(|(path, bar)| {
        let middle = bar.extrapolated.or(bar.value);
        let share = bar.band.zip(middle).map(|(band, middle)| (band / middle).abs());
        vec![
            references::in_words(path),
            exact(bar.value),
            exact(bar.extrapolated),
            bar.band.map_or("–".into(), digits),
            share.map_or("–".into(), percent),
            bar.order.map_or("–".into(), |order| format!("{order:.2}")),
            bar.verdict.clone(),
            bar.method.clone(),
        ]
    });
    let head = ["number", "value", "extrapolated", "band ±", "of the value", "order", "verdict", "method"];
    table_section(text, Table::new("Error bars", &head, rows.collect()))
}

/// The force on the body by four rules; nothing where the scene does not ask.
pub(super) fn force_rules_section(s: &Record) -> Vec<Block> {
    let text = "The check: the integral of p dA against the body's force. Reaction: sum of the pair forces, which moves \
                the body. First row: pressure of the boundary particles. Gauss: pressure as a gauge reads it, at Gauss \
                points. Gauss, viscous: pressure by moving least squares, with viscous traction. Means over the last \
                fifth of the run; differences from the reaction.";
    let percent = |share: Option<f64>| share.map_or("–".into(), |v| format!("{:.2}", 100.0 * v));
    let rows = s.force_rules.iter().map(|r| {
        vec![
            r.rule.clone(),
            unit(r.force_n_per_m[0], "N/m"),
            unit(r.force_n_per_m[1], "N/m"),
            unit(r.force_y_sd_n_per_m, "N/m"),
            unit(r.moment_n, "N m/m"),
            unit(r.impulse_n_s_per_m[1], "N s/m"),
            percent(r.force_difference),
            percent(r.impulse_difference),
        ]
    });
    let head = ["rule", "Fx", "Fy", "sd of Fy", "moment", "impulse y", "force [%]", "impulse [%]"];
    table_section(text, Table::new("Force by four rules", &head, rows.collect()))
}

/// Conservation; nothing where the run has no particles.
pub(super) fn audit_section(run: &RunFolder) -> Vec<Block> {
    let s = &run.record;
    let Some(audit) = s.audit.as_ref().filter(|_| s.particles.fluid > 0) else { return Vec::new() };
    let small =
        |value: f64, bound: f64| if value.abs() <= bound { "in\u{a0}bounds" } else { "out\u{a0}of\u{a0}bounds" };
    let energy = |value: f64| match value {
        v if v > ENERGY[1] || v.is_nan() => "out of bounds: energy from nowhere",
        v if v < ENERGY[0] => "strong dissipation",
        _ => "in\u{a0}bounds",
    };
    let mut rows = Vec::new();
    let mut add = |quantity: &str, value: Option<f64>, right: &str, mark: &dyn Fn(f64) -> &'static str| {
        rows.push(row(&[quantity, &number(value), right, value.map_or("not a number: out of bounds", mark)]));
    };
    add("Momentum: largest gap per step, relative", audit.momentum, "at most 10⁻⁹", &|v| small(v, 1e-9));
    add(
        "Energy: drift over the largest exchanged",
        audit.energy,
        "−0.1 to 0 (resolved) or −0.3 (coarse), dissipated; at most 0.02 gained",
        &energy,
    );
    if run.scene.body.is_some() {
        add("Work of the water that did not reach the body, relative", audit.work, "at most 0.01", &|v| small(v, 0.01));
    }
    if run.scene.body.as_ref().is_some_and(|body| body.bends()) {
        let words = "Work on an elastic body that its energies do not contain, relative";
        add(words, audit.structure, "at most 0.01", &|v| small(v, 0.01));
    }
    if audit.surface.is_some() {
        let words = "Impulse of the pressure on a body's outline that the body did not get, relative";
        add(words, audit.surface, "at most 0.05", &|v| small(v, 0.05));
    }
    add("Volume: relative change", audit.volume, "at most about 0.01", &|v| small(v, 0.01));
    let penetrated = audit.penetrated as f64;
    add("Particles beyond a wall", Some(penetrated), "0", &|v| small(v, 0.0));
    vec![Block::Table(Table::new("Conservation", &["quantity", "value", "right value", ""], rows))]
}

/// Wall time by part, in the order of a step.
pub(super) fn cost_section(s: &Record) -> Vec<Block> {
    let known = Phase::ALL.into_iter().filter_map(|phase| Some((phase, s.phases.get(phase.name())?.seconds?)));
    let parts: Vec<Part> = known.map(|(phase, size)| Part { label: phase.name().into(), size }).collect();
    if parts.is_empty() {
        return Vec::new();
    }
    vec![Block::Bar(Bar {
        title: format!("Wall time by part of the run, {} threads", s.threads),
        unit: "s".into(),
        parts,
    })]
}
