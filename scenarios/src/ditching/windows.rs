//! Windows of a landing: parts of the bottom whose mean pressure is wanted, and the map of the largest pressures (THEORY EN55).

use run::summary::Peak;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use settings::{Problem, require};
use water_entry::EntryModel;
use water_entry::ditching::{Fuselage, GirthRange, Hull, Landing, LandingState, PressureMap, Window};

/// Cells of the map along the fuselage, and along half a girth.
const CELLS: [usize; 2] = [40, 8];

/// An item of `[[windows]]`: a part of the bottom, the same on both sides, whose largest mean pressure is wanted.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WindowKeys {
    /// A word that names it.
    pub name: String,
    /// Front end, from the nose [m].
    pub from: f64,
    /// Rear end, from the nose [m].
    pub to: f64,
    /// Lower and upper border as shares of the girth from the keel, 0, to the edge of the bottom, 1 [-], shape (2).
    #[schemars(extend("x-default" = "[0, 1] without height"))]
    pub girth: Option<[f64; 2]>,
    /// Lower and upper border as heights over the body axis; what lies above the edge of the bottom does not count [m], shape (2).
    #[schemars(extend("x-default" = "none"))]
    pub height: Option<[f64; 2]>,
}

/// Load of a window.
#[derive(Clone, Debug, Serialize)]
pub struct WindowLoad {
    /// Its name.
    pub name: String,
    /// Front and rear end, from the nose [m], shape (2).
    pub ends_m: [f64; 2],
    /// Its area on one side [m²].
    pub area_m2: f64,
    /// Largest mean pressure over it [Pa].
    pub mean_pressure_pa: Peak,
}

/// The windows of their keys.
pub(super) fn windows(keys: &[WindowKeys], hull: &Hull, model: EntryModel) -> Result<Vec<(Window, f64)>, Problem> {
    let window = |(k, keys): (usize, &WindowKeys)| {
        let key = |name: &str| format!("windows[{k}].{name}");
        require(
            model != EntryModel::VonKarman,
            "model",
            model.name(),
            "wagner or mlm beside windows: von_karman has no pressures",
        )?;
        let [first, last] = hull.fuselage().ends();
        require(
            (first..last).contains(&keys.from),
            &key("from"),
            keys.from,
            format_args!("a place from {first} to {last} m"),
        )?;
        let expected = format_args!("more than {}, {} m, and up to {last} m", key("from"), keys.from);
        require(keys.to > keys.from && keys.to <= last, &key("to"), keys.to, expected)?;
        let girth = match (keys.girth, keys.height) {
            (Some(given), Some(_)) => {
                return Err(Problem::new(&key("girth"), format!("{given:?}"), "a girth or a height, not both"));
            }
            (None, Some(height)) => GirthRange::Height(height),
            (given, None) => GirthRange::Share(given.unwrap_or([0.0, 1.0])),
        };
        let (name, [low, high]) = match girth {
            GirthRange::Height(height) => ("height", height),
            GirthRange::Share(shares) => ("girth", shares),
        };
        let inside = name == "height" || low >= 0.0 && high <= 1.0;
        let expected = "a lower border and a higher one; shares from 0 to 1";
        require(low < high && inside, &key(name), format!("[{low}, {high}]"), expected)?;
        let window = Window { name: keys.name.clone(), ends: [keys.from, keys.to], girth };
        let area = window.area(hull);
        require(
            area > 0.0,
            &key(name),
            format!("[{low}, {high}]"),
            "heights on the bottom, between its keel and its edge",
        )?;
        Ok((window, area))
    };
    keys.iter().enumerate().map(window).collect()
}

/// Largest mean pressure of each window, and the map of all of the bottom; none by a theory without pressures.
pub(super) fn pressures(
    landing: &Landing<'_>,
    windows: &[(Window, f64)],
    moments: &[LandingState],
) -> (Vec<WindowLoad>, Option<PressureMap>) {
    let of_window = |(window, area): &(Window, f64)| {
        let mut peak = Peak::default();
        for now in moments {
            let value = window.mean_pressure(landing, now, *area);
            if value > peak.value {
                peak = Peak { value, time_s: now.time, verdict: None };
            }
        }
        WindowLoad { name: window.name.clone(), ends_m: window.ends, area_m2: *area, mean_pressure_pa: peak }
    };
    let loads = windows.iter().map(of_window).collect();
    if landing.hull.model() == EntryModel::VonKarman {
        return (loads, None);
    }
    let mut map = PressureMap::new(landing.hull.fuselage(), CELLS[0], CELLS[1]);
    moments.iter().for_each(|now| map.add(landing, now));
    (loads, Some(map))
}

/// The file of a map: a row for each cell.
pub(super) fn csv(map: Option<&PressureMap>, fuselage: &Fuselage) -> String {
    let head = "x_from_m,x_to_m,breadth_m,girth_from,girth_to,mean_pressure_Pa,time_s\n";
    let rows = map.into_iter().flat_map(|map| {
        (0..map.mean.len()).flat_map(move |cell| {
            (0..map.shares).map(move |k| {
                let [mean, time] = map.mean[cell][k];
                let (from, to) = (map.places[cell], map.places[cell + 1]);
                let [low, high] = [k, k + 1].map(|k| k as f64 / map.shares as f64);
                let breadth = fuselage.breadth(0.5 * (from + to));
                format!("{from:.4},{to:.4},{breadth:.4},{low},{high},{mean:.6e},{time:.6}\n")
            })
        })
    });
    rows.fold(head.to_string(), |text, row| text + &row)
}
