//! `sweep.html`: worst cases, trends, response surfaces, points and failures.

use super::collect::{Collected, Number, PointResult};
use super::surfaces::surfaces;
use super::table::{folder_of, plain, worst};
use super::trends::{charted, trends};
use crate::report::{Block, Report, Status, escape, render};
use crate::scene::significant;

/// Most points that the page lists; the rest is in `table.csv`.
const MOST_LISTED: usize = 2000;
/// Most messages below the heading.
const MOST_MESSAGES: usize = 5;

/// Status of a point with results that are doubtful.
const DOUBTFUL: &str = "completed_with_doubts";

/// The page of a sweep.
pub(super) fn page(collected: &Collected) -> String {
    let mut sections = vec![("Worst cases".to_string(), worst_cases(collected))];
    let charts = trends(collected);
    if !charts.is_empty() {
        sections.push(("Trends".into(), charts));
    }
    let surfaces = surfaces(collected);
    if !surfaces.is_empty() {
        sections.push(("Response surfaces".into(), surfaces));
    }
    sections.push(("Points".into(), points(collected)));
    if collected.failed().next().is_some() {
        sections.push(("Failures".into(), failures(collected)));
    }
    render(&Report {
        title: format!("splashdown sweep: {}", collected.name),
        subtitle: subtitle(collected),
        status: status(collected),
        sections,
    })
}

fn subtitle(collected: &Collected) -> String {
    let axes: Vec<String> = collected.axes.iter().map(|axis| axis.label()).collect();
    let over = if axes.is_empty() { "one point".into() } else { format!("over {}", axes.join(", ")) };
    let seconds: f64 = collected.points.iter().filter_map(|p| Some(p.wall_time_s? * p.threads? as f64)).sum();
    format!("{} points {over}; {} core-s", collected.points.len(), significant(seconds))
}

fn status(collected: &Collected) -> Status {
    let (all, done, failed) = (collected.points.len(), collected.completed().count(), collected.failed().count());
    let messages = collected.failed().take(MOST_MESSAGES);
    let message =
        |p: &PointResult| format!("point {}: {}: {}", p.number, p.status, p.message.as_deref().unwrap_or("-"));
    match (failed, all - done - failed) {
        (0, 0) => Status::Completed,
        (0, left) => Status::Doubtful(format!("{left} of {all} points have no result yet"), Vec::new()),
        (failed, 0) => Status::Doubtful(format!("{failed} of {all} points failed"), messages.map(message).collect()),
        (failed, left) => {
            let heading = format!("{failed} of {all} points failed, {left} have no result yet");
            Status::Doubtful(heading, messages.map(message).collect())
        }
    }
}

/// A cell: its text, and the file that it leads to.
struct Cell(String, Option<String>);

fn text(text: impl Into<String>) -> Cell {
    Cell(text.into(), None)
}

/// The number of a point, which leads to its report.
fn link(point: &PointResult) -> Cell {
    let report = point.id.as_deref().filter(|_| point.is_completed() || point.status == "failed");
    Cell(point.number.to_string(), report.map(|id| format!("{}/report.html", folder_of(id))))
}

/// A number, perhaps with a band and a mark behind it.
fn is_number(text: &str) -> bool {
    text.split(' ').next().is_some_and(|word| word.parse::<f64>().is_ok())
}

/// A table whose cells may be links.
fn linked_table(caption: &str, head: &[String], rows: Vec<Vec<Cell>>) -> Block {
    let is_numeric = |k: usize| {
        rows.iter().any(|row| is_number(&row[k].0)) && rows.iter().all(|row| is_number(&row[k].0) || row[k].0 == DASH)
    };
    let classes: Vec<&str> = (0..head.len()).map(|k| if is_numeric(k) { " class=\"number\"" } else { "" }).collect();
    let cell = |(Cell(text, to), class): (&Cell, &&str)| match to {
        Some(to) => format!("<td{class}><a href=\"{}\">{}</a></td>", escape(to), escape(text)),
        None => format!("<td{class}>{}</td>", escape(text)),
    };
    let heading = |(text, class): (&String, &&str)| format!("<th{class}>{}</th>", escape(text));
    let head: String = head.iter().zip(&classes).map(heading).collect();
    let row = |row: &Vec<Cell>| format!("<tr>{}</tr>\n", row.iter().zip(&classes).map(cell).collect::<String>());
    let body: String = rows.iter().map(row).collect();
    let svg = format!(
        "<div class=\"table\"><table>\n<thead>\n<tr>{head}</tr>\n</thead>\n<tbody>\n{body}</tbody>\n</table></div>"
    );
    Block::Drawing { svg, caption: caption.into() }
}

