//! `splashdown check`: cost and validity of a run, before it is run.
//!
//! # Example
//! ```
//! use scenarios::preflight::preflight;
//!
//! let loaded = run::load("wedge", &[])?;
//! let estimate = preflight(&loaded.scene, &loaded.warnings);
//! assert!(estimate.fluid_particles > 1000 && estimate.steps > 100);
//! # Ok::<(), scene::SceneError>(())
//! ```

use fsi_coupling::geometry::layout::tile;
use fsi_coupling::natural_frequencies;
use run::model_hierarchy::{Assessment, assess};
use run::observers::{WaveTheory, wave_theory};
use scene::{
    Body, CouplingScheme, Entry, ExchangeRatio, Modes, OutlineReport, Panel, Scene, Symmetry, cost_of_step,
    estimated_steps, known_compressibility_error, layout, line, memory_estimate, panel_exchanges, panel_length,
    particle_estimate, step_at_start,
};
use serde::Serialize;
use settings::significant;
use water_entry::EntryModel;

/// Cost and validity of a run, estimated.
#[derive(Clone, Debug, Serialize)]
pub struct Preflight {
    /// Name of the scene.
    pub scene: String,
    /// Fluid particles at the start, counted.
    pub fluid_particles: usize,
    /// Fluid particles at the end, estimated, where the fine zone grows; absent where they stay as many.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fluid_particles_at_end: Option<u64>,
    /// Wall particles, estimated.
    pub wall_particles: u64,
    /// Memory, estimated [MiB].
    pub memory_mib: f64,
    /// Step at the start [s].
    pub step_s: f64,
    /// Steps, estimated.
    pub steps: u64,
    /// Core-seconds, estimated.
    pub core_seconds: f64,
    /// Sound speed [m/s]; absent where water is incompressible.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sound_speed_m_per_s: Option<f64>,
    /// Fastest speed known beforehand over the sound speed [-]; absent where water is incompressible.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mach: Option<f64>,
    /// Estimated share of the force lost to compressibility [-].
    pub compressibility_error: Option<f64>,
    /// Spacings across the wetted width at the end [-].
    pub spacings_across_wetted_width: Option<f64>,
    /// Spacings across the length with 90 % of the peak pressure at the end [-].
    pub spacings_across_pressure_peak: Option<f64>,
    /// The scheme of the coupling.
    pub coupling_scheme: CouplingScheme,
    /// Added mass of half a row of water over the body's own, along x, y and about its centre of mass (THEORY CO10) [-]. The
    /// largest is the spectral radius of the weak exchange: stable below 1. Absent where water is incompressible.
    pub added_mass_ratios: Option<[f64; 3]>,
    /// Stability of an explicit coupling with each panel (THEORY CO12).
    pub panels: Vec<PanelExchange>,
    /// A structure by its modes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub modes: Option<ModesBrief>,
    /// What the errors of theories are of.
    #[serde(skip)]
    pub want: &'static str,
    /// The model that runs the scene.
    pub model: &'static str,
    /// The reason, where the model was chosen automatically.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub choice: Option<String>,
    /// The theories: range of validity, cost, and error of the largest force.
    #[serde(rename = "ladder")]
    pub theories: Vec<Assessment>,
    /// Amplitudes of loads or motions in the waves asked for, by linear potential theory in place of the run (THEORY WA17).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub in_waves: Option<WaveTheory>,
    /// What was understood of the file of `body.outline`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub outline: Option<OutlineReport>,
    /// Warnings.
    pub warnings: Vec<String>,
}

