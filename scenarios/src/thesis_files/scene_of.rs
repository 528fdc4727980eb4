//! From INDAT and IPART to a scene.

use super::body_of::body_of;
use super::{Indat, Ipart, Particle, ThesisFileError, wrong};

/// Times √(depth/g) that an imported run lasts: INDAT has no end.
const DURATION: f64 = 10.0;
const GRAVITY: f64 = 9.81;
/// Tilt below which a surface is level [deg].
const LEVEL_DEG: f64 = 0.25;
/// Distance of water from a wall that it stands at, in spacings [-].
const AT_WALL: f64 = 6.0;
/// Particles of a scene over those of the files from which it is reported [-].
const LARGER: f64 = 2.0;
/// Share of the tank's width from which water fills it [-].
const FULL: f64 = 0.95;

/// A scene, and what of the files has no counterpart in it.
#[derive(Debug, Clone, PartialEq)]
pub struct Imported {
    /// The text of the scene.
    pub text: String,
    /// A line for each parameter without counterpart, and for each value that was chosen.
    pub notes: Vec<String>,
}

/// Lines of a scene, by table.
#[derive(Default)]
struct Lines {
    top: Vec<String>,
    resolution: Vec<String>,
    time: Vec<String>,
    fluid: Vec<String>,
    tank: Vec<String>,
    body: Vec<String>,
    notes: Vec<String>,
}

impl Lines {
    fn note(&mut self, text: impl Into<String>) {
        self.notes.push(text.into());
    }

    fn text(&self) -> String {
        let notes: String = self.notes.iter().map(|note| format!("# {note}\n")).collect();
        let table = |name: &str, lines: &[String]| match lines {
            [] => String::new(),
            lines => format!("\n[{name}]\n{}\n", lines.join("\n")),
        };
        format!(
            "# Written by `splashdown import` from INDAT and IPART (Pilorget 2010). What has no counterpart, or was chosen:\n{notes}{}\n{}{}{}{}{}",
            self.top.join("\n"),
            table("time", &self.time),
            table("resolution", &self.resolution),
            table("fluid", &self.fluid),
            table("tank", &self.tank),
            table("body", &self.body)
        )
    }
}

/// The scene of both files.
///
/// # Errors
/// Parameters that contradict each other or the particles, with the file; `name` is a word for the scene.
pub fn scene_of(name: &str, indat: &Indat, ipart: &Ipart, files: [&str; 2]) -> Result<Imported, ThesisFileError> {
    let of_indat = |given: String, expected: &str| Err(wrong(files[0], 1, given, expected));
    for name in ["h_SWL", "dx", "rho0", "vlx"] {
        if indat.get(name) <= 0.0 {
            return of_indat(format!("{name} = {}", indat.get(name)), "a number above 0");
        }
    }
    let [total, limit, fixed] = ["NP", "NB", "NBF"].map(|name| indat.get(name));
    if !(0.0 <= fixed && fixed <= limit && limit <= total) {
        return of_indat(format!("NP = {total}, NB = {limit}, NBF = {fixed}"), "0 <= NBF <= NB <= NP");
    }
    if ipart.particles.len() as f64 != total {
        let given = format!("{} particles", ipart.particles.len());
        return Err(wrong(files[1], ipart.particles.len().max(1), given, format!("NP = {total} of {}", files[0])));
    }
    let mut lines = Lines::default();
    lines.top.extend([
        format!("name = \"{name}\""),
        "description = \"Imported from INDAT and IPART\"".into(),
        "source = \"M. Pilorget, Development of a dynamic calculation tool for ditching, KTH/Dassault Aviation, 2010\""
            .into(),
    ]);
    let projection = indat.get("i_algorithm") == 4.0;
    if projection {
        lines.top.push("solver = \"incompressible_thesis\"".into());
    }
    let upright = upright_axis(&ipart.particles);
    let turned = mirrored(ipart, fixed as usize, limit as usize, indat.get("dx"));
    if turned.is_some() {
        lines.note("the water stands at the right wall: the scene is the mirror image, x to the left");
    }
    let ipart = turned.as_ref().unwrap_or(ipart);
    let (fixed, limit) = (fixed as usize, limit as usize);
    let [walls, mobile, fluid] = [&ipart.particles[..fixed], &ipart.particles[fixed..limit], &ipart.particles[limit..]];
    let body = (!mobile.is_empty()).then(|| {
        // the middle of the tank and the still water in the file's axes
        let middle = match walls.is_empty() {
            true => 0.5 * (indat.get("XMIN") + indat.get("XMAX")),
            false => 0.5 * extent(walls, 0).iter().sum::<f64>(),
        };
        let floor = if fluid.is_empty() { 0.0 } else { extent(fluid, upright)[0] - 0.5 * indat.get("dx") };
        body_of(mobile, upright, [middle, floor + indat.get("h_SWL")], indat.get("dx"))
    });
    lines_about_water(indat, fluid, upright, &mut lines);
    let plate = body.as_ref().is_some_and(|body| body.is_plate);
    numerics(indat, projection, plate, &mut lines, files[0])?;
    basin(indat, fluid, upright, &mut lines);
    if let Some(body) = body {
        lines.body.extend(body.lines);
        lines.notes.extend(body.notes);
    }
    for (name, what) in [
        ("visc_wall", "the viscosity of Monaghan's walls"),
        ("fex", "the rule of the force: see report.force_rules with a body"),
    ] {
        lines.note(format!("{name} = {}: no counterpart, {what}", indat.get(name)));
    }
    lines.note(
        "XMIN to ZMAX: no counterpart, the domain is the tank; x = 0 is its middle, y = 0 the still water".to_string(),
    );
    lines.note("pressure, density, temperature and sound velocity of each particle: no counterpart, water starts at rest in equilibrium");
    lines.note("IPART: fixed limit particles are taken to stand first, then mobile ones; walls are made from the tank");
    Ok(Imported { text: lines.text(), notes: lines.notes })
}

