//! The check of given settings against their schema, with conditions under which a key has an effect:
//! `.integrator = verlet | beeman and .kinematic_viscosity`.

use serde_json::{Map, Value};

use super::node::{Foreign, Node};
use super::problem::Problem;

/// A table with its schema: what a path of a condition starts from.
#[derive(Clone, Copy)]
pub(super) struct Place<'a> {
    pub node: Node<'a>,
    pub content: &'a Map<String, Value>,
}

impl Place<'_> {
    /// The value at a path, or its default.
    fn value(self, path: &str) -> Option<Value> {
        let (key, rest) = path.split_once('.').map_or((path, None), |(key, rest)| (key, Some(rest)));
        let keys = self.node.keys(self.content);
        if let Some((_, value)) = keys.tags.iter().find(|(tag, _)| *tag == key) {
            return Some(Value::from(*value));
        }
        let node = keys.own(key)?;
        match rest {
            None => self.content.get(key).or(node.default()).cloned(),
            Some(rest) => {
                let empty = Map::new();
                let content = self.content.get(key).and_then(Value::as_object).unwrap_or(&empty);
                Place { node, content }.value(rest)
            }
        }
    }

    /// `here` and `root` satisfy the condition: paths that start with a dot are those of `here`.
    pub fn satisfies(here: Place, root: Place, condition: &str) -> bool {
        condition.split(" and ").all(|part| {
            let (path, words) = part.split_once(" = ").map_or((part, None), |(path, words)| (path, Some(words)));
            let value = match path.strip_prefix('.') {
                Some(path) => here.value(path),
                None => root.value(path),
            };
            match (value, words) {
                (Some(value), None) => !is_off(&value),
                (Some(value), Some(words)) => {
                    value.as_str().is_some_and(|value| words.split(" | ").any(|word| word == value))
                }
                (None, _) => false,
            }
        })
    }
}

/// False, zero, `none` and an empty list switch an option off.
fn is_off(value: &Value) -> bool {
    match value {
        Value::Null | Value::Bool(false) => true,
        Value::Number(x) => x.as_f64() == Some(0.0),
        Value::String(word) => word == "none",
        Value::Array(items) => items.iter().all(is_off),
        _ => false,
    }
}

/// Checks values of one set of settings.
pub(super) struct Checker<'a> {
    /// The refusal of an unknown key.
    pub unknown: &'a dyn Fn(&str) -> Problem,
    pub root: Place<'a>,
}

