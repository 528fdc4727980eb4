//! `report.html` of a landing: its largest loads, what they leave out, curves, side views.

use report::run_page::folded;
use report::run_page::quantity::{Unit, digits, with_unit};
use report::{
    Block, Card, Chart, Curve, Lead, Mark, Table, Tone, escape, hint_html, lead_html, page as html_page, row,
};
use run::summary::Peak;
use scene::vocabulary::Status;

use super::afloat_page as afloat;
use super::landed::{Landed, Structure, seconds};
use super::loads::StationLoad;
use super::model::Scene;
use super::plating_page;
use super::side_views::side_views;

/// What stands beside accelerations.
const MEASURED: &str = "model tests: see what the loads leave out";
const NO_BAND: &str = "no band known";

/// The page of a landing.
pub(super) fn page(scene: &Scene, landed: &Landed) -> String {
    let failed = landed.summary.status == Status::Failed;
    let loads = if failed { "Largest values before the failure" } else { "Largest loads" };
    let assumed = (!scene.assumptions.is_empty()).then(|| {
        ("What the file assumes", vec![Block::Html(list(scene.assumptions.iter().map(|assumed| escape(assumed))))])
    });
    let first = (
        loads,
        [
            vec![Block::Table(loads_table(scene, landed))],
            structure_tables(&landed.summary.structure),
            plating_page::blocks(&landed.summary.structure.plating),
            afloat::blocks(landed),
        ]
        .concat(),
    );
    let others = [
        ("What the loads leave out", vec![Block::Html(limits(scene, &landed.summary.warnings))]),
        ("Curves", [vec![Block::Html(hint_html())], curves(scene, landed)].concat()),
        ("Side views", side_views(scene, landed)),
        ("Landing as run", vec![Block::Html(folded("scene.resolved.toml", &scene.to_toml()))]),
    ];
    let sections = std::iter::once(first).chain(assumed).chain(others);
    let sections: Vec<_> = sections.map(|(heading, blocks)| (heading.to_string(), blocks)).collect();
    html_page(&format!("splashdown ditch: {}", scene.name), &lead_html(&lead(scene, landed)), &sections)
}

fn lead(scene: &Scene, landed: &Landed) -> Lead {
    let s = &landed.summary;
    let title = if scene.description.is_empty() { &scene.name } else { &scene.description };
    let message = || s.message.clone().unwrap_or_default();
    let (tone, heading, reasons) = match s.status {
        Status::Completed => {
            (Tone::Doubtful, "Completed. No load has a known band: compare variants by them.".into(), vec![])
        }
        Status::Failed => (Tone::Failed, format!("Failed: {}", message()), vec![]),
        _ => (
            Tone::Doubtful,
            "Completed with doubts. No load has a known band: compare variants by them.".into(),
            vec![message()],
        ),
    };
    let cards = if s.status == Status::Failed { Vec::new() } else { cards(landed) };
    let eyebrow = format!("{} · ditching by 2D+t, sections by {} · splashdown {}", s.scene, s.model, VERSION);
    Lead { eyebrow, title: title.clone(), tone, heading, reasons, cards }
}

const VERSION: &str = env!("CARGO_PKG_VERSION");

/// A largest value: what it is, the peak, its SI unit, where.
struct Largest<'a> {
    title: &'static str,
    peak: &'a Peak,
    si: &'static str,
    place: String,
}

fn largest(landed: &Landed) -> Vec<Largest<'_>> {
    let s = &landed.summary;
    let new = |title, peak, si, place: &str| Largest { title, peak, si, place: place.into() };
    let moment = if s.moment_nm.value < 0.0 { "nose down" } else { "nose up" };
    let line = format!("{} from the nose", with_unit(s.line_load_at_m, "m"));
    vec![
        new("Upward acceleration", &s.az_g, "g", "centre of mass"),
        new("Load factor", &s.load_factor, "-", "centre of mass"),
        new("Deceleration", &s.deceleration_g, "g", "centre of mass"),
        new("Force of the water, upwards", &s.fz_n, "N", "whole aeroplane"),
        new("Moment of the water", &s.moment_nm, "N m", moment),
        new(
            "Load of a metre of keel",
            &s.line_load_n_per_m,
            "N/m",
            if s.line_load_at_m.is_finite() { &line } else { "–" },
        ),
    ]
}

