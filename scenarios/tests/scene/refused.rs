//! What is refused, and how: place, key, what was given, what was expected.

use miette::Diagnostic;
use run::{load, load_text};
use scene::{BYTES_PER_PARTICLE, builtin, particle_estimate, schema};

use super::{DROP, TANK, changed, drop_with};

#[test]
fn a_mistake_is_reported_with_line_key_given_and_expected() {
    // (text, what it becomes, line, fragments of the message)
    #[rustfmt::skip]
    let table: &[(&str, &str, usize, &[&str])] = &[
        ("breadth = 0.5", "breadht = 0.5", 10, &["unknown key `body.breadht`", "`body.breadth`"]),
        ("[time]", "[timee]", 3, &["unknown key `timee`", "expected"]),
        ("spacing = 0.005", "spacing = \"fine\"", 6, &["`resolution.spacing`", "\"fine\"", "expected a finite number"]),
        ("shape = \"wedge\"", "shape = \"cone\"", 8, &["`body.shape`", "cone", "expected one of", "`polyline`"]),
        ("velocity = [0.0, -5.0]", "velocity = [-5.0]", 14, &["`body.velocity`", "length 1", "an array of length 2"]),
        ("velocity = [0.0, -5.0]", "velocity = [0.0, \"a\"]", 14, &["`body.velocity[1]`", "\"a\"", "expected a number"]),
        ("end = 0.02", "end = nan", 4, &["`time.end` = NaN", "a finite number"]),
        ("gravity = [0.0, -9.81]", "gravity = [0.0, -inf]", 2, &["`gravity[1]` = -inf", "a finite number"]),
        ("end = 0.02", "end = -0.02", 4, &["`time.end` = -0.02", "above 0"]),
        ("end = 0.02", "end = 0.02\nstart = 0.01", 5, &["`time.start` = 0.01", "at most 0 s"]),
        ("[time]", "solver = \"incompressible\"\n[time]\nstart = -0.01", 5, &["`time.start` = -0.01", "with this solver"]),
        ("end = 0.02", "", 3, &["`time.end` is missing", "[s]"]),
        ("end = 0.02", "end = 0.02\nsample_every = 0.5", 5, &["`time.sample_every` = 0.5", "up to time.end = 0.02"]),
        ("end = 0.02", "end = 0.02\nsample_every = 0", 5, &["`time.sample_every` = 0", "above 0"]),
        ("spacing = 0.005", "spacing = 0", 6, &["`resolution.spacing` = 0", "above 0"]),
        ("spacing = 0.005", "spacing = 0.1", 6, &["`resolution.spacing` = 0.1", "0.244", "thinner than its walls"]),
        ("spacing = 0.005", "spacing = 0.005\ngrowth = 0.9", 7, &["`resolution.growth` = 0.9", "from 1 to 2"]),
        ("[time]", "[fluid]\ndensity = -1000\n[time]", 4, &["`fluid.density` = -1000", "above 0"]),
        ("[time]", "[fluid]\nsound_speed = \"fast\"\n[time]", 4, &["`fluid.sound_speed`", "fast", "a finite number above 0 or \"auto\""]),
        ("[time]", "[fluid]\nsound_speed = 5\n[tank]\ndepth = 3\n[time]", 4, &["`fluid.sound_speed` = 5", "at least 17.16 m/s", "the weight of 3 m of water"]),
        ("[time]", "[tank]\ndepth = -1\n[time]", 4, &["`tank.depth` = -1", "above 0"]),
        ("[time]", "[tank]\nwidth = 0.01\n[time]", 4, &["`tank.width` = 0.01", "at least 4 spacings", "0.02 m"]),
        ("[time]", "[tank]\nheight = 0.1\ndepth = 2\n[time]", 4, &["`tank.height` = 0.1", "at least tank.depth = 2"]),
        ("[time]", "[tank]\nwidth = 2\nwater_width = 3\n[time]", 5, &["`tank.water_width` = 3", "tank.width = 2"]),
        ("deadrise_deg = 30.0", "deadrise_deg = 2.0", 9, &["`body.deadrise_deg` = 2", "from 4 to 80"]),
        ("deadrise_deg = 30.0", "", 7, &["`body.deadrise_deg` is missing", "[deg]"]),
        ("breadth = 0.5", "breadth = -0.5", 10, &["`body.breadth` = -0.5", "above 0"]),
        ("breadth = 0.5", "breadth = 0.5\nradius = 1", 11, &["`body.radius`", "none with shape = \"wedge\"", "belongs to shape = \"arc\""]),
        ("mass = 100.0", "mass = 0.0", 12, &["`body.mass` = 0", "above 0"]),
        ("mass = 100.0", "", 7, &["`body.mass` is missing", "[kg/m]"]),
        ("free = [\"y\"]", "free = [\"y\", \"angle\"]", 7, &["`body.inertia` is missing", "free to rotate"]),
        ("free = [\"y\"]", "free = [\"z\"]", 13, &["`body.free[0]`", "`z`", "`angle`"]),
        ("free = [\"y\"]", "free = []", 13, &["`body.free` = []", "expected some of"]),
        ("velocity = [0.0, -5.0]", "velocity = [1.0, -5.0]", 14, &["`body.velocity` = [1.0, -5.0]", "expected 0"]),
        ("free = [\"y\"]", "free = [\"y\"]\nposition = [0.0, -5.0]", 1, &["`tank.depth` is missing", "needs a body that falls or moves down into"]),
        ("name = \"drop\"", "name = \"a drop\"", 1, &["`name` = \"a drop\"", "a word of letters"]),
        ("name = \"drop\"", "symmetry = \"y\"", 1, &["`symmetry`", "`y`", "`x`"]),
        ("at = [0.1, 0.0577]", "at = [0.1, 0.2]", 17, &["`gauges[0].at` = [0.1, 0.2]", "the nearest", "0.04434 m away"]),
        ("at = [0.1, 0.0577]", "at = [0.1, -50.0]\non = \"fixed\"", 17, &["`gauges[0].at`", "a point in the tank"]),
        ("at = [0.1, 0.0577]", "at = [0.1, 0.0577]\nlength = -0.1", 18, &["`gauges[0].length` = -0.1", "at least 0"]),
        ("at = [0.1, 0.0577]", "at = [0.1, 0.0577]\nbandwidth = 0", 18, &["`gauges[0].bandwidth` = 0", "above 0"]),
        ("at = [0.1, 0.0577]", "at = [0.1, -0.2]\non = \"fixed\"\nlength = 0.1", 19, &["`gauges[0].length` = 0.1", "expected 0 for a gauge in the water"]),
        ("name = \"face\"", "name = \"body\"", 16, &["`gauges[0].name` = \"body\"", "no other gauge or body"]),
        ("name = \"face\"", "", 15, &["`gauges[0].name` is missing", "A word"]),
        ("quantity = \"body.vy_m_per_s\"", "quantity = \"vy\"", 20, &["`compare[0].quantity` = \"vy\"", "body.vy_m_per_s", "face.p_Pa"]),
        ("x = \"t_ms\"", "x = \"t\"", 21, &["`compare[0].x` = \"t\"", "no column `t`", "t_ms"]),
        ("x = \"t_ms\"", "x = \"t_ms\"\nwindow = [2.0, 1.0]", 22, &["`compare[0].window` = [2.0, 1.0]", "from < to"]),
        ("x = \"t_ms\"", "x = \"t_ms\"\nx_scale = 0", 22, &["`compare[0].x_scale` = 0", "other than 0"]),
        ("x = \"t_ms\"", "x = \"t_ms\"\nnorm = \"l2\"", 22, &["`compare[0].norm`", "`l2`", "`rms_over_peak`"]),
        ("[time]", "similarity = \"wedge\"\n[time]", 3, &["`similarity`", "may change its speed", "constant_velocity"]),
        ("[time]", "solver = \"incompressible_thesis\"\n[thesis]\nresidual = 2\n[time]", 5, &["`thesis.residual` = 2", "from 0.000000000001 to 0.1"]),
        ("[time]", "solver = \"incompressible_thesis\"\n[thesis]\ninner_passes = 0\n[time]", 5, &["`thesis.inner_passes` = 0", "at least 1"]),
        ("[time]", "solver = \"incompressible_thesis\"\n[thesis]\nmasses = \"mine\"\n[time]", 5, &["`thesis.masses`", "mine", "`inverse`"]),
        ("[time]", "solver = \"incompressible\"\n[thesis]\ninner_passes = 1\n[time]", 5, &["`thesis.inner_passes` = 1", "belongs to solver = \"incompressible_thesis\""]),
        ("[time]", "solver = \"incompressible\"\n[projection]\ntolerance = 2\n[time]", 5, &["`projection.tolerance` = 2", "from 0.000000000001 to 0.1"]),
        ("[time]", "solver = \"incompressible\"\n[projection]\nmost_iterations = 0\n[time]", 5, &["`projection.most_iterations` = 0", "at least 1"]),
        ("[time]", "solver = \"incompressible\"\n[projection]\nmost_iterations = 1.5\n[time]", 5, &["`projection.most_iterations`", "1.5"]),
        ("[time]", "solver = \"incompressible\"\n[projection]\nrelaxation = 0\n[time]", 5, &["`projection.relaxation` = 0", "above 0"]),
        ("[time]", "solver = \"incompressible\"\n[projection]\ncalming = -0.1\n[time]", 5, &["`projection.calming` = -0.1", "at least 0"]),
        ("[time]", "solver = \"incompressible\"\n[projection]\nshift = 11\n[time]", 5, &["`projection.shift` = 11", "from 0 to 10"]),
        ("[time]", "solver = \"incompressible\"\n[projection]\nshfit = 1\n[time]", 5, &["unknown key `projection.shfit`", "`projection.shift`"]),
        ("[time]", "[projection]\nrelaxation = 10\n[time]", 4, &["`projection.relaxation` = 10", "none, or 3.0, with solver = \"weakly_compressible\"", "\"incompressible_explicit\""]),
        ("[time]", "solver = \"incompressible_thesis\"\n[projection]\nmost_iterations = 7\n[time]", 5, &["`projection.most_iterations` = 7", "none, or 2000, with solver = \"incompressible_thesis\""]),
        ("[time]", "solver = \"incompressible\"\n[fluid]\ncfl = 1.1\n[time]", 5, &["`fluid.cfl` = 1.1", "up to 1 with solver = \"incompressible\""]),
        ("[time]", "solver = \"incompressible\"\n[fluid]\nartificial_viscosity = 0.02\n[time]", 5, &["`fluid.artificial_viscosity` = 0.02", "none, or 0, with solver = \"incompressible\""]),
        ("[time]", "solver = \"incompressible\"\n[fluid]\nintegrator = \"verlet\"\n[time]", 5, &["`fluid.integrator` = \"verlet\"", "none, or \"symplectic\", with solver = \"incompressible\"", "belongs to solver = \"weakly_compressible\""]),
        ("[time]", "solver = \"incompressible\"\n[fluid]\nwalls = \"dynamic\"\n[time]", 5, &["`fluid.walls` = \"dynamic\"", "none, or \"extrapolated\", with solver = \"incompressible\"", "belongs to solver = \"weakly_compressible\""]),
        ("[time]", "solver = \"incompressible_explicit\"\n[fluid]\nequation_of_state = \"ideal_gas\"\n[time]", 5, &["`fluid.equation_of_state` = \"ideal_gas\"", "none, or \"tait\", with solver = \"incompressible_explicit\"", "belongs to solver = \"weakly_compressible\""]),
        ("[time]", "solver = \"incompressible\"\n[fluid]\ndensity_diffusion = 0.1\n[time]", 5, &["`fluid.density_diffusion` = 0.1", "none, or 0, with solver = \"incompressible\"", "belongs to solver = \"weakly_compressible\""]),
        ("[time]", "solver = \"incompressible_thesis\"\n[fluid]\ndensity_diffusion = 0.1\n[time]", 5, &["`fluid.density_diffusion` = 0.1", "none, or 0, with solver = \"incompressible_thesis\"", "belongs to solver = \"weakly_compressible\""]),
        ("[time]", "solver = \"incompressible\"\n[fluid]\ndensity_diffusion_form = \"molteni\"\n[time]", 5, &["`fluid.density_diffusion_form` = \"molteni\"", "none, or \"fourtakas\", with solver = \"incompressible\"", "belongs to solver = \"weakly_compressible\""]),
        ("[time]", "solver = \"incompressible_explicit\"\n[fluid]\ndensity_evolution = \"summation\"\n[time]", 5, &["`fluid.density_evolution` = \"summation\"", "none, or \"continuity\", with solver = \"incompressible_explicit\"", "belongs to solver = \"weakly_compressible\""]),
        ("[time]", "solver = \"incompressible\"\n[fluid]\ndensity_filter = \"mls\"\n[time]", 5, &["`fluid.density_filter` = \"mls\"", "none, or \"none\", with solver = \"incompressible\"", "belongs to solver = \"weakly_compressible\""]),
        ("[time]", "solver = \"incompressible\"\n[fluid]\nvolume_correction = true\n[time]", 5, &["`fluid.volume_correction` = true", "expected false", "was dropped"]),
        ("[time]", "solver = \"incompressible\"\n[fluid]\nxsph = 0.5\n[time]", 5, &["`fluid.xsph` = 0.5", "none, or 0.0, with solver = \"incompressible\"", "belongs to solver = \"weakly_compressible\""]),
        ("[time]", "solver = \"incompressible\"\n[fluid]\nturbulence = \"sps\"\n[time]", 5, &["`fluid.turbulence` = \"sps\"", "none, or \"none\", with solver = \"incompressible\"", "belongs to solver = \"weakly_compressible\""]),
        ("[time]", "solver = \"incompressible_explicit\"\n[fluid]\ndissipation = \"riemann\"\n[time]", 5, &["`fluid.dissipation` = \"riemann\"", "none, or \"diffusion\", with solver = \"incompressible_explicit\"", "belongs to solver = \"weakly_compressible\""]),
        ("end = 0.02", "end = 0.02\nstep = 0.5", 5, &["`time.step` = 0.5", "up to time.end = 0.02"]),
        ("end = 0.02", "end = 0.02\nstep = 0", 5, &["`time.step` = 0", "above 0"]),
        ("[time]", "[fluid]\nintegrator = \"euler\"\n[time]", 4, &["`fluid.integrator`", "`euler`", "`verlet`", "`beeman`"]),
        ("[time]", "[fluid]\nverlet_correction_every = -1\n[time]", 4, &["`fluid.verlet_correction_every`", "-1", "a whole number from 0"]),
        ("[time]", "[fluid]\ndensity_filter = \"median\"\n[time]", 4, &["`fluid.density_filter`", "`median`", "`mls`"]),
        ("[time]", "[fluid]\ndensity_filter_every = 0\n[time]", 4, &["`fluid.density_filter_every` = 0", "at least 1"]),
        ("[time]", "[fluid]\nxsph = 2\n[time]", 4, &["`fluid.xsph` = 2", "from 0 to 1"]),
        ("[time]", "[fluid]\nturbulence = \"sps\"\n[time]", 4, &["`fluid.turbulence` = \"sps\"", "fluid.kinematic_viscosity above 0"]),
        ("[time]", "[fluid]\nequation_of_state = \"ideal_gas\"\nsound_speed = 50\n[time]", 5, &["`fluid.sound_speed` = 50", "340.3 m/s", "fluid.temperature"]),
        ("[time]", "[fluid]\nequation_of_state = \"ideal_gas\"\neos_exponent = 1\n[time]", 5, &["`fluid.eos_exponent` = 1", "above 1"]),
        ("[time]", "[fluid]\ntemperature = -3\n[time]", 4, &["`fluid.temperature` = -3", "above 0"]),
        ("[time]", "[fluid]\nmolar_mass = 0\n[time]", 4, &["`fluid.molar_mass` = 0", "above 0"]),
        ("[time]", "[fluid]\ndensity_evolution = \"guess\"\n[time]", 4, &["`fluid.density_evolution`", "`guess`", "`summation`"]),
        ("[time]", "[fluid]\ndensity_diffusion_form = \"antuono\"\n[time]", 4, &["`fluid.density_diffusion_form`", "`antuono`", "`molteni`"]),
        ("[time]", "[fluid]\ndissipation = \"roe\"\n[time]", 4, &["`fluid.dissipation`", "`roe`", "`diffusion`", "`riemann`"]),
        ("[time]", "[fluid]\ndissipation = \"riemann\"\ndensity_diffusion = 0.1\n[time]", 5, &["`fluid.density_diffusion` = 0.1", "expected none, or 0, with fluid.dissipation = \"riemann\""]),
        ("[time]", "[fluid]\nartificial_viscosity = 0.02\ndissipation = \"riemann\"\n[time]", 4, &["`fluid.artificial_viscosity` = 0.02", "expected none, or 0, with fluid.dissipation = \"riemann\""]),
        ("x = \"t_ms\"", "x = \"t_ms\"\nthreshold = 2", 22, &["`compare[0].threshold` = 2", "from 0.01 to 0.99"]),
        ("mass = 100.0", "mass = 100.0\nperiod = 1.0", 13, &["`body.period`", "belongs to motion = \"oscillating\""]),
        ("mass = 100.0", "motion = \"oscillating\"", 7, &["`body.amplitude` is missing", "[m]"]),
        ("mass = 100.0", "motion = \"oscillating\"\namplitude = [0, 0.1]\nperiod = 0", 14, &["`body.period` = 0", "above 0"]),
        ("mass = 100.0", "motion = \"tabulated\"\ndisplacements = [[0, 0, 0, 0], [0, 0, 1, 0]]", 13, &["`body.displacements`", "rows in order of time"]),
        ("mass = 100.0", "motion = \"tabulated\"\ndisplacements = [[0, 0, 0, 0], [1e-300, 0, 1, 0]]", 13, &["`body.displacements`", "speeds up to"]),
        ("[time]", "solver = \"incompressible\"\n[fluid]\ncavitation_pressure = -99000\n[time]", 5, &["`fluid.cavitation_pressure`", "weakly_compressible"]),
        ("[time]", "[observe]\nfront = 1\n[time]", 4, &["`observe.front`"]),
        ("end = 0.02", "end = ", 4, &["not valid TOML"]),
        ("end = 0.02", "end = 0.02\nend = 0.03", 5, &["not valid TOML", "duplicate key"]),
    ];
    for (from, to, line, fragments) in table {
        assert!(DROP.contains(from), "{from}");
        let error = match load_text("drop.toml", &DROP.replacen(from, to, 1), &[]) {
            Err(error) => error,
            Ok(_) => panic!("{to:?} must be refused"),
        };
        let message = error.to_string();
        assert!(message.starts_with(&format!("drop.toml:{line}: ")), "{to:?}: {message}");
        for fragment in *fragments {
            assert!(message.contains(fragment), "{to:?}: {fragment:?} is not in: {message}");
        }
    }
}

