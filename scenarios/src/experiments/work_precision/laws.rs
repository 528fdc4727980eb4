//! Laws of a chart that apply to other runs (THEORY GE17).

use run::charted::{ErrorLaw, ShareOf, WedgeEntry};
use run::observers::SIMILARITY_FROM;
use run::power_law::PowerLaw;
use scene::{Norm, Scene, SceneError};

use super::case::{Family, Quantity, Reading};
use super::measured::Measured;
use crate::experiments::runs::scene_with;

/// The laws of a chart that apply to other runs: one for each family over spacings and each number.
///
/// # Errors
/// The scene of the chart is wrong.
pub fn error_laws(measured: &Measured) -> Result<Vec<ErrorLaw>, SceneError> {
    let mut laws = Vec::new();
    for family in measured.case.family.iter().filter(|f| f.vary.as_deref() == Some("resolution.spacing")) {
        let Some((_, set)) = family.runs(&measured.case).into_iter().next() else { continue };
        let scene = scene_with(&measured.case.scene, &set, &[])?;
        laws.extend(measured.case.quantity.iter().filter_map(|q| error_law(measured, family, q, &scene)));
    }
    Ok(laws)
}

fn error_law(measured: &Measured, family: &Family, quantity: &Quantity, scene: &Scene) -> Option<ErrorLaw> {
    let entry = WedgeEntry::of(scene)?;
    let (path, share_of) = number_of(quantity, scene)?;
    let seen = measured.seen(quantity).into_iter().filter(|s| s.point.family == family.name);
    let point = |k: f64, reading: Reading| [k, error_of_mean(k, reading)];
    let points: Vec<[f64; 2]> = seen.filter_map(|s| Some(point(s.run.spacings_per_draught?, s.reading))).collect();
    let law = PowerLaw::fit(points.iter().copied())?;
    let spacings = points.iter().fold([f64::INFINITY, 0.0], |e: [f64; 2], p| [e[0].min(p[0]), e[1].max(p[0])]);
    Some(ErrorLaw {
        case: measured.case.name.clone(),
        family: family.name.clone(),
        number: path.replace(&format!("/{}.", entry.body), "/BODY."),
        kind: entry.kind,
        deadrise_deg: entry.deadrise_deg,
        mach: entry.mach,
        share_of,
        law,
        spacings,
    })
}

/// Error of a mean over the window [-]: its bias, and the scatter of single samples over √n, n the rows of particles that the body
/// meets in the window, of k that it meets in the run.
fn error_of_mean(spacings: f64, reading: Reading) -> f64 {
    let rows = ((1.0 - SIMILARITY_FROM) * spacings).max(1.0);
    reading.bias.hypot(reading.scatter / rows.sqrt())
}

/// The number that a quantity's error belongs to; `None` for errors of curves that are not relative to a number.
fn number_of(quantity: &Quantity, scene: &Scene) -> Option<(String, ShareOf)> {
    if let Some(path) = &quantity.value {
        return Some((path.clone(), ShareOf::Value));
    }
    let column = quantity.comparison.as_ref().filter(|column| column.ends_with(".vy_m_per_s"))?;
    let compared =
        scene.compare.iter().find(|c| c.quantity == *column && Some(&c.reference) == quantity.against.as_ref())?;
    (compared.norm == Norm::RmsOverFirst).then(|| (format!("means/{column}"), ShareOf::ContactSpeed))
}