fn cards(landed: &Landed) -> Vec<Card> {
    let s = &landed.summary;
    let of_largest = |l: Largest<'_>| {
        let unit = Unit::of(l.si, l.peak.value);
        let compared = (l.si == "g").then(|| (MEASURED.to_string(), None));
        let place = if l.place.contains("nose") { format!(", {}", l.place) } else { String::new() };
        let lines = std::iter::once((format!("at {}{place}", seconds(l.peak.time_s)), None)).chain(compared);
        Card {
            title: l.title.into(),
            value: digits(unit.scale * l.peak.value),
            unit: if unit.name == "-" { String::new() } else { unit.name },
            lines: lines.collect(),
            chip: Some((Tone::Doubtful, NO_BAND.into())),
        }
    };
    let [first, last] = s.speed_m_per_s.map(digits);
    let [touch, least, most] = s.pitch_deg.map(digits);
    let plain = |title: &str, value: String, unit: &str, line: String| Card {
        title: title.into(),
        value,
        unit: unit.into(),
        lines: vec![(line, None)],
        chip: None,
    };
    let way = Unit::of("m", s.run_length_m);
    let others = [
        plain(
            "Way on the water",
            digits(way.scale * s.run_length_m),
            &way.name,
            format!(
                "in {}; from {first} to {last} m/s{}",
                seconds(s.time_end_s),
                if s.ended_at_m_per_s.is_some() { ", ended at landing.least_speed" } else { "" }
            ),
        ),
        plain("Largest pitch", most, "°", format!("{touch}° at the first touch, least {least}°")),
    ];
    let of_sea = s.sea.as_ref().map(|sea| {
        let place = format!(
            "{} from the nose, elevation {}",
            with_unit(sea.touchdown_at_m, "m"),
            with_unit(sea.elevation_m, "m")
        );
        match sea.touchdown_phase_deg {
            Some(phase) => plain("Phase of the waves at the first contact", digits(phase), "°", place),
            None => plain("Steepness of the sea", digits(sea.steepness), "", format!("first contact {place}")),
        }
    });
    largest(landed).into_iter().map(of_largest).chain(others).chain(of_sea).collect()
}

fn loads_table(scene: &Scene, landed: &Landed) -> Table {
    let line = |l: Largest<'_>| {
        let value = with_unit(l.peak.value, l.si);
        let of_weight = (l.si == "N").then(|| l.peak.value / (scene.aeroplane.mass * scene.water.gravity));
        let value = of_weight.map_or(value.clone(), |share| format!("{value}, {} times the weight", digits(share)));
        row(&[l.title, &value, &digits(l.peak.time_s), &l.place])
    };
    let head = ["largest", "value", "time [s]", "where"];
    Table::new(
        "Largest loads of the landing; none has a known band",
        &head,
        largest(landed).into_iter().map(line).collect(),
    )
}

/// Tables of accelerometers, parts and stations; those that a landing has.
fn structure_tables(s: &Structure) -> Vec<Block> {
    let accelerometers = s.accelerometers.iter().map(|a| {
        let at = format!("{} from the nose", with_unit(a.at_m[0], "m"));
        let numbers =
            [a.bandwidth_hz, a.normal_g.value, a.normal_g.time_s, a.longitudinal_g.value, a.longitudinal_g.time_s];
        [vec![a.name.clone(), at], numbers.map(digits).to_vec()].concat()
    });
    let accelerometers = Table::new(
        "Accelerometers: largest acceleration upwards from the body axis, 1 g at rest, and largest deceleration along it",
        &["name", "place", "follows up to [Hz]", "upwards [g]", "time [s]", "deceleration [g]", "time [s]"],
        accelerometers.collect(),
    );
    let parts = s.parts.iter().map(|p| {
        let lost = p.lost_at_s.map_or("no".into(), |t| format!("at {}", seconds(t)));
        row(&[&p.name, &with_unit(p.force_n.value, "N"), &digits(p.force_n.time_s), &lost])
    });
    let parts = Table::new(
        "Parts that may meet the water",
        &["part", "largest force of the water", "time [s]", "lost"],
        parts.collect(),
    );
    let tables =
        [(parts, s.parts.is_empty()), (accelerometers, s.accelerometers.is_empty()), (stations_table(s), false)];
    tables.into_iter().filter(|(_, empty)| !empty).map(|(table, _)| Block::Table(table)).collect()
}

