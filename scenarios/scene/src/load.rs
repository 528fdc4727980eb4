//! From a name or a path to a scene, and from `model = "auto"` to the model that runs it.

use std::sync::LazyLock;

use include_dir::{Dir, include_dir};
use serde_json::Value;
use settings::{Problem, require, significant};
use sph_core::FluidSettings;
use water_entry::{EntryModel, OutOfRange};

use super::as_written::as_written;
use super::check::{check, check_step};
use super::draft::Draft;
use super::embedded::texts;
use super::error::SceneError;
use super::estimate::{BYTES_PER_PARTICLE, memory_estimate, particle_estimate};
use super::ignored::ignored;
use super::impact::Entry;
use super::keys::{Body, GRAVITY, QuantityOfInterest, Scene, Symmetry, schema};
use super::mistaken_file::Expected;
use super::models::{Choice, Models};
use super::outline::OutlineReport;
use super::prepare::{Prepared, prepare};
use super::references::{drop_references, sets_of_the_flow};
use super::resolve::resolve;
use super::resolve_body::resolve_body;
use super::source::{Source, refuse_absurd_numbers};
use super::validity::gaps::gap_warnings;
use super::validity::gauges::gauge_warnings;
use super::validity::keel::keel_warnings;
use super::validity::plausible::implausible;
use super::validity::springs::check_spring_step;
use super::validity::warnings;

/// Largest error that `auto` may have had, where the scene does not say [-].
const USUAL_TOLERANCE: f64 = 0.05;
/// Left to the program, the end of an entry is when a body that kept its speed would be this many times as deep as when its
/// spray root is at the chines: past the largest force.
const PAST_CHINES: f64 = 2.0;
/// Spacings in the draught from which a spacing is looked for.
const PROVISIONAL: f64 = 32.0;
const SPACING: &str = "/resolution/spacing";

/// Whether steps at which the scheme is known to break down are refused (THEORY WC16).
#[derive(Clone, Copy, PartialEq, Eq)]
enum Limits {
    Kept,
    Ignored,
}

/// A scene that can be run, and what is doubtful about it.
#[derive(Debug, Clone, PartialEq)]
pub struct Loaded {
    /// The resolved scene.
    pub scene: Scene,
    /// Warnings, in plain words.
    pub warnings: Vec<String>,
    /// What was understood of the file of `body.outline`.
    pub outline: Option<OutlineReport>,
    source: Source,
}

impl Loaded {
    /// True where the scene's file or an override names a key of the top level.
    pub fn names(&self, key: &str) -> bool {
        let in_file = self.source.table().is_ok_and(|table| table.contains_key(key));
        in_file || self.source.sets.iter().any(|set| set.split('=').next().is_some_and(|name| name.trim() == key))
    }
}

static FILES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/scenes");

/// Name and text of each built-in scene, by name.
pub fn builtin() -> &'static [(&'static str, &'static str)] {
    static SCENES: LazyLock<Vec<(&str, &str)>> = LazyLock::new(|| texts(&FILES));
    &SCENES
}

/// Reads scenes for a set of models.
#[derive(Clone, Copy)]
pub struct Loader<'a> {
    models: &'a dyn Models,
    limits: Limits,
}

impl<'a> Loader<'a> {
    /// For these models.
    pub fn new(models: &'a dyn Models) -> Loader<'a> {
        Loader { models, limits: Limits::Kept }
    }

    /// Steps at which the scheme is known to break down are let through (THEORY WC16): for maps of where that is.
    pub fn beyond_limits(self) -> Loader<'a> {
        Loader { limits: Limits::Ignored, ..self }
    }

    /// A built-in scene by its name, or a scene file by its path, with `--set` arguments applied in their order.
    ///
    /// # Errors
    /// A scene that cannot be read, or that has no sense.
    pub fn load(self, name_or_path: &str, sets: &[String]) -> Result<Loaded, SceneError> {
        loaded(Source::find(Expected::Scene, builtin(), name_or_path, sets, schema())?, self)
    }

    /// A scene from its text; `name` stands for the file in messages.
    ///
    /// # Errors
    /// As [`Loader::load`].
    pub fn load_text(self, name: &str, text: &str, sets: &[String]) -> Result<Loaded, SceneError> {
        let source = Source { name: name.to_string(), text: text.to_string(), sets: sets.to_vec(), schema: schema() };
        loaded(source, self)
    }
}

