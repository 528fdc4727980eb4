//! One page that compares runs: the same curves overlaid, the results side by side, the keys that differ.

use std::collections::BTreeSet;
use std::path::PathBuf;

use scene::schema;
use scene::vocabulary::{Quantity, ResultId, Status, Verdict};
use settings::significant;

use super::charts::{self, Figure};
use super::flow::{Flow, picture};
use super::folder::{FolderError, RunFolder};
use super::headline::{two_digits, with_band};
use super::quantity::{digits, with_unit};
use super::{figure_blocks, folded, structure};
use crate::flow_figure::flow_svg;
use crate::html::page;
use crate::lead::{COARSE, READ_CURVES};
use crate::markup::escape;
use crate::{Block, CATEGORIES, Chart, Curve, Mark, Paint, Table, row};

/// Width of the picture of a run [pixels].
const PICTURE: u32 = 640;
/// Most keys that the head of the page names.
const MOST_NAMED: usize = 6;

/// The page of several runs; the first is the one that the others are compared with.
///
/// # Errors
/// A folder holds no run.
pub fn compare(dirs: &[PathBuf]) -> Result<String, FolderError> {
    let mut runs = dirs.iter().map(|dir| RunFolder::read(dir)).collect::<Result<Vec<_>, _>>()?;
    let names = names(&runs);
    let pictures = at_peaks(&mut runs, &names);
    let differing = Differing::of(&runs);
    let lead = lead(&runs, &names, &differing);
    let sections = [
        ("Results", vec![results(&runs, &names)]),
        ("Curves", figure_blocks(&overlaid(&runs, &names, charts::figures), READ_CURVES)),
        ("Structure", figure_blocks(&overlaid(&runs, &names, structure::figures), "")),
        ("Flow at the largest force", pictures),
        ("Keys that differ", differing.blocks(&names)),
    ];
    let shown = sections.into_iter().filter(|(_, blocks)| !blocks.is_empty());
    let sections: Vec<_> = shown.map(|(heading, blocks)| (heading.to_string(), blocks)).collect();
    Ok(page(&format!("splashdown: {}", names.join(", ")), &lead, &sections))
}

/// Names of the runs: those of their folders, as many of the folders above as tell them apart.
fn names(runs: &[RunFolder]) -> Vec<String> {
    let parts = |run: &RunFolder, count: usize| {
        let whole: Vec<String> =
            run.path.components().map(|part| part.as_os_str().to_string_lossy().into_owned()).collect();
        whole[whole.len().saturating_sub(count)..].join("/")
    };
    let distinct = |names: &Vec<String>| names.iter().collect::<BTreeSet<_>>().len() == runs.len();
    let named = |count: usize| runs.iter().map(|run| parts(run, count)).collect::<Vec<_>>();
    (1..=6)
        .map(named)
        .find(distinct)
        .unwrap_or_else(|| runs.iter().zip(1..).map(|(run, k)| format!("{} ({k})", run.name())).collect())
}

fn lead(runs: &[RunFolder], names: &[String], differing: &Differing) -> String {
    let line = |(run, name): (&RunFolder, &String)| {
        let status = run.record.status();
        let class = match status {
            Status::Completed => "completed",
            Status::BeyondAllowable | Status::Ruptured | Status::Failed => "failed",
            Status::CompletedWithDoubts | Status::Interrupted | Status::NotFinished => "doubtful",
        };
        let words = status.words();
        format!("<li><b>{}</b> <span class=\"{class}\">{words}</span> · {}</li>", escape(name), escape(run.model()))
    };
    let lines: String = runs.iter().zip(names).map(line).collect();
    format!(
        "<p class=\"eyebrow\">splashdown</p>\n<h1>Comparison of {} runs</h1>\n<ul class=\"runs\">{lines}</ul>\n<p>{}</p>\n",
        runs.len(),
        escape(&differing.sentence())
    )
}