/// The files in a mirror, where the water stands at the right wall and not at the left one.
fn mirrored(ipart: &Ipart, fixed: usize, limit: usize, dx: f64) -> Option<Ipart> {
    let (walls, fluid) = (&ipart.particles[..fixed], &ipart.particles[limit..]);
    let [[left, right], [low, high]] = [extent(walls, 0), extent(fluid, 0)];
    let gaps = [low - left, right - high];
    let at_right = gaps.iter().all(|gap| gap.is_finite()) && gaps[1] < AT_WALL * dx && gaps[0] >= AT_WALL * dx;
    at_right.then(|| {
        let turn = |particle: &Particle| {
            let Particle { position: [x, y, z], velocity: [u, v, w], state } = *particle;
            Particle { position: [left + right - x, y, z], velocity: [-u, v, w], state }
        };
        Ipart { particles: ipart.particles.iter().map(turn).collect() }
    })
}

/// Reports water that the scene does not have: above h_SWL, or away from the left wall; and of a scene much larger than the files.
fn lines_about_water(indat: &Indat, fluid: &[Particle], upright: usize, lines: &mut Lines) {
    let [dx, depth, width] = ["dx", "h_SWL", "vlx"].map(|name| indat.get(name));
    let [low, _] = extent(fluid, upright);
    let above = fluid.iter().filter(|particle| particle.position[upright] > low + depth + dx).count();
    if above > 0 {
        lines.note(format!("{above} particles of water above h_SWL: left out, the scene has a tank's water at rest"));
    }
    let [left, right] = extent(fluid, 0);
    let area = (right - left + dx).min(width) * depth;
    let particles = area / (dx * dx);
    if particles > LARGER * fluid.len() as f64 {
        lines.note(format!(
            "the scene has about {particles:.0} particles of water, the files {}: IPART of several sizes? set resolution.spacing",
            fluid.len()
        ));
    }
}

