//! What the table `[certify]` must keep to.

use scene::source::word;
use serde_json::{Value, json};
use settings::{Problem, require};

use super::certify_keys::FailureKeys;
use super::model::Scene;

/// A rule that is given as a number, `rule = 25.801`, as the word that it is.
pub(super) fn settle(given: &mut Value) {
    let rule = given.get_mut("certify").and_then(|keys| keys.get_mut("rule"));
    if let Some((rule, number)) = rule.and_then(|rule| rule.as_f64().map(|number| (rule, number))) {
        *rule = json!(number.to_string());
    }
}

/// Lists of numbers: key, values, least and most allowed.
type Listed<'a> = (&'a str, &'a Option<Vec<f64>>, [f64; 2]);

/// Refuses lists that are empty or have values out of their range, seas that are none, names that nothing has.
pub(super) fn check(scene: &Scene) -> Result<(), Problem> {
    let Some(keys) = &scene.certify else { return Ok(()) };
    let lists: [Listed<'_>; 5] = [
        ("pitches_deg", &keys.pitches_deg, [0.0, 30.0]),
        ("sink_speeds", &keys.sink_speeds, [0.01, 50.0]),
        ("forward_speeds", &keys.forward_speeds, [0.0, 300.0]),
        ("headings_deg", &keys.headings_deg, [0.0, 180.0]),
        ("phases_deg", &keys.phases_deg, [0.0, 360.0]),
    ];
    for (name, list, [least, most]) in lists {
        let Some(list) = list else { continue };
        require(!list.is_empty(), &format!("certify.{name}"), "[]", "at least one number")?;
        for (k, value) in list.iter().enumerate() {
            let expected = format_args!("a number from {least} to {most}");
            require((least..=most).contains(value), &format!("certify.{name}[{k}]"), value, expected)?;
        }
    }
    for (k, sea) in keys.seas.iter().flatten().enumerate() {
        sea.form(&format!("certify.seas[{k}]"))?;
    }
    require(
        keys.calm || keys.seas.as_ref().is_none_or(|seas| !seas.is_empty()),
        "certify.calm",
        "false",
        "true, or [[certify.seas]]",
    )?;
    let whole = keys.intact || !keys.failures.is_empty();
    require(whole, "certify.intact", "false", "true, or [[certify.failures]]")?;
    let mut known: Vec<&str> = Vec::new();
    let loadings = keys.loadings.iter().enumerate().map(|(k, l)| (format!("certify.loadings[{k}].name"), &l.name));
    let failures = keys.failures.iter().enumerate().map(|(k, f)| (format!("certify.failures[{k}].name"), &f.name));
    for (key, name) in loadings.chain(failures) {
        word(&key, name)?;
        require(!known.contains(&name.as_str()), &key, name, "a name that no other loading or failure has")?;
        known.push(name);
    }
    keys.failures.iter().enumerate().try_for_each(|(k, failure)| parts(scene, k, failure))
}

/// Refuses parts that the aeroplane does not have.
fn parts(scene: &Scene, k: usize, failure: &FailureKeys) -> Result<(), Problem> {
    let key = |name: &str| format!("certify.failures[{k}].{name}");
    let of_aeroplane: Vec<&str> = {
        let surfaces = scene.surfaces.iter().map(|s| s.name.as_str());
        let nacelles = scene.nacelles.iter().map(|n| n.name.as_str());
        let panels = scene.panels.iter().map(|p| p.name.as_str());
        surfaces.chain(nacelles).chain(panels).chain(scene.struts.iter().map(|s| s.name.as_str())).collect()
    };
    let openings: Vec<&str> = scene.openings.iter().map(|o| o.name.as_str()).collect();
    require(!failure.lost.is_empty(), &key("lost"), "[]", "at least one name")?;
    for (j, name) in failure.lost.iter().enumerate() {
        let names = [&of_aeroplane[..], &openings[..]].concat();
        let expected = format!("a part of the aeroplane: {}", names.join(", "));
        require(names.contains(&name.as_str()), &key(&format!("lost[{j}]")), format!("{name:?}"), expected)?;
        let closed = scene.openings.iter().any(|o| o.name == *name && o.area == 0.0) && failure.open_area.is_none();
        let expected = format!("an area through which water runs, as {name} is closed in the file");
        require(!closed, &key("open_area"), "none", expected)?;
    }
    let opens = failure.lost.iter().any(|name| openings.contains(&name.as_str()));
    let unused = failure.open_area.filter(|_| !opens);
    unused.map_or(Ok(()), |area| Err(Problem::new(&key("open_area"), area, "none without an opening in lost")))
}
