//! Axes of a sweep: lists, ranges, axes that go together, Latin hypercubes; and their product.

use scene::SceneError;
use toml::de::{DeTable, DeValue};
use toml::{Spanned, Value};

use super::latin_hypercube::latin_hypercube;
use super::toml_reader::{Entry, TomlReader};

/// Most values of an axis, samples of a hypercube, and points of a sweep.
pub(super) const MOST_POINTS: usize = 100_000;

/// Keys that change together: a row of values for each of its places.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// The keys.
    pub keys: Vec<String>,
    /// Their values, shape (places, keys).
    pub rows: Vec<Vec<Value>>,
}

/// A table with ends is a range, not a table of keys.
fn is_range(table: &DeTable<'_>) -> bool {
    ["from", "to"].into_iter().any(|end| table.iter().any(|(key, _)| key.get_ref() == end))
}

/// The entries of a table of axes: key, and list or range.
fn axes_of<'t>(reader: &TomlReader<'_>, table: &'t DeTable<'t>) -> Vec<Entry<'t>> {
    reader.leaves(table, is_range)
}

/// `[grid]`: a block for each key.
pub(super) fn grid(reader: &TomlReader<'_>, table: &DeTable<'_>) -> Result<Vec<Block>, SceneError> {
    let axis = |entry: Entry<'_>| {
        let rows = values(reader, &entry)?.into_iter().map(|value| vec![value]).collect();
        Ok(Block { keys: vec![entry.key], rows })
    };
    axes_of(reader, table).into_iter().map(axis).collect()
}

/// `[[zip]]`: one block; all keys have as many values.
pub(super) fn zip(reader: &TomlReader<'_>, given: &Entry<'_>) -> Result<Block, SceneError> {
    let mut block = Block { keys: Vec::new(), rows: Vec::new() };
    let entries = axes_of(reader, reader.table(given)?);
    if entries.is_empty() {
        return Err(reader.error(given.place.clone(), "[zip]: expected at least one key with its values".into()));
    }
    for entry in entries {
        let column = values(reader, &entry)?;
        if block.keys.is_empty() {
            block.rows = vec![Vec::new(); column.len()];
        }
        if column.len() != block.rows.len() {
            let expected = format!("as many values as `{}`: {}, not {}", block.keys[0], block.rows.len(), column.len());
            return Err(reader.unexpected(&entry.key, entry.value, &expected));
        }
        block.rows.iter_mut().zip(column).for_each(|(row, value)| row.push(value));
        block.keys.push(entry.key);
    }
    Ok(block)
}

/// `[latin_hypercube]`: one block.
pub(super) fn hypercube(reader: &TomlReader<'_>, given: &Entry<'_>) -> Result<Block, SceneError> {
    const KEYS: [&str; 3] = ["samples", "seed", "keys"];
    let (mut samples, mut seed, mut keys) = (None, 1, Vec::new());
    for entry in reader.entries(reader.table(given)?) {
        match entry.key.as_str() {
            "samples" => samples = Some(reader.whole("samples", entry.value, [1, MOST_POINTS as i64])? as usize),
            "seed" => seed = reader.whole("seed", entry.value, [0, i64::MAX])? as u64,
            "keys" => keys = axes_of(reader, reader.table(&entry)?),
            _ => return Err(reader.unknown(&entry, &KEYS)),
        }
    }
    let missing = |what: &str| reader.error(given.place.clone(), format!("[latin_hypercube]: expected {what}"));
    let samples = samples.ok_or_else(|| missing("`samples`, the number of points"))?;
    if keys.is_empty() {
        return Err(missing("a table [latin_hypercube.keys] with the ends of each key, such as [100, 400]"));
    }
    let ranges = keys.iter().map(|entry| ends(reader, entry)).collect::<Result<Vec<_>, _>>()?;
    let row =
        |shares: Vec<f64>| ranges.iter().zip(shares).map(|(range, share)| Value::Float(range.at(share))).collect();
    let rows = latin_hypercube(samples, keys.len(), seed).into_iter().map(row).collect();
    Ok(Block { keys: keys.into_iter().map(|entry| entry.key).collect(), rows })
}

/// Two ends and the way between them.
struct Range {
    from: f64,
    to: f64,
    logarithmic: bool,
    whole: bool,
}

impl Range {
    /// The number at a share of the way, to 12 digits: decimal fractions stay short.
    fn at(&self, share: f64) -> f64 {
        let value = match self.logarithmic {
            true => self.from * (self.to / self.from).powf(share),
            false => self.from + (self.to - self.from) * share,
        };
        format!("{value:.11e}").parse().unwrap_or(value)
    }

    fn value(&self, share: f64) -> Value {
        let value = self.at(share);
        match self.whole && value.fract() == 0.0 && value.abs() < 1e15 {
            true => Value::Integer(value as i64),
            false => Value::Float(value),
        }
    }
}

