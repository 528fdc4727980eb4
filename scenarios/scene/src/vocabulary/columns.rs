//! Titles and units of the columns of the curves.

/// What a column of the series is.
#[derive(Clone, Debug, PartialEq)]
pub struct ColumnTitle {
    /// Title in words; columns with the same title share a chart.
    pub title: String,
    /// Its name among those that share the chart; empty for a column that stands alone.
    pub part: String,
    /// SI unit.
    pub si: &'static str,
    /// Factor from the column to SI, or to g.
    pub scale: f64,
}

/// Quantities of a body by the ends of their columns.
const OF_BODY: [(&str, &str, &str, f64); 10] = [
    ("fy_N_per_m", "Vertical force on", "N/m", 1.0),
    ("fx_N_per_m", "Horizontal force on", "N/m", 1.0),
    ("moment_N", "Moment on", "N m/m", 1.0),
    ("ay_m_per_s2", "Vertical acceleration of", "g", 1.0 / 9.80665),
    ("ax_m_per_s2", "Horizontal acceleration of", "g", 1.0 / 9.80665),
    ("vy_m_per_s", "Vertical velocity of", "m/s", 1.0),
    ("vx_m_per_s", "Horizontal velocity of", "m/s", 1.0),
    ("y_m", "Height of", "m", 1.0),
    ("x_m", "Horizontal position of", "m", 1.0),
    ("angle_deg", "Pitch of", "°", 1.0),
];

/// Quantities at a place of a panel.
const OF_PANEL: [(&str, &str, &str); 6] = [
    ("deflection_m", "Deflection of", "m"),
    ("dx_m", "Displacement along x of", "m"),
    ("dy_m", "Displacement along y of", "m"),
    ("moment_N", "Bending moment in", "N m/m"),
    ("strain_left", "Strain of the left face of", "-"),
    ("strain_right", "Strain of the right face of", "-"),
];

/// What a column is; one that is not known keeps its name.
pub fn column_title(name: &str) -> ColumnTitle {
    let new = |title: String, part: &str, si, scale| ColumnTitle { title, part: part.into(), si, scale };
    let known = |(first, rest): (&str, &str)| {
        if rest == "p_Pa" {
            return Some(new("Pressure at the gauges".into(), first, "Pa", 1.0));
        }
        if rest == "stress_Pa" {
            return Some(new(format!("Largest stress in {first}"), "", "Pa", 1.0));
        }
        if let Some((place, quantity)) = rest.strip_prefix("at").and_then(|rest| rest.rsplit_once('.')) {
            let (_, words, si) = OF_PANEL.into_iter().find(|(end, ..)| *end == quantity)?;
            return Some(new(format!("{words} {first}"), &format!("at {place} % of its length"), si, 1.0));
        }
        if let Some((mass, "extension_m")) = rest.rsplit_once('.') {
            return Some(new(format!("Height of the {mass} above its unloaded spring"), "", "m", 1.0));
        }
        let (of, rest) = rest.rsplit_once('.').unwrap_or((first, rest)); // of a mass on the body, or its own
        let (_, words, si, scale) = OF_BODY.into_iter().find(|(end, ..)| *end == rest)?;
        Some(new(format!("{words} the {of}"), "", si, scale))
    };
    if let Some(column) = name.split_once('.').and_then(known) {
        return column;
    }
    let level = name.strip_prefix("level").and_then(|rest| rest.strip_suffix("_m"));
    match (name, level) {
        (_, Some(number)) => new("Height of the water".into(), &format!("level {number}"), "m", 1.0),
        ("front_m", _) => new("Length of the water along the floor".into(), "", "m", 1.0),
        ("volume_m2", _) => new("Volume of the water per metre of span".into(), "", "m²", 1.0),
        ("kinetic_J_per_m", _) => new("Energies of the water".into(), "kinetic", "J/m", 1.0),
        ("potential_J_per_m", _) => new("Energies of the water".into(), "potential", "J/m", 1.0),
        ("mechanical_J_per_m", _) => new("Energies of the water".into(), "sum", "J/m", 1.0),
        ("elastic_J_per_m", _) => new("Energies of the water".into(), "elastic", "J/m", 1.0),
        _ => new(name.into(), "", "", 1.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_have_titles_in_words() {
        assert_eq!(column_title("wedge.fy_N_per_m").title, "Vertical force on the wedge");
        let deflection = column_title("plate.at12.5.deflection_m");
        assert_eq!(
            (deflection.title.as_str(), deflection.part.as_str()),
            ("Deflection of plate", "at 12.5 % of its length")
        );
        assert_eq!(column_title("keel.p_Pa").part, "keel");
        assert_eq!(column_title("unknown_m").title, "unknown_m");
    }
}
