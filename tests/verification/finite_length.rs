//! Loads between free ends (THEORY RU6–RU8), and what a run says of them.

use std::f64::consts::PI;

use run::{RunOptions, load_text, run};
use scene::vocabulary::ResultName;
use water_entry::finite_span::Ends;

/// Vortex rings along the quarter of a plate; cosine spacing makes the error fall with their square.
const RINGS: [usize; 2] = [10, 14];

/// Edges, and places between them, of cosine-spaced rings over one half of −half … half.
fn rings(half: f64, count: usize) -> (Vec<f64>, Vec<f64>) {
    let at = |k: f64| -half * (PI * k / (2 * count) as f64).cos();
    ((0..=2 * count).map(|k| at(k as f64)).collect(), (0..count).map(|k| at(k as f64 + 0.5)).collect())
}

/// Solves A x = b by elimination with pivots.
fn solved(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|i, j| a[*i][k].abs().total_cmp(&a[*j][k].abs())).expect("a row");
        a.swap(k, pivot);
        b.swap(k, pivot);
        let (row, right) = (a[k].clone(), b[k]);
        for i in k + 1..n {
            let share = a[i][k] / row[k];
            (k..n).for_each(|j| a[i][j] -= share * row[j]);
            b[i] -= share * right;
        }
    }
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|j| a[k][j] * b[j]).sum();
        b[k] = (b[k] - known) / a[k][k];
    }
    b
}

/// Added mass of a rectangular plate of length over breadth λ, over that of a strip of an endless plate: rings of constant jump of potential, whose
/// normal velocity is that of the plate.
fn plate(ratio: f64) -> f64 {
    let [n, m] = RINGS;
    let ((xe, xc), (ye, yc)) = (rings(1.0, n), rings(ratio, m));
    let corner = |at: [f64; 2], i: usize, j: usize| {
        let [dx, dy] = [at[0] - xe[i], at[1] - ye[j]];
        dx.hypot(dy) / (dx * dy)
    };
    let ring = |at: [f64; 2], i: usize, j: usize| {
        (corner(at, i + 1, j + 1) - corner(at, i, j + 1) - corner(at, i + 1, j) + corner(at, i, j)) / (4.0 * PI)
    };
    let places: Vec<[usize; 2]> = (0..n * m).map(|k| [k / m, k % m]).collect();
    let velocity = |&[p, q]: &[usize; 2]| {
        let at = [xc[p], yc[q]];
        let of = |&[i, j]: &[usize; 2]| {
            let images = [[i, j], [2 * n - 1 - i, j], [i, 2 * m - 1 - j], [2 * n - 1 - i, 2 * m - 1 - j]];
            images.map(|[i, j]| ring(at, i, j)).iter().sum::<f64>()
        };
        places.iter().map(of).collect::<Vec<f64>>()
    };
    let jumps = solved(places.iter().map(velocity).collect(), vec![1.0; n * m]);
    let area = |&[i, j]: &[usize; 2]| (xe[i + 1] - xe[i]) * (ye[j + 1] - ye[j]);
    let sum: f64 = places.iter().zip(jumps).map(|(place, jump)| area(place) * jump).sum();
    4.0 * sum.abs() / (PI * 2.0 * ratio)
}

/// Pabst's (1930) formula, as it is printed.
fn pabst(ratio: f64) -> f64 {
    (1.0 + ratio.powi(-2)).powf(-0.5) * (1.0 - 0.425 * ratio / (1.0 + ratio * ratio))
}

/// RU7: the value is the mean of Pabst's formula and of the plate, which is solved here.
#[test]
fn the_factor_is_between_pabst_and_a_plate_in_potential_flow() {
    for ratio in [0.5, 1.0, 1.6, 2.0, 4.0, 10.0] {
        let Ends { impulse, .. } = Ends::of_aspect_ratio(ratio);
        let [a, b] = [pabst(ratio), plate(ratio)];
        assert!((impulse.value / (0.5 * (a + b)) - 1.0).abs() < 2e-4, "{ratio}: {} {a} {b}", impulse.value);
        assert!(impulse.band > 0.499 * (a - b).abs(), "{ratio}: {} {a} {b}", impulse.band);
    }
}

const WEDGE: &str = "name = \"short\"\nmodel = \"similarity\"\ngravity = [0.0, 0.0]\n[time]\nend = 0.02\n[body]\nname = \"wedge\"\n\
    shape = \"wedge\"\ndeadrise_deg = 25.0\nbreadth = 1.0\nside_height = 0.2\nmotion = \"constant_velocity\"\nvelocity = [0.0, -4.0]\n\
    [report]\nlength = 0.5\n";

