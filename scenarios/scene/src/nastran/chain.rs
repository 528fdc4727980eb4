//! A chain of bars in a plane, with properties of a metre of span.

use std::collections::BTreeMap;

use super::CardError;
use super::axes::Axes;
use super::model::{Bar, BeamModel, Grid, Isotropic, Orientation, Property};
use super::supports::{Held, ends};

/// Most bars of a chain.
const MOST: usize = 2000;
/// Distance from the plane over the extent of the model below which a grid point lies in it [-].
const IN_PLANE: f64 = 1e-6;
/// Largest sine of the angle between a bar's first plane and that of the model, or its normal [-].
const TWISTED: f64 = 1e-3;
/// Shear factor of a rectangle [-], and how near one must be to it.
const RECTANGLE: [f64; 2] = [5.0 / 6.0, 1e-3];

/// How to read a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    /// Its plane.
    pub axes: Axes,
    /// Its unit of length [m], and of mass [kg]; time is in seconds.
    pub units: [f64; 2],
    /// Span that a bar stands for [m].
    pub width: f64,
}

/// A bar of a chain, from its first node to its second; of a metre of span.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChainBar {
    /// Young's modulus [Pa].
    pub youngs_modulus: f64,
    /// Shear modulus [Pa].
    pub shear_modulus: f64,
    /// Mass over length and area [kg/m³].
    pub density: f64,
    /// Area [m²/m].
    pub area: f64,
    /// Second moment of area [m⁴/m].
    pub second_moment: f64,
    /// Outer fibres to the left of the axis: the right one, the left one [m].
    pub fibres: [f64; 2],
    /// Allowable stress [Pa].
    pub allowable_stress: Option<f64>,
    /// With shear.
    pub shears: bool,
    /// Line of its card.
    pub line: usize,
}

/// A node of a chain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChainNode {
    /// Number of its grid point.
    pub id: i64,
    /// Where it is [m].
    pub at: [f64; 2],
    /// Line of its card.
    pub line: usize,
}

/// Nodes and the bars between them.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    /// Nodes in order.
    pub nodes: Vec<ChainNode>,
    /// Bars in order.
    pub bars: Vec<ChainBar>,
    /// What holds its ends; `None` where the file has no constraints.
    pub ends: Option<[Held; 2]>,
}

/// The bars of a grid point, and the walk along them.
struct Walk<'a> {
    grids: BTreeMap<i64, &'a Grid>,
    bars_at: BTreeMap<i64, Vec<usize>>,
}

/// Grid points in order, and bars with whether they run against it.
type Order = (Vec<i64>, Vec<(usize, bool)>);

impl Chain {
    /// The chain of all bars of a model.
    ///
    /// # Errors
    /// A card that is missing, a bar out of the plane, a chain that branches or is not one.
    pub fn of(model: &BeamModel, reading: &Reading) -> Result<Chain, CardError> {
        let walk = Walk::new(model)?;
        walk.check_plane(model, reading.axes)?;
        let (nodes, order) = walk.order(model)?;
        let [length, _] = reading.units;
        let node = |id: &i64| {
            let Grid { at, line, .. } = *walk.grids[id];
            ChainNode { id: *id, at: reading.axes.of(at).map(|value| length * value), line }
        };
        let bars = order.iter().map(|(k, reversed)| chain_bar(model, &walk, &model.bars[*k], *reversed, reading));
        let bars = bars.collect::<Result<Vec<_>, _>>()?;
        let ends = ends(model, reading.axes, &nodes, &order)?;
        Ok(Chain { nodes: nodes.iter().map(node).collect(), bars, ends })
    }

    /// The chain from its other end.
    pub fn reversed(mut self) -> Chain {
        self.nodes.reverse();
        self.bars.reverse();
        for bar in &mut self.bars {
            let [right, left] = bar.fibres;
            bar.fibres = [0.0 - left, 0.0 - right]; // no -0
        }
        self.ends = self.ends.map(|[first, last]| [last, first]);
        self
    }
}

