//! Do a wave maker and a beach fit their tank? Refusals and warnings.

use fsi_coupling::geometry::polygon;
use settings::{Problem, require, significant};
use sph_core::Solver;
use water_entry::waves::linear_wave::{LinearWave, STEEPEST};

use crate::keys::{Beach, Body, GaugeFrame, Scene, SolverSettings, Symmetry, WaveMaker};
use crate::resolve_links::further;

/// Longest stroke over the width of the tank [-].
const LONGEST_STROKE: f64 = 0.25;
/// Spacings between the piston and the nearest place where the water's height is read.
const CLEAR_OF_PISTON: f64 = 4.0;
/// Spacings in a wave's height below which it was up to 9 % low after ten wavelengths.
const RESOLVED_HEIGHT: f64 = 4.0;
/// Share of its height that a wave may lose per wavelength by viscosity [-].
const LARGEST_LOSS: f64 = 0.01;
/// Samples per period below which the second harmonic of a load is read wrong.
const SAMPLES: f64 = 20.0;
/// Calming below which noise beside a body took more of the waves than less calming saved (section in waves, 10 spacings per draught) [-].
const LEAST_CALMING: f64 = 0.02;
/// Height over that of breaking from which waves are no longer those of linear theory [-].
const STEEP: f64 = 0.5;
/// H L²/d³ from which a second harmonic does not make the shape of the wave (Madsen 1971) [-].
const URSELL: f64 = 26.3;

pub(crate) fn check_waves(scene: &Scene) -> Result<(), Problem> {
    scene.tank.beach.map_or(Ok(()), |beach| check_beach(scene, &beach))?;
    scene.tank.wave_maker.map_or(Ok(()), |maker| check_wave_maker(scene, &maker))
}

fn check_beach(scene: &Scene, Beach { length, .. }: &Beach) -> Result<(), Problem> {
    let width = scene.water_sides()[1] - scene.water_sides()[0];
    let expected = format_args!("less than the {} m of water beside it", significant(width));
    require(*length < width, "tank.beach.length", length, expected)?;
    let still = scene.gravity != [0.0; 2] || scene.tank.beach.is_some_and(|beach| beach.rate.is_some());
    require(still, "gravity", format_args!("{:?}", scene.gravity), "other than [0, 0] with a [tank.beach] without rate")
}

fn check_wave_maker(scene: &Scene, maker: &WaveMaker) -> Result<(), Problem> {
    let key = |name: &str| format!("tank.wave_maker.{name}");
    match (maker.period, maker.length) {
        (None, None) => {
            return Err(Problem::missing(&key("period"), "the period [s] of the waves, or their length [m]"));
        }
        (Some(period), Some(length)) => {
            let expected = format_args!("absent beside period = {period} s: one gives the other");
            return Err(Problem::new(&key("length"), length, expected));
        }
        _ => {}
    }
    let thesis = scene.solver.kind() == Solver::IncompressibleThesis;
    require(
        !thesis,
        "solver",
        "\"incompressible_thesis\"",
        "another solver with a [tank.wave_maker]: its moving wall loses momentum",
    )?;
    let whole = scene.symmetry == Symmetry::None;
    require(whole, "symmetry", "\"x\"", "\"none\" with a [tank.wave_maker], which is at one end of the tank")?;
    let [gx, gy] = scene.gravity;
    let expected = "[0, a number below 0] with a [tank.wave_maker]";
    require(gx == 0.0 && gy < 0.0, "gravity", format_args!("{:?}", scene.gravity), expected)?;
    let expected = format_args!("tank.width = {} m with a [tank.wave_maker]", scene.tank.width);
    require(scene.tank.water_width >= scene.tank.width, "tank.water_width", scene.tank.water_width, expected)?;
    let (Some(wave), Some(piston)) = (scene.wave(), scene.piston()) else { return Ok(()) };
    let [length, breaking, stroke] = [wave.length(), wave.breaking_height(), piston.stroke].map(significant);
    let expected =
        format_args!("below {breaking} m, {STEEPEST} L tanh(kd), where a wave of {length} m breaks (Miche 1944)");
    require(maker.height < wave.breaking_height(), &key("height"), maker.height, expected)?;
    let longest = LONGEST_STROKE * scene.tank.width;
    let expected = format_args!(
        "a wave whose piston has a stroke of at most {} m, a quarter of tank.width: this one has {stroke} m",
        significant(longest)
    );
    require(piston.stroke <= longest, &key("height"), maker.height, expected)?;
    let crest = scene.tank.depth + maker.height;
    let expected = format_args!("at least {} m, above the crests", significant(crest));
    require(scene.tank.height >= crest, "tank.height", scene.tank.height, expected)?;
    let between = scene.tank.width - scene.tank.beach.map_or(0.0, |beach| beach.length);
    let least = CLEAR_OF_PISTON * scene.resolution.spacing;
    let relaxation = maker.relaxation.unwrap_or(0.5 * between);
    let expected = format_args!(
        "at least {} m, {CLEAR_OF_PISTON} spacings, and below {} m, the width of the tank less the beach",
        significant(least),
        significant(between)
    );
    let fits = maker.relaxation.is_none() || (least..between).contains(&relaxation);
    require(fits, &key("relaxation"), relaxation, expected)?;
    check_way_of_piston(scene, -0.5 * scene.tank.width + piston.reach())
}

