//! Keys of what carries or floods an aeroplane beside its bottom: struts, openings, flotation.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Discharge coefficient of a sharp-edged opening (Torricelli's law with a contracted jet).
pub(super) const DISCHARGE: f64 = 0.6;

/// An item of `[[struts]]`: a strut along the normal of the body axis with wheels or a float; loads and masses are those of one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StrutKeys {
    /// A word that names them.
    pub name: String,
    /// How many of them side by side.
    #[serde(default = "usual::number")]
    #[schemars(range(min = 1, max = 12))]
    pub number: u32,
    /// Lowest point of wheel or float, extended: from the nose, over the body axis [m].
    pub foot: [f64; 2],
    /// Mass that moves with wheel or float; part of the aeroplane's mass [kg].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub mass: f64,
    /// Largest stroke; beyond it a stop stands, 20 times as stiff as the load there over the stroke [m].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub stroke: f64,
    /// Load at which the stroke begins [N].
    #[serde(default)]
    #[schemars(range(min = 0.0))]
    pub preload: f64,
    /// Stiffness of a linear spring [N/m].
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "required unless gas_length"))]
    pub stiffness: Option<f64>,
    /// Length of the gas column of an oleo, extended; more than the stroke [m].
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "required unless stiffness"))]
    pub gas_length: Option<f64>,
    /// Exponent of the polytropic compression of the gas [-].
    #[serde(default = "usual::exponent")]
    #[schemars(range(min = 1.0, max = 1.67))]
    pub gas_exponent: f64,
    /// Load per speed of the stroke [N s/m].
    #[serde(default)]
    #[schemars(range(min = 0.0))]
    pub damping: f64,
    /// Load per square of the speed of the stroke, of an orifice [N s²/m²].
    #[serde(default)]
    #[schemars(range(min = 0.0))]
    pub orifice: f64,
    /// Force on the fuselage, weight of the foot included, at which it is lost [N].
    #[schemars(extend("exclusiveMinimum" = 0, "x-default" = "it holds"))]
    pub breaks_at: Option<f64>,
    /// Breadth and height above the foot of what stands against the water: wheels and leg [m], shape (2).
    pub face: [f64; 2],
    /// Drag coefficient of its immersed part [-].
    #[serde(default = "usual::drag")]
    #[schemars(range(min = 0.0, max = 2.0))]
    pub drag: f64,
    /// Area of a float's waterplane; its buoyancy is that of upright sides [m²].
    #[serde(default)]
    #[schemars(range(min = 0.0))]
    pub waterplane: f64,
}

mod usual {
    pub fn number() -> u32 {
        1
    }
    /// Air in oleos that stroke fast (Milwitzky & Cook 1953).
    pub fn exponent() -> f64 {
        1.12
    }
    /// A disc in a cavity (Reichardt 1946).
    pub fn drag() -> f64 {
        0.8
    }
}

/// Table `[flotation]`: how the aeroplane floats after it has stopped.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct FlotationKeys {
    /// End of time after the stop [s].
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub end: f64,
}

impl Default for FlotationKeys {
    fn default() -> FlotationKeys {
        FlotationKeys { end: 1800.0 }
    }
}

/// An item of `[[openings]]`: an exit or another hole of the fuselage.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OpeningKeys {
    /// A word that names it.
    pub name: String,
    /// Its sill: from the nose, over the body axis [m].
    pub sill: [f64; 2],
    /// Area that water runs through; 0 for a closed exit, of which only the time is given at which its sill is wet [m²].
    #[schemars(range(min = 0.0))]
    pub area: f64,
    /// Discharge coefficient [-].
    #[serde(default = "usual_discharge")]
    #[schemars(range(min = 0.1, max = 1.0))]
    pub discharge: f64,
}

fn usual_discharge() -> f64 {
    DISCHARGE
}
