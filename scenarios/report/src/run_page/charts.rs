//! The curves of the page: columns of the series by what they are, with references, theories and peaks.

use run::compare::{self, ReferenceCurve};
use run::observers::phaseless;
use run::results::PASS_OVER_CLASS;
use scene::vocabulary::{CUTOFF, ColumnTitle, Quantity, ResultName, column_title};
use scene::{Compare, Scene};
use water_entry::EntryModel;

use super::folder::RunFolder;
use super::headline::allowable;
use super::quantity::{Unit, with_unit};
use super::references::{self, in_full};
use super::theories::{self, Theories};
use crate::{Chart, Curve, Mark, Paint, Rgb};

/// References of more points than this are drawn as lines.
const MANY: usize = 60;
/// A curve that moves by less than this share of its largest value stays where it is.
const STILL: f64 = 1e-9;
/// A mean is drawn where it holds more than this number of samples.
const LEAST_SAMPLES: f64 = 3.0;
/// An allowable stress is drawn where it is below this multiple of the stress.
const NEAR: f64 = 4.0;
/// What columns of stress begin with.
const STRESS: &str = "Largest stress";
/// The dashes of references, other than those of theories.
const DASH_AND_DOT: usize = 3;
/// Colours of our curves (M. Okabe and K. Ito, *Color Universal Design*, 2008), of references, and of results and limits.
const OURS: [Rgb; 6] = [[0, 114, 178], [230, 159, 0], [0, 158, 115], [204, 121, 167], [86, 180, 233], [138, 99, 210]];
const THEIRS: [Rgb; 4] = [[128, 128, 128], [138, 99, 210], [181, 72, 122], [153, 153, 51]];
pub(super) const LIMIT: Rgb = [213, 94, 0];
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
    columns: Vec<(String, ColumnTitle)>,
}

/// The charts of a run, in their order.
pub(crate) fn figures(run: &RunFolder) -> Vec<Figure> {
    let theories = if run.record.host.is_some() { Theories::none() } else { Theories::beside(&run.scene) };
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
        let column = column_title(name);
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
    let stress = first.title.starts_with(STRESS);
    let values = |name: &str| {
        let points = run.curves.points(name, [time.scale, first.scale]);
        // the sign of the largest stress jumps between the faces
        points.into_iter().map(|[t, v]| [t, if stress { v.abs() } else { v }]).collect::<Vec<_>>()
    };
    let largest = |points: &[[f64; 2]]| points.iter().map(|p| p[1].abs()).filter(|v| v.is_finite()).fold(0.0, f64::max);
    let most = group.columns.iter().map(|(name, _)| largest(&values(name))).fold(0.0, f64::max);
    let unit = Unit::of(first.si, most);
    let scaled = |points: Vec<[f64; 2]>| points.into_iter().map(|[t, v]| [t, unit.scale * v]).collect::<Vec<_>>();
    let mut curves = Vec::new();
    let mut results = Vec::new();
    for (k, (name, column)) in group.columns.iter().enumerate() {
        let label = if group.columns.len() == 1 { "this run" } else { &column.part };
        let paint = Paint { colour: Some(OURS[k % OURS.len()]), ..Paint::default() };
        let own = Curve::new(label, Mark::Line, scaled(values(name))).painted(paint);
        let result = quantity(run, name, column);
        match smooth(run, first, result, &own, &time) {
            Some(mean) => {
                let label = if group.columns.len() == 1 { "every sample" } else { label };
                curves.insert(0, Curve { label: label.into(), ..own }.painted(Paint { pale: true, ..paint }));
                results.extend(result.and_then(|result| mark(result, column, [&time, &unit], &mean)));
                let label = if group.columns.len() == 1 {
                    mean.label.clone()
                } else {
                    format!("{}, {}", column.part, mean.label)
                };
                curves.push(Curve { label, ..mean }.painted(paint));
            }
            None => {
                results.extend(result.and_then(|result| mark(result, column, [&time, &unit], &own)));
                curves.push(own);
            }
        }
    }
    curves.extend(drawn_references(run, group, references, [&time, &unit]));
    if let [(name, column)] = group.columns.as_slice() {
        curves.extend(theories.curves(name, [time.scale, column.scale * unit.scale]));
        curves.extend(allowed(run, name, [time.scale, unit.scale], most));
    }
    curves.extend(results);
    let [only] = curves.as_slice() else { return Some(drawn(group, &time, &unit, curves)) };
    let alone = Curve { label: String::new(), ..only.clone() };
    Some(drawn(group, &time, &unit, vec![alone]))
}

