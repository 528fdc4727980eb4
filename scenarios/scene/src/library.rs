//! Materials and waters by name: `material` of a panel, `fluid.water`. Keys that the scene gives count before those of the name.

use schemars::JsonSchema;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

/// Materials with tabulated properties at room temperature.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum MaterialName {
    /// Aluminium 2024-T3, bare sheet of 0.25 to 3.25 mm.
    #[serde(rename = "aluminium_2024_t3")]
    Aluminium2024T3,
    /// Aluminium 7075-T6, bare sheet of 1 to 3.2 mm.
    #[serde(rename = "aluminium_7075_t6")]
    Aluminium7075T6,
    /// Aluminium 5083-H116, rolled, away from welds.
    #[serde(rename = "aluminium_5083_h116")]
    Aluminium5083H116,
    /// Aluminium 6082-T6, extruded up to 5 mm, away from welds.
    #[serde(rename = "aluminium_6082_t6")]
    Aluminium6082T6,
    /// Structural steel S235, up to 16 mm.
    #[serde(rename = "steel_s235")]
    SteelS235,
    /// Structural steel S355, up to 16 mm.
    #[serde(rename = "steel_s355")]
    SteelS355,
    /// Stainless steel 316L (1.4404), hot-rolled plate.
    #[serde(rename = "stainless_316l")]
    Stainless316l,
    /// Titanium Ti-6Al-4V, annealed sheet up to 4.8 mm.
    #[serde(rename = "titanium_6al_4v")]
    Titanium6al4v,
}

/// Waters at a temperature.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum WaterName {
    /// Fresh water of 15 °C.
    #[serde(rename = "fresh_15C")]
    Fresh15C,
    /// Fresh water of 20 °C.
    #[serde(rename = "fresh_20C")]
    Fresh20C,
    /// Sea water of 15 °C and 35.17 g/kg of salt.
    #[serde(rename = "sea_15C")]
    Sea15C,
    /// Sea water of 20 °C and 35.17 g/kg of salt.
    #[serde(rename = "sea_20C")]
    Sea20C,
}

/// A material.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct MaterialProperties {
    /// Its name in a scene.
    pub name: MaterialName,
    /// Young's modulus [Pa].
    pub youngs_modulus: f64,
    /// Poisson's ratio [-].
    pub poissons_ratio: f64,
    /// Density [kg/m³].
    pub density: f64,
    /// Yield stress, or proof stress of 0.2 % [Pa]; the allowable stress too.
    pub yield_stress: f64,
    /// Source of the numbers.
    pub source: &'static str,
}

/// A water.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct WaterProperties {
    /// Its name in a scene.
    pub name: WaterName,
    /// Density [kg/m³].
    pub density: f64,
    /// Source of the number.
    pub source: &'static str,
}

const AEROSPACE: &str = "MIL-HDBK-5H (1998), A-basis";
const ALUMINIUM: &str = "EN 1999-1-1:2007, table 3.2";
const STEEL: &str = "EN 1993-1-1:2005, table 3.1";
const WATERS: &str = "ITTC 7.5-02-01-03 (2011)";

const fn material(
    name: MaterialName,
    [gpa, poissons_ratio, density, mpa]: [f64; 4],
    source: &'static str,
) -> MaterialProperties {
    let (youngs_modulus, yield_stress) = (gpa * 1e9, mpa * 1e6);
    MaterialProperties { name, youngs_modulus, poissons_ratio, density, yield_stress, source }
}

