//! Doubts and warnings in sentences for the page.

use scene::vocabulary::{Doubt, ResultId, Shallow};

use super::folder::RunFolder;
use super::quantity::{digits, with_unit};
use crate::markup::escape;

/// A doubt with the names of its results in words.
pub fn in_words(doubt: &Doubt) -> String {
    if doubt.about.is_empty() { doubt.why.text.clone() } else { format!("{}: {}", named(&doubt.about), doubt.why.text) }
}

/// Names of results, as a doubt lists them, in words.
fn named(names: &[String]) -> String {
    let word = |(k, name): (usize, &String)| {
        let words = match name.strip_prefix("audit.") {
            Some(part) => Some(format!("Audit of {part}")),
            None => ResultId::of(name).map(|id| id.title()),
        };
        match words {
            Some(words) if k > 0 => lower(&words),
            words => words.unwrap_or_else(|| name.clone()),
        }
    };
    names.iter().enumerate().map(word).collect::<Vec<_>>().join(", ")
}

/// Words within a sentence: with a small first letter.
pub(super) fn lower(words: &str) -> String {
    let mut letters = words.chars();
    letters.next().map_or(String::new(), |first| first.to_lowercase().chain(letters).collect())
}

/// Doubts in words; those that differ only in how small a draught is become one.
pub(super) fn merged<'a>(doubts: impl Iterator<Item = &'a Doubt>) -> Vec<String> {
    let mut groups: Vec<Vec<&Doubt>> = Vec::new();
    let cure = |doubt: &'a Doubt| doubt.why.shallow.as_ref().map(|shallow| &shallow.cure);
    for doubt in doubts {
        match groups.iter_mut().find(|group| cure(doubt).is_some() && cure(group[0]) == cure(doubt)) {
            Some(group) => group.push(doubt),
            None => groups.push(vec![doubt]),
        }
    }
    groups.iter().map(|group| sentence(group)).collect()
}

/// Doubts with the same cure, in one sentence.
fn sentence(group: &[&Doubt]) -> String {
    let shallow: Vec<&Shallow> = group.iter().filter_map(|doubt| doubt.why.shallow.as_ref()).collect();
    let [first, _, ..] = &shallow[..] else { return in_words(group[0]) };
    let spacings = || shallow.iter().map(|shallow| shallow.draught_spacings);
    let (least, most) = (digits(spacings().fold(f64::INFINITY, f64::min)), digits(spacings().fold(0.0, f64::max)));
    let range = if least == most { least } else { format!("{least} to {most}") };
    let about: Vec<String> = group.iter().flat_map(|doubt| doubt.about.clone()).collect();
    format!("{}: the draught there is {range} spacings; {}", named(&about), first.cure)
}

/// What the material of a panel above its allowable stress does in the run.
pub(super) fn of_material(run: &RunFolder, name: &str) -> Option<String> {
    let panel = run.scene.body.iter().flat_map(|body| &body.panels).find(|panel| panel.name == name)?;
    Some(match panel.yield_stress {
        Some(stress) if run.record.panels.get(name).is_some_and(|panel| panel.yielded) => {
            let stress = with_unit(stress, "Pa");
            format!(
                "{name} yielded above {stress}, by force and moment together: its strain is the result, not its stress"
            )
        }
        Some(stress) => format!("{name} did not yield, which it does above {}", with_unit(stress, "Pa")),
        None => format!(
            "{name} is elastic at any stress in this run, for it has no yield_stress: a metal that yields has less stress and bends more"
        ),
    })
}

/// Text in which words between backticks are code.
pub(super) fn html(text: &str) -> String {
    let parts = escape(text);
    let marked = |(k, part): (usize, &str)| if k % 2 == 1 { format!("<code>{part}</code>") } else { part.to_string() };
    match parts.matches('`').count() % 2 {
        0 => parts.split('`').enumerate().map(marked).collect(),
        _ => parts,
    }
}

#[cfg(test)]
mod tests {
    use scene::vocabulary::Why;

    use super::*;

    #[test]
    fn doubts_about_the_same_draught_are_one_sentence() {
        let of = |name: &str, spacings: f64| {
            let cure = "6 are needed: 0.003 m would do for resolution.spacing".to_string();
            Doubt::about(name, Why::shallow("the peak comes at a draught of", spacings, cure))
        };
        let doubts =
            [of("peak_force_N_per_m", 1.672), of("peak_acceleration_g", 2.036), Doubt::about("plate", "`x` is wrong")];
        let cure = "6 are needed: 0.003 m would do for resolution.spacing";
        let sentences = merged(doubts.iter());
        assert_eq!(
            sentences[0],
            format!("Peak force, peak acceleration: the draught there is 1.67 to 2.04 spacings; {cure}")
        );
        assert_eq!((sentences.len(), sentences[1].as_str()), (2, "plate: `x` is wrong"));
        assert_eq!(html(&sentences[1]), "plate: <code>x</code> is wrong");
        assert_eq!(
            merged(doubts[..1].iter())[0],
            format!("Peak force: the peak comes at a draught of 1.672 spacings; {cure}")
        );
    }
}
