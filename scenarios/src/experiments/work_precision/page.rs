//! A chart as SVG, as a page and as tables.

use report::{Block, Chart, Curve, Mark, Report, Status, Table, TrendLine, chart_svg, render};

use super::case::{Quantity, Reading, as_set};
use super::measured::{Measured, Outcome, Seen, Trend};
use super::peers::{Peer, PeerPoint, peers};
use crate::experiments::ExperimentError;

const HEAD: [&str; 9] =
    ["family", "at", "value", "bias [%]", "scatter [%]", "error [%]", "particles", "steps", "core-s"];
const TREND_HEAD: [&str; 5] =
    ["family", "error at 1 core-s [%]", "power of the cost", "scatter about it [%]", "verdict"];
/// Errors below this are drawn at it [%]: references are known to some four digits.
const LEAST_DRAWN: f64 = 0.01;

/// Error against cost of one quantity, both logarithmic, with the Pareto front.
pub fn svg(measured: &Measured, quantity: &Quantity) -> Result<String, ExperimentError> {
    Ok(chart_svg(&chart(measured, quantity, &peers(&measured.case.name)?)))
}

/// The charts with their tables.
pub fn page(measured: &Measured) -> Result<String, ExperimentError> {
    let case = &measured.case;
    let peers = peers(&case.name)?;
    let section = |quantity: &Quantity| {
        let drawn = Block::Chart(chart(measured, quantity, &peers));
        let tables = tables(measured, quantity, &peers).into_iter().map(Block::Table);
        (quantity.name.clone(), std::iter::once(drawn).chain(tables).collect())
    };
    Ok(render(&Report {
        title: format!("splashdown chart: {}", case.name),
        subtitle: format!("{}; {} threads, version {}", case.about, measured.threads, measured.version),
        status: Status::Completed,
        sections: case.quantity.iter().map(section).collect(),
    }))
}

/// The runs as Markdown.
pub fn table(measured: &Measured) -> Result<String, ExperimentError> {
    let case = &measured.case;
    let peers = peers(&case.name)?;
    let mut text = format!("{}. {} threads.\n", case.about, measured.threads);
    for quantity in &case.quantity {
        text += &format!("\n### {}, {}\n", case.name, quantity.name);
        for table in tables(measured, quantity, &peers) {
            text += &format!("\n{}\n\n{}", table.title, table.markdown());
        }
    }
    Ok(text)
}

/// Runs, laws, and runs without a number.
fn tables(measured: &Measured, quantity: &Quantity, peers: &[Peer]) -> Vec<Table> {
    let mut rows: Vec<Vec<String>> = measured.seen(quantity).iter().map(cells).collect();
    let reference = quantity.reference.unwrap_or(f64::NAN);
    let theirs = given(peers, quantity, reference);
    rows.extend(theirs.iter().map(|(peer, point, reading)| {
        let first = [format!("{} (peer)", peer.name), point.at.clone()];
        row(first, reading, point.particles, point.steps, point.core_seconds)
    }));
    let sources: Vec<String> = peers
        .iter()
        .filter(|p| theirs.iter().any(|t| t.0.name == p.name))
        .map(|p| format!(" {}: {}.", p.name, p.provenance))
        .collect();
    let title = format!("{}.{}", quantity.text(), sources.concat());
    let mut tables = vec![Table::new(title, &HEAD, rows)];
    let laws: Vec<Vec<String>> = measured
        .case
        .family
        .iter()
        .filter_map(|f| {
            let Trend { law, verdict } = measured.trend(quantity, f)?;
            let spread = 100.0 * law.scatter.exp_m1();
            let numbers = [
                percent(law.factor),
                format!("{:+.2} ± {:.2}", law.exponent, law.exponent_error),
                format!("{spread:.0}"),
            ];
            Some([vec![f.name.clone()], numbers.to_vec(), vec![verdict.to_string()]].concat())
        })
        .collect();
    if !laws.is_empty() {
        tables.push(Table::new("Error against cost, fitted.", &TREND_HEAD, laws));
    }
    let lost: Vec<Vec<String>> = measured
        .points
        .iter()
        .filter_map(|p| {
            let why = match &p.outcome {
                Outcome::Failed(why) => why,
                Outcome::Done(run) => run.missing.get(&quantity.name)?,
            };
            Some(vec![p.name(), why.clone()])
        })
        .collect();
    if !lost.is_empty() {
        tables.push(Table::new("Without a number.", &["run", "why"], lost));
    }
    tables
}

