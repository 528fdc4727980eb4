//! A tank that is full: water between a floor and a lid, without a free surface, so that nothing gives the pressure a
//! level.

use evidence::bare::{advance, lattice, parameters};
use evidence::parameters::{Parameters, projection_of};
use sph_core::projection::Settings;
use sph_core::{Breakdown, Fluid, Periodic, Solver, WallPoint, Walls};

const HEIGHT: f64 = 1.0;
const ROWS: usize = 20;
const COLUMNS: usize = 12;
const GRAVITY: f64 = 9.81;
const WATER: f64 = 1000.0;

/// Water, a floor below it and a lid above, all repeated sideways.
fn full_tank() -> (Fluid, Walls) {
    let spacing = HEIGHT / ROWS as f64;
    let width = COLUMNS as f64 * spacing;
    let parameters = Parameters {
        gravity: [0.0, -GRAVITY],
        periodic: Some(Periodic { x: Some([0.0, width]), y: None }),
        solver: Solver::Incompressible,
        cfl: 0.2,
        ..parameters(44.3)
    };
    let point = |k: usize, floor: bool| {
        let depth = ((k / COLUMNS) as f64 + 0.5) * spacing;
        let (y, normal) = if floor { (-depth, [0.0, 1.0]) } else { (HEIGHT + depth, [0.0, -1.0]) };
        let at = [((k % COLUMNS) as f64 + 0.5) * spacing, y];
        WallPoint { at, normal, area: spacing * spacing, spacing, depth, outline: Default::default(), midline: None }
    };
    let points: Vec<WallPoint> = (0..6 * COLUMNS).map(|k| point(k / 2, k % 2 == 0)).collect();
    let mut walls = Walls::default();
    walls.extend(&points, parameters.smoothing_ratio);
    let seeds = lattice([0.0; 2], [width, HEIGHT], spacing, |_| Some(([0.0; 2], 0.0)));
    (parameters.fluid(&seeds), walls)
}

/// At rest, from no pressure at all: hydrostatic about the mean 0, half of it tension, from the first step to the end of a
/// second; the walls carry the water's weight in difference.
#[test]
fn a_full_tank_is_at_rest_under_a_pressure_with_the_mean_0() {
    let (mut fluid, mut walls) = full_tank();
    let head = WATER * GRAVITY * HEIGHT;
    advance(&mut fluid, &mut walls, 1.0, |fluid| {
        let (p, pressure) = (fluid.particles(), &fluid.fields().pressure);
        assert!(fluid.surface_indicator().iter().all(|&e| e == 0.0), "air where there is none");
        let mean = pressure.iter().sum::<f64>() / pressure.len() as f64;
        assert!(mean.abs() < 1e-9 * head, "mean {mean:.2e} Pa");
        let off = |k: usize| (pressure[k] - WATER * GRAVITY * (0.5 * HEIGHT - p.y[k])).abs();
        let worst = (0..p.len()).map(off).fold(0.0, f64::max);
        assert!(worst < 0.002 * head, "{worst:.1} Pa off at t = {}", fluid.time());
        let fastest = (0..p.len()).map(|k| p.u[k].hypot(p.v[k])).fold(0.0, f64::max);
        assert!(fastest < 1e-3 * (GRAVITY * HEIGHT).sqrt(), "{fastest:.2e} m/s at t = {}", fluid.time());
    })
    .expect("a stable run");
    let (weight, force) = (fluid.mass() * GRAVITY, walls.fy.iter().sum::<f64>());
    println!("force {force:.3} N/m, weight {weight:.3} N/m, steps {}", fluid.steps());
    assert!((force / weight + 1.0).abs() < 1e-3, "walls carry {force:.3} of {weight:.3} N/m");
}

/// Places, velocities and pressures by identity, to the bit.
fn state(fluid: &Fluid) -> Vec<[u64; 6]> {
    let p = fluid.particles();
    let of = |k: usize| [p.x[k], p.y[k], p.u[k], p.v[k], fluid.fields().pressure[k]].map(f64::to_bits);
    let row = |k: usize| {
        let [x, y, u, v, pressure] = of(k);
        [u64::from(p.id[k]), x, y, u, v, pressure]
    };
    let mut rows: Vec<[u64; 6]> = (0..p.len()).map(row).collect();
    rows.sort_unstable();
    rows
}

/// CO26: a step whose pressure is not found leaves everything as it was, so that a shorter one can be taken.
#[test]
fn a_step_that_is_refused_leaves_the_water_as_it_was() {
    let (mut fluid, mut walls) = full_tank();
    advance(&mut fluid, &mut walls, 0.05, |_| {}).expect("a stable run");
    let (before, time, steps) = (state(&fluid), fluid.time(), fluid.steps());
    let dt = fluid.stable_dt(&walls).expect("a step");
    let usual = *projection_of(&mut fluid);
    *projection_of(&mut fluid) = Settings { tolerance: 1e-15, most_iterations: 1, ..usual };
    let refused = fluid.step(&mut walls, dt).expect_err("single iterations are too few");
    assert!(matches!(refused, Breakdown::Projection { time: at, .. } if at == time), "{refused}");
    assert_eq!((fluid.time(), fluid.steps()), (time, steps));
    assert!(state(&fluid) == before, "something has moved");
    *projection_of(&mut fluid) = usual;
    fluid.step(&mut walls, 0.5 * dt).expect("a step");
    assert_eq!(fluid.time(), time + 0.5 * dt);
}
