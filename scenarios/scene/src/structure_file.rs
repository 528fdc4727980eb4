//! `body.panels[].structure_file`: the structure of a panel from a Nastran bulk data file.

use fsi_coupling::geometry::polyline::Polyline;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value, json};
use settings::{DataLine, Problem, require, significant};

use super::data_file::{DataFile, Fault};
use super::draft::Draft;
use super::keys::{StructurePlane, StructureUnits, line, schema};
use super::resolve_body::resolve_shape;
use crate::nastran::chain::{Chain, ChainBar, ChainNode, Reading};
use crate::nastran::model::BeamModel;
use crate::nastran::{Axes, CardError, Held};

const KIND: &str = "a Nastran bulk data file (.bdf, .dat, .nas)";
/// Keys that the file stands for.
const REPLACED: [&str; 9] =
    ["material", "elements", "thickness", "youngs_modulus", "poissons_ratio", "density", "plane", "nodes", "bars"];
/// Distance of a node from the body's line over the length of the chain, at most [-].
const FARTHEST: f64 = 0.1;
/// A corner of the body's line is the place of an end that is nearer to it than this multiple of its distance from the line, or that of
/// its outer fibre.
const AT_CORNER: f64 = 1.5;

/// A file that a panel names.
pub(super) struct StructureFile {
    panel: usize,
    name: String,
    chain: Chain,
    notes: Vec<String>,
}

impl StructureFile {
    /// What was left out of it, in sentences.
    pub(super) fn notes(&self) -> &[String] {
        &self.notes
    }

    /// A problem of one of its lines.
    fn problem(&self, fault: Fault) -> Problem {
        let at = DataLine { file: self.name.clone(), line: fault.line };
        Problem::in_file(&format!("body.panels[{}].structure_file", self.panel), at, fault.given, fault.expected)
    }
}

impl From<CardError> for Fault {
    fn from(error: CardError) -> Fault {
        Fault::new(error.line, error.given, error.expected)
    }
}

fn panels(given: &mut Value) -> impl Iterator<Item = (usize, &mut Map<String, Value>)> {
    let panels = given.get_mut("body").and_then(|body| body.get_mut("panels")).and_then(Value::as_array_mut);
    panels.into_iter().flatten().enumerate().filter_map(|(k, panel)| Some((k, panel.as_object_mut()?)))
}

/// Reads the files that panels name, and removes the keys that say how.
pub(super) fn files(given: &mut Value, scene_file: &str) -> Result<Vec<StructureFile>, Problem> {
    let mut found = Vec::new();
    for (panel, table) in panels(given) {
        let key = |name: &str| format!("body.panels[{panel}].{name}");
        let Some(name) = table.get("structure_file").and_then(Value::as_str).map(str::to_string) else { continue };
        if let Some((name, value)) = REPLACED.iter().find_map(|name| Some((name, table.get(*name)?))) {
            let expected = "none beside structure_file, whose cards have it";
            return Err(Problem::new(&key(name), value, expected));
        }
        let plane = option(table, "structure_plane", key, "\"xy\", \"xz\" or \"yz\"")?.unwrap_or_default();
        let units = option(table, "structure_units", key, "\"m_kg_s\" or \"mm_t_s\"")?.unwrap_or_default();
        let width = option(table, "structure_width", key, "a number above 0")?.unwrap_or(1.0);
        require(width > 0.0, &key("structure_width"), width, "a number above 0")?;
        let axes = Axes(match plane {
            StructurePlane::Xy => [0, 1],
            StructurePlane::Xz => [0, 2],
            StructurePlane::Yz => [1, 2],
        });
        let units = match units {
            StructureUnits::MKgS => [1.0, 1.0],
            StructureUnits::MmTS => [1e-3, 1e3],
        };
        let key = key("structure_file");
        let file = DataFile::read(scene_file, &key, &name, KIND)?;
        let model = BeamModel::read(&file.text).map_err(|error| file.problem(error.into()))?;
        let chain = Chain::of(&model, &Reading { axes, units, width }).map_err(|error| file.problem(error.into()))?;
        let notes = model.notes.iter().map(|what| format!("{key} {name:?}: {what}")).collect();
        for name in ["structure_file", "structure_plane", "structure_units", "structure_width"] {
            table.remove(name);
        }
        found.push(StructureFile { panel, name, chain, notes });
    }
    Ok(found)
}

/// The value of a key, where it is given.
fn option<T: DeserializeOwned>(
    table: &Map<String, Value>,
    name: &str,
    key: impl Fn(&str) -> String,
    expected: &str,
) -> Result<Option<T>, Problem> {
    let Some(value) = table.get(name) else { return Ok(None) };
    T::deserialize(value).map(Some).map_err(|_| Problem::new(&key(name), value, expected))
}

