//! A wedge that is rolled or moves obliquely, by boundary elements (THEORY EN34, EN47).

use scene::{Body, Scene, Shape};
use water_entry::{
    AsymmetricFlow, EntryModel, Instant, OutOfRange, RolledEntry, RolledFlow, RolledInstant, SectionMotion,
};

/// Share of a face that the check of a scene wets.
const CHECKED: f64 = 0.1;

/// Are boundary elements those about a rigid wedge that is rolled or moves sideways?
pub(super) fn rolls(scene: &Scene, model: EntryModel) -> bool {
    let lopsided = |body: &Body| body.angle_deg != 0.0 || body.velocity[0] != 0.0;
    let wedge = |body: &Body| matches!(body.shape, Shape::Wedge { .. }) && lopsided(body) && !body.bends();
    model == EntryModel::BoundaryElement && scene.body.as_ref().is_some_and(wedge)
}

/// Deadrises of the faces, left and right [deg]; `None` for other shapes.
pub(super) fn deadrises(body: &Body) -> Option<[f64; 2]> {
    let Shape::Wedge { deadrise_deg, .. } = body.shape else { return None };
    Some([deadrise_deg - body.angle_deg, deadrise_deg + body.angle_deg])
}

/// Does a jet's tip come to a chine, at the speed of the start?
pub(super) fn wets_chines(scene: &Scene) -> Option<bool> {
    let body = scene.body.as_ref()?;
    let RolledEntry { deadrises, lengths, speed, sideways, .. } = entry(scene, body, SectionMotion::Constant)?;
    let flow = AsymmetricFlow::oblique(deadrises[0], deadrises[1], sideways / speed).ok()?;
    let longest = flow.left.length.max(flow.right.length);
    Some(scene.entry()?.final_draught * longest > lengths[0].min(lengths[1]))
}

/// The entry of a rolled wedge; `None` for other shapes.
fn entry(scene: &Scene, body: &Body, motion: SectionMotion) -> Option<RolledEntry> {
    let Shape::Wedge { deadrise_deg, breadth, .. } = body.shape else { return None };
    let (deadrise, roll) = (deadrise_deg.to_radians(), body.angle_deg.to_radians());
    Some(RolledEntry {
        deadrises: [deadrise - roll, deadrise + roll],
        lengths: [0.5 * breadth / deadrise.cos(); 2],
        motion,
        draught: body.draught(),
        speed: -body.velocity[1],
        sideways: body.velocity[0],
        gravity: -scene.gravity[1],
        density: scene.water().density,
    })
}

/// Is there a flow about the wedge?
///
/// # Errors
/// Deadrises outside the range of boundary elements, or of which there is no similar flow.
pub(super) fn check(scene: &Scene, body: &Body, motion: SectionMotion) -> Result<(), OutOfRange> {
    let Some(RolledEntry { deadrises, lengths, speed, sideways, .. }) = entry(scene, body, motion) else {
        return Ok(());
    };
    let ratio = sideways / speed;
    let longest = AsymmetricFlow::oblique(deadrises[0], deadrises[1], ratio)
        .map_or(1.0, |flow| flow.left.length.max(flow.right.length));
    let draught = CHECKED * lengths[0].min(lengths[1]) / longest;
    RolledFlow::oblique(deadrises, lengths, draught, [ratio, 1.0], 0.0).map(|_| ())
}

/// The wedge at `times` [s], as far as the flow can be followed, and why not further.
///
/// # Errors
/// As [`RolledEntry::solve`].
pub(super) fn solve(
    scene: &Scene,
    body: &Body,
    motion: SectionMotion,
    times: &[f64],
) -> Result<(Vec<RolledInstant>, Option<OutOfRange>), OutOfRange> {
    let Some(entry) = entry(scene, body, motion) else { return Ok((Vec::new(), None)) };
    let (steps, end) = entry.solve(times.last().copied().unwrap_or(0.0))?;
    let reached = steps.last().map_or(0.0, |step| step.time);
    let within = times.iter().take_while(|time| **time <= reached);
    Ok((within.map(|time| RolledInstant::between(&steps, *time)).collect(), end))
}

/// What a symmetric section has too: `wetted` is the larger half width, in the wedge's axes, whose face has the slope of `deadrise_deg`.
pub(super) fn as_symmetric(now: &RolledInstant, deadrise_deg: f64) -> Instant {
    Instant {
        time: now.time,
        draught: now.draught,
        speed: now.speed,
        rate: now.rate,
        force: now.force[1],
        wetted: now.wetted[0].max(now.wetted[1]) * deadrise_deg.to_radians().cos(),
    }
}

/// Largest pressure on both faces [Pa], and its distance from the apex in the wedge's axes, negative on the left [m].
pub(super) fn peak_pressure(now: &RolledInstant, deadrise_deg: f64) -> [f64; 2] {
    let cos = deadrise_deg.to_radians().cos();
    let faces = now.pressure.iter().zip([-cos, cos]);
    let places = faces.flat_map(|(face, cos)| face.iter().map(move |[s, p]| [*p, s * cos]));
    places.fold([0.0, 0.0], |top, here| if here[0] > top[0] { here } else { top })
}
