//! Sections of PBARL by their shape and dimensions: areas, second moments and outer fibres (MSC Nastran Quick Reference Guide, PBARL).

use std::f64::consts::PI;

use super::CardError;
use super::cards::Card;
use super::model::Property;

/// Shapes that are read, with the number of their dimensions.
const SHAPES: [(&str, usize); 8] =
    [("BAR", 2), ("BOX", 4), ("ROD", 1), ("TUBE", 2), ("I", 6), ("CHAN", 4), ("T", 4), ("L", 4)];
/// Index of the first dimension.
const FIRST: usize = 8;

/// A rectangle of a section: from, to along its first direction (height), then along its second one (width).
struct Rectangle([f64; 2], [f64; 2]);

/// Area, second moments for bending in the first and the second plane, and the extent on both sides of the centroid in both directions.
struct Shape {
    area: f64,
    second_moments: [f64; 2],
    extents: [[f64; 2]; 2],
}

impl Shape {
    /// Of rectangles that do not overlap.
    fn of_rectangles(parts: &[Rectangle]) -> Shape {
        let area_of = |part: &Rectangle| (part.0[1] - part.0[0]) * (part.1[1] - part.1[0]);
        let side = |part: &Rectangle, k: usize| if k == 0 { part.0 } else { part.1 };
        let area: f64 = parts.iter().map(area_of).sum();
        let middle = |[from, to]: [f64; 2]| 0.5 * (from + to);
        let centre = [0, 1].map(|k| parts.iter().map(|part| area_of(part) * middle(side(part, k))).sum::<f64>() / area);
        let about = |k: usize| {
            let own = |part: &Rectangle| {
                let [from, to] = side(part, k);
                area_of(part) * ((to - from).powi(2) / 12.0 + (middle([from, to]) - centre[k]).powi(2))
            };
            parts.iter().map(own).sum::<f64>()
        };
        let extent = |k: usize| {
            let low = parts.iter().map(|part| side(part, k)[0]).fold(f64::INFINITY, f64::min);
            let high = parts.iter().map(|part| side(part, k)[1]).fold(f64::NEG_INFINITY, f64::max);
            [low - centre[k], high - centre[k]]
        };
        Shape { area, second_moments: [about(0), about(1)], extents: [extent(0), extent(1)] }
    }

    /// A tube between two radii.
    fn ring(outer: f64, inner: f64) -> Shape {
        let second = 0.25 * PI * (outer.powi(4) - inner.powi(4));
        Shape { area: PI * (outer.powi(2) - inner.powi(2)), second_moments: [second; 2], extents: [[-outer, outer]; 2] }
    }
}

/// PBARL: a section by its shape.
pub(super) fn property_of_shape(card: &Card) -> Result<Property, CardError> {
    let name = card.text(3).to_ascii_uppercase();
    let Some((_, count)) = SHAPES.iter().find(|(known, _)| *known == name) else {
        let names: Vec<&str> = SHAPES.iter().map(|(name, _)| *name).collect();
        return Err(card.wrong(3, "TYPE", &format!("one of {}; or PBAR, the properties as numbers", names.join(", "))));
    };
    let dims = (0..*count).map(|k| match (k, name.as_str()) {
        (1, "TUBE") => Ok(card.real(FIRST + 1, "DIM2")?.unwrap_or(0.0)), // a rod
        _ => card.positive(FIRST + k, &format!("DIM{}", k + 1)),
    });
    let d = dims.collect::<Result<Vec<f64>, _>>()?;
    let thin = |holds: bool, k: usize| match holds {
        true => Ok(()),
        false => Err(card.wrong(FIRST + k, &format!("DIM{}", k + 1), "walls that leave room between them")),
    };
    let centred = |size: f64| [-0.5 * size, 0.5 * size];
    let shape = match name.as_str() {
        "BAR" => Shape::of_rectangles(&[Rectangle(centred(d[1]), centred(d[0]))]),
        "ROD" => Shape::ring(d[0], 0.0),
        "TUBE" => {
            thin(d[1] >= 0.0 && d[1] < d[0], 1)?;
            Shape::ring(d[0], d[1])
        }
        "BOX" => {
            let (width, height, flange, web) = (d[0], d[1], d[2], d[3]);
            thin(2.0 * flange < height, 2)?;
            thin(2.0 * web < width, 3)?;
            let between = [-0.5 * height + flange, 0.5 * height - flange];
            Shape::of_rectangles(&[
                Rectangle([0.5 * height - flange, 0.5 * height], centred(width)),
                Rectangle([-0.5 * height, -0.5 * height + flange], centred(width)),
                Rectangle(between, [-0.5 * width, -0.5 * width + web]),
                Rectangle(between, [0.5 * width - web, 0.5 * width]),
            ])
        }
        "I" => {
            let (height, bottom, top, web, low, high) = (d[0], d[1], d[2], d[3], d[4], d[5]);
            thin(low + high < height, 4)?;
            thin(web <= bottom.min(top), 3)?;
            Shape::of_rectangles(&[
                Rectangle([0.0, low], centred(bottom)),
                Rectangle([low, height - high], centred(web)),
                Rectangle([height - high, height], centred(top)),
            ])
        }
        "CHAN" => {
            let (width, height, web, flange) = (d[0], d[1], d[2], d[3]);
            thin(2.0 * flange < height, 3)?;
            thin(web < width, 2)?;
            Shape::of_rectangles(&[
                Rectangle([0.0, flange], [0.0, width]),
                Rectangle([flange, height - flange], [0.0, web]),
                Rectangle([height - flange, height], [0.0, width]),
            ])
        }
        "T" => {
            let (width, height, flange, web) = (d[0], d[1], d[2], d[3]);
            thin(flange < height, 2)?;
            thin(web <= width, 3)?;
            Shape::of_rectangles(&[
                Rectangle([height - flange, height], centred(width)),
                Rectangle([0.0, height - flange], centred(web)),
            ])
        }
        _ => {
            let (width, height, foot, leg) = (d[0], d[1], d[2], d[3]);
            thin(foot < height, 2)?;
            thin(leg < width, 3)?;
            Shape::of_rectangles(&[Rectangle([0.0, foot], [0.0, width]), Rectangle([foot, height], [0.0, leg])])
        }
    };
    let [[y_low, y_high], [z_low, z_high]] = shape.extents;
    let extra_mass = card.real(FIRST + count, "NSM")?.unwrap_or(0.0);
    if extra_mass < 0.0 {
        return Err(card.wrong(FIRST + count, "NSM", "a real number of at least 0"));
    }
    Ok(Property {
        id: card.id(0, "PID")?,
        material: card.id(1, "MID")?,
        area: shape.area,
        second_moments: shape.second_moments,
        extra_mass,
        stress_points: [[y_high, z_high], [y_low, z_high], [y_low, z_low], [y_high, z_low]],
        shear_factors: [0.0; 2],
        line: card.line,
    })
}