impl<'a> Walk<'a> {
    fn new(model: &'a BeamModel) -> Result<Walk<'a>, CardError> {
        let grids: BTreeMap<i64, &Grid> = model.grids.iter().map(|grid| (grid.id, grid)).collect();
        let mut bars_at: BTreeMap<i64, Vec<usize>> = BTreeMap::new();
        for (k, bar) in model.bars.iter().enumerate() {
            for id in bar.grids {
                if !grids.contains_key(&id) {
                    let given = format!("grid point {id} of CBAR {}", bar.id);
                    return Err(CardError::new(bar.line, given, format!("a card GRID {id}")));
                }
                let at = bars_at.entry(id).or_default();
                at.push(k);
                if at.len() > 2 {
                    let given = format!("a third bar at grid point {id}");
                    return Err(CardError::new(bar.line, given, "a chain: at most two bars at a grid point"));
                }
            }
            let [a, b] = bar.grids.map(|id| grids[&id].at);
            if a == b {
                let given = format!("CBAR {} of length 0", bar.id);
                return Err(CardError::new(bar.line, given, "two grid points that are apart"));
            }
        }
        match model.bars.len() {
            2..=MOST => Ok(Walk { grids, bars_at }),
            count => {
                let line = model.bars.last().map_or(model.lines, |bar| bar.line);
                Err(CardError::new(line, format!("{count} CBAR"), format!("a chain of 2 to {MOST} CBAR")))
            }
        }
    }

    /// All grid points of bars lie in a plane.
    fn check_plane(&self, model: &BeamModel, axes: Axes) -> Result<(), CardError> {
        let third = axes.normal();
        let used = || self.bars_at.keys().map(|id| self.grids[id]);
        let extent = |k: usize| {
            let values = used().map(|grid| grid.at[k]);
            values.clone().fold(f64::MIN, f64::max) - values.fold(f64::MAX, f64::min)
        };
        let size = (0..3).map(extent).fold(0.0, f64::max);
        let first = self.grids[&model.bars[0].grids[0]];
        match used().find(|grid| (grid.at[third] - first.at[third]).abs() > IN_PLANE * size) {
            Some(grid) => {
                let name = ["x", "y", "z"][third];
                let given = format!("{name} = {} at GRID {}", grid.at[third], grid.id);
                let expected = format!(
                    "{name} = {} as at GRID {}: a model in the {} plane; structure_plane names another one",
                    first.at[third],
                    first.id,
                    axes.name()
                );
                Err(CardError::new(grid.line, given, expected))
            }
            None => Ok(()),
        }
    }

    /// The order of the chain, from the end that comes first in the file.
    fn order(&self, model: &BeamModel) -> Result<Order, CardError> {
        let ends = self.bars_at.iter().filter(|(_, bars)| bars.len() == 1).map(|(id, _)| *id);
        let Some(start) = ends.min_by_key(|id| self.grids[id].line) else {
            let line = model.bars[0].line;
            return Err(CardError::new(line, "a ring of bars", "a chain with two ends"));
        };
        let (mut nodes, mut order) = (vec![start], Vec::new());
        let mut taken = vec![false; model.bars.len()];
        let mut at = start;
        while let Some(k) = self.bars_at[&at].iter().copied().find(|k| !taken[*k]) {
            taken[k] = true;
            let [a, b] = model.bars[k].grids;
            order.push((k, a != at));
            at = if a == at { b } else { a };
            nodes.push(at);
        }
        match taken.iter().position(|taken| !taken) {
            Some(k) => {
                let bar = &model.bars[k];
                let given = format!("CBAR {}, which is not joined to the bars at GRID {start}", bar.id);
                Err(CardError::new(bar.line, given, "one chain of bars"))
            }
            None => Ok((nodes, order)),
        }
    }
}

/// The card that a bar names.
fn named<'a, T>(bar: &Bar, what: &str, id: i64, found: Option<&'a T>) -> Result<&'a T, CardError> {
    let given = || format!("{what} {id} of CBAR {}", bar.id);
    found.ok_or_else(|| CardError::new(bar.line, given(), format!("a card {what} {id}")))
}