/// A row for each result, a column for each run, with ratios to the first.
fn results(runs: &[RunFolder], names: &[String]) -> Block {
    let all: Vec<Vec<_>> = runs.iter().map(|run| run.record.results.named().collect()).collect();
    let mut rows: Vec<Vec<String>> = Vec::new();
    let mut known: Vec<&ResultId> = Vec::new();
    for (id, _) in all.iter().flatten() {
        if !known.contains(&id) {
            known.push(id);
        }
    }
    for id in known {
        let of = |k: usize| all[k].iter().find(|(own, _)| own == id).map(|(_, quantity)| *quantity);
        let mut cells = vec![id.title()];
        for k in 0..runs.len() {
            let Some(quantity) = of(k) else {
                cells.extend(row(if k == 0 { &["–"] } else { &["–", "–"] }));
                continue;
            };
            // a line breaks before the verdict only
            let value = with_band(quantity, id.name.si()).replace(' ', "\u{a0}");
            cells.push(format!("{value}, {}", verdict(quantity)));
            cells.extend((k > 0).then(|| of(0).and_then(|first| ratio(quantity, first)).unwrap_or("–".into())));
        }
        rows.push(cells);
    }
    let mut head = vec!["result".to_string()];
    for (k, name) in names.iter().enumerate() {
        head.push(name.clone());
        head.extend((k > 0).then(|| format!("{name} / {}", names[0])));
    }
    let title = "Results with band and verdict; the band of a ratio is the sum of the shares of both bands";
    Block::Table(Table { title: title.into(), head, rows })
}

/// What may be said of a result, in words.
fn verdict(quantity: &Quantity) -> String {
    match quantity.share().filter(|share| quantity.verdict == Verdict::Resolved && *share > COARSE) {
        Some(share) => format!("coarse, ± {} %", digits(100.0 * share)),
        None if quantity.allowed == Some(false) => format!("{}; not allowed", quantity.verdict.words()),
        None => quantity.verdict.words().into(),
    }
}

/// A result over the first run's, with its band where both have one.
fn ratio(quantity: &Quantity, first: &Quantity) -> Option<String> {
    let (value, over) = (quantity.shown()?, first.shown()?);
    let ratio = Some(value / over).filter(|ratio| ratio.is_finite())?;
    let shares = quantity.band.zip(first.band).map(|(band, of_first)| (band / value).abs() + (of_first / over).abs());
    let band =
        shares.map_or(", no\u{a0}band".into(), |shares| format!("\u{a0}±\u{a0}{}", two_digits(ratio.abs() * shares)));
    Some(format!("{}{band}", digits(ratio)))
}

/// The charts that runs have in common, with the first curve of each run.
fn overlaid(runs: &[RunFolder], names: &[String], of: fn(&RunFolder) -> Vec<Figure>) -> Vec<Figure> {
    let all: Vec<Vec<Figure>> = runs.iter().map(of).collect();
    let mut titles: Vec<&Figure> = Vec::new();
    for figure in all.iter().flatten() {
        if !titles.iter().any(|known| known.chart.title == figure.chart.title) {
            titles.push(figure);
        }
    }
    let overlay = |first: &&Figure| {
        let mut curves = Vec::new();
        for (run, (figures, name)) in all.iter().zip(names).enumerate() {
            let mut form = 0;
            let Some(figure) = figures.iter().find(|figure| figure.chart.title == first.chart.title) else { continue };
            let scales = [(&figure.chart.x_label, &first.chart.x_label), (&figure.chart.y_label, &first.chart.y_label)];
            let [x, y] = scales.map(|(own, shown)| prefix(own) / prefix(shown));
            // references and theories are drawn beside their own run only
            let own = figure.chart.curves.iter().filter(|curve| curve.mark == Mark::Line);
            for curve in own {
                let part = if known_alone(figure) { "" } else { &curve.label };
                let label = if part.is_empty() { name.clone() } else { format!("{name}: {part}") };
                let pale = curve.paint.pale || curve.label == "every sample";
                let paint = Paint {
                    colour: Some(CATEGORIES[run % CATEGORIES.len()]),
                    form: Some(if pale { 0 } else { form }),
                    pale,
                };
                form += usize::from(!pale);
                let points = curve.x.iter().zip(&curve.y).map(|(u, v)| [x * u, y * v]);
                curves.push(Curve::new(label, Mark::Line, points).painted(paint));
            }
        }
        curves.sort_by_key(|curve| !curve.paint.pale);
        let chart =
            Chart { curves, ..Chart::new(&first.chart.title, &first.chart.x_label, &first.chart.y_label, Vec::new()) };
        Figure { name: first.name.clone(), chart }
    };
    titles.iter().map(overlay).collect()
}

