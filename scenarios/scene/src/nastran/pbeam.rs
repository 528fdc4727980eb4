//! PBEAM: a beam of one section, as a bar (MSC Nastran Quick Reference Guide, PBEAM).

use super::CardError;
use super::cards::Card;
use super::model::Property;

/// Index of the first stress point of end A, and fields of a line.
const STRESS: usize = 8;
/// Fields of a station with stress points, and without.
const STATION: [usize; 2] = [16, 8];
/// Difference of two numbers that are one [-].
const SAME: f64 = 1e-6;

/// The section of a PBEAM, with what is left out of it.
///
/// # Errors
/// A beam whose section changes along it, a neutral axis beside the grid points, or a wrong field.
pub(super) fn property_of_beam(card: &Card) -> Result<(Property, Option<String>), CardError> {
    let number = |k: usize, name: &str| Ok::<f64, CardError>(card.real(k, name)?.unwrap_or(0.0));
    let not_negative = |k: usize, name: &str| {
        let found = number(k, name)?;
        if found < 0.0 { Err(card.wrong(k, name, "a real number of at least 0")) } else { Ok(found) }
    };
    let (area, second_moments) = (card.positive(2, "A")?, [not_negative(3, "I1")?, not_negative(4, "I2")?]);
    card.unused(5..6, "I12", "nothing or 0: a section that is symmetric about the plane")?;
    let is_station = |k: usize| ["YES", "YESA", "NO"].contains(&card.text(k).to_ascii_uppercase().as_str());
    let mut stress_points = [[0.0; 2]; 4];
    let mut at = STRESS;
    if !is_station(at) {
        for (k, name) in ["C1", "C2", "D1", "D2", "E1", "E2", "F1", "F2"].into_iter().enumerate() {
            stress_points[k / 2][k % 2] = number(STRESS + k, name)?;
        }
        at += STRESS;
    }
    while is_station(at) {
        for (k, name, of_a) in [(2, "A", area), (3, "I1", second_moments[0]), (4, "I2", second_moments[1])] {
            let here = card.real(at + k, name)?.unwrap_or(of_a);
            if (here - of_a).abs() > SAME * of_a {
                return Err(card.wrong(at + k, name, "the same as at end A: a beam of one section"));
            }
        }
        at += STATION[usize::from(!card.text(at).eq_ignore_ascii_case("YES"))];
    }
    let factors = [card.real(at, "K1")?, card.real(at + 1, "K2")?];
    card.unused(at + 12..at + 16, "N", "nothing or 0: the neutral axis between the grid points")?;
    let rectangle = |k: f64| (k - 5.0 / 6.0).abs() < 1e-3;
    let read = |k: Option<f64>| k.filter(|k| rectangle(*k)).unwrap_or(0.0);
    let id = card.id(0, "PID")?;
    let left_out = factors.iter().any(|k| !k.is_some_and(|k| k == 0.0 || rectangle(k)));
    let notes = left_out.then(|| format!("PBEAM {id} bends without shear: of K only 0 and 0.8333 are read"));
    let property = Property {
        id,
        material: card.id(1, "MID")?,
        area,
        second_moments,
        extra_mass: not_negative(7, "NSM")?,
        stress_points,
        shear_factors: factors.map(read),
        line: card.line,
    };
    Ok((property, notes))
}

#[cfg(test)]
mod tests {
    use super::super::model::BeamModel;

    #[test]
    fn a_beam_of_one_section_is_read_and_a_tapered_one_refused() {
        let card = |end_b: &str| {
            format!("PBEAM,1,2,.1,1.-4,2.-4,,1.-6,3.\n,.5,,-.5\n,YES,1.,{end_b},1.-4,2.-4\n,.5,,-.5\n,0.,0.\n")
        };
        let model = BeamModel::read(&card(".1")).expect("a beam");
        let found = &model.properties[0];
        assert_eq!((found.area, found.second_moments, found.extra_mass), (0.1, [1e-4, 2e-4], 3.0));
        assert_eq!((found.stress_points[0][0], found.shear_factors), (0.5, [0.0; 2]));
        assert!(model.notes.is_empty(), "{:?}", model.notes);
        let error = BeamModel::read(&card(".2")).expect_err("tapered");
        assert!(error.line == 3 && error.expected.contains("one section"), "{error:?}");
        let usual = BeamModel::read("PBEAM,1,2,.1,1.-4,2.-4\n").expect("a beam");
        assert!(usual.notes[0].contains("without shear"), "{:?}", usual.notes);
    }
}
