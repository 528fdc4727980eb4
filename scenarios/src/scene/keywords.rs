//! Every key of a scene file, declared once: for help, for the reference page, and for error messages.

/// A key of a scene file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Keyword {
    /// Where it stands, such as `body.mass`; `gauges[].at` stands in each `[[gauges]]` table.
    pub path: &'static str,
    /// Unit of its value, `-` for a pure number, empty for anything else.
    pub unit: &'static str,
    /// Its value where the file is silent, or `required`.
    pub default: &'static str,
    /// What it means.
    pub doc: &'static str,
}

impl Keyword {
    /// The keyword in one line.
    pub fn help(&self) -> String {
        let Keyword { path, unit, default, doc } = self;
        let unit = if unit.is_empty() { String::new() } else { format!(" [{unit}]") };
        match default.starts_with("required") {
            true => format!("{path}{unit}: {doc} ({default})"),
            false => format!("{path}{unit}: {doc} (default: {default})"),
        }
    }
}

/// All keys, in the order in which a scene is usually written.
pub fn keywords() -> &'static [Keyword] {
    KEYWORDS
}

/// The keyword of `keys` at `path`, where `gauges[2].at` and `gauges[].at` are the same.
pub(super) fn find(keys: &'static [Keyword], path: &str) -> Option<&'static Keyword> {
    let path = without_indices(path);
    // An item of a list belongs to the key of the list.
    let key = path.trim_end_matches("[]");
    keys.iter().find(|keyword| keyword.path == key)
}

/// The known path nearest to an unknown one: few edits of the last word, few changes of table.
pub(super) fn nearest(keys: &'static [Keyword], path: &str) -> Option<&'static str> {
    let path = without_indices(path);
    let (table, key) = path.rsplit_once('.').unwrap_or(("", &path));
    let cost = |keyword: &&Keyword| {
        let (its_table, its_key) = keyword.path.rsplit_once('.').unwrap_or(("", keyword.path));
        3 * edit_distance(key, its_key) + edit_distance(table, its_table).min(2)
    };
    let best = keys.iter().min_by_key(cost)?;
    // More than a third of the word changed is another word.
    (cost(&best) <= key.chars().count() + 2).then_some(best.path)
}

fn without_indices(path: &str) -> String {
    let mut inside = false;
    path.chars()
        .filter(|c| {
            inside = match c {
                '[' => true,
                ']' => false,
                _ => inside,
            };
            !inside || *c == '['
        })
        .collect()
}

/// Least number of inserted, removed and replaced characters between two words (Levenshtein 1965).
fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, from) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, to) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(from != *to);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

const fn key(path: &'static str, unit: &'static str, default: &'static str, doc: &'static str) -> Keyword {
    Keyword { path, unit, default, doc }
}

