//! Which scheme the settings ask for.

use crate::domain::Domain;
use crate::particles::Seed;
use crate::scheme::{Scheme, SchemeSettings};
use crate::wcsph::split_explicit::SplitExplicit;
use crate::wcsph::{Settings, Wcsph};

impl SchemeSettings for Settings {
    fn scheme(&self, domain: &Domain) -> Box<dyn Scheme> {
        match self.acoustic_steps() {
            1 => Box::new(Wcsph::new(domain, *self)),
            _ => Box::new(SplitExplicit::new(domain, *self)),
        }
    }

    fn state(&self, domain: &Domain, seed: &Seed) -> (f64, Option<f64>) {
        (self.equation_of_state(domain).density(seed.pressure), None)
    }
}
