//! The theories of a scene in its report: their curves, their range and error.

use run::model_hierarchy::{Assessment, Theory, assess};
use run::observers::columns;
use scene::{QuantityOfInterest, Scene};
use water_entry::EntryModel;

use super::quantity::percent;
use crate::{Block, Curve, Mark, Paint, Table};

/// Points of a pressure profile.
const PROFILE: usize = 400;

/// A theory that holds for a scene, as far as it holds.
struct Followed {
    model: EntryModel,
    theory: Theory,
    rows: Vec<Vec<f64>>,
}

/// The theories that hold for a scene.
pub(super) struct Theories {
    followed: Vec<Followed>,
    columns: Vec<String>,
}

impl Theories {
    /// All formulae but the one that was run, up to when the first of them has the chines wet: beyond, the flow separates.
    pub fn beside(scene: &Scene) -> Theories {
        let theories = EntryModel::ALL.into_iter().filter(|model| model.is_formula());
        let follow = |model| {
            let (theory, _) = Theory::while_in_range(scene, model).ok()?;
            let rows = theory.rows(scene);
            Some(Followed { model, theory, rows })
        };
        let mut followed: Vec<Followed> = theories.filter_map(follow).collect();
        let dry = |f: &Followed| {
            let chines = f.theory.section.half_breadth();
            let wet = f.theory.instants.iter().find(|now| now.wetted >= chines);
            wet.map_or(f64::INFINITY, |now| now.time)
        };
        let end = followed.iter().map(dry).fold(f64::INFINITY, f64::min);
        followed.iter_mut().for_each(|f| f.rows.retain(|row| row[0] < end));
        followed.retain(|f| f.model != scene.model && f.rows.len() > 1);
        Theories { followed, columns: columns(scene) }
    }

    /// No theory.
    pub fn none() -> Theories {
        Theories { followed: Vec::new(), columns: Vec::new() }
    }

    /// Their values of a column of the series; times and values by their scales.
    pub fn curves(&self, column: &str, scales: [f64; 2]) -> Vec<Curve> {
        let Some(k) = self.columns.iter().position(|c| c == column) else { return Vec::new() };
        let known = |f: &&Followed| f.rows.iter().all(|row| row.get(k).is_some_and(|v| v.is_finite()));
        let points =
            |f: &Followed| f.rows.iter().map(|row| [scales[0] * row[0], scales[1] * row[k]]).collect::<Vec<_>>();
        self.followed.iter().filter(known).map(|f| curve(f.model, points(f))).collect()
    }

    /// Their pressure coefficients along the face, at their last moments, but for that of the similarity solution.
    pub fn profiles(&self) -> Vec<Curve> {
        let drawn = |Followed { model, theory, rows }: &Followed| {
            let last = theory.instants.len().checked_sub(1).filter(|last| *last < rows.len())?;
            theory.peak_pressure(last)?; // infinite, or none: not to be drawn
            Some(curve(*model, theory.profile(last, PROFILE)))
        };
        self.followed.iter().filter(|f| f.model != EntryModel::Similarity).filter_map(drawn).collect()
    }
}

/// A curve of a theory, in the colour that it has on every chart.
pub(super) fn curve(model: EntryModel, points: Vec<[f64; 2]>) -> Curve {
    let colour = match model {
        EntryModel::VonKarman => [0, 158, 115],
        EntryModel::Wagner => [204, 121, 167],
        EntryModel::Mlm => [230, 159, 0],
        _ => [86, 180, 233],
    };
    Curve::new(in_words(model), Mark::Dashed, points).painted(Paint { colour: Some(colour), ..Paint::default() })
}

/// A model's name as papers have it.
fn in_words(model: EntryModel) -> &'static str {
    match model {
        EntryModel::VonKarman => "von Karman",
        EntryModel::Wagner => "Wagner",
        EntryModel::Mlm => "modified Logvinovich",
        EntryModel::Similarity => "similarity solution",
        EntryModel::BoundaryElement => "boundary elements",
        EntryModel::Wcsph => "weakly compressible SPH",
        EntryModel::Incompressible => "incompressible SPH",
    }
}

/// A model of `summary.json` in words.
pub(super) fn model_in_words(name: &str) -> &str {
    EntryModel::ALL.into_iter().find(|model| model.name() == name).map_or(name, |model| in_words(model))
}

/// Range and measured error of every theory; sentences where no error is known.
pub(super) fn theories_section(scene: &Scene) -> Vec<Block> {
    let all = assess(scene, QuantityOfInterest::PeakForce);
    let obstacle_or_case = |a: &Assessment| {
        let case = || a.measured.as_ref().map(|m| m.case.clone());
        a.obstacle.clone().or_else(case).unwrap_or("measured nowhere near this scene".into())
    };
    let why = scene.choice.iter().map(|why| Block::Text(format!("Model chosen: {why}.")));
    let shown = match all.iter().any(|a| a.measured.is_some()) {
        false => {
            let mut reasons: Vec<(String, Vec<&str>)> = Vec::new();
            for a in &all {
                let reason = obstacle_or_case(a);
                match reasons.iter_mut().find(|(known, _)| *known == reason) {
                    Some((_, names)) => names.push(in_words(a.model)),
                    None => reasons.push((reason, vec![in_words(a.model)])),
                }
            }
            let each = |(reason, names): &(String, Vec<&str>)| format!("{}: {reason}.", names.join(", "));
            let words = reasons.iter().map(each).collect::<Vec<_>>().join(" ");
            Block::Text(format!("No theory of entry has a known error here. {words}"))
        }
        true => Block::Table(Table::of(
            "Theories of this entry",
            all,
            &[
                ("theory", |a| in_words(a.model).to_string()),
                ("error of the largest force", |a| {
                    a.measured.as_ref().map_or("not known".to_string(), |m| percent(m.error))
                }),
                ("measured where, or why not", obstacle_or_case),
            ],
        )),
    };
    why.chain([shown]).collect()
}
