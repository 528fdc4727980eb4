//! The text of a scene in which a section enters its plane of water as on a landing (THEORY EN63).

use fsi_coupling::PanelEnd;
use water_entry::ditching::{Form, Hull, PlaneHistory};

use super::model::Scene;
use super::plating_keys::{Bay, PlateMaterial, PlatingKeys};
use super::stations::shape_keys;

/// Width and depth of the tank over the section's breadth [-].
const TANK: [f64; 2] = [8.0, 3.0];

/// A section on its way into its plane of water.
pub(super) struct SectionEntry<'a> {
    /// The landing.
    pub scene: &'a Scene,
    /// The landing's bottom.
    pub hull: &'a Hull,
    /// Its place from the nose [m].
    pub x: f64,
    /// Its way, from the contact on.
    pub history: PlaneHistory,
}

impl SectionEntry<'_> {
    /// Breadth between its edges [m].
    pub fn breadth(&self) -> f64 {
        self.hull.fuselage().breadth(self.x)
    }

    /// Its shape.
    pub fn form(&self) -> Form {
        self.hull.form(self.x)
    }

    /// When its keel meets the water, from the landing's first touch on [s].
    pub fn contact(&self) -> f64 {
        self.history.rows[0].time
    }

    /// The scene: `head` is comment lines and keys of the top, `end` [s] and `sample_every` [s] those of its time, `tail` follows the body.
    pub fn text(&self, head: &str, [end, sample_every]: [f64; 2], spacing: f64, tail: &str) -> String {
        let Scene { water, .. } = self.scene;
        let breadth = self.breadth();
        let rows = &self.history.rows;
        let deepest = rows.iter().map(|row| row.draught).fold(0.0, f64::max);
        let list = |of: &dyn Fn(usize) -> String| (0..rows.len()).map(of).collect::<Vec<_>>().join(",\n    ");
        let places = list(&|k| format!("[{:?}, 0.0, {:?}, 0.0]", rows[k].time - rows[0].time, -rows[k].draught));
        let rates = list(&|k| format!("[0.0, {:?}, 0.0]", -rows[k].speed));
        format!(
            "{head}symmetry = \"x\"\ngravity = [0.0, {:?}]\n\n\
             [time]\nend = {end:?}\nsample_every = {sample_every:?}\n\n[resolution]\nspacing = {spacing:?}\n\n\
             [fluid]\ndensity = {:?}\n\n[tank]\nwidth = {:?}\ndepth = {:?}\n\n\
             [body]\nname = \"section\"\n{}\nmotion = \"tabulated\"\n\
             # time, way [s, m, m, deg], and its rate\n\
             displacements = [\n    {places},\n]\n\
             displacement_rates = [\n    {rates},\n]\n{tail}",
            -water.gravity,
            water.density,
            TANK[0] * breadth,
            TANK[1] * breadth + deepest,
            shape_keys(&self.form(), breadth),
        )
    }

    /// Length of a bay along the girth [m].
    pub fn bay_length(&self, bay: &Bay) -> f64 {
        (bay.girth[1] - bay.girth[0]) * self.hull.girth(self.x)
    }

    /// The panels of a plating on it: of all its bays, or of one, of which number and elements are given.
    pub fn panels(&self, keys: &PlatingKeys, plate: &PlateMaterial, only: Option<(usize, usize)>) -> String {
        let (form, breadth) = (self.form(), self.breadth());
        let panel = |(k, bay): (usize, Bay)| {
            let [from, to] = bay.girth.map(|share| form.at_girth(breadth, share));
            let ends = bay.ends.map(|end| match end {
                PanelEnd::Mirror => "mirror",
                PanelEnd::Pinned => "pinned",
                _ => "clamped",
            });
            let elements = only.map_or(String::new(), |(_, count)| format!("elements = {count}\n"));
            let allowable =
                plate.allowable.map_or(String::new(), |allowable| format!("allowable_stress = {allowable:?}\n"));
            format!(
                "\n[[body.panels]]\nname = \"{}\"\nfrom = {from:?}\nto = {to:?}\nends = {ends:?}\n{elements}thickness = {:?}\n\
                 youngs_modulus = {:?}\npoissons_ratio = {:?}\ndensity = {:?}\n{allowable}",
                bay_name(&keys.name, k),
                keys.thickness,
                plate.youngs_modulus,
                plate.poissons_ratio,
                plate.density
            )
        };
        let bays = keys.bays().into_iter().enumerate();
        bays.filter(|(k, _)| only.is_none_or(|(bay, _)| bay == *k)).map(panel).collect()
    }
}

/// Name of a bay's panel.
pub(super) fn bay_name(plating: &str, bay: usize) -> String {
    format!("{plating}_{}", bay + 1)
}