#[test]
fn bodies_and_tanks_must_fit_together() {
    let polygon = |points: &str| format!("body={{ shape = \"polygon\", motion = \"fixed\", points = {points} }}");
    let box_at = |x: f64, y: f64| {
        format!("body={{ shape = \"box\", breadth = 0.4, height = 0.2, motion = \"fixed\", position = [{x}, {y}] }}")
    };
    let plate = |x: f64, y: f64| {
        let shape = "shape = \"polyline\", points = [[0, 0], [0, 0.3]], thickness = 0.002";
        format!("body={{ {shape}, motion = \"fixed\", position = [{x}, {y}] }}")
    };
    let bent = "body={ shape = \"polyline\", points = [[0, 0.1], [0, 0], [0.02, 0], [0.02, 0.1]], thickness = 0.002, \
                motion = \"fixed\", position = [0, 0] }";
    #[rustfmt::skip]
    let table: &[(&[&str], &[&str])] = &[
        (&[&plate(0.0, -0.55), "resolution.spacing=0.02"], &["`body.position`", "a plate that reaches from", "ends at the floor, y = -0.5 m"]),
        (&[&plate(0.0, -0.5), "resolution.spacing=0.02", "fluid.walls=dynamic"], &["`fluid.walls` = \"dynamic\"", "extrapolated or mirror_point", "0.002 m thin"]),
        (&[bent, "resolution.spacing=0.02"], &["`body.points` = [0.0, 0.0] to [0.02, 0.0]", "longer sides or gentler bends", "0.06 m"]),
        (&[&box_at(0.45, 0.0)], &["`body.position`", "from x = 0.25 to 0.65 m, overlapping a tank wall", "-0.5 and 0.5"]),
        (&[&box_at(2.0, 0.0)], &["`body.position`", "off the tank", "-0.5 and 0.5"]),
        (&[&box_at(0.0, -0.45)], &["`body.position`", "down to y = -0.55 m, overlapping the floor", "y = -0.5"]),
        (&[&box_at(0.1, 0.0), "symmetry=x"], &["`body.position` = [0.1, 0]", "symmetry"]),
        (&[&box_at(0.0, 0.0), "body.angle_deg=5", "symmetry=x"], &["`body.angle_deg` = 5", "expected 0"]),
        (&[&box_at(0.0, 0.0), "body.velocity=[0, -1]"], &["`body.velocity`", "expected 0"]),
        (&[&polygon("[[0, 0], [0, 0.2], [0.2, 0]]")], &["`body.points`", "-0.02", "counter-clockwise"]),
        (&[&polygon("[[0, 0], [0.3, 0.3], [0.3, 0], [0, 0.3]]")], &["`body.points`", "edges 0 and 2 meet"]),
        (&[&polygon("[[0, 0], [0.3, 0]]")], &["`body.points` = 2 points", "at least 3"]),
        (&[&polygon("[[0, 0], [0.3, 0], [0.3, 0], [0, 0.3]]")], &["`body.points`", "twice in a row"]),
        (&[&polygon("[[-0.2, 0], [0.3, 0], [0, 0.3]]"), "symmetry=x"], &["`body.points`", "lopsided", "symmetric about x = 0"]),
        (&["tank.depth=auto"], &["`tank.depth` is missing", "needs a body that falls or moves down"]),
        (&["tank.water_width=0.5", "symmetry=x"], &["`tank.water_width` = 0.5", "symmetry"]),
        (&["gravity=[0, 0]"], &["`fluid.sound_speed` is missing", "needs gravity or a moving body"]),
        (&["gauges=[{ name = \"g\", at = [0, 0] }]"], &["`gauges[0].on` = \"body\"", "\"fixed\" in a scene without a body"]),
        (&["similarity=wedge"], &["`similarity` = \"wedge\" without a body", "expected a wedge"]),
    ];
    for (changes, fragments) in table {
        let message = match changed(TANK, changes) {
            Err(error) => error.to_string(),
            Ok(_) => panic!("{changes:?} must be refused"),
        };
        for fragment in *fragments {
            assert!(message.contains(fragment), "{changes:?}: {fragment:?} is not in: {message}");
        }
    }
}

