//! A study in rows and words.

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

impl Study {
    /// The answer, name and value by line.
    pub(super) fn answer(&self) -> Vec<[String; 2]> {
        let f = &self.fit;
        let percent = |x: f64| format!("{:+.2} %", 100.0 * x);
        let line = |name: &str, value: String| [name.to_string(), value];
        let order = match f.order {
            Some(p) if p == f.order_used => format!("{p:.2}"),
            Some(p) => format!("{p:.2}; {} is used", f.order_used),
            None => format!("none; {} is used", f.order_used),
        };
        let unknown = || "unknown: one sound speed".to_string();
        vec![
            line("extrapolated", format!("{:.6e}, within {:.2} %", f.extrapolated, 100.0 * f.uncertainty)),
            line("observed order", order),
            line("finest run, error of its spacing", percent(f.discretisation_error)),
            line("finest run, error of its sound speed", f.sound_speed_error.map_or_else(unknown, percent)),
            line(
                "share of the sound speed in both",
                f.sound_speed_share.map_or_else(unknown, |s| format!("{:.0} %", 100.0 * s)),
            ),
            line("scatter about the fit", f.scatter.map_or("unknown: no runs to spare".into(), percent)),
            line("law of the sound speed", self.sound_speed_law.to_string()),
            line("cost of all runs", format!("{:.1} core-s", self.core_seconds)),
            line("verdict", self.verdict()),
        ]
    }

    /// In plain words.
    pub fn to_text(&self) -> String {
        let mut rows = vec![HEAD.map(String::from)];
        rows.extend(self.points.iter().map(cells));
        let widths: Vec<usize> =
            (0..HEAD.len()).map(|k| rows.iter().map(|r| r[k].chars().count()).max().unwrap_or(0)).collect();
        let set = |row: &[String; 8]| {
            let cells = row.iter().zip(&widths).map(|(cell, width)| format!("{cell:>width$}", width = *width));
            cells.collect::<Vec<_>>().join("  ")
        };
        let mut lines = vec![format!("{}: {}", self.scene, self.quantity)];
        lines.extend(rows.iter().map(set));
        lines.extend(self.answer().into_iter().map(|[name, value]| format!("{name:<38} {value}")));
        lines.join("\n")
    }
}