/// What stands where no number is known.
const DASH: &str = "–";

/// A number with four digits; with an exponent where it is very small or large.
fn short(number: f64) -> String {
    match number.abs() {
        size if size > 0.0 && !(1e-4..1e7).contains(&size) => format!("{number:.3e}"),
        _ => significant(number),
    }
}

/// Marks of the verdicts, for the table of points.
const MARKS: [(&str, &str); 4] =
    [("acoustic", "~"), ("not_resolved", "?"), ("no_band", "*"), ("beyond_allowable", "!")];

/// A number with its band and its mark.
fn in_words(number: &Number) -> String {
    let mark = MARKS.iter().find(|(verdict, _)| number.verdict.as_deref() == Some(verdict));
    let band = number.band.map_or(String::new(), |band| format!(" ± {}", short(band)));
    format!("{}{band}{}", short(number.value), mark.map_or(String::new(), |(_, mark)| format!(" {mark}")))
}

fn axes_of(point: &PointResult) -> impl Iterator<Item = Cell> {
    point.values.iter().map(|value| match value.as_f64() {
        Some(number) => text(short(number)),
        None => text(plain(value)),
    })
}

fn head(collected: &Collected, before: &[&str], after: &[&str]) -> Vec<String> {
    let words = |words: &[&str]| words.iter().map(|word| word.to_string()).collect::<Vec<_>>();
    let axes = collected.axes.iter().map(|axis| axis.label()).collect();
    [words(before), axes, words(after)].concat()
}

fn worst_cases(collected: &Collected) -> Vec<Block> {
    let cases = worst(collected);
    if cases.is_empty() {
        return vec![Block::Text("No point has results.".into())];
    }
    let rows = cases.iter().map(|case| {
        let place = case.scene.iter().map(String::as_str).chain([case.place]).filter(|word| !word.is_empty());
        let band = case.number.band.map_or(DASH.into(), short);
        let verdict = case.number.verdict.as_deref().unwrap_or(DASH).replace('_', " ");
        let first = [text(place.collect::<Vec<_>>().join(", ")), text(case.quantity)];
        let number = [text(short(case.number.value)), text(band), text(verdict), link(case.point)];
        first.into_iter().chain(number).chain(axes_of(case.point)).collect()
    });
    let head = head(collected, &["place", "quantity", "value", "band ±", "verdict", "point"], &[]);
    let caption = "Worst case of each quantity: the largest magnitude, or the smallest reserve factor. A value that is not \
                   resolved may be too large or too small.";
    let doubtful = collected.points.iter().filter(|point| point.status == DOUBTFUL).count();
    let all = collected.points.len();
    let text = Block::Text(format!("{doubtful} of {all} points are completed with doubts: their reports say why."));
    let table = linked_table(caption, &head, rows.collect());
    (doubtful > 0).then_some(text).into_iter().chain([table]).collect()
}

fn points(collected: &Collected) -> Vec<Block> {
    let names: Vec<&str> = charted(collected);
    let rows = collected.points.iter().take(MOST_LISTED).map(|point| {
        let numbers = names.iter().map(|name| text(point.numbers.get(*name).map_or(DASH.into(), in_words)));
        let seconds = text(point.wall_time_s.map_or(DASH.into(), short));
        let status = text(point.status.replace('_', " "));
        [link(point)].into_iter().chain(axes_of(point)).chain([status]).chain(numbers).chain([seconds]).collect()
    });
    let after: Vec<&str> = ["status"].into_iter().chain(names.iter().copied()).chain(["wall time [s]"]).collect();
    let marks = MARKS.map(|(verdict, mark)| format!("{mark} {}", verdict.replace('_', " "))).join(", ");
    let mut blocks = vec![linked_table(
        &format!("Points; the number leads to the report. Values with band; marks: {marks}."),
        &head(collected, &["point"], &after),
        rows.collect(),
    )];
    if collected.points.len() > MOST_LISTED {
        blocks.push(Block::Text(format!("The first {MOST_LISTED} points; table.csv has all.")));
    }
    blocks
}

fn failures(collected: &Collected) -> Vec<Block> {
    let rows = collected.failed().take(MOST_LISTED).map(|point| {
        let why = [text(point.status.clone()), text(point.message.clone().unwrap_or_default())];
        [link(point)].into_iter().chain(axes_of(point)).chain(why).collect()
    });
    vec![linked_table("Points without results.", &head(collected, &["point"], &["status", "message"]), rows.collect())]
}
