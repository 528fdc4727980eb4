//! `sweep.html`: worst cases, trends, response surfaces, points and failures.

use decide::numbers::{Number, Said};
use report::{Block, Card, Lead, Table, Tone, hint_html, lead_html, page as html_page};
use scene::vocabulary::{ResultName, Status, Verdict};

use super::collect::{Collected, PointResult, is_failed};
use super::surfaces::surfaces;
use super::table::{Worst, folder_of, worst};
use super::trends::{charted, trends};
use super::words::{Quantity, axis_label, axis_number, inside, place_of, verdict};

/// Most points that the page lists; the rest is in `table.csv`.
const MOST_LISTED: usize = 2000;
/// Most messages below the heading, and most cards.
const MOST_MESSAGES: usize = 5;
const MOST_CARDS: usize = 8;

/// What stands where no number is known.
const DASH: &str = "–";

/// The page of a sweep.
pub(super) fn page(collected: &Collected) -> String {
    // a place is no load
    let cases: Vec<Worst<'_>> = worst(collected).into_iter().filter(|case| case.quantity != "line_load_at_m").collect();
    let mut sections = vec![("Worst cases", worst_cases(collected, &cases))];
    let charts = trends(collected);
    if !charts.is_empty() {
        sections.push(("Trends", [vec![Block::Html(hint_html())], charts].concat()));
    }
    let surfaces = surfaces(collected);
    if !surfaces.is_empty() {
        sections.push(("Response surfaces", surfaces));
    }
    sections.push(("Points", points(collected)));
    if collected.failed().next().is_some() {
        sections.push(("Failures", failures(collected)));
    }
    let sections: Vec<_> = sections.into_iter().map(|(heading, blocks)| (heading.to_string(), blocks)).collect();
    html_page(&format!("splashdown sweep: {}", collected.name), &lead_html(&lead(collected, &cases)), &sections)
}

