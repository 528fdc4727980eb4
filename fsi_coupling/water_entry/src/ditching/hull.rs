//! Loads of the sections of a fuselage.

use super::fuselage::{Form, Fuselage, FuselageError, outside};
use crate::{EntryModel, Loads, OutOfRange};

/// Forms that differ by less than this share are one.
const ALIKE: f64 = 1e-6;

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
    /// Which of them each station has.
    of_station: Vec<usize>,
}

impl Hull {
    /// Tables of the sections' loads, one for each form.
    ///
    /// # Errors
    /// A section that the theory does not hold for, up to its edges.
    pub fn new(fuselage: Fuselage, model: EntryModel) -> Result<Hull, FuselageError> {
        let mut kinds: Vec<Form> = Vec::new();
        let (mut forms, mut of_station) = (Vec::new(), Vec::new());
        for (station, s) in fuselage.stations().iter().enumerate() {
            let refused = |e: OutOfRange| FuselageError { station, why: outside(&e, None) };
            let form = s.form.scaled(1.0 / s.breadth);
            let known = kinds.iter().position(|kind| alike(*kind, form));
            if known.is_none() {
                let section = form.section(1.0).map_err(refused)?;
                let advised = |e: OutOfRange| FuselageError { station, why: outside(&e, Some(&section)) };
                model.covers(&section, f64::INFINITY).map_err(advised)?;
                forms.push(Loads::new(model, &section).map_err(refused)?);
                kinds.push(form);
            }
            of_station.push(known.unwrap_or(kinds.len() - 1));
        }
        Ok(Hull { fuselage, model, forms, of_station })
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
        let (k, share) = self.fuselage.between(x);
        let nearest = &self.fuselage.stations()[if share < 0.5 { k } else { k + 1 }];
        nearest.form.scaled(self.fuselage.breadth(x) / nearest.breadth)
    }

    /// EN16: load at a place x [m from the nose] and a draught h [m]. With the breadth b and a form's table for b = 1,
    /// A = b Â(h/b) and M = b² M̂(h/b); between stations of different forms the mean by distance.
    pub fn at(&self, x: f64, draught: f64) -> SectionLoad {
        let (k, share) = self.fuselage.between(x);
        let b = self.fuselage.breadth(x);
        let [from, to] = [self.of_station[k], self.of_station[k + 1]];
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
        let (k, share) = self.fuselage.between(x);
        let b = self.fuselage.breadth(x);
        let of = |form: usize| b * b * self.forms[form].at(draught / b).added_mass;
        let [from, to] = [self.of_station[k], self.of_station[k + 1]];
        let first = of(from);
        if from == to { first } else { first + share * (of(to) - first) }
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

fn alike(a: Form, b: Form) -> bool {
    match (a, b) {
        (Form::Radius(a), Form::Radius(b)) | (Form::DeadriseDeg(a), Form::DeadriseDeg(b)) => {
            (a / b - 1.0).abs() < ALIKE
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
