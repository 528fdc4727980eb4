//! The schema of a struct of settings.

use std::borrow::Cow;
use std::marker::PhantomData;

use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, SchemaGenerator, json_schema};
use serde_json::Value;

use super::check::{Checker, Place, joined};
use super::keyword::{self, Keyword};
use super::node::Node;
use super::problem::Problem;
use super::units;

/// The JSON Schema (draft 2020-12) of a struct of settings, and its keywords.
#[derive(Debug, Clone, PartialEq)]
pub struct Schema {
    value: Value,
    /// The same, where a number may be a string with a unit too.
    published: Value,
    keywords: Vec<Keyword>,
    noun: &'static str,
}

/// In a schema: a `T`, or the word `touching`, which means the same as an absent key.
pub struct OrTouching<T>(PhantomData<T>);

impl<T: JsonSchema> JsonSchema for OrTouching<T> {
    fn schema_name() -> Cow<'static, str> {
        format!("{}OrTouching", T::schema_name()).into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> schemars::Schema {
        json_schema!({ "anyOf": [generator.subschema_for::<T>(), { "const": "touching" }] })
    }
}

impl Schema {
    /// The schema of `T`; `noun` names such settings in messages: "a scene".
    pub fn of<T: JsonSchema>(noun: &'static str) -> Schema {
        let settings = SchemaSettings::draft2020_12().with(|settings| settings.inline_subschemas = true);
        let mut value = settings.into_generator().into_root_schema_for::<T>().to_value();
        finish(&mut value, true);
        let mut keywords = Vec::new();
        keyword::collect(Node(&value), "", &mut keywords);
        let mut published = value.clone();
        units::allow_strings(&mut published, false);
        Schema { value, published, keywords, noun }
    }

    /// As JSON.
    pub fn to_json(&self) -> &Value {
        &self.published
    }

    /// What the settings are called in messages: "a scene".
    pub fn noun(&self) -> &'static str {
        self.noun
    }

    /// The given settings with each string that has a unit, `"4 mm"`, as a number in the unit of its key; a number beyond `largest`
    /// is refused as one is that was given without a unit.
    pub fn in_si(&self, given: Value, largest: f64) -> Result<Value, Problem> {
        units::Conversion { unit_of: &|path| self.keyword(path).map(|keyword| keyword.unit.as_str()), largest }
            .value(given, "", None)
    }

    /// All keys, in the order of their declaration.
    pub fn keywords(&self) -> &[Keyword] {
        &self.keywords
    }

    /// All keys as a Markdown table.
    pub fn markdown(&self) -> String {
        let rows = self.keywords.iter().map(Keyword::row);
        rows.fold("| key | unit | takes | default | meaning |\n|---|---|---|---|---|\n".to_string(), |page, row| {
            page + &row
        })
    }

    /// The keyword at a path, where `gauges[2].at` and `gauges[].at` are the same.
    pub fn keyword(&self, path: &str) -> Option<&Keyword> {
        let path = without_indices(path);
        // an item of a list belongs to the key of the list
        let key = path.trim_end_matches("[]");
        self.keywords.iter().find(|keyword| keyword.path == key)
    }

    /// The settings without what says nothing: words such as `auto`, neutral keys of other variants. A wrong type, a value out
    /// of range, an unknown key and a key without effect are refused; required keys are not asked for.
    pub fn check(&self, given: &Value) -> Result<Value, Problem> {
        let node = Node(&self.value);
        let content = given.as_object().ok_or_else(|| Problem::new("", given, "a table of keys"))?;
        let root = Place { node, content };
        Checker { unknown: &|path| self.unknown(path), root }.table(node, &[], content, "").map(Value::Object)
    }

    /// The refusal of a key that is absent, found by serde at `table`; anything else that serde refuses in its words.
    pub fn missing(&self, table: &str, error: &serde_json::Error) -> Problem {
        let text = error.to_string();
        let Some(key) = text.strip_prefix("missing field `").and_then(|rest| rest.split('`').next()) else {
            let sentence = format!("`{table}`: {text}");
            return Problem { key: table.to_string(), sentence, ..Problem::default() };
        };
        let path = joined(table, key);
        let keyword = self.keyword(&path);
        let expected = keyword.map_or("a value".to_string(), |word| match word.unit.as_str() {
            "" => format!("{}; {}", word.takes, word.doc),
            unit => format!("{} [{unit}]: {}", word.takes, word.doc),
        });
        Problem::missing(&path, expected)
    }

    /// The refusal of an unknown key, with the nearest known one.
    fn unknown(&self, path: &str) -> Problem {
        let near = self.nearest(path).map_or(String::new(), |near| format!(", such as `{near}`"));
        let expected = format!("a key of {}{near}", self.noun);
        let sentence = format!("unknown key `{path}`: expected {expected}");
        Problem { key: path.to_string(), sentence, given: Some(path.to_string()), expected, line: None }
    }

    /// The known path nearest to an unknown one: few edits of the last word, few changes of table.
    fn nearest(&self, path: &str) -> Option<&str> {
        let path = without_indices(path);
        let (table, key) = path.rsplit_once('.').unwrap_or(("", &path));
        let cost = |known: &&str| {
            let (its_table, its_key) = known.rsplit_once('.').unwrap_or(("", known));
            3 * strsim::levenshtein(key, its_key) + strsim::levenshtein(table, its_table).min(2)
        };
        let keys = self.keywords.iter().map(|keyword| keyword.path.as_str());
        let best = keys.chain(self.tables()).min_by_key(cost)?;
        // more than a third of the word changed is another word
        (cost(&best) <= key.chars().count() + 2).then_some(best)
    }

    /// The tables that hold keys, such as `body` and `body.panels`; most of them several times.
    pub fn tables(&self) -> impl Iterator<Item = &str> {
        let around = |path: &'_ str| path.match_indices('.').map(|(at, _)| at).collect::<Vec<_>>();
        let tables = move |path| around(path).into_iter().map(move |at: usize| path[..at].trim_end_matches("[]"));
        self.keywords.iter().flat_map(move |keyword| tables(keyword.path.as_str()))
    }
}

