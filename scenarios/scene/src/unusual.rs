//! Keys of the method that a scene sets otherwise than the program would.
//!
//! Bands and charts are measured with the values that the program chooses. A scene is compared with itself, resolved again without its keys
//! of the method: what differs then was set by hand.

use serde_json::{Map, Value};
use sph_core::Solver;

use super::draft::Draft;
use super::keys::{Scene, schema};
use super::resolve::resolve;

/// Tables of keys of the method, and the keys in them that say what flows, how finely, and how compressible it is: charts and bands have these
/// as parameters.
const TABLES: [(&str, &[&str]); 6] = [
    ("fluid", &["density", "sound_speed", "compressibility_error"]),
    ("projection", &[]),
    ("thesis", &[]),
    ("resolution", &["spacing"]),
    ("coupling", &[]),
    ("time", &["end", "sample_every", "frame_every"]),
];

/// Largest kinematic viscosity that no band sees: some times that of cold water [m²/s].
const OF_WATER: f64 = 1e-5;

/// A key that is not what the program would choose.
#[derive(Clone, Debug, PartialEq)]
pub struct Unusual {
    /// The key.
    pub key: String,
    /// Its value.
    pub value: Value,
    /// The value that the program would choose; `Null` for none.
    pub usual: Value,
}

impl Scene {
    /// A solver whose bands were not measured.
    fn unmeasured_solver(&self) -> Option<Unusual> {
        let measured = matches!(self.solver.kind(), Solver::WeaklyCompressible | Solver::Incompressible);
        let [value, usual] = [self.solver.name(), "weakly_compressible"].map(Value::from);
        (!measured).then(|| Unusual { key: "solver".into(), value, usual })
    }

    /// Keys of the method that differ from the program's choice, where that may change the flow by more than a band; the keys of
    /// `parameters`, such as `fluid.kernel`, count as they are.
    pub fn unusual_keys(&self, parameters: &[&str]) -> Vec<Unusual> {
        let own = table_of(self);
        let mut draft = own.clone();
        for (table, kept) in TABLES {
            let stays = |key: &str| kept.contains(&key) || parameters.contains(&format!("{table}.{key}").as_str());
            if let Some(table) = draft.get_mut(table).and_then(Value::as_object_mut) {
                table.retain(|key, _| stays(key));
            }
        }
        let usual = Draft::of(&draft, schema()).and_then(resolve).map_or(Value::Null, |scene| table_of(&scene));
        let of_tables = TABLES.iter().flat_map(|(table, _)| differences(table, &own, &usual)).filter(Unusual::matters);
        self.unmeasured_solver()
            .filter(|solver| !parameters.contains(&solver.key.as_str()))
            .into_iter()
            .chain(of_tables)
            .collect()
    }
}

impl Unusual {
    /// In words, as `fluid.walls = "dynamic" (usually "extrapolated")`.
    pub fn words(&self) -> String {
        match &self.usual {
            Value::Null => format!("{} = {} (usually absent)", self.key, self.value),
            usual => format!("{} = {} (usually {usual})", self.key, self.value),
        }
    }

    /// False for what changes no quantity by more than a share of its band: finer steps, tolerances and fine zones, and what changed the force
    /// and the largest pressure of wedges at constant speed by less than 0.3 and 1.3 %.
    fn matters(&self) -> bool {
        let [value, usual] = [&self.value, &self.usual].map(|value| value.as_f64().unwrap_or(f64::NAN));
        match self.key.as_str() {
            "fluid.cfl" | "fluid.acoustic_steps" | "resolution.growth" | "projection.tolerance" => value > usual,
            "resolution.fine_zone" => {
                let side = |of: &Value, k: usize| of.get(k).and_then(Value::as_f64).unwrap_or(f64::INFINITY);
                (0..2).any(|k| side(&self.value, k) < side(&self.usual, k))
            }
            "fluid.kinematic_viscosity" => value > OF_WATER,
            "coupling.tolerance" | "coupling.max_iterations" | "projection.most_iterations" => false,
            "fluid.eos_exponent" | "fluid.ventilation" => false,
            _ => true,
        }
    }
}

fn table_of(scene: &Scene) -> Value {
    // by TOML, which has no null
    let table = toml::Value::try_from(scene).ok().and_then(|table| serde_json::to_value(table).ok());
    table.unwrap_or_default()
}

fn differences(table: &str, own: &Value, usual: &Value) -> Vec<Unusual> {
    let empty = Map::new();
    let [own, usual] = [own, usual].map(|scene| scene.get(table).and_then(Value::as_object).unwrap_or(&empty));
    let keys = own.keys().chain(usual.keys().filter(|key| !own.contains_key(*key)));
    let both = keys.map(|key| {
        let [value, usual] = [own, usual].map(|table| table.get(key).cloned().unwrap_or_default());
        Unusual { key: format!("{table}.{key}"), value, usual }
    });
    both.filter(|unusual| unusual.value != unusual.usual).collect()
}

#[cfg(test)]
mod tests {
    use crate::load;

    fn keys(scene: &str, sets: &[&str], parameters: &[&str]) -> Vec<String> {
        let sets: Vec<String> = sets.iter().map(|set| set.to_string()).collect();
        let scene = load(scene, &sets).expect("a scene").scene;
        scene.unusual_keys(parameters).into_iter().map(|unusual| unusual.words()).collect()
    }

    /// A value that the program chose is found again from the resolved scene.
    #[test]
    fn what_a_scene_leaves_to_the_program_is_usual() {
        for solver in ["weakly_compressible", "incompressible"] {
            assert_eq!(keys("wedge", &[&format!("solver={solver}")], &[]), [""; 0]);
        }
    }

    #[test]
    fn each_key_of_the_method_that_differs_is_named() {
        let set = |set: &str| keys("wedge_constant", &[set], &[]);
        assert_eq!(set("fluid.artificial_viscosity=0.5"), ["fluid.artificial_viscosity = 0.5 (usually 0.02)"]);
        assert_eq!(set("fluid.density_diffusion=0"), ["fluid.density_diffusion = 0.0 (usually 0.3)"]);
        assert_eq!(set("fluid.kinematic_viscosity=0.01").len(), 1);
        assert_eq!(set("fluid.sound_speed=50"), [""; 0], "bands know it by the Mach number");
        assert_eq!(set("fluid.cfl=0.3"), [""; 0], "shorter steps");
        assert!(set("fluid.kernel=gaussian").iter().any(|words| words.contains("fluid.kernel")));
        assert_eq!(keys("wedge_constant", &["fluid.kernel=gaussian"], &["fluid.kernel"]), [""; 0]);
        assert!(set("fluid.walls=dynamic")[0].contains("fluid.walls"));
    }
}