fn stations_table(s: &Structure) -> Table {
    let largest =
        |of: fn(&StationLoad) -> &Peak| s.stations.iter().fold(0.0, |most: f64, l| most.max(of(l).value.abs()));
    let line = Unit::of("N/m", largest(|l| &l.line_load_n_per_m));
    let pressure = Unit::of("Pa", largest(|l| &l.pressure_pa));
    let (shear, bending) = (Unit::of("N", largest(|l| &l.shear_n)), Unit::of("N m", largest(|l| &l.bending_nm)));
    let of_station = |l: &StationLoad| {
        let cells = [
            l.x_m,
            line.scale * l.line_load_n_per_m.value,
            pressure.scale * l.pressure_pa.value,
            shear.scale * l.shear_n.value,
            bending.scale * l.bending_nm.value,
            l.bending_nm.time_s,
        ];
        cells.map(digits).to_vec()
    };
    let head = [
        "station, from the nose [m]".into(),
        format!("load of a metre of keel [{}]", line.name),
        format!("pressure on the breadth [{}]", pressure.name),
        format!("shear, aft part lifts the part ahead [{}]", shear.name),
        format!("bending, ends upwards [{}]", bending.name),
        "time of bending [s]".into(),
    ];
    Table::new(
        "Stations: largest load and mean pressure near each; shear and bending of largest size in its cut",
        &head.each_ref().map(String::as_str),
        s.stations.iter().map(of_station).collect(),
    )
}

/// What the method does not have, as a list.
fn limits(scene: &Scene, warnings: &[String]) -> String {
    let suction = format!(
        "Suction where the keel curves up acts by the share {} of what the theory gives (water.suction). Ventilation limits \
         real suction; the result depends on it strongly: compute 0 and 1. It is at most {} kPa (water.largest_suction).",
        digits(scene.water.suction),
        digits(1e-3 * scene.water.largest_suction)
    );
    let bare = "Only the fuselage touches the water: the file has no surfaces and no nacelles.";
    let panels = "A panel of the bottom gives way at one load of its strip; the frame behind it has the drag of a plate, the water inside has no weight.";
    let parts = "Wing, flaps, tailplane and engines are plates and bodies in a steady stream: no slam of a flat wing, no spray, no wake of the \
                 fuselage.";
    let items = [
        "Built-in mercure beside model tests: the deceleration is within a factor of 1.5 in 10 of 14 cases, the upward acceleration of the \
         worst accelerometer in 7; it is low by up to 2.8 at small angles of attack. Built-in xp2v, b36 and constellation: decelerations of the \
         centre of mass are within a factor of 1.5, on the low side. Do not take them for loads to design by.",
        &suction,
        match scene.sea {
            None => {
                "The sections are planes of calm water that the fuselage passes through (2D+t, THEORY EN14–EN19): no waves, no wind, no flow \
                 along the fuselage."
            }
            Some(sea) if sea.spectrum.is_some() => {
                "The sections are planes of water that move with 40 long-crested waves of linear theory whose sum has the spectrum (2D+t, THEORY EN59): \
                 the aeroplane does not change the waves; no wind, no slope of the water across the flight, no roll."
            }
            Some(_) => {
                "The sections are planes of water that move with regular waves of linear theory (2D+t, THEORY EN36–EN38): the aeroplane does \
                 not change the waves; no wind, no flow along the fuselage, no slope of the water across it, no roll."
            }
        },
        if scene.surfaces.is_empty() && scene.nacelles.is_empty() { bare } else { parts },
    ];
    let struts = (!scene.struts.is_empty()).then_some(
        "Struts: drag of the immersed part of wheels and leg in a steady stream, the buoyancy of floats, spring and damper along the normal of the body \
         axis. No skipping of tyres, no spray, no cavity that one wheel leaves to another, no side loads.",
    );
    let of_plating = (!scene.plating.is_empty()).then_some(
        "Plating: one bay bends at a time, elastic, in a section that keeps its shape; no change along the fuselage, no stress where the water \
         pulls, none of stiffeners.",
    );
    let of_panels = (!scene.panels.is_empty()).then_some(panels);
    let items = items
        .into_iter()
        .chain(of_panels)
        .chain(struts)
        .chain(of_plating)
        .map(str::to_string)
        .chain(warnings.iter().map(|w| escape(w)));
    list(items)
}

/// Items of HTML as a list.
fn list(items: impl Iterator<Item = String>) -> String {
    let items: String = items.map(|item| format!("<li>{item}</li>\n")).collect();
    format!("<ul class=\"reasons\">\n{items}</ul>\n")
}

/// A chart: title, SI unit, factor to it, columns with their names.
type Of<'a> = (&'a str, &'a str, f64, &'a [(&'a str, &'a str)]);

