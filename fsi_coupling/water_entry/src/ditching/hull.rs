//! Loads of the sections of a fuselage.

use super::form::Form;
use super::fuselage::{Fuselage, FuselageError, outside};
use crate::{EntryModel, Loads, OutOfRange, Section};

/// Forms that differ by less than this share are one.
const ALIKE: f64 = 1e-6;

/// Sections between two stations of different outlines whose loads are tabled.
const LOFTED: usize = 4;

/// A section's load at a draught, per metre of length and for water of density ρ = 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SectionLoad {
    /// Half width of the wetted bottom, up to the edges [m].
    pub wetted: f64,
    /// Half width of the cut with still water [m].
    pub still: f64,
    /// A: force over V² [m].
    pub slam: f64,
    /// M: force over dV/dt [m²].
    pub added_mass: f64,
    /// Area below still water [m²].
    pub area: f64,
}

/// A fuselage with the loads of its sections by one theory.
#[derive(Clone, Debug)]
pub struct Hull {
    fuselage: Fuselage,
    model: EntryModel,
    /// Loads of every form that occurs, of breadth 1.
    forms: Vec<Loads>,
    /// Places with a form of their own, from the nose, and which form each has: the stations, and places between outlines [m].
    places: Vec<(f64, usize)>,
}

impl Hull {
    /// Tables of the sections' loads, one for each form.
    ///
    /// # Errors
    /// A section that the theory does not hold for, up to its edges.
    pub fn new(fuselage: Fuselage, model: EntryModel) -> Result<Hull, FuselageError> {
        let mut tables = Tables { model, kinds: Vec::new(), loads: Vec::new() };
        let mut places = Vec::new();
        for (station, s) in fuselage.stations().iter().enumerate() {
            let of_station =
                tables.of(&s.form.scaled(1.0 / s.breadth), false).map_err(|why| FuselageError { station, why })?;
            if let Some((before, _)) = places.last().copied().filter(|(_, before)| *before != of_station) {
                for k in 1..=LOFTED {
                    let x: f64 = before + (s.x - before) * k as f64 / (LOFTED + 1) as f64;
                    let Some(form) = fuselage.lofted(x) else { continue };
                    let form = form.scaled(1.0 / fuselage.breadth(x));
                    let refused = |why: String| FuselageError { station, why: between(x, &why) };
                    let of_place = tables.of(&form, true).map_err(refused)?;
                    places.push((x, of_place));
                }
            }
            places.push((s.x, of_station));
        }
        Ok(Hull { fuselage, model, forms: tables.loads, places })
    }

    /// The fuselage.
    pub fn fuselage(&self) -> &Fuselage {
        &self.fuselage
    }

    /// The theory.
    pub fn model(&self) -> EntryModel {
        self.model
    }

    /// The form of the station nearest to a place [m from the nose], of the breadth there.
    pub fn form(&self, x: f64) -> Form {
        if let Some(lofted) = self.fuselage.lofted(x) {
            return lofted;
        }
        let (k, share) = self.fuselage.between(x);
        let nearest = &self.fuselage.stations()[if share < 0.5 { k } else { k + 1 }];
        nearest.form.scaled(self.fuselage.breadth(x) / nearest.breadth)
    }

    /// EN16: load at a place x [m from the nose] and a draught h [m]. With the breadth b and a form's table for b = 1,
    /// A = b Â(h/b) and M = b² M̂(h/b); between stations of different forms the mean by distance.
    pub fn at(&self, x: f64, draught: f64) -> SectionLoad {
        let (from, to, share) = self.between(x);
        let b = self.fuselage.breadth(x);
        let first = self.of_form(from, b, draught);
        if from == to {
            return first;
        }
        let second = self.of_form(to, b, draught);
        let mean = |a: f64, b: f64| a + share * (b - a);
        SectionLoad {
            wetted: mean(first.wetted, second.wetted),
            still: mean(first.still, second.still),
            slam: mean(first.slam, second.slam),
            added_mass: mean(first.added_mass, second.added_mass),
            area: mean(first.area, second.area),
        }
    }