/// Kernel, integrator, equation of state and their numbers; `plate`: with a body that is a plate.
fn numerics(
    indat: &Indat,
    projection: bool,
    plate: bool,
    lines: &mut Lines,
    file: &str,
) -> Result<(), ThesisFileError> {
    let choose = |name: &str, words: &[(f64, &'static str)]| {
        let given = indat.get(name);
        let known = words.iter().find(|(value, _)| *value == given).map(|(_, word)| *word);
        known.ok_or_else(|| {
            let values: Vec<String> = words.iter().map(|(value, _)| value.to_string()).collect();
            wrong(file, 1, format!("{name} = {given}"), format!("one of {}", values.join(", ")))
        })
    };
    let kernels = [(1.0, "gaussian"), (2.0, "quadratic"), (3.0, "cubic_spline"), (5.0, "wendland_c2")];
    let kernel = choose("i_kernel", &kernels)?;
    let integrators = [(1.0, "predictor_corrector"), (2.0, "verlet"), (3.0, "beeman"), (4.0, "")];
    let integrator = choose("i_algorithm", &integrators)?;
    let filter = choose("i_densityFilter", &[(0.0, "none"), (1.0, "shepard"), (2.0, "mls")])?;
    let viscous = choose("i_viscos", &[(1.0, "artificial"), (2.0, "laminar"), (3.0, "sps")])?;
    let walls = choose("iBC", &[(1.0, "repulsive"), (2.0, "dynamic")])?;
    let lattice = choose("lattice", &[(1.0, "square"), (2.0, "staggered")])?;
    let state = choose("i_EoS", &[(1.0, "tait"), (2.0, "ideal_gas")])?;
    let [dx, depth, rho0, gamma] = ["dx", "h_SWL", "rho0", "gamma"].map(|name| indat.get(name));
    lines.resolution.extend([format!("spacing = {dx:?}"), "growth = 1.0".into(), format!("lattice = \"{lattice}\"")]);
    if [indat.get("dy"), indat.get("dz")].iter().any(|other| *other != 0.0 && *other != dx) {
        lines.note("dy and dz: the spacing is dx along both axes");
    }
    let ratio = (1e9 * indat.get("h") / dx).round() / 1e9;
    let kept = ratio.clamp(1.0, 3.0);
    if kept != ratio {
        lines.note(format!("h/dx = {ratio}: fluid.smoothing_ratio takes 1 to 3, {kept} is written"));
    }
    lines.fluid.extend([
        format!("density = {rho0:?}"),
        format!("kernel = \"{kernel}\""),
        format!("smoothing_ratio = {kept:?}"),
    ]);
    if viscous != "artificial" {
        lines.fluid.push(format!("kinematic_viscosity = {:?}", indat.get("viscos_val")));
    }
    end_of(indat, depth, lines);
    if projection {
        lines.note("i_densityFilter, iBC, i_EoS, B, gamma, coef, eps: without effect in the projection");
        return Ok(());
    }
    lines.fluid.push(format!("cfl = {:?}", indat.get("CFL_number")));
    let artificial = if viscous == "artificial" { indat.get("viscos_val") } else { 0.0 };
    lines.fluid.extend([
        format!("integrator = \"{integrator}\""),
        format!("density_filter = \"{filter}\""),
        format!("artificial_viscosity = {artificial:?}"),
        format!("xsph = {:?}", indat.get("eps")),
        "density_diffusion = 0.0".into(),
        "shifting = false".into(),
    ]);
    if viscous == "sps" {
        lines.fluid.push("turbulence = \"sps\"".into());
    }
    let steps_density = matches!(integrator, "verlet" | "beeman");
    match walls {
        given if plate => lines.note(format!("{given} walls are refused with a plate: extrapolated ones are written")),
        "dynamic" if steps_density => {
            lines.note(format!("iBC = 2 with {integrator}: dynamic walls are refused, extrapolated ones are written"));
        }
        "dynamic" => lines.fluid.extend([
            "walls = \"dynamic\"".into(),
            format!("limit_pressure = {}", indat.get("i_correct_pb").clamp(0.0, 1.0)),
        ]),
        other => lines.fluid.push(format!("walls = \"{other}\"")),
    }
    if state == "ideal_gas" {
        lines.fluid.push("equation_of_state = \"ideal_gas\"".into());
        lines.note(format!("TE0 = {}: fluid.temperature has its default", indat.get("TE0")));
        return Ok(());
    }
    let by_b = (indat.get("B") * gamma / rho0).sqrt();
    let sound = if by_b > 0.0 { by_b } else { indat.get("coef") * (GRAVITY * depth).sqrt() };
    lines.fluid.push(format!("eos_exponent = {gamma:?}"));
    if sound > 0.0 {
        lines.fluid.push(format!("sound_speed = {sound:?}"));
    }
    Ok(())
}

/// The time steps, and the end, which INDAT does not have.
fn end_of(indat: &Indat, depth: f64, lines: &mut Lines) {
    let end = DURATION * (depth / GRAVITY).sqrt();
    lines.time.push(format!("end = {end:.4}"));
    lines.note(format!("time.end: INDAT has none, {DURATION} sqrt(h_SWL/g) is written"));
    match indat.get("ivar_dt") == 0.0 {
        true => lines.time.push(format!("step = {:?}", indat.get("dt"))),
        false => lines.note(format!("dt = {}: steps are as long as the limits allow (ivar_dt 1)", indat.get("dt"))),
    }
}

/// The upright axis: y, or z where particles lie along z and not along y.
fn upright_axis(particles: &[Particle]) -> usize {
    let height = |axis: usize| extent(particles, axis)[1] - extent(particles, axis)[0];
    if height(1) == 0.0 && height(2) > 0.0 { 2 } else { 1 }
}

/// Smallest and largest coordinate along an axis [m].
fn extent(particles: &[Particle], axis: usize) -> [f64; 2] {
    let values = particles.iter().map(|particle| particle.position[axis]);
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)])
}

