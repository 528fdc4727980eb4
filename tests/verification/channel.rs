//! Start-up of Couette's and Poiseuille's flows between plates that do not slip (series in Morris, Fox & Zhu 1997):
//! laminar viscosity (WC7), no-slip walls (WA5), periodic planes (OP9).

use evidence::bare::{advance, lattice, parameters};
use evidence::parameters::Parameters;
use scene::reference::Table;
use sph_core::{Fluid, Periodic, Slip, WallPoint, Walls};

/// Distance of the plates [m].
const GAP: f64 = 1e-3;
/// Kinematic viscosity [m²/s].
const VISCOSITY: f64 = 1e-6;
/// Force on the water [m/s²] in Poiseuille's flow.
const PUSH: f64 = 1e-4;
/// Speed of the upper plate [m/s] in Couette's flow.
const SPEED: f64 = 1.25e-5;
/// Speed of sound [m/s]: 800 times the flow's, and still the viscous step is the shorter one.
const SOUND: f64 = 0.01;
/// Times [s] after which the flows are steady: two viscous times GAP²/ν.
const STEADY: f64 = 2.0;

/// Water between two plates, `cells` particles across and half as many along the period.
fn channel(cells: usize, push: f64, speed: f64) -> (Fluid, Walls) {
    let (spacing, length) = (GAP / cells as f64, 0.5 * GAP);
    let parameters = Parameters {
        alpha: 0.0,
        nu: VISCOSITY,
        gravity: [push, 0.0],
        slip: Slip::None,
        periodic: Some(Periodic { x: Some([0.0, length]), y: None }),
        ..parameters(SOUND)
    };
    let mut walls = Walls::default();
    for (face, normal, speed) in [(0.0, 1.0, 0.0), (GAP, -1.0, speed)] {
        let row = |layer: usize| {
            let y = face - normal * (layer as f64 + 0.5) * spacing;
            let point = move |k: usize| [(k as f64 + 0.5) * spacing, y];
            (0..cells / 2).map(move |k| WallPoint {
                at: point(k),
                normal: [0.0, normal],
                area: spacing * spacing,
                spacing,
                depth: (layer as f64 + 0.5) * spacing,
                outline: Default::default(),
                midline: None,
            })
        };
        let points: Vec<WallPoint> = (0..3).flat_map(row).collect();
        let range = walls.extend(&points, parameters.smoothing_ratio);
        walls.u[range].fill(speed);
    }
    let seeds = lattice([0.0; 2], [length, GAP], spacing, |_| Some(([0.0; 2], 0.0)));
    (parameters.fluid(&seeds), walls)
}

/// The tabulated profile [y, u] at a time [s]; the steady one stands at 1e9 s.
fn profile(column: &str, time: f64) -> Vec<[f64; 2]> {
    let name = "exact/poiseuille_couette_startup.csv";
    let table = Table::load(name).expect("a reference");
    let read = |column: &str| table.column(name, column).expect("a column");
    let (t, y, u) = (read("t_s"), read("y_m"), read(column));
    let time = if time >= STEADY { 1e9 } else { time };
    (0..t.len()).filter(|&k| t[k] == time).map(|k| [y[k], u[k]]).collect()
}

/// Largest error of any particle's velocity at each time, over the steady flow's fastest, 1.25e-5 m/s in both.
fn errors(column: &str, cells: usize, times: &[f64]) -> Vec<f64> {
    let (push, speed) = if column == "u_couette" { (0.0, SPEED) } else { (PUSH, 0.0) };
    let (mut fluid, mut walls) = channel(cells, push, speed);
    let mut at = |&time: &f64| {
        advance(&mut fluid, &mut walls, time, |_| {}).expect("a stable run");
        let (rows, p) = (profile(column, time), fluid.particles());
        assert!(rows.len() > 10, "{column} at {time} s is not tabulated");
        let exact = |y: f64| {
            let k = rows.partition_point(|row| row[0] < y).clamp(1, rows.len() - 1);
            let ([y0, u0], [y1, u1]) = (rows[k - 1], rows[k]);
            u0 + (u1 - u0) * (y - y0) / (y1 - y0)
        };
        (0..p.len()).map(|k| (p.u[k] - exact(p.y[k])).abs().max(p.v[k].abs())).fold(0.0, f64::max) / SPEED
    };
    times.iter().map(&mut at).collect()
}

/// 20 particles across: within 1 % at every time, steady flow included; 40 across: closer, within ½ %.
#[test]
fn channels_start_up_as_their_series_say() {
    let times = [0.0225, 0.045, 0.1125, 0.225, 1.0, STEADY];
    for flow in ["u_poiseuille", "u_couette"] {
        let (coarse, fine) = (errors(flow, 20, &times), errors(flow, 40, &times[..4]));
        println!("{flow}: 20 across {coarse:.5?}, 40 across {fine:.5?}");
        assert!(coarse.iter().all(|e| *e < 0.01), "{flow}, 20 across: {coarse:.4?}");
        assert!(fine.iter().all(|e| *e < 0.005), "{flow}, 40 across: {fine:.4?}");
        assert!(fine.iter().zip(&coarse).all(|(fine, coarse)| fine < coarse), "{flow}: {coarse:.4?}, then {fine:.4?}");
    }
}
