//! Supports of the ends of a chain.

use std::collections::BTreeMap;

use super::CardError;
use super::axes::Axes;
use super::model::BeamModel;

/// What holds an end: along the first axis, along the second one, in rotation; and whether it slides along the bar.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Held {
    /// First axis, second axis, rotation.
    pub fixed: [bool; 3],
    /// The bar does not transmit its normal force to the end.
    pub slides: bool,
}

/// What holds the ends of a chain; supports between its ends are refused.
pub(super) fn ends(
    model: &BeamModel,
    axes: Axes,
    nodes: &[i64],
    order: &[(usize, bool)],
) -> Result<Option<[Held; 2]>, CardError> {
    let mut held: BTreeMap<i64, [bool; 3]> = BTreeMap::new();
    let in_plane = [axes.0[0] + 1, axes.0[1] + 1, axes.normal() + 4];
    let mut hold = |id: i64, components: &str| {
        let fixed = in_plane.map(|component| components.contains(&component.to_string()));
        let all = held.entry(id).or_default();
        all.iter_mut().zip(fixed).for_each(|(sum, fixed)| *sum |= fixed);
        fixed != [false; 3]
    };
    let within = &nodes[1..nodes.len() - 1];
    let refuse = |line: usize, id: i64| {
        let given = format!("a support at GRID {id}, between the ends of the chain");
        let expected = format!("supports in the {} plane at its ends only", axes.name());
        Err(CardError::new(line, given, expected))
    };
    let mut first_set = None;
    for constraint in &model.constraints {
        let (first, line) = *first_set.get_or_insert((constraint.set, constraint.line));
        if first != constraint.set {
            let given = format!("a second set of constraints, {}", constraint.set);
            return Err(CardError::new(constraint.line, given, format!("one set, {first} as in line {line}")));
        }
        for id in &constraint.grids {
            if hold(*id, &constraint.components) && within.contains(id) {
                return refuse(constraint.line, *id);
            }
        }
    }
    for grid in model.grids.iter().filter(|grid| nodes.contains(&grid.id)) {
        if hold(grid.id, &grid.held) && within.contains(&grid.id) {
            return refuse(grid.line, grid.id);
        }
    }
    let last = nodes.len() - 1;
    let mut slides = [false; 2];
    for (k, (bar, reversed)) in order.iter().enumerate() {
        let bar = &model.bars[*bar];
        for (end, released) in bar.released.iter().enumerate().filter(|(_, released)| !released.is_empty()) {
            // the node of the chain at this end of the bar
            let node = if (end == 1) != *reversed { k + 1 } else { k };
            let of_chain = [0, last].iter().position(|place| *place == node).filter(|_| released == "1");
            let Some(of_chain) = of_chain else {
                let given = format!("pin flags {released} of CBAR {}", bar.id);
                return Err(CardError::new(
                    bar.line,
                    given,
                    "none, or 1 at an end of the chain, which slides along it",
                ));
            };
            slides[of_chain] = true;
        }
    }
    if first_set.is_none() && held.values().all(|fixed| *fixed == [false; 3]) {
        return Ok(None);
    }
    let of = |node: usize, slides: bool| Held { fixed: held.get(&nodes[node]).copied().unwrap_or_default(), slides };
    Ok(Some([of(0, slides[0]), of(last, slides[1])]))
}
