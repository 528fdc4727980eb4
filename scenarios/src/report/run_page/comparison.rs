//! One page that compares runs: the same curves overlaid, the results side by side, the keys that differ.

use std::collections::BTreeSet;
use std::path::PathBuf;

use super::charts::{self, Figure};
use super::flow::{Flow, picture};
use super::folder::{FolderError, RunFolder};
use super::headline::{in_words, named, with_band};
use super::quantity::{digits, result, with_unit};
use super::{HINT, figure_blocks, structure};
use crate::report::flow_figure::flow_svg;
use crate::report::html::page;
use crate::report::markup::escape;
use crate::report::{Block, Chart, Curve, Mark, Table, row};

/// Width of the picture of a run [pixels].
const PICTURE: u32 = 640;

/// The page of several runs; the first is the one that the others are compared with.
///
/// # Errors
/// A folder holds no run.
pub(crate) fn compare(dirs: &[PathBuf]) -> Result<String, FolderError> {
    let mut runs = dirs.iter().map(|dir| RunFolder::read(dir)).collect::<Result<Vec<_>, _>>()?;
    let names = names(&runs);
    let pictures: Vec<Block> = runs.iter_mut().zip(&names).filter_map(|(run, name)| at_peak(run, name)).collect();
    let lead = lead(&runs, &names);
    let sections = [
        ("Results", vec![results(&runs, &names)]),
        ("Curves", figure_blocks(&overlaid(&runs, &names, charts::figures), HINT)),
        ("Structure", figure_blocks(&overlaid(&runs, &names, structure::figures), "")),
        ("Flow at the largest force", pictures),
        ("Keys that differ", differences(&runs, &names)),
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

fn lead(runs: &[RunFolder], names: &[String]) -> String {
    let line = |(run, name): (&RunFolder, &String)| {
        let status = run.record.status.as_str();
        let (class, words) = match status {
            "completed" => ("completed", "completed"),
            "completed_with_doubts" => ("doubtful", "completed with doubts"),
            "beyond_allowable" => ("failed", "stress beyond the allowable"),
            "failed" => ("failed", "failed"),
            "interrupted" => ("doubtful", "interrupted"),
            _ => ("doubtful", "not finished"),
        };
        format!("<li><b>{}</b> <span class=\"{class}\">{words}</span> · {}</li>", escape(name), escape(run.model()))
    };
    let lines: String = runs.iter().zip(names).map(line).collect();
    format!(
        "<p class=\"eyebrow\">splashdown</p>\n<h1>Comparison of {} runs</h1>\n<ul class=\"runs\">{lines}</ul>\n",
        runs.len()
    )
}

/// A row for each result, a column for each run, with ratios to the first.
fn results(runs: &[RunFolder], names: &[String]) -> Block {
    let all: Vec<_> = runs.iter().map(named).collect();
    let mut rows: Vec<Vec<String>> = Vec::new();
    let mut known: Vec<String> = Vec::new();
    for (name, _) in all.iter().flatten() {
        if !known.contains(name) {
            known.push(name.clone());
        }
    }
    for name in known {
        let (title, si) = result(&name);
        let of = |k: usize| all[k].iter().find(|(own, _)| *own == name).map(|(_, quantity)| *quantity);
        let mut cells = vec![title];
        for k in 0..runs.len() {
            let Some(quantity) = of(k) else {
                cells.extend(row(if k == 0 { &["–"] } else { &["–", "–"] }));
                continue;
            };
            let verdict = if quantity.verdict == "resolved" {
                String::new()
            } else {
                format!(", {}", in_words(&quantity.verdict))
            };
            cells.push(with_band(quantity, si) + &verdict);
            let ratio = of(0).and_then(|first| Some(quantity.value? / first.value?));
            cells.extend((k > 0).then(|| ratio.map_or("–".into(), digits)));
        }
        rows.push(cells);
    }
    let mut head = vec!["result".to_string()];
    for (k, name) in names.iter().enumerate() {
        head.push(name.clone());
        head.extend((k > 0).then(|| format!("over {}", names[0])));
    }
    Block::Table(Table { title: "Results with bands and ratios".into(), head, rows })
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
        for (figures, name) in all.iter().zip(names) {
            let Some(figure) = figures.iter().find(|figure| figure.chart.title == first.chart.title) else { continue };
            let scales = [(&figure.chart.x_label, &first.chart.x_label), (&figure.chart.y_label, &first.chart.y_label)];
            let [x, y] = scales.map(|(own, shown)| prefix(own) / prefix(shown));
            // references and theories are drawn beside their own run only
            let own = figure.chart.curves.iter().filter(|curve| curve.mark == Mark::Line);
            for curve in own {
                let part = if known_alone(figure) { "" } else { &curve.label };
                let label = if part.is_empty() { name.clone() } else { format!("{name}: {part}") };
                curves.push(Curve::new(label, Mark::Line, curve.x.iter().zip(&curve.y).map(|(u, v)| [x * u, y * v])));
            }
        }
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

/// The picture of a run at its largest force.
fn at_peak(run: &mut RunFolder, name: &str) -> Option<Block> {
    let flow = Flow::read(run)?;
    let (frame, view) = picture(&run.scene, run.log.as_mut()?, &flow, flow.still, PICTURE)?;
    let caption = format!("{name}: pressure at {}", with_unit(frame.time, "s"));
    Some(Block::Drawing { svg: flow_svg(&frame, &view), caption })
}

/// Keys of the scenes whose values differ.
fn differences(runs: &[RunFolder], names: &[String]) -> Vec<Block> {
    let keys: Vec<Vec<(String, String)>> = runs.iter().map(|run| keys(&run.scene.to_toml())).collect();
    let all: BTreeSet<&String> = keys.iter().flatten().map(|(key, _)| key).collect();
    let value = |k: usize, key: &String| keys[k].iter().find(|(own, _)| own == key).map_or("–", |(_, value)| value);
    let differs = |key: &&&String| (1..runs.len()).any(|k| value(k, key) != value(0, key));
    let line = |key: &&String| {
        std::iter::once(key.to_string()).chain((0..runs.len()).map(|k| value(k, key).to_string())).collect::<Vec<_>>()
    };
    let rows: Vec<Vec<String>> = all.iter().filter(differs).map(line).collect();
    if rows.is_empty() {
        return vec![Block::Text("The scenes are the same.".into())];
    }
    let head = std::iter::once("key".to_string()).chain(names.iter().cloned()).collect();
    vec![Block::Table(Table { title: "Keys of the scenes as run".into(), head, rows })]
}

/// Keys and values of a TOML text, each with its path.
fn keys(text: &str) -> Vec<(String, String)> {
    fn walk(path: &str, value: &toml::Value, found: &mut Vec<(String, String)>) {
        let below = |key: &str| if path.is_empty() { key.to_string() } else { format!("{path}.{key}") };
        match value {
            toml::Value::Table(table) => table.iter().for_each(|(key, value)| walk(&below(key), value, found)),
            toml::Value::Array(items) if items.iter().any(toml::Value::is_table) => {
                items.iter().enumerate().for_each(|(k, value)| walk(&below(&k.to_string()), value, found));
            }
            other => found.push((path.to_string(), other.to_string())),
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
    fn keys_have_paths_and_units_their_prefix() {
        let found = keys("a = 1\n[b]\nc = \"x\"\n[[d]]\ne = [1.0, 2.0]\n");
        let expected = [("a", "1"), ("b.c", "\"x\""), ("d.0.e", "[1.0, 2.0]")];
        assert_eq!(found, expected.map(|(key, value)| (key.to_string(), value.to_string())));
        assert_eq!(["[kN/m]", "[Pa]", "time [ms]", "[MPa]", "[m]"].map(prefix), [1e3, 1.0, 1e-3, 1e6, 1.0]);
    }
}
