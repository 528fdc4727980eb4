//! What the rules state, and what of it a list of landings answers: the files in `scenarios/rules`.

use std::sync::LazyLock;

use serde::{Deserialize, Serialize};
use settings::significant;
use water_entry::EntryModel;
use water_entry::rules::{FOOT, KNOT};

use crate::ditching::{RuleKey, Scene};

/// A rule.
#[derive(Clone, Debug, Deserialize)]
pub struct Rule {
    /// Its name.
    pub title: String,
    /// Speeds downwards that it states.
    pub sink: Option<Sinks>,
    /// Forward speeds that it states.
    pub forward: Option<Forwards>,
    /// Its paragraphs.
    pub paragraphs: Vec<Paragraph>,
}

/// Speeds downwards of a rule.
#[derive(Clone, Debug, Deserialize)]
pub struct Sinks {
    /// The paragraph that states them.
    pub paragraph: String,
    feet_per_second: Vec<f64>,
}

/// Forward speeds of a rule.
#[derive(Clone, Debug, Deserialize)]
pub struct Forwards {
    /// The paragraph that states them.
    pub paragraph: String,
    knots: Vec<f64>,
}

impl Sinks {
    /// In m/s.
    pub fn speeds(&self) -> Vec<f64> {
        self.feet_per_second.iter().map(|v| v * FOOT).collect()
    }
}

impl Forwards {
    /// In m/s.
    pub fn speeds(&self) -> Vec<f64> {
        self.knots.iter().map(|v| v * KNOT).collect()
    }
}

/// A paragraph of a rule.
#[derive(Clone, Debug, Deserialize)]
pub struct Paragraph {
    /// Its number.
    pub id: String,
    /// What it asks for, shortened.
    pub asks: String,
    needs: Needs,
    gives: String,
    open: String,
}

/// What must have been computed for an answer to a paragraph.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Needs {
    /// No computation answers it.
    Nothing,
    /// A landing that completed.
    Landings,
    /// One on waves.
    Waves,
    /// Flotation.
    Flotation,
    /// Pressures of windows.
    Windows,
}

/// What the cases have of a paragraph.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Answer {
    /// The paragraph.
    pub paragraph: String,
    /// What it asks for, shortened.
    pub asks: String,
    /// "answered in part" or "not answered".
    pub answer: &'static str,
    /// What the dossier gives for it; empty for nothing.
    pub gives: String,
    /// What it asks for and the dossier does not give.
    pub not_given: String,
}

/// The answer to a paragraph that has none.
pub const NOT_ANSWERED: &str = "not answered";

/// What there is to answer with.
#[derive(Clone, Copy, Debug, Default)]
pub struct Computed {
    /// Number of landings that completed.
    pub landings: usize,
    /// Number of them on waves.
    pub on_waves: usize,
    /// Largest speed downwards of them [m/s].
    pub sink: f64,
    /// Largest forward speed of them [m/s].
    pub forward: f64,
}

/// Relative distance below a stated speed that still counts as reached [-].
const REACHED: f64 = 1e-3;

impl Paragraph {
    /// The answer by what was computed for a scene.
    fn answer(&self, scene: &Scene, computed: Computed) -> Answer {
        let missing = match self.needs {
            Needs::Nothing => Some("no computation of this program answers it"),
            _ if computed.landings == 0 => Some("no landing of the list completed"),
            Needs::Landings => None,
            Needs::Waves if computed.on_waves == 0 => Some("no landing on waves completed"),
            Needs::Flotation if scene.flotation.is_none() && scene.openings.is_empty() => {
                Some("the file has neither [flotation] nor [[openings]]")
            }
            Needs::Windows if scene.model == EntryModel::VonKarman => Some("the model has no pressures"),
            Needs::Windows if scene.windows.is_empty() => {
                Some("the file has no [[windows]]: only the cells of the bottom")
            }
            Needs::Waves | Needs::Flotation | Needs::Windows => None,
        };
        let (answer, gives, not_given) = match missing {
            None => ("answered in part", self.gives.clone(), self.open.clone()),
            Some(why) => (NOT_ANSWERED, String::new(), format!("{}: {why}.", self.open.trim_end_matches('.'))),
        };
        Answer { paragraph: self.id.clone(), asks: self.asks.clone(), answer, gives, not_given }
    }
}

