//! Inputs at random: texts with values, lines and letters changed.

use sph_core::SplitMix64;

/// A generator of numbers: the same seed gives the same inputs.
pub struct Random(SplitMix64);

impl Random {
    pub fn new(seed: u64) -> Random {
        Random(SplitMix64(SplitMix64(seed).bits())) // neighbouring seeds far apart
    }

    /// A number below `count`, which is not 0.
    pub fn below(&mut self, count: usize) -> usize {
        (self.0.bits() % count as u64) as usize
    }

    /// True in one of `count` cases.
    pub fn one_in(&mut self, count: usize) -> bool {
        self.below(count) == 0
    }

    pub fn unit(&mut self) -> f64 {
        self.0.unit()
    }

    pub fn pick<'a, T>(&mut self, items: &'a [T]) -> &'a T {
        &items[self.below(items.len())]
    }
}

/// Values that break things.
const VALUES: &[&str] = &[
    "0",
    "-0",
    "0.0",
    "-0.0",
    "1",
    "-1",
    "2",
    "1e-300",
    "-1e-300",
    "5e-324",
    "1e300",
    "-1e300",
    "1e12",
    "-1e12",
    "1e-12",
    "1e11",
    "1e6",
    "1e-6",
    "nan",
    "-nan",
    "inf",
    "-inf",
    "1e400",
    "9223372036854775807",
    "-9223372036854775808",
    "9223372036854775808",
    "18446744073709551615",
    "4294967296",
    "2147483648",
    "1000000000",
    "99999999999999999999999999",
    "0x7fffffffffffffff",
    "\"\"",
    "\" \"",
    "\"auto\"",
    "auto",
    "\"nan\"",
    "\"ünï 水 🌊\"",
    "\"\\u0000\"",
    "\"../../etc/passwd\"",
    "\"a/b\"",
    "''",
    "'''\n\n'''",
    "true",
    "false",
    "[]",
    "{}",
    "[[]]",
    "[0.0, 0.0]",
    "[0, 0]",
    "[nan, inf]",
    "[1e300, -1e300]",
    "[1e12, -1e12]",
    "[0.0]",
    "[0.0, 0.0, 0.0]",
    "[-1.0, 1.0]",
    "[[0.0, 0.0], [0.0, 0.0]]",
    "[[0.0, 0.0], [0.0, 0.0], [0.0, 0.0]]",
    "[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]",
    "[\"x\", \"x\"]",
    "[\"x\", \"y\", \"angle\"]",
    "[\"\"]",
    "[true]",
    "1979-05-27T07:32:00Z",
    "{ a = 1 }",
    "[{}]",
    "[{}, {}]",
    "",
    "=",
    "\"unclosed",
    "[",
    "wendland_c4",
];

/// A value of any kind.
pub fn value(random: &mut Random) -> String {
    match random.below(12) {
        0 => format!("{:?}", (random.unit() - 0.3) * 10f64.powi(random.below(16) as i32 - 8)),
        1 => format!("{}", random.below(40) as i64 - 5),
        2 => format!("[{}, {}]", value(random), value(random)),
        3 => format!("{:?}", random.unit() * 3.0),
        4 if random.one_in(20) => deep(random),
        _ => random.pick(VALUES).to_string(),
    }
}

/// A value of the kind that a key takes, in its documentation's words.
pub fn plausible(random: &mut Random, takes: &str) -> String {
    if takes.contains(" | ") {
        let words: Vec<&str> = takes.split(" | ").collect();
        return random.pick(&words).to_string();
    }
    if takes.contains("length 2") || takes.contains("two numbers") {
        return format!("[{:?}, {:?}]", number(random), number(random));
    }
    if takes.contains("whole number") {
        return format!("{}", random.below(40));
    }
    match takes {
        "true or false" => random.pick(&["true", "false"]).to_string(),
        _ if takes.contains("number") => format!("{:?}", number(random)),
        _ => value(random),
    }
}

/// A number from 0.0003 to 300, or the negative of one.
fn number(random: &mut Random) -> f64 {
    let size = 10f64.powf(random.unit() * 6.0 - 3.5);
    if random.one_in(5) { -size } else { size }
}

