//! Courant numbers at which each integrator breaks down; a scene with such a number is refused (THEORY WC16).

use evidence::systems::advance;
use run::build;

/// Whether a scene runs to `end` [s] with a Courant number that scenes refuse.
fn ran(name: &str, spacing: &str, end: f64, integrator: &str, cfl: f64) -> bool {
    let cfl = format!("fluid.cfl={cfl}");
    let every = integrator.ends_with("verlet").then_some("fluid.verlet_correction_every=2");
    let sets = [spacing, integrator, &cfl].into_iter().chain(every).map(String::from).collect::<Vec<_>>();
    let scene = run::load_beyond_limits(name, &sets).expect("a built-in scene").scene;
    let mut system = build::build(&scene).expect("a scene that loads can be built");
    advance(&mut system, end, |_| ()).is_ok()
}

fn dam_break(integrator: &str, cfl: f64) -> bool {
    ran("dam_break", "resolution.spacing=0.06", 0.9, integrator, cfl)
}

fn wedge(integrator: &str, cfl: f64) -> bool {
    ran("wedge_constant", "resolution.spacing=0.1", 0.6, integrator, cfl)
}

/// Failure: at the Courant number from which a scene is refused, each integrator breaks down. Remedy: 0.2 to 0.3 less.
/// Verlet's has an Euler step every other step here, the most that helps it.
#[test]
fn each_integrator_breaks_down_at_the_courant_number_that_is_refused() {
    for (name, refused, runs) in
        [("symplectic", 1.2, 1.0), ("predictor_corrector", 1.2, 1.0), ("beeman", 1.4, 1.2), ("verlet", 0.7, 0.5)]
    {
        let integrator = format!("fluid.integrator={name}");
        let column = name != "verlet";
        let run = |cfl: f64| if column { dam_break(&integrator, cfl) } else { wedge(&integrator, cfl) };
        assert!(!run(refused), "{name} ran at C = {refused}");
        assert!(run(runs), "{name} broke down at C = {runs}");

        let load = |cfl: f64| run::load("dam_break", &[integrator.clone(), format!("fluid.cfl={cfl}")]);
        let message = load(refused).expect_err("refused").to_string();
        assert!(message.contains(&format!("below {refused}, where {name} breaks down")), "{message}");
        assert!(load(refused - 0.01).is_ok(), "{name}: {} is refused", refused - 0.01);
    }
}