fn loaded(source: Source, loader: Loader<'_>) -> Result<Loaded, SceneError> {
    let mut given = source.read()?;
    let written = given.clone();
    let Prepared { outline, notes } = prepare(&mut given, &source.name).map_err(|problem| {
        // a misspelt key may be why another is missing
        let misspelt = schema().check(&written).err().filter(|first| first.sentence.starts_with("unknown key"));
        source.error(misspelt.unwrap_or(problem))
    })?;
    let in_its_words = |problem| source.error(as_written(problem, &written, outline.as_ref()));
    let mut scene = checked(given.clone(), loader).map_err(in_its_words)?;
    // what the program chose must be read again from the resolved scene
    let resolved = toml::Value::try_from(&scene).unwrap_or(toml::Value::Boolean(false));
    refuse_absurd_numbers("", &resolved).map_err(|problem| source.error(problem))?;
    let dropped =
        before(&source, &scene, loader).and_then(|(before, key)| drop_references(&mut scene, before.as_ref(), &key));
    let warnings = dropped
        .into_iter()
        .chain(notes)
        .chain(ignored(&given, &scene))
        .chain(warnings_about(&scene, outline.as_ref()))
        .collect();
    Ok(Loaded { warnings, scene, outline, source })
}

/// Warnings about a resolved scene: what is doubtful in it, in plain words.
pub fn all_warnings(scene: &Scene) -> Vec<String> {
    warnings_about(scene, None)
}

fn warnings_about(scene: &Scene, outline: Option<&OutlineReport>) -> Vec<String> {
    let of_gaps = if scene.model.is_theory() { Vec::new() } else { gap_warnings(scene) };
    [implausible(scene, outline), warnings(scene), keel_warnings(scene), gauge_warnings(scene), of_gaps].concat()
}

/// The scene without the `--set` keys that say what flows, where it can be read, and the first of these keys; `None` without any.
fn before(source: &Source, scene: &Scene, loader: Loader<'_>) -> Option<(Option<Scene>, String)> {
    let (sets, changed) = sets_of_the_flow(&source.sets).filter(|_| !scene.compare.is_empty())?;
    let before = Source { sets, ..source.clone() }.read().ok().and_then(|mut given| {
        prepare(&mut given, &source.name).ok()?;
        checked(given, loader.beyond_limits()).ok()
    });
    Some((before, changed))
}

impl Loaded {
    /// The file the scene was read from, or the name of a built-in scene's.
    pub fn source_name(&self) -> &str {
        &self.source.name
    }

    /// An error where the particles would need more than `limit` [bytes].
    pub fn fits_in_memory(&self, limit: u64) -> Result<(), SceneError> {
        let bytes = memory_estimate(&self.scene);
        if bytes <= limit || self.scene.model.is_theory() {
            return Ok(());
        }
        let (fluid, wall) = particle_estimate(&self.scene);
        let gib = |bytes: u64| significant(bytes as f64 / f64::from(1 << 30));
        let expected = format!(
            "a spacing that fits in {} GiB of memory: this one makes {fluid} fluid and {wall} wall particles of \
             {BYTES_PER_PARTICLE} bytes, {} GiB",
            gib(limit),
            gib(bytes)
        );
        let spacing = self.scene.resolution.spacing;
        Err(self.source.error(Problem::new("resolution.spacing", spacing, expected)))
    }
}

fn checked(mut given: Value, loader: Loader<'_>) -> Result<Scene, Problem> {
    refuse_dropped(&mut given)?;
    settle_solver(&mut given)?;
    fill_in_spacing_of_theory(&mut given)?;
    let draft = draft_of(&given)?;
    if given.get("model").and_then(Value::as_str) == Some("auto") {
        let want: QuantityOfInterest = draft.get("want").unwrap_or_default();
        let bends = draft.count("body.panels") > 0 || draft.is_given("body.modal");
        let expected = "something else without body.panels: nothing bends";
        require(want != QuantityOfInterest::Strain || bends, "want", "\"strain\"", expected)?;
        return Auto { want, within: draft.get("within").unwrap_or(USUAL_TOLERANCE), loader }.settle(given);
    }
    let scene = sensible(draft, loader)?;
    if scene.model.is_theory() {
        let name = scene.model.name();
        loader.models.holds(&scene, scene.model).map_err(|e| {
            let e = OutOfRange { next: next_that_holds(&scene, e.next, loader.models), ..e };
            Problem::new("model", format!("\"{name}\""), format!("a scene it holds for: {e}"))
        })?;
    }
    Ok(scene)
}

