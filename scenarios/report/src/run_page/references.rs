//! What a run is compared with: names of references, and the table of comparisons.

use scene::reference::Table as ReferenceTable;
use scene::vocabulary::{ColumnTitle, ResultId, ResultName, column_title};
use scene::{Compare, Norm};

use super::folder::RunFolder;
use super::quantity::{Unit, digits, percent, with_unit};
use super::record::Comparison;
use crate::{Block, Table};

/// Kinds of references by words of their file names.
const KINDS: [(&str, &str); 6] =
    [("exp", "experiment"), ("bem", "BEM"), ("sph", "SPH"), ("isph", "ISPH"), ("mps", "MPS"), ("pfem", "PFEM")];
/// The column of the verdict.
const VERDICT: usize = 6;
/// A longer list of authors is cut [letters].
const LONGEST: usize = 32;

/// A reference in words: authors, year and kind, as far as its file says them.
pub(super) fn name(path: &str) -> String {
    let stem = path.rsplit('/').next().unwrap_or(path).trim_end_matches(".csv");
    let words: Vec<&str> = stem.split('_').collect();
    let Some(who) = words.iter().find_map(|word| dated(word)).or_else(|| paper(path)) else {
        return stem.replace('_', " ");
    };
    let kind = |word: &&str| {
        let known = KINDS.iter().find(|(short, _)| short == word).map(|(_, long)| long.to_string());
        let place =
            word.len() <= 2 && word.to_uppercase() == **word && word.starts_with(|c: char| c.is_ascii_uppercase());
        known.or_else(|| place.then(|| word.to_string()))
    };
    std::iter::once(who).chain(words.iter().filter_map(kind)).collect::<Vec<_>>().join(", ")
}

/// An author with a year, such as `yettou2006`.
fn dated(word: &str) -> Option<String> {
    let (author, year) = word.split_at_checked(word.len().checked_sub(4)?)?;
    let first = author.chars().next().filter(|_| author.chars().all(|c| c.is_ascii_alphabetic()))?;
    is_year(year).then(|| format!("{}{} {year}", first.to_ascii_uppercase(), &author[1..]))
}

fn is_year(text: &str) -> bool {
    text.len() == 4 && text.parse::<u32>().is_ok_and(|year| (1900..2100).contains(&year))
}

/// Authors and year of the paper that the header of a table names.
fn paper(path: &str) -> Option<String> {
    let table = ReferenceTable::load(path).ok()?;
    let source = table.about.iter().find_map(|line| line.trim().strip_prefix("source paper:"))?.trim();
    let (at, year) = (0..source.len()).find_map(|k| Some((k, source.get(k..k + 4).filter(|text| is_year(text))?)))?;
    let authors = source[..at].trim_end_matches([' ', ',', '(']);
    match authors.chars().count() > LONGEST {
        true => Some(format!("{} et al. {year}", authors.split([',', '&']).next()?.trim())),
        false => Some(format!("{authors} {year}")),
    }
}

/// Comparisons with references, and those that the run does not reach; nothing without any.
pub(super) fn section(run: &RunFolder) -> Vec<Block> {
    let mut asked: Vec<&Compare> = run.scene.compare.iter().collect();
    let mut rows = Vec::new();
    for made in &run.record.comparison {
        let is_it = |asked: &&Compare| asked.reference == made.reference && quantity(asked) == made.quantity;
        let found = asked.iter().position(is_it).map(|k| asked.remove(k));
        let mut cells = found.map_or_else(|| of_similarity(made), |asked| of_curve(run, asked, made));
        let within = made.error.zip(made.tolerance).map(|(error, tolerance)| error.abs() <= tolerance);
        let verdict = match (made.tolerance, within) {
            (None, _) => "not\u{a0}judged",
            (Some(_), Some(true)) => "within",
            _ => "outside",
        };
        cells.insert(VERDICT, verdict.into());
        rows.push(cells);
    }
    let missing = run.record.not_compared.iter().map(|why| Block::Text(format!("Not compared: {why}.")));
    if rows.is_empty() {
        return missing.collect();
    }
    let about = "Errors are ours minus theirs; rms differences have no sign. A largest sample is a single value of series.csv within the \
                 times compared: the peaks among the results are means, and a gauge's peak is the largest of every step of the run.";
    let head =
        ["quantity", "measure", "ours", "theirs", "error", "tolerance", "verdict", "times compared", "reference"];
    let table = Table::new("Errors against references", &head, rows);
    let about = (!run.scene.compare.is_empty()).then(|| Block::Text(about.into()));
    about.into_iter().chain([Block::Table(table)]).chain(missing).collect()
}

