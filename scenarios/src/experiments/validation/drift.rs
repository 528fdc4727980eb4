//! Drift: the numbers of `validate` in this and in earlier states of the program.
//!
//! A state is a table that `splashdown validate --all --table` wrote; its first heading names it: `# Validation, 0c470806 of 2026-11-27`.
//! Stored states lie in `scenarios/cases/states`.

use include_dir::{Dir, include_dir};
use report::Table;

use super::{Line, number};

static STATES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/cases/states");

/// Numbers that differ by less are the same: tables have six digits [-].
const SAME: f64 = 2e-5;
/// Changes of the deviation from the reference, or of the number, from which a number is listed [-].
const LISTED: f64 = 1e-3;

/// Which number: case, quantity, its reference, and which of several such.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Key {
    case: String,
    quantity: String,
    reference: String,
    k: usize,
}

/// The numbers of a state.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Its name: commit and date.
    pub name: String,
    numbers: Vec<(Key, f64)>,
}

/// A number that two states have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Changed<'s> {
    /// Its case.
    pub case: &'s str,
    /// Its quantity.
    pub quantity: &'s str,
    /// Its value in the earlier state and in this one.
    pub values: [f64; 2],
}

impl State {
    /// Of a table in Markdown.
    pub fn read(markdown: &str) -> State {
        let name =
            markdown.lines().next().unwrap_or_default().trim_start_matches("# Validation").trim_start_matches(", ");
        let mut state = State { name: name.into(), numbers: Vec::new() };
        for line in markdown.lines().filter(|line| line.starts_with("| ")) {
            let cells: Vec<&str> = line.split('|').map(str::trim).collect();
            if let [_, case, quantity, ours, reference, ..] = cells[..]
                && let Ok(value) = ours.parse()
            {
                state.push([case, quantity, reference], value);
            }
        }
        state
    }

    /// Of lines that were run now, to the digits of a table.
    pub fn now(lines: &[Line]) -> State {
        let mut state = State { name: "now".into(), numbers: Vec::new() };
        for line in lines {
            state.push([&line.case, &line.quantity, &line.theirs], number(line.ours).parse().unwrap_or(f64::NAN));
        }
        state
    }

    /// How many numbers the cases of these names have.
    pub fn count(&self, cases: &[&str]) -> usize {
        self.numbers.iter().filter(|(key, _)| cases.contains(&key.case.as_str())).count()
    }

    fn push(&mut self, [case, quantity, reference]: [&str; 3], value: f64) {
        let mut key = Key { case: case.into(), quantity: quantity.into(), reference: reference.into(), k: 0 };
        while self.get(&key).is_some() {
            key.k += 1;
        }
        self.numbers.push((key, value));
    }

    fn get(&self, key: &Key) -> Option<f64> {
        self.numbers.iter().find(|(known, _)| known == key).map(|row| row.1)
    }

    /// The numbers of both states that differ. Residues that are 0 to rounding do not count.
    pub fn changed<'s>(&'s self, earlier: &State) -> Vec<Changed<'s>> {
        let differs = |a: f64, b: f64| (a - b).abs() > SAME * a.abs().max(b.abs()) && a.abs().max(b.abs()) > 1e-9;
        let pair = |(key, ours): &'s (Key, f64)| {
            let theirs = earlier.get(key)?;
            let changed = Changed { case: &key.case, quantity: &key.quantity, values: [theirs, *ours] };
            differs(theirs, *ours).then_some(changed)
        };
        self.numbers.iter().filter_map(pair).collect()
    }
}

/// The stored states, the oldest first.
pub fn states() -> Vec<State> {
    let mut files: Vec<_> = STATES.files().collect();
    files.sort_by_key(|file| file.path());
    files.into_iter().filter_map(|file| file.contents_utf8()).map(State::read).collect()
}

/// The table as Markdown: numbers with a reference whose deviation changed by a thousandth or more between any two states.
pub fn page(lines: &[Line]) -> String {
    let (now, stored) = (State::now(lines), states());
    let mut rows = Vec::new();
    let (mut known, mut same) = (0, 0);
    for (line, (key, ours)) in lines.iter().zip(&now.numbers) {
        let Some(reference) = line.theirs.parse::<f64>().ok().filter(|r| *r != 0.0) else { continue };
        let values: Vec<Option<f64>> = stored.iter().map(|state| state.get(key)).collect();
        let all: Vec<f64> = values.iter().flatten().copied().chain([*ours]).collect();
        known += usize::from(all.len() > 1);
        let [low, high] = [f64::min, f64::max].map(|pick| all.iter().copied().reduce(pick).unwrap_or_default());
        if (high - low) / reference.abs() < LISTED {
            same += usize::from(all.len() > 1);
            continue;
        }
        let of =
            |value: Option<f64>| value.map_or("–".into(), |v| format!("{:+.2} %", 100.0 * (v / reference - 1.0)));
        let mut row = vec![key.case.clone(), key.quantity.clone(), key.reference.clone()];
        row.extend(values.into_iter().chain([Some(*ours)]).map(of));
        rows.push(row);
    }
    let mut head = vec!["case", "quantity", "reference"];
    head.extend(stored.iter().map(|state| state.name.as_str()));
    head.push("now");
    format!(
        "Of {known} numbers with a reference that an earlier state has too, {same} changed by less than 0.1 % of the reference. The others, as \
         deviations from the reference:\n\n{}",
        Table::new("", &head, rows).markdown()
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_changed_number_is_found_among_numbers_of_one_name() {
        let table = |second: &str| {
            State::read(&format!(
                "# Validation, a of b\n\n| case | quantity | ours | reference |\n|---|---|---|---|\n| w | f | 1.5 | 2 |\n| w | f | {second} | 2 |\n"
            ))
        };
        let (one, other) = (table("2.5"), table("2.501"));
        assert_eq!((one.name.as_str(), one.numbers.len()), ("a of b", 2));
        assert_eq!(other.changed(&one), [Changed { case: "w", quantity: "f", values: [2.5, 2.501] }]);
        assert!(one.changed(&one).is_empty());
    }

    #[test]
    fn stored_states_are_read() {
        let states = states();
        assert!(
            states.len() >= 3 && states.iter().all(|state| state.numbers.len() > 100 && state.name.contains(" of "))
        );
    }
}