/// True for a chart of one curve of the run, with what it is compared with.
fn known_alone(figure: &Figure) -> bool {
    figure.chart.curves.iter().filter(|curve| curve.mark == Mark::Line).count() == 1
}

/// How many SI units the unit in brackets at the end of a label is.
fn prefix(label: &str) -> f64 {
    let unit = label.rsplit_once('[').map_or("", |(_, unit)| unit.trim_end_matches(']'));
    let starts = |prefix: char| unit.starts_with(prefix) && unit.len() > 1;
    match () {
        _ if starts('M') => 1e6,
        _ if starts('k') && unit != "kg" => 1e3,
        _ if unit == "ms" || unit == "mm" => 1e-3,
        _ => 1.0,
    }
}

/// The picture of each run at its largest force, with one scale of colours.
fn at_peaks(runs: &mut [RunFolder], names: &[String]) -> Vec<Block> {
    let mut flows: Vec<Option<Flow>> = runs.iter_mut().map(Flow::read).collect();
    let tops = flows.iter().flatten().map(|flow| flow.top);
    let top = tops.fold([0.0, 0.0], |[p, v]: [f64; 2], [q, w]| [p.max(q), v.max(w)]);
    flows.iter_mut().flatten().for_each(|flow| flow.top = top);
    let drawn = runs.iter_mut().zip(&flows).zip(names);
    let block = |((run, flow), name): ((&mut RunFolder, &Option<Flow>), &String)| {
        let flow = flow.as_ref()?;
        let (frame, view) = picture(&run.scene, run.log.as_mut()?, flow, flow.still, PICTURE)?;
        let caption = format!("{name}: pressure at {}; the colours are those of all runs", with_unit(frame.time, "s"));
        Some(Block::Drawing { svg: flow_svg(&frame, &view), caption })
    };
    drawn.filter_map(block).collect()
}

/// Keys whose values differ between the scenes as run, with the value in each.
#[derive(Default)]
struct Differing {
    /// Keys that a scene gives.
    given: Vec<Vec<String>>,
    /// Keys that the program fills in from others, and references.
    derived: Vec<Vec<String>>,
}

impl Differing {
    fn of(runs: &[RunFolder]) -> Differing {
        let keys: Vec<Vec<(String, String)>> = runs.iter().map(|run| keys(&run.scene.to_toml())).collect();
        let all: BTreeSet<&String> = keys.iter().flatten().map(|(key, _)| key).collect();
        let value =
            |k: usize, key: &String| keys[k].iter().find(|(own, _)| own == key).map_or("–", |(_, value)| value);
        let differs = |key: &&String| (1..runs.len()).any(|k| value(k, key) != value(0, key));
        let line = |key: &String| {
            std::iter::once(with_unit_of(key))
                .chain((0..runs.len()).map(|k| value(k, key).to_string()))
                .collect::<Vec<_>>()
        };
        let (given, derived): (Vec<_>, Vec<_>) = all.into_iter().filter(differs).partition(|key| is_given(key));
        let lines = |keys: Vec<&String>| keys.into_iter().map(line).collect();
        Differing { given: lines(given), derived: lines(derived) }
    }

    /// The keys that were given, in a sentence.
    fn sentence(&self) -> String {
        let mut keys: Vec<&str> =
            self.given.iter().take(MOST_NAMED).map(|line| line[0].split(" [").next().unwrap_or_default()).collect();
        if self.given.len() > MOST_NAMED {
            keys.push("others");
        }
        match keys.as_slice() {
            [] if self.derived.is_empty() => "The scenes are the same.".into(),
            [] => "The scenes differ in derived keys only.".into(),
            [only] => format!("They differ in {only}."),
            [most @ .., last] => format!("They differ in {} and {last}.", most.join(", ")),
        }
    }

    fn blocks(&self, names: &[String]) -> Vec<Block> {
        let head: Vec<String> = std::iter::once("key".to_string()).chain(names.iter().cloned()).collect();
        let mut blocks = Vec::new();
        if self.given.is_empty() {
            blocks.push(Block::Text(self.sentence()));
        } else {
            let table = Table { title: "Keys of the scenes".into(), head, rows: self.given.clone() };
            blocks.push(Block::Table(table));
        }
        let lines: Vec<String> =
            self.derived.iter().map(|line| format!("{}: {}", line[0], line[1..].join(" | "))).collect();
        if !lines.is_empty() {
            let title = format!("{} keys that follow from others, and references", lines.len());
            blocks.push(Block::Html(folded(&title, &lines.join("\n"))));
        }
        blocks
    }
}

