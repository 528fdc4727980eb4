//! Where inputs come from: the built-in scenes, landings, tables and cases.

use std::fs;
use std::path::Path;

use scenarios::ditching;
use settings::Schema;

use crate::mutate::{Random, plausible, text, value};
use crate::targets::{Input, Target};

/// Sweep files with all that they may hold.
const SWEEPS: [&str; 2] = [
    "scene = \"wedge\"\ntabulate = [\"steps\"]\n[set]\nmodel = \"mlm\"\n[grid]\nbody.deadrise_deg = [20, 30]\n\"body.velocity[1]\" = \
     { from = -8, to = -4, step = 2 }\nbody.mass = { from = 100, to = 400, count = 3, scale = \"log\" }\n",
    "ditch = [\"mercure\", \"mercure\"]\n[[zip]]\nlanding.strips = [20, 30]\nwater.suction = { from = 0, to = 1, count = 2 }\n\
     [latin_hypercube]\nsamples = 4\nseed = 2\n[latin_hypercube.keys]\naeroplane.mass = [4e4, 6e4]\nlanding.flight_path_deg = \
     { from = -1, to = -3, scale = \"log\" }\n",
];

/// Texts to change, by target.
pub struct Seeds {
    texts: Vec<(Target, Vec<String>)>,
    names: Vec<&'static str>,
    keys: Vec<(String, String)>,
    landing_keys: Vec<(String, String)>,
}

impl Seeds {
    pub fn read() -> Seeds {
        let scenarios = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios");
        let (cases, reference) = (scenarios.join("cases"), scenarios.join("scene/reference"));
        let of = |texts: &[(&str, &str)]| texts.iter().map(|(_, text)| text.to_string()).collect::<Vec<_>>();
        let mut tables: Vec<String> = Vec::new();
        for folder in ["external", "exact", "wedge_similarity"] {
            tables.extend(files(&reference.join(folder)));
        }
        let keys =
            |schema: &Schema| schema.keywords().iter().map(|key| (key.path.clone(), key.takes.clone())).collect();
        Seeds {
            texts: vec![
                (Target::Scene, of(scene::builtin())),
                (Target::Landing, of(ditching::builtin())),
                (Target::Table, tables.into_iter().filter(|table| table.len() < 20_000).collect()),
                (Target::Map, files(&cases.join("maps"))),
                (Target::Chart, files(&cases.join("charts"))),
                (Target::Bands, files(&cases.join("bands"))),
                (Target::Validation, files(&cases.join("validation"))),
                (Target::Sweep, SWEEPS.map(String::from).to_vec()),
            ],
            names: scene::builtin().iter().map(|(name, _)| *name).collect(),
            keys: keys(scene::schema()),
            landing_keys: keys(ditching::schema()),
        }
    }

    /// An input at random.
    pub fn draw(&self, random: &mut Random, target: Target) -> Input {
        let text = match target {
            Target::Set => self.sets(random, self.names.as_slice(), &self.keys),
            Target::LandingSet => self.sets(random, &["mercure"], &self.landing_keys),
            Target::Study => {
                let list = |random: &mut Random| match random.below(3) {
                    0 => String::new(),
                    _ => format!("{}, {}", value(random), value(random)).replace('\n', ""),
                };
                let (spacings, speeds) = (list(random), list(random));
                format!("{spacings}\n{speeds}\n{}", self.sets(random, self.names.as_slice(), &self.keys))
            }
            _ => self.changed(random, target),
        };
        Input { target, text }
    }

    fn changed(&self, random: &mut Random, target: Target) -> String {
        let (_, texts) = self.texts.iter().find(|(of, _)| *of == target).expect("texts of every target");
        let mut changed = random.pick(texts).clone();
        for _ in 0..=random.below(4) {
            changed = text(random, &changed, texts);
        }
        changed
    }

    /// The name of a scene, and a few arguments.
    fn sets(&self, random: &mut Random, names: &[&str], keys: &[(String, String)]) -> String {
        let mut lines = vec![random.pick(names).to_string()];
        for _ in 0..=random.below(4) {
            let (path, takes) = random.pick(keys);
            let item = *random.pick(&["[0]", "[0]", "[0]", "[1]", "[99]", ".0", ""]);
            let path = path.replace("[]", item);
            let value = if random.one_in(4) { value(random) } else { plausible(random, takes) };
            let line = match random.below(40) {
                0 => path,
                1 => format!("{path}.x={value}"),
                2 => format!("{}={value}", path.to_uppercase()),
                3 => format!("[0]{path}={value}"),
                4 => format!("{}={value}", path.split('.').next().unwrap_or_default()),
                5 => format!("{}{path}={value}", "a.".repeat(*random.pick(&[5, 5_000]))),
                _ => format!("{path}={value}"),
            };
            lines.push(line.replace('\n', " "));
        }
        lines.join("\n")
    }
}

/// The texts of a folder's files.
fn files(folder: &Path) -> Vec<String> {
    let mut paths: Vec<_> =
        fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    paths.iter().filter_map(|path| fs::read_to_string(path).ok()).collect()
}