fn chain_bar(
    model: &BeamModel,
    walk: &Walk,
    bar: &Bar,
    reversed: bool,
    reading: &Reading,
) -> Result<ChainBar, CardError> {
    let property: &Property =
        named(bar, "PBAR, PBARL or PBEAM", bar.property, model.properties.iter().find(|p| p.id == bar.property))?;
    let id = property.material;
    let material: &Isotropic = match model.materials.iter().find(|material| material.id == id) {
        Some(material) => material,
        None => {
            let given = format!("MAT1 {id} of PBAR {}", property.id);
            return Err(CardError::new(property.line, given, format!("a card MAT1 {id}")));
        }
    };
    let (plane, left) = first_plane(walk, bar, reading.axes)?;
    let second_moment = property.second_moments[plane];
    let wrong = |given: String, expected: &str| Err(CardError::new(property.line, given, expected));
    if second_moment == 0.0 {
        let given = format!("I{} = 0 of PBAR {}", plane + 1, property.id);
        return wrong(given, "a second moment of area above 0 for bending in the plane of the model");
    }
    let density = material.density + property.extra_mass / property.area;
    if density == 0.0 {
        let given = format!("PBAR {} without mass", property.id);
        return wrong(given, "RHO of its MAT1, or NSM, above 0");
    }
    let shear = property.shear_factors[plane];
    if shear != 0.0 && (shear - RECTANGLE[0]).abs() > RECTANGLE[1] {
        let given = format!("K{} = {shear} of PBAR {}", plane + 1, property.id);
        return wrong(given, "nothing, without shear, or 0.8333, with that of a rectangle");
    }
    // without places for stresses, a rectangle of the same area and second moment
    let places = property.stress_points.map(|point| left * point[plane]);
    let (low, high) = (places.into_iter().fold(0.0, f64::min), places.into_iter().fold(0.0, f64::max));
    let half = 0.5 * (12.0 * second_moment / property.area).sqrt();
    let [low, high] = if low == high { [-half, half] } else { [low, high] };
    let [low, high] = if reversed { [0.0 - high, 0.0 - low] } else { [low, high] };
    let [length, mass] = reading.units;
    let (stress, width) = (mass / length, reading.width);
    Ok(ChainBar {
        youngs_modulus: stress * material.youngs_modulus,
        shear_modulus: stress * material.shear_modulus,
        density: mass / length.powi(3) * density,
        area: length.powi(2) * property.area / width,
        second_moment: length.powi(4) * second_moment / width,
        fibres: [length * low, length * high],
        allowable_stress: material.allowable_stress.map(|limit| stress * limit),
        shears: shear != 0.0,
        line: bar.line,
    })
}