#[rustfmt::skip]
static KEYWORDS: &[Keyword] = &[
    key("name", "", "required", "a word for file names and titles"),
    key("description", "", "\"\"", "what the scene shows, in one line"),
    key("source", "", "\"\"", "where its numbers come from"),
    key("model", "", "wcsph; the solver's where there is one", "auto: the cheapest whose measured error for `want` is `within`; von_karman | wagner | mlm | similarity: theories of a symmetric section's entry, in milliseconds; wcsph | incompressible: particles (THEORY LM11)"),
    key("want", "", "peak_force", "what model = \"auto\" is chosen for: peak_force | peak_pressure | history | strain | motion"),
    key("within", "-", "0.05", "largest error that model = \"auto\" may have had where it was measured, 0 to 1"),
    key("solver", "", "weakly_compressible", "what gives the pressure: weakly_compressible (an equation of state), incompressible (a projection), incompressible_explicit (the projection with one pressure sweep a step: as weakly compressible as its step is long, THEORY EX4), incompressible_thesis (Pilorget 2010)"),
    key("symmetry", "", "none", "none | x: simulate x >= 0 only, with a mirror at x = 0; left out with model = \"auto\": x where the scene is symmetric"),
    key("gravity", "m/s^2", "[0.0, -9.81]", "acceleration of gravity [x, y]"),
    key("similarity", "", "absent", "wedge: judge by the similarity solution of a wedge at constant speed (Dobrovolskaya 1969)"),
    key("time.end", "s", "required; with model = \"auto\" of an entry: past the largest force", "end of the simulated time, which starts at 0"),
    key("time.sample_every", "s", "end/500", "interval between rows of the series"),
    key("time.frame_every", "s", "end/50", "interval between frames of particles"),
    key("time.step", "s", "absent", "length of every step (INDAT ivar_dt 0, and dt), below the limit of fluid.cfl; absent: each (ivar_dt 1) as long as fluid.cfl and the other limits allow"),
    key("resolution.spacing", "m", "required", "finest particle spacing dx (INDAT dx, dy, dz: one here)"),
    key("resolution.growth", "-", "1.1", "ratio of successive rows outside the fine zone; 1 is uniform"),
    key("resolution.fine_zone", "m", "auto", "[half width from the body's middle, depth below still water]; auto: holds the spray root to the end, or the whole tank without an impact"),
    key("resolution.lattice", "", "square", "square | staggered: body-centred squares of side sqrt(2) dx, growth 1 only (INDAT lattice 1 | 2: SC | BCC)"),
    key("resolution.packing", "", "false; true if incompressible with a body", "pack the water round the body before the run: as much as there is room for, evenly (Colagrossi et al. 2012); not round a polyline: true | false"),
    key("resolution.follow", "", "false", "the fine zone grows with the draught of a body that enters the water, coarse particles being halved; weakly compressible with the symplectic integrator: true | false"),
    key("fluid.density", "kg/m^3", "1000.0", "density of the undisturbed water (INDAT rho0)"),
    key("fluid.sound_speed", "m/s", "auto", "speed of sound; ideal_gas: of its temperature; auto: compressibility costs an impact fluid.compressibility_error of its force; at least 10 times the flow's fastest known speed; with an incompressible solver nothing but the size of an auto tank comes from it (INDAT coef, which makes B = density sound_speed^2/eos_exponent)"),
    key("fluid.compressibility_error", "-", "0.01", "share of the force that compressibility may cost"),
    key("fluid.eos_exponent", "-", "7.0", "exponent of Tait's equation of state (INDAT gamma); 1 is linear; ideal_gas: ratio of specific heats, by default 1.4"),
    key("fluid.kernel", "", "wendland_c2", "gaussian | quadratic | cubic_spline | wendland_c2 (INDAT i_kernel 1 | 2 | 3 | 5) | wendland_c4"),
    key("fluid.smoothing_ratio", "-", "1.5", "smoothing length over spacing h/dx (INDAT h), 1.0 if not given with solver = incompressible_thesis; the kernel's support is 2h"),
    key("fluid.artificial_viscosity", "-", "0.02", "coefficient alpha of artificial viscosity (INDAT i_viscos 1: viscos_val), 0.1 if not given with solver = incompressible_thesis; 0 is none; absent or 0 with dissipation = riemann, and with solver = incompressible, whose viscosity is projection.calming"),
    key("fluid.kinematic_viscosity", "m^2/s", "0.0", "kinematic viscosity (INDAT i_viscos 2 | 3: viscos_val; 3 with fluid.turbulence); 0 is none"),
    key("fluid.density_diffusion", "-", "0.3", "coefficient delta of density diffusion; 0 is none; absent or 0 with dissipation = riemann, and with an incompressible solver"),
    key("fluid.shifting", "", "true", "particle shifting: true | false"),
    key("fluid.settling", "-", "0.1", "share of h^2 grad C that particles are shifted by in each step, whatever their speed, away from the surface (THEORY E13), 0 to 0.3; without effect where fluid.shifting is false or the solver is a projection"),
    key("fluid.volume_correction", "", "false", "dropped; false is accepted: true | false"),
    key("fluid.wall_slip", "", "free", "free: the water slides along walls | none: it sticks to them"),
    key("fluid.wall_stretch", "", "false", "true: behind walls the water is stretched along them like that in front; sound along walls is nearer its speed and particles keep their volume better; noisier at coarse spacing"),
    key("fluid.ventilation", "", "false", "true: water within the kernel of both a wall and the air holds no tension, so that air comes in between and flow leaves a round bottom; it cuts noise to one side, which costs accuracy at coarse spacing | false: flow is sucked along"),
    key("fluid.integrator", "", "symplectic", "symplectic | predictor_corrector | verlet | beeman (INDAT i_algorithm -, 1 | 2 | 3; 4, incompressible, is not here)"),
    key("fluid.cfl", "-", "0.6", "step limit dt <= cfl h/(c0 + |v|) (INDAT CFL_number), dt <= cfl h/|v| and at most 1 with an incompressible solver; by default 0.4 for solver = incompressible, 0.3 for predictor_corrector and beeman, 0.05 for verlet, 0.4 with wall_stretch"),
    key("fluid.verlet_correction_every", "-", "40", "verlet: steps between two Euler steps, which keep its two time levels together; 0 is never"),
    key("fluid.density_filter", "", "none", "none | shepard (keeps a constant density) | mls (keeps a linear one) (INDAT i_densityFilter 0 | 1 | 2)"),
    key("fluid.density_filter_every", "-", "20", "steps between two filterings"),
    key("fluid.xsph", "-", "0.0", "share of the neighbours' mean velocity that particles move with (INDAT eps, there 0.5); 0 is none"),
    key("fluid.turbulence", "", "none", "none | sps: Smagorinsky's eddies below the spacing (INDAT i_viscos 2 | 3); needs fluid.kinematic_viscosity"),
    key("fluid.equation_of_state", "", "tait", "tait | ideal_gas, with the energy equation; then the pressure is that over the gas at rest (INDAT i_EoS 1 | 2)"),
    key("fluid.temperature", "K", "288.15", "ideal_gas: temperature at rest (INDAT TE0: its thermal energy)"),
    key("fluid.molar_mass", "kg/mol", "0.0289644", "ideal_gas: molar mass; the default is dry air's"),
    key("fluid.density_evolution", "", "continuity", "continuity | summation: densities counted from masses, which fails at a free surface"),
    key("fluid.density_diffusion_form", "", "fourtakas", "fourtakas: the hydrostatic pressure does not diffuse | molteni: it does; of riemann, the difference of pressures it sees"),
    key("fluid.walls", "", "extrapolated", "extrapolated | repulsive (Monaghan, INDAT iBC 1) | dynamic (Dalrymple, INDAT iBC 2) | mirror_point: how walls keep the water out"),
    key("fluid.limit_pressure", "-", "1", "dynamic walls at the start: 0: density rho0, no pressure | 1: the pressure of the water beside them (INDAT i_correct_pb 0 | 1)"),
    key("fluid.dissipation", "", "diffusion", "diffusion: density diffusion and artificial viscosity | riemann: the limited Riemann problem of each pair, in place of both (Zhang, Hu & Adams 2017), with no coefficient; the thesis has no such switch"),
    key("tank.width", "m", "auto", "full inner width, x from -width/2 to width/2; auto: outside acoustic reach of an impact (INDAT vlx)"),
    key("tank.depth", "m", "auto", "depth of still water, whose surface is y = 0 and whose floor is y = -depth; auto: outside acoustic reach of an impact (INDAT h_SWL, ZZMAX)"),
    key("tank.height", "m", "1.25 depth, 3 depth for a dam break", "height of the side walls above the floor (INDAT vlz)"),
    key("tank.water_width", "m", "width", "width of the water at rest from the left wall; less than width for a dam break"),
    key("tank.surface_amplitude", "m", "0.0", "amplitude of the wave that the water starts with, at rest and with the pressure of its depth: a cosine between the walls, its crest (where positive) at the left wall; no more than half the depth"),
    key("tank.surface_mode", "-", "1", "half waves of surface_amplitude between the walls"),
    key("tank.surface_tilt_deg", "deg", "0.0", "tilt of the surface that the water starts with, upwards to the right (the thesis's tank out of equilibrium; its INDAT has no switch, IPART places the particles)"),
    key("tank.block_from", "m", "absent", "[x, y] of the lower left corner of a block of water in the air, at or above the surface"),
    key("tank.block_to", "m", "required with block_from", "[x, y] of its upper right corner"),
    key("tank.block_velocity", "m/s", "[0.0, 0.0]", "velocity [x, y] of that block at t = 0"),
    key("body.name", "", "body", "a word that starts its columns in the series"),
    key("body.shape", "", "required", "wedge | arc | box | polygon | polyline (a bent plate)"),
    key("body.deadrise_deg", "deg", "required by wedge", "angle between the bottom and the still water, 4 to 80"),
    key("body.breadth", "m", "required by wedge, arc, box", "distance from chine to chine, chord of the arc, width of the box"),
    key("body.side_height", "m", "breadth/4", "wedge, arc: height of the vertical sides above the chines"),
    key("body.radius", "m", "required by arc", "radius of the bottom"),
    key("body.height", "m", "required by box", "height of the box"),
    key("body.points", "m", "required by polygon, polyline", "vertices [[x, y], ...] in the body's frame: a polygon's counter-clockwise, a plate's middle line"),
    key("body.thickness", "m", "required by polyline", "thickness of the plate, half of it on each side of the line: of any size, also below the spacing (THEORY T2); a fixed plate may stand on the tank's floor or walls"),
    key("body.mass", "kg/m", "required if free", "mass of the whole body, also with symmetry; without its panels, which add theirs"),
    key("body.inertia", "kg m^2/m", "required if free to rotate", "moment of inertia of the whole body about its centre of mass; without its panels"),
    key("body.center_of_mass", "m", "centroid of the outline", "[x, y] in the body's frame, without its panels; the frame's origin is a wedge's keel, an arc's lowest point, a box's centre"),
    key("body.motion", "", "free", "free | constant_velocity | fixed | oscillating (wave generator, thesis chapter 4)"),
    key("body.free", "", "all; [\"y\"] with symmetry", "directions a free body can move in: any of \"x\", \"y\", \"angle\""),
    key("body.velocity", "m/s", "[0.0, 0.0]", "velocity [x, y] of body.center_of_mass at t = 0"),
    key("body.angular_velocity_deg_per_s", "deg/s", "0.0", "angular velocity at t = 0, counter-clockwise"),
    key("body.position", "m", "touching", "[x, y] of the body frame's origin at t = 0; touching: x = 0 and the lowest point on the still water"),
    key("body.angle_deg", "deg", "0.0", "rotation of the body's frame about its origin at t = 0, counter-clockwise"),
    key("body.amplitude", "m", "required if oscillating", "[x, y] of the prescribed motion A sin(2 pi t/T), eased in over its first period"),
    key("body.period", "s", "required if oscillating", "period T of the prescribed motion"),
    key("body.damping", "[1/s, s]", "[0.0, 0.0]", "Rayleigh damping of the panels, by mass and by stiffness"),
    key("body.panels[].name", "", "panel1, ...", "a word that starts its columns in the series: a part of the body's surface that bends"),
    key("body.panels[].from", "m", "required", "[x, y] in the body's frame where it starts, on the outline (a polyline's middle line)"),
    key("body.panels[].to", "m", "required", "[x, y] where it ends; along an outline counter-clockwise, along a polyline in the order of its points"),
    key("body.panels[].elements", "", "24, none shorter than 2 spacings, at least 8", "number of beam elements; light, soft panels may break down where they are much shorter than 1.5 spacings"),
    key("body.panels[].thickness", "m", "required", "thickness of the plate; along an outline its outside is wet"),
    key("body.panels[].youngs_modulus", "Pa", "required", "Young's modulus; the plate bends with E/(1 - nu^2)"),
    key("body.panels[].poissons_ratio", "-", "0.3", "Poisson's ratio"),
    key("body.panels[].density", "kg/m^3", "required", "density of the plate"),
    key("body.panels[].ends", "", "[\"clamped\", \"clamped\"]", "how the rest of the body holds its ends, each of clamped | pinned | sliding (pinned, but free along the panel) | free | mirror (joined to its image, at x = 0 with symmetry = x)"),
    key("body.panels[].theory", "", "euler_bernoulli", "euler_bernoulli | timoshenko"),
    key("body.panels[].watch", "-", "[0.5]", "shares of its length whose motion, moment and strains are reported"),
    key("body.panels[].yield_stress", "Pa", "absent", "yield stress of the tension test: beyond it the plate bends for good (bilinear moment and curvature); absent: elastic"),
    key("body.panels[].hardening_modulus", "Pa", "0.0", "plastic modulus beyond the yield stress"),
    key("body.panels[].rupture_strain", "-", "absent", "strain of an outer fibre at a held end at which that end breaks off; the wetted surface stays closed; absent: never"),
    key("body.panels[].allowable_stress", "Pa", "yield_stress", "stress it may bear: the reserve factor is this over the largest"),
    key("gauges[].name", "", "required", "a word that starts its column in the series"),
    key("gauges[].on", "", "body", "body: fixed in the body's frame | fixed: fixed in the tank"),
    key("gauges[].at", "m", "required", "[x, y] in that frame"),
    key("gauges[].length", "m", "0.0", "length of its face, along the surface about its place and up to a corner: it shows the mean; 0 is a point, which the kernel spreads over its support 2h all the same"),
    key("gauges[].bandwidth", "Hz", "absent", "bandwidth of its low-pass (Butterworth, second order, -3 dB), which takes every step; absent: unfiltered"),
    key("compare[].reference", "", "required", "CSV file, below the folder of references"),
    key("compare[].quantity", "", "required", "column of the series, such as wedge.vy_m_per_s"),
    key("compare[].scale", "-", "1.0", "factor on our column"),
    key("compare[].x", "", "required", "the reference's column of times"),
    key("compare[].x_scale", "", "1.0", "factor that turns it into seconds"),
    key("compare[].y", "", "required", "the reference's column of values"),
    key("compare[].y_scale", "", "1.0", "factor that turns it into SI units"),
    key("compare[].window", "s", "[0.0, end]", "times compared [from, to], cut at the end of the run"),
    key("compare[].norm", "", "rms_over_peak", "rms | max, in the quantity's unit; rms_over_first | rms_over_peak | peak (heights of the peaks) | arrival (times of arrival) | impulse (integrals over time) | period (mean distances of zeros), relative"),
    key("compare[].tolerance", "", "absent", "largest error that passes, in the norm's unit; absent: drawn, not judged"),
    key("compare[].threshold", "-", "0.5", "norm arrival: share of its own peak in the window at which a curve has arrived"),
    key("observe.front", "", "false", "column front_m: length of the connected water along the floor, from its left end: true | false"),
    key("observe.level", "m", "[]", "places x of the columns level1_m, level2_m ...: height of the water there over still water, counted by volume, also what flies above; not below a body"),
    key("observe.volume", "-", "false", "the column volume_m2, and water in the summary: volume below the water's surface, found from above; for tanks without a body"),
    key("report.force_rules", "", "false", "compare the force on the body by four rules: true | false (INDAT fex 1 | 2 | 3: FEX_2D, FEX_2D2, FEX_2D3; FEX_2D4 has no number)"),
    key("report.log_budget", "MB", "absent", "size that log.mcap stays below: frames of particles are left out, evenly over the run, curves and notes are not; absent: every frame that is due (command line: --log-budget)"),
    key("coupling.scheme", "", "weak; added_mass with body.panels, and for free bodies with solver = incompressible", "weak: one exchange a step | added_mass: body's acceleration and wall pressures found together, without iterations; for light bodies | iqn_ils: the step is repeated until both agree (no INDAT switch: the thesis exchanges once a step)"),
    key("coupling.tolerance", "-", "1e-6", "iqn_ils: mismatch of the body's acceleration, relative, at which a step is done"),
    key("coupling.max_iterations", "-", "50", "iqn_ils: repetitions of a step after which one that still disagrees ends the run with an error"),
    key("projection.tolerance", "-", "3e-4", "solver incompressible: share of the largest right-hand side that no residual of the pressure equation exceeds, 1e-12 to 0.1 (no INDAT switch)"),
    key("projection.most_iterations", "", "2000", "solver incompressible: iterations after which a pressure equation has failed"),
    key("projection.relaxation", "-", "3.0", "time in which an error of density relaxes, over h/U with the fastest known speed U (THEORY I9)"),
    key("projection.calming", "-", "0.15", "viscosity over h sqrt(|g| h), which brings water to rest (THEORY I12); 0 is none"),
    key("projection.shift", "-", "1.0", "shift of particles over the distance moved in a step, times 2h grad C, 0 to 10 (THEORY I13); without effect where fluid.shifting is false"),
    key("thesis.masses", "", "interior", "solver incompressible_thesis (INDAT i_algorithm 4): interior: one mass, from a particle with a whole support, and what the others lack stored | inverse: all from W m = rho0, which gives negative masses (no INDAT switch)"),
    key("thesis.limit_rows", "", "poisson", "rows of limit particles: poisson | zero_gradient, which gives wrong pressures (no INDAT switch)"),
    key("thesis.predictor", "", "gravity", "what acts before the pressure equation: gravity | old_pressure: the last step's pressure too, which diverges (no INDAT switch)"),
    key("thesis.side_freedom", "", "true", "upright walls at rest take the predictor's motion: true | false, which gives density errors beside them"),
    key("thesis.gradient_correction", "", "true", "the pressure's gradient is scaled so that water at rest does not depend on h: true | false"),
    key("thesis.surface_ratio", "-", "0.75", "particles at the free surface have a divergence of r below this share of that inside, 0 to 1"),
    key("thesis.density_tolerance", "-", "1e-5", "the inner corrector loop ends where no density is farther from the reference than this share"),
    key("thesis.inner_passes", "", "10", "most passes of the inner corrector loop"),
    key("thesis.residual", "-", "1e-6", "share of the largest right-hand side that the residual of no row of the pressure equation exceeds, 1e-12 to 0.1"),
    key("thesis.most_iterations", "", "2000", "iterations of Bi-CGSTAB after which a pressure equation ends the run with an error"),
];

