//! Particles that turn from surface to inside and back from step to step (THEORY PR5): the state that a projection depends on.

use std::collections::HashMap;

use evidence::systems::{advance, system};

/// Share of the particles at the free surface that change their state in a step, and that change it back in the next [-].
fn changes(sets: &[&str], end: f64) -> [f64; 2] {
    let mut wedge = system("wedge_constant", sets);
    let mut before: [HashMap<u32, bool>; 2] = Default::default();
    let (mut exposed, mut changed, mut back) = (0, 0, 0);
    advance(&mut wedge, end, |s| {
        let (ids, exposure) = (&s.fluid.particles().id, s.fluid.surface_indicator());
        let now: HashMap<u32, bool> = ids.iter().zip(exposure).map(|(&id, &e)| (id, e > 0.5)).collect();
        let [last, earlier] = &before;
        exposed += now.values().filter(|&&exposed| exposed).count();
        for (id, state) in &now {
            if last.get(id).is_some_and(|was| was != state) {
                changed += 1;
                back += usize::from(earlier.get(id) == Some(state));
            }
        }
        let [last, _] = std::mem::take(&mut before);
        before = [now, last];
    })
    .expect("a stable run");
    assert!(exposed > 0, "no particle was ever at the free surface");
    [changed, back].map(|count| count as f64 / exposed as f64)
}

/// A wedge goes through the surface: of the particles at the free surface few turn inside in a step, and hardly one turns back in the
/// next. (A state that flickers puts a particle's pressure on and off.)
#[test]
fn few_particles_change_between_surface_and_inside_from_step_to_step() {
    let sets = ["solver=incompressible", "fluid.cfl=0.2", "fluid.artificial_viscosity=0", "resolution.spacing=0.04"];
    let [changed, back] = changes(&sets, 0.6);
    println!(
        "a step changes {:.3} % of the particles at the free surface, {:.3} % back from the step before",
        100.0 * changed,
        100.0 * back
    );
    assert!(changed < 0.03, "{changed}");
    assert!(back < 0.01, "{back}");
}
