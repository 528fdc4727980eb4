//! Doubts and warnings in sentences for the page.

use super::folder::RunFolder;
use super::quantity::{digits, result, with_unit};
use crate::markup::escape;

/// A doubt with the names of its results in words.
pub fn in_words(doubt: &str) -> String {
    match doubt.split_once(": ") {
        Some((names, why)) => format!("{}: {why}", named(names)),
        None => doubt.to_string(),
    }
}

/// Names of results, as a doubt lists them, in words.
fn named(names: &str) -> String {
    let word = |(k, name): (usize, &str)| {
        let words = match name.strip_prefix("audit.") {
            Some(part) => format!("Audit of {part}"),
            None => result(name).0,
        };
        let known = words != name;
        if k > 0 && known { lower(&words) } else { words }
    };
    names.split(", ").enumerate().map(word).collect::<Vec<_>>().join(", ")
}

/// Words within a sentence: with a small first letter.
pub(super) fn lower(words: &str) -> String {
    let mut letters = words.chars();
    letters.next().map_or(String::new(), |first| first.to_lowercase().chain(letters).collect())
}

/// Doubts in words; those that differ only in how small a draught is become one.
pub(super) fn merged(doubts: &[String]) -> Vec<String> {
    let mut groups: Vec<Group<'_>> = Vec::new();
    for doubt in doubts {
        let shallow = shallow(doubt);
        let known = shallow.as_ref().and_then(|new| groups.iter_mut().find(|group| group.cure == Some(new.cure)));
        match (known, shallow) {
            (Some(group), Some(new)) => {
                group.names += &format!(", {}", new.names);
                group.spacings.push(new.spacings);
            }
            (None, Some(new)) => groups.push(Group {
                doubt,
                names: new.names.to_string(),
                cure: Some(new.cure),
                spacings: vec![new.spacings],
            }),
            (_, None) => groups.push(Group { doubt, names: String::new(), cure: None, spacings: Vec::new() }),
        }
    }
    groups.iter().map(Group::sentence).collect()
}

/// Doubts that are told in one sentence.
struct Group<'a> {
    doubt: &'a str,
    names: String,
    cure: Option<&'a str>,
    spacings: Vec<f64>,
}

impl Group<'_> {
    fn sentence(&self) -> String {
        let Some(cure) = self.cure.filter(|_| self.spacings.len() > 1) else { return in_words(self.doubt) };
        let least = self.spacings.iter().copied().fold(f64::INFINITY, f64::min);
        let most = self.spacings.iter().copied().fold(0.0, f64::max);
        let names = named(&self.names);
        let (least, most) = (digits(least), digits(most));
        let range = if least == most { least } else { format!("{least} to {most}") };
        format!("{names}: the draught there is {range} spacings; {cure}")
    }
}

/// A doubt about a small draught.
struct Shallow<'a> {
    names: &'a str,
    spacings: f64,
    cure: &'a str,
}

fn shallow(doubt: &str) -> Option<Shallow<'_>> {
    let (names, why) = doubt.split_once(": ")?;
    let (what, cure) = why.split_once("; ")?;
    let spacings = what.strip_suffix(" spacings").filter(|_| what.contains("draught"))?.rsplit(' ').next()?;
    Some(Shallow { names, spacings: spacings.parse().ok()?, cure })
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
            "{name} is elastic at any stress in this run, for it has no yield_stress: a metal that yields bears less stress and bends more"
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
    use super::*;

    #[test]
    fn doubts_about_the_same_draught_are_told_once() {
        let cure = "6 are needed: 0.003 m would do for resolution.spacing";
        let doubts = [
            format!("peak_force_N_per_m: the peak comes at a draught of 1.672 spacings; {cure}"),
            format!("peak_acceleration_g: the peak comes at a draught of 2.036 spacings; {cure}"),
            "plate: `x` is wrong".to_string(),
        ];
        let told = merged(&doubts);
        assert_eq!(
            told[0],
            format!("Peak force, peak acceleration: the draught there is 1.67 to 2.04 spacings; {cure}")
        );
        assert_eq!((told.len(), told[1].as_str()), (2, "plate: `x` is wrong"));
        assert_eq!(html(&told[1]), "plate: <code>x</code> is wrong");
        assert_eq!(
            merged(&doubts[..1])[0],
            format!("Peak force: the peak comes at a draught of 1.672 spacings; {cure}")
        );
    }
}