/// A film of water of one layer of particles gives a warning, and no other one.
#[test]
fn a_film_too_thin_for_the_projection_is_reported() {
    let said = |scene: &str, gap: &str| {
        let loaded = run::load(scene, &[format!("contact.gap={gap}")]).expect("a sound scene");
        loaded.warnings.iter().any(|warning| warning.starts_with("contact.gap"))
    };
    assert!(said("two_boxes", "1.9") && !said("two_boxes", "2") && !said("flap", "1"));
}

/// With panels Verlet's leapfrog broke at 0.5 ms beside "added_mass" and at 2 ms beside "iqn_ils"; beside "weak" it ran.
#[test]
fn verlets_leapfrog_with_panels_has_the_scheme_it_runs_with() {
    let with = |more: &[&str]| {
        let sets: Vec<String> = ["fluid.integrator=verlet"].iter().chain(more).map(|set| set.to_string()).collect();
        run::load("elastic_gate", &sets)
    };
    assert_eq!(with(&[]).expect("a sound scene").scene.coupling.scheme.name(), "weak");
    for scheme in ["coupling.scheme=added_mass", "coupling.scheme=iqn_ils"] {
        let error = with(&[scheme]).expect_err(scheme).to_string();
        assert!(error.contains("`coupling.scheme`") && error.contains("verlet"), "{error}");
    }
}

