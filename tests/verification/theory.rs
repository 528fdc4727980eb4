//! The low-order models of entry (THEORY EN2–EN10) against tables that independent programs computed.

use water_entry::{Entry, EntryModel, Loads, OutOfRange, Section, SectionMotion, SimilarityFlow};

/// Rows of a reference, with its columns by name.
struct Reference {
    head: Vec<String>,
    rows: Vec<Vec<f64>>,
}

impl Reference {
    fn read(path: &str) -> Reference {
        let file = format!("{}/../scenarios/scene/reference/{path}", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(file).expect("a reference");
        let mut lines = text.lines().filter(|l| !l.starts_with('#'));
        let head = lines.next().expect("a head").split(',').map(String::from).collect();
        let rows = lines.map(|l| l.split(',').map(|v| v.parse().expect("a number")).collect()).collect();
        Reference { head, rows }
    }

    fn of<'a>(&'a self, row: &'a [f64]) -> impl Fn(&str) -> f64 + 'a {
        |name| row[self.head.iter().position(|h| h == name).unwrap_or_else(|| panic!("no column {name}"))]
    }
}

fn near(ours: f64, theirs: f64, within: f64, what: &str) {
    assert!((ours / theirs - 1.0).abs() <= within, "{what}: {ours}, reference {theirs}");
}

fn wedge(model: EntryModel, deadrise: f64) -> Loads {
    Loads::new(model, &Section::wedge(deadrise, 1000.0).expect("a section")).expect("in range")
}

#[test]
fn forces_of_classical_models_on_wedges() {
    let table = Reference::read("exact/wedge_models_const_speed.csv");
    for row in &table.rows {
        let of = table.of(row);
        let deadrise = of("beta_deg");
        for (model, name) in
            [(EntryModel::VonKarman, "F_vK"), (EntryModel::Wagner, "F_Wagner"), (EntryModel::Mlm, "F_MLM")]
        {
            if deadrise <= model.deadrises()[1] {
                let loads = wedge(model, deadrise);
                near(loads.at(1.0).slam, of(name), 1e-6, &format!("{name} at {deadrise}"));
                near(loads.at(0.3).slam, 0.3 * of(name), 1e-6, &format!("{name} at {deadrise}, less deep"));
            }
        }
        let loads = wedge(EntryModel::Mlm, deadrise);
        let cp = |x: f64| 2.0 * loads.pressure(x, 1.0, 1.0, 0.0, 1.0).expect("a pressure");
        near(cp(0.0), of("Cp_apex_MLM"), 1e-6, "at the keel");
        let reach = loads.at(1.0).wetted;
        let top = (0..200_000).map(|k| cp(reach * f64::from(k) / 200_000.0)).fold(0.0, f64::max);
        near(top, of("Cpmax_MLM"), 1e-3, &format!("Cp_max at {deadrise}"));
    }
}

/// Closed forms: A/h = π/tan² β, π³/(4 tan² β), and the modified Logvinovich model's with q = 1/cos θ where p = 0.
#[test]
fn closed_forms_on_wedges() {
    use std::f64::consts::PI;
    for deadrise in [4.0_f64, 13.0, 30.0, 44.0] {
        let tan = deadrise.to_radians().tan();
        let (c, spread, across) = (0.5 * PI / tan, 0.5 * PI / tan, 1.0 / (1.0 + tan * tan));
        let q = (spread + (spread * spread - across * (1.0 - across)).sqrt()) / across;
        let sin = (1.0 - 1.0 / (q * q)).sqrt();
        let mlm = 2.0 * c * (spread * sin.asin() - 0.5 * across * sin.atanh() - 0.5 * (1.0 - across) * sin);
        for h in [1e-3, 0.37, 1.0, 7.0] {
            let slam = |model| wedge(model, deadrise).at(h).slam / h;
            near(slam(EntryModel::VonKarman), PI / (tan * tan), 1e-10, "von Karman");
            near(slam(EntryModel::Wagner), PI.powi(3) / (4.0 * tan * tan), 1e-10, "Wagner");
            near(slam(EntryModel::Mlm), mlm, 1e-10, "MLM");
        }
    }
}

#[test]
fn pressures_along_a_wedge() {
    for deadrise in [10, 20, 30, 45] {
        let table = Reference::read(&format!("exact/wedge_pressure_mlm_wagner_{deadrise}deg.csv"));
        let [mlm, wagner] = [EntryModel::Mlm, EntryModel::Wagner].map(|model| wedge(model, f64::from(deadrise)));
        for row in &table.rows {
            let of = table.of(row);
            let cp = |loads: &Loads| 2.0 * loads.pressure(of("x_over_Vt"), 1.0, 1.0, 0.0, 1.0).expect("a pressure");
            if of("x_over_c") < 0.95 {
                near(cp(&mlm), of("Cp_MLM"), 2e-5, "MLM");
                near(cp(&wagner), of("Cp_Wagner_linear"), 2e-5, "Wagner");
            }
        }
    }
}

#[test]
fn the_similarity_solution_of_an_independent_program() {
    let table = Reference::read("wedge_similarity/summary.csv");
    for row in &table.rows {
        let of = table.of(row);
        let deadrise = of("beta_deg");
        let usual = SimilarityFlow::solve(deadrise).expect("a solution");
        let finer = SimilarityFlow::with_step(deadrise, 0.2).expect("a solution");
        let check = |flow: &SimilarityFlow, within: f64| {
            near(flow.force_coefficient, of("F_over_rhoV3t"), within, &format!("force at {deadrise}"));
            near(flow.cp_max, of("Cpmax"), within, &format!("Cp_max at {deadrise}"));
            near(flow.cp_keel, of("Cp_apex"), 2.0 * within, &format!("Cp at the keel at {deadrise}"));
            near(flow.contact_angle_deg, of("gamma_deg"), 2.0 * within, &format!("contact angle at {deadrise}"));
            near(flow.tip[0], of("x_tip"), within, &format!("tip at {deadrise}"));
            near(flow.tip[1], of("y_tip"), within, &format!("tip at {deadrise}"));
            near(flow.z_max, of("zmax_over_Vt"), 5.0 * within, &format!("height of the peak at {deadrise}"));
        };
        check(&usual, 1e-4);
        check(&finer, 5e-5);
        let usual_profile = |x: f64| usual.pressure_coefficient(x);
        let profile = Reference::read(&format!("wedge_similarity/cp_beta{deadrise}.csv"));
        for row in &profile.rows {
            let of = profile.of(row);
            let wrong = (usual_profile(of("x_over_Vt")) - of("Cp")).abs();
            assert!(wrong < 1e-3 * usual.cp_max, "{deadrise}, x = {}: {wrong}", of("x_over_Vt"));
        }
    }
}

/// The power that the wedge gives goes into the water's motion: force from pressures is force from energy.
#[test]
fn the_similarity_solution_keeps_energy_at_every_degree() {
    for deadrise in 4..=80 {
        let flow = SimilarityFlow::with_step(f64::from(deadrise), 0.2).expect("a solution");
        println!("{deadrise} {:e}", flow.force_from_energy / flow.force_coefficient - 1.0);
    }
}

#[test]
fn the_similarity_solution_exists_for_every_deadrise_and_tends_to_wagners() {
    let mut before = f64::INFINITY;
    for tenths in (40..=800).step_by(4) {
        let deadrise = f64::from(tenths) / 10.0;
        let flow = SimilarityFlow::solve(deadrise).unwrap_or_else(|| panic!("no solution at {deadrise}"));
        assert!(flow.force_coefficient < before, "not monotone at {deadrise}");
        before = flow.force_coefficient;
    }
    let wagner = |deadrise| wedge(EntryModel::Wagner, deadrise).at(1.0).slam;
    let ratio = |deadrise| SimilarityFlow::solve(deadrise).expect("a solution").force_coefficient / wagner(deadrise);
    assert!(ratio(4.0) > 0.93 && ratio(4.0) > ratio(8.0) && ratio(8.0) > ratio(16.0));
    for deadrise in [3.9, 80.1, f64::NAN] {
        assert!(SimilarityFlow::solve(deadrise).is_none());
    }
}

/// The surface of the similarity flow ends at still water, far away, and what stands above still water is what the wedge
/// displaces: the solution does not assume it.
#[test]
fn the_surface_of_the_similarity_flow_holds_the_water_displaced() {
    for deadrise in [10.0, 30.0, 60.0] {
        let flow = SimilarityFlow::with_step(deadrise, 0.2).expect("a solution");
        let last = flow.surface[flow.surface.len() - 1];
        assert!(last[0] > 1e3 && last[1].abs() < 2e-3, "{last:?}");
        // between face, surface and still water; what is raised beyond 30 times the spray root is missing
        let tip = flow.tip;
        let above: f64 = flow
            .surface
            .windows(2)
            .take_while(|w| w[1][0] < 30.0 * flow.turn)
            .map(|w| 0.5 * (w[0][1] + w[1][1]) * (w[1][0] - w[0][0]))
            .sum();
        let face_foot = 1.0 / deadrise.to_radians().tan();
        let triangle = 0.5 * (tip[1] - last[1]) * (tip[0] - face_foot);
        near(above + triangle, 0.5 * face_foot, 0.02, &format!("water raised at {deadrise}"));
    }
}

#[test]
fn a_free_drop_by_the_modified_logvinovich_model() {
    for (file, deadrise, breadth, mass, speed) in [
        ("freefall_zhao1996_30deg_mlm", 30.0, 0.5, 241.0, 6.15),
        ("freefall_generic_10deg_mlm", 10.0, 0.6, 150.0, 3.0),
        ("freefall_generic_20deg_mlm", 20.0, 0.6, 100.0, 4.0),
    ] {
        let table = Reference::read(&format!("exact/{file}.csv"));
        let loads =
            Loads::new(EntryModel::Mlm, &Section::wedge(deadrise, breadth).expect("a section")).expect("in range");
        let times: Vec<f64> = table.rows.iter().map(|row| row[0]).collect();
        let entry = Entry {
            loads: &loads,
            motion: SectionMotion::Free(mass),
            draught: 0.0,
            speed,
            gravity: 9.81,
            density: 1000.0,
            buoyancy: false,
            steep: false,
        };
        let dry = entry.solve(&times).expect("in range");
        let peak = table.rows.iter().map(|row| row[4]).fold(0.0, f64::max);
        for (row, now) in table.rows.iter().zip(&dry) {
            let of = table.of(row);
            assert!((now.speed - of("v_m_s")).abs() < 1e-4 * speed, "{file}: {now:?}");
            assert!((now.force - of("F_N_per_m")).abs() < 2e-3 * peak, "{file}: {now:?}, {}", of("F_N_per_m"));
        }
    }
}

#[test]
fn von_karmans_momentum_is_kept() {
    let loads = Loads::new(EntryModel::VonKarman, &Section::wedge(25.0, 2.0).expect("a section")).expect("in range");
    let entry = Entry {
        loads: &loads,
        motion: SectionMotion::Free(80.0),
        draught: 0.0,
        speed: 5.0,
        gravity: 0.0,
        density: 1000.0,
        buoyancy: true,
        steep: false,
    };
    let times: Vec<f64> = (0..=100).map(|k| 0.0005 * f64::from(k)).collect();
    for now in entry.solve(&times).expect("in range") {
        let momentum = (80.0 + 1000.0 * loads.at(now.draught).added_mass) * now.speed;
        assert!((momentum / 400.0 - 1.0).abs() < 1e-5, "{now:?}: {momentum}");
    }
}

#[test]
fn cylinders() {
    let table = Reference::read("exact/cylinder_slamming.csv");
    let section = Section::arc(1.0, 2.0).expect("a section");
    for (model, name) in
        [(EntryModel::VonKarman, "Cs_vK"), (EntryModel::Wagner, "Cs_Wagner"), (EntryModel::Mlm, "Cs_MLM")]
    {
        let loads = Loads::new(model, &section).expect("in range");
        for row in &table.rows {
            let of = table.of(row);
            if (0.001..0.2).contains(&of("h_over_R")) {
                near(loads.at(of("h_over_R")).slam, of(name), 6e-3, &format!("{name} at {}", of("h_over_R")));
            }
        }
    }
}

#[test]
fn past_the_chines_the_load_of_a_fast_entry_falls() {
    let loads = Loads::new(EntryModel::Mlm, &Section::wedge(20.0, 0.6).expect("a section")).expect("in range");
    let separation = (1..400).map(|k| 0.001 * f64::from(k)).find(|h| loads.at(*h).wetted > 0.3).expect("it comes");
    let at = loads.at(separation).slam;
    assert!(loads.at(1.3 * separation).slam < 0.7 * at && loads.at(3.0 * separation).slam < 0.35 * at);
}

#[test]
fn what_a_model_cannot_do_is_refused_with_its_range_and_the_next_that_can() {
    let of = |model: EntryModel, section: &Section| Loads::new(model, section).expect_err("out of range");
    let steep = Section::wedge(80.0, 1.0).expect("a section");
    let OutOfRange { next, .. } = of(EntryModel::Wagner, &steep);
    assert_eq!(next, EntryModel::Similarity);
    assert!(of(EntryModel::Wagner, &steep).to_string().contains("4 to 45 degrees"));
    let steeper = Section::wedge(85.0, 1.0).expect("a section");
    assert_eq!(of(EntryModel::Similarity, &steeper).next, EntryModel::Wcsph);
    let arc = Section::arc(1.0, 1.0).expect("a section");
    assert_eq!(of(EntryModel::Similarity, &arc).next, EntryModel::BoundaryElement);
    let lopsided = vec![[0.0, 0.0], [1.0, 0.3], [1.0, 1.0], [-1.0, 1.0], [-1.0, 0.5]];
    let refused =
        fsi_coupling::section_of(&fsi_coupling::Shape::Polygon { points: lopsided }).expect_err("not symmetric");
    assert!(refused.to_string().contains("symmetric"), "{refused}");

    let loads = Loads::new(EntryModel::Mlm, &Section::wedge(30.0, 0.5).expect("a section")).expect("in range");
    let entry = Entry {
        loads: &loads,
        motion: SectionMotion::Free(20.0),
        draught: 0.0,
        speed: 3.0,
        gravity: 9.81,
        density: 1000.0,
        buoyancy: true,
        steep: false,
    };
    let times: Vec<f64> = (0..=1000).map(|k| 0.001 * f64::from(k)).collect();
    let refused = entry.solve(&times).expect_err("it comes back up");
    assert!(refused.to_string().contains("leaves the water") && refused.next == EntryModel::Wcsph, "{refused}");
}