/// The materials, each with Young's modulus [GPa], Poisson's ratio, density [kg/m³] and yield stress [MPa].
pub const MATERIALS: [MaterialProperties; 8] = [
    material(MaterialName::Aluminium2024T3, [72.4, 0.33, 2768.0, 324.0], AEROSPACE),
    material(MaterialName::Aluminium7075T6, [71.0, 0.33, 2796.0, 483.0], AEROSPACE),
    material(MaterialName::Aluminium5083H116, [70.0, 0.3, 2700.0, 215.0], ALUMINIUM),
    material(MaterialName::Aluminium6082T6, [70.0, 0.3, 2700.0, 250.0], ALUMINIUM),
    material(MaterialName::SteelS235, [210.0, 0.3, 7850.0, 235.0], STEEL),
    material(MaterialName::SteelS355, [210.0, 0.3, 7850.0, 355.0], STEEL),
    material(MaterialName::Stainless316l, [200.0, 0.3, 8000.0, 220.0], "EN 1993-1-4:2006, table 2.1"),
    material(MaterialName::Titanium6al4v, [110.3, 0.31, 4429.0, 869.0], AEROSPACE),
];

/// The waters.
pub const WATER_TABLE: [WaterProperties; 4] = [
    WaterProperties { name: WaterName::Fresh15C, density: 999.1, source: WATERS },
    WaterProperties { name: WaterName::Fresh20C, density: 998.2, source: WATERS },
    WaterProperties { name: WaterName::Sea15C, density: 1026.0, source: WATERS },
    WaterProperties { name: WaterName::Sea20C, density: 1024.8, source: WATERS },
];

/// Replaces the names of materials and of the water by their numbers.
pub(super) fn settle(given: &mut Value) {
    if let Some(fluid) = given.get_mut("fluid").and_then(Value::as_object_mut) {
        let name: Option<WaterName> = named(fluid, "water");
        let water = WATER_TABLE.iter().find(|water| Some(water.name) == name);
        water.into_iter().for_each(|water| fill(fluid, "water", &[("density", water.density)]));
    }
    let panels = given.get_mut("body").and_then(|body| body.get_mut("panels")).and_then(Value::as_array_mut);
    for panel in panels.into_iter().flatten().filter_map(Value::as_object_mut) {
        let name: Option<MaterialName> = named(panel, "material");
        let Some(found) = MATERIALS.iter().find(|material| Some(material.name) == name) else { continue };
        // a beam that shears does not yield in this program
        let elastic = panel.get("theory").is_some_and(|theory| theory == "timoshenko");
        let numbers = [
            ("youngs_modulus", found.youngs_modulus),
            ("poissons_ratio", found.poissons_ratio),
            ("density", found.density),
            ("allowable_stress", panel.get("yield_stress").and_then(Value::as_f64).unwrap_or(found.yield_stress)),
            ("yield_stress", found.yield_stress),
        ];
        fill(panel, "material", if elastic { &numbers[..4] } else { &numbers });
    }
}

/// The name at a key, if it is one.
fn named<T: DeserializeOwned>(table: &Map<String, Value>, key: &str) -> Option<T> {
    table.get(key).and_then(|name| serde_json::from_value(name.clone()).ok())
}

/// Writes numbers where none are given, and removes the name.
fn fill(table: &mut Map<String, Value>, name: &str, numbers: &[(&str, f64)]) {
    table.remove(name);
    for (key, value) in numbers {
        table.entry(*key).or_insert_with(|| Value::from(*value));
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn numbers_that_the_scene_gives_count_before_those_of_the_name() {
        let mut scene = json!({"fluid": {"water": "sea_15C"}, "body": {"panels": [
            {"material": "aluminium_2024_t3", "density": 2700.0}, {"material": "steel_s355", "theory": "timoshenko"},
            {"material": "cheese"}]}});
        settle(&mut scene);
        assert_eq!(scene["fluid"], json!({"density": 1026.0}));
        let panels = &scene["body"]["panels"];
        assert!(panels[0]["density"] == 2700.0 && panels[0]["yield_stress"] == 324e6, "{panels}");
        assert!(panels[1].get("yield_stress").is_none() && panels[1]["allowable_stress"] == 355e6, "{panels}");
        assert_eq!(panels[2], json!({"material": "cheese"}), "refused by the schema");
    }
}
