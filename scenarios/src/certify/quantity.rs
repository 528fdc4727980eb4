//! Names of the numbers of a case: what each is in words, its unit, which end of it is the worst.

/// Which end of a number is the worst.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Worst {
    /// The largest.
    Most,
    /// That of largest size, of either sign.
    Size,
    /// The least.
    Least,
}

use Worst::{Least, Most, Size};

/// A number of a case.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Quantity {
    /// What it is.
    pub title: String,
    /// Its SI unit.
    pub unit: &'static str,
    /// Its place in tables.
    pub rank: usize,
    worst: Worst,
}

/// Numbers in the order of tables: name, title, unit, the worst. A name with `*` stands for all names that have something there, which `*` in the title is.
const TABLE: [(&str, &str, &str, Worst); 27] = [
    ("upward_acceleration", "Upward acceleration of the centre of mass", "g", Most),
    ("load_factor", "Load factor", "-", Most),
    ("deceleration", "Deceleration of the centre of mass", "g", Most),
    ("accelerometer.*.upwards", "Acceleration upwards at *", "g", Most),
    ("accelerometer.*.deceleration", "Deceleration at *", "g", Most),
    ("water_force", "Upward force of the water", "N", Most),
    ("water_moment", "Moment of the water about the centre of mass, nose up", "N m", Size),
    ("line_load", "Load of a metre of the keel", "N/m", Most),
    ("cell_pressure", "Mean pressure on a cell of the bottom", "Pa", Most),
    ("window.*.mean_pressure", "Mean pressure on the window *", "Pa", Most),
    ("part.*.force", "Force of the water on *", "N", Most),
    ("deflection", "Deflection of the fuselage", "m", Size),
    ("largest_pitch", "Largest pitch", "°", Most),
    ("least_pitch", "Least pitch", "°", Least),
    ("run_length", "Shortest way on the water", "m", Least),
    ("flotation.sinks", "Time to sinking after the stop", "s", Least),
    ("flotation.*.wet", "Time after which the sill of * is wet", "s", Least),
    ("flotation.*.over_water", "Least height of the sill of * over the water, none inside", "m", Least),
    ("flotation.waterline", "Height of the water over the body axis, none inside", "m", Most),
    ("flotation.trim", "Trim afloat, nose up, no water inside", "°", Size),
    ("flotation.reserve", "Volume of the fuselage over what the mass displaces", "-", Least),
    ("flotation.inside", "Water inside at the end", "m³", Most),
    ("balance_error", "Error of the balance of the fuselage's cuts", "-", Most),
    ("station.*.line_load", "Load of a metre of the keel at * m", "N/m", Most),
    ("station.*.pressure", "Mean pressure on the breadth at * m", "Pa", Most),
    ("station.*.shear", "Shear force in the cut at * m", "N", Size),
    ("station.*.bending", "Bending moment in the cut at * m", "N m", Size),
];

impl Quantity {
    /// Of a name.
    pub fn of(name: &str) -> Quantity {
        let found = TABLE.iter().enumerate().find_map(|(rank, (known, title, unit, worst))| {
            let inner = match known.split_once('*') {
                Some((start, end)) => name.strip_prefix(start)?.strip_suffix(end)?,
                None => (*known == name).then_some("")?,
            };
            Some(Quantity { title: title.replace('*', inner), unit, rank, worst: *worst })
        });
        found.unwrap_or_else(|| Quantity { title: name.into(), unit: "-", rank: TABLE.len(), worst: Size })
    }

    /// True where `value` is worse than `other`.
    pub fn is_worse(&self, value: f64, other: f64) -> bool {
        match self.worst {
            Most => value > other,
            Size => value.abs() > other.abs(),
            Least => value < other,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_have_titles_units_and_a_worst_end() {
        let of = Quantity::of("station.12.5.bending");
        assert_eq!((of.title.as_str(), of.unit), ("Bending moment in the cut at 12.5 m", "N m"));
        let wet = Quantity::of("flotation.aft_exit.wet");
        assert!(wet.is_worse(3.0, 5.0) && of.is_worse(-5.0, 3.0) && wet.title.contains("aft_exit"));
        assert!(Quantity::of("flotation.waterline").is_worse(-0.5, -0.7) && wet.rank < of.rank);
    }
}
