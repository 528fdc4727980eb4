//! Extremes of the panels' loads and stresses: extremes along each panel, and over all.

use super::charts::{Figure, LIMIT, file_name};
use super::folder::RunFolder;
use super::headline::allowable;
use super::quantity::{Unit, digits, with_unit};
use super::record::{Envelope, Extremes, Panel};
use crate::{Block, Chart, Curve, Mark, Paint, Rgb, Table, row};

/// Reserve factors above this are drawn at it: there the panel carries next to nothing.
const LARGEST_RESERVE: f64 = 20.0;

/// Colour of the lower envelope, other than that of limits.
const LOWER: Rgb = [0, 158, 115];

/// Tables of all panels, and ruptures in words.
pub(super) fn tables(run: &RunFolder) -> Vec<Block> {
    let blocks = |(name, panel): (&String, &Panel)| {
        std::iter::once(extremes_table(run, name, panel)).chain(ruptures(name, panel)).collect::<Vec<_>>()
    };
    run.record.panels.iter().flat_map(blocks).collect()
}

/// Envelopes along each panel.
pub(crate) fn figures(run: &RunFolder) -> Vec<Figure> {
    run.record.panels.iter().flat_map(|(name, panel)| envelopes(run, name, &panel.envelope)).collect()
}

fn envelopes(run: &RunFolder, name: &str, envelope: &Envelope) -> Vec<Figure> {
    let stations: Vec<f64> = envelope.station_m.iter().map(|s| s.unwrap_or(f64::NAN)).collect();
    let length = Unit::of("m", stations.last().copied().unwrap_or(0.0));
    let ours = [
        ("Stress of the outer fibres along", &envelope.stress_pa, "Pa"),
        ("Bending moment along", &envelope.moment_n, "N m/m"),
        ("Shear force along", &envelope.shear_n_per_m, "N/m"),
        ("Normal force along", &envelope.normal_n_per_m, "N/m"),
    ];
    let x_label = format!("station from the start [{}]", length.name);
    let figure = |title: String, unit: &str, curves| Figure {
        name: file_name(&title),
        chart: Chart::new(title, x_label.clone(), unit, curves),
    };
    let mut figures = Vec::new();
    for (words, values, si) in ours.into_iter().filter(|(_, values, _)| values.len() == stations.len()) {
        let largest = values.iter().flat_map(|v| [v.least, v.most]).flatten().map(f64::abs).fold(0.0, f64::max);
        if stations.is_empty() || largest == 0.0 {
            continue;
        }
        let unit = Unit::of(si, largest);
        let at = |of: fn(&Extremes) -> Option<f64>| {
            let value = |(s, v): (&f64, &Extremes)| Some([length.scale * s, unit.scale * of(v)?]);
            stations.iter().zip(values).filter_map(value).collect::<Vec<_>>()
        };
        let lower = Paint { colour: Some(LOWER), ..Paint::default() };
        let mut curves = vec![
            Curve::new("largest over the run", Mark::Line, at(|v| v.most)),
            Curve::new("smallest over the run", Mark::Line, at(|v| v.least)).painted(lower),
        ];
        if let Some(allowed) = allowable(run, name).filter(|_| si == "Pa") {
            let ends = [stations[0], stations[stations.len() - 1]].map(|s| length.scale * s);
            for (label, sign) in [("allowable, tension", 1.0), ("allowable, compression", -1.0)] {
                let line = ends.map(|s| [s, sign * unit.scale * allowed]);
                let paint = Paint { colour: Some(LIMIT), ..Paint::default() };
                curves.push(Curve::new(label, Mark::Dashed, line).painted(paint));
            }
        }
        figures.push(figure(format!("{words} {name}"), &format!("[{}]", unit.name), curves));
    }
    let reserve = stations.iter().zip(&envelope.reserve_factor);
    let reserve: Vec<[f64; 2]> =
        reserve.filter_map(|(s, r)| Some([length.scale * s, r.as_ref()?.min(LARGEST_RESERVE)])).collect();
    if let (Some(first), Some(last)) = (reserve.first(), reserve.last()) {
        let one = [[first[0], 1.0], [last[0], 1.0]];
        let curves = vec![Curve::new("reserve factor", Mark::Line, reserve), Curve::new("needed", Mark::Dashed, one)];
        figures.push(figure(format!("Reserve factor along {name}"), "[-]", curves));
    }
    figures
}

fn extremes_table(run: &RunFolder, name: &str, panel: &Panel) -> Block {
    let of = |si: &str, value: Option<f64>| value.map_or("–".into(), |v| with_unit(v, si));
    let mut rows = Vec::new();
    if let Some(factor) = panel.reserve_factor {
        let allowed = allowable(run, name).map_or(String::new(), |v| format!(" ({} allowed)", with_unit(v, "Pa")));
        let allowed = if panel.yielded { " of the strain".into() } else { allowed };
        rows.push(row(&[&format!("Reserve factor{allowed}"), "", "", &digits(factor), ""]));
    }
    let mut extremes = |what: &str, si: &str, e: &Extremes| {
        rows.push(vec![what.to_string(), of(si, e.most), of("s", e.most_at_s), of(si, e.least), of("s", e.least_at_s)]);
    };
    extremes("Stress of the outer fibres", "Pa", &panel.stress_pa);
    extremes("Their strain", "-", &panel.strain);
    extremes("Bending moment", "N m/m", &panel.moment_n);
    extremes("Shear force", "N/m", &panel.shear_n_per_m);
    extremes("Normal force", "N/m", &panel.normal_n_per_m);
    if let Some(left) = panel.plastic_curvature_per_m.filter(|left| *left > 0.0) {
        rows.push(row(&["Plastic curvature left", &format!("{} 1/m", digits(left)), "", "", ""]));
    }
    Block::Table(Table::new(
        format!("{name}: extremes over every step"),
        &["quantity", "largest", "at", "smallest", "at"],
        rows,
    ))
}

/// The ruptures in a sentence.
fn ruptures(name: &str, panel: &Panel) -> Option<Block> {
    let known = |value: Option<f64>, si: &str| value.map_or("–".into(), |v| with_unit(v, si));
    let one = |r: &super::record::Rupture| {
        let (x, y, time, strain) = (known(r.x_m, "m"), known(r.y_m, "m"), known(r.time_s, "s"), known(r.strain, "-"));
        format!("{name} broke off at ({x}, {y}) at {time}, at a strain of {strain}")
    };
    let all: Vec<String> = panel.ruptures.iter().map(one).collect();
    (!all.is_empty()).then(|| Block::Text(format!("{}.", all.join("; "))))
}
