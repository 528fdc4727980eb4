//! A study as tables and as text.

use super::{Point, Study};

/// Headings of a table of runs.
pub(super) const HEAD: [&str; 8] =
    ["spacing [m]", "sound speed [m/s]", "Mach", "value", "error [%]", "particles", "steps", "core-s"];

/// The cells of a run.
pub(super) fn cells(p: &Point) -> [String; 8] {
    [
        format!("{:.6}", p.spacing_m),
        format!("{:.2}", p.sound_speed_m_per_s),
        format!("{:.4}", p.mach),
        format!("{:.6e}", p.value),
        p.error.map_or("–".into(), |e| format!("{:+.2}", 100.0 * e)),
        p.particles.to_string(),
        p.steps.to_string(),
        format!("{:.1}", p.core_seconds),
    ]
}

/// Name and value of each result.
pub(super) fn results(study: &Study) -> Vec<[String; 2]> {
    let f = &study.fit;
    let percent = |x: f64| format!("{:+.2} %", 100.0 * x);
    let order = match f.order {
        Some(p) if p == f.order_used => format!("{p:.2}"),
        Some(p) => format!("{p:.2}; {} is used", f.order_used),
        None => format!("none; {} is used", f.order_used),
    };
    let unknown = || "unknown: one sound speed".to_string();
    let share = f.sound_speed_share.map_or_else(unknown, |s| format!("{:.0} %", 100.0 * s));
    [
        ("extrapolated", format!("{:.6e}, within {:.2} %", f.extrapolated, 100.0 * f.uncertainty)),
        ("observed order", order),
        ("finest run, error of its spacing", percent(f.discretisation_error)),
        ("finest run, error of its sound speed", f.sound_speed_error.map_or_else(unknown, percent)),
        ("share of the sound speed in both", share),
        ("scatter about the fit", f.scatter.map_or("unknown: no runs to spare".into(), percent)),
        ("law of the sound speed", study.sound_speed_law.to_string()),
        ("cost of all runs", format!("{:.1} core-s", study.core_seconds)),
        ("verdict", f.verdict()),
    ]
    .map(|(name, value)| [name.to_string(), value])
    .to_vec()
}

/// Runs and results in aligned columns.
pub fn text(study: &Study) -> String {
    let mut rows = vec![HEAD.map(String::from)];
    rows.extend(study.points.iter().map(cells));
    let width = |k: usize| rows.iter().map(|r| r[k].chars().count()).max().unwrap_or(0);
    let widths: [usize; 8] = std::array::from_fn(width);
    let aligned = |row: &[String; 8]| {
        let cells = row.iter().zip(&widths).map(|(cell, width)| format!("{cell:>width$}", width = *width));
        cells.collect::<Vec<_>>().join("  ")
    };
    let mut lines = vec![format!("{}: {}", study.scene, study.quantity)];
    lines.extend(rows.iter().map(aligned));
    lines.extend(results(study).into_iter().map(|[name, value]| format!("{name:<38} {value}")));
    lines.join("\n")
}
