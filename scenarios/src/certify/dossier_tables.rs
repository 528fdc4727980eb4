//! Tables of the dossier.

use report::run_page::quantity::{Unit, digits, with_unit as scaled};
use report::{Block, Table, row};
use settings::significant;

use super::findings::{Findings, Worst};
use super::{Extreme, Plan};

/// Case numbers that a row shows, at most.
const SHOWN: usize = 8;

/// A number with its unit; zero has the unit itself.
fn with_unit(value: f64, unit: &str) -> String {
    if value == 0.0 { format!("0\u{a0}{unit}") } else { scaled(value, unit) }
}

/// Case numbers in a row.
fn numbers(cases: &[usize]) -> String {
    let first: Vec<String> = cases.iter().take(SHOWN).map(usize::to_string).collect();
    let more = if cases.len() > SHOWN { ", …" } else { "" };
    first.join(", ") + more
}

/// The rule's paragraphs.
pub(super) fn paragraphs(found: &Findings) -> Vec<Block> {
    let rows = found.paragraphs.iter().map(|answer| {
        let gives = if answer.gives.is_empty() { "–" } else { &answer.gives };
        row(&[&answer.paragraph, &answer.asks, answer.answer, gives, &answer.not_given])
    });
    let head = ["paragraph", "asks, shortened", "here", "what this gives", "what is not given"];
    vec![Block::Table(Table::new(format!("{}: the rule's own text counts", found.rule), &head, rows.collect()))]
}

/// Files and lists.
pub(super) fn inputs(found: &Findings) -> Vec<Block> {
    let files = found.files.iter().map(|file| row(&[&file.file, &file.sha256]));
    let lists = found.inputs.iter().map(|input| row(&[input.what, &input.values, &input.origin]));
    let assumed = found.assumptions.iter().map(|assumed| row(&[assumed]));
    let mut blocks = vec![
        Block::Table(Table::new(
            "Lists of the cases, and where each comes from",
            &["list", "values", "from"],
            lists.collect(),
        )),
        Block::Table(Table::new("Files that were read", &["file", "SHA-256"], files.collect())),
    ];
    if !found.assumptions.is_empty() {
        blocks.push(Block::Table(Table::new("What the landing file assumes", &["assumed"], assumed.collect())));
    }
    blocks
}

/// How the cases ended.
pub(super) fn cases(found: &Findings) -> Vec<Block> {
    let counts = &found.counts;
    let rows = [
        ("completed", counts.completed),
        ("completed with a doubt", counts.doubtful),
        ("failed: numbers up to the failure stand apart", counts.failed),
        ("not run: outside the model's range, or not possible", counts.outside),
    ];
    let rows = rows.map(|(ended, count)| row(&[ended, &count.to_string()]));
    let part = match found.cases == found.combinations {
        true => "Every combination of the lists.".to_string(),
        false => format!(
            "{} of {} combinations (certify.cases): multiples of a step near the golden section, so that they spread over the list.",
            found.cases, found.combinations
        ),
    };
    let reasons = found.reasons.iter().map(|reason| {
        row(&[reason.ended.words(), &reason.cases.len().to_string(), &reason.example, &numbers(&reason.cases)])
    });
    let mut blocks =
        vec![Block::Text(part), Block::Table(Table::new("How the cases ended", &["ended", "cases"], rows.into()))];
    if !found.reasons.is_empty() {
        let title = "Reasons; numbers in them are those of the first case";
        blocks.push(Block::Table(Table::new(title, &["ended", "cases", "reason", "their numbers"], reasons.collect())));
    }
    if !found.lost.is_empty() {
        let lost = found.lost.iter().map(|part| row(&[&part.part, &part.cases.to_string(), &part.first.to_string()]));
        let title = "Parts that were lost; those of certify.failures too, with their first touch";
        blocks.push(Block::Table(Table::new(title, &["part", "cases", "the first"], lost.collect())));
    }
    blocks
}

