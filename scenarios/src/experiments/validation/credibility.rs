//! The credibility sheet: factors of NASA-STD-7009B with levels that the program argues from its own numbers.

use report::Table;
use run::evidence::{LEAST_POINTS, Nature, Point, Quantity, Statistics};

use super::Line;
use super::drift::states;

/// A factor of the standard: its level, 0 to 4, and why it is neither higher nor lower.
struct Factor {
    name: &'static str,
    level: u8,
    because: String,
    next: &'static str,
}

/// What the levels are argued from.
struct Counts {
    lines: usize,
    holding: usize,
    quantities: usize,
    exact: usize,
    measured: usize,
    measured_cases: usize,
    measured_loads: usize,
    known_reference: usize,
    points: usize,
    within: (usize, usize),
    worst_bias: f64,
    worst_scatter: f64,
    states: usize,
    experiments: Experiments,
}

/// Force, impulse, pressure or strain of a body that enters.
fn is_load_of_entry(point: &Point) -> bool {
    let load = [Quantity::Force, Quantity::Impulse, Quantity::PeakPressure, Quantity::Stress].contains(&point.quantity);
    load && point.setup.speed.is_some()
}

fn counts(lines: &[Line], experiments: Experiments) -> Counts {
    let points: Vec<&Point> = lines.iter().filter_map(|line| line.point.as_ref()).collect();
    let of = |q: Quantity| Statistics::of(&points.iter().copied().filter(|p| p.quantity == q).collect::<Vec<_>>());
    let found: Vec<Statistics> = Quantity::all().filter_map(of).filter(|s| s.points >= LEAST_POINTS).collect();
    let of_nature = |nature| points.iter().filter(|p| p.reference.nature == nature).count();
    let mut cases: Vec<&str> =
        points.iter().filter(|p| p.reference.nature == Nature::Experiment).map(|p| p.case.as_str()).collect();
    cases.sort_unstable();
    cases.dedup();
    let uncertain: Vec<(f64, f64)> =
        points.iter().filter_map(|p| Some(((p.ratio - 1.0).abs(), p.validation_uncertainty()?))).collect();
    Counts {
        lines: lines.iter().filter(|line| line.is_judged()).count(),
        holding: lines.iter().filter(|line| line.holds && line.is_judged()).count(),
        quantities: found.len(),
        exact: of_nature(Nature::Exact),
        measured: of_nature(Nature::Experiment),
        measured_cases: cases.len(),
        measured_loads: points
            .iter()
            .filter(|p| p.reference.nature == Nature::Experiment && is_load_of_entry(p))
            .count(),
        known_reference: points.iter().filter(|p| p.reference.uncertainty.is_some()).count(),
        points: points.len(),
        within: (uncertain.iter().filter(|(error, u)| *error <= 2.0 * u).count(), uncertain.len()),
        worst_bias: found.iter().map(|s| (s.bias - 1.0).abs()).fold(0.0, f64::max),
        worst_scatter: found.iter().filter_map(|s| s.scatter).fold(0.0, f64::max),
        states: states().len(),
        experiments,
    }
}

fn factors(c: &Counts) -> Vec<Factor> {
    let all_hold = c.holding == c.lines;
    let many_measured = c.measured >= 20 && c.measured_cases >= 8;
    let percent = |x: f64| format!("{:.0} %", 100.0 * x);
    vec![
        Factor {
            name: "Data pedigree",
            level: 1,
            because: format!(
                "each of {} references has a source; {} have an uncertainty, most of them 0 of an exact solution or that of a digitiser; the scatter \
                 of tests is known of landings alone",
                c.points, c.known_reference
            ),
            next: "raw measurements with an uncertainty from their authors",
        },
        Factor {
            name: "Verification",
            level: if c.exact >= 50 && c.holding * 100 >= c.lines * 99 { 2 } else { 1 },
            because: format!(
                "{} numbers are compared with exact solutions, {} of {} numbers of all cases hold; tests of each equation run at each change; \
                 numerical errors are charted for {} set-ups",
                c.exact, c.holding, c.lines, c.experiments.charts
            ),
            next: "a review of the code and of the project's own solutions by others",
        },
        Factor {
            name: "Validation",
            level: if many_measured && c.measured_loads >= 5 { 2 } else { 1 },
            because: format!(
                "{} points of {} cases are compared with measurements, {} of them a load on a section that enters water and none of a full-scale \
                 aeroplane; computations include boundary elements of this project; {} quantities have a bias and a scatter, the largest {} and {}",
                c.measured,
                c.measured_cases,
                c.measured_loads,
                c.quantities,
                percent(c.worst_bias),
                percent(c.worst_scatter)
            ),
            next: "measured pressures, accelerations and strains of sections that enter water",
        },
        Factor {
            name: "Input pedigree",
            level: 1,
            because: "inputs are the user's: the program checks units, ranges and plausibility, and keeps the resolved scene beside the results; \
                      it knows no source of a user's number"
                .into(),
            next: "a source and an uncertainty for each key of a scene",
        },
        Factor {
            name: "Uncertainty characterization",
            level: if c.within.1 >= 5 { 2 } else { 1 },
            because: format!(
                "each result has a band for the numerical error or says why not; {} of {} errors are within twice the validation uncertainty \
                 where both parts are known; {} cases test error bars; uncertain inputs are not propagated by the program",
                c.within.0, c.within.1, c.experiments.bands
            ),
            next: "distributions of inputs",
        },
        Factor {
            name: "Results robustness",
            level: 2,
            because: format!(
                "{} maps show where methods fail, tables of many runs show how results follow inputs; the sensitivity of a user's scene is the user's to run",
                c.experiments.maps
            ),
            next: "sensitivities in the report of each run",
        },
        Factor {
            name: "History of use",
            level: 0,
            because: "no use of the program in a decision is known".into(),
            next: "uses that others report",
        },
        Factor {
            name: "Management",
            level: if c.states >= 3 && all_hold { 3 } else { 2 },
            because: format!(
                "versions are controlled, same input gives the same bits, numbers of {} earlier states are kept and compared, and changed numbers \
                 must stand in the changelog; {} of {} numbers hold",
                c.states, c.holding, c.lines
            ),
            next: "a release with a tag and a hash",
        },
    ]
}

/// How many experiments of each kind the program has.
#[derive(Clone, Copy, Debug)]
pub struct Experiments {
    /// Work–precision charts.
    pub charts: usize,
    /// Maps of stability.
    pub maps: usize,
    /// Cases of error bars.
    pub bands: usize,
}

/// The sheet as Markdown.
pub fn page(lines: &[Line], experiments: Experiments) -> String {
    let rows = factors(&counts(lines, experiments))
        .into_iter()
        .map(|f| vec![f.name.to_string(), f.level.to_string(), f.because, f.next.to_string()])
        .collect();
    let sheet = Table::new("", &["factor", "level", "because", "the next level needs"], rows).markdown();
    format!("{sheet}\nLevels are 0 (no evidence) to 4 (NASA-STD-7009B, 2024). The rules stand in `credibility.rs`.\n")
}
