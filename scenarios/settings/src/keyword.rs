//! Keywords: the keys of a schema in words.

use serde::Serialize;
use serde_json::{Map, Value};

use super::check::joined;
use super::node::Node;

/// A key in words.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Keyword {
    /// Its path, such as `body.mass`; `gauges[].at` stands in each `[[gauges]]` table.
    #[serde(rename = "key")]
    pub path: String,
    /// Unit of its value, `-` for a pure number, empty for anything else.
    pub unit: String,
    /// Its value where it is absent, or `required`.
    pub default: String,
    /// What it means.
    pub doc: String,
    /// The values that it takes.
    pub takes: String,
}

impl Keyword {
    /// The keyword in one line.
    pub fn help(&self) -> String {
        let Keyword { path, unit, default, doc, takes } = self;
        let unit = if unit.is_empty() { String::new() } else { format!(" [{unit}]") };
        match default.starts_with("required") {
            true => format!("{path}{unit}: {doc}; {takes} ({default})"),
            false => format!("{path}{unit}: {doc}; {takes} (default: {default})"),
        }
    }

    /// The keyword as a row of a Markdown table.
    pub(super) fn row(&self) -> String {
        let Keyword { path, unit, default, doc, takes } = self;
        let cell = |text: &str| text.replace('|', "\\|");
        format!("| `{path}` | {unit} | {} | {} | {} |\n", cell(takes), cell(default), cell(doc))
    }
}

/// Stands for any key in the path of a keyword.
const FREE: &str = "KEY";

/// The keywords of a table and of the tables in it, in their order.
pub(super) fn collect(node: Node, path: &str, words: &mut Vec<Keyword>) {
    let keys = node.keys(&Map::new());
    let foreign = keys.foreign.iter().map(|foreign| (foreign.key, foreign.node, Some(foreign.owner)));
    let own = keys.own.iter().map(|(key, node)| (*key, *node, None));
    let free = node.free_key().map(|child| (FREE, child, None));
    for (key, child, owner) in own.chain(foreign).chain(free) {
        let at = joined(path, key);
        let (inner, _) = child.given();
        let is_tag = keys.tags.iter().any(|(tag, _)| *tag == key);
        match (inner.kind(), inner.get("items").map(Node)) {
            (Some("array"), Some(item)) if item.kind() == Some("object") => collect(item, &format!("{at}[]"), words),
            (Some("object"), _) if !is_tag => {
                if !child.kinds_of_values().is_empty() {
                    words.push(of_key(&at, node, child, key, false));
                }
                collect(inner, &at, words);
            }
            _ if words.iter().any(|known| known.path == at) => {}
            _ if is_tag => words.push(of_tag(&at, child)),
            _ => words.push(of_key(&at, node, child, key, owner.is_some() || is_of_variant(node, key))),
        }
    }
}

/// True for a key that only some variants of a table have.
fn is_of_variant(table: Node, key: &str) -> bool {
    table.get("properties").and_then(|properties| properties.get(key)).is_none()
}

fn of_tag(path: &str, node: Node) -> Keyword {
    let doc = node.text("x-tag").unwrap_or_default();
    let usual = node.text("x-tag-default").unwrap_or("required");
    Keyword {
        path: path.into(),
        unit: String::new(),
        default: usual.into(),
        doc: doc.into(),
        takes: node.tag_words().join(" | "),
    }
}

fn of_key(path: &str, table: Node, node: Node, key: &str, of_variant: bool) -> Keyword {
    let of_table = || table.text("description").filter(|_| key == FREE);
    let (doc, unit) = meaning(node.text("description").or_else(of_table).unwrap_or_default());
    let default = match (node.text("x-default"), node.get("default")) {
        (Some(text), _) => text.to_string(),
        (None, Some(value)) => written(value),
        (None, None) if !table.requires(key) => "absent".into(),
        (None, None) if of_variant => required_by(table, key),
        (None, None) => "required".into(),
    };
    Keyword { path: path.into(), unit, default, doc, takes: takes(node) }
}

/// `required by` the tags that have the key, in the order of the schema.
fn required_by(table: Node, key: &str) -> String {
    let owners = table.owners(key);
    if owners.is_empty() { "required".into() } else { format!("required by {}", owners.join(", ")) }
}

/// The text of a description and the unit that ends its first sentence.
pub(super) fn meaning(description: &str) -> (String, String) {
    let text = description.split_whitespace().collect::<Vec<_>>().join(" ");
    let end = text.find(". ").unwrap_or_else(|| text.trim_end_matches('.').len());
    let (sentence, rest) = text.split_at(end);
    let rest = rest.trim_end_matches('.');
    match sentence.strip_suffix(']').and_then(|sentence| sentence.rsplit_once(" [")) {
        Some((sentence, unit)) => (format!("{sentence}{rest}"), unit.to_string()),
        None => (format!("{sentence}{rest}"), String::new()),
    }
}

/// What a key takes: words as they are written, else in a phrase.
fn takes(node: Node) -> String {
    let words = node.given_words();
    if words.is_empty() { node.expected() } else { words.join(" | ") }
}

/// A default as a scene file has it.
fn written(value: &Value) -> String {
    match value {
        Value::Null => "absent".into(),
        Value::String(word) if !word.is_empty() => word.clone(),
        Value::Number(x) if x.as_f64().is_some_and(|x| x != 0.0 && x.abs() < 1e-3) => {
            format!("{:e}", x.as_f64().unwrap_or_default())
        }
        Value::Array(items) => format!("[{}]", items.iter().map(item).collect::<Vec<_>>().join(", ")),
        value => value.to_string(),
    }
}

/// An item of a list as a scene file has it: words in quotes.
fn item(value: &Value) -> String {
    match value {
        Value::String(word) => format!("{word:?}"),
        value => written(value),
    }
}
