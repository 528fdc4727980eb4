//! The loads on the panels of a run: over time and along each panel, as tables.

use std::io;
use std::path::Path;

use serde_json::Value;

use super::structure::PanelModel;
use crate::data_table::DataTable;

/// The fluid's loads on the nodes of a panel, in the axes of the body's frame.
pub(super) struct PanelLoads<'a> {
    /// The panel.
    pub model: PanelModel<'a>,
    /// Times of the run [s].
    pub times: Vec<f64>,
    /// `[times][nodes][F_x, F_y, M]` [N/m, N/m, N].
    pub loads: Vec<Vec<[f64; 3]>>,
    /// Extremes along it from `summary.json`, where it has them.
    pub envelope: Option<Value>,
}

/// Largest and smallest value with their times [s].
pub(super) struct Extremes {
    pub least: (f64, f64),
    pub most: (f64, f64),
}

impl PanelLoads<'_> {
    /// Pressure at a node over time [Pa].
    pub fn pressures(&self, node: usize) -> Vec<f64> {
        self.loads.iter().map(|loads| self.model.pressure(node, [loads[node][0], loads[node][1]])).collect()
    }

    /// Extremes of the pressure at a node over the samples.
    pub fn extremes(&self, node: usize) -> Extremes {
        let each = || self.pressures(node).into_iter().zip(self.times.iter().copied());
        let by = |a: &(f64, f64), b: &(f64, f64)| a.0.total_cmp(&b.0);
        let none = (0.0, 0.0);
        Extremes { least: each().min_by(by).unwrap_or(none), most: each().max_by(by).unwrap_or(none) }
    }

    /// The sample with the largest force on the panel to one side, and that force [N/m].
    pub fn largest(&self) -> Option<(usize, f64)> {
        let nodes = 0..self.model.nodes.len();
        let force = |loads: &Vec<[f64; 3]>| {
            let of =
                |node: usize| self.model.tributary(node) * self.model.pressure(node, [loads[node][0], loads[node][1]]);
            nodes.clone().map(of).sum::<f64>()
        };
        self.loads.iter().map(force).enumerate().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
    }

    /// Write its tables.
    pub fn write_tables(&self, folder: &Path) -> io::Result<()> {
        let file = |what: &str| folder.join(format!("{}_{what}.csv", self.model.panel.name));
        std::fs::write(file("pressure"), self.over_time_and_place().to_csv())?;
        std::fs::write(file("nodes"), self.over_time().to_csv())?;
        std::fs::write(file("stations"), self.along().to_csv())
    }

    fn times(&self) -> DataTable {
        let mut table = DataTable::default();
        table.numbers("time_s", self.times.iter().map(|time| Some(*time)));
        table
    }

    /// Pressure: a row per sample, a column per node.
    fn over_time_and_place(&self) -> DataTable {
        let mut table = self.times();
        for node in 0..self.model.nodes.len() {
            let name = format!("p_Pa_at_{:.6}_m", self.model.along(node));
            table.numbers(name, self.pressures(node).into_iter().map(Some));
        }
        table
    }

    /// Forces and moments on the nodes: a row per sample.
    fn over_time(&self) -> DataTable {
        let mut table = self.times();
        for (k, name) in run::observers::load_names(self.model.nodes.len()).into_iter().enumerate() {
            table.numbers(name, self.loads.iter().map(|loads| Some(loads[k / 3][k % 3])));
        }
        table
    }

    /// Places of the nodes, extremes of the pressure over the samples, and of what `summary.json` has over the steps.
    fn along(&self) -> DataTable {
        let model = &self.model;
        let nodes = 0..model.nodes.len();
        let extremes: Vec<Extremes> = nodes.clone().map(|node| self.extremes(node)).collect();
        let mut table = DataTable::default();
        table.wholes("node", nodes.clone().map(|node| Some(node + 1)));
        table.numbers("along_m", nodes.clone().map(|node| Some(model.along(node))));
        table.numbers("x_m", model.nodes.iter().map(|at| Some(at[0])));
        table.numbers("y_m", model.nodes.iter().map(|at| Some(at[1])));
        table.numbers("tributary_m", nodes.clone().map(|node| Some(model.tributary(node))));
        table.numbers("p_least_Pa", extremes.iter().map(|e| Some(e.least.0)));
        table.numbers("p_least_at_s", extremes.iter().map(|e| Some(e.least.1)));
        table.numbers("p_most_Pa", extremes.iter().map(|e| Some(e.most.0)));
        table.numbers("p_most_at_s", extremes.iter().map(|e| Some(e.most.1)));
        for (key, name, unit) in [
            ("normal_n_per_m", "normal", "N_per_m"),
            ("shear_n_per_m", "shear", "N_per_m"),
            ("moment_n", "moment", "N"),
            ("stress_pa", "stress", "Pa"),
        ] {
            let Some(envelope) = self.envelope.as_ref().and_then(|all| all.get(key)) else { continue };
            for side in ["least", "most"] {
                let value = |key: &str, node: usize| envelope.get(node).and_then(|range| range.get(key)?.as_f64());
                table.numbers(format!("{name}_{side}_{unit}"), nodes.clone().map(|node| value(side, node)));
                let time = format!("{side}_at_s");
                table.numbers(format!("{name}_{side}_at_s"), nodes.clone().map(|node| value(&time, node)));
            }
        }
        table
    }
}
