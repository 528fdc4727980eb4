//! Coarse systems made of the built-in scenes, and the loop that steps them.

use fsi_coupling::{Coupled, CouplingError};
use run::build;
use scene::Scene;

/// A built-in scene with overrides, each as for `--set`.
pub fn scene(name: &str, sets: &[&str]) -> Scene {
    let sets: Vec<String> = sets.iter().map(|set| set.to_string()).collect();
    run::load(name, &sets).expect("a built-in scene with sound overrides").scene
}

/// The same, built and ready to step.
pub fn system(name: &str, sets: &[&str]) -> Coupled {
    build::build(&scene(name, sets)).expect("a scene that loads can be built")
}

/// Step until `end` [s], each step as long as is stable; `watch` gets the system after each.
pub fn advance(system: &mut Coupled, end: f64, mut watch: impl FnMut(&Coupled)) -> Result<(), CouplingError> {
    while system.fluid.time() < end {
        let dt = system.stable_dt()?;
        system.step(dt)?;
        watch(system);
    }
    Ok(())
}

/// Take `steps` stable steps.
pub fn take(system: &mut Coupled, steps: usize) -> Result<(), CouplingError> {
    for _ in 0..steps {
        let dt = system.stable_dt()?;
        system.step(dt)?;
    }
    Ok(())
}

/// Vertical force of the fluid on the first body that moves or could [N/m].
pub fn lift(system: &Coupled) -> f64 {
    system.bodies().find_map(|body| body.motion()).expect("the scene has a body").force[1]
}

/// The system of a scene's text with overrides.
pub fn of_text(text: &str, sets: &[&str]) -> Coupled {
    let sets: Vec<String> = sets.iter().map(|set| set.to_string()).collect();
    let scene = run::load_text("a scene of a test", text, &sets).expect("a sound scene").scene;
    build::build(&scene).expect("a scene that loads can be built")
}