/// When four periods of full waves have passed a place [s]; `None` without a wave maker (THEORY GE26).
pub fn full_waves_by(scene: &Scene, x: f64) -> Option<f64> {
    let (maker, wave) = (scene.tank.wave_maker?, scene.wave()?);
    Some((x + 0.5 * scene.tank.width) / wave.group_speed() + (maker.ramp + 4.0) * wave.period())
}

/// A run that ends before its farthest gauge has seen four periods of full waves (THEORY GE26).
pub fn early_end(scene: &Scene) -> Option<String> {
    let farthest = scene.observe.level.iter().copied().reduce(f64::max)?;
    let needed = full_waves_by(scene, farthest)?;
    (scene.time.end < needed).then(|| {
        format!(
            "time.end = {} s is early for the gauge at x = {farthest} m: waves of full height have passed it for four periods after {} s",
            scene.time.end,
            significant(needed)
        )
    })
}

/// WA13: the key of the solver's viscosity, its value, and the share of its height that a wave loses per wavelength by that
/// viscosity, 1 − exp(−2νk²L/c_g).
fn viscous_loss(scene: &Scene, wave: &LinearWave) -> (&'static str, f64, f64) {
    let h = scene.water().smoothing_ratio * scene.resolution.spacing;
    let g = scene.gravity[1].abs();
    let (key, given, viscosity) = match &scene.solver {
        SolverSettings::WeaklyCompressible { fluid } => {
            let alpha = fluid.scheme.artificial_viscosity;
            ("fluid.artificial_viscosity", alpha, alpha * h * scene.sound_speed() / 8.0)
        }
        SolverSettings::Incompressible { projection, .. }
        | SolverSettings::IncompressibleExplicit { projection, .. } => {
            let calming = projection.viscosity_coefficient;
            ("projection.calming", calming, calming * h * (g * h).sqrt())
        }
        SolverSettings::IncompressibleThesis { .. } => ("fluid.kinematic_viscosity", 0.0, 0.0),
    };
    let k = wave.wave_number;
    (key, given, 1.0 - (-2.0 * viscosity * k * k * wave.length() / wave.group_speed()).exp())
}

/// What is fixed or read is right of the piston, which reaches to x = `end` [m].
fn check_way_of_piston(scene: &Scene, end: f64) -> Result<(), Problem> {
    let clear = end + CLEAR_OF_PISTON * scene.resolution.spacing;
    let expected = format_args!(
        "places x of at least {} m, {CLEAR_OF_PISTON} spacings right of where the piston of [tank.wave_maker] reaches",
        significant(clear)
    );
    for x in &scene.observe.level {
        require(*x >= clear, "observe.level", x, expected)?;
    }
    for (i, gauge) in scene.gauges.iter().enumerate().filter(|(_, gauge)| gauge.on == GaugeFrame::Fixed) {
        require(gauge.at[0] >= clear, &format!("gauges[{i}].at"), format_args!("{:?}", gauge.at), expected)?;
    }
    let clear_of_it = |body: &Body| {
        let [min, _] = polygon::bounding_box(&body.placed_outline());
        let given = format_args!("a body from x = {} m on", significant(min[0]));
        require(min[0] >= clear, "body.position", given, expected)
    };
    scene.body.as_ref().map_or(Ok(()), clear_of_it)?;
    let mut others = scene.bodies.iter().enumerate();
    others.try_for_each(|(i, body)| clear_of_it(body).map_err(|problem| further(problem, i)))
}