    /// Added mass at a place and a draught, as in [`Hull::at`] [m²].
    pub(super) fn added_mass(&self, x: f64, draught: f64) -> f64 {
        let (from, to, share) = self.between(x);
        let b = self.fuselage.breadth(x);
        let of = |form: usize| b * b * self.forms[form].at(draught / b).added_mass;
        let first = of(from);
        if from == to { first } else { first + share * (of(to) - first) }
    }

    /// Loads of the form nearest to a place, of breadth 1.
    pub(super) fn nearest(&self, x: f64) -> &Loads {
        let (from, to, share) = self.between(x);
        &self.forms[if share < 0.5 { from } else { to }]
    }

    /// Forms before and after a place, and the share of the way between them [-].
    fn between(&self, x: f64) -> (usize, usize, f64) {
        let after = self.places.partition_point(|(at, _)| *at <= x).clamp(1, self.places.len() - 1);
        let ((a, from), (b, to)) = (self.places[after - 1], self.places[after]);
        (from, to, ((x - a) / (b - a)).clamp(0.0, 1.0))
    }

    fn of_form(&self, form: usize, b: f64, draught: f64) -> SectionLoad {
        let loads = &self.forms[form];
        let load = loads.at(draught / b);
        SectionLoad {
            wetted: b * load.wetted.min(0.5),
            still: b * loads.section().still_half_width(draught / b),
            slam: b * load.slam,
            added_mass: b * b * load.added_mass,
            area: b * b * loads.section().still_area(draught / b),
        }
    }
}

/// Tables of the forms that occur.
struct Tables {
    model: EntryModel,
    kinds: Vec<Form>,
    loads: Vec<Loads>,
}

impl Tables {
    /// Which table a form of breadth 1 has; why it has none. One between stations is taken without its hollows, and its keel may be level.
    fn of(&mut self, form: &Form, is_lofted: bool) -> Result<usize, String> {
        if let Some(known) = self.kinds.iter().position(|kind| alike(kind, form)) {
            return Ok(known);
        }
        let refused = |e: OutOfRange| outside(&e, None);
        let section = match form {
            Form::Outline(points) if is_lofted => Section::new(points).map(|s| s.convex().with_round_keel()),
            form => form.section(1.0),
        };
        let section = section.map_err(refused)?;
        self.model.covers(&section, f64::INFINITY).map_err(|e| outside(&e, Some(&section)))?;
        self.loads.push(Loads::new(self.model, &section).map_err(refused)?);
        self.kinds.push(form.clone());
        Ok(self.kinds.len() - 1)
    }
}

/// What is said of a section before a station.
fn between(x: f64, why: &str) -> String {
    format!("the section between it and the station before, at x = {x:.3} m: {why}")
}

fn alike(a: &Form, b: &Form) -> bool {
    match (a, b) {
        (Form::Radius(a), Form::Radius(b)) | (Form::DeadriseDeg(a), Form::DeadriseDeg(b)) => {
            (a / b - 1.0).abs() < ALIKE
        }
        (Form::Outline(a), Form::Outline(b)) => {
            let close = |(a, b): (&[f64; 2], &[f64; 2])| (a[0] - b[0]).hypot(a[1] - b[1]) < ALIKE;
            a.len() == b.len() && a.iter().zip(b).all(close)
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ditching::Station;

    /// The advice was a model that landings refuse.
    #[test]
    fn a_section_outside_a_model_is_advised_of_a_model_of_landings() {
        let refused = |model: EntryModel, deadrise: f64| {
            let station = |x: f64| Station { x, keel: 0.0, breadth: 1.0, form: Form::DeadriseDeg(deadrise) };
            let fuselage = Fuselage::new(&[station(0.0), station(5.0)]).expect("a fuselage");
            Hull::new(fuselage, model).expect_err("a face out of range").why
        };
        assert!(
            refused(EntryModel::Wagner, 50.0).ends_with("model = \"mlm\" holds for it"),
            "{}",
            refused(EntryModel::Wagner, 50.0)
        );
        assert!(refused(EntryModel::Mlm, 70.0).ends_with("no model of a landing holds for it"));
    }
}