/// Tank and surface.
fn basin(indat: &Indat, fluid: &[Particle], upright: usize, lines: &mut Lines) {
    let [width, depth, dx] = ["vlx", "h_SWL", "dx"].map(|name| indat.get(name));
    let walls = indat.get(if upright == 1 { "vly" } else { "vlz" });
    lines.tank.extend([format!("width = {width:?}"), format!("depth = {depth:?}")]);
    match walls >= depth {
        true => lines.tank.push(format!("height = {walls:?}")),
        false => lines.note("the domain is lower than the water: tank.height has its default"),
    }
    if indat.get("ZZMAX") != depth {
        lines.note(format!("ZZMAX = {}: the depth is h_SWL", indat.get("ZZMAX")));
    }
    let moving = fluid.iter().filter(|particle| particle.velocity != [0.0; 3]).count();
    if moving > 0 {
        lines.note(format!("velocities of {moving} particles: no counterpart, water starts at rest"));
    }
    let [left, right] = extent(fluid, 0);
    let wetted = right - left + dx;
    if wetted.is_finite() && wetted < FULL * width {
        lines.tank.push(format!("water_width = {:?}", (1e9 * wetted).round() / 1e9));
        lines.note("the water does not fill the tank: it stands at the left wall");
    } else if let Some(tilt) = tilt_deg(fluid, upright, dx).filter(|tilt| tilt.abs() > LEVEL_DEG) {
        lines.tank.push(format!("surface_tilt_deg = {tilt:.3}"));
    }
}

/// Tilt of the line through the highest particle of each column [deg], by least squares.
fn tilt_deg(fluid: &[Particle], upright: usize, dx: f64) -> Option<f64> {
    let mut tops = std::collections::BTreeMap::new();
    for particle in fluid {
        let (x, y) = (particle.position[0], particle.position[upright]);
        let top = tops.entry((x / dx).floor() as i64).or_insert((x, y));
        if y > top.1 {
            *top = (x, y);
        }
    }
    let count = tops.len() as f64;
    let mean = |value: fn(&(f64, f64)) -> f64| tops.values().map(value).sum::<f64>() / count;
    let (x0, y0) = (mean(|top| top.0), mean(|top| top.1));
    let (xy, xx) = tops.values().fold((0.0, 0.0), |(xy, xx), (x, y)| (xy + (x - x0) * (y - y0), xx + (x - x0).powi(2)));
    (tops.len() > 2 && xx > 0.0).then(|| (xy / xx).atan().to_degrees())
}