/// Stability of an explicit coupling of a panel with the water beside it (THEORY CO12).
#[derive(Clone, Debug, Serialize)]
pub struct PanelExchange {
    /// Its name.
    pub name: String,
    /// Its length along the body's line [m].
    pub length_m: f64,
    /// Its elements.
    pub elements: usize,
    /// Particle spacings in an element [-].
    pub element_spacings: f64,
    /// Its estimate; absent where water is incompressible.
    #[serde(flatten)]
    pub exchange: Option<fsi_coupling::PanelExchange>,
    /// Its lowest natural frequencies in air, its ends held at rest [Hz]; empty for a mesh too large to find them quickly.
    pub natural_frequencies_hz: Vec<f64>,
}

/// Cost of a run at half the spacing over its own: four times the particles, twice the steps.
const HALF_THE_SPACING: f64 = 8.0;

/// Particles of the block of water in the air, counted.
fn particles_of_block(scene: &Scene) -> usize {
    let mut count = 0;
    if let Some(block) = scene.tank.block() {
        tile(block.from, block.to, scene.resolution.spacing, |_| count += 1);
    }
    count
}

/// Estimate cost and validity of a run, without running it.
pub fn preflight(scene: &Scene, warnings: &[String]) -> Preflight {
    let fluid_particles = layout(scene).count() + particles_of_block(scene);
    let (last, wall_particles) = particle_estimate(scene);
    let fluid_particles_at_end = scene.resolution.follow.then_some(last);
    // an area grows with the square of the draught: a third of what is added is there in the mean
    let added = fluid_particles_at_end.map_or(0.0, |last| (last as f64 - fluid_particles as f64).max(0.0) / 3.0);
    let fastest = scene.fastest_speed();
    let sound = (!scene.solver.is_incompressible()).then_some(scene.sound_speed());
    let (step, cost) = (step_at_start(scene), cost_of_step(scene));
    let steps = estimated_steps(scene);
    let entries = scene.entries();
    let least = |of: &dyn Fn(&Entry) -> f64| entries.iter().map(|(_, entry)| of(entry)).reduce(f64::min);
    let root = entries.iter().map(|(_, entry)| entry.root_speed()).reduce(f64::max);
    let sides = if scene.symmetry == Symmetry::X { 1.0 } else { 2.0 };
    let length = |panel: &Panel| scene.body.as_ref().map_or(0.0, |body| panel_length(body, panel));
    let wetted = least(&|e| sides * e.bottom.wetted_half_width(e.attached_draught()));
    Preflight {
        scene: scene.name.clone(),
        fluid_particles,
        fluid_particles_at_end,
        wall_particles,
        memory_mib: memory_estimate(scene) as f64 / f64::from(1 << 20),
        step_s: step,
        steps: steps as u64,
        core_seconds: cost * (fluid_particles as f64 + added) * steps,
        sound_speed_m_per_s: sound,
        mach: sound.map(|sound| fastest / sound),
        compressibility_error: root.zip(sound).and_then(|(root, sound)| known_compressibility_error(root, sound)),
        spacings_across_wetted_width: wetted.map(|w| w / scene.resolution.spacing),
        spacings_across_pressure_peak: least(&Entry::peak_length).map(|length| length / scene.resolution.spacing),
        coupling_scheme: scene.coupling.scheme,
        added_mass_ratios: sound.and_then(|_| ExchangeRatio::of(scene)).map(|exchange| exchange.ratios),
        panels: panel_exchanges(scene)
            .into_iter()
            .map(|(panel, exchange)| PanelExchange {
                name: panel.name.clone(),
                length_m: length(panel),
                elements: panel.elements,
                element_spacings: length(panel) / panel.elements as f64 / scene.resolution.spacing,
                exchange: sound.map(|_| exchange),
                natural_frequencies_hz: dry_frequencies(scene, panel),
            })
            .collect(),
        modes: scene.body.as_ref().and_then(|body| body.modal.as_ref()).map(ModesBrief::of),
        model: scene.model.name(),
        want: scene.want.words(),
        choice: scene.choice.clone(),
        theories: scene.entry().filter(|_| scene.bodies.is_empty()).map_or(Vec::new(), |_| assess(scene, scene.want)),
        in_waves: wave_theory(scene),
        outline: None,
        warnings: warnings.to_vec(),
    }
}

