//! What weakly compressible water takes of a force, how fast its sound must be, and how far its echo is (THEORY WC17).

use settings::significant;

use crate::impact::Entry;
use crate::keys::{Body, Scene};
use crate::vocabulary::{Doubt, Why};

/// Speed of sound in water [m/s]: a faster one has no meaning.
pub const WATER_SOUND: f64 = 1480.0;
/// Reach of the water over c₀ t_end, the way of sound in the run [-]. An echo needs at least 0.5 to come back in time;
/// the coarse rows far away return the wave a little earlier: 0.5 disturbs the force, 0.65 does not.
pub const ACOUSTIC_REACH: f64 = 0.65;
/// Least speed of sound over the fastest known speed of the flow [-].
pub const LEAST_SOUND_RATIO: f64 = 10.0;

/// Share of the force that weak compressibility costs [-]: ε = 2 M² ln(1/M), M = U/c₀ from the spray root's speed U
/// and the speed of sound c₀ [m/s].
///
/// A fit to weakly compressible runs against the similarity solution at deadrise 10° to 30°, for M up to about 0.3;
/// it says nothing beyond M = e^(−1/2), where it turns, and is held constant there.
pub fn compressibility_error(root_speed: f64, sound_speed: f64) -> f64 {
    let mach = (root_speed / sound_speed).min(LARGEST_MACH);
    match mach > 0.0 {
        true => -2.0 * mach * mach * mach.ln(),
        false => 0.0,
    }
}

/// [`compressibility_error`] where the fit holds: `None` for a spray root faster than Mach 0.3, as a round bottom's is at
/// first contact.
pub fn known_compressibility_error(root_speed: f64, sound_speed: f64) -> Option<f64> {
    (root_speed <= FITTED_MACH * sound_speed).then(|| compressibility_error(root_speed, sound_speed))
}

/// Largest Mach number of the spray root in the runs that the error is fitted to [-].
pub const FITTED_MACH: f64 = 0.3;

/// Mach number at which the fitted error is largest, e^(−1/2) [-].
const LARGEST_MACH: f64 = 0.606_530_659_712_633_4;

/// Largest error that [`sound_speed_for`] can be asked for [-]: below the maximum 1/e of the fit.
pub const LARGEST_COMPRESSIBILITY_ERROR: f64 = 0.25;

/// Speed of sound [m/s] at which compressibility costs the share `error` [-] of the force of a spray root of speed
/// U [m/s]: the inverse of [`compressibility_error`], for errors in (0, [`LARGEST_COMPRESSIBILITY_ERROR`]].
pub fn sound_speed_for(error: f64, root_speed: f64) -> f64 {
    let (mut low, mut high) = (0.0, LARGEST_MACH);
    while high - low > 4.0 * f64::EPSILON * high {
        let mach = 0.5 * (low + high);
        match compressibility_error(mach, 1.0) < error {
            true => low = mach,
            false => high = mach,
        }
    }
    root_speed / high
}

/// Share that compressibility takes of the forces that the bands are fitted to [-].
const ADMITTED: f64 = 0.01;

/// Share of a force that compressibility takes beyond that, or why it is not known; none where water is incompressible [-].
pub fn lost_beyond(sound: Option<f64>, entry: &Entry) -> Result<f64, Why> {
    let mach = sound.map_or(0.0, |sound| entry.root_speed() / sound);
    let lost = known_compressibility_error(mach, 1.0).ok_or_else(|| {
        Why::from(format!(
            "the spray root starts at Mach {}: what compressibility takes of the force is known up to 0.3",
            significant(mach)
        ))
    })?;
    Ok((lost - ADMITTED).max(0.0))
}

/// Water that outran the forecast by which the speed of sound was chosen: the largest Mach number of a particle.
pub fn doubt(mach_reached: f64) -> Option<Doubt> {
    (mach_reached > FITTED_MACH).then(|| {
        let mach = significant(mach_reached);
        let why =
            format!("a particle reached Mach {mach}: compressibility is not small; set a higher fluid.sound_speed");
        Doubt::about("compressibility.mach_reached", why)
    })
}

