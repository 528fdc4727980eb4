//! Names of the numbers of a case: what each is in words, its unit, which end of it is the worst.

/// A number of a case.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Quantity {
    /// What it is.
    pub title: String,
    /// Its SI unit.
    pub unit: &'static str,
    /// The least value is the worst one.
    pub is_least: bool,
}

/// Numbers of all cases: name, title, unit, the least is the worst.
const PLAIN: [(&str, &str, &str, bool); 17] = [
    ("upward_acceleration", "Upward acceleration of the centre of mass", "g", false),
    ("load_factor", "Load factor", "-", false),
    ("deceleration", "Deceleration of the centre of mass", "g", false),
    ("water_force", "Upward force of the water", "N", false),
    ("water_moment", "Moment of the water about the centre of mass", "N m", false),
    ("line_load", "Load of a metre of the keel", "N/m", false),
    ("largest_pitch", "Largest pitch", "°", false),
    ("least_pitch", "Least pitch", "°", true),
    ("run_length", "Shortest way on the water", "m", true),
    ("deflection", "Deflection of the fuselage", "m", false),
    ("cell_pressure", "Mean pressure on a cell of the bottom", "Pa", false),
    ("balance_error", "Error of the balance of the fuselage's cuts", "-", false),
    ("flotation.trim", "Trim afloat", "°", false),
    ("flotation.waterline", "Height of the water over the body axis afloat", "m", false),
    ("flotation.reserve", "Volume of the fuselage over what the mass displaces", "-", true),
    ("flotation.sinks", "Time to sinking after the stop", "s", true),
    ("flotation.inside", "Water inside at the end", "m³", false),
];

/// Numbers of named things: start, end, title with the name, unit, the least is the worst.
const NAMED: [(&str, &str, &str, &str, bool); 10] = [
    ("accelerometer.", ".upwards", "Acceleration upwards at NAME", "g", false),
    ("accelerometer.", ".deceleration", "Deceleration at NAME", "g", false),
    ("window.", ".mean_pressure", "Mean pressure on the window NAME", "Pa", false),
    ("part.", ".force", "Force of the water on NAME", "N", false),
    ("flotation.", ".wet", "Time after which the sill of NAME is wet", "s", true),
    ("flotation.", ".over_water", "Height of the sill of NAME over the water", "m", true),
    ("station.", ".line_load", "Load of a metre of the keel at NAME m", "N/m", false),
    ("station.", ".pressure", "Mean pressure on the breadth at NAME m", "Pa", false),
    ("station.", ".shear", "Shear force in the cut at NAME m", "N", false),
    ("station.", ".bending", "Bending moment in the cut at NAME m", "N m", false),
];

impl Quantity {
    /// Of a name.
    pub fn of(name: &str) -> Quantity {
        let plain = PLAIN.iter().find(|(known, ..)| *known == name);
        if let Some((_, title, unit, is_least)) = plain {
            return Quantity { title: (*title).into(), unit, is_least: *is_least };
        }
        let named = NAMED.iter().find_map(|(start, end, title, unit, is_least)| {
            let inner = name.strip_prefix(start)?.strip_suffix(end)?;
            Some(Quantity { title: title.replace("NAME", inner), unit, is_least: *is_least })
        });
        named.unwrap_or_else(|| Quantity { title: name.into(), unit: "-", is_least: false })
    }

    /// True where `value` is worse than `other`.
    pub fn is_worse(&self, value: f64, other: f64) -> bool {
        match self.is_least {
            true => value < other,
            false => value.abs() > other.abs(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_have_titles_and_units() {
        let of = Quantity::of("station.12.5.bending");
        assert_eq!((of.title.as_str(), of.unit, of.is_least), ("Bending moment in the cut at 12.5 m", "N m", false));
        let wet = Quantity::of("flotation.aft_door.wet");
        assert!(wet.is_worse(3.0, 5.0) && !of.is_worse(3.0, -5.0) && wet.title.contains("aft_door"));
        assert_eq!(Quantity::of("flotation.trim").unit, "°");
    }
}