/// Writes nodes, bars, ends and places of the panels whose files were read, in the order of the body's line.
pub(super) fn settle(given: &mut Value, files: &[StructureFile]) -> Result<(), Problem> {
    if files.is_empty() {
        return Ok(());
    }
    let line = line(&resolve_shape(&mut Draft::of(given, schema())?)?);
    for (panel, table) in panels(given) {
        let Some(file) = files.iter().find(|file| file.panel == panel) else { continue };
        let chain = along(&line, &file.chain).map_err(|fault| file.problem(fault))?;
        write(table, &line, &chain).map_err(|fault| file.problem(fault))?;
    }
    Ok(())
}

/// The chain in the order of the body's line.
fn along(line: &Polyline, chain: &Chain) -> Result<Chain, Fault> {
    let length: f64 = chain.nodes.windows(2).map(|pair| distance(pair[0].at, pair[1].at)).sum();
    let mut places = Vec::new();
    for ChainNode { id, at, line: number } in &chain.nodes {
        let (s, away) = line.nearest(*at);
        if away > FARTHEST * length {
            let [x, y] = at.map(significant);
            let given = format!("GRID {id} at [{x}, {y}] m, {} m from the body's line", significant(away));
            let expected = format!(
                "at most {} m, a tenth of the chain's length: coordinates of the body's frame; or other structure_units",
                significant(FARTHEST * length)
            );
            return Err(Fault::new(*number, given, expected));
        }
        places.push(s);
    }
    // steps along the line, the shorter way round a closed one
    let whole = line.length();
    let step = |pair: &[f64]| match pair[1] - pair[0] {
        step if !line.is_closed() => step,
        step => step - whole * (step / whole).round(),
    };
    let steps: Vec<f64> = places.windows(2).map(step).collect();
    let forwards = steps.iter().sum::<f64>() > 0.0;
    if let Some(k) = steps.iter().position(|step| (*step > 0.0) != forwards || *step == 0.0) {
        let bar = &chain.bars[k];
        let (a, b) = (chain.nodes[k].id, chain.nodes[k + 1].id);
        let given = format!("the bar from GRID {a} to GRID {b}, which turns back");
        return Err(Fault::new(bar.line, given, "a chain that follows the body's line in one direction"));
    }
    Ok(if forwards { chain.clone() } else { chain.clone().reversed() })
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// The place of an end on the body's line: a corner beside it, or the nearest place.
fn place(line: &Polyline, at: [f64; 2], bar: &ChainBar) -> [f64; 2] {
    let (s, away) = line.nearest(at);
    let fibre = bar.fibres.into_iter().map(f64::abs).fold(away, f64::max);
    let reach = AT_CORNER * fibre + 1e-9 * line.length();
    let corner = line.points().iter().min_by(|a, b| distance(**a, at).total_cmp(&distance(**b, at)));
    corner.filter(|corner| distance(**corner, at) <= reach).copied().unwrap_or_else(|| line.at(s))
}

fn write(table: &mut Map<String, Value>, line: &Polyline, chain: &Chain) -> Result<(), Fault> {
    let nodes: Vec<[f64; 2]> = chain.nodes.iter().map(|node| node.at).collect();
    let bars = chain.bars.iter().map(|bar| {
        let [right, left] = bar.fibres;
        [bar.youngs_modulus, bar.shear_modulus, bar.density, bar.area, bar.second_moment, right, left]
    });
    let mut fill = |name: &str, value: Value| {
        table.entry(name).or_insert(value);
    };
    fill("from", json!(place(line, nodes[0], &chain.bars[0])));
    fill("to", json!(place(line, nodes[chain.bars.len()], &chain.bars[chain.bars.len() - 1])));
    fill("nodes", json!(nodes));
    fill("bars", json!(bars.collect::<Vec<_>>()));
    if let Some(ends) = chain.ends {
        let ends = [0, 1].map(|k| end(ends[k], &chain.nodes[k * (chain.nodes.len() - 1)]));
        let [first, last] = ends;
        fill("ends", json!([first?, last?]));
    }
    if chain.bars.iter().all(|bar| bar.shears) {
        fill("theory", json!("timoshenko"));
    }
    if let Some(allowable) = chain.bars.iter().filter_map(|bar| bar.allowable_stress).reduce(f64::min) {
        fill("allowable_stress", json!(allowable));
    }
    Ok(())
}

/// The end of a panel that is held as a node is.
fn end(held: Held, node: &ChainNode) -> Result<&'static str, Fault> {
    match (held.fixed, held.slides) {
        ([true, true, true], false) => Ok("clamped"),
        ([true, true, false], false) => Ok("pinned"),
        ([true, true, true], true) => Ok("guided"),
        ([true, true, false], true) => Ok("sliding"),
        ([true, false, true], false) => Ok("mirror"),
        ([false, false, false], false) => Ok("free"),
        _ => {
            let names = ["its first direction", "its second direction", "rotation"];
            let fixed: Vec<&str> =
                names.into_iter().zip(held.fixed).filter(|(_, fixed)| *fixed).map(|(n, _)| n).collect();
            let given = format!("GRID {} held in {}", node.id, fixed.join(", "));
            let expected = "both directions with or without rotation, none, or the first direction with rotation (mirror); \
                            or the key ends";
            Err(Fault::new(node.line, given, expected))
        }
    }
}
