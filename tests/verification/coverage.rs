//! Error bars of convergence studies against exact values. The whole table: `splashdown bands --all`.

use scenarios::experiments::coverage::{CASES, Line, cover};

/// Nine of ten bars hold the exact value.
#[test]
fn bars_of_coarse_studies_hold_exact_values() {
    let names = ["wedge_30_coarse", "wedge_45_coarse", "still_water_coarse"].map(String::from);
    let cases = CASES.select(&names).expect("they are there");
    let lines: Vec<_> = cases.iter().flat_map(|case| cover(case).expect("it runs")).collect();
    let lost: Vec<String> = lines
        .iter()
        .filter(|l| !l.holds)
        .map(|l| format!("{} {}: {} outside {} ± {}", l.case, l.path, l.exact, l.bar.middle(), l.bar.band))
        .collect();
    assert!(lines.len() >= 8, "{} bars", lines.len());
    assert!(10 * lost.len() <= lines.len(), "{} of {}: {}", lost.len(), lines.len(), lost.join("; "));
    // a bar as wide as the number itself would hold anything
    let share = |l: &Line| (l.bar.band / l.exact).abs();
    let mut shares: Vec<f64> = lines.iter().map(share).collect();
    shares.sort_by(f64::total_cmp);
    assert!(shares[shares.len() / 2] < 0.10, "bands: {shares:?}");
}