/// What other programs gave for a quantity.
fn given<'a>(peers: &'a [Peer], quantity: &Quantity, reference: f64) -> Vec<(&'a Peer, &'a PeerPoint, Reading)> {
    let of = |peer: &'a Peer| {
        peer.point.iter().filter_map(move |p| Some((peer, p, p.gave.get(&quantity.name)?.reading(reference))))
    };
    peers.iter().flat_map(of).collect()
}

fn chart(measured: &Measured, quantity: &Quantity, peers: &[Peer]) -> Chart {
    let seen = measured.seen(quantity);
    let spot = |s: &Seen<'_>| [s.run.core_seconds, (100.0 * s.reading.error).max(LEAST_DRAWN)];
    let (mut curves, mut trends) = (Vec::new(), Vec::new());
    for family in &measured.case.family {
        let of: Vec<[f64; 2]> = seen.iter().filter(|s| s.point.family == family.name).map(spot).collect();
        if let Some(Trend { law, .. }) = measured.trend(quantity, family) {
            let ends = of.iter().fold([f64::INFINITY, 0.0], |e: [f64; 2], p| [e[0].min(p[0]), e[1].max(p[0])]);
            trends.push(TrendLine { curve: curves.len(), ends: ends.map(|x| [x, 100.0 * law.at(x)]) });
        }
        if !of.is_empty() {
            curves.push(Curve::new(&family.name, Mark::Points, of));
        }
    }
    for peer in peers {
        let theirs = given(std::slice::from_ref(peer), quantity, quantity.reference.unwrap_or(f64::NAN));
        let of: Vec<[f64; 2]> = theirs.iter().map(|(_, p, r)| [p.core_seconds, 100.0 * r.error]).collect();
        if !of.is_empty() {
            curves.push(Curve::new(format!("{} (hollow)", peer.name), Mark::Hollow, of));
        }
    }
    let mut front: Vec<[f64; 2]> = seen.iter().filter(|s| s.on_front).map(spot).collect();
    front.sort_by(|a, b| a[0].total_cmp(&b[0]));
    curves.push(Curve::new("nothing is cheaper and more exact", Mark::Dashed, front));
    let cut = seen.iter().any(|s| 100.0 * s.reading.error < LEAST_DRAWN);
    let y_label = if cut { "error [%], drawn from 0.01 on" } else { "error [%]" };
    let title = format!("{}: {}", measured.case.about, quantity.name);
    Chart { trends, logarithmic: true, ..Chart::new(title, "cost [core-s]", y_label, curves) }
}

fn cells(seen: &Seen<'_>) -> Vec<String> {
    let Seen { point, run, reading, on_front } = seen;
    let mark = if *on_front { " (front)" } else { "" };
    let at = point.at.as_ref().map_or_else(String::new, as_set);
    row([format!("{}{mark}", point.family), at], reading, run.particles, run.steps, run.core_seconds)
}

fn row(first: [String; 2], reading: &Reading, particles: usize, steps: u64, core_seconds: f64) -> Vec<String> {
    let numbers = [
        number(reading.value),
        format!("{:+.2}", 100.0 * reading.bias),
        percent(reading.scatter),
        percent(reading.error),
        particles.to_string(),
        steps.to_string(),
        if core_seconds < 0.1 { format!("{core_seconds:.1e}") } else { format!("{core_seconds:.1}") },
    ];
    first.into_iter().chain(numbers).collect()
}

/// In percent; of small ones more digits.
fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    if percent > 0.0 && percent < 0.095 { format!("{percent:.4}") } else { format!("{percent:.2}") }
}

/// Six digits, in powers of ten where they would not show otherwise.
fn number(x: f64) -> String {
    if (1e-2..1e6).contains(&x.abs()) { format!("{x:.6}") } else { format!("{x:.4e}") }
}
