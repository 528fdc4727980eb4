//! The theories of a scene in its report: their curves, their range and error.

use fsi_coupling::entry_theory::EntryModel;

use crate::model_hierarchy::{Assessment, QuantityOfInterest, Theory, assess};
use crate::observers::columns;
use crate::report::{Block, Curve, Mark, Table};
use crate::scene::Scene;

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
    /// All but the one that was run, up to when the first of them has the chines wet: beyond, the flow separates.
    pub fn beside(scene: &Scene) -> Theories {
        let theories = EntryModel::ALL.into_iter().filter(|model| model.is_theory());
        let follow = |model| {
            let (theory, _) = Theory::while_in_range(scene, model).ok()?;
            let rows = theory.rows(scene);
            Some(Followed { model, theory, rows })
        };
        let mut followed: Vec<Followed> = theories.filter_map(follow).collect();
        let dry = |f: &Followed| {
            let chines = f.theory.loads.section().half_breadth();
            let wet = f.theory.instants.iter().find(|now| now.wetted >= chines);
            wet.map_or(f64::INFINITY, |now| now.time)
        };
        let end = followed.iter().map(dry).fold(f64::INFINITY, f64::min);
        followed.iter_mut().for_each(|f| f.rows.retain(|row| row[0] < end));
        followed.retain(|f| f.model != scene.model && f.rows.len() > 1);
        Theories { followed, columns: columns(scene) }
    }

    /// Their values of a column of the series; times and values by their scales.
    pub fn curves(&self, column: &str, scales: [f64; 2]) -> Vec<Curve> {
        let Some(k) = self.columns.iter().position(|c| c == column) else { return Vec::new() };
        let known = |f: &&Followed| f.rows.iter().all(|row| row.get(k).is_some_and(|v| v.is_finite()));
        let points =
            |f: &Followed| f.rows.iter().map(|row| [scales[0] * row[0], scales[1] * row[k]]).collect::<Vec<_>>();
        self.followed.iter().filter(known).map(|f| Curve::new(in_words(f.model), Mark::Dashed, points(f))).collect()
    }

    /// Their pressure coefficients along the face, at their last moments.
    pub fn profiles(&self) -> Vec<Curve> {
        let curve = |Followed { model, theory, rows }: &Followed| {
            let last = theory.instants.len().checked_sub(1).filter(|last| *last < rows.len())?;
            theory.peak_pressure(last)?; // infinite, or none: not to be drawn
            Some(Curve::new(in_words(*model), Mark::Dashed, theory.profile(last, PROFILE)))
        };
        self.followed.iter().filter_map(curve).collect()
    }
}

/// A theory's name as papers have it.
fn in_words(model: EntryModel) -> &'static str {
    match model {
        EntryModel::VonKarman => "von Karman",
        EntryModel::Wagner => "Wagner",
        EntryModel::Mlm => "modified Logvinovich",
        EntryModel::Similarity => "similarity solution",
        other => other.name(),
    }
}

/// Range and measured error of every theory.
pub(super) fn theories_section(scene: &Scene) -> Vec<Block> {
    let obstacle_or_case = |a: &Assessment| {
        let case = || a.measured.as_ref().map(|m| m.case.clone());
        a.obstacle.clone().or_else(case).unwrap_or("measured nowhere near this scene".into())
    };
    let table = Table::of(
        "Theories of this entry",
        assess(scene, QuantityOfInterest::PeakForce),
        &[
            ("theory", |a| a.model.name().to_string()),
            ("error of the largest force [%]", |a| {
                a.measured.as_ref().map_or(String::new(), |m| format!("{:.2}", 100.0 * m.error))
            }),
            ("measured where, or why not", obstacle_or_case),
        ],
    );
    let why = scene.choice.iter().map(|why| Block::Text(format!("Model chosen: {why}.")));
    why.chain([Block::Table(table)]).collect()
}