/// True for a key that a scene gives; the program fills the others in by a rule where they are absent.
fn is_given(key: &str) -> bool {
    let Some(keyword) = schema().keyword(key) else { return false };
    let default = keyword.default.as_str();
    let is_word = default != "auto" && keyword.takes.contains(default);
    let is_value = default.starts_with('[') || default.parse::<f64>().is_ok() || ["true", "false"].contains(&default);
    !key.starts_with("compare") && (is_word || is_value || default.starts_with("required"))
}

/// A key with its unit.
fn with_unit_of(key: &str) -> String {
    let unit = schema().keyword(key).map_or("", |keyword| keyword.unit.as_str());
    if unit.is_empty() || unit == "-" { key.into() } else { format!("{key} [{unit}]") }
}

/// A value with four digits.
fn shown(value: &toml::Value) -> String {
    match value {
        toml::Value::Float(number) => significant(*number),
        toml::Value::Array(items) => format!("[{}]", items.iter().map(shown).collect::<Vec<_>>().join(", ")),
        other => other.to_string(),
    }
}

/// Keys and values of a TOML text, each with its path.
fn keys(text: &str) -> Vec<(String, String)> {
    fn walk(path: &str, value: &toml::Value, found: &mut Vec<(String, String)>) {
        let below = |key: &str| if path.is_empty() { key.to_string() } else { format!("{path}.{key}") };
        match value {
            toml::Value::Table(table) => table.iter().for_each(|(key, value)| walk(&below(key), value, found)),
            toml::Value::Array(items) if items.iter().any(toml::Value::is_table) => {
                items.iter().enumerate().for_each(|(k, value)| walk(&format!("{path}[{k}]"), value, found));
            }
            other => found.push((path.to_string(), shown(other))),
        }
    }
    let mut found = Vec::new();
    if let Ok(value) = toml::from_str::<toml::Value>(text) {
        walk("", &value, &mut found);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ratio_has_the_bands_of_both_and_a_wide_band_is_coarse() {
        let (time_s, cutoff_hz, allowed, verdict_of_all) = (None, None, None, Verdict::Resolved);
        let of = |value: f64, band: Option<f64>| Quantity {
            value,
            band,
            time_s,
            cutoff_hz,
            raw: value,
            verdict: verdict_of_all,
            allowed,
        };
        let (first, second) = (of(10.0, Some(1.0)), of(20.0, Some(1.0)));
        assert_eq!(ratio(&second, &first).as_deref(), Some("2.00\u{a0}±\u{a0}0.30"));
        assert_eq!(ratio(&of(20.0, None), &first).as_deref(), Some("2.00, no\u{a0}band"));
        assert_eq!(ratio(&first, &of(0.0, None)), None);
        assert_eq!([verdict(&second), verdict(&of(10.0, Some(6.1)))], ["resolved", "coarse, ± 61.0 %"]);
    }

    #[test]
    fn a_key_is_given_or_derived() {
        let given = ["body.deadrise_deg", "resolution.spacing", "body.mass", "solver", "time.end"].map(is_given);
        assert_eq!(given, [true; 5]);
        let derived = ["tank.width", "body.center_of_mass", "time.start", "compare[0].norm"].map(is_given);
        assert_eq!(derived, [false; 4]);
    }

    #[test]
    fn keys_have_paths_and_units_their_prefix() {
        let found = keys("a = 1\n[b]\nc = \"x\"\n[[d]]\ne = [1.0, 2.0]\n");
        let expected = [("a", "1"), ("b.c", "\"x\""), ("d[0].e", "[1, 2]")];
        assert_eq!(found, expected.map(|(key, value)| (key.to_string(), value.to_string())));
        assert_eq!(["[kN/m]", "[Pa]", "time [ms]", "[MPa]", "[m]"].map(prefix), [1e3, 1.0, 1e-3, 1e6, 1.0]);
    }
}
