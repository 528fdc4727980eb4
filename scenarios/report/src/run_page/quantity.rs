//! Numbers as an engineer writes them: a title in words, a unit with its prefix, three digits.

use crate::ticks::powers;

/// A unit to show numbers in.
#[derive(Clone, Debug, PartialEq)]
pub struct Unit {
    /// The unit with its prefix, such as kN/m.
    pub name: String,
    /// Factor from SI.
    pub scale: f64,
}

impl Unit {
    /// The unit for numbers up to `largest` in magnitude, in SI units of `si`.
    pub fn of(si: &str, largest: f64) -> Unit {
        let prefixes: &[(&str, f64)] = match si {
            "N/m" | "Pa" | "Pa s" | "N" | "N m" | "N m/m" | "J/m" | "N s/m" => &[("M", 1e-6), ("k", 1e-3), ("", 1.0)],
            "s" => &[("", 1.0), ("m", 1e3)],
            "m" => &[("", 1.0), ("m", 1e3)],
            _ => &[("", 1.0)],
        };
        let least = match si {
            "s" => 2.0,
            "m" => 0.2,
            _ => 1.0,
        };
        let fits = |(_, scale): &&(&str, f64)| largest.abs() * scale >= least;
        let (prefix, scale) = prefixes.iter().find(fits).unwrap_or(&prefixes[prefixes.len() - 1]);
        Unit { name: format!("{prefix}{si}"), scale: *scale }
    }
}

/// Three digits, such as 26.8, 0.0123, 1 240.
pub fn digits(value: f64) -> String {
    if !value.is_finite() {
        return "–".into();
    }
    let size = value.abs();
    if size == 0.0 {
        return "0".into();
    }
    let minus = |text: String| text.replace('-', "\u{2212}");
    // the third digit decides, also where rounding carries into a fourth
    let exponent = format!("{size:.2e}").split_once('e').and_then(|(_, e)| e.parse::<i32>().ok()).unwrap_or(0);
    match exponent {
        -3..=2 => minus(format!("{value:.*}", (2 - exponent) as usize)),
        3..=5 => {
            let rounded = 10f64.powi(exponent - 2) * (value / 10f64.powi(exponent - 2)).round();
            let (whole, text) = (rounded.abs() as u64, rounded < 0.0);
            let sign = if text { "\u{2212}" } else { "" };
            format!("{sign}{}\u{202f}{:03}", whole / 1000, whole % 1000)
        }
        _ => powers(&format!("{value:.2e}")),
    }
}

/// Five digits, for numbers with a narrow band; other magnitudes as [`digits`].
pub(crate) fn five_digits(value: f64) -> String {
    let exponent = value.abs().log10().floor();
    match (-3.0..6.0).contains(&exponent) {
        true => format!("{value:.*}", (4.0 - exponent).max(0.0) as usize).replace('-', "\u{2212}"),
        false => digits(value),
    }
}

/// A share with its sign, in percent.
pub(crate) fn percent(share: f64) -> String {
    let size = 100.0 * share.abs();
    let places = if size < 0.095 { 2 } else { usize::from(size < 9.95) };
    let text = format!("{:.places$} %", 100.0 * share);
    text.replace('-', "\u{2212}").replacen("\u{2212}0.00 %", "0.00 %", 1)
}

/// A number of SI units `si` with its own prefix.
pub fn with_unit(value: f64, si: &str) -> String {
    let unit = Unit::of(si, value);
    let space = if unit.name == "-" || unit.name.is_empty() { "" } else { "\u{a0}" };
    let name = if unit.name == "-" { String::new() } else { unit.name.replace(' ', "\u{a0}") };
    format!("{}{space}{name}", digits(unit.scale * value))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits_and_a_prefix() {
        let forces = [26_830.3, 1.24e9, -0.5].map(|force| with_unit(force, "N/m"));
        assert_eq!(forces, ["26.8\u{a0}kN/m", "1\u{202f}240\u{a0}MN/m", "−0.500\u{a0}N/m"]);
        assert_eq!(with_unit(0.014842, "s"), "14.8\u{a0}ms");
        assert_eq!(with_unit(2.914e8, "Pa"), "291\u{a0}MPa");
        assert_eq!(with_unit(0.85926, "-"), "0.859");
        assert_eq!([digits(f64::NAN), digits(0.0), digits(1.234e-7)], ["–", "0", "1.23·10⁻⁷"]);
    }

    #[test]
    fn shares_and_long_numbers_are_written_alike() {
        assert_eq!([0.4225, -0.0008, 0.153, -1e-9].map(percent), ["42 %", "−0.08 %", "15 %", "0.00 %"]);
        assert_eq!([6.894_76, -13_292.5, 1.4e-15].map(five_digits), ["6.8948", "−13292", "1.40·10⁻¹⁵"]);
    }
}
