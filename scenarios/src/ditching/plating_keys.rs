//! Keys of the plating of a landing's bottom, and what it must keep to.

use fsi_coupling::PanelEnd;
use scene::{MATERIALS, MaterialName};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use settings::{Problem, require, significant};
use water_entry::EntryModel;
use water_entry::ditching::Hull;

/// Bays of a plating, at most.
const MOST_BAYS: usize = 12;
/// Shortest bay, as a share of the girth: shorter ones are shorter than the elements of the water.
const SHORTEST: f64 = 0.02;

/// An item of `[[plating]]`: a part of the bottom, the same on both sides, whose plates bend between supports that run along the fuselage. Its
/// stresses are those of a strip along the girth, by boundary elements, in sections chosen by load.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PlatingKeys {
    /// A word that names it.
    pub name: String,
    /// Front end, from the nose [m].
    pub from: f64,
    /// Rear end, from the nose [m].
    pub to: f64,
    /// Places of the supports as shares of the girth from the keel, 0, to the edge of the bottom, 1 [-]; without one at 0 the first bay spans
    /// the keel, from its image to the first support.
    #[serde(default = "usual_supports")]
    pub supports: Vec<f64>,
    /// How the supports hold the plates: clamped, which is continuous over equal bays, or pinned.
    #[serde(default)]
    pub ends: PlateEnd,
    /// Thickness; the stress is that of its outer fibres, which lie elsewhere in a plate with stiffeners along the girth [m].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub thickness: f64,
    /// Material by name; `splashdown keywords material` lists the numbers. Keys that are given count before those of the name.
    #[schemars(extend("x-default" = "none"))]
    pub material: Option<MaterialName>,
    /// Young's modulus; the plate bends with E/(1 − ν²) [Pa].
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "required without material"))]
    pub youngs_modulus: Option<f64>,
    /// Poisson's ratio [-].
    #[schemars(extend("minimum" = 0, "exclusiveMaximum" = 0.5, "x-default" = "of material, or 0.3"))]
    pub poissons_ratio: Option<f64>,
    /// Density [kg/m³].
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "required without material"))]
    pub density: Option<f64>,
    /// Allowable stress; the reserve factor is this over the largest stress [Pa].
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "yield stress of material, or none"))]
    pub allowable_stress: Option<f64>,
    /// Cells of equal length along the fuselage: for each and each bay the section that presses most there is followed [-].
    #[serde(default = "usual_sections")]
    #[schemars(range(min = 1, max = 50))]
    pub sections: usize,
}

/// How a support holds a plate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PlateEnd {
    /// It does not turn.
    #[default]
    Clamped,
    /// It turns freely.
    Pinned,
}

fn usual_supports() -> Vec<f64> {
    vec![0.0, 0.25, 0.5, 0.75, 1.0]
}

fn usual_sections() -> usize {
    3
}

/// A strip of plate between two supports.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bay {
    /// Its ends as shares of the girth from the keel [-].
    pub girth: [f64; 2],
    /// How they are held.
    pub ends: [PanelEnd; 2],
}

/// Numbers of a plate's material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PlateMaterial {
    /// [Pa].
    pub youngs_modulus: f64,
    /// [-].
    pub poissons_ratio: f64,
    /// [kg/m³].
    pub density: f64,
    /// [Pa].
    pub allowable: Option<f64>,
}

impl PlatingKeys {
    /// Its strips, from the keel outwards.
    pub(super) fn bays(&self) -> Vec<Bay> {
        let end = match self.ends {
            PlateEnd::Clamped => PanelEnd::Clamped,
            PlateEnd::Pinned => PanelEnd::Pinned,
        };
        let at_keel = self.supports.first().filter(|first| **first > 0.0);
        let first = at_keel.map(|support| Bay { girth: [0.0, *support], ends: [PanelEnd::Mirror, end] });
        let others = self.supports.windows(2).map(|w| Bay { girth: [w[0], w[1]], ends: [end, end] });
        first.into_iter().chain(others).collect()
    }