/// How the summary names a comparison.
fn quantity(asked: &Compare) -> String {
    let name = &asked.quantity;
    match asked.norm {
        Norm::Arrival => format!("{name}, arrival [s]"),
        Norm::Impulse => format!("{name}, impulse"),
        Norm::Peak => format!("{name}, peak"),
        Norm::Period => format!("{name}, period [s]"),
        _ => name.clone(),
    }
}

/// A column in words, with its place.
pub(super) fn in_full(column: &ColumnTitle) -> String {
    match column.part.as_str() {
        "" => column.title.clone(),
        gauge if column.title == "Pressure at the gauges" => format!("Pressure at {gauge}"),
        part => format!("{}, {part}", column.title),
    }
}

/// The cells of a comparison with a curve, but for the verdict.
fn of_curve(run: &RunFolder, asked: &Compare, made: &Comparison) -> Vec<String> {
    let column = column_title(&asked.quantity);
    // a factor other than a sign makes the numbers dimensionless
    let plain = asked.scale.abs() == 1.0;
    let (si, scale) = if plain { (column.si, column.scale) } else { ("-", 1.0) };
    let over_time = if plain { format!("{si} s") } else { "s".to_string() };
    let over_time = over_time.replace("N/m s", "N s/m");
    let (measure, si, scale) = match asked.norm {
        Norm::Arrival => ("time of arrival", "s", 1.0),
        Norm::Period => ("period", "s", 1.0),
        Norm::Impulse => ("integral over time", over_time.as_str(), scale),
        Norm::Peak => ("largest sample", si, scale),
        Norm::Rms => ("means; rms difference", si, scale),
        Norm::RmsOverFirst => ("means; rms difference over the first value", si, scale),
        Norm::RmsOverPeak => ("means; rms difference over the peak", si, scale),
        Norm::Max => ("means; largest difference", si, scale),
    };
    let shown = |value: Option<f64>| value.map_or("–".into(), |v| with_unit(scale * v, si));
    let absolute = matches!(asked.norm, Norm::Rms | Norm::Max);
    let signed = matches!(asked.norm, Norm::Arrival | Norm::Period | Norm::Impulse | Norm::Peak);
    let size = |value: f64| if absolute { with_unit(scale.abs() * value, si) } else { percent(value) };
    let error = match made.ours.zip(made.theirs).filter(|_| signed) {
        Some((ours, theirs)) if theirs != 0.0 => Some((ours - theirs) / theirs.abs()),
        _ => made.error,
    };
    let end = run.record.time_end_s.unwrap_or(f64::INFINITY);
    let [from, to] = [asked.window[0], asked.window[1].min(end)];
    let unit = Unit::of("s", to);
    vec![
        in_full(&column),
        measure.into(),
        shown(made.ours),
        shown(made.theirs),
        error.map_or("–".into(), size),
        made.tolerance.map_or("–".into(), |tolerance| format!("± {}", size(tolerance))),
        format!("{} to {}\u{a0}{}", digits(unit.scale * from), digits(unit.scale * to), unit.name),
        name(&made.reference),
    ]
}

/// The cells of a comparison with the similarity solution, but for the verdict.
fn of_similarity(made: &Comparison) -> Vec<String> {
    let number = |value: Option<f64>| value.map_or("–".into(), digits);
    vec![
        in_words(&made.quantity),
        "mean".into(),
        number(made.ours),
        number(made.theirs),
        made.error.map_or("–".into(), percent),
        made.tolerance.map_or("–".into(), |tolerance| format!("± {}", percent(tolerance))),
        "last fifth of the run".into(),
        "similarity solution".into(),
    ]
}

/// A number of `summary.json`, by its path, in words.
pub fn in_words(path: &str) -> String {
    match path.replace('/', ".").as_str() {
        "similarity.force_coefficient" => "Force coefficient".into(),
        "similarity.impulse_coefficient" => "Impulse coefficient".into(),
        "similarity.cp_max" => "Largest pressure coefficient".into(),
        "similarity.profile_error" => "Error of the pressure profile".into(),
        "similarity.cp_noise" => "Noise of the pressure coefficient".into(),
        other => {
            let result =
                other.strip_prefix("results.").and_then(|rest| rest.strip_suffix(".value")).and_then(ResultName::of);
            result.map_or(path.into(), |name| format!("{} [{}]", ResultId { panel: None, name }.title(), name.si()))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn references_have_authors_and_years() {
        let known = [
            ("external/wedge25_yettou2006_velocity_exp.csv", "Yettou 2006, experiment"),
            ("external/dambreak_buchner_pressure_trixi_P1.csv", "Buchner 2002, P1"),
            ("external/dambreak_decourcy_P2.csv", "De Courcy et al. 2024, P2"),
            ("external/cylinder_entry_rho500_bem.csv", "P. Sun et al. 2018, BEM"),
            ("mine/drop_of_monday.csv", "drop of monday"),
        ];
        for (path, words) in known {
            assert_eq!(name(path), words);
        }
    }
}
