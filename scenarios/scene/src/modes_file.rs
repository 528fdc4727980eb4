//! `body.modes_file`: the structure of a body from a file of natural modes.

use serde::Deserialize;
use serde_json::{Value, json};
use settings::{Problem, require};
use toml::Spanned;

use super::data_file::{DataFile, Fault};
use super::keys::{Modes, NaturalMode};

const KEY: &str = "body.modes_file";
const KIND: &str = "a file of natural modes (.toml)";

/// What the file says, with the places of what may be wrong.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ModesFile {
    /// Span that the structure stands for [m].
    #[serde(default = "metre")]
    width: Spanned<f64>,
    nodes: Spanned<Vec<[f64; 2]>>,
    #[serde(default)]
    masses: Option<Spanned<Vec<f64>>>,
    modes: Vec<Spanned<NaturalMode>>,
}

fn metre() -> Spanned<f64> {
    Spanned::new(0..0, 1.0)
}

/// Replaces `body.modes_file` by the modes of the file that it names.
pub(super) fn settle(given: &mut Value, scene_file: &str) -> Result<(), Problem> {
    let Some(body) = given.get_mut("body").and_then(Value::as_object_mut) else { return Ok(()) };
    let Some(name) = body.get("modes_file").and_then(Value::as_str).map(str::to_string) else { return Ok(()) };
    let beside = body.get("modal").is_some();
    require(!beside, KEY, format_args!("{name:?}"), "no body.modal beside it")?;
    let file = DataFile::read(scene_file, KEY, &name, KIND)?;
    let modes = read(&file.text).map_err(|fault| file.problem(fault))?;
    body.remove("modes_file");
    body.insert("modal".into(), json!(modes));
    Ok(())
}

/// The modes of a metre of span.
fn read(text: &str) -> Result<Modes, Fault> {
    let line = |at: usize| 1 + text[..at.min(text.len())].matches('\n').count();
    let file: ModesFile = toml::from_str(text).map_err(|error| {
        let at = error.span().map_or(0, |span| span.start);
        let expected = "nodes = [[x, y], ...] and [[modes]] with frequency, mass, shape = [[u, v, rotation], ...]";
        Fault::new(line(at), error.message().trim().to_string(), expected)
    })?;
    let table: toml::Table = toml::from_str(text).unwrap_or_default();
    let ragged = |rows: Option<&toml::Value>, columns: usize| {
        let rows = rows.and_then(toml::Value::as_array).into_iter().flatten();
        rows.filter_map(toml::Value::as_array).map(Vec::len).find(|found| *found != columns)
    };
    if let Some(found) = ragged(table.get("nodes"), 2) {
        return Err(Fault::new(line(file.nodes.span().start), format!("a node of {found} numbers"), "two: x, y [m]"));
    }
    let modes = table.get("modes").and_then(toml::Value::as_array).into_iter().flatten();
    for (mode, given) in file.modes.iter().zip(modes) {
        if let Some(found) = ragged(given.get("shape"), 3) {
            let given = format!("a row of {found} numbers in shape");
            return Err(Fault::new(line(mode.span().start), given, "three: displacement x, y and rotation"));
        }
    }
    let width = *file.width.get_ref();
    if !(width > 0.0 && width.is_finite()) {
        return Err(Fault::new(
            line(file.width.span().start),
            format!("width = {width}"),
            "a number of metres above 0",
        ));
    }
    let count = file.nodes.get_ref().len();
    let counted = |what: &str, found: usize, at: usize| match found == count {
        true => Ok(()),
        false => Err(Fault::new(line(at), format!("{found} {what}"), format!("{count}, one for each of nodes"))),
    };
    if let Some(masses) = &file.masses {
        counted("masses", masses.get_ref().len(), masses.span().start)?;
    }
    let mut modes = Vec::new();
    for mode in file.modes {
        let at = mode.span().start;
        let mode = mode.into_inner();
        counted("rows of shape", mode.shape.len(), at)?;
        if !mode.stress.is_empty() {
            counted("values of stress", mode.stress.len(), at)?;
        }
        let sound = |value: f64| value > 0.0 && value.is_finite();
        if !sound(mode.frequency) || !sound(mode.mass) {
            let given = format!("frequency = {}, mass = {}", mode.frequency, mode.mass);
            return Err(Fault::new(line(at), given, "finite numbers above 0 [Hz, kg]; a rigid motion is no mode"));
        }
        modes.push(NaturalMode { mass: mode.mass / width, ..mode });
    }
    let masses = file.masses.map_or(Vec::new(), |masses| masses.into_inner().iter().map(|m| m / width).collect());
    Ok(Modes { nodes: file.nodes.into_inner(), masses, modes })
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = "width = 0.5\nnodes = [[0, 0], [1, 0.2]]\nmasses = [1, 2]\n\n[[modes]]\nfrequency = 30\nmass = 1.5\n\
                        shape = [[0, 0, 0], [0, 1, 0]]\n";

    #[test]
    fn a_bay_becomes_a_metre_of_span() {
        let modes = read(FILE).expect("modes");
        assert_eq!((modes.nodes, modes.masses), (vec![[0.0, 0.0], [1.0, 0.2]], vec![2.0, 4.0]));
        assert_eq!((modes.modes[0].mass, modes.modes[0].frequency), (3.0, 30.0));
    }

    #[test]
    fn faults_have_their_line() {
        for (from, to, line, part) in [
            ("width = 0.5", "width = 0", 1, "above 0"),
            ("masses = [1, 2]", "masses = [1]", 3, "2, one for each of nodes"),
            ("[0, 1, 0]]", "[0, 1, 0], [0, 2, 0]]", 5, "2, one for each of nodes"),
            ("[0, 1, 0]]", "[0, 1, 0, 0]]", 5, "displacement x, y and rotation"),
            ("[1, 0.2]]", "[1, 0.2, 0]]", 2, "two: x, y"),
            ("frequency = 30", "frequency = 0", 5, "rigid motion"),
            ("frequency = 30", "frequenz = 30", 6, "[[modes]]"),
            ("mass = 1.5", "mass = \"heavy\"", 7, "[[modes]]"),
            ("[[modes]]", "[[modes", 5, "[[modes]]"),
        ] {
            let fault = read(&FILE.replace(from, to)).expect_err(to);
            assert!(fault.line == line && fault.expected.contains(part), "{to}: {fault:?}");
        }
    }
}