#[cfg(test)]
mod tests {
    use super::super::model::BeamModel;

    fn property(shape: &str, dims: &[f64]) -> super::Property {
        let dims: Vec<String> = dims.iter().map(|d| format!("{d:?}")).collect();
        let text = format!("PBARL,1,2,,{shape},,,,\n,{}\n", dims.join(","));
        BeamModel::read(&text).unwrap_or_else(|error| panic!("{shape}: {error:?}")).properties[0].clone()
    }

    /// Against formulas of handbooks: b h³/12, (b h³ − b' h'³)/12, π (R⁴ − r⁴)/4, and a T by its centroid.
    #[test]
    fn sections_have_the_areas_and_second_moments_of_handbooks() {
        let near = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-12, "{a} {b}");
        let bar = property("BAR", &[0.02, 0.05]);
        near(bar.area, 1e-3);
        near(bar.second_moments[0], 0.02 * 0.05_f64.powi(3) / 12.0);
        near(bar.second_moments[1], 0.05 * 0.02_f64.powi(3) / 12.0);
        assert_eq!(bar.stress_points[0], [0.025, 0.01]);
        let walls = property("BOX", &[0.04, 0.06, 0.003, 0.002]);
        near(walls.area, 0.04 * 0.06 - 0.036 * 0.054);
        near(walls.second_moments[0], (0.04 * 0.06_f64.powi(3) - 0.036 * 0.054_f64.powi(3)) / 12.0);
        near(walls.second_moments[1], (0.06 * 0.04_f64.powi(3) - 0.054 * 0.036_f64.powi(3)) / 12.0);
        let tube = property("TUBE", &[0.03, 0.028]);
        near(tube.second_moments[0], 0.25 * std::f64::consts::PI * (0.03_f64.powi(4) - 0.028_f64.powi(4)));
        let i = property("I", &[0.1, 0.05, 0.05, 0.004, 0.006, 0.006]);
        near(i.second_moments[0], (0.05 * 0.1_f64.powi(3) - 0.046 * 0.088_f64.powi(3)) / 12.0);
        let channel = property("CHAN", &[0.05, 0.1, 0.004, 0.006]);
        near(channel.second_moments[0], i.second_moments[0]);
        // flange 40 by 4, web 3 by 46: centroid from the foot
        let t = property("T", &[0.04, 0.05, 0.004, 0.003]);
        let (flange, web) = (0.04 * 0.004, 0.003 * 0.046);
        let centre = (flange * 0.048 + web * 0.023) / (flange + web);
        near(t.stress_points[0][0], 0.05 - centre);
        near(-t.stress_points[1][0], centre);
        let own = 0.04 * 0.004_f64.powi(3) / 12.0 + 0.003 * 0.046_f64.powi(3) / 12.0;
        near(t.second_moments[0], own + flange * (0.048 - centre).powi(2) + web * (0.023 - centre).powi(2));
        let l = property("L", &[0.03, 0.04, 0.002, 0.003, 1.5]);
        near(l.area, 0.03 * 0.002 + 0.038 * 0.003);
        assert_eq!(l.extra_mass, 1.5);
    }

    #[test]
    fn walls_that_leave_no_room_and_other_shapes_are_refused() {
        for (card, part) in [
            ("PBARL,1,2,,BOX,,,,\n,.04,.06,.03,.002\n", "room between"),
            ("PBARL,1,2,,HAT,,,,\n,.04,.06,.03,.002\n", "one of BAR, BOX"),
            ("PBARL,1,2,,BAR,,,,\n,.04\n", "above 0"),
        ] {
            let error = BeamModel::read(card).expect_err(card);
            assert!(error.expected.contains(part), "{card}: {error:?}");
        }
    }
}