/// The references of a group's columns, each once, in the colour of its column where there are several.
fn drawn_references(
    run: &RunFolder,
    group: &Group,
    references: &[Option<ReferenceCurve>],
    [time, unit]: [&Unit; 2],
) -> Vec<Curve> {
    let mut seen: Vec<(&str, &str, Vec<[f64; 2]>)> = Vec::new();
    let mut curves = Vec::new();
    let all = || run.scene.compare.iter().zip(references);
    for (compare, reference) in all() {
        let Some(reference) = reference else { continue };
        let Some(k) = group.columns.iter().position(|(name, _)| *name == compare.quantity) else { continue };
        let factor = group.columns[k].1.scale * unit.scale / compare.scale;
        let alike = |other: &Compare| {
            let column = group.columns.iter().any(|(name, _)| *name == other.quantity);
            column && other.reference == compare.reference && other.y == compare.y
        };
        let windows: Vec<[f64; 2]> = all().filter(|(other, _)| alike(other)).map(|(other, _)| other.window).collect();
        let inside = |t: &f64| windows.iter().any(|[from, to]| (from..=to).contains(&t));
        let points = reference.t.iter().zip(&reference.y).filter(|(t, _)| inside(t));
        let points: Vec<[f64; 2]> = points.map(|(t, y)| [time.scale * t, factor * y]).collect();
        if seen.iter().any(|(path, y, known)| *path == compare.reference && *y == compare.y && *known == points) {
            continue;
        }
        seen.push((&compare.reference, &compare.y, points.clone()));
        let mark = if points.len() > MANY { Mark::Dashed } else { Mark::Points };
        let colour = match group.columns.len() {
            1 => THEIRS[curves.len() % THEIRS.len()],
            _ => OURS[k % OURS.len()],
        };
        let form = if mark == Mark::Dashed { DASH_AND_DOT } else { curves.len() };
        let paint = Paint { colour: Some(colour), form: Some(form), pale: false };
        curves.push(Curve::new(references::name(&compare.reference), mark, points).painted(paint));
    }
    curves
}

/// The allowable stress of a panel, where it is near the stress of a column.
fn allowed(run: &RunFolder, name: &str, scales: [f64; 2], most: f64) -> Option<Curve> {
    let stress = allowable(run, name.strip_suffix(".stress_Pa")?).filter(|allowed| *allowed < NEAR * most)?;
    let times = run.curves.times();
    let ends = [*times.first()?, *times.last()?];
    let paint = Paint { colour: Some(LIMIT), ..Paint::default() };
    let label = format!("allowable, {}", with_unit(stress, "Pa"));
    Some(Curve::new(label, Mark::Dashed, ends.map(|t| [scales[0] * t, scales[1] * stress])).painted(paint))
}

fn drawn(group: &Group, time: &Unit, unit: &Unit, curves: Vec<Curve>) -> Figure {
    let title = match group.columns.as_slice() {
        [(_, column)] if column.title.starts_with(STRESS) => format!("{}, magnitude", column.title),
        [(_, column)] => in_full(column),
        _ => group.title.clone(),
    };
    let y_label = if unit.name.is_empty() { String::new() } else { format!("[{}]", unit.name) };
    let chart = Chart::new(title, format!("time [{}]", time.name), y_label, curves);
    Figure { name: file_name(&group.title), chart }
}

/// A title as the name of a file.
pub(crate) fn file_name(title: &str) -> String {
    let letter = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' };
    title.chars().map(letter).collect()
}

/// A column as its result is averaged, or through the filter that the scene asks for.
fn smooth(run: &RunFolder, column: &ColumnTitle, result: Option<Quantity>, raw: &Curve, time: &Unit) -> Option<Curve> {
    let points: Vec<[f64; 2]> = raw.x.iter().zip(&raw.y).map(|(t, v)| [t / time.scale, *v]).collect();
    let (label, smooth) = match run.scene.report.acceleration_cfc.filter(|_| column.si == "g") {
        Some(class) => (format!("filtered, CFC {class}"), phaseless(&points, PASS_OVER_CLASS * class)),
        None => {
            let window = CUTOFF / result?.cutoff_hz.filter(|hertz| *hertz > 0.0)?;
            (format!("mean over {}", with_unit(window, "s")), means(&points, window)?)
        }
    };
    Some(Curve::new(label, Mark::Line, smooth.into_iter().map(|[t, v]| [t * time.scale, v])))
}

