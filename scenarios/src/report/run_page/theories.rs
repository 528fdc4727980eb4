//! The theories of a scene in its report: their curves, their range, cost and error.

use fsi_coupling::entry_theory::EntryModel;

use crate::model_hierarchy::{Assessment, QuantityOfInterest, Theory, assess};
use crate::observers::columns;
use crate::report::table::row;
use crate::report::{Block, Curve, Mark, Table};
use crate::scene::Scene;

/// Points of a pressure profile.
const PROFILE: usize = 400;

/// What the theories say that hold for a scene, each as far as it holds.
pub(super) struct Theories {
    told: Vec<(EntryModel, Theory, Vec<Vec<f64>>)>,
    columns: Vec<String>,
}

impl Theories {
    /// All but the one that was run.
    pub fn beside(scene: &Scene) -> Theories {
        let others = EntryModel::ALL.into_iter().filter(|model| model.is_theory() && *model != scene.model);
        let told = others.filter_map(|model| {
            let (theory, _) = Theory::while_in_range(scene, model).ok()?;
            let rows = theory.rows(scene);
            (rows.len() > 1).then_some((model, theory, rows))
        });
        let columns = columns(scene);
        Theories { told: told.collect(), columns }
    }

    /// What they say of a column of the series, times `scale`.
    pub fn curves(&self, column: &str, scale: f64) -> Vec<Curve> {
        let Some(k) = self.columns.iter().position(|c| c == column) else { return Vec::new() };
        let told =
            self.told.iter().filter(|(_, _, rows)| rows.iter().all(|row| row.get(k).is_some_and(|v| v.is_finite())));
        let curve = |(model, _, rows): &(EntryModel, Theory, Vec<Vec<f64>>)| Curve {
            label: model.name().into(),
            mark: Mark::Dashed,
            x: rows.iter().map(|row| row[0]).collect(),
            y: rows.iter().map(|row| scale * row[k]).collect(),
        };
        told.map(curve).collect()
    }

    /// Their pressure coefficients along the face, at their last moments.
    pub fn profiles(&self) -> Vec<Curve> {
        let curve = |(model, theory, _): &(EntryModel, Theory, Vec<Vec<f64>>)| {
            theory.peak_pressure(theory.instants.len() - 1)?; // infinite, or none: not to be drawn
            let (x, y) = theory.profile(theory.instants.len() - 1, PROFILE).into_iter().map(|p| (p[0], p[1])).unzip();
            Some(Curve { label: model.name().into(), mark: Mark::Dashed, x, y })
        };
        self.told.iter().filter_map(curve).collect()
    }
}

/// Range, cost and measured error of every theory.
pub(super) fn theories_section(scene: &Scene) -> Vec<Block> {
    let want = QuantityOfInterest::PeakForce;
    let line = |a: Assessment| {
        let cost = a.core_seconds.map_or(String::new(), |s| format!("{:.1}", 1e3 * s));
        let error = a.measured.as_ref().map_or(String::new(), |m| format!("{:.2}", 100.0 * m.error));
        let said = a.obstacle.or(a.measured.map(|m| m.case)).unwrap_or("measured nowhere near this scene".into());
        row(&[a.model.name(), &cost, &error, &said])
    };
    let head = row(&["theory", "cost [ms]", "error of the largest force [%]", "measured where, or why not"]);
    let table = Table {
        title: "Theories of this entry".into(),
        head,
        rows: assess(scene, want).into_iter().map(line).collect(),
    };
    let why = scene.choice.iter().map(|why| Block::Text(format!("Model chosen: {why}.")));
    why.chain([Block::Table(table)]).collect()
}
