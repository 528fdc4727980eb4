//! Two hulls side by side: with their mirror images between walls they are one hull beside a wall.

use evidence::systems::scene;
use run::{RunOptions, load_text, run};
use scene::Scene;
use scene::vocabulary::ResultName;

/// Middle of the right wedge in the scene [m].
const ASIDE: f64 = 0.3;

/// Impulse on the body that results are of, and that of its force to the right [N s/m].
fn loads(scene: &Scene) -> [f64; 2] {
    let outcome = run(scene, &RunOptions::default()).expect("a run");
    let impulse = outcome.summary.results.get(ResultName::Impulse).expect("an impulse").value;
    let (times, sideways) = (outcome.series.times(), outcome.series.column("right.fx_N_per_m").expect("a column"));
    let side = times.windows(2).zip(sideways.windows(2)).map(|(t, f)| 0.5 * (t[1] - t[0]) * (f[0] + f[1])).sum();
    [impulse, side]
}

/// One wedge of the twins, at a place x in a tank of a width [m], with the twins' depth.
fn one(twins: &Scene, x: f64, width: f64) -> Scene {
    let text = format!(
        "name = \"one\"\n[time]\nend = {:?}\n[resolution]\nspacing = {:?}\n[tank]\nwidth = {width:?}\ndepth = {:?}\n\
         [body]\nname = \"right\"\nshape = \"wedge\"\ndeadrise_deg = 25.0\nbreadth = 0.4\nside_height = 0.2\nposition = [{x:?}, 0.0]\n\
         motion = \"constant_velocity\"\nvelocity = [0.0, -3.0]\n",
        twins.time.end, twins.resolution.spacing, twins.tank.depth
    );
    load_text("one.toml", &text, &[]).expect("a scene").scene
}

/// At default settings twins have the impulse of one wedge as far from a wall as from the plane between them, which is 10 % more than that of one
/// alone. Without a fine zone that follows both it was 4 % off here.
#[test]
fn twin_wedges_are_one_wedge_beside_a_wall() {
    let twins = scene("twin_wedges", &["resolution.spacing=0.006"]);
    assert!(twins.resolution.follow);
    let half = 0.5 * twins.tank.width;
    let [impulse, side] = loads(&twins);
    let [beside_wall, side_of_wall] = loads(&one(&twins, ASIDE - 0.5 * half, half));
    let [alone, _] = loads(&one(&twins, 0.0, twins.tank.width));
    assert!((impulse / beside_wall - 1.0).abs() < 0.02, "{impulse} {beside_wall}");
    assert!((side - side_of_wall).abs() < 0.02 * impulse, "{side} {side_of_wall}");
    assert!(impulse > 1.08 * alone, "{impulse} {alone}");
}

/// The twins are each other's image in their impulses; in single steps particles that are halved differ from their images (WC21).
#[test]
fn twin_wedges_have_the_same_impulse_and_push_each_other_apart_equally() {
    let outcome = run(&scene("twin_wedges", &["resolution.spacing=0.006"]), &RunOptions::default()).expect("a run");
    let times = outcome.series.times();
    let impulse = |name: &str| {
        let forces = outcome.series.column(name).expect("a column");
        times.windows(2).zip(forces.windows(2)).map(|(t, f)| 0.5 * (t[1] - t[0]) * (f[0] + f[1])).sum::<f64>()
    };
    let [right, left] = ["right.fy_N_per_m", "left.fy_N_per_m"].map(impulse);
    assert!((left / right - 1.0).abs() < 0.02, "{left} {right}");
    let [outwards, inwards] = ["right.fx_N_per_m", "left.fx_N_per_m"].map(impulse);
    assert!(outwards > 0.0 && (outwards + inwards).abs() < 0.01 * right, "{outwards} {inwards}");
}