/// Keys whose value the program finds are not required, and no table has keys beyond its own.
fn finish(schema: &mut Value, is_whole: bool) {
    describe_tags(schema);
    let usual = schema.get("x-tag-default").cloned();
    for list in ["oneOf", "anyOf", "allOf"] {
        for part in schema.get_mut(list).and_then(Value::as_array_mut).into_iter().flatten() {
            if let Some(usual) = &usual {
                release_tag(part, usual);
            }
            finish(part, list == "anyOf" && part.get("properties").is_some());
        }
    }
    if let Some(items) = schema.get_mut("items") {
        finish(items, true);
    }
    let Some(table) = schema.as_object_mut() else { return };
    let mut found = Vec::new();
    for (key, property) in table.get_mut("properties").and_then(Value::as_object_mut).into_iter().flatten() {
        finish(property, true);
        if property.get("x-default").is_some() {
            found.push(key.clone());
        }
    }
    if let Some(required) = table.get_mut("required").and_then(Value::as_array_mut) {
        required.retain(|key| !found.iter().any(|found| key.as_str() == Some(found)));
    }
    if is_whole && table.get("type").is_some_and(|kind| kind == "object") {
        table.insert("unevaluatedProperties".into(), false.into());
    }
}

/// Writes default and meaning of each tag of a table, `x-shape-default` and `x-shape-doc`, beside the tag's variants.
fn describe_tags(table: &mut Value) {
    let outer = table.clone();
    let describe = |part: &mut Value| {
        let Some(tag) = Node(part).tag_name().map(String::from) else { return };
        for (from, to) in [("default", "x-tag-default"), ("doc", "x-tag")] {
            if let Some(value) = outer.get(format!("x-{tag}-{from}")) {
                part[to] = value.clone();
            }
        }
    };
    describe(table);
    table.get_mut("allOf").and_then(Value::as_array_mut).into_iter().flatten().for_each(describe);
}

/// A variant that an absent tag means does not require the tag.
fn release_tag(variant: &mut Value, usual: &Value) {
    let properties = variant.get("properties").and_then(Value::as_object).into_iter().flatten();
    let tag = properties.filter(|(_, node)| node.get("const") == Some(usual)).map(|(key, _)| key.clone()).next();
    if let (Some(tag), Some(required)) = (tag, variant.get_mut("required").and_then(Value::as_array_mut)) {
        required.retain(|key| key.as_str() != Some(&tag));
    }
}

/// `gauges[2].at` as `gauges[].at`.
fn without_indices(path: &str) -> String {
    let mut parts = path.split('[');
    let first = parts.next().unwrap_or_default().to_string();
    parts.fold(first, |known, part| known + "[]" + part.split_once(']').map_or("", |(_, rest)| rest))
}
