//! The curves of the page: columns of the series by what they are, with references, theories and peaks.

use super::folder::RunFolder;
use super::quantity::{Column, Unit, column};
use super::theories::Theories;
use crate::compare::{self, ReferenceCurve};
use crate::observers::phaseless;
use crate::report::{Chart, Curve, Mark};
use crate::results::PASS_OVER_CLASS;
use crate::scene::Scene;

/// References of more points than this are drawn as lines.
const MANY: usize = 60;
/// A curve that moves by less than this share of its largest value stays where it is.
const STILL: f64 = 1e-9;
/// The frequency at which a pass there and back halves the power, over that of a single pass [-].
const TWICE: f64 = 0.802;
/// The order of the charts, by the beginning of their titles.
const ORDER: [&str; 7] = [
    "Vertical force",
    "Horizontal force",
    "Vertical acceleration",
    "Horizontal acceleration",
    "Pressure",
    "Largest stress",
    "Deflection",
];

/// A chart with its place in files.
pub(crate) struct Figure {
    /// File name without its ending.
    pub name: String,
    /// The chart.
    pub chart: Chart,
}

/// Columns that share a chart.
struct Group {
    title: String,
    columns: Vec<(String, Column)>,
}

/// The charts of a run, in their order.
pub(crate) fn figures(run: &RunFolder) -> Vec<Figure> {
    let theories = Theories::beside(&run.scene);
    let references: Vec<Option<ReferenceCurve>> = run.scene.compare.iter().map(|c| compare::curve(c).ok()).collect();
    let mut figures: Vec<Figure> =
        groups(run).iter().filter_map(|group| figure(run, group, &theories, &references)).collect();
    if let Some(profile) = profile(run, theories.profiles()) {
        figures.insert(figures.len().min(2), profile);
    }
    figures
}

/// The columns that change, by title.
fn groups(run: &RunFolder) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    for name in run.curves.columns.iter().skip(1) {
        let values = run.curves.column(name).unwrap_or_default();
        let finite = values.iter().copied().filter(|v| v.is_finite());
        let [low, high, most] =
            finite.fold([f64::INFINITY, f64::NEG_INFINITY, 1e-9], |[l, h, m], v| [l.min(v), h.max(v), m.max(v.abs())]);
        if high - low <= STILL * most {
            continue;
        }
        let column = column(name);
        match groups.iter_mut().find(|group| group.title == column.title) {
            Some(group) => group.columns.push((name.clone(), column)),
            None => groups.push(Group { title: column.title.clone(), columns: vec![(name.clone(), column)] }),
        }
    }
    groups.sort_by_key(|group| ORDER.iter().position(|start| group.title.starts_with(start)).unwrap_or(ORDER.len()));
    groups
}

/// The unit of the times of a run.
pub(crate) fn time_unit(run: &RunFolder) -> Unit {
    Unit::of("s", run.curves.times().iter().fold(0.0, |most: f64, t| most.max(t.abs())))
}

fn figure(
    run: &RunFolder,
    group: &Group,
    theories: &Theories,
    references: &[Option<ReferenceCurve>],
) -> Option<Figure> {
    let time = time_unit(run);
    let (_, first) = group.columns.first()?;
    let values = |name: &str| run.curves.points(name, [time.scale, first.scale]);
    let largest = |points: &[[f64; 2]]| points.iter().map(|p| p[1].abs()).filter(|v| v.is_finite()).fold(0.0, f64::max);
    let most = group.columns.iter().map(|(name, _)| largest(&values(name))).fold(0.0, f64::max);
    let unit = Unit::of(first.si, most);
    let scaled = |points: Vec<[f64; 2]>| points.into_iter().map(|[t, v]| [t, unit.scale * v]).collect::<Vec<_>>();
    let mut curves = Vec::new();
    for (name, column) in &group.columns {
        let label = if column.part.is_empty() { run.model() } else { &column.part };
        curves.push(Curve::new(label, Mark::Line, scaled(values(name))));
    }
    if first.si == "g"
        && let Some(smooth) = filtered(run, &curves[0], &time)
    {
        curves[0].label = "every sample".into();
        curves.insert(0, smooth);
    }
    for (name, column) in &group.columns {
        for (compare, reference) in run.scene.compare.iter().zip(references) {
            let Some(reference) = reference.as_ref().filter(|_| compare.quantity == *name) else { continue };
            let factor = column.scale * unit.scale / compare.scale;
            let inside = |t: &f64| (compare.window[0]..=compare.window[1]).contains(t);
            let points = reference.t.iter().zip(&reference.y).filter(|(t, _)| inside(t));
            let points: Vec<[f64; 2]> = points.map(|(t, y)| [time.scale * t, factor * y]).collect();
            let mark = if points.len() > MANY { Mark::Dashed } else { Mark::Points };
            curves.push(Curve::new(short(&compare.reference), mark, points));
        }
    }
    if let [(name, column)] = group.columns.as_slice() {
        curves.extend(theories.curves(name, [time.scale, column.scale * unit.scale]));
        curves.extend(peak(run, name, column, [&time, &unit], &curves[0]));
    }
    let [only] = curves.as_slice() else { return Some(drawn(group, &time, &unit, curves)) };
    let alone = Curve { label: String::new(), ..only.clone() };
    Some(drawn(group, &time, &unit, vec![alone]))
}

