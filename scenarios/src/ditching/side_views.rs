//! The fuselage on the water at a few moments of a landing.

use report::run_page::quantity::{Unit, digits};
use report::{Block, LandingScales, LandingView, landing_view_svg};
use water_entry::ditching::{Fuselage, LandingState, Swell};

use super::checked::hull;
use super::landed::{Landed, seconds};
use super::model::Scene;

/// Points along the keel.
const POINTS: usize = 120;
/// Points along the water's surface.
const SURFACE_POINTS: usize = 160;
/// Blank round the fuselage, a share of its length [-].
const ROOM: f64 = 0.03;

/// A picture of the first touch, of the largest force, of the largest load of a metre of keel, and of the last touch.
pub(super) fn side_views(scene: &Scene, landed: &Landed) -> Vec<Block> {
    let (Ok(hull), moments, s) = (hull(scene), &landed.run.moments, &landed.summary) else {
        return Vec::new();
    };
    let nearest = |time: f64| {
        let distance = |m: &&LandingState| (m.time - time).abs();
        moments.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))
    };
    let is_loaded = |m: &&LandingState| m.strips.iter().filter(|(strip, _)| strip.entry.is_some()).count() > 1;
    let wanted = [
        ("First touch", 0.0),
        ("Largest force of the water", s.fz_n.time_s),
        ("Largest load of a metre of keel", s.line_load_n_per_m.time_s),
        ("Last touch", moments.iter().rfind(is_loaded).map_or(s.time_end_s, |m| m.time)),
    ];
    let mut chosen: Vec<(&str, &LandingState)> = Vec::new();
    for (name, moment) in wanted.into_iter().filter_map(|(name, time)| Some((name, nearest(time)?))) {
        if !chosen.iter().any(|(_, known)| known.time == moment.time) {
            chosen.push((name, moment));
        }
    }
    let unit = Unit::of("N/m", s.line_load_n_per_m.value);
    let views = chosen.iter().map(|(name, now)| LandingView {
        title: format!("{name}: {}, pitch {}°", seconds(now.time), digits(now.attitude.place[2].to_degrees())),
        ..view(scene, hull.fuselage(), now, &unit)
    });
    let mut views: Vec<LandingView> = views.collect();
    let scales = scales(&views, hull.fuselage().length(), landed.swell.amplitude);
    for (view, (_, now)) in views.iter_mut().zip(&chosen) {
        view.surface = surface(&landed.swell.later(now.time), now.attitude.place[0], scales.ahead);
    }
    let block =
        |view: &LandingView| Block::Drawing { svg: landing_view_svg(view, &scales), caption: view.title.clone() };
    let words = "To scale, the same axes in all pictures. The cross is the centre of mass. Of the fuselage the keel is known; its top is drawn \
                 a breadth above it.";
    std::iter::once(Block::Text(words.into())).chain(views.iter().map(block)).collect()
}

/// The water's surface ahead of a place x [m].
fn surface(swell: &Swell, x: f64, [from, to]: [f64; 2]) -> Vec<[f64; 2]> {
    let ahead = (0..=SURFACE_POINTS).map(|k| from + (to - from) * k as f64 / SURFACE_POINTS as f64);
    ahead.map(|ahead| [ahead, swell.water(x + ahead).elevation]).collect()
}

fn view(scene: &Scene, fuselage: &Fuselage, now: &LandingState, unit: &Unit) -> LandingView {
    let [from, to] = fuselage.ends();
    let places = || (0..=POINTS).map(|k| from + (to - from) * k as f64 / POINTS as f64);
    let ahead = |x: f64, height: f64| {
        let [px, pz] = now.attitude.of_point(scene.aeroplane.center_of_mass, [x, height]);
        [px - now.attitude.place[0], pz]
    };
    let load = now.strips.iter().filter_map(|(strip, force)| {
        let part = strip.entry?;
        Some([part.at.lever_arm[0], unit.scale * force / part.length])
    });
    LandingView {
        title: String::new(),
        keel: places().map(|x| ahead(x, fuselage.keel(x).height)).collect(),
        top: places().map(|x| ahead(x, fuselage.keel(x).height + fuselage.breadth(x))).collect(),
        surface: Vec::new(),
        centre: [0.0, now.attitude.place[1]],
        load: load.collect(),
        unit: unit.name.clone(),
    }
}

/// Axes that hold all views; the water is seen to a tenth of the length below still water, with waves to their troughs.
fn scales(views: &[LandingView], length: f64, amplitude: f64) -> LandingScales {
    let room = ROOM * length;
    let outline = || views.iter().flat_map(|view| view.keel.iter().chain(&view.top));
    let extent = |values: &mut dyn Iterator<Item = f64>, first: [f64; 2]| {
        values.filter(|v| v.is_finite()).fold(first, |[low, high], v| [low.min(v), high.max(v)])
    };
    let [low, high] = extent(&mut outline().map(|p| p[0]), [f64::INFINITY, f64::NEG_INFINITY]);
    let height = extent(&mut outline().map(|p| p[1]), [-0.1 * length - amplitude, 0.1 * length + amplitude]);
    let load = extent(&mut views.iter().flat_map(|view| view.load.iter().map(|p| p[1])), [0.0, 1e-3]);
    let margin = 0.05 * (load[1] - load[0]);
    let under = if load[0] < 0.0 { margin } else { 0.0 };
    LandingScales {
        ahead: [low - room, high + room],
        height: [height[0] - room, height[1] + room],
        load: [load[0] - under, load[1] + margin],
    }
}
