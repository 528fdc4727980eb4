//! Numbers in the fields of a card.

/// Columns of a field of the large format.
pub(super) const LARGE: usize = 16;
/// Largest number that is read.
const LARGEST: f64 = 1e30;
/// Most significant digits of a number of double precision that are written.
const DIGITS: usize = 17;

/// A real number as Nastran writes it: `1.`, `-.5`, `1.0E+5`, `1.0D+5`, `1.0+5`; `None` for anything else, whole numbers too.
pub(super) fn real(text: &str) -> Option<f64> {
    let text = text.to_ascii_uppercase().replace('D', "E");
    let (mantissa, exponent) = match text.find('E') {
        Some(at) => (&text[..at], &text[at + 1..]),
        // a sign within the number starts the exponent
        None => match text.char_indices().skip(1).find(|(_, c)| matches!(c, '+' | '-')) {
            Some((at, _)) => (&text[..at], &text[at..]),
            None => (&text[..], "0"),
        },
    };
    let plain = |part: &str, point: bool| {
        let digits = part.strip_prefix(['+', '-']).unwrap_or(part);
        digits.contains(|c: char| c.is_ascii_digit()) && digits.chars().all(|c| c.is_ascii_digit() || point && c == '.')
    };
    if !mantissa.contains('.') || !plain(mantissa, true) || !plain(exponent, false) {
        return None;
    }
    let value: f64 = format!("{mantissa}E{exponent}").parse().ok()?;
    (value.is_finite() && value.abs() <= LARGEST).then_some(value)
}

/// A whole number.
pub(super) fn whole(text: &str) -> Option<i64> {
    let digits = text.strip_prefix(['+', '-']).unwrap_or(text);
    (!digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit())).then(|| text.parse().ok()).flatten()
}

/// A real number in at most 16 columns, with as many digits as they hold; what is read from it is written the same again.
pub(super) fn large(value: f64) -> String {
    if value == 0.0 {
        return "0.".into();
    }
    let shortest = format!("{value:e}");
    let rounded = (0..DIGITS).rev().map(|digits| format!("{value:.digits$e}"));
    let fitting = std::iter::once(shortest).chain(rounded).filter_map(|text| layout(&text)).next();
    fitting.unwrap_or_else(|| "0.".into())
}

/// A number `-1.25e-7` in at most 16 columns: plain, with an exponent, or with an exponent without its letter.
fn layout(text: &str) -> Option<String> {
    let (mantissa, exponent) = text.split_once('e')?;
    let exponent: i32 = exponent.parse().ok()?;
    let (sign, mantissa) = mantissa.strip_prefix('-').map_or(("", mantissa), |rest| ("-", rest));
    let (first, rest) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let rest = rest.trim_end_matches('0');
    let digits = format!("{first}{rest}");
    let plain = match exponent {
        0.. => {
            let exponent = exponent as usize;
            let whole: String = digits.chars().chain(std::iter::repeat('0')).take(exponent + 1).collect();
            format!("{sign}{whole}.{}", digits.get(exponent + 1..).unwrap_or(""))
        }
        _ => format!("{sign}.{}{digits}", "0".repeat((-1 - exponent) as usize)),
    };
    let lettered = format!("{sign}{first}.{rest}E{exponent:+}");
    let signed = format!("{sign}{first}.{rest}{exponent:+}");
    [plain, lettered, signed].into_iter().find(|text| text.len() <= LARGE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_as_nastran_writes_them() {
        for (text, value) in [
            ("1.", 1.0),
            (".5", 0.5),
            ("-1.25", -1.25),
            ("7.E+10", 7e10),
            ("7.0+10", 7e10),
            ("-7.0-3", -7e-3),
            ("1.5D-3", 1.5e-3),
            ("+2.0e3", 2e3),
        ] {
            assert_eq!(real(text), Some(value), "{text}");
        }
        for text in ["", "1", "a", "1.2.3", "1.0E", "nan", "inf", "1.0 2", "--1.", ".", "1.0E+400", "1.0+"] {
            assert_eq!(real(text), None, "{text}");
        }
        assert_eq!([whole("12"), whole("-3"), whole("1."), whole("")], [Some(12), Some(-3), None, None]);
        assert_eq!(whole("99999999999999999999"), None);
    }

    #[test]
    fn what_is_written_is_read_to_the_last_digit_and_written_the_same() {
        let mut seed = 1_u64;
        for k in 0..20_000 {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let share = (seed >> 11) as f64 / (1_u64 << 53) as f64 - 0.5;
            let value = share * 10_f64.powi(k % 61 - 30);
            let text = large(value);
            assert!(text.len() <= LARGE, "{text}");
            let found = real(&text).unwrap_or_else(|| panic!("{text}"));
            assert!((found / value - 1.0).abs() < 5e-11, "{value} {text}");
            assert_eq!(large(found), text);
        }
        for value in [0.0015, 70e9, 2700.0, 2.25e-9, 1.0 / 3.0, -0.25, 100.0] {
            assert!((real(&large(value)).expect("a number") / value - 1.0).abs() < 1e-13, "{}", large(value));
        }
        assert_eq!([large(0.0015), large(-2.0), large(7e10)], [".0015", "-2.", "70000000000."]);
    }
}
