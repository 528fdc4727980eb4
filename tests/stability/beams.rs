//! Coupling with beams: where one exchange a step fails, and the schemes that hold there (THEORY X1–X5).

use evidence::strip::{GRAVITY, LENGTH, PERIOD, WATER, deflection, floor};
use fsi_coupling::{Agreement, Iteration, Scheme};

const ENOUGH: Iteration = Iteration { tolerance: 1e-6, max_iterations: 60 };

/// What a run of one and a half periods of the strip in water shows.
#[derive(Clone, Copy, Debug)]
struct Run {
    /// Largest deflection [m]; infinite where the run broke down.
    deepest: f64,
    /// Its time [s].
    when: f64,
    steps: f64,
    agreement: Agreement,
}

fn run(ratio: f64, rows: u32, scheme: Scheme) -> Run {
    let mut run = Run { deepest: f64::INFINITY, when: 0.0, steps: 0.0, agreement: Agreement::default() };
    let mut system = match floor(ratio, rows, scheme) {
        Ok(system) => system,
        Err(error) => { println!("{error}"); return run; }
    };
    let mut deepest = (0.0_f64, 0.0);
    while system.fluid.time < 1.5 * PERIOD {
        if let Err(error) = system.stable_dt().and_then(|dt| system.step(dt)) {
            println!("  {scheme:?}: {error}");
            return run;
        }
        let now = deflection(&system).abs();
        if now > deepest.0 {
            deepest = (now, system.fluid.time);
        }
    }
    (run.deepest, run.when) = deepest;
    run.agreement = system.agreement();
    run.steps = run.agreement.steps as f64;
    run
}

#[test]
fn beams_map() {
    let static_ = WATER * GRAVITY * LENGTH; // Pa
    println!("pressure {static_}");
    for rows in [20, 40] {
        for ratio in [10.0, 1.0, 0.3, 0.1, 0.05, 0.03, 0.02, 0.015, 0.01] {
            let found = run(ratio, rows, Scheme::Weak);
            println!("{rows} rows, ratio {ratio:6.3}, C8 {:.3}: {found:?}", 0.5 / f64::from(rows) / ratio);
        }
    }
}