impl Checker<'_> {
    /// A table without the keys that say nothing. `others` are the table's schemas under other tags of the tables around it.
    pub fn table(
        &self,
        node: Node,
        others: &[Foreign],
        content: &Map<String, Value>,
        path: &str,
    ) -> Result<Map<String, Value>, Problem> {
        let keys = node.keys(content);
        let here = Place { node, content };
        let mut kept = Map::new();
        for (tag, _) in &keys.tags {
            if let (Some(value), Some(node)) = (content.get(*tag), keys.own(tag)) {
                word(&node.tag_words(), value, &joined(path, tag))?;
            }
        }
        for (key, value) in content {
            let tagged = keys.foreign(key).find(|other| keys.assumed.contains(&other.tag) && keys.own(key).is_none());
            if let Some((other, node)) = tagged.and_then(|other| Some((other, keys.own(other.tag)?))) {
                let words = node.tag_words().join(", ");
                return Err(Problem::missing(&joined(path, other.tag), format!("one of {words}")));
            }
            let path = joined(path, key);
            let nested: Vec<Foreign> =
                others.iter().flat_map(|other| within(other, content, key)).chain(keys.foreign(key).copied()).collect();
            let Some(node) = keys.own(key).or(node.free_key()) else {
                let tag = nested.first().map_or("", |foreign| foreign.tag);
                let chosen =
                    keys.tags.iter().chain(&self.tags()).find(|(name, _)| *name == tag).map(|(_, value)| *value);
                self.foreign(&nested, value, &path, chosen.unwrap_or_default())?;
                continue;
            };
            if keys.tags.iter().any(|(tag, _)| *tag == key) {
                kept.insert(key.clone(), word(&node.tag_words(), value, &path)?);
                continue;
            }
            let Some(value) = self.value(node, &nested, value, &path)? else { continue };
            match node.text("x-when") {
                Some(condition) if !Place::satisfies(here, self.root, condition) => {
                    if !is_default(node, &value) {
                        return Err(idle(node, &value, &path, condition));
                    }
                    if value.is_object() {
                        continue;
                    }
                }
                _ => {}
            }
            kept.insert(key.clone(), value);
        }
        Ok(kept)
    }

    fn tags(&self) -> Vec<(&str, &str)> {
        self.root.node.keys(self.root.content).tags
    }

    /// A value of a key; none for the word that stands for an absent key.
    fn value(&self, node: Node, others: &[Foreign], given: &Value, path: &str) -> Result<Option<Value>, Problem> {
        if let Some(part) = node.kinds_of_values().into_iter().find(|part| part.kind() == Some(kind_of(given))) {
            return self.value(part, others, given, path);
        }
        let (inner, word) = node.given();
        if word.is_some() && given.as_str() == word {
            return Ok(None);
        }
        let refused = |given: String| Err(Problem::new(path, given, node.expected()));
        let words = node.given_words();
        if !words.is_empty() {
            return self::word(&words, given, path).map(Some);
        }
        match (inner.kind(), given) {
            _ if *node.0 == Value::Bool(true) => {}
            _ if !node.kinds_of_values().is_empty() => return refused(shown(given)),
            (_, Value::String(text)) if node.words_beside_number().contains(&text.as_str()) => {}
            (Some("number"), Value::Number(x))
                if x.as_f64().is_some_and(|x| inner.allows_number(x) && node.allows_number(x)) => {}
            (Some("integer"), Value::Number(x))
                if is_whole(inner, x) && x.as_f64().is_some_and(|x| node.allows_number(x)) => {}
            (Some("boolean"), Value::Bool(_)) | (Some("string"), Value::String(_)) => {}
            (Some("array"), Value::Array(items)) => return self.list(inner, items, path).map(Some),
            (Some("object"), Value::Object(content)) => {
                return self.table(inner, others, content, path).map(|table| Some(Value::Object(table)));
            }
            (Some("object"), Value::Array(items)) if items.iter().all(Value::is_object) => {
                let given = format!("a list of tables, [[{path}]]");
                return Err(Problem::new(
                    path,
                    given,
                    format!("one table, [{path}] in single brackets: there is only one"),
                ));
            }
            _ => return refused(shown(given)),
        }
        Ok(Some(given.clone()))
    }

    fn list(&self, node: Node, items: &[Value], path: &str) -> Result<Value, Problem> {
        let count = items.len() as f64;
        if node.number("minItems").is_some_and(|least| count < least)
            || node.number("maxItems").is_some_and(|most| count > most)
        {
            return Err(Problem::new(path, format!("an array of length {count}"), node.expected()));
        }
        let Some(item) = node.get("items").map(Node) else { return Ok(Value::from(items)) };
        let checked = items.iter().enumerate().map(|(i, value)| {
            let value = self.value(item, &[], value, &format!("{path}[{i}]"))?;
            Ok(value.unwrap_or(Value::Null))
        });
        checked.collect::<Result<Vec<_>, _>>().map(Value::Array)
    }

    /// Refuses a key that the present tags do not allow, unless its value is neutral.
    fn foreign(&self, theirs: &[Foreign], given: &Value, path: &str, chosen: &str) -> Result<(), Problem> {
        let Some(first) = theirs.first() else { return Err((self.unknown)(path)) };
        if let (Value::Object(content), Some("object")) = (given, first.node.kind()) {
            return content.iter().try_for_each(|(key, value)| {
                let nested: Vec<Foreign> = theirs.iter().flat_map(|other| within(other, content, key)).collect();
                self.foreign(&nested, value, &joined(path, key), chosen)
            });
        }
        if first.node.get("x-ignored-elsewhere").is_some() || theirs.iter().any(|other| is_neutral(other.node, given)) {
            return Ok(());
        }
        let neutral = first.node.get("x-neutral").or(first.node.default());
        let neutral = neutral.map_or(String::new(), |neutral| format!(", or {neutral},"));
        let mut owners: Vec<String> = Vec::new();
        for owner in theirs.iter().map(|other| format!("{:?}", other.owner)) {
            if !owners.contains(&owner) {
                owners.push(owner);
            }
        }
        let expected = format!(
            "none{neutral} with {tag} = {chosen:?}: the key belongs to {tag} = {}",
            owners.join(", "),
            tag = first.tag
        );
        Err(Problem::new(path, shown(given), expected))
    }
}

