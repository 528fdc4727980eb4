//! A section of a landing's plating by boundary elements with the bay that bends (THEORY EN63).

use run::{Outcome, RunError, RunOptions, load_text};
use water_entry::ditching::Hull;

use super::model::Scene;
use super::plating_choice::{Chosen, Place};
use super::section_text::{SectionEntry, bay_name};

/// Folder of the sections' scenes.
pub(super) const FOLDER: &str = "sections";
/// Elements of a bay: the most with which its shortest waves do not make the load chatter. Six give the stress of twelve within 1.5 %.
const ELEMENTS: [usize; 3] = [16, 10, 6];
/// Rows of the series of a section.
const ROWS: f64 = 800.0;
/// Shares of a section's time that are tried with the fewest elements, where boundary elements do not follow all of it [-].
const SHARES: [f64; 6] = [0.8, 0.6, 0.4, 0.25, 0.15, 0.08];
/// A stress that is largest within this last share of the time may go on growing [-].
const LAST: f64 = 0.02;

/// What a section gives.
#[derive(Clone, Default)]
pub(super) struct Followed {
    /// Largest stress of the strip that is in the plane, on the plating, at each row of its series.
    pub places: Vec<Place>,
    /// Its file in the landing's folder, and its text.
    pub scene: Option<(String, String)>,
    /// Why there are no stresses.
    pub refused: Option<String>,
    /// Why they are doubtful.
    pub doubt: Option<String>,
}

/// Follow a section, or as much of it as boundary elements can.
pub(super) fn follow(scene: &Scene, hull: &Hull, chosen: &Chosen<'_>) -> Followed {
    let history = match &chosen.history {
        Ok(history) => history.clone(),
        Err(why) => return Followed { refused: Some(why.clone()), ..Followed::default() },
    };
    let entry = SectionEntry { scene, hull, x: chosen.load.x, history };
    let rows = &entry.history.rows;
    let whole = rows[rows.len() - 1].time - rows[0].time;
    let tries = ELEMENTS.map(|elements| (elements, 1.0)).into_iter().chain(SHARES.map(|share| (ELEMENTS[2], share)));
    let (mut scene, mut refused) = (None, None);
    for (elements, share) in tries {
        let (name, text) = scene_of(&entry, chosen, elements, share * whole);
        let outcome = by_boundary_elements(&name, &text);
        scene = Some((format!("{FOLDER}/{name}.toml"), text));
        match outcome {
            Ok(outcome) => return of_outcome(&entry, chosen, (&outcome, scene, refused.filter(|_| share < 1.0))),
            Err(why) => refused = Some(why),
        }
    }
    Followed { scene, refused, ..Followed::default() }
}

/// What a run gives; `short` is why it is not that of the whole time.
fn of_outcome(
    entry: &SectionEntry<'_>,
    chosen: &Chosen<'_>,
    (outcome, scene, short): (&Outcome, Option<(String, String)>, Option<String>),
) -> Followed {
    let keys = chosen.keys;
    let panel = bay_name(&keys.name, chosen.bay);
    let stress = outcome.series.column(&format!("{panel}.stress_Pa")).unwrap_or_default();
    let places = outcome.series.times().into_iter().zip(stress).map(|(time, stress)| {
        let time = time + entry.contact();
        Place { value: stress.abs(), time, x: entry.history.place(time), doubtful: false }
    });
    let mut places: Vec<Place> = places.filter(|p| (keys.from..=keys.to).contains(&p.x)).collect();
    let of_suction = outcome.summary.doubts.iter().filter(|doubt| {
        !doubt.why.beyond_limit && doubt.about.contains(&panel) && !doubt.why.text.contains("time.end")
    });
    let mut reasons: Vec<String> = of_suction.map(|doubt| doubt.why.text.clone()).collect();
    let (largest, last) = places
        .iter()
        .fold((Place::default(), 0.0), |(most, _), p| (if p.value > most.value { *p } else { most }, p.time));
    if let Some(why) = short {
        reasons.push(format!("followed to {last:.4} s only: {why}"));
    } else if last - largest.time < LAST * (last - entry.contact()) {
        reasons.push(format!(
            "the stress still grows at {last:.4} s, when the section leaves the plating or the water pulls at it"
        ));
    }
    let doubt = (!reasons.is_empty()).then(|| reasons.join("; "));
    places.iter_mut().for_each(|place| place.doubtful = doubt.is_some());
    Followed { places, scene, refused: None, doubt }
}

/// Name and text of the scene of a section whose bay bends, in this number of elements, by boundary elements, up to an `end` after the contact [s].
fn scene_of(entry: &SectionEntry<'_>, chosen: &Chosen<'_>, elements: usize, end: f64) -> (String, String) {
    let Chosen { keys, plate, bay, load, .. } = chosen;
    let panel = bay_name(&keys.name, *bay);
    let name = format!("{panel}_{:.2}m_{:.3}s", entry.x, load.time).replace('.', "p");
    let head = format!(
        "# Bay {} of plating {} at {:.2} m from the nose on the way that its plane of water sees, from the contact at {:.4} s of the\n\
         # landing {} on.\nname = \"{name}\"\nmodel = \"boundary_element\"\n",
        bay + 1,
        keys.name,
        entry.x,
        entry.contact(),
        entry.scene.name,
    );
    let panels = entry.panels(keys, plate, Some((*bay, elements)));
    let spacing = entry.bay_length(&keys.bays()[*bay]) / (2.0 * elements as f64);
    (name, entry.text(&head, [end, end / ROWS], spacing, &panels))
}

/// A scene's run; or why there is none.
fn by_boundary_elements(name: &str, text: &str) -> Result<Outcome, String> {
    let loaded = load_text(&format!("{name}.toml"), text, &[]).map_err(|error| error.to_string())?;
    run::run(&loaded.scene, &RunOptions::default()).map_err(|error| match error {
        RunError::Theory(_, out_of_range) => format!("boundary elements do not follow {}", out_of_range.what),
        error => error.to_string(),
    })
}