#[cfg(test)]
mod tests {
    use super::super::file::SceneFile;
    use super::*;

    #[test]
    fn a_typing_error_finds_its_keyword() {
        assert_eq!(nearest(KEYWORDS, "resolution.spaceing"), Some("resolution.spacing"));
        assert_eq!(nearest(KEYWORDS, "gauges[0].nane"), Some("gauges[].name"));
        assert_eq!(nearest(KEYWORDS, "spacing"), Some("resolution.spacing"));
        assert_eq!(nearest(KEYWORDS, "body.colour"), None);
    }

    #[test]
    fn an_item_of_a_list_belongs_to_the_key_of_the_list() {
        assert_eq!(find(KEYWORDS, "body.points[3][1]").map(|k| k.path), Some("body.points"));
        assert_eq!(find(KEYWORDS, "gauges[12].at[0]").map(|k| k.path), Some("gauges[].at"));
        assert_eq!(find(KEYWORDS, "body"), None);
    }

    /// The fields that serde knows in a table, from its answer to an unknown one.
    fn serde_fields(table: &str) -> Vec<String> {
        let text = format!("{}\nno_such_key = 1\n", if table.is_empty() { String::new() } else { table_header(table) });
        let error = toml::from_str::<SceneFile>(&text).expect_err("the key does not exist");
        let (_, fields) = error.message().split_once(", expected ").expect("serde lists the fields");
        fields.split('`').skip(1).step_by(2).map(String::from).collect()
    }