/// A body where the waves are relaxed or damped, or whose incident waves no gauges tell.
fn in_no_waves(scene: &Scene, body: &Body) -> Option<String> {
    let [min, max] = polygon::bounding_box(&body.placed_outline());
    let from = scene.relaxation().map(|zone| zone.zone.from);
    let name = &body.name;
    if from.is_some_and(|from| min[0] < from) {
        return Some(format!(
            "body {name} is in the relaxation zone of the wave maker: its loads are not those of the waves"
        ));
    }
    if scene.beach().is_some_and(|beach| max[0] > beach.from) {
        return Some(format!(
            "body {name} is on the beach, where the water is braked: its loads are not those of the waves"
        ));
    }
    let clear = from.unwrap_or(f64::NEG_INFINITY);
    let gauges = scene.observe.level.iter().filter(|x| (clear..min[0]).contains(*x)).count();
    (gauges < 2).then(|| {
        format!("fewer than two observe.level before body {name}: the amplitude of its incident waves is not known")
    })
}

/// Warnings about waves that run nevertheless.
pub(crate) fn wave_warnings(scene: &Scene) -> Vec<String> {
    let (Some(maker), Some(wave)) = (scene.tank.wave_maker, scene.wave()) else { return Vec::new() };
    let (mut warnings, length) = (Vec::new(), wave.length());
    match scene.tank.beach {
        Some(beach) if beach.length < length => warnings.push(format!(
            "tank.beach.length = {} m is {} wavelengths: a beach shorter than one, {} m, sends waves back",
            beach.length,
            significant(beach.length / length),
            significant(length)
        )),
        Some(_) => {}
        None => {
            let back = 2.0 * scene.tank.width / wave.group_speed();
            warnings.push(format!(
                "the waves come back from the right wall: they are at the piston again after about {} s; a [tank.beach] would absorb them",
                significant(back)
            ));
        }
    }
    let (key, given, loss) = viscous_loss(scene, &wave);
    if loss > LARGEST_LOSS {
        let less = if key == "projection.calming" { LEAST_CALMING } else { 0.1 * given };
        let instead = if less < given {
            format!("{} would take {}", significant(less), significant(loss * less / given))
        } else {
            "a finer spacing takes less; less calming leaves noise that takes more".into()
        };
        warnings.push(format!(
            "{key} = {given} takes {} of the waves' height per wavelength: {instead}",
            significant(loss)
        ));
    }
    if let Some(relaxation) = maker.relaxation.filter(|relaxation| *relaxation < 0.9 * length) {
        warnings.push(format!(
            "tank.wave_maker.relaxation = {relaxation} m is {} wavelengths: a zone shorter than one, {} m, sends waves back",
            significant(relaxation / length),
            significant(length)
        ));
    }
    warnings.extend(early_end(scene));
    warnings.extend(scene.all_bodies().filter_map(|body| in_no_waves(scene, body)));
    let samples = wave.period() / scene.time.sample_every;
    if scene.all_bodies().next().is_some() && samples < SAMPLES {
        warnings.push(format!(
            "time.sample_every = {} s gives {} samples in a period: harmonics of loads need {SAMPLES}",
            scene.time.sample_every,
            significant(samples)
        ));
    }
    let rows = maker.height / scene.resolution.spacing;
    if rows < RESOLVED_HEIGHT {
        warnings.push(format!(
            "waves {} spacings high lose height on their way: {RESOLVED_HEIGHT} and more keep it better, {} m for resolution.spacing",
            significant(rows),
            significant(maker.height / RESOLVED_HEIGHT)
        ));
    }
    if maker.height > STEEP * wave.breaking_height() {
        warnings.push(format!(
            "tank.wave_maker.height = {} m is {} of the height of breaking: such waves are no longer those of linear theory",
            maker.height,
            significant(maker.height / wave.breaking_height())
        ));
    }
    let ursell = maker.height * length * length / wave.depth.powi(3);
    if (maker.second_order || maker.relaxation.is_some()) && ursell > URSELL {
        warnings.push(format!(
            "H L^2/d^3 = {}: above {URSELL} the second harmonic of tank.wave_maker.second_order does not make the shape of the wave",
            significant(ursell)
        ));
    }
    warnings
}
