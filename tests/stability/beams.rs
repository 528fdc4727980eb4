//! Coupling with beams: where one exchange a step fails, and the schemes that hold there (THEORY C10–C14).

use evidence::strip::{Floor, PERIOD, deflection};
use fsi_coupling::{Agreement, Iteration, Scheme};

const ENOUGH: Iteration = Iteration { tolerance: 1e-6, max_iterations: 60 };
const STRONG: [Scheme; 3] = [Scheme::AddedMass, Scheme::Aitken(ENOUGH), Scheme::IqnIls(ENOUGH)];

/// What a run shows.
#[derive(Clone, Copy, Debug)]
struct Run {
    deepest: f64,
    when: f64,
    smallest: f64,
    drift: f64,
    momentum: f64,
    agreement: Agreement,
}

fn run(floor: &Floor, scheme: Scheme, periods: f64) -> Run {
    let mut run = Run {
        deepest: f64::INFINITY,
        when: 0.0,
        smallest: f64::INFINITY,
        drift: 0.0,
        momentum: 0.0,
        agreement: Agreement::default(),
    };
    let mut system = match floor.build(scheme) {
        Ok(system) => system,
        Err(error) => {
            println!("{error}");
            return run;
        }
    };
    let mut deepest = (0.0_f64, 0.0);
    while system.fluid.time < periods * PERIOD {
        let dt = match system.stable_dt().and_then(|dt| system.step(dt).map(|()| dt)) {
            Ok(dt) => dt,
            Err(error) => {
                println!("  {scheme:?}: {error}");
                return run;
            }
        };
        run.smallest = run.smallest.min(dt);
        let now = deflection(&system).abs();
        if now > deepest.0 {
            deepest = (now, system.fluid.time);
        }
    }
    (run.deepest, run.when) = deepest;
    run.agreement = system.agreement();
    run.drift = system.energy_drift();
    run.momentum = system.momentum_audit().worst;
    run
}

fn show(floor: &Floor, schemes: &[Scheme], periods: f64) {
    println!("{floor:?}, C8 {:.3}", 0.5 / f64::from(floor.rows) / floor.ratio);
    for &scheme in schemes {
        let start = std::time::Instant::now();
        let Run { deepest, when, smallest, drift, momentum, agreement } = run(floor, scheme, periods);
        let each = agreement.iterations as f64 / agreement.steps as f64;
        println!(
            "    {deepest:.5} at {when:.3}, {} steps, least {smallest:.1e}, {each:.2} each, most {}, residual {:.0e}, energy {drift:.2}, momentum {momentum:.0e}, {:.1} s",
            agreement.steps,
            agreement.most_iterations,
            agreement.worst_residual,
            start.elapsed().as_secs_f64()
        );
    }
}

#[test]
fn mismatch() {
    for ratio in [1.0, 0.1, 0.01, 0.001] {
        for fall in [0.0, 1.0] {
            let mut system = Floor { fall, ..Floor::still(ratio, 20) }.build(STRONG[2]).expect("a start");
            let range = system.range(0);
            let (mut worst, mut mean, mut n) = (0.0_f64, 0.0, 0.0);
            for step in 0..150 {
                let dt = system.stable_dt().expect("dt");
                system.step(dt).expect("step");
                let seen = system.walls.slice_mut(range.clone());
                let seen: Vec<f64> = seen.ay.to_vec();
                let mut copy = system.walls.clone();
                system.bodies().next().expect("strip").place(0.0, copy.slice_mut(range.clone()));
                let now = &copy.ay[range.clone()];
                let norm = |v: &mut dyn Iterator<Item = f64>| v.map(|x| x * x).sum::<f64>().sqrt();
                let gap = norm(&mut seen.iter().zip(now).map(|(a, b)| a - b));
                let size = norm(&mut now.iter().copied());
                if step < 10 {
                    println!("   {step} {gap:.3e} {size:.3e}");
                }
                worst = worst.max(gap / size);
                mean += gap / size;
                n += 1.0;
            }
            println!("ratio {ratio}, fall {fall}: worst {worst:.3e} mean {:.3e}", mean / n);
        }
    }
}
#[test]
fn in_time() {
    for (ratio, fall) in [(0.1, 0.0), (0.01, 0.0), (0.001, 0.0), (0.1, 1.0), (0.01, 1.0), (0.001, 1.0)] {
        for scheme in [Scheme::Weak, STRONG[0]] {
            for courant in [0.6, 0.3, 0.15, 0.075] {
                let mut system = Floor { fall, courant, ..Floor::still(ratio, 20) }.build(scheme).expect("a start");
                print!("ratio {ratio} fall {fall} C {courant} {scheme:?}: ");
                'run: for k in 1..9 {
                    let end = 0.025 * f64::from(k);
                    while end - system.fluid.time > 1e-12 {
                        let left = end - system.fluid.time;
                        let stepped = system.stable_dt().and_then(|dt| system.step(left / (left / dt).ceil()));
                        if stepped.is_err() {
                            print!("broke");
                            break 'run;
                        }
                    }
                    print!("{:.5} ", deflection(&system));
                }
                println!();
            }
        }
    }
}
#[test]
fn thresholds() {
    for courant in [0.6, 0.45, 0.3, 0.15, 0.075] {
        for rows in [20, 40] {
            let mut last = 0.0;
            for k in 0..14 {
                let radius = 0.36 + 0.04 * f64::from(k);
                let floor = Floor { courant, ..Floor::still(0.5 / f64::from(rows) / radius, rows) };
                let found = run(&floor, Scheme::Weak, 0.75);
                if found.deepest.is_infinite() || found.drift > 0.0 {
                    break;
                }
                last = radius;
            }
            println!("C {courant}, {rows} rows: stable to {last:.2}");
        }
    }
    for ratio in [1.0, 0.1, 0.01] {
        for courant in [0.6, 0.3, 0.15] {
            let mut system = Floor { courant, ..Floor::still(ratio, 20) }.build(STRONG[2]).expect("a start");
            let range = system.range(0);
            let (mut mean, mut n) = (0.0, 0.0);
            while system.fluid.time < 0.25 * PERIOD {
                let dt = system.stable_dt().expect("dt");
                system.step(dt).expect("step");
                let mut copy = system.walls.clone();
                system.bodies().next().expect("strip").place(0.0, copy.slice_mut(range.clone()));
                let (seen, now) = (&system.walls.ay[range.clone()], &copy.ay[range.clone()]);
                let norm = |v: &mut dyn Iterator<Item = f64>| v.map(|x| x * x).sum::<f64>().sqrt();
                mean += norm(&mut seen.iter().zip(now).map(|(a, b)| a - b)) / norm(&mut now.iter().copied());
                n += 1.0;
            }
            println!("ratio {ratio}, C {courant}: mismatch {:.4}", mean / n);
        }
    }
}

#[test]
fn beams_map() {
    let all = [Scheme::Weak, STRONG[0], STRONG[1], STRONG[2]];
    for ratio in [1.0, 0.1, 0.01, 0.003, 0.001, 0.0001] {
        show(&Floor::still(ratio, 20), &all, 1.5);
    }
    for ratio in [1.0, 0.1, 0.01, 0.001] {
        show(&Floor { fall: 1.0, ..Floor::still(ratio, 20) }, &all, 0.5);
    }
    for courant in [0.6, 0.15] {
        for rows in [20, 40] {
            for radius in [0.4, 0.5, 0.6, 0.7, 0.8] {
                show(&Floor { courant, ..Floor::still(0.5 / f64::from(rows) / radius, rows) }, &all[..1], 0.75);
            }
        }
    }
}