    fn table_header(table: &str) -> String {
        match table.strip_suffix("[]") {
            Some(array) => format!("[[{array}]]"),
            None => format!("[{table}]"),
        }
    }

    #[test]
    fn keywords_and_serde_fields_are_the_same() {
        let tables = [
            "time",
            "resolution",
            "fluid",
            "tank",
            "body",
            "body.panels[]",
            "gauges[]",
            "compare[]",
            "observe",
            "report",
            "coupling",
            "projection",
            "thesis",
        ];
        let top = serde_fields("");
        let mut fields: Vec<String> =
            top.iter().filter(|f| !tables.iter().any(|t| t.trim_end_matches("[]") == *f)).cloned().collect();
        let nested = tables.iter().filter(|t| t.contains('.')).count();
        assert_eq!(fields.len() + tables.len() - nested, top.len());
        for table in tables {
            let is_table = |field: &String| tables.contains(&format!("{table}.{field}[]").as_str());
            fields.extend(serde_fields(table).iter().filter(|f| !is_table(f)).map(|field| format!("{table}.{field}")));
        }
        let declared: Vec<&str> = KEYWORDS.iter().map(|keyword| keyword.path).collect();
        assert_eq!(declared, fields);
    }

    #[test]
    fn edit_distance_counts_edits() {
        assert_eq!(edit_distance("kitten", "sitting"), 3);
        assert_eq!(edit_distance("", "abc"), 3);
    }
}