    /// Its material; `None` without Young's modulus or density.
    pub(super) fn plate(&self) -> Option<PlateMaterial> {
        let known = MATERIALS.iter().find(|material| Some(material.name) == self.material);
        Some(PlateMaterial {
            youngs_modulus: self.youngs_modulus.or(known.map(|m| m.youngs_modulus))?,
            poissons_ratio: self.poissons_ratio.or(known.map(|m| m.poissons_ratio)).unwrap_or(0.3),
            density: self.density.or(known.map(|m| m.density))?,
            allowable: self.allowable_stress.or(known.map(|m| m.yield_stress)),
        })
    }
}

/// Refuses plating that is not on the bottom, or without a material.
pub(super) fn check(plating: &[PlatingKeys], hull: &Hull) -> Result<(), Problem> {
    let ([first, last], model) = (hull.fuselage().ends(), hull.model());
    for (k, keys) in plating.iter().enumerate() {
        let key = |name: &str| format!("plating[{k}].{name}");
        let expected = "wagner or mlm beside plating: von_karman has no pressures";
        require(model != EntryModel::VonKarman, "model", model.name(), expected)?;
        let expected = format_args!("a place from {first} to {last} m");
        require((first..last).contains(&keys.from), &key("from"), keys.from, expected)?;
        let expected = format_args!("more than {}, {} m, and up to {last} m", key("from"), keys.from);
        require(keys.to > keys.from && keys.to <= last, &key("to"), keys.to, expected)?;
        let inside = keys.supports.iter().all(|share| (0.0..=1.0).contains(share));
        let apart = keys.bays().iter().all(|bay| bay.girth[1] - bay.girth[0] >= SHORTEST);
        let count = (1..=MOST_BAYS).contains(&keys.bays().len());
        let expected = format_args!(
            "shares of the girth from 0 to 1 in order, at least {SHORTEST} apart, of 1 to {MOST_BAYS} bays"
        );
        require(inside && apart && count, &key("supports"), format!("{:?}", keys.supports), expected)?;
        let shortest = keys.bays().iter().map(|bay| bay.girth[1] - bay.girth[0]).fold(f64::INFINITY, f64::min);
        let girth = [keys.from, keys.to].map(|x| hull.girth(x)).into_iter().fold(f64::INFINITY, f64::min);
        let thickest = 0.5 * shortest * girth;
        let expected = format_args!("at most half the shortest bay, {} m", significant(thickest));
        require(keys.thickness <= thickest, &key("thickness"), keys.thickness, expected)?;
        if keys.plate().is_none() {
            let name = if keys.youngs_modulus.is_none() { "youngs_modulus" } else { "density" };
            return Err(Problem::missing(&key(name), "a number, or a material by name"));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn keys(supports: &[f64]) -> PlatingKeys {
        PlatingKeys {
            name: "belly".into(),
            from: 1.0,
            to: 2.0,
            supports: supports.to_vec(),
            ends: PlateEnd::Pinned,
            thickness: 0.002,
            material: Some(MaterialName::Aluminium2024T3),
            youngs_modulus: None,
            poissons_ratio: None,
            density: None,
            allowable_stress: Some(2e8),
            sections: 3,
        }
    }

    #[test]
    fn the_first_bay_spans_the_keel_without_a_support_there() {
        let bays = keys(&[0.2, 0.6]).bays();
        assert_eq!(bays[0], Bay { girth: [0.0, 0.2], ends: [PanelEnd::Mirror, PanelEnd::Pinned] });
        assert_eq!(bays[1], Bay { girth: [0.2, 0.6], ends: [PanelEnd::Pinned; 2] });
        assert_eq!(keys(&[0.0, 0.6]).bays().len(), 1);
    }

    #[test]
    fn given_numbers_count_before_those_of_a_material() {
        let plate = keys(&[0.0, 1.0]).plate().expect("a material");
        assert_eq!((plate.youngs_modulus, plate.allowable), (72.4e9, Some(2e8)));
        assert_eq!(PlatingKeys { material: None, ..keys(&[0.0, 1.0]) }.plate(), None);
    }
}
