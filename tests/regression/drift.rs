//! Numbers of short validation cases against the table of the last complete run: one that changed must stand in the changelog.

use std::fs;
use std::path::Path;

use scenarios::experiments::validation::drift::{Changed, State, states};
use scenarios::experiments::validation::{CASES, validate};

/// Cases of a few seconds: weakly compressible, incompressible, a panel, a landing.
const SHORT: [&str; 4] = ["flat_bottom", "projection_column_of_16", "hydrostatic_plate", "landing_xp2v"];

/// Numbers that differ by less have not changed: other machines have other last digits [-].
const CHANGED: f64 = 1e-3;

fn text(path: &str) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the workspace");
    fs::read_to_string(root.join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

#[test]
fn a_number_that_changed_stands_in_the_changelog() {
    let (stored, changelog) = (State::read(&text("docs/src/validation/cases.md")), text("CHANGELOG.md"));
    let cases = CASES.select(&SHORT.map(String::from)).expect("built-in cases");
    let lines: Vec<_> = cases.iter().flat_map(|case| validate(case, None).expect("a run")).collect();
    let now = State::now(&lines);
    assert_eq!(
        stored.count(&SHORT),
        now.count(&SHORT),
        "docs/src/validation/cases.md has other rows: run `splashdown validate --all --table`"
    );
    for Changed { case, quantity, values: [then, now] } in now.changed(&stored) {
        let moved = (now - then).abs() > CHANGED * then.abs() && !quantity.starts_with("audit/");
        assert!(
            !moved || changelog.contains(&format!("`{case}`")),
            "{case}: {quantity} was {then} and is {now}: name the case in CHANGELOG.md, with the reason, and run `splashdown validate --all --table`"
        );
    }
}

/// The same for all cases, between the page and the last stored state.
#[test]
fn numbers_that_changed_since_the_last_state_stand_in_the_changelog() {
    let (now, changelog) = (State::read(&text("docs/src/validation/cases.md")), text("CHANGELOG.md"));
    let stored = states();
    let last = stored.last().expect("a state");
    for Changed { case, quantity, values: [then, now] } in now.changed(last) {
        let moved = (now - then).abs() > CHANGED * then.abs() && !quantity.starts_with("audit/");
        assert!(!moved || changelog.contains(&format!("`{case}`")), "{case}: {quantity} was {then} and is {now}");
    }
}
