//! A rigid plate on springs, coupled: two masses under the similarity solution's load.

use evidence::systems::{advance, of_text};

/// Force of a wedge of 30° at constant speed, over rho V^3 t (Zhao & Faltinsen 1993, table 1) [-].
const SIMILARITY: f64 = 14.139;
/// Frame and springs, of the whole body [kg/m, N/m²].
const FRAME: f64 = 60.0;
const SPRINGS: f64 = 4e6;

/// Largest deceleration of the frame [m/s²] before `end` [s]: the faces take the momentum ½ C rho z² z' of the water (von Karman's
/// argument with the similarity solution's coefficient C).
fn of_two_masses(faces: f64, speed: f64, end: f64) -> f64 {
    let (dt, steps) = (1e-6, (end / 1e-6) as usize);
    let ([mut z, mut y], [mut rate, mut frame_rate], mut most) = ([0.0_f64; 2], [speed; 2], 0.0_f64);
    for _ in 0..steps {
        let (added, spring) = (0.5 * SIMILARITY * 1000.0 * z * z, SPRINGS * (y - z));
        rate += dt * (spring - SIMILARITY * 1000.0 * z * rate * rate) / (faces + added);
        frame_rate -= dt * spring / FRAME;
        (z, y, most) = (z + dt * rate, y + dt * frame_rate, most.max(spring / FRAME));
    }
    most
}

#[test]
fn a_frame_over_rigid_faces_on_springs_decelerates_like_two_masses() {
    let text = format!(
        "name = \"two\"\nsymmetry = \"x\"\ngravity = [0.0, 0.0]\n[time]\nend = 0.01\n[tank]\nwidth = 1.2\ndepth = 0.5\n\
         [resolution]\nspacing = 0.004\n[body]\nname = \"frame\"\nshape = \"wedge\"\ndeadrise_deg = 30.0\nbreadth = 0.4\n\
         mass = {FRAME}\nvelocity = [0.0, -6.0]\n[[body.panels]]\nname = \"face\"\nfrom = [0.0, 0.0]\nto = [0.2, 0.11547]\n\
         thickness = 0.04\nyoungs_modulus = 1e12\npoissons_ratio = 0.0\ndensity = 800.0\nends = [\"mirror\", \"free\"]\n\
         end_springs = [[{0}, {0}, 0.0], [0.0, 0.0, 0.0]]\n",
        0.5 * SPRINGS
    );
    let mut system = of_text(&text, &[]);
    let mut most = 0.0_f64;
    advance(&mut system, 0.01, |s| {
        let frame = s.bodies().find_map(|body| body.motion()).expect("a frame");
        most = most.max(frame.acceleration[1]);
    })
    .expect("a stable run");
    let expected = of_two_masses(2.0 * 0.04 * 0.2_f64.hypot(0.11547) * 800.0, 6.0, 0.01);
    println!("{most} m/s², of two masses {expected} m/s²");
    assert!((most / expected - 1.0).abs() < 0.04, "{most} m/s² instead of {expected} m/s²");
}