/// A structure by its modes, before the run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ModesBrief {
    /// Nodes.
    pub nodes: usize,
    /// Natural frequencies in air [Hz].
    pub natural_frequencies_hz: Vec<f64>,
    /// Mass of its nodes [kg/m].
    pub mass_kg_per_m: f64,
}

impl ModesBrief {
    fn of(modal: &Modes) -> ModesBrief {
        ModesBrief {
            nodes: modal.nodes.len(),
            natural_frequencies_hz: modal.modes.iter().map(|mode| mode.frequency).collect(),
            mass_kg_per_m: modal.masses.iter().sum(),
        }
    }

    fn to_text(&self) -> String {
        let all: Vec<String> = self.natural_frequencies_hz.iter().map(|f| significant(*f)).collect();
        let (nodes, mass) = (self.nodes, significant(self.mass_kg_per_m));
        format!("modes        {} Hz in air, at {nodes} nodes with {mass} kg/m", all.join(", "))
    }
}

/// Frequencies of a panel that are listed.
const FREQUENCIES: usize = 3;
/// Elements up to which they are found: the time grows with the cube.
const MOST_ELEMENTS: usize = 200;

/// The lowest natural frequencies of a panel in air [Hz].
fn dry_frequencies(scene: &Scene, panel: &Panel) -> Vec<f64> {
    let body = scene.body.as_ref().filter(|_| panel.elements <= MOST_ELEMENTS);
    // a panel without modes cannot be built, which the build reports
    let of = |body: &Body| natural_frequencies(&line(&body.shape), &panel.spec(), FREQUENCIES).ok();
    body.and_then(of).unwrap_or_default()
}

/// A theory in a line.
fn theory_line(a: &Assessment, want: &str) -> String {
    let name = format!("  {:<17}", a.model.name());
    match (&a.obstacle, a.core_seconds, &a.measured) {
        (Some(obstacle), ..) => format!("{name}{obstacle}"),
        (None, Some(cost), Some(m)) => {
            format!("{name}{:.1} ms, {want} {:.2} % off in {}", 1e3 * cost, 100.0 * m.error, m.case)
        }
        (None, cost, _) => format!("{name}{:.1} ms, measured nowhere near this scene", 1e3 * cost.unwrap_or(0.0)),
    }
}

impl Preflight {
    /// As lines of text.
    pub fn to_text(&self) -> String {
        let growing = self.fluid_particles_at_end.map_or(String::new(), |last| format!(" growing to about {last}"));
        let mut lines = vec![format!("scene        {}", self.scene), format!("model        {}", self.model)];
        lines.extend(self.outline.iter().map(OutlineReport::to_text));
        lines.extend(self.choice.iter().map(|why| format!("             chosen: {why}")));
        lines.extend(self.theories.iter().map(|theory| theory_line(theory, self.want)));
        lines.extend(self.in_waves.iter().map(|theory| format!("linear waves {}", theory.to_text())));
        if !self.theories.is_empty() {
            lines.push(format!("  {:<17}about {:.0} core-seconds", "particles", self.core_seconds));
        }
        let warnings = self.warnings.iter().map(|w| format!("warning      {w}"));
        if EntryModel::ALL.iter().any(|model| model.is_theory() && model.name() == self.model) {
            return lines.into_iter().chain(warnings).collect::<Vec<_>>().join("\n");
        }
        lines.extend([
            format!("particles    {} fluid{growing}, about {} wall", self.fluid_particles, self.wall_particles),
            format!("memory       about {:.0} MiB", self.memory_mib),
            format!("step         {:.3e} s at the start, about {} steps", self.step_s, self.steps),
            format!(
                "cost         about {:.0} core-seconds; half the error, at half the spacing: about {:.0}",
                self.core_seconds,
                HALF_THE_SPACING * self.core_seconds
            ),
        ]);
        if let Some((sound, mach)) = self.sound_speed_m_per_s.zip(self.mach) {
            lines.push(format!("sound speed  {sound:.1} m/s, Mach {mach:.3} at the fastest known speed"));
        }
        if let Some(e) = self.compressibility_error {
            lines.push(format!("compressible share of the force about {:.2} %", 100.0 * e));
        }
        if let Some(n) = self.spacings_across_wetted_width {
            lines.push(format!("resolution   {n:.0} spacings across the simulated wetted width at the end"));
        }
        if let Some(n) = self.spacings_across_pressure_peak {
            lines.push(format!("             {n:.1} across the pressure peak"));
        }
        lines.extend(self.exchange());
        lines.extend(self.panels.iter().map(|panel| self.exchange_with(panel)));
        lines.extend(self.modes.iter().map(ModesBrief::to_text));
        lines.extend(warnings);
        lines.join("\n")
    }