fn lead(collected: &Collected, cases: &[Worst<'_>]) -> Lead {
    let axes: Vec<String> = collected.axes.iter().map(|axis| axis.key.clone()).collect();
    let over = if axes.is_empty() { "one point".to_string() } else { axes.join(" × ") };
    let all = collected.points.len();
    let with_status = |status: Status| collected.points.iter().filter(|point| point.status == status.name()).count();
    let (done, failed) = (collected.completed().count(), collected.failed().count());
    let counts = [
        (with_status(Status::CompletedWithDoubts), "with doubts"),
        (with_status(Status::BeyondAllowable), "with a panel beyond the allowable"),
        (with_status(Status::Ruptured), Status::Ruptured.words()),
        (failed, Status::Failed.words()),
        (all - done - failed, "without a result yet"),
    ];
    let wrong: Vec<String> =
        counts.iter().filter(|(count, _)| *count > 0).map(|(count, words)| format!("{count} {words}")).collect();
    let named: Vec<(&Worst<'_>, Quantity)> = named(collected, cases).filter(|(case, _)| !is_aside(case)).collect();
    let first = named.first().map(|(case, quantity)| {
        format!(
            "{}: {} at point {} ({}){}.",
            title(case, quantity),
            quantity.whole(case.number),
            case.point.number,
            place_of(collected, case.point),
            unresolved(case, quantity).map_or(String::new(), |words| format!("; {words}"))
        )
    });
    let message =
        |p: &PointResult| format!("point {}: {}: {}", p.number, p.status, p.message.as_deref().unwrap_or("-"));
    let unresolved_at = |point: &&PointResult| {
        let mut verdicts = point.numbers.values().filter_map(|number| number.verdict);
        verdicts.any(|verdict| verdict != Verdict::Resolved)
    };
    let count = collected.completed().filter(unresolved_at).count();
    let unresolved =
        (count > 0).then(|| format!("{count} of {done} have results that are not resolved or have no band."));
    let messages = collected.failed().take(MOST_MESSAGES).map(message);
    let is_doubtful =
        |(case, _): &(&Worst<'_>, Quantity)| verdict(case.number).is_some_and(|(tone, _)| tone != Tone::Good);
    let tone = match () {
        _ if failed > 0 || counts[1].0 > 0 || counts[2].0 > 0 => Tone::Failed,
        _ if !wrong.is_empty() || named.iter().any(is_doubtful) => Tone::Doubtful,
        _ => Tone::Good,
    };
    let heading = match wrong.is_empty() {
        true if all == 1 => "1 point: completed, without doubts.".to_string(),
        true if tone == Tone::Doubtful => {
            format!("{all} points: all completed, but the worst cases are coarse, not resolved or without a band.")
        }
        true => format!("{all} points: all completed, none with doubts."),
        false => format!("{all} points: {done} completed; {}.", wrong.join(", ")),
    };
    Lead {
        eyebrow: format!("splashdown sweep · {over}"),
        title: collected.name.clone(),
        tone,
        heading,
        reasons: first.into_iter().chain(unresolved).chain(messages).collect(),
        cards: named.iter().take(MOST_CARDS).map(|(case, quantity)| card(collected, case, quantity)).collect(),
    }
}

fn named<'a>(collected: &Collected, cases: &'a [Worst<'a>]) -> impl Iterator<Item = (&'a Worst<'a>, Quantity)> {
    cases.iter().map(|case| (case, Quantity::of(collected, &name(case))))
}

/// The name of a worst case in the table.
fn name(case: &Worst<'_>) -> String {
    if case.place.is_empty() { case.quantity.into() } else { format!("{}.{}", case.place, case.quantity) }
}

/// True for what stands in the table only: parts of the audit, stations of a landing.
fn is_aside(case: &Worst<'_>) -> bool {
    case.quantity.starts_with("audit.") || case.place.starts_with("station")
}

/// What is worst, with the scene where there are several.
fn title(case: &Worst<'_>, quantity: &Quantity) -> String {
    let scene = case.scene.as_ref().map_or(String::new(), |scene| format!(", {scene}"));
    let least = if case.quantity == ResultName::ReserveFactor.name() { "Least" } else { "Largest" };
    format!("{least} {}{scene}", inside(&quantity.title))
}

/// What is said of a worst case that is not resolved.
fn unresolved(case: &Worst<'_>, quantity: &Quantity) -> Option<String> {
    let verdict = case.number.verdict.filter(|verdict| *verdict != Verdict::Resolved)?;
    let resolved = match case.resolved {
        Some((number, point)) => format!("; worst resolved {} at point {}", quantity.whole(number), point.number),
        None => String::new(),
    };
    Some(format!("{}{resolved}", verdict.words()))
}

fn card(collected: &Collected, case: &Worst<'_>, quantity: &Quantity) -> Card {
    let number = case.number;
    let place = format!("point {}: {}", case.point.number, place_of(collected, case.point));
    let mut lines = vec![(place, report_of(case.point))];
    if let Some((number, point)) = case.resolved {
        lines.push((format!("worst resolved: {} at point {}", quantity.whole(number), point.number), report_of(point)));
    }
    Card {
        title: title(case, quantity),
        value: quantity.value(number.value),
        unit: quantity.unit.clone(),
        lines,
        chip: verdict(number),
    }
}

/// The address of a point's page, from the folder of the sweep.
fn report_of(point: &PointResult) -> Option<String> {
    let id = point.id.as_deref().filter(|_| point.has_page && (point.is_completed() || is_failed(&point.status)));
    id.map(|id| format!("{}/report.html", folder_of(id)))
}

/// The mark of a number in the table of points; none where nothing speaks against it.
fn mark(said: Said) -> &'static str {
    match said {
        Said::Of(Verdict::Resolved) => "",
        Said::Of(Verdict::Acoustic) => "~",
        Said::Of(Verdict::NotResolved) => "?",
        Said::Of(Verdict::NoBand) => "*",
        Said::Beyond => "!",
    }
}

/// A number with its band and its mark.
fn marked(quantity: &Quantity, number: &Number) -> String {
    let said = Said::all().filter(|said| number.said().any(|own| own == *said));
    let marks: String = said.map(mark).filter(|mark| !mark.is_empty()).map(|mark| format!(" {mark}")).collect();
    format!("{}{marks}", quantity.banded(number))
}

fn axes_of(point: &PointResult) -> impl Iterator<Item = String> {
    point.values.iter().map(axis_number)
}

fn head(collected: &Collected, before: &[String], after: &[String]) -> Vec<String> {
    let axes: Vec<String> = collected.axes.iter().map(|axis| axis_label(collected, axis)).collect();
    [before, &axes, after].concat()
}

fn worst_cases(collected: &Collected, cases: &[Worst<'_>]) -> Vec<Block> {
    if cases.is_empty() {
        return vec![Block::Text("No point has results.".into())];
    }
    let scenes = cases.iter().any(|case| case.scene.is_some());
    let others = cases.iter().any(|case| case.resolved.is_some());
    let rows = named(collected, cases).map(|(case, quantity)| {
        let scene = scenes.then(|| case.scene.clone().unwrap_or_default());
        let verdict = verdict(case.number).map_or(DASH.into(), |(_, words)| words);
        let resolved =
            case.resolved.map_or(DASH.into(), |(n, p)| format!("{} at point {}", quantity.whole(n), p.number));
        let first = [quantity.title.clone(), quantity.whole(case.number), verdict];
        let point = [case.point.number.to_string()];
        let cells = scene.into_iter().chain(first).chain(point).chain(axes_of(case.point));
        cells.chain(others.then_some(resolved)).collect()
    });
    let before = ["quantity", "worst", "verdict", "point"].into_iter();
    let before: Vec<String> = scenes.then_some("scene").into_iter().chain(before).map(String::from).collect();
    let after: Vec<String> = others.then(|| "worst resolved".to_string()).into_iter().collect();
    let table = Table {
        title: "Worst case of each quantity: the largest magnitude, or the smallest reserve factor. The point leads to its report.".into(),
        head: head(collected, &before, &after),
        rows: rows.collect(),
    };
    let links = cases.iter().map(|case| report_of(case.point)).collect();
    let doubtful = cases.iter().any(|case| case.number.verdict.is_some_and(|verdict| !verdict.is_sound()));
    let words = "A value that is not resolved may be too large or too small; the reports of the points say why.";
    let mut blocks = vec![Block::LinkedTable { table, column: before.len() - 1, links }];
    blocks.extend(doubtful.then(|| Block::Text(words.into())));
    blocks
}

fn points(collected: &Collected) -> Vec<Block> {
    let quantities: Vec<(&str, Quantity)> =
        charted(collected).into_iter().map(|name| (name, Quantity::of(collected, name))).collect();
    let listed = || collected.points.iter().take(MOST_LISTED);
    // statuses that are all the same stand above
    let differ = listed().any(|point| point.status != Status::Completed.name());
    let rows = listed().map(|point| {
        let number = |(name, quantity): &(&str, Quantity)| {
            point.numbers.get(*name).map_or(DASH.into(), |number| marked(quantity, number))
        };
        let first = [point.number.to_string()];
        let status = differ.then(|| point.status.replace('_', " "));
        first.into_iter().chain(axes_of(point)).chain(status).chain(quantities.iter().map(number)).collect()
    });
    let labels = quantities.iter().map(|(_, quantity)| quantity.label());
    let after: Vec<String> = differ.then(|| "status".to_string()).into_iter().chain(labels).collect();
    let has = |said: Said| {
        let mut numbers = listed().flat_map(|point| point.numbers.values());
        numbers.any(|number| number.said().any(|own| own == said))
    };
    let marks = Said::all().filter(|said| has(*said) && !mark(*said).is_empty());
    let marks: Vec<String> = marks.map(|said| format!("{} {}", mark(said), said.words())).collect();
    let marks = if marks.is_empty() { String::new() } else { format!(" Marks: {}.", marks.join(", ")) };
    let table = Table {
        title: format!("Points, with bands; the number leads to the report.{marks}"),
        head: head(collected, &["point".into()], &after),
        rows: rows.collect(),
    };
    let mut blocks = vec![Block::LinkedTable { table, column: 0, links: listed().map(report_of).collect() }];
    if collected.points.len() > MOST_LISTED {
        blocks.push(Block::Text(format!("The first {MOST_LISTED} points; table.csv has all.")));
    }
    blocks
}

fn failures(collected: &Collected) -> Vec<Block> {
    let listed = || collected.failed().take(MOST_LISTED);
    let rows = listed().map(|point| {
        let why = [point.status.clone(), point.message.clone().unwrap_or_default()];
        std::iter::once(point.number.to_string()).chain(axes_of(point)).chain(why).collect()
    });
    let table = Table {
        title: "Points without results".into(),
        head: head(collected, &["point".into()], &["status".into(), "message".into()]),
        rows: rows.collect(),
    };
    vec![Block::LinkedTable { table, column: 0, links: listed().map(report_of).collect() }]
}
