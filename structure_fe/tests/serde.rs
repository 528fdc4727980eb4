//! Materials and sections as scene files would give them.

mod common;

use common::MATERIAL;
use serde::Deserialize;
use serde::de::value::{Error, MapAccessDeserializer, MapDeserializer};
use std::collections::BTreeMap;
use structure_fe::{Material, Section};

type Fields<'a> = BTreeMap<&'a str, f64>;

fn material(fields: Fields) -> Result<Material, Error> {
    Material::deserialize(MapDeserializer::new(fields.into_iter()))
}

fn section(shape: &str, fields: Fields) -> Result<Section, Error> {
    let map = MapDeserializer::new([(shape, fields)].into_iter());
    Section::deserialize(MapAccessDeserializer::new(map))
}

#[test]
fn a_material_is_its_three_constants_and_nothing_else() {
    let fields = BTreeMap::from([("youngs_modulus", 70e9), ("poissons_ratio", 0.33), ("density", 2700.0)]);
    assert_eq!(material(fields.clone()).unwrap(), MATERIAL);
    let mut misspelt = fields.clone();
    misspelt.insert("densty", 1.0);
    assert!(material(misspelt).unwrap_err().to_string().contains("densty"));
    let mut incomplete = fields;
    incomplete.remove("density");
    assert!(material(incomplete).unwrap_err().to_string().contains("density"));
}

#[test]
fn a_section_is_a_named_shape_with_its_sizes() {
    let strip = section("strip", BTreeMap::from([("thickness", 0.02)]));
    assert_eq!(strip.unwrap(), Section::strip(0.02));
    let sizes = BTreeMap::from([("thickness", 0.02), ("width", 0.3)]);
    let bar = section("rectangular", sizes.clone()).unwrap();
    assert_eq!(bar, Section::rectangular(0.02, 0.3));
    let error = section("strip", sizes).unwrap_err().to_string();
    assert!(error.contains("width"), "{error}");
}
