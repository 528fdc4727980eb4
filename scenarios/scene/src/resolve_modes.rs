//! What `body.modal` must be.

use fsi_coupling::Shape;
use settings::{Problem, require, significant};

use super::keys::{Modes, Symmetry, line};

/// Nodes and modes, at most.
const MOST: [usize; 2] = [2000, 100];
/// Distance of a node from the body's line over the length of the chain, at most [-].
const FARTHEST: f64 = 0.1;
/// What the nodes' masses carry in a mode over its generalised mass, at most: of lumped and consistent masses [-].
const CARRIED: f64 = 1.25;

/// Refuses modes that do not fit the body's line, or each other.
pub(super) fn check_modes(modal: &Modes, shape: &Shape, symmetry: Symmetry) -> Result<(), Problem> {
    let (line, count) = (line(shape), modal.nodes.len());
    let nodes = "body.modal.nodes";
    require((2..=MOST[0]).contains(&count), nodes, format_args!("{count} nodes"), "2 to 2000 nodes")?;
    let (found, modes) = (modal.modes.len(), "body.modal.modes");
    require((1..=MOST[1]).contains(&found), modes, format_args!("{found} modes"), "1 to 100 modes")?;
    let length: f64 = modal.nodes.windows(2).map(|n| (n[1][0] - n[0][0]).hypot(n[1][1] - n[0][1])).sum();
    let mut along = Vec::new();
    for (k, at) in modal.nodes.iter().enumerate() {
        let key = format!("{nodes}[{k}]");
        let (s, away) = line.nearest(*at);
        let farthest = FARTHEST * length;
        let expected = format_args!(
            "a place at most {} m from the body's line, in its frame; this is {} m away",
            significant(farthest),
            significant(away)
        );
        require(away <= farthest, &key, format_args!("{at:?}"), expected)?;
        let expected = "x >= 0 with symmetry = \"x\": the modes are those of this half";
        require(symmetry != Symmetry::X || at[0] >= -farthest, &key, format_args!("{at:?}"), expected)?;
        along.push(s);
    }
    let whole = line.length();
    for (k, pair) in along.windows(2).enumerate() {
        let step = pair[1] - pair[0];
        let step = if line.is_closed() { step - whole * (step / whole).round() } else { step };
        let expected = "nodes in the order of the body's line, counter-clockwise along an outline";
        require(step > 0.0, &format!("{nodes}[{}]", k + 1), format_args!("{:?}", modal.nodes[k + 1]), expected)?;
    }
    let counted = |key: &str, found: usize| {
        require(found == count, key, format_args!("{found} entries"), format_args!("{count}, one for each node"))
    };
    if !modal.masses.is_empty() {
        counted("body.modal.masses", modal.masses.len())?;
    }
    for (k, mode) in modal.modes.iter().enumerate() {
        let key = |name: &str| format!("{modes}[{k}].{name}");
        counted(&key("shape"), mode.shape.len())?;
        if !mode.stress.is_empty() {
            counted(&key("stress"), mode.stress.len())?;
        }
        let all = mode.stress.is_empty() == modal.modes[0].stress.is_empty();
        require(all, &key("stress"), "absent or given", "stress in all modes, or in none")?;
        let masses = modal.all_masses();
        let carried: f64 = masses.iter().zip(&mode.shape).map(|(m, [u, v, _])| m * (u * u + v * v)).sum();
        let expected = format_args!(
            "at least the {} kg/m that body.modal.masses carry in its shape: masses and generalised mass of the same span",
            significant(carried)
        );
        require(carried <= CARRIED * mode.mass, &key("mass"), mode.mass, expected)?;
    }
    Ok(())
}