/// Means of a curve over a time about each of its points, as far as it reaches; `None` where the samples are too few for it.
fn means(points: &[[f64; 2]], window: f64) -> Option<Vec<[f64; 2]>> {
    let (first, last) = (points.first()?[0], points.last()?[0]);
    let finite = points.iter().flatten().all(|v| v.is_finite());
    if !finite || last - first <= window || window * (points.len() - 1) as f64 <= LEAST_SAMPLES * (last - first) {
        return None;
    }
    let mut sums = vec![0.0];
    for pair in points.windows(2) {
        let area = 0.5 * (pair[1][0] - pair[0][0]) * (pair[0][1] + pair[1][1]);
        sums.push(sums[sums.len() - 1] + area);
    }
    let sum = |t: f64| {
        let k = points.partition_point(|p| p[0] <= t).clamp(1, points.len() - 1);
        let ([t0, v0], [t1, v1]) = (points[k - 1], points[k]);
        let share = if t1 > t0 { (t - t0) / (t1 - t0) } else { 0.0 };
        sums[k - 1] + (t - t0) * (v0 + 0.5 * share * (v1 - v0))
    };
    let whole = |t: &f64| t - 0.5 * window >= first && t + 0.5 * window <= last;
    let mean = |t: f64| [t, (sum(t + 0.5 * window) - sum(t - 0.5 * window)) / window];
    Some(points.iter().map(|p| p[0]).filter(whole).map(mean).collect())
}

/// The result that a column has; none where the run failed.
fn quantity(run: &RunFolder, name: &str, column: &ColumnTitle) -> Option<Quantity> {
    let results = &run.record.results;
    match () {
        _ if run.has_failed() => None,
        _ if name.ends_with(".fy_N_per_m") => results.get(ResultName::PeakForce),
        _ if name.ends_with(".ay_m_per_s2") && name.matches('.').count() == 1 => {
            results.get(ResultName::PeakAcceleration)
        }
        _ if name.ends_with(".p_Pa") => {
            results.get(ResultName::PeakPressure).filter(|_| run.gauge_of_peak() == Some(&column.part))
        }
        _ => name.strip_suffix(".stress_Pa").and_then(|panel| results.of_panel(panel, ResultName::PeakStress)),
    }
}

/// A result at its place on a curve.
fn mark(quantity: Quantity, column: &ColumnTitle, [time, unit]: [&Unit; 2], ours: &Curve) -> Option<Curve> {
    let (t, value) =
        (time.scale * quantity.time_s?, unit.scale * Some(quantity.value).filter(|value| value.is_finite())?);
    let k = ours.x.partition_point(|x| *x < t).min(ours.x.len().checked_sub(1)?);
    let sign = if ours.y[k] < 0.0 { -1.0 } else { 1.0 };
    let label = format!("result: {}", super::headline::with_band(&quantity, column.si));
    let paint = Paint { colour: Some(LIMIT), form: None, pale: false };
    Some(Curve::new(label, Mark::Hollow, [[t, sign * value]]).painted(paint))
}

/// The pressure along the face of a wedge at constant speed.
fn profile(run: &RunFolder, theories: Vec<Curve>) -> Option<Figure> {
    let similarity = run.record.similarity.as_ref()?;
    let points: Vec<[f64; 2]> = similarity.profile.iter().filter_map(|[x, y]| Some([(*x)?, (*y)?])).collect();
    let end = points.last()?[0];
    let exact = exact(&run.scene);
    let curves = std::iter::once(Curve::new("this run", Mark::Line, points)).chain(theories).chain(exact).collect();
    let title = "Pressure on the face, mean over the last fifth of the run";
    let chart = Chart { x_range: Some([0.0, end]), ..Chart::new(title, "x/(V t)", "Cp [-]", curves) };
    Some(Figure { name: "pressure_on_the_face".into(), chart })
}

fn exact(scene: &Scene) -> Option<Curve> {
    let exact = compare::similarity_of(scene)?;
    Some(theories::curve(EntryModel::Similarity, exact.profile))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mean_is_centred_and_ends_half_a_window_before_the_curve() {
        let line: Vec<[f64; 2]> = (0..=100).map(|k| 0.01 * f64::from(k)).map(|t| [t, 3.0 * t]).collect();
        let smooth = means(&line, 0.1).expect("samples");
        assert!(smooth.iter().all(|[t, v]| (v - 3.0 * t).abs() < 1e-12), "{smooth:?}");
        assert!((smooth[0][0] - 0.05).abs() < 0.011 && means(&line, 0.02).is_none() && means(&line, 2.0).is_none());
    }
}
