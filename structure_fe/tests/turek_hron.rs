//! Turek & Hron's (2006) structural benchmarks: a flag of 0.35 m x 0.02 m behind a cylinder, in plane
//! strain, under its weight. St. Venant-Kirchhoff there, a beam here.

mod common;

use common::{number, table};
use structure_fe::{
    Beam, Damping, Dynamics, Integration, Loads, Material, NonlinearStatics, Section, Supports, Theory,
};

const ELEMENTS: usize = 32;

/// The flag from the cylinder's rearmost point to point A, and its weight.
fn flag(youngs_modulus: f64) -> (Beam, Supports, Loads) {
    let material = Material { youngs_modulus, poissons_ratio: 0.4, density: 1000.0 };
    let beam = Beam::straight([0.25, 0.2], [0.6, 0.2], ELEMENTS, material, Section::strip(0.02)).unwrap();
    let beam = beam.with_theory(Theory::TIMOSHENKO).unwrap().with_rotatory_inertia().unwrap();
    let mut loads = Loads::default();
    for element in 0..ELEMENTS {
        loads.along_element(element, [0.0, -2.0 * 1000.0 * 0.02], [0.0, -2.0 * 1000.0 * 0.02]);
    }
    let mut supports = Supports::default();
    supports.clamp(0);
    (beam, supports, loads)
}

fn row(case: &str) -> std::collections::HashMap<String, String> {
    table("turek_hron_csm").into_iter().find(|row| row["case"] == case).unwrap()
}

#[test]
fn csm1_and_csm2_hang_where_published() {
    for (case, modulus) in [("CSM1", 1.4e6), ("CSM2", 5.6e6)] {
        let (beam, supports, loads) = flag(modulus);
        let solution = NonlinearStatics::new(beam, supports).unwrap().solve(&loads, 4).unwrap();
        let [u, w, _] = solution.displacement[ELEMENTS];
        for (name, ours, column) in [("u", u, "ux_m"), ("w", w, "uy_m")] {
            let error = ours / number(&row(case), column) - 1.0;
            println!("{case} {name}: {ours:.6} m, error {:.3} %", 100.0 * error);
            assert!(error.abs() < 0.01, "{case} {name}: {ours}");
        }
    }
}

/// Mean and amplitude of the extremes, and frequency between the first and the last upward crossing of
/// the mean, as the benchmark defines them.
fn mean_amplitude_frequency(series: &[(f64, f64)]) -> [f64; 3] {
    let values = series.iter().map(|&(_, value)| value);
    let (low, high) = (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max));
    let mean = 0.5 * (low + high);
    let crossings: Vec<f64> = series
        .windows(2)
        .filter(|pair| pair[0].1 < mean && pair[1].1 >= mean)
        .map(|pair| pair[0].0 + (pair[1].0 - pair[0].0) * (mean - pair[0].1) / (pair[1].1 - pair[0].1))
        .collect();
    let periods = (crossings.len() - 1) as f64;
    [mean, 0.5 * (high - low), periods / (crossings[crossings.len() - 1] - crossings[0])]
}

#[test]
fn csm3_swings_as_published() {
    let (beam, supports, loads) = flag(1.4e6);
    let load = loads.at_nodes(&beam, &[[0.0; 3]; ELEMENTS + 1]).unwrap();
    let rule = Integration::GeneralisedAlpha { spectral_radius: 1.0 };
    let mut dynamics = Dynamics::new(beam, supports, rule, Damping::default()).unwrap();
    let mut state = dynamics.at_rest();
    dynamics.equilibrate(&mut state, &load).unwrap();
    let dt = 0.005;
    let (mut across, mut along) = (vec![(0.0, 0.0)], vec![(0.0, 0.0)]);
    for _ in 0..2000 {
        dynamics.step(&mut state, &load, dt).unwrap();
        let [u, w, _] = state.displacement[ELEMENTS];
        across.push((state.time, w));
        along.push((state.time, u));
    }
    // Against the published extremes, over the last of ten seconds as there.
    let late = |series: &[(f64, f64)]| series.iter().copied().filter(|&(t, _)| t > 5.0).collect::<Vec<_>>();
    let published = row("CSM3");
    for (name, series, columns) in [("w", &across, ["uy_m", "uy_amp"]), ("u", &along, ["ux_m", "ux_amp"])] {
        let [mean, amplitude, frequency] = mean_amplitude_frequency(&late(series));
        let expected = [number(&published, columns[0]), number(&published, columns[1]), number(&published, "freq_Hz")];
        for (what, ours, expected) in
            [("mean", mean, expected[0]), ("amplitude", amplitude, expected[1]), ("frequency", frequency, expected[2])]
        {
            let error = ours / expected - 1.0;
            println!("CSM3 {name} {what}: {ours:.6}, error {:.2} %", 100.0 * error);
            assert!(error.abs() < 0.01, "CSM3 {name} {what}: {ours} against {expected}");
        }
    }
    // Against the authors' own series, first 5 s.
    let reference = series();
    let [mean, amplitude, frequency] = mean_amplitude_frequency(&reference);
    let ours: Vec<_> = across.iter().copied().filter(|&(t, _)| t <= 5.0).collect();
    let [our_mean, our_amplitude, our_frequency] = mean_amplitude_frequency(&ours);
    for (what, ours, expected) in
        [("mean", our_mean, mean), ("amplitude", our_amplitude, amplitude), ("frequency", our_frequency, frequency)]
    {
        println!(
            "CSM3 w {what} against the series: {ours:.6} and {expected:.6}, {:.2} %",
            100.0 * (ours / expected - 1.0)
        );
    }
    let square = |f: &dyn Fn(usize) -> f64| (0..ours.len()).map(|i| f(i).powi(2)).sum::<f64>();
    let difference = (square(&|i| ours[i].1 - reference[i].1) / square(&|i| reference[i].1)).sqrt();
    println!("CSM3: L2 difference from the series over 5 s {:.2} %", 100.0 * difference);
    assert!(difference < 0.03, "{difference}");
}

fn series() -> Vec<(f64, f64)> {
    let path =
        concat!(env!("CARGO_MANIFEST_DIR"), "/../scenarios/scene/reference/external/turek_csm3_reference_t0_5.csv");
    let text = std::fs::read_to_string(path).unwrap();
    let rows = text.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit()));
    rows.map(|line| {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        (cells[0], cells[2])
    })
    .collect()
}