fn drawn(group: &Group, time: &Unit, unit: &Unit, curves: Vec<Curve>) -> Figure {
    let y_label = if unit.name.is_empty() { String::new() } else { format!("[{}]", unit.name) };
    let chart = Chart::new(&group.title, format!("time [{}]", time.name), y_label, curves);
    Figure { name: file_name(&group.title), chart }
}

/// A title as the name of a file.
pub(crate) fn file_name(title: &str) -> String {
    let letter = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' };
    title.chars().map(letter).collect()
}

/// The acceleration through the filter that the scene asks for, else through the one of its peak.
fn filtered(run: &RunFolder, raw: &Curve, time: &Unit) -> Option<Curve> {
    let result = run.record.results.peak_acceleration_g.as_ref();
    let (label, hertz) = match run.scene.report.acceleration_cfc {
        Some(class) => (format!("filtered, CFC {class}"), PASS_OVER_CLASS * class),
        None => {
            let cutoff = result?.cutoff_hz?;
            (format!("filtered, below {cutoff:.0} Hz"), cutoff / TWICE)
        }
    };
    let points: Vec<[f64; 2]> = raw.x.iter().zip(&raw.y).map(|(t, v)| [t / time.scale, *v]).collect();
    let smooth = phaseless(&points, hertz);
    Some(Curve::new(label, Mark::Line, smooth.into_iter().map(|[t, v]| [t * time.scale, v])))
}

/// The result that a chart shows, at its place.
fn peak(run: &RunFolder, name: &str, column: &Column, [time, unit]: [&Unit; 2], ours: &Curve) -> Option<Curve> {
    let results = &run.record.results;
    let quantity = match () {
        _ if name.ends_with(".fy_N_per_m") => results.peak_force_N_per_m.as_ref(),
        _ if name.ends_with(".ay_m_per_s2") => results.peak_acceleration_g.as_ref(),
        _ if column.title.starts_with("Pressure") => results.peak_pressure_Pa.as_ref(),
        _ => name.strip_suffix(".stress_Pa").and_then(|panel| results.panels.get(panel)?.peak_stress_Pa.as_ref()),
    }?;
    let (t, value) = (time.scale * quantity.time_s?, unit.scale * quantity.value?);
    let k = ours.x.partition_point(|x| *x < t).min(ours.x.len().checked_sub(1)?);
    let sign = if ours.y[k] < 0.0 { -1.0 } else { 1.0 };
    let label = format!("result: {}", super::headline::with_band(quantity, column.si));
    Some(Curve::new(label, Mark::Hollow, [[t, sign * value]]))
}

/// The pressure along the face of a wedge at constant speed.
fn profile(run: &RunFolder, theories: Vec<Curve>) -> Option<Figure> {
    let similarity = run.record.similarity.as_ref()?;
    let points: Vec<[f64; 2]> = similarity.profile.iter().filter_map(|[x, y]| Some([(*x)?, (*y)?])).collect();
    let end = points.last()?[0];
    let exact = exact(&run.scene);
    let curves = std::iter::once(Curve::new(run.model(), Mark::Line, points)).chain(theories).chain(exact).collect();
    let title = "Pressure on the face, mean over the last fifth of the run";
    let chart = Chart { x_range: Some([0.0, end]), ..Chart::new(title, "x/(V t)", "Cp [-]", curves) };
    Some(Figure { name: "pressure_on_the_face".into(), chart })
}

fn exact(scene: &Scene) -> Option<Curve> {
    let exact = compare::similarity_of(scene)?;
    Some(Curve::new("similarity solution", Mark::Dashed, exact.profile))
}

/// A reference's file name without folder and ending.
fn short(path: &str) -> String {
    let name = path.rsplit('/').next().unwrap_or(path);
    name.trim_end_matches(".csv").replace('_', " ")
}
