//! Axes of a sweep: lists, ranges, axes that go together, Latin hypercubes; and their product.

use serde::Deserialize;
use serde_json::Value as Json;
use settings::Problem;
use toml::Value;

use super::keys::{HypercubeKeys, refused};
use crate::axis::{MOST_POINTS, Values};
use decide::latin_hypercube::latin_hypercube;

/// Longest value that a message shows [characters].
const LONGEST_SHOWN: usize = 60;

/// Keys that change together: a row of values for each of its places.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// The keys.
    pub keys: Vec<String>,
    /// Their values, shape (places, keys).
    pub rows: Vec<Vec<Value>>,
}

/// The values at a path, in the words of `read`.
fn read<T>(path: &str, given: &Json, read: impl FnOnce(Values) -> Result<T, String>) -> Result<T, Problem> {
    // the schema has been checked: only an end can be missing
    let values = Values::deserialize(given).map_err(|_| "both ends, `from` and `to`".to_string());
    values.and_then(read).map_err(|expected| {
        let text = toml(given).to_string();
        let shown: String = text.chars().take(LONGEST_SHOWN).collect();
        Problem::new(path, if shown == text { shown } else { shown + " …" }, expected)
    })
}

/// A value as TOML has it.
pub(super) fn toml(value: &Json) -> Value {
    Value::try_from(value).unwrap_or(Value::String(value.to_string()))
}

/// `[[zip]]`, and a key of `[grid]`: one block; all keys have as many values.
pub(super) fn zip<'k>(path: &str, keys: impl IntoIterator<Item = (&'k String, &'k Json)>) -> Result<Block, Problem> {
    let mut block = Block { keys: Vec::new(), rows: Vec::new() };
    for (key, given) in keys {
        let (first, count) = (block.keys.first(), block.rows.len());
        let column = read(&format!("{path}.{key}"), given, |values| match (values.all()?, first) {
            (column, Some(first)) if column.len() != count => {
                Err(format!("as many values as `{first}`: {count}, not {}", column.len()))
            }
            (column, _) => Ok(column),
        })?;
        block.rows.resize(column.len(), Vec::new());
        block.rows.iter_mut().zip(&column).for_each(|(row, value)| row.push(toml(value)));
        block.keys.push(key.clone());
    }
    match block.keys.is_empty() {
        true => Err(refused(path, "[zip]: expected at least one key with its values")),
        false => Ok(block),
    }
}

/// `[latin_hypercube]`: one block.
pub(super) fn hypercube(cube: &HypercubeKeys) -> Result<Block, Problem> {
    const KEYS: &str = "latin_hypercube.keys";
    if cube.keys.is_empty() {
        return Err(refused(
            KEYS,
            "[latin_hypercube.keys]: expected at least one key with its ends, such as [100, 400]",
        ));
    }
    let ends = cube.keys.iter().map(|(key, given)| read(&format!("{KEYS}.{key}"), given, Values::ends));
    let ends = ends.collect::<Result<Vec<_>, _>>()?;
    let row = |shares: Vec<f64>| ends.iter().zip(shares).map(|(ends, share)| Value::Float(ends.at(share))).collect();
    let rows = latin_hypercube(cube.samples, ends.len(), cube.seed as u64).into_iter().map(row).collect();
    Ok(Block { keys: cube.keys.keys().cloned().collect(), rows })
}

/// The rows of all combinations, the last block changing fastest, shape (points, keys); `None` beyond [`MOST_POINTS`].
pub(super) fn product(blocks: &[Block]) -> Option<Vec<Vec<Value>>> {
    let count = blocks.iter().try_fold(1_usize, |count, block| count.checked_mul(block.rows.len()));
    count.filter(|count| *count <= MOST_POINTS)?;
    let mut rows: Vec<Vec<Value>> = vec![Vec::new()];
    for block in blocks {
        let longer =
            |row: &Vec<Value>| block.rows.iter().map(|more| [row.as_slice(), more].concat()).collect::<Vec<_>>();
        rows = rows.iter().flat_map(longer).collect();
    }
    Some(rows)
}