/// Which of a bar's planes is that of the model, 0 or 1, and whether coordinates in it count to the left, 1, or to the right, -1.
fn first_plane(walk: &Walk, bar: &Bar, axes: Axes) -> Result<(usize, f64), CardError> {
    let [a, b] = bar.grids.map(|id| walk.grids[&id].at);
    let vector = match bar.orientation {
        Orientation::Vector(vector) => vector,
        Orientation::Grid(id) => match walk.grids.get(&id) {
            Some(grid) => [0, 1, 2].map(|k| grid.at[k] - a[k]),
            None => {
                let given = format!("grid point {id} of CBAR {}", bar.id);
                return Err(CardError::new(bar.line, given, format!("a card GRID {id}")));
            }
        },
    };
    let along = [0, 1, 2].map(|k| b[k] - a[k]);
    let size = along.iter().map(|x| x * x).sum::<f64>().sqrt();
    let share = (0..3).map(|k| vector[k] * along[k]).sum::<f64>() / (size * size);
    let across = [0, 1, 2].map(|k| vector[k] - share * along[k]);
    let length = across.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length <= TWISTED * vector.iter().map(|x| x * x).sum::<f64>().sqrt() {
        let given = format!("an orientation of CBAR {} along the bar, or none", bar.id);
        return Err(CardError::new(bar.line, given, "a vector across the bar"));
    }
    let ([x, y], [u, v]) = (axes.of(along), axes.of(across));
    let (to_left, out) = ((x * v - y * u) / (size * length), axes.sign() * across[axes.normal()] / length);
    match (out.abs() <= TWISTED, to_left.abs() <= TWISTED) {
        (true, _) => Ok((0, to_left.signum())),
        // the second direction of a bar is the bar × the first one
        (_, true) => Ok((1, -out.signum())),
        _ => {
            let given = format!("an orientation of CBAR {} oblique to the {} plane", bar.id, axes.name());
            Err(CardError::new(bar.line, given, "a vector in the plane or across it: bending in one plane"))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SI: [f64; 2] = [1.0, 1.0];

    fn fibres(axes: [usize; 2], second: [f64; 3], orientation: &str, card: &str) -> [f64; 2] {
        let [x, y, z] = second;
        let text = format!(
            "GRID,1,,0.,0.,0.\nGRID,2,,{x:?},{y:?},{z:?}\nGRID,3,,{:?},{:?},{:?}\nCBAR,1,1,{card},{orientation}\nCBAR,2,1,2,3,{orientation}\n\
             PBAR,1,1,.1,1.-4,2.-4\n,.03,.03,-.01,-.01\nMAT1,1,7.+10,,.3,2700.\n",
            2.0 * x,
            2.0 * y,
            2.0 * z
        );
        let model = BeamModel::read(&text).expect("a model");
        let chain = Chain::of(&model, &Reading { axes: Axes(axes), units: SI, width: 1.0 }).expect("a chain");
        chain.bars[0].fibres
    }

    /// Of a section with the flange 0.03 to one side and the foot 0.01 to the other: by orientation, plane and direction of the card.
    #[test]
    fn fibres_lie_on_the_side_that_the_orientation_says() {
        let (left, right) = ([-0.01, 0.03], [-0.03, 0.01]);
        let x = [1.0, 0.0, 0.0];
        for (orientation, expected) in
            [("0.,1.,0.", left), ("0.,-1.,0.", right), ("0.,0.,1.", right), ("0.,0.,-1.", left)]
        {
            assert_eq!(fibres([0, 1], x, orientation, "1,2"), expected, "{orientation}");
        }
        // the first direction is that of the vector, whichever way the bar runs; the second one turns with the bar
        assert_eq!(fibres([0, 1], x, "0.,1.,0.", "2,1"), left);
        assert_eq!(fibres([0, 1], x, "0.,0.,1.", "2,1"), left);
        assert_eq!(fibres([0, 2], x, "0.,0.,1.", "1,2"), left);
        assert_eq!(fibres([0, 2], x, "0.,1.,0.", "1,2"), left);
        assert_eq!(fibres([1, 2], [0.0, 1.0, 0.0], "0.,0.,1.", "1,2"), left);
        assert_eq!(fibres([1, 2], [0.0, 1.0, 0.0], "1.,0.,0.", "1,2"), right);
    }

    #[test]
    fn units_and_width_scale_to_a_metre_of_span() {
        let text = "GRID,1,,0.,0.,0.\nGRID,2,,100.,0.,0.\nGRID,3,,200.,0.,0.\nCBAR,1,1,1,2,0.,1.,0.\nCBAR,2,1,2,3,0.,1.,0.\n\
                    PBAR,1,1,1500.,1125.,,,2.-6\nMAT1,1,70000.,,.3,2.7-9\n";
        let model = BeamModel::read(text).expect("a model");
        let chain =
            Chain::of(&model, &Reading { axes: Axes([0, 1]), units: [1e-3, 1e3], width: 0.5 }).expect("a chain");
        let bar = chain.bars[0];
        let near = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-12, "{a} {b}");
        near(bar.youngs_modulus, 7e10);
        near(bar.area, 3e-3);
        near(bar.second_moment, 2.25e-9);
        near(bar.density, 2700.0 + 2e-6 / 1500.0 * 1e12);
        near(bar.fibres[1], 1.5e-3);
        near(chain.nodes[2].at[0], 0.2);
        assert_eq!(chain.clone().reversed().reversed(), chain);
        assert_eq!(chain.ends, None);
    }
}