/// The ends of a key of a hypercube: `[a, b]` or `{ from = a, to = b, scale = "log" }`.
fn ends(reader: &TomlReader<'_>, entry: &Entry<'_>) -> Result<Range, SceneError> {
    const EXPECTED: &str = "two different ends, [a, b] or { from = a, to = b, scale = \"log\" }";
    let range = match entry.value.get_ref() {
        DeValue::Array(items) if items.len() == 2 => {
            let [from, to] = [0, 1].map(|k| reader.number(&entry.key, &items[k]));
            Range { from: from?, to: to?, logarithmic: false, whole: false }
        }
        DeValue::Table(table) => range(reader, entry, table, &["from", "to", "scale"])?.0,
        _ => return Err(reader.unexpected(&entry.key, entry.value, EXPECTED)),
    };
    match range.from == range.to {
        true => Err(reader.unexpected(&entry.key, entry.value, EXPECTED)),
        false => Ok(range),
    }
}

/// How many values a range has.
enum Steps {
    Count(usize),
    Step(f64),
}

/// A range and the number of its values, where it gives one; `known` are the keys that it may have.
fn range(
    reader: &TomlReader<'_>,
    given: &Entry<'_>,
    table: &DeTable<'_>,
    known: &[&str],
) -> Result<(Range, Option<Steps>), SceneError> {
    let (mut from, mut to, mut logarithmic, mut steps, mut whole) = (None, None, false, None, true);
    let is_whole = |value: &Spanned<DeValue<'_>>| matches!(value.get_ref(), DeValue::Integer(_));
    for entry in reader.entries(table) {
        let key = format!("{}.{}", given.key, entry.key);
        if !known.contains(&entry.key.as_str()) {
            return Err(reader.unknown(&entry, known));
        }
        match entry.key.as_str() {
            "from" => (from, whole) = (Some(reader.number(&key, entry.value)?), whole && is_whole(entry.value)),
            "to" => (to, whole) = (Some(reader.number(&key, entry.value)?), whole && is_whole(entry.value)),
            "scale" => match reader.string(&key, entry.value)?.as_str() {
                "log" => logarithmic = true,
                "linear" => {}
                _ => return Err(reader.unexpected(&key, entry.value, "\"linear\" or \"log\"")),
            },
            _ if steps.is_some() => {
                return Err(reader.error(entry.place, format!("`{key}`: expected count or step, not both")));
            }
            "count" => {
                let count = reader.whole(&key, entry.value, [2, MOST_POINTS as i64])?;
                steps = Some(Steps::Count(count as usize));
            }
            _ => steps = Some(Steps::Step(reader.number(&key, entry.value)?)),
        }
    }
    let (Some(from), Some(to)) = (from, to) else {
        return Err(reader.unexpected(&given.key, given.value, "both ends, `from` and `to`"));
    };
    if logarithmic && from * to <= 0.0 {
        return Err(reader.unexpected(&given.key, given.value, "ends of the same sign and not 0 with scale = \"log\""));
    }
    Ok((Range { from, to, logarithmic, whole }, steps))
}

/// The values of an axis.
fn values(reader: &TomlReader<'_>, entry: &Entry<'_>) -> Result<Vec<Value>, SceneError> {
    const EXPECTED: &str =
        "a list of values, or a range { from = a, to = b, count = n }; a fixed value belongs to [set]";
    let refuse = |expected: &str| reader.unexpected(&entry.key, entry.value, expected);
    match entry.value.get_ref() {
        DeValue::Array(items) if items.is_empty() => Err(refuse("at least one value")),
        DeValue::Array(items) => items.iter().map(|item| reader.value(item)).collect(),
        DeValue::Table(table) => match range(reader, entry, table, &["from", "to", "count", "step", "scale"])? {
            (range, Some(Steps::Count(count))) => {
                Ok((0..count).map(|k| range.value(k as f64 / (count - 1) as f64)).collect())
            }
            (range, Some(Steps::Step(step))) => {
                let steps = (range.to - range.from) / step;
                if range.logarithmic || !steps.is_finite() || steps < 0.0 || steps >= MOST_POINTS as f64 {
                    return Err(refuse(&format!(
                        "a step that leads from `from` to `to` in at most {MOST_POINTS} values, on a linear scale"
                    )));
                }
                let to_last = (steps + 1e-9).floor();
                let whole = range.whole && step.fract() == 0.0;
                let range = Range { to: range.from + to_last * step, whole, ..range };
                Ok((0..=to_last as usize)
                    .map(|k| range.value(if to_last > 0.0 { k as f64 / to_last } else { 0.0 }))
                    .collect())
            }
            (_, None) => Err(refuse("`count` or `step`")),
        },
        _ => Err(refuse(EXPECTED)),
    }
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
