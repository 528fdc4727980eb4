//! A body in regular waves by linear potential theory (THEORY WA17).

use fsi_coupling::geometry::polygon;
use scene::{Motion, Scene};
use serde::Serialize;
use settings::significant;
use water_entry::waves::floating::{DIRECTIONS, SectionInWaves};

/// First harmonics over the incident amplitude, and the mean over its square; only what the theory of this body has.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct WaveTheory {
    /// Amplitude of the waves that the scene asks for [m].
    pub amplitude_m: f64,
    /// Force along x, along y [N/m²] and moment about the centre of mass [N/m] of a body held still.
    #[serde(rename = "loads_N_per_m2_and_N_per_m")]
    pub loads: [Option<f64>; DIRECTIONS],
    /// Displacement along x, along y [-] and angle [deg/m] of a body afloat.
    #[serde(rename = "motions_m_per_m_and_deg_per_m")]
    pub motions: [Option<f64>; DIRECTIONS],
    /// Mean force along x over a² of a body held still [N/m³].
    #[serde(rename = "drift_N_per_m3")]
    pub drift: Option<f64>,
}

impl WaveTheory {
    /// In a line: amplitudes in the waves that the scene asks for.
    pub fn to_text(&self) -> String {
        let amplitude = self.amplitude_m;
        let names = [["force x", "force y", "moment"], ["motion x", "y", "angle"]];
        let units = [["N/m", "N/m", "N"], ["m", "m", "deg"]];
        let mut parts: Vec<String> = Vec::new();
        for (of, values) in [self.loads, self.motions].into_iter().enumerate() {
            for k in 0..DIRECTIONS {
                parts.extend(
                    values[k].map(|v| format!("{} {} {}", names[of][k], significant(amplitude * v), units[of][k])),
                );
            }
        }
        parts.extend(self.drift.map(|d| format!("mean force x {} N/m", significant(amplitude * amplitude * d))));
        parts.join(", ")
    }
}

/// Amplitude over freeboard and draught from which waves are not small for a section [-].
const SMALL: f64 = 0.5;
/// Difference of a body's mass from that of the water that it displaces at the start from which it is not afloat there, and lever of buoyancy
/// over the waterline's breadth [-].
const NOT_AFLOAT: f64 = 0.03;

/// A factor of directions by directions.
type Table = [[f64; DIRECTIONS]; DIRECTIONS];

/// WA17: of the only, rigid body of a scene with a wave maker, fixed, or free with springs to the tank, at rest and stable; `None` for
/// others, and for an outline that does not cross the surface just twice.
pub fn wave_theory(scene: &Scene) -> Option<WaveTheory> {
    let (wave, body) = (scene.wave()?, scene.body.as_ref()?);
    let rigid =
        scene.bodies.is_empty() && body.panels.is_empty() && body.modal.is_none() && body.sprung_masses.is_empty();
    rigid.then_some(())?;
    let (sin, cos) = body.angle_deg.to_radians().sin_cos();
    let ([x, y], [cx, cy]) = (body.position, body.center_of_mass);
    let centre = [x + cx * cos - cy * sin, y + cx * sin + cy * cos];
    let density = scene.water().density;
    let section = SectionInWaves::new(&body.placed_outline(), centre, wave, density, scene.gravity[1].abs())?;
    let amplitude_m = 0.5 * scene.tank.wave_maker?.height;
    let [least, most] = polygon::bounding_box(&body.placed_outline()).map(|corner| corner[1]);
    let small = amplitude_m < SMALL * most.min(-least);
    small.then_some(())?;
    match &body.motion {
        Motion::Fixed => {
            let loads = section.excitation.map(|[re, im]| Some(re.hypot(im)));
            Some(WaveTheory { amplitude_m, loads, drift: Some(section.drift), ..WaveTheory::default() })
        }
        Motion::Free(freedom) => {
            let turns = freedom.inertia.is_some();
            let breadth = section.stiffness[1][1] / (density * scene.gravity[1].abs());
            let afloat = (freedom.mass / (density * section.area) - 1.0).abs() < NOT_AFLOAT
                && (!turns || section.lever.abs() < NOT_AFLOAT * breadth);
            let [_, [_, c22, c23], [_, c32, c33]] = section.stiffness;
            let at_rest = body.velocity == [0.0; 2] && body.angular_velocity_deg_per_s == 0.0;
            (afloat && at_rest && (!turns || c22 * c33 > c23 * c32)).then_some(())?;
            let (stiffness, damping) = springs(scene, centre)?;
            let free = [freedom.x(), freedom.y(), freedom.inertia.is_some()];
            let masses = [freedom.mass, freedom.inertia.unwrap_or(1.0)];
            let [x, y, angle] = section.motion(masses, free, stiffness, damping);
            Some(WaveTheory {
                amplitude_m,
                motions: [Some(x), Some(y), Some(angle.to_degrees())],
                ..WaveTheory::default()
            })
        }
        _ => None,
    }
}

/// Stiffness and damping of the scene's springs between the tank and its body, for small motions; `None` with other joints.
fn springs(scene: &Scene, centre: [f64; 2]) -> Option<(Table, Table)> {
    let (mut stiffness, mut damping) = ([[0.0; DIRECTIONS]; DIRECTIONS], [[0.0; DIRECTIONS]; DIRECTIONS]);
    for joint in &scene.joints {
        let to = joint.to.filter(|_| joint.breaks_at.is_none())?; // another joint has none
        let on_body = if joint.bodies[0] == "tank" { to } else { joint.at };
        let length = (to[0] - joint.at[0]).hypot(to[1] - joint.at[1]);
        let way = [(to[0] - joint.at[0]) / length, (to[1] - joint.at[1]) / length];
        let arm = [on_body[0] - centre[0], on_body[1] - centre[1]];
        let along = [way[0], way[1], arm[0] * way[1] - arm[1] * way[0]];
        for j in 0..DIRECTIONS {
            for k in 0..DIRECTIONS {
                stiffness[j][k] += joint.stiffness * along[j] * along[k];
                damping[j][k] += joint.damping * along[j] * along[k];
            }
        }
    }
    Some((stiffness, damping))
}