#[test]
fn bodies_and_joints_that_make_no_sense_are_refused() {
    let body = |name: &str, x: f64, more: &str| {
        format!(
            "bodies=[{{ name = \"{name}\", shape = \"box\", breadth = 0.3, height = 0.2, mass = 3, position = [{x}, 0]{more} }}]"
        )
    };
    let joint = |more: &str| format!("joints=[{{ name = \"h\", at = [0, 0.1], {more} }}]");
    #[rustfmt::skip]
    let table: &[(&str, &str, &[&str])] = &[
        ("two_boxes", &body("left", 0.1, ", inertia = 1"), &["`bodies[0].name` = \"left\"", "no other thing or body has"]),
        ("two_boxes", &body("r", 0.1, ""), &["`bodies[0].inertia` is missing", "free to rotate"]),
        ("two_boxes", &body("r", -0.1, ", inertia = 1"), &["`bodies[0].position`", "\"r\" overlaps \"left\""]),
        ("two_boxes", &body("r", 9.1, ", inertia = 1"), &["`bodies[0].position`", "off the tank"]),
        ("two_boxes", &body("r", 0.1, ", inertia = 1, free = []"), &["`bodies[0].free` = []", "motion = \"fixed\""]),
        ("two_boxes", &body("r", 0.1, ", inertia = 1, outline = \"a.csv\""), &["`bodies[0].outline`", "only the first body"]),
        ("flap", &joint("kind = \"hinge\", bodies = [\"hull\", \"flop\"]"), &["`joints[0].bodies[1]` = \"flop\"", "one of hull, flap, tank"]),
        ("flap", &joint("kind = \"hinge\", bodies = [\"hull\", \"hull\"]"), &["`joints[0].bodies`", "two different bodies"]),
        ("flap", "body={ name = \"hull\", shape = \"box\", breadth = 0.6, height = 0.24, position = [-0.3, 0.17], motion = \"tabulated\", displacements = [[0, 0, 0, 0], [1, 0, -1, 0]] }", &["`joints[0].bodies`", "the same velocity at the hinge"]),
        ("flap", "bodies[0].velocity=[0, -2.5]", &["`joints[0].bodies`", "[0.0, -2.5] m/s", "the same velocity at the hinge"]),
        ("flap", &joint("kind = \"slider\", bodies = [\"hull\", \"flap\"]"), &["`joints[0].axis`", "a direction"]),
        ("flap", &joint("kind = \"hinge\", axis = [1, 0], bodies = [\"hull\", \"flap\"]"), &["`joints[0].axis`", "only a slider"]),
        ("flap", &joint("kind = \"spring\", to = [0, 0.1], bodies = [\"hull\", \"flap\"]"), &["`joints[0].to`", "another point than at"]),
        ("flap", &joint("kind = \"spring\", to = [0, 0.2], bodies = [\"hull\", \"flap\"]"), &["`joints[0].stiffness` = 0", "does nothing"]),
        ("flap", "joints=[{ kind = \"hinge\", bodies = [\"hull\", \"flap\"], at = [0, 0.1] }]", &["`joints[0].name` is missing"]),
        ("two_boxes", "body.name=tank", &["`body.name` = \"tank\"", "joints mean the tank by it"]),
        ("wave_maker", "tank.wave_maker={ period = 2 }", &["`tank.wave_maker.height` is missing"]),
        ("wave_maker", "tank.beach={ rate = 3 }", &["`tank.beach.length` is missing"]),
        ("flap", "model=wagner", &["`model` = \"wagner\"", "several bodies, or joints", "\"wcsph\""]),
        ("box_on_floor", &joint("kind = \"hinge\", bodies = [\"tank\", \"box\"]").replace("[{", "[{ breaks_at = 0, "), &["`joints[0].breaks_at` = 0"]),
    ];
    for (scene, set, fragments) in table {
        let message = match run::load(scene, &[set.to_string()]) {
            Err(error) => error.to_string(),
            Ok(_) => panic!("{set:?} must be refused"),
        };
        for fragment in *fragments {
            assert!(message.contains(fragment), "{set:?}: {fragment:?} is not in: {message}");
        }
    }
}

