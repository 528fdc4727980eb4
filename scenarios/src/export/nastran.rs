//! Panels and their loads as Nastran bulk data: `NAME.bdf`, the structure; `NAME_time.bdf`, its loads over time; `NAME_peak.bdf`, static
//! loads.

use std::io;
use std::path::Path;

use scene::nastran::cards::Value::{Blank, Real, Whole, Word};
use scene::nastran::cards::{Value, comment, written};

use super::loads::PanelLoads;

/// Numbers of the sets of loads, after that of the panel: pressures, forces of an instant, loads over time; then one per load.
const PRESSURES: i64 = 1;
const FORCES: i64 = 2;
const OVER_TIME: i64 = 3;
const SINGLE: i64 = 11;

impl PanelLoads<'_> {
    /// Write its files.
    pub fn write_nastran(&self, folder: &Path) -> io::Result<()> {
        let file = |what: &str| folder.join(format!("{}{what}.bdf", self.model.panel.name));
        std::fs::write(file(""), self.model.beam_model().written())?;
        std::fs::write(file("_time"), self.time_cards())?;
        std::fs::write(file("_peak"), self.peak_cards())
    }

    /// The last sample before any load, or the first one.
    fn first_loaded(&self) -> usize {
        let loaded = |loads: &Vec<[f64; 3]>| loads.as_flattened().iter().any(|value| *value != 0.0);
        self.loads.iter().position(loaded).unwrap_or(0).saturating_sub(1)
    }

    fn heading(&self, what: &str, lines: &[String]) -> String {
        let heading = self.model.heading(what);
        heading.iter().chain(lines).map(|line| comment(line)).collect()
    }

    /// Forces and moments on the nodes over time: a table, an area and a load for each that is not zero throughout.
    fn time_cards(&self) -> String {
        let (set, first) = (self.model.base + OVER_TIME, self.first_loaded());
        let begin = self.times.get(first).copied().unwrap_or(0.0);
        let times: Vec<f64> = self.times[first..].iter().map(|time| time - begin).collect();
        let last = times.last().copied().unwrap_or(0.0);
        let mut text = self.heading(
            "loads over time",
            &[
                format!(
                    "Case control: DLOAD = {set}. Forces of the water on the nodes, in the axes of the body's frame."
                ),
                format!("Time 0 is t = {begin} s of the run. The last sample is at {last} s: end TSTEP there."),
                "The body's acceleration (series.csv) acts on the structure besides.".into(),
            ],
        );
        let mut all = vec![Whole(set), Real(1.0)];
        for (k, name) in run::observers::load_names(self.model.nodes.len()).iter().enumerate() {
            let (node, component) = (k / 3, [1, 2, 6][k % 3]);
            let values: Vec<f64> = self.loads[first..].iter().map(|loads| loads[node][k % 3]).collect();
            if values.iter().all(|value| *value == 0.0) {
                continue;
            }
            let id = self.model.base + SINGLE + k as i64;
            text += &comment(name);
            text += &written("TLOAD1", &[Whole(id), Whole(id), Blank, Word("LOAD".into()), Whole(id)]);
            text += &written("DAREA", &[Whole(id), Whole(self.model.grid(node)), Whole(component), Real(1.0)]);
            let head = std::iter::once(Whole(id)).chain((0..7).map(|_| Blank));
            let points = times.iter().zip(values).flat_map(|(time, value)| [Real(*time), Real(value)]);
            let table: Vec<Value> = head.chain(points).chain([Word("ENDT".into())]).collect();
            text += &written("TABLED1", &table);
            all.extend([Real(1.0), Whole(id)]);
        }
        text + &written("DLOAD", &all)
    }

    /// Static loads: the largest pressure of each node, and the forces at the instant of the largest force.
    fn peak_cards(&self) -> String {
        let model = &self.model;
        let (pressures, forces) = (model.base + PRESSURES, model.base + FORCES);
        let instant = self.largest().map(|(sample, force)| (self.times[sample], force, &self.loads[sample]));
        let (time, force) = instant.map_or((0.0, 0.0), |(time, force, _)| (time, force));
        let mut text = self.heading(
            "static loads",
            &[
                format!(
                    "LOAD = {pressures}: the largest pressure of each node over the samples, each at its own time:"
                ),
                "more than the panel carries at any instant. FYE is to the left of the bars.".into(),
                format!(
                    "LOAD = {forces}: forces at t = {time} s, when that across the panel is largest: {force:.6e} N/m."
                ),
            ],
        );
        let largest = |node: usize| {
            let extremes = self.extremes(node);
            if -extremes.least.0 > extremes.most.0 { extremes.least.0 } else { extremes.most.0 }
        };
        for k in 0..model.elements.len() {
            let [a, b] = [largest(k), largest(k + 1)];
            let id = model.base + k as i64 + 1;
            let (kind, scale) = (Word("FYE".into()), Word("FR".into()));
            text +=
                &written("PLOAD1", &[Whole(pressures), Whole(id), kind, scale, Real(0.0), Real(a), Real(1.0), Real(b)]);
        }
        for (node, [x, y, moment]) in instant.into_iter().flat_map(|(.., loads)| loads.iter().enumerate()) {
            let head = |name: &str, vector: [f64; 3]| {
                let [x, y, z] = vector.map(Real);
                written(name, &[Whole(forces), Whole(model.grid(node)), Blank, Real(1.0), x, y, z])
            };
            if [*x, *y] != [0.0; 2] {
                text += &head("FORCE", [*x, *y, 0.0]);
            }
            if *moment != 0.0 {
                text += &head("MOMENT", [0.0, 0.0, *moment]);
            }
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use run::load;
    use scene::nastran::cards::{cards, rewritten};
    use scene::nastran::model::BeamModel;

    use super::super::structure::PanelModel;
    use super::*;

    /// Every card of the three files is read back and written again to the same text.
    #[test]
    fn files_are_read_back_to_the_last_digit() {
        for name in ["flexible_wedge", "fuselage_flexible", "elastic_wedge_pinned"] {
            let scene = load(name, &[]).expect("a scene").scene;
            for model in PanelModel::of(&scene) {
                let nodes = model.nodes.len();
                let load =
                    |t: usize, n: usize| [1.0 / (1 + t + n) as f64, (n as f64).sin() * 1e5, 1e-7 / (1 + t) as f64];
                let loads = (0..5).map(|t| (0..nodes).map(|n| load(t, n)).collect()).collect();
                let loads =
                    PanelLoads { model, times: (0..5).map(|t| f64::from(t) / 3.0).collect(), loads, envelope: None };
                let structure = loads.model.beam_model().written();
                assert_eq!(BeamModel::read(&structure).expect("a model").written(), structure);
                for text in [loads.time_cards(), loads.peak_cards(), structure] {
                    let found = cards(&text).expect("cards");
                    let again: String = found.iter().map(rewritten).collect();
                    let plain: String = text.split_inclusive('\n').filter(|line| !line.starts_with('$')).collect();
                    assert_eq!(again, plain);
                    assert!(found.len() > 20);
                }
            }
        }
    }
}