fn curves(scene: &Scene, landed: &Landed) -> Vec<Block> {
    let g = 1.0 / scene.water.gravity;
    let s = &landed.summary;
    let charts: [(Of<'_>, Option<&Peak>); 8] = [
        (("Load factor", "-", 1.0, &[("load_factor", "")]), Some(&s.load_factor)),
        (
            ("Acceleration of the centre of mass", "g", g, &[("az_m_per_s2", "upwards"), ("ax_m_per_s2", "forwards")]),
            None,
        ),
        (
            (
                "Forces",
                "N",
                1.0,
                &[("fz_N", "water, upwards"), ("fx_N", "water, forwards"), ("lift_N", "lift of the wing")],
            ),
            None,
        ),
        (
            ("Moment of the water about the centre of mass, nose up", "N m", 1.0, &[("moment_Nm", "")]),
            Some(&s.moment_nm),
        ),
        (("Pitch", "°", 1.0, &[("pitch_deg", "")]), None),
        (("Speed of the centre of mass", "m/s", 1.0, &[("u_m_per_s", "forwards"), ("w_m_per_s", "upwards")]), None),
        (
            (
                "Wetted part of the keel, from the nose",
                "m",
                1.0,
                &[("wetted_from_m", "front end"), ("wetted_to_m", "rear end")],
            ),
            None,
        ),
        (("Largest load of a metre of keel", "N/m", 1.0, &[("line_load_N_per_m", "")]), Some(&s.line_load_n_per_m)),
    ];
    let heights = [("z_m", "centre of mass"), ("elevation_m", "water below it")];
    let sea = scene.sea.map(|_| (("Heights over still water", "m", 1.0, &heights[..]), None));
    let usual = charts.into_iter().chain(sea).map(|(of, peak)| Block::Chart(chart(landed, of, peak)));
    usual.chain(named_charts(landed).into_iter().map(Block::Chart)).collect()
}

/// Charts of accelerometers and of parts, a curve for each.
fn named_charts(landed: &Landed) -> Vec<Chart> {
    let s = &landed.summary.structure;
    let accelerometers: Vec<&str> = s.accelerometers.iter().map(|a| a.name.as_str()).collect();
    let parts: Vec<&str> = s.parts.iter().map(|p| p.name.as_str()).collect();
    let charts = [
        ("Accelerometers, upwards from the body axis", "g", "normal_g", &accelerometers),
        ("Accelerometers, deceleration along the body axis", "g", "longitudinal_g", &accelerometers),
        ("Force of the water on parts, upwards", "N", "fz_N", &parts),
        ("Force of the water on parts, forwards", "N", "fx_N", &parts),
    ];
    let drawn = charts.into_iter().filter(|(.., names)| !names.is_empty());
    drawn
        .map(|(title, si, column, names)| {
            let columns: Vec<(String, &str)> = names.iter().map(|name| (format!("{name}.{column}"), *name)).collect();
            let columns: Vec<(&str, &str)> = columns.iter().map(|(column, name)| (column.as_str(), *name)).collect();
            chart(landed, (title, si, 1.0, &columns), None)
        })
        .collect()
}

fn chart(landed: &Landed, (title, si, factor, columns): Of<'_>, peak: Option<&Peak>) -> Chart {
    let times = landed.series.column("time_s").unwrap_or_default();
    let values = |name: &str| landed.series.column(name).unwrap_or_default();
    let finite = columns.iter().flat_map(|(name, _)| values(name)).filter(|v| v.is_finite());
    let unit = Unit::of(si, finite.fold(0.0, |most: f64, v| most.max((factor * v).abs())));
    let scale = factor * unit.scale;
    let curve = |(name, label): &(&str, &str)| {
        let points = times.iter().zip(values(name)).map(|(t, v)| [*t, scale * v]);
        Curve::new(*label, Mark::Line, points.collect::<Vec<_>>())
    };
    let mut curves: Vec<Curve> = columns.iter().map(curve).collect();
    let shown = landed.summary.status.is_completed();
    curves.extend(peak.filter(|peak| shown && peak.value != 0.0).map(|peak| {
        let label = format!("largest: {} at {}", with_unit(peak.value, si), seconds(peak.time_s));
        Curve::new(label, Mark::Hollow, [[peak.time_s, scale * peak.value]])
    }));
    let y_label = if unit.name == "-" { String::new() } else { format!("[{}]", unit.name) };
    Chart { x_range: Some([0.0, landed.summary.time_end_s]), ..Chart::new(title, "time [s]", y_label, curves) }
}