#[test]
fn a_mistake_in_a_set_argument_names_the_argument_instead_of_a_line() {
    for (set, fragments) in [
        ("body.mass=-1", ["--set body.mass=-1: ", "`body.mass` = -1", "above 0"]),
        ("body.velocity[1]=up", ["--set body.velocity[1]=up: ", "`body.velocity[1]`", "\"up\""]),
        ("body.colour=red", ["--set body.colour=red: ", "unknown key `body.colour`", "expected"]),
        ("no.such.key=1", ["--set no.such.key=1: ", "unknown key `no`", "expected"]),
        ("gauges[3].at=[0, 0]", ["--set gauges[3].at=[0, 0]: ", "gauges has 1 items", "expected an index below 1"]),
        ("time.end=[1,", ["--set time.end=[1,: ", "`time.end` = [1,", "expected a TOML value"]),
        ("time.end", ["--set time.end: ", "expected", "key.path=value"]),
    ] {
        let error = changed(DROP, &[set]).expect_err(set);
        let message = error.to_string();
        for fragment in fragments {
            assert!(message.contains(fragment), "{fragment:?} is not in: {message}");
        }
        assert!(error.source_code().is_none(), "{set}");
    }
}

#[test]
fn the_last_of_two_set_arguments_wins_and_is_blamed() {
    assert_eq!(drop_with(&["time.end=0.01", "time.end=0.03"]).time.end, 0.03);
    let message = changed(DROP, &["time.end=0.01", "time.end=0"]).expect_err("0 is refused").to_string();
    assert!(message.starts_with("--set time.end=0: "), "{message}");
}

