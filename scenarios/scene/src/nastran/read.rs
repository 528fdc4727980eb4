//! From cards to a beam model.

use std::collections::BTreeMap;

use super::CardError;
use super::cards::{Card, cards};
use super::model::{Bar, BeamModel, Constraint, Grid, Isotropic, Orientation, Property};
use super::pbeam::property_of_beam;
use super::sections::property_of_shape;

/// Cards that do not change the structure: loads, which are the water's here, and what controls the solution.
const WITHOUT_EFFECT: [&str; 29] = [
    "PARAM", "EIGR", "EIGRL", "EIGB", "FORCE", "FORCE1", "FORCE2", "MOMENT", "LOAD", "PLOAD", "PLOAD1", "PLOAD2",
    "PLOAD4", "GRAV", "ACCEL", "DAREA", "DLOAD", "TLOAD1", "TLOAD2", "TABLED1", "TABLED2", "TSTEP", "TSTEPNL",
    "NLPARM", "TEMPD", "TABDMP1", "MDLPRM", "SPCADD", "RLOAD1",
];

impl BeamModel {
    /// Reads a bulk data file, or the bulk data of a whole deck.
    ///
    /// # Errors
    /// A line that cannot be used: a card of another kind, a wrong field, a number that two cards have.
    pub fn read(text: &str) -> Result<BeamModel, CardError> {
        let comments = text.lines().map_while(|line| line.strip_prefix('$'));
        let heading = comments.map(|line| line.trim().to_string()).collect();
        let mut model = BeamModel { heading, lines: text.lines().count().max(1), ..BeamModel::default() };
        let (mut held, mut passed_over) = (0, BTreeMap::<String, usize>::new());
        let cards = cards(text)?;
        let usual = cards.iter().find(|card| card.name == "GRDSET").map_or(Ok(String::new()), usual_of_grids)?;
        for card in cards {
            match card.name.as_str() {
                "GRID" => model.grids.push(grid(&card, &usual)?),
                "GRDSET" => {}
                "CBAR" | "CBEAM" => model.bars.push(bar(&card)?),
                "PBAR" => model.properties.push(property(&card)?),
                "PBARL" => model.properties.push(property_of_shape(&card)?),
                "PBEAM" => {
                    let (property, notes) = property_of_beam(&card)?;
                    model.properties.push(property);
                    model.notes.extend(notes);
                }
                "MAT1" => model.materials.push(isotropic(&card)?),
                "SPC1" => {
                    let constraint = constraint_of_list(&card)?;
                    held += constraint.grids.len();
                    if held > MOST_HELD {
                        let expected = format!("at most {MOST_HELD} in all");
                        return Err(CardError::new(card.line, format!("{held} grid points of SPC1"), expected));
                    }
                    model.constraints.push(constraint);
                }
                "SPC" => model.constraints.extend(constraints_of_pairs(&card)?),
                name if WITHOUT_EFFECT.contains(&name) => {}
                "INCLUDE" => {
                    let expected = "the cards themselves: one file holds the model";
                    return Err(CardError::new(card.line, "a card INCLUDE", expected));
                }
                name => *passed_over.entry(name.to_string()).or_insert(0) += 1,
            }
        }
        if !passed_over.is_empty() {
            let cards: Vec<String> = passed_over.iter().map(|(name, count)| format!("{count} {name}")).collect();
            model.notes.push(format!(
                "cards that make no beam are left out, with their mass and stiffness: {}",
                cards.join(", ")
            ));
        }
        let grids = model.grids.iter().map(|card| (card.id, card.line));
        unique("GRID", grids)?;
        unique("CBAR", model.bars.iter().map(|card| (card.id, card.line)))?;
        unique("PBAR", model.properties.iter().map(|card| (card.id, card.line)))?;
        unique("MAT1", model.materials.iter().map(|card| (card.id, card.line)))?;
        Ok(model)
    }
}

/// Each number once.
fn unique(name: &str, cards: impl Iterator<Item = (i64, usize)>) -> Result<(), CardError> {
    let mut seen = BTreeMap::new();
    for (id, line) in cards {
        if let Some(first) = seen.insert(id, line) {
            let expected = format!("another number than that of line {first}");
            return Err(CardError::new(line, format!("{name} {id} a second time"), expected));
        }
    }
    Ok(())
}

/// GRDSET: the components that all grid points without their own are held in.
fn usual_of_grids(card: &Card) -> Result<String, CardError> {
    card.unused(1..2, "CP", "nothing or 0: coordinates of the basic system")?;
    card.unused(5..6, "CD", "nothing or 0: displacements in the basic system")?;
    Ok(components(card, 6, "PS")?.unwrap_or_default())
}

