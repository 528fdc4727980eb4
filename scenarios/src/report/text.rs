//! Lettering for the pictures: a plain stroke alphabet, drawn with round pens like a drawing-office
//! stencil.

use super::canvas::Canvas;
use super::colour::INK;

/// Height of capitals and digits in units of the alphabet.
pub(super) const CAP_HEIGHT: f64 = 6.0;

/// Blank between two letters \[units\].
const GAP: f64 = 2.0;
const PEN: f64 = 0.95;

/// Which point of the text is placed.
#[derive(Clone, Copy)]
pub(super) enum Anchor {
    Start,
    Middle,
}

/// Width of `text` \[pixels\] at `unit` pixels per unit of the alphabet.
pub(super) fn text_width(text: &str, unit: f64) -> f64 {
    (text.chars().map(advance).sum::<f64>() - GAP).max(0.0) * unit
}

/// Writes `text` on the baseline through `at`, capitals being `CAP_HEIGHT` times `unit` pixels
/// high.
pub(super) fn write(canvas: &mut Canvas, text: &str, at: [f64; 2], anchor: Anchor, unit: f64) {
    let mut x = match anchor {
        Anchor::Start => at[0],
        Anchor::Middle => at[0] - 0.5 * text_width(text, unit),
    };
    let top = at[1] - CAP_HEIGHT * unit;
    for letter in text.chars() {
        for stroke in strokes(letter).split(' ') {
            let place = |p: [u8; 2]| [x + f64::from(p[0]) * unit, top + f64::from(p[1]) * unit];
            let mut from = None;
            for to in points(stroke).map(place) {
                if let Some(from) = from.replace(to) {
                    canvas.stroke(from, to, PEN * unit, INK);
                }
            }
        }
        x += advance(letter) * unit;
    }
}

fn advance(letter: char) -> f64 {
    let right = strokes(letter).split(' ').flat_map(points).map(|p| p[0]).max();
    GAP + right.map_or(1.0, f64::from)
}

fn points(stroke: &str) -> impl Iterator<Item = [u8; 2]> {
    stroke.as_bytes().chunks_exact(2).map(|p| [p[0] - b'0', p[1] - b'0'])
}

/// The pen strokes of a letter: runs of points, each a digit for x (0 left) and one for y (0 top, 6
/// baseline, 8 lowest).
#[rustfmt::skip]
fn strokes(letter: char) -> &'static str {
    match letter {
        ' ' => "",
        'A' => "062046 1434",
        'B' => "00063645443303 3342413000",
        'C' => "4130100105163645",
        'D' => "00062645412000",
        'E' => "40000646 0333",
        'F' => "400006 0333",
        'G' => "41301001051636454323",
        'H' => "0006 4046 0343",
        'I' => "0020 1016 0626",
        'J' => "3035261605",
        'K' => "0006 4003 1246",
        'L' => "000646",
        'M' => "0600234046",
        'N' => "06004640",
        'O' | '0' => "103041453616050110",
        'P' => "06003041423303",
        'Q' => "103041453616050110 2446",
        'R' => "06003041423303 2346",
        'S' => "413010010213334445361605",
        'T' => "0040 2026",
        'U' => "000516364540",
        'V' => "002640",
        'W' => "0016223640",
        'X' => "0046 4006",
        'Y' => "002340 2326",
        'Z' => "00400646",
        'a' => "3236 3322120305162635",
        'b' => "0006 0312223335261605",
        'c' => "3322120305162635",
        'd' => "3036 3322120305162635",
        'e' => "04343322120305162635",
        'f' => "30201116 0232",
        'g' => "3237281807 3322120305162635",
        'h' => "0006 0312223336",
        'i' => "0000 0206",
        'j' => "1010 121708",
        'k' => "0006 3204 1336",
        'l' => "000516",
        'm' => "0206 03122326 23324346",
        'n' => "0206 0312223336",
        'o' => "122233352616050312",
        'p' => "0208 0312223335261605",
        'q' => "3238 3322120305162635",
        'r' => "0206 031222",
        's' => "3212031424352606",
        't' => "10152636 0232",
        'u' => "0205162635 3236",
        'v' => "022642",
        'w' => "0216233642",
        'x' => "0236 3206",
        'y' => "0226 4218",
        'z' => "02320636",
        '1' => "112026 1636",
        '2' => "01103041420646",
        '3' => "01103041423323 334445361605",
        '4' => "36300444",
        '5' => "400002324345361605",
        '6' => "4130100105163645443303",
        '7' => "004016",
        '8' => "103041423313020110 1304051636454433",
        '9' => "0516364541301001021343",
        '.' => "0606",
        ',' => "1607",
        ':' => "0303 0606",
        ';' => "1313 1607",
        '-' | '–' | '—' => "0333",
        '−' => "0343",
        '+' => "0343 2125",
        '=' => "0242 0444",
        '±' => "0242 2024 0646",
        '×' => "1135 1531",
        '·' => "0404",
        '/' => "0630",
        '\\' => "0036",
        '|' => "0007",
        '_' => "0747",
        '(' => "10020517",
        ')' => "00121507",
        '[' => "10000717",
        ']' => "00101707",
        '{' => "20111203141526",
        '}' => "00111223141506",
        '<' => "310335",
        '>' => "013305",
        '%' => "0640 0010110100 3545463635",
        '*' => "1133 3113 2024",
        '#' => "1016 3036 0242 0444",
        '\'' => "0001",
        '"' => "0001 2021",
        '`' => "0011",
        '^' => "022042",
        '~' => "04133443",
        '!' => "0004 0606",
        '?' => "011030414224 2626",
        '&' => "4602011020310405162644",
        '@' => "453616050110304144242242",
        '$' => "413010010213334445361605 2026",
        '°' => "1021120110",
        '²' => "0020210323",
        '³' => "002011221303",
        'µ' | 'μ' => "0208 05162635 3236",
        'ρ' => "080312223335261605",
        'π' => "0242 1216 3236",
        'Δ' => "20064620",
        _ => "0040460600",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_stroke_is_whole_points_on_the_grid() {
        for letter in (' '..='~').chain("°²³±×µρπΔ−–·".chars()).chain(['\u{1f30a}']) {
            for stroke in strokes(letter).split(' ') {
                assert!(stroke.len().is_multiple_of(2), "{letter:?}: {stroke}");
                assert!(points(stroke).all(|[x, y]| x <= 4 && y <= 8), "{letter:?}: {stroke}");
            }
        }
    }

    #[test]
    fn printable_ascii_has_letters_of_its_own() {
        let unknown = strokes('\u{1f30a}');
        assert!((' '..='~').all(|letter| strokes(letter) != unknown));
    }
}