impl Rule {
    /// The answers to its paragraphs by what was computed for a scene. Speeds that it states and no landing had are not answered.
    pub fn answers(&self, scene: &Scene, computed: Computed) -> Vec<Answer> {
        let states =
            |stated: Option<&String>, answer: &Answer| stated == Some(&answer.paragraph) && computed.landings > 0;
        let least_sink = self.sink.iter().flat_map(Sinks::speeds).fold(f64::INFINITY, f64::min);
        let most_forward = self.forward.iter().flat_map(Forwards::speeds).fold(0.0, f64::max);
        let short = |own: f64, stated: f64| own < (1.0 - REACHED) * stated;
        let with_speeds = |mut answer: Answer| {
            if states(self.sink.as_ref().map(|of| &of.paragraph), &answer) && short(computed.sink, least_sink) {
                let [own, stated] = [computed.sink, least_sink].map(significant);
                let why = format!(
                    "No landing that completed has the {stated} m/s downwards that it states: {own} m/s at most."
                );
                answer.not_given = format!("{why} {}", answer.not_given);
                (answer.answer, answer.gives) = (NOT_ANSWERED, String::new());
            }
            if states(self.forward.as_ref().map(|of| &of.paragraph), &answer) && short(computed.forward, most_forward) {
                let [own, stated] = [computed.forward, most_forward].map(significant);
                let why = format!(
                    "Forward speeds to the {stated} m/s that it states: landings that completed have {own} m/s at most."
                );
                answer.not_given = format!("{why} {}", answer.not_given);
            }
            answer
        };
        self.paragraphs.iter().map(|paragraph| with_speeds(paragraph.answer(scene, computed))).collect()
    }

    /// The rule of a key.
    pub fn of(key: RuleKey) -> &'static Rule {
        static RULES: LazyLock<[Rule; 3]> = LazyLock::new(|| {
            let texts = [
                include_str!("../../rules/25.801.toml"),
                include_str!("../../rules/29.563.toml"),
                include_str!("../../rules/29.519.toml"),
            ];
            texts.map(|text| toml::from_str(text).expect("the program's own files are rules"))
        });
        &RULES[key as usize]
    }
}

/// A row of the evidence: computed over measured.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Evidence {
    /// What was compared.
    pub quantity: String,
    /// Number of points and of cases.
    pub points: String,
    /// The same of cases.
    pub cases: String,
    /// Mean of computed over measured [-].
    pub bias: String,
    /// Relative standard deviation of it.
    pub scatter: String,
    /// The worst error and its case.
    pub worst: String,
    /// A true value is below a computed one times this at 95 % [-].
    pub factor: String,
}

/// What is known of the errors of landings, from `docs/src/validation/quantities.md`.
pub fn evidence() -> Vec<Evidence> {
    let rows = include_str!("../../rules/evidence.csv").lines().filter(|line| !line.starts_with('#')).skip(1);
    let row = |line: &str| {
        let mut cells = line.split(',').map(str::to_string);
        let mut next = || cells.next().unwrap_or_default();
        Evidence {
            quantity: next(),
            points: next(),
            cases: next(),
            bias: next(),
            scatter: next(),
            worst: next(),
            factor: next(),
        }
    };
    rows.map(row).collect()
}

#[cfg(test)]
mod tests {
    use water_entry::rules::{DITCHING_FORWARD, DITCHING_VERTICAL};

    use super::*;

    #[test]
    fn speeds_of_the_rules_are_those_of_their_units() {
        let rule = Rule::of(RuleKey::Rotorcraft);
        assert_eq!(rule.sink.as_ref().map(Sinks::speeds), Some(vec![DITCHING_VERTICAL]));
        let forward = rule.forward.as_ref().map(Forwards::speeds).unwrap_or_default();
        assert_eq!(forward.last(), Some(&DITCHING_FORWARD));
        assert!(
            Rule::of(RuleKey::Aeroplane).sink.is_none() && Rule::of(RuleKey::HullRotorcraft).title.contains("29.519")
        );
        let hull = Rule::of(RuleKey::HullRotorcraft).sink.as_ref().map(Sinks::speeds).unwrap_or_default();
        assert!((hull[0] - 1.9812).abs() < 1e-12);
    }

    #[test]
    fn an_answer_needs_what_was_computed() -> Result<(), scene::SceneError> {
        let scene = crate::ditching::load("mercure", &[])?;
        let answers = |computed: Computed| {
            let answers = Rule::of(RuleKey::Aeroplane).answers(&scene, computed);
            answers.iter().map(|answer| answer.answer).collect::<Vec<_>>()
        };
        let not = "not answered";
        let in_part = "answered in part";
        assert_eq!(answers(Computed::default()), [not; 6]);
        let one = Computed { landings: 1, ..Computed::default() };
        assert_eq!(answers(one), [not, in_part, in_part, not, not, not]);

        // the sink speed that the rule states, and its forward speeds
        let of_sink = |sink: f64, forward: f64| {
            let computed = Computed { landings: 9, on_waves: 9, sink, forward };
            Rule::of(RuleKey::Rotorcraft).answers(&scene, computed).swap_remove(0)
        };
        let [slow, fast] = [of_sink(1.5, 30.0), of_sink(1.524, 10.0)];
        assert_eq!((slow.answer, slow.gives.as_str()), (not, ""));
        assert!(slow.not_given.contains("1.524 m/s downwards that it states: 1.5 m/s at most"), "{}", slow.not_given);
        assert_eq!(fast.answer, in_part);
        assert!(fast.not_given.contains("Forward speeds to the 15.43 m/s"), "{}", fast.not_given);
        Ok(())
    }

    #[test]
    fn evidence_is_a_table_of_seven_columns() {
        let rows = evidence();
        assert!(rows.len() >= 4 && rows.iter().all(|row| row.factor.parse::<f64>().is_ok()), "{rows:?}");
    }
}