#[test]
fn an_error_points_at_the_wrong_value_or_the_unknown_key_and_explains_the_key() {
    for (to, marked, help) in [("mass = -3.5", "-3.5", Some("body.mass [kg/m]: ")), ("mas = 3.5", "mas", None)] {
        let text = DROP.replace("mass = 100.0", to);
        let error = load_text("drop.toml", &text, &[]).expect_err(to);
        let mut labels = error.labels().expect("a label");
        let label = labels.next().expect("a label");
        let (start, end) = (label.offset(), label.offset() + label.len());
        assert_eq!(&text[start..end], marked);
        let explained = error.help().map(|help| help.to_string());
        assert_eq!(explained.is_some(), help.is_some());
        assert!(explained.unwrap_or_default().starts_with(help.unwrap_or_default()));
    }
}

#[test]
fn a_scene_that_is_nowhere_lists_the_scenes_there_are() {
    let error = load("wegde", &[]).expect_err("a typing error");
    assert!(error.to_string().contains("`wegde`"));
    assert!(error.help().expect("a list").to_string().contains("wedge25"));
}

#[test]
fn more_particles_than_memory_is_refused_at_the_spacing() {
    let loaded = load_text("drop.toml", DROP, &[]).expect("the scene loads");
    let (fluid, wall) = particle_estimate(&loaded.scene);
    let bytes = (fluid + wall) * BYTES_PER_PARTICLE;
    assert!(loaded.fits_in_memory(bytes).is_ok());
    let message = loaded.fits_in_memory(bytes - 1).expect_err("one byte short").to_string();
    assert!(message.starts_with("drop.toml:6: `resolution.spacing` = 0.005"), "{message}");
    assert!(message.contains(&format!("{fluid} fluid and {wall} wall")), "{message}");
}

