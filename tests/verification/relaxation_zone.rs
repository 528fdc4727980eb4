//! A relaxation zone makes waves and absorbs those that come back (THEORY WA16): before a wall that sends all of them back, the waves stay what
//! linear theory says.

use evidence::systems::scene;
use run::{RunOptions, run};

/// Waves of 1.5 m, three spacings high, on 0.5 m of water before a wall 3 m behind the zone; places near the wall, half a wavelength before it and
/// at the node between. The beach does nothing.
const WALL: [&str; 6] = [
    "tank.width=5.26",
    "tank.beach={ length = 0.04, rate = 1e-9 }",
    "resolution.spacing=0.02",
    "tank.wave_maker={ height = 0.06, length = 1.5, relaxation = 2.26 }",
    "observe.level=[2.6, 1.88, 2.26]",
    "time.sample_every=0.02",
];

/// Amplitudes [m] near the wall, half a wavelength before it and at the node, in the four periods before `end` [s].
fn amplitudes(end: f64) -> [f64; 3] {
    let end = format!("time.end={end}");
    let sets: Vec<&str> = WALL.iter().copied().chain([end.as_str()]).collect();
    let outcome = run(&scene("wave_maker", &sets), &RunOptions::default()).expect("a run");
    let gauges = outcome.summary.waves.expect("waves of a wave maker").gauges;
    [0, 1, 2].map(|k| 0.5 * gauges[k].height_m)
}

/// The standing wave is twice as high as the waves that arrive, 3 m behind the zone in which they are made, and no higher six periods later.
#[test]
fn waves_before_a_wall_keep_their_height() {
    let (early, late) = (amplitudes(14.0), amplitudes(20.0));
    println!("{early:?} m, later {late:?} m");
    for [wall, before, node] in [early, late] {
        assert!((wall / 0.06 - 1.0).abs() < 0.12 && (before / 0.06 - 1.0).abs() < 0.12, "{wall} {before} m");
        assert!(node < 0.05 * wall, "{node} m at the node");
    }
    assert!((late[0] / early[0] - 1.0).abs() < 0.1, "{} of {} m", late[0], early[0]);
}