fn grid(card: &Card, usual: &str) -> Result<Grid, CardError> {
    card.unused(1..2, "CP", "nothing or 0: coordinates of the basic system")?;
    card.unused(5..6, "CD", "nothing or 0: displacements in the basic system")?;
    let at = |k: usize, name: &str| Ok(card.real(k, name)?.unwrap_or(0.0));
    // 0 is none, also beside GRDSET
    let own = components(card, 6, "PS")?;
    let held = own.unwrap_or_else(|| if card.text(6).is_empty() { usual.to_string() } else { String::new() });
    Ok(Grid { id: card.id(0, "ID")?, at: [at(2, "X1")?, at(3, "X2")?, at(4, "X3")?], held, line: card.line })
}

/// Digits 1 to 6, each at most once.
fn components(card: &Card, k: usize, name: &str) -> Result<Option<String>, CardError> {
    let text = card.text(k);
    let sound = text.bytes().all(|byte| (b'1'..=b'6').contains(&byte));
    let once = text.char_indices().all(|(at, c)| !text[..at].contains(c));
    match text {
        "" | "0" => Ok(None),
        text if sound && once => Ok(Some(text.to_string())),
        _ => Err(card.wrong(k, name, "components: digits 1 to 6, each once")),
    }
}

fn bar(card: &Card) -> Result<Bar, CardError> {
    let id = card.id(0, "EID")?;
    let property = card.whole(1, "PID")?.unwrap_or(id);
    let grids = [card.id(2, "GA")?, card.id(3, "GB")?];
    let given = [4, 5, 6].map(|k| !card.text(k).is_empty());
    let orientation = match card.text(4).parse::<i64>() {
        Ok(grid) if !given[1] && !given[2] => Orientation::Grid(grid),
        _ if given == [false; 3] => {
            return Err(card.wrong(4, "X1", "an orientation: a vector X1, X2, X3 or a grid point"));
        }
        _ => {
            let part = |k: usize, name: &str| Ok(card.real(k, name)?.unwrap_or(0.0));
            Orientation::Vector([part(4, "X1")?, part(5, "X2")?, part(6, "X3")?])
        }
    };
    card.unused(10..16, "an offset W", "nothing or 0: the bar lies between its grid points")?;
    let released = |k: usize, name: &str| Ok(components(card, k, name)?.unwrap_or_default());
    let released = [released(8, "PA")?, released(9, "PB")?];
    Ok(Bar { id, property, grids, orientation, released, line: card.line })
}

fn property(card: &Card) -> Result<Property, CardError> {
    let number = |k: usize, name: &str| Ok(card.real(k, name)?.unwrap_or(0.0));
    let not_negative = |k: usize, name: &str| {
        let found = number(k, name)?;
        if found < 0.0 { Err(card.wrong(k, name, "a real number of at least 0")) } else { Ok(found) }
    };
    let mut stress_points = [[0.0; 2]; 4];
    for (k, name) in ["C1", "C2", "D1", "D2", "E1", "E2", "F1", "F2"].into_iter().enumerate() {
        stress_points[k / 2][k % 2] = number(8 + k, name)?;
    }
    card.unused(18..19, "I12", "nothing or 0: a section that is symmetric about the plane")?;
    Ok(Property {
        id: card.id(0, "PID")?,
        material: card.id(1, "MID")?,
        area: card.positive(2, "A")?,
        second_moments: [not_negative(3, "I1")?, not_negative(4, "I2")?],
        extra_mass: not_negative(6, "NSM")?,
        stress_points,
        shear_factors: [not_negative(16, "K1")?, not_negative(17, "K2")?],
        line: card.line,
    })
}

fn isotropic(card: &Card) -> Result<Isotropic, CardError> {
    let youngs_modulus = card.positive(1, "E")?;
    let (shear_modulus, poissons_ratio) = (card.real(2, "G")?, card.real(3, "NU")?);
    if let Some(value) = poissons_ratio
        && !(value > -1.0 && value <= 0.5)
    {
        return Err(card.wrong(3, "NU", "Poisson's ratio, above -1 and at most 0.5"));
    }
    let shear_modulus = match (shear_modulus, poissons_ratio) {
        (Some(_), _) => card.positive(2, "G")?,
        (None, nu) => youngs_modulus / (2.0 * (1.0 + nu.unwrap_or(0.0))),
    };
    let limit = |k: usize, name: &str| match card.real(k, name)? {
        None | Some(0.0) => Ok(None),
        Some(value) => Ok(Some(value.abs())),
    };
    let (tension, compression) = (limit(8, "ST")?, limit(9, "SC")?);
    let allowable_stress = tension.into_iter().chain(compression).reduce(f64::min);
    let id = card.id(0, "MID")?;
    let density = card.real(4, "RHO")?.unwrap_or(0.0);
    if density < 0.0 {
        return Err(card.wrong(4, "RHO", "a real number of at least 0"));
    }
    Ok(Isotropic { id, youngs_modulus, shear_modulus, density, allowable_stress, line: card.line })
}