pub(crate) fn slow_sound(scene: &Scene) -> Option<String> {
    let (fastest, sound) = (scene.fastest_speed(), scene.sound_speed());
    // A hair of slack: an "auto" speed of sound is exactly the least.
    (sound < LEAST_SOUND_RATIO * fastest * (1.0 - 1e-9)).then(|| {
        format!(
            "fluid.sound_speed = {} m/s is {} times the flow's fastest known speed, {} m/s, Mach {}: water is nearly \
             incompressible from {LEAST_SOUND_RATIO} times on, up to Mach {}",
            significant(sound),
            significant(sound / fastest),
            significant(fastest),
            significant(fastest / sound),
            1.0 / LEAST_SOUND_RATIO
        )
    })
}

pub(crate) fn echo(scene: &Scene) -> Option<String> {
    let beside = scene
        .entries()
        .iter()
        .map(|(body, _)| 0.5 * scene.tank.width - body.middle().abs())
        .fold(f64::INFINITY, f64::min);
    let reach = beside.min(scene.tank.depth);
    let needed = ACOUSTIC_REACH * scene.sound_speed() * scene.time.end;
    // A hair of slack: an "auto" tank is exactly as large as needed.
    (reach < needed * (1.0 - 1e-9)).then(|| {
        format!(
            "the echo from the tank's walls, {} m away, reaches the body after about {} s: {} m would keep it out",
            significant(reach),
            significant(scene.time.end * reach / needed),
            significant(needed)
        )
    })
}

/// What compressibility takes of the force on each body.
pub(crate) fn lost_forces(scene: &Scene) -> Vec<String> {
    let entries = scene.entries();
    let wet = entries.iter().filter(|(_, entry)| entry.final_draught > 0.0);
    wet.filter_map(|(body, entry)| Some(scene.about(body) + &lost_force(scene, body, entry)?)).collect()
}

/// What compressibility takes of an impact's force.
fn lost_force(scene: &Scene, body: &Body, entry: &Entry) -> Option<String> {
    if scene.is_cushioned_by(body, entry) {
        return None; // as soft as it is meant to be
    }
    let (root, sound) = (entry.root_speed(), scene.sound_speed());
    let cure = match sound < WATER_SOUND {
        true => "raise fluid.sound_speed",
        false => "sound is as fast as in water, where the force is lower as well",
    };
    match known_compressibility_error(root, sound) {
        None => Some(format!(
            "the spray root starts at Mach {}: what compressibility takes of the force is known up to 0.3; {cure}",
            significant(root / sound)
        )),
        Some(error) if error > scene.solver.water().compressibility_error * (1.0 + 1e-9) => Some(format!(
            "compressibility takes about {} % of the force at Mach {} of the spray root; fluid.compressibility_error \
             admits {} %: {cure}",
            significant(100.0 * error),
            significant(root / sound),
            significant(100.0 * scene.solver.water().compressibility_error)
        )),
        Some(_) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sound_speed_inverts_the_error() {
        for error in [1e-4, 0.01, 0.057, LARGEST_COMPRESSIBILITY_ERROR] {
            let c = sound_speed_for(error, 2.72);
            assert!((compressibility_error(2.72, c) / error - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn error_matches_the_runs_it_was_fitted_to() {
        // k = 29, after an approach: −3.4 % (30°), −3.9 % (20°), −5.5 % (10°) at Mach 0.1; −1.05 % (30°), −1.3 % (20°) at 0.05
        assert!((compressibility_error(0.1, 1.0) - 0.043).abs() < 0.012);
        assert!((compressibility_error(0.05, 1.0) - 0.0118).abs() < 0.004);
        assert_eq!(compressibility_error(0.0, 20.0), 0.0);
    }
}
