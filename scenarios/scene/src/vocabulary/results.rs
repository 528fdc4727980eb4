//! The results of a run.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use serde::ser::SerializeMap;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::Value;

use super::bandwidth::BandwidthBy;
use super::names::{ResultId, ResultName};
use super::quantity::Quantity;
use super::verdict::Verdict;

/// Results with their names.
pub type Named = BTreeMap<ResultName, Quantity>;

/// The results of a run; what a scene does not have is absent.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Results {
    /// Of the body.
    pub body: Named,
    /// What the bandwidth of force and acceleration follows from; absent without an averaged force.
    pub bandwidth_by: Option<BandwidthBy>,
    /// Of each panel, by name.
    pub panels: BTreeMap<String, Named>,
}

const BANDWIDTH: &str = "bandwidth_by";
const PANELS: &str = "panels";

impl Results {
    /// A result of the body.
    pub fn get(&self, name: ResultName) -> Option<Quantity> {
        self.body.get(&name).copied()
    }

    /// A result of a panel.
    pub fn of_panel(&self, panel: &str, name: ResultName) -> Option<Quantity> {
        self.panels.get(panel)?.get(&name).copied()
    }

    /// All results: those of the body, then those of each panel.
    pub fn named(&self) -> impl Iterator<Item = (ResultId, &Quantity)> {
        let body = self.body.iter().map(|(name, quantity)| (ResultId { panel: None, name: *name }, quantity));
        let panels = self.panels.iter().flat_map(|(panel, named)| {
            named.iter().map(|(name, quantity)| (ResultId { panel: Some(panel.clone()), name: *name }, quantity))
        });
        body.chain(panels)
    }

    /// All results, to be changed.
    pub fn quantities_mut(&mut self) -> impl Iterator<Item = &mut Quantity> {
        self.body.values_mut().chain(self.panels.values_mut().flat_map(BTreeMap::values_mut))
    }
}

impl Serialize for Results {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        self.body.iter().try_for_each(|(name, quantity)| map.serialize_entry(name, quantity))?;
        self.bandwidth_by.iter().try_for_each(|by| map.serialize_entry(BANDWIDTH, by))?;
        if !self.panels.is_empty() {
            map.serialize_entry(PANELS, &self.panels)?;
        }
        map.end()
    }
}

/// A quantity of version 0.1.0, whose verdict could be `beyond_allowable`, as this program writes it.
fn present(mut quantity: Value) -> Value {
    if quantity["verdict"] == "beyond_allowable" {
        (quantity["verdict"], quantity["allowed"]) = (Verdict::NoBand.name().into(), false.into());
    }
    quantity
}

impl<'de> Deserialize<'de> for Results {
    /// What this program does not know, of a summary of another version, is left out.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Results, D::Error> {
        let mut table = BTreeMap::<String, Value>::deserialize(deserializer)?;
        let named = |table: BTreeMap<String, Value>| -> Named {
            let known = table.into_iter().filter_map(|(name, value)| Some((ResultName::of(&name)?, value)));
            known.filter_map(|(name, value)| Some((name, Quantity::deserialize(present(value)).ok()?))).collect()
        };
        let mut take = |key: &str| match table.entry(key.into()) {
            Entry::Occupied(entry) => Some(entry.remove()),
            Entry::Vacant(_) => None,
        };
        let panels: BTreeMap<String, BTreeMap<String, Value>> =
            take(PANELS).and_then(|value| Deserialize::deserialize(value).ok()).unwrap_or_default();
        let bandwidth_by = take(BANDWIDTH).and_then(|value| Deserialize::deserialize(value).ok());
        let panels = panels.into_iter().map(|(panel, table)| (panel, named(table))).collect();
        Ok(Results { body: named(table), bandwidth_by, panels })
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn a_summary_of_version_0_1_keeps_what_is_beyond_the_allowable() {
        let old = json!({ "value": 1.0, "time_s": 0.1, "band": null, "verdict": "beyond_allowable" });
        let results = Results::deserialize(json!({ "panels": { "bow": { ResultName::PeakStress.name(): old } } }));
        let stress = results.expect("results").of_panel("bow", ResultName::PeakStress).expect("a stress");
        assert_eq!((stress.verdict, stress.allowed), (Verdict::NoBand, Some(false)));
    }
}