    /// Stability of the scene's coupling scheme; `radius` is the spectral radius of the explicit one.
    fn verdict(&self, radius: f64) -> String {
        match self.coupling_scheme {
            CouplingScheme::Weak if radius < 1.0 => format!("exchange contracts to {radius:.3} a step"),
            CouplingScheme::Weak => format!("exchange grows {radius:.2}-fold a step: take added_mass"),
            CouplingScheme::AddedMass => "solved in one exchange whatever the ratio".into(),
            CouplingScheme::IqnIls => "iterated until it agrees".into(),
        }
    }

    fn exchange_with(&self, panel: &PanelExchange) -> String {
        let PanelExchange { name, exchange, length_m, elements, element_spacings, natural_frequencies_hz } = panel;
        let mut size = format!("{name:<12} {length_m:.4} m, {elements} elements of {element_spacings:.2} spacings");
        if !natural_frequencies_hz.is_empty() {
            let all: Vec<String> = natural_frequencies_hz.iter().map(|f| significant(*f).to_string()).collect();
            size += &format!("\n{:<12} natural frequencies in air {} Hz", "", all.join(", "));
        }
        let Some(fsi_coupling::PanelExchange { added_mass, acoustic, spectral_radius }) = *exchange else {
            return size;
        };
        format!(
            "{size}\n{:<12} {}: added mass of its rows over its own {added_mass:.3}, sound {acoustic:.3}; one exchange would \
             multiply an error by {spectral_radius:.2}; {}",
            "",
            self.coupling_scheme.name(),
            self.verdict(spectral_radius)
        )
    }

    /// The coupling's stability in a line.
    fn exchange(&self) -> Option<String> {
        let ratios = self.added_mass_ratios?;
        let radius = ratios.into_iter().fold(0.0, f64::max);
        let [x, y, turn] = ratios;
        let verdict = self.verdict(radius);
        Some(format!(
            "coupling     {}: added mass of half a row over the body's {x:.3} (x), {y:.3} (y), {turn:.3} (angle); {verdict}",
            self.coupling_scheme.name()
        ))
    }
}

#[cfg(test)]
mod tests {
    use run::load;

    use super::*;

    /// 0.2 by 0.3 m at 0.02 m are 150 particles, 1.2 by 0.4 m are 1200.
    #[test]
    fn the_block_of_water_is_counted() {
        let loaded = load("falling_jet", &[]).expect("a built-in scene");
        assert_eq!(preflight(&loaded.scene, &loaded.warnings).fluid_particles, 1350);
    }

    /// Warnings stand in the text whatever the model.
    #[test]
    fn theories_have_warnings_too() {
        for model in ["model=wagner", "model=wcsph"] {
            let loaded = load("wedge", &[model.into(), "body.mass=1e9".into()]).expect("a scene");
            let text = preflight(&loaded.scene, &loaded.warnings).to_text();
            assert!(text.contains("warning      the mean density"), "{text}");
        }
    }
}