/// Worst cases in words.
pub(super) fn worst(found: &Findings) -> Vec<Block> {
    let shown = found.worst.iter().filter(|worst| !worst.name.starts_with("station."));
    let of = |worst: &Worst| {
        let Extreme { value, time_s, case } = worst.extreme;
        let time = if worst.name.starts_with("flotation.") { "–".into() } else { digits(time_s) };
        let before = worst
            .before_a_failure
            .map_or("–".into(), |failed| format!("{} (case {})", with_unit(failed.value, worst.unit), failed.case));
        row(&[&worst.title, &with_unit(value, worst.unit), &time, &found.case(case), &worst.words, &before])
    };
    let head = ["quantity", "worst value", "time [s]", "case", "the case", "worse before a failure"];
    let table = Table::new(
        "Worst values over all cases that completed, with a doubt or without; none has a known band",
        &head,
        shown.map(of).collect(),
    );
    vec![Block::Table(table)]
}

/// Stations: load, pressure, shear, bending, each with its case.
pub(super) fn stations(plan: &Plan, found: &Findings) -> Vec<Block> {
    let of = |x: f64, what: &str| found.envelope.numbers.get(&format!("station.{x}.{what}")).copied();
    let columns = [("line_load", "N/m"), ("pressure", "Pa"), ("shear", "N"), ("bending", "N m")];
    let units = columns.map(|(what, si)| {
        let values = plan.scene.stations.iter().filter_map(|station| of(station.x, what));
        Unit::of(si, values.fold(0.0, |most, extreme| f64::max(most, extreme.value.abs())))
    });
    let of_station = |x: f64| {
        let cells = columns.iter().zip(&units).flat_map(|((what, _), unit)| match of(x, what) {
            Some(extreme) if extreme.value != 0.0 => [digits(unit.scale * extreme.value), found.case(extreme.case)],
            _ => ["–".into(), "–".into()],
        });
        std::iter::once(digits(x)).chain(cells).collect()
    };
    let [line, pressure, shear, bending] = units.each_ref().map(|unit| unit.name.as_str());
    let head = [
        "station [m]".to_string(),
        format!("load of a metre of keel [{line}]"),
        "case".into(),
        format!("pressure on the breadth [{pressure}]"),
        "case".into(),
        format!("shear of largest size [{shear}]"),
        "case".into(),
        format!("bending of largest size [{bending}]"),
        "case".into(),
    ];
    let rows = plan.scene.stations.iter().map(|station| of_station(station.x)).collect();
    vec![Block::Table(Table {
        title: "Stations: worst values over all cases that completed, with a doubt or without".into(),
        head: head.to_vec(),
        rows,
    })]
}

/// Windows, then the cells of the bottom.
pub(super) fn pressures(found: &Findings) -> Vec<Block> {
    let windows = found.worst.iter().filter(|worst| worst.name.starts_with("window."));
    let window = |worst: &Worst| {
        let Extreme { value, time_s, case } = worst.extreme;
        row(&[&worst.title, &with_unit(value, "Pa"), &digits(time_s), &found.case(case), &worst.words])
    };
    let windows: Vec<_> = windows.map(window).collect();
    let mut blocks = Vec::new();
    if !windows.is_empty() {
        let head = ["window", "largest mean pressure", "time [s]", "case", "the case"];
        blocks.push(Block::Table(Table::new("Windows of the bottom", &head, windows)));
    }
    let cells = &found.envelope.pressure;
    let Some(shares) = cells.first().map(Vec::len) else {
        return vec![Block::Text("The model of the sections has no pressures along the girth.".into())];
    };
    let most = cells.iter().flatten().fold(0.0, |most, cell| f64::max(most, cell.value));
    let unit = Unit::of("Pa", most);
    let row_of = |(place, row): (&[f64], &Vec<Extreme>)| {
        let worst = row.iter().max_by(|a, b| a.value.total_cmp(&b.value)).copied().unwrap_or_default();
        let cells = row.iter().map(|cell| digits(unit.scale * cell.value));
        let case = if worst.case == 0 { "–".into() } else { found.case(worst.case) };
        let ends = format!("{} to {}", significant(place[0]), significant(place[1]));
        std::iter::once(ends).chain(cells).chain([case]).collect()
    };
    let share = |k: usize| format!("girth {}", significant((k as f64 + 0.5) / shares as f64));
    let head: Vec<String> = std::iter::once("place [m]".to_string())
        .chain((0..shares).map(share))
        .chain(["case of the largest".into()])
        .collect();
    let rows = found.places_m.windows(2).zip(cells).map(row_of).collect();
    let title = format!(
        "Largest mean pressure on each cell [{}]: place from the nose × middle of the share of the girth, 0 keel, 1 edge; all cases",
        unit.name
    );
    blocks.push(Block::Table(Table { title, head, rows }));
    blocks
}