/// A model that is valid for the scene: the one `named`, a more detailed theory, or particles.
fn next_that_holds(scene: &Scene, named: EntryModel, models: &dyn Models) -> EntryModel {
    let holds = |model: &EntryModel| models.holds(scene, *model).is_ok();
    let more_detailed = EntryModel::ALL.into_iter().filter(|model| *model > scene.model);
    std::iter::once(named)
        .chain(more_detailed)
        .filter(|model| model.is_theory() && *model != scene.model)
        .find(holds)
        .unwrap_or(EntryModel::Wcsph)
}

fn draft_of(given: &Value) -> Result<Draft, Problem> {
    let mut draft = Draft::of(given, schema())?;
    draft.fill("solver", "weakly_compressible".to_string());
    Ok(draft)
}

/// The scene of a draft, if it makes sense as a whole.
fn sensible(draft: Draft, loader: Loader<'_>) -> Result<Scene, Problem> {
    let scene = resolve(draft)?;
    if loader.limits == Limits::Kept {
        check_step(&scene)?;
    }
    check_spring_step(&scene)?;
    check(&scene, &loader.models.columns(&scene))?;
    Ok(scene)
}

/// Writes the solver of a scene whose model names one, and refuses that of another model.
fn settle_solver(given: &mut Value) -> Result<(), Problem> {
    let word = |key: &str| given.get(key).and_then(Value::as_str).map(String::from);
    let (model, solver) = (word("model"), word("solver"));
    let Some(model) = model.and_then(|model| EntryModel::ALL.into_iter().find(|known| known.name() == model)) else {
        return Ok(());
    };
    let wanted = model == EntryModel::Incompressible;
    if let Some(solver) = solver {
        let expected = format_args!("no solver, or that of model = \"{}\"", model.name());
        let is = solver != "weakly_compressible";
        return require(wanted == is, "solver", format_args!("{solver:?}"), expected);
    }
    if wanted {
        given["solver"] = "incompressible".into();
    }
    Ok(())
}

/// What a scene asks of `model = "auto"`.
#[derive(Clone, Copy)]
struct Auto<'a> {
    want: QuantityOfInterest,
    within: f64,
    loader: Loader<'a>,
}

impl Auto<'_> {
    /// The scene by the model that [`Models::choose`] takes: symmetry, end, spacing and solver are left to the program where the scene does
    /// not give them.
    fn settle(self, mut given: Value) -> Result<Scene, Problem> {
        for key in ["model", "want", "within"] {
            given.as_object_mut().map(|table| table.remove(key));
        }
        fill_in_end(&mut given)?;
        let solvers = match given.get("solver").and_then(Value::as_str) {
            Some(solver) => vec![solver],
            None => vec!["weakly_compressible", "incompressible"],
        };
        let mut of_particles = Vec::new();
        for solver in solvers {
            match self.fine_enough(with(&given, "solver", solver)) {
                Ok(scene) => of_particles.push(scene),
                Err(problem) if of_particles.is_empty() => return Err(problem),
                Err(_) => {} // the other solver can
            }
        }
        let Choice { model, scene, spacing, why } = self.loader.models.choose(&of_particles, self.want, self.within);
        if !model.is_theory() && given.pointer(SPACING).is_none() && !spacing {
            let such_as = significant(of_particles[scene].resolution.spacing);
            let why = format!(
                "the finest spacing [m], such as {such_as}: no chart is near this scene that would tell it; {why}"
            );
            return Err(Problem::missing("resolution.spacing", why));
        }
        let mut scene = of_particles.swap_remove(scene);
        (scene.model, scene.choice, scene.want) = (model, Some(why), self.want);
        Ok(scene)
    }

    /// A sensible scene of a table: half of a symmetric one is as good.
    fn resolved(self, given: &Value) -> Result<Scene, Problem> {
        let resolved = |given: &Value| sensible(draft_of(given)?, self.loader);
        match given.get("symmetry") {
            Some(_) => resolved(given),
            None => resolved(&with(given, "symmetry", "x")).or_else(|_| resolved(given)),
        }
    }

    /// A scene at the spacing that it gives, or else at the one that charts say is fine enough.
    fn fine_enough(self, mut given: Value) -> Result<Scene, Problem> {
        if given.pointer(SPACING).is_some() {
            return self.resolved(&given);
        }
        given["resolution"]["spacing"] = provisional_spacing(&given)?.into();
        let scene = self.resolved(&given)?;
        let fine = self.loader.models.spacing_within(&scene, self.want, self.within);
        fine.map_or(Ok(scene), |spacing| {
            given["resolution"]["spacing"] = spacing.into();
            self.resolved(&given)
        })
    }
}

