//! `splashdown keywords` and `schema`: every key, material and water.

use clap::Args;
use scene::{MATERIALS, WATER_TABLE, nearest};
use serde_json::{Value, json};
use settings::{Keyword, Schema};

use super::shared::{DONE, Output, Stop, say};
use crate::reference_page::reference_page;
use crate::{ditching, planing, sweep};

#[derive(Args)]
pub(super) struct KeywordsArgs {
    /// Only keys that start so, as `body.` or `landing`; `material` and `water` list those too.
    prefix: Option<String>,
    /// As a page of Markdown, with the keys of landings and of embedded elements.
    #[arg(long, conflicts_with = "prefix")]
    markdown: bool,
}

/// The files that have keys.
fn readers() -> [(&'static str, &'static Schema); 4] {
    [
        ("scene", scene::schema()),
        ("landing", ditching::schema()),
        ("planing hull", planing::schema()),
        ("sweep", sweep::schema()),
    ]
}

pub(super) fn keywords(output: &Output, args: &KeywordsArgs) -> Result<u8, Stop> {
    if args.markdown {
        say(reference_page().trim_end());
        return Ok(DONE);
    }
    let prefix = args.prefix.as_deref().unwrap_or_default();
    let mut found = 0;
    for (file, schema) in readers() {
        for keyword in schema.keywords().iter().filter(|keyword| starts_with(&keyword.path, prefix)) {
            found += 1;
            tell(output, file, keyword);
        }
    }
    found += tell_library(output, prefix);
    if found == 0 { Err(unknown(prefix)) } else { Ok(DONE) }
}

/// True for a key, with its tables or alone, that starts so.
fn starts_with(path: &str, prefix: &str) -> bool {
    let [path, prefix] = [path, prefix].map(|text| text.replace("[]", "").to_lowercase());
    path.starts_with(&prefix) || path.rsplit('.').next().is_some_and(|key| key == prefix)
}

fn tell(output: &Output, file: &str, keyword: &Keyword) {
    if output.json {
        let mut line = json!(keyword);
        line["file"] = Value::from(file);
        return say(line);
    }
    let Keyword { path, doc, takes, unit, default } = keyword;
    let of = if file == "scene" { String::new() } else { format!(" (of a {file})") };
    say(format_args!("{path}{of}\n    {doc}; {takes} (unit: {unit}; default: {default})"));
}

/// Lists the materials or the waters; how many.
fn tell_library(output: &Output, prefix: &str) -> usize {
    let materials = MATERIALS.iter().map(|material| json!(material)).collect::<Vec<_>>();
    let waters = WATER_TABLE.iter().map(|water| json!(water)).collect::<Vec<_>>();
    let (kind, entries) = match prefix {
        "material" | "materials" => ("material", materials),
        "water" | "waters" => ("water", waters),
        _ => return 0,
    };
    for entry in &entries {
        if output.json {
            say(json!({ kind: entry }));
            continue;
        }
        let number = |key: &str, scale: f64, unit: &str| {
            entry[key].as_f64().map(|value| format!("{key} {} {unit}", settings::significant(value / scale)))
        };
        let numbers = [
            number("youngs_modulus", 1e9, "GPa"),
            number("poissons_ratio", 1.0, "-"),
            number("density", 1.0, "kg/m³"),
            number("yield_stress", 1e6, "MPa"),
        ];
        let numbers: Vec<String> = numbers.into_iter().flatten().collect();
        let [name, source] = ["name", "source"].map(|key| entry[key].as_str().unwrap_or_default());
        say(format_args!("{name}\n    {} ({source})", numbers.join(", ")));
    }
    entries.len()
}

fn unknown(prefix: &str) -> Stop {
    let keys = readers().into_iter().flat_map(|(_, schema)| {
        let keys = schema.keywords().iter().map(|keyword| keyword.path.as_str());
        keys.chain(schema.tables())
    });
    let near = nearest(prefix, keys).map_or(String::new(), |near| format!(": did you mean `{near}`?"));
    Stop::Input(format!("no key starts with `{prefix}`{near}"))
}

pub(super) fn schema() -> Result<u8, Stop> {
    say(format_args!("{:#}", scene::schema().to_json()));
    Ok(DONE)
}