/// One of these words.
fn word(words: &[&str], given: &Value, path: &str) -> Result<Value, Problem> {
    if given.as_str().is_some_and(|word| words.contains(&word)) {
        return Ok(given.clone());
    }
    let words: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
    let given = given.as_str().map_or_else(|| shown(given), |word| format!("`{word}`"));
    Err(Problem::new(path, given, format!("one of {}", words.join(", "))))
}

/// The key of a table that other tags allow, under those tags.
fn within<'s>(other: &Foreign<'s>, content: &Map<String, Value>, key: &str) -> Option<Foreign<'s>> {
    let node = other.node.keys(content).own(key)?;
    let (key, _) = other.node.get("properties")?.as_object()?.get_key_value(key)?;
    Some(Foreign { key, node, ..*other })
}

/// Refuses a key that has no effect beside the other keys.
fn idle(node: Node, value: &Value, path: &str, condition: &str) -> Problem {
    let neutral = node.default().map_or(String::new(), |default| format!(", or its default {}", shown(default)));
    let owner = match path.rsplit_once('.') {
        Some((table, _)) => condition.replace(" and .", &format!(" and {table}.")),
        None => condition.to_string(),
    };
    let owner = match (owner.strip_prefix('.'), path.rsplit_once('.')) {
        (Some(rest), Some((table, _))) => format!("{table}.{rest}"),
        (Some(rest), None) => rest.to_string(),
        _ => owner,
    };
    Problem::new(path, shown(value), format!("none{neutral}: the key has no effect here, only with {owner}"))
}

/// A value that changes nothing under another tag: off, or the default.
fn is_neutral(node: Node, given: &Value) -> bool {
    match node.get("x-neutral") {
        Some(neutral) => neutral.as_f64() == given.as_f64(),
        None => is_off(given) || is_default(node, given),
    }
}

fn is_default(node: Node, given: &Value) -> bool {
    match (node.default(), given) {
        (Some(Value::Number(a)), Value::Number(b)) => a.as_f64() == b.as_f64(),
        (Some(default), given) if default == given => true,
        (_, Value::Object(content)) => {
            let keys = node.keys(content);
            content.iter().all(|(key, value)| keys.own(key).is_some_and(|node| is_default(node, value)))
        }
        (None, given) => is_off(given),
        _ => false,
    }
}

/// The type of a value, as a schema names it.
fn kind_of(value: &Value) -> &'static str {
    match value {
        Value::Number(_) => "number",
        Value::String(_) => "string",
        Value::Array(_) => "array",
        Value::Object(_) => "object",
        _ => "boolean",
    }
}

fn is_whole(node: Node, x: &serde_json::Number) -> bool {
    let within_format = match node.text("format") {
        Some("uint32") => x.as_u64().is_some_and(|x| x <= u32::MAX.into()),
        Some(format) if format.starts_with("uint") => x.is_u64(),
        _ => x.is_i64() || x.is_u64(),
    };
    within_format && x.as_f64().is_some_and(|x| node.allows_number(x))
}

pub(super) fn joined(path: &str, key: &str) -> String {
    if path.is_empty() { key.to_string() } else { format!("{path}.{key}") }
}

/// A value as messages show it.
pub(super) fn shown(value: &Value) -> String {
    match value {
        Value::Number(x) => x.as_f64().map_or_else(|| x.to_string(), |x| x.to_string()),
        value => value.to_string(),
    }
}
