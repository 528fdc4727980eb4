use super::*;

const BOX: [[f64; 2]; 4] = [[-0.2, -0.2], [0.2, -0.2], [0.2, 0.1], [-0.2, 0.1]];
/// A section without symmetry.
const ODD: [[f64; 2]; 5] = [[-0.1, -0.25], [0.15, -0.2], [0.3, 0.1], [-0.2, 0.1], [-0.2, -0.1]];

fn section(outline: &[[f64; 2]], period: f64, depth: f64) -> SectionInWaves {
    SectionInWaves::new(outline, [0.0, -0.05], LinearWave::of_period(period, depth, 9.81), 1000.0, 9.81)
        .expect("through the surface")
}

/// No energy is lost: R² + T² = 1; added mass and damping are symmetric.
#[test]
fn energy_and_reciprocity_hold() {
    for outline in [&BOX[..], &ODD] {
        for (period, depth) in [(0.7, 1.0), (1.0, 0.6), (1.5, 1.0), (1.2, 5.0)] {
            let s = section(outline, period, depth);
            let kept = s.reflected.powi(2) + s.transmitted.powi(2);
            assert!((kept - 1.0).abs() < 0.01, "T = {period} s, d = {depth} m: {kept}");
            for (table, name) in [(s.added_mass, "added mass"), (s.damping, "damping")] {
                let scale = |j: usize, k: usize| (table[j][j] * table[k][k]).abs().sqrt().max(1e-3 * table[0][0]);
                for (j, k) in [(0, 1), (0, 2), (1, 2)] {
                    let gap = (table[j][k] - table[k][j]).abs() / scale(j, k);
                    assert!(gap < 0.02, "{name} {j}{k}: {} {}", table[j][k], table[k][j]);
                }
            }
        }
    }
}

/// Haskind's relation of a symmetric section: the damping is that of the waves that it makes, B = |X|²/(2ρg c_g).
#[test]
fn damping_is_that_of_haskind() {
    for (period, depth) in [(0.8, 1.0), (1.1, 1.0), (1.4, 0.6)] {
        let s = section(&BOX, period, depth);
        for j in [0, 1] {
            let x = s.excitation[j];
            let haskind = (x[0] * x[0] + x[1] * x[1]) / (2.0 * 1000.0 * 9.81 * s.wave.group_speed());
            assert!(
                (s.damping[j][j] / haskind - 1.0).abs() < 0.02,
                "T = {period} s, direction {j}: {} {haskind}",
                s.damping[j][j]
            );
        }
    }
}

/// In waves much longer than the section the load is that of the pressure at rest, ρgb a, and it rides on them; beyond heave resonance it
/// stays behind.
#[test]
fn long_waves_carry_the_section() {
    let s = section(&BOX, 6.0, 1.0);
    let heave = s.excitation[1][0].hypot(s.excitation[1][1]);
    assert!((heave / (1000.0 * 9.81 * 0.4) - 1.0).abs() < 0.06, "{heave}");
    let none = [[0.0; 3]; 3];
    let ridden = s.motion([80.0, 2.0], [false, true, false], none, none);
    assert!((ridden[1] - 1.0).abs() < 0.06 && ridden[0] == 0.0, "{ridden:?}");
    let behind = section(&BOX, 0.7, 1.0).motion([80.0, 2.0], [false, true, false], none, none);
    assert!(behind[1] < 0.2, "{behind:?}");
}

/// Roll stiffness of a box at its draught: ρg (b³/12 + S (y_B − y_G)).
#[test]
fn a_box_rights_itself_as_archimedes_says() {
    let s = section(&BOX, 1.0, 1.0);
    let exact = 1000.0 * 9.81 * (0.4_f64.powi(3) / 12.0 + 0.08 * (-0.1 + 0.05));
    assert!((s.stiffness[2][2] / exact - 1.0).abs() < 1e-12 && (s.stiffness[1][1] - 3924.0).abs() < 1e-9);
    assert!((s.area - 0.08).abs() < 1e-15 && s.lever.abs() < 1e-15);
    let odd = section(&ODD, 1.0, 1.0);
    let wet = [[-0.1, -0.25], [0.15, -0.2], [0.25, 0.0], [-0.2, 0.0], [-0.2, -0.1]];
    let n = wet.len();
    let sum = |f: &dyn Fn([f64; 2], [f64; 2]) -> f64| (0..n).map(|i| f(wet[i], wet[(i + 1) % n])).sum::<f64>();
    let area = 0.5 * sum(&|a, b| a[0] * b[1] - b[0] * a[1]);
    let x = sum(&|a, b| (a[0] + b[0]) * (a[0] * b[1] - b[0] * a[1])) / (6.0 * area);
    assert!((odd.area - area).abs() < 1e-14 && (odd.lever - x).abs() < 1e-14, "{} {}", odd.area, odd.lever);
}

#[test]
fn what_is_not_half_in_the_water_has_no_answer() {
    let wave = LinearWave::of_period(1.0, 1.0, 9.81);
    let at = |dy: f64| BOX.map(|[x, y]| [x, y + dy]);
    for outline in [at(0.5), at(-0.5), at(-0.9).map(|[x, y]| [x, y.max(-1.2)])] {
        assert!(SectionInWaves::new(&outline, [0.0; 2], wave, 1000.0, 9.81).is_none());
    }
}
