//! Thin walls (THEORY T1–T5): plates of any thickness, wet on both sides.

use evidence::plates::{DENSITY, GRAVITY, face_forces, parted};
use evidence::statistics::mean;
use evidence::systems::advance;

/// ½ρgh² [N/m].
fn push(height: f64) -> f64 {
    0.5 * DENSITY * GRAVITY * height * height
}

#[test]
fn a_plate_parts_two_still_waters() {
    let spacing = 0.02;
    for thickness in [0.2, 1.0, 2.5] {
        let mut system = parted(thickness, 16, [24, 12], spacing);
        let side = |s: &fsi_coupling::Coupled| {
            let p = &s.fluid.particles;
            let mut left = vec![false; p.len()];
            (0..p.len()).for_each(|k| left[p.id[k] as usize] = p.x[k] < 0.0);
            left
        };
        let before = side(&system);
        let (mut left, mut right, mut worst) = (vec![], vec![], 0.0_f64);
        advance(&mut system, 3.0, |s| {
            let [l, r] = face_forces(s);
            if s.fluid.time > 1.0 {
                left.push(l);
                right.push(-r);
                worst = worst.max(s.fluid_energy().kinetic);
            }
            if s.fluid.steps % 1000 == 0 {
                println!(
                    "{:.2} {:.4} {:.4} kin {:.2e} top {:.3}",
                    s.fluid.time,
                    l / push(24. * spacing) - 1.,
                    -r / push(12. * spacing) - 1.,
                    s.fluid_energy().kinetic,
                    s.fluid.top_speed()
                );
            }
        })
        .expect("a stable run");
        let errors = [mean(&left) / push(24.0 * spacing) - 1.0, mean(&right) / push(12.0 * spacing) - 1.0];
        println!(
            "t = {thickness}: {errors:?} stopped {} pen {} worst kin {worst:.3e} changed {}",
            system.stopped(),
            system.penetration().count,
            before.iter().zip(side(&system)).filter(|(a, b)| **a != *b).count()
        );
    }
}

#[test]
fn zz_debug() {
    let spacing = 0.02;
    for (thickness, rows) in [(0.2, [24, 12]), (1.0, [24, 12]), (1.0, [12, 12]), (2.0, [24, 12])] {
        let mut system = parted(thickness, 16, rows, spacing);
        let mut sums: std::collections::BTreeMap<&str, (f64, f64)> = Default::default();
        let mut n = 0.0;
        advance(&mut system, 1.5, |s| {
            if s.fluid.time < 0.7 {
                return;
            }
            n += 1.0;
            let w = &s.walls;
            for k in 0..w.len() {
                let plate = s.range(0).contains(&k);
                let right = if plate { w.nx[k] > 0.0 } else { w.x[k] > 0.0 };
                let below = w.y[k] < 0.0;
                let name = match (plate, right, below, w.ny[k] > 0.9, w.nx[k].abs() > 0.9) {
                    (true, true, false, ..) => "R plate",
                    (true, true, true, ..) => "R root",
                    (true, false, false, ..) => "L plate",
                    (true, false, true, ..) => "L root",
                    (_, true, _, true, _) => "R floor",
                    (_, false, _, true, _) => "L floor",
                    (_, true, _, _, true) => "R side",
                    (_, false, _, _, true) => "L side",
                    (_, true, ..) => "R corner",
                    (_, false, ..) => "L corner",
                };
                let e = sums.entry(name).or_default();
                e.0 += w.fx[k];
                e.1 += w.fy[k];
            }
        })
        .expect("a stable run");
        println!("thickness {thickness} rows {rows:?}: exact {:?}", rows.map(|r| push(r as f64 * spacing)));
        for (name, (x, y)) in sums {
            println!("  {name}: {:.2} {:.2}", x / n, y / n);
        }
    }
}