/// Most grid points of all constraints.
const MOST_HELD: usize = 1_000_000;

fn constraint_of_list(card: &Card) -> Result<Constraint, CardError> {
    let held = components(card, 1, "C")?.unwrap_or_default();
    let grids = match card.text(3).to_ascii_uppercase().as_str() {
        "THRU" => {
            let (first, last) = (card.id(2, "G1")?, card.id(4, "G2")?);
            if first > last || last - first >= MOST_HELD as i64 {
                return Err(card.wrong(4, "G2", "a grid point behind G1"));
            }
            (first..=last).collect()
        }
        _ => {
            let given: Vec<usize> = (2..card.count()).filter(|k| !card.text(*k).is_empty()).collect();
            given.into_iter().map(|k| card.id(k, "G")).collect::<Result<Vec<_>, _>>()?
        }
    };
    Ok(Constraint { set: card.id(0, "SID")?, components: held, grids, line: card.line })
}

fn constraints_of_pairs(card: &Card) -> Result<Vec<Constraint>, CardError> {
    let set = card.id(0, "SID")?;
    let mut found = Vec::new();
    for k in [1, 4] {
        if card.text(k).is_empty() {
            continue;
        }
        card.unused(k + 2..k + 3, "D", "nothing or 0: supports that do not move")?;
        let held = components(card, k + 1, "C")?.unwrap_or_default();
        found.push(Constraint { set, components: held, grids: vec![card.id(k, "G")?], line: card.line });
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    const MODEL: &str = "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.,,345\nCBAR,1,1,1,2,0.,1.,0.\nPBAR,1,1,.1,1.-4,2.-4,,3.\n,.5,,-.5\n\
                         MAT1,1,7.+10,,.3,2700.\n,3.+8,2.+8\nSPC1,1,126,1\nPARAM,POST,-1\n";

    #[test]
    fn a_model_is_read() {
        let model = BeamModel::read(MODEL).expect("a model");
        assert_eq!((model.grids.len(), model.bars.len(), model.grids[1].held.as_str()), (2, 1, "345"));
        assert_eq!(model.properties[0].stress_points, [[0.5, 0.0], [-0.5, 0.0], [0.0; 2], [0.0; 2]]);
        assert_eq!((model.properties[0].second_moments, model.properties[0].extra_mass), ([1e-4, 2e-4], 3.0));
        assert!((model.materials[0].shear_modulus / (7e10 / 2.6) - 1.0).abs() < 1e-15);
        assert_eq!(model.materials[0].allowable_stress, Some(2e8));
        assert_eq!(model.constraints[0].grids, [1]);
    }

    /// A deck as programs write it: GRDSET, CBEAM, a section by its shape, comments in the tenth field, cards that make no beam.
    #[test]
    fn a_deck_of_another_program_is_read() {
        let deck = "SOL 101\nCEND\nBEGIN BULK\nGRDSET                                                       345\n\
            GRID           1              0.      0.      0.                        nodes, 1\n\
            GRID           2              1.      0.      0.               0\n\
            CBEAM          1       1       1       2      0.      1.      0.         EID 1\n\
            PBARL          1       1             BOX                                +\n\
            +            .04     .06    .003    .002\n\
            MAT1           1  7.+10              .33   2700.                        alu\n\
            CONM2          9       1               2.\nRBE2           8       1     123       2\nSET1           1       1       2\nENDDATA\n";
        let model = BeamModel::read(deck).expect("a deck");
        assert_eq!((model.bars.len(), model.properties.len(), model.materials.len()), (1, 1, 1));
        assert_eq!([&model.grids[0].held, &model.grids[1].held], ["345", ""]);
        assert!(model.notes[0].ends_with("1 CONM2, 1 RBE2, 1 SET1"), "{:?}", model.notes);
        assert!(BeamModel::read("INCLUDE 'other.bdf'\n").is_err());
    }

    #[test]
    fn what_is_written_is_read_and_written_the_same() {
        let model = BeamModel::read(MODEL).expect("a model");
        let text = model.written();
        let again = BeamModel::read(&text).expect("a model");
        assert_eq!(again.written(), text, "{text}");
        assert_eq!((again.bars.len(), &again.materials[0].density), (1, &2700.0));
    }
}