/// Every key meets every scene, every value every key, and every value every scene: a quarter of all that there are of the three. The
/// others follow in the long variant, with `LONG=1`, as in `tests/nightly`.
#[test]
fn no_value_of_any_key_makes_loading_panic() {
    let values = [
        "0",
        "-1",
        "1e12",
        "1e300",
        "-1e-300",
        "\"x\"",
        "true",
        "[]",
        "[0, 0]",
        "[[0, 0], [1, 0], [0, 1]]",
        "{}",
        "nan",
    ];
    let share = if std::env::var("LONG").is_ok_and(|value| value == "1") { 1 } else { 4 };
    let (mut loaded, mut refused) = (0, 0);
    for (s, (name, _)) in builtin().iter().enumerate() {
        for (k, keyword) in schema().keywords().iter().enumerate() {
            for value in values.iter().skip((s + k) % share).step_by(share) {
                let set = format!("{}={value}", keyword.path.replace("[]", "[0]"));
                match load(name, &[set]) {
                    Err(error) => refused += usize::from(!error.to_string().is_empty()),
                    Ok(strange) => {
                        let (fluid, _) = particle_estimate(&strange.scene);
                        loaded += usize::from(fluid > 0);
                    }
                }
            }
        }
    }
    println!("{loaded} loaded, {refused} refused");
    assert!(loaded > 0 && refused > 0, "{loaded} loaded, {refused} refused");
    assert_eq!(loaded + refused, builtin().len() * schema().keywords().len() * values.len() / share);
}
