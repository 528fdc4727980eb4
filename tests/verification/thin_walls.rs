//! Thin walls (THEORY T1–T5): plates of any thickness, wet on both sides.

use evidence::plates::{DENSITY, GRAVITY, face_forces, parted};
use evidence::statistics::mean;
use evidence::systems::advance;

/// ½ρgh² [N/m].
fn push(height: f64) -> f64 {
    0.5 * DENSITY * GRAVITY * height * height
}

#[test]
fn zz_submerged() {
    use evidence::plates::Submerged;
    use fsi_coupling::*;
    for (thickness, turned) in
        [(0.2, 0.0), (1.0, 0.0), (0.2, 1.5707963), (0.2, 0.6), (1.0, 0.6), (2.5, 0.6), (8.0, 0.6)]
    {
        let plate = Submerged { thickness, cells: 12.0, turned, spacing: 0.02 };
        let law = PrescribedBody::steady(plate.middle(), 0.0, [0.0; 2], 0.0);
        let mut system = plate.with(Box::new(PrescribedBody::new("plate", plate.outline(), false, law)), 30.0);
        let (mut fx, mut fy, mut kin, mut m) = (vec![], vec![], 0.0_f64, vec![]);
        advance(&mut system, 3.0, |s| {
            let f = s.bodies().next().unwrap().motion().unwrap();
            if s.fluid.time > 1.0 {
                fx.push(f.force[0]);
                fy.push(f.force[1]);
                m.push(f.moment);
                kin = s.fluid_energy().kinetic;
            }
            if s.fluid.steps % 1500 == 0 {
                println!(
                    "   {:.2} {:?} {:.2e} top {:.3}",
                    s.fluid.time,
                    f.force,
                    s.fluid_energy().kinetic,
                    s.fluid.top_speed()
                );
            }
        })
        .expect("stable");
        let one = DENSITY * GRAVITY * 12.0 * 0.02 * 12.0 * 0.02;
        println!(
            "t {thickness} turned {turned}: fx {:.3} fy {:.3} m {:.4} buoyancy {:.3} one face {one:.2} kin {kin:.2e} stopped {} pen {} mom {:.1e}",
            mean(&fx),
            mean(&fy),
            mean(&m),
            DENSITY * GRAVITY * thickness * 12.0 * 0.0004,
            system.stopped(),
            system.penetration().count,
            system.momentum_audit().worst
        );
    }
}