/// A value that is long or deep.
fn deep(random: &mut Random) -> String {
    let count = *random.pick(&[50, 200, 3_000, 20_000]);
    match random.below(6) {
        0 => "[".repeat(count) + &"]".repeat(count),
        1 => "{ a = ".repeat(count) + "1" + &" }".repeat(count),
        2 => format!("\"{}\"", "ü".repeat(count)),
        3 => "9".repeat(count),
        4 => format!("[{}]", "0.5, ".repeat(count)),
        _ => format!("[{}]", "[0.5, 0.5], ".repeat(count)),
    }
}

/// Another number near or far from one that is written.
fn number_like(random: &mut Random, given: &str) -> String {
    let number: f64 = given.parse().unwrap_or(1.0);
    match random.below(5) {
        0 => random.pick(VALUES).to_string(),
        1 => format!("{:?}", -number),
        2 => format!("{:?}", number * 10f64.powi(random.below(12) as i32 - 6)),
        3 => format!("{}", number.round() as i64 + random.below(5) as i64 - 2),
        _ => format!("{:?}", number * (0.5 + random.unit())),
    }
}

/// The text with one thing changed; `others` lend lines.
pub fn text(random: &mut Random, given: &str, others: &[String]) -> String {
    let mut lines: Vec<String> = given.lines().map(str::to_string).collect();
    if lines.is_empty() {
        return value(random);
    }
    let at = random.below(lines.len());
    match random.below(14) {
        0..=2 => {
            if let Some(key) = lines[at].split_once('=').map(|(key, _)| key.to_string()) {
                lines[at] = format!("{key}= {}", value(random));
            }
        }
        3..=6 => lines[at] = with_number(random, &lines[at]),
        7 => {
            lines.remove(at);
        }
        8 => lines.insert(at, lines[at].clone()),
        9 => {
            let to = random.below(lines.len());
            lines.swap(at, to);
        }
        10 | 11 => {
            let other: Vec<&str> = random.pick(others).lines().collect();
            if !other.is_empty() {
                lines.insert(at, random.pick(&other).to_string());
            }
        }
        12 => lines[at] = with_letter(random, &lines[at]),
        _ if random.one_in(8) => lines[at] = format!("{} {}", lines[at], deep(random)),
        _ => {
            let dots = if random.one_in(10) { "a.".repeat(*random.pick(&[90, 5_000])) } else { String::new() };
            lines
                .insert(at, format!("{dots}{} = {}", random.pick(&["x", "name", "body", "\"\"", "at"]), value(random)));
        }
    }
    lines.join("\n") + "\n"
}

/// The line with one of its numbers changed.
fn with_number(random: &mut Random, line: &str) -> String {
    let in_number = |c: char| c.is_ascii_digit() || "+-.eE".contains(c);
    let mut spans = Vec::new();
    let mut start = None;
    for (k, c) in line.char_indices().chain([(line.len(), ' ')]) {
        match (start, in_number(c)) {
            (None, true) => start = Some(k),
            (Some(from), false) => {
                if line[from..k].parse::<f64>().is_ok() {
                    spans.push(from..k);
                }
                start = None;
            }
            _ => {}
        }
    }
    if spans.is_empty() {
        return line.to_string();
    }
    let span = random.pick(&spans).clone();
    format!("{}{}{}", &line[..span.start], number_like(random, &line[span.clone()]), &line[span.end..])
}

/// The line with a letter changed, added or taken away.
fn with_letter(random: &mut Random, line: &str) -> String {
    let mut letters: Vec<char> = line.chars().collect();
    let strange =
        ['\0', '\u{feff}', 'é', '水', '"', '[', ']', '{', '=', '.', ',', '#', '\\', '\r', '-', '9', ' ', '\u{202e}'];
    let at = random.below(letters.len() + 1);
    match random.below(3) {
        0 if at < letters.len() => letters[at] = *random.pick(&strange),
        1 if at < letters.len() => {
            letters.remove(at);
        }
        _ => letters.insert(at, *random.pick(&strange)),
    }
    letters.into_iter().collect()
}
