//! The convergence study on a flow with an exact answer: the 30° wedge at constant speed.

use scenarios::experiments::convergence::{Plan, study};

/// Impulse of the exact solution, 2∫F dt/(ρV³t²) = F/(ρV³t) (Dobrovolskaya 1969; `wedge_similarity/summary.csv`).
const EXACT: f64 = 14.02010;

/// Six coarse runs (Vt/Δx = 8, 17, 33) after an approach: the exact value inside the band of the extrapolated one, which is within
/// 1.5 % of it, and the sound speed's share as WC17 has it.
#[test]
fn a_study_of_the_wedge_holds_the_exact_impulse() {
    let plan = Plan {
        scene: "wedge_constant".into(),
        sets: vec!["resolution.spacing=0.03".into()],
        quantity: "similarity/impulse_coefficient".into(),
        spacings: vec![0.12, 0.06, 0.03],
        sound_speeds: Vec::new(),
    };
    let done = study(&plan, |_, _, _, _| {}).expect("six runs");
    let fit = &done.fit;
    let error = fit.extrapolated / EXACT - 1.0;
    println!("extrapolated {:+.2} %, band {:.2} %, order {:?}", 100.0 * error, 100.0 * fit.uncertainty, fit.order);
    assert!(error.abs() < 0.015, "extrapolated {:+.2} %", 100.0 * error);
    assert!(
        error.abs() < fit.uncertainty,
        "{:+.2} % outside the band of {:.2} %",
        100.0 * error,
        100.0 * fit.uncertainty
    );
    let sound = fit.sound_speed_error.expect("two sound speeds");
    assert!((-0.016..-0.007).contains(&sound), "WC17 says -1.0 %, measured {:+.2} %", 100.0 * sound);
}
