//! Round numbers for axes, colour bars and scale bars.

/// `range` as an axis can show it: finite, increasing, and wide enough to be distinct in f64.
///
/// A reversed range is turned round, a single value gets room on both sides, and a range with a
/// non-finite end becomes [0, 1].
pub(super) fn proper_range([a, b]: [f64; 2]) -> [f64; 2] {
    const LARGEST: f64 = 1e300;
    if !(a.is_finite() && b.is_finite()) {
        return [0.0, 1.0];
    }
    let (low, high) = (a.min(b).max(-LARGEST), a.max(b).min(LARGEST));
    let magnitude = low.abs().max(high.abs());
    if magnitude < 1.0 / LARGEST {
        [-0.5, 0.5]
    } else if high - low < 1e-12 * magnitude {
        [low - 0.5 * magnitude, high + 0.5 * magnitude]
    } else {
        [low, high]
    }
}

/// Smallest of 1, 2, 2.5, 5 times a power of ten that divides `span` into at most `intervals`
/// parts.
pub(super) fn nice_step(span: f64, intervals: usize) -> f64 {
    let least = span / intervals as f64;
    let decade = 10f64.powf(least.log10().floor());
    let multiple = [1.0, 2.0, 2.5, 5.0].into_iter().find(|m| m * decade >= least * (1.0 - 1e-9));
    multiple.unwrap_or(10.0) * decade
}

/// Largest of 1, 2, 5 times a power of ten that is at most `longest`.
pub(super) fn nice_length(longest: f64) -> f64 {
    let decade = 10f64.powf(longest.log10().floor());
    let multiple = [5.0, 2.0].into_iter().find(|m| m * decade <= longest);
    multiple.unwrap_or(1.0) * decade
}

/// The multiples of `step` within `range`.
pub(super) fn ticks([low, high]: [f64; 2], step: f64) -> impl Iterator<Item = f64> {
    const SLACK: f64 = 1e-9;
    let first = (low / step - SLACK).ceil() as i64;
    let last = (high / step + SLACK).floor() as i64;
    (first..=last).map(move |i| i as f64 * step)
}

/// `value` with the decimals that tell ticks `step` apart; an exponent where plain digits would be
/// long.
pub(super) fn tick_label(value: f64, step: f64) -> String {
    if value.abs() < 1e-6 * step {
        return "0".into();
    }
    let mut places = -(step.log10() + 1e-9).floor() as i32;
    let leading = step * 10f64.powi(places);
    if (leading - leading.round()).abs() > 1e-6 {
        places += 1;
    }
    if (-4..=4).contains(&places) {
        format!("{value:.*}", places.max(0) as usize)
    } else {
        let digits = value.abs().log10().floor() as i32 + places;
        let text = format!("{value:.*e}", digits.max(0) as usize);
        match text.split_once('e') {
            Some((mantissa, exponent)) if mantissa.contains('.') => {
                format!("{}e{exponent}", mantissa.trim_end_matches('0').trim_end_matches('.'))
            }
            _ => text,
        }
    }
}

/// A number with an exponent as people write it: `1.25e-7` as 1.25·10⁻⁷.
pub(super) fn powers(label: &str) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raised = |c: char| c.to_digit(10).map_or('⁻', |digit| DIGITS[digit as usize]);
    let minus = |text: &str| text.replace('-', "\u{2212}");
    match label.split_once('e') {
        Some(("1", power)) => format!("10{}", power.chars().map(raised).collect::<String>()),
        Some((mantissa, power)) => format!("{}·10{}", minus(mantissa), power.chars().map(raised).collect::<String>()),
        None => minus(label),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_round_and_few() {
        for span in [1e-30, 0.013, 0.2, 1.0, 7.0, 10.0, 12.5, 99.0, 3e44] {
            let step = nice_step(span, 5);
            assert!(span / step <= 5.0 + 1e-6 && span / step >= 2.0 - 1e-6, "{span} / {step}");
        }
        assert_eq!(nice_step(10.0, 5), 2.0);
        assert_eq!(nice_length(0.73), 0.5);
        assert_eq!(nice_length(19.0), 10.0);
    }

    #[test]
    fn labels_tell_neighbours_apart() {
        assert_eq!(tick_label(0.30000000000000004, 0.1), "0.3");
        assert_eq!(tick_label(-0.25, 0.25), "-0.25");
        assert_eq!(tick_label(2500.0, 500.0), "2500");
        assert_eq!(tick_label(1.25e7, 2.5e6), "1.25e7");
        assert_eq!(tick_label(3e-7, 1e-7), "3e-7");
        assert_eq!(tick_label(1e-4, 2e-5), "1e-4");
        assert_eq!(tick_label(-1e-18, 0.1), "0");
    }

    #[test]
    fn exponents_are_raised() {
        let written = ["1.25e7", "1e-4", "-3e-7", "-0.5"].map(powers);
        assert_eq!(written, ["1.25·10⁷", "10⁻⁴", "−3·10⁻⁷", "−0.5"]);
    }

    #[test]
    fn any_range_becomes_drawable() {
        let ranges = [[0.0, 0.0], [3.0, 3.0], [1e15, 1e15], [f64::NAN, 1.0], [2.0, -1.0]];
        for range in ranges.into_iter().chain([[-f64::MAX, f64::MAX], [5e-324, 0.0]]) {
            let [low, high] = proper_range(range);
            let step = nice_step(high - low, 5);
            let count = ticks([low, high], step).count();
            assert!(low < high && (2..=6).contains(&count), "{range:?} -> [{low}, {high}], {count} ticks");
        }
    }
}
