//! `report.html` of a landing: numbers, curves, the fuselage on the water at a few moments.

use fsi_coupling::entry_theory::ditching::{Fuselage, LandingState};

use super::landed::Landed;
use super::model::{Scene, hull};
use crate::report::run_page::page_status;
use crate::report::{Block, Chart, Curve, Mark, Report, Table, render};

/// Side views, as shares of the time to the end.
const VIEWS: [f64; 4] = [0.0, 0.1, 0.25, 0.6];
/// Points along the keel of a side view.
const POINTS: usize = 120;

/// The page of a landing.
pub(super) fn page(scene: &Scene, landed: &Landed) -> String {
    let s = &landed.summary;
    let words = Block::Text(format!(
        "{}\n\nSections by the model {} in planes of water across the way of flight (THEORY EN14–EN19). Suction where the keel \
         curves up and away acts by the share {} of what the theory gives; it has no limit by cavitation or by air that comes in. \
         Wing, engines and tail that touch the water bear nothing.",
        s.to_text(),
        s.model,
        scene.water.suction
    ));
    let numbers = Table {
        title: "Extremes".into(),
        head: ["", "value", "time [s]"].map(String::from).to_vec(),
        rows: [
            ("upward acceleration [g]", s.az_g),
            ("load factor [-]", s.load_factor),
            ("deceleration [g]", s.deceleration_g),
            ("force of the water upwards [N]", s.fz_n),
            ("moment of the water, nose up [N m]", s.moment_nm),
            ("load of a metre of keel [N/m]", s.line_load_n_per_m),
        ]
        .map(|(name, peak)| vec![name.into(), format!("{:.4}", peak.value), format!("{:.3}", peak.time_s)])
        .to_vec(),
    };
    let curve = |title: &str, y_label: &str, columns: &[&str]| Block::Chart(chart(landed, title, y_label, columns));
    let curves = vec![
        curve("Load factor", "load factor [-]", &["load_factor"]),
        curve("Accelerations of the centre of mass", "acceleration [m/s²]", &["az_m_per_s2", "ax_m_per_s2"]),
        curve("Forces of the water, and lift", "force [N]", &["fz_N", "fx_N", "lift_N"]),
        curve("Moment of the water about the centre of mass", "moment, nose up [N m]", &["moment_Nm"]),
        curve("Pitch", "pitch [deg]", &["pitch_deg"]),
        curve("Speeds", "speed [m/s]", &["u_m_per_s", "w_m_per_s"]),
        curve("Wetted part of the keel", "from the nose [m]", &["wetted_from_m", "wetted_to_m"]),
        curve("Largest load of a metre of keel", "load [N/m]", &["line_load_N_per_m"]),
    ];
    render(&Report {
        title: format!("splashdown ditch: {}", scene.name),
        subtitle: scene.description.clone(),
        status: page_status(s.status, s.message.as_deref(), s.message.as_slice()),
        sections: vec![
            ("Landing".into(), vec![words, Block::Table(numbers)]),
            ("Curves".into(), curves),
            ("Side views".into(), side_views(scene, landed)),
            ("Landing as run".into(), vec![Block::Code { title: "scene.resolved.toml".into(), text: scene.to_toml() }]),
        ],
    })
}

fn chart(landed: &Landed, title: &str, y_label: &str, columns: &[&str]) -> Chart {
    let time = landed.column("time_s").unwrap_or_default();
    let curve = |name: &&str| Curve {
        label: name.to_string(),
        mark: Mark::Line,
        x: time.clone(),
        y: landed.column(name).unwrap_or_default(),
        ..Curve::default()
    };
    Chart {
        title: title.into(),
        x_label: "time [s]".into(),
        y_label: y_label.into(),
        curves: columns.iter().map(curve).collect(),
        ..Chart::default()
    }
}

fn side_views(scene: &Scene, landed: &Landed) -> Vec<Block> {
    let (Ok(hull), moments) = (hull(scene), &landed.run.moments) else {
        return Vec::new();
    };
    let view = |share: f64| &moments[(share * (moments.len() - 1) as f64) as usize];
    let views = VIEWS.map(|share| Block::Chart(side_view(scene, hull.fuselage(), view(share))));
    views.into_iter().collect()
}

/// The keel, and what a metre of it bears, from the centre of mass.
fn side_view(scene: &Scene, fuselage: &Fuselage, now: &LandingState) -> Chart {
    let [from, to] = fuselage.ends();
    let places = (0..=POINTS).map(|k| from + (to - from) * k as f64 / POINTS as f64);
    let keel = places.map(|x| now.attitude.of_point(scene.aeroplane.center_of_mass, [x, fuselage.keel(x).height]));
    let ahead = |[x, z]: [f64; 2]| (x - now.attitude.place[0], z);
    let (x, y): (Vec<f64>, Vec<f64>) = keel.map(ahead).unzip();
    let ends = vec![x[x.len() - 1], x[0]];
    let mut curves = vec![
        Curve::new("keel", Mark::Line, x.into_iter().zip(y).map(|(x, y)| [x, y])),
        Curve::new("still water", Mark::Dashed, ends.into_iter().map(|x| [x, 0.0])),
    ];
    let loaded = now.strips.iter().filter_map(|(s, f)| Some((s.entry?.at.lever_arm[0], 1e-5 * f / s.entry?.length)));
    let (x, y): (Vec<f64>, Vec<f64>) = loaded.unzip();
    curves.push(Curve::new("load of the keel [100 kN/m]", Mark::Line, x.into_iter().zip(y).map(|(x, y)| [x, y])));
    Chart {
        title: format!("t = {:.3} s, pitch {:.1} degrees", now.time, now.attitude.place[2].to_degrees()),
        x_label: "ahead of the centre of mass [m]".into(),
        y_label: "height [m]".into(),
        curves,
        ..Chart::default()
    }
}