/// A spacing to begin with [m].
fn provisional_spacing(given: &Value) -> Result<f64, Problem> {
    let entry = entry_of(draft_of(given)?)?;
    let draught = entry.map(|(_, entry)| entry.attached_draught().max(entry.bottom.draught_at(entry.half_breadth)));
    let why = "the finest spacing [m]: nothing enters the water";
    Ok(draught.ok_or_else(|| Problem::missing("resolution.spacing", why))? / PROVISIONAL)
}

/// A theory has no particles: its scene needs no spacing.
fn fill_in_spacing_of_theory(given: &mut Value) -> Result<(), Problem> {
    let model = given.get("model").and_then(Value::as_str).map(String::from);
    let by_theory = EntryModel::ALL.iter().any(|known| known.is_theory() && Some(known.name()) == model.as_deref());
    if by_theory && given.pointer(SPACING).is_none() {
        given["resolution"]["spacing"] = provisional_spacing(given)?.into();
    }
    Ok(())
}

/// The table with another value at a key.
fn with(given: &Value, key: &str, value: &str) -> Value {
    let mut given = given.clone();
    given[key] = value.into();
    given
}

/// The entry of a draft's body, were there no end.
fn entry_of(mut draft: Draft) -> Result<Option<(Body, Entry)>, Problem> {
    let symmetry = draft.get("symmetry").unwrap_or(Symmetry::None);
    let alone = draft.count("bodies") == 0 && draft.count("joints") == 0;
    let Some(body) = resolve_body(&mut draft, symmetry)?.filter(|_| alone) else { return Ok(None) };
    let gravity = draft.get("gravity").unwrap_or_else(GRAVITY);
    let density = draft.get("fluid.density").unwrap_or(FluidSettings::default().density);
    let spacing = draft.get("resolution.spacing").unwrap_or(f64::INFINITY);
    let entry = Entry::of(&body, gravity, density, draft.get("time.end").unwrap_or(0.0), spacing);
    Ok(entry.map(|entry| (body, entry)))
}

/// An entry without an end: the end from how long it takes.
fn fill_in_end(given: &mut Value) -> Result<(), Problem> {
    let draft = draft_of(given)?;
    if let (false, Some((body, entry))) = (draft.is_given("time.end"), entry_of(draft)?) {
        let gap = (-body.draught()).max(0.0);
        let fall = 2.0 * gap / (entry.speed - body.velocity[1]); // at the mean of first and last speed
        let end = fall + PAST_CHINES * entry.bottom.draught_at(entry.half_breadth) / entry.speed;
        given["time"]["end"] = end.into();
    }
    Ok(())
}

/// Refuses a setting of earlier versions that is in use, and removes one that is off.
fn refuse_dropped(given: &mut Value) -> Result<(), Problem> {
    if given.pointer("/coupling/scheme").and_then(Value::as_str) == Some("aitken") {
        let expected = "another scheme: aitken was dropped: \"iqn_ils\" needs no more iterations";
        return Err(Problem::new("coupling.scheme", "\"aitken\"", expected));
    }
    let Some(fluid) = given.get_mut("fluid").and_then(Value::as_object_mut) else { return Ok(()) };
    match fluid.remove("volume_correction") {
        None | Some(Value::Bool(false)) => Ok(()),
        Some(value) => {
            let expected = "false, or no such key: the correction was dropped, fluid.shifting keeps volumes as well";
            Err(Problem::new("fluid.volume_correction", value, expected))
        }
    }
}