/// RU8: the factor of a run is that of the breadth that is wet at the peak, and the force of the whole section is less than length times
/// force per metre.
#[test]
fn a_run_has_the_factors_of_its_own_wetted_breadth() {
    let scene = load_text("short.toml", WEDGE, &[]).expect("a scene").scene;
    let summary = run(&scene, &RunOptions::default()).expect("a run").summary;
    let ends = summary.ends.expect("two ends");
    // Wagner: 2c = π V t/tan β
    let breadth = |time: f64| PI * 4.0 * time / 25.0_f64.to_radians().tan();
    let (force, of_force) =
        (summary.results.get(ResultName::PeakForce).expect("a force"), ends.peak_force.expect("wet"));
    let time = force.time_s.expect("a time");
    assert!((of_force.wetted_breadth_m / breadth(time) - 1.0).abs() < 1e-9, "{of_force:?}");
    let exact = Ends::of_aspect_ratio(0.5 / breadth(time)).force;
    assert!((of_force.factor / exact.value - 1.0).abs() < 1e-9 && of_force.whole < 0.5 * force.value);
    let of_impulse = ends.impulse.expect("wet");
    assert!((of_impulse.wetted_breadth_m / breadth(0.02) - 1.0).abs() < 1e-9, "{of_impulse:?}");
    assert!(of_impulse.factor > of_force.factor);
    // up to wet chines the force has one, past them the impulse has none
    let narrow = WEDGE.replace("breadth = 1.0", "breadth = 0.4").replace("\"similarity\"", "\"boundary_element\"");
    let scene = load_text("short.toml", &narrow, &[]).expect("a scene").scene;
    let ends = run(&scene, &RunOptions::default()).expect("a run").summary.ends.expect("two ends");
    let force = ends.peak_force.expect("a peak as the chines get wet");
    assert!((force.wetted_breadth_m / 0.4 - 1.0).abs() < 0.01 && ends.impulse.is_none(), "{ends:?}");
}

/// RU1–RU3 beside a run: the rule's numbers come from its own inputs, whatever the run's speed.
#[test]
fn the_loads_of_the_rules_stand_beside_those_of_the_run() {
    let rule = "[rule]\ntakeoff_speed = \"60 kn\"\nlanding_speed = \"55 kn\"\nlanding_mass = \"6000 lb\"\nk2 = 0.75\n";
    let loads = |speed: &str| {
        let text = WEDGE.replace("-4.0", speed) + rule;
        let scene = load_text("short.toml", &text, &[]).expect("a scene").scene;
        run(&scene, &RunOptions::default()).expect("a run").summary.rule_loads
    };
    let (slow, fast) = (loads("-4.0"), loads("-5.0"));
    let of = |loads: &[run::stated_numbers::RuleLoad], paragraph: &str| {
        loads.iter().find(|load| load.paragraph == paragraph).cloned().unwrap_or_else(|| panic!("{paragraph}"))
    };
    // 0.00213·0.75·60²/tan 25° = 12.333 psi; 0.012·55²/(tan^⅔ 25°·6000^⅓) = 3.3221; 0.078·0.012·0.75·55²/tan 25° = 4.5540 psi
    let by_hand = [
        ("25.533(b)(1)", 12.33306 * 6_894.757_293),
        ("25.527(a)(1)", 3.322_063),
        ("25.533(c)(1)", 4.553_968 * 6_894.757_293),
    ];
    for (paragraph, value) in by_hand {
        let [a, b] = [&slow, &fast].map(|loads| of(loads, paragraph).value.expect("a number"));
        assert!((a / value - 1.0).abs() < 2e-6 && a == b, "{paragraph}: {a} {b} {value}");
    }
    let [a, b] = [&slow, &fast].map(|loads| of(loads, "25.533(c)(1)").computed.expect("a mean pressure"));
    assert!((b / a / (5.0_f64 / 4.0).powi(2) - 1.0).abs() < 1e-6, "{a} {b}");
    // a flat bottom has no number, and the reason
    let faces = "shape = \"wedge\"\ndeadrise_deg = 25.0\nbreadth = 1.0\nside_height = 0.2\n";
    let round = WEDGE
        .replace("\"similarity\"", "\"boundary_element\"")
        .replace(faces, "shape = \"arc\"\nradius = 1.0\nbreadth = 1.0\nside_height = 0.2\n")
        + rule;
    let scene = load_text("arc.toml", &round, &[]).expect("a scene").scene;
    let round = run(&scene, &RunOptions::default()).expect("a run").summary.rule_loads;
    let keel = of(&round, "25.533(b)(1)");
    assert!(keel.value.is_none() && keel.reason.expect("a reason").contains("a hull with a keel"));
}
