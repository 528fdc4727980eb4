//! Doubts about results: why, and about which.

use super::{OWN, Quantity, Results, Verdict};

/// Reasons, each with the names of the results that it is about.
#[derive(Default)]
pub(super) struct Doubts(Vec<(String, String)>);

impl Doubts {
    pub fn add(&mut self, name: &str, why: Option<String>) {
        let Some(why) = why else { return };
        match self.0.iter_mut().find(|(_, known)| *known == why) {
            Some((names, _)) => *names = format!("{names}, {name}"),
            None => self.0.push((name.to_string(), why)),
        }
    }

    pub fn sentences(self) -> Vec<String> {
        self.0.into_iter().map(|(names, why)| format!("{names}: {why}")).collect()
    }
}

impl Results {
    /// What comes at `from` [s] or later, or belongs to the whole run, is not resolved, and why, in a sentence that names it.
    pub(crate) fn unresolve(&mut self, from: f64, why: &str) -> Option<String> {
        let mut names = Vec::new();
        for (name, quantity) in OWN.into_iter().zip(self.own_mut()) {
            let Some(quantity) = quantity.as_mut().filter(|q| q.time_s.is_none_or(|time| time >= from)) else {
                continue;
            };
            if matches!(quantity.verdict, Verdict::Resolved | Verdict::NoBand) {
                *quantity = Quantity { band: None, verdict: Verdict::NotResolved, ..*quantity };
            }
            names.push(name);
        }
        (!names.is_empty()).then(|| format!("{}: {why}", names.join(", ")))
    }

    /// The same without bands, and why: the flow was computed with keys of the method, in words, with which no band was measured.
    pub(super) fn without_bands(mut self, unusual: &[String], doubts: &mut Doubts) -> Results {
        let why = format!("no band was measured with {}", unusual.join(", "));
        for (name, quantity) in self.named() {
            doubts.add(&name, quantity.band.map(|_| why.clone()));
        }
        let own = [&mut self.peak_force_N_per_m, &mut self.peak_acceleration_g, &mut self.peak_pressure_Pa];
        let of_panels = self.panels.values_mut();
        let of_panels = of_panels.flat_map(|p| {
            [Some(&mut p.peak_stress_Pa), p.peak_strain.as_mut(), p.reserve_factor.as_mut()].into_iter().flatten()
        });
        for quantity in own.into_iter().chain([&mut self.impulse_N_s_per_m]).flatten().chain(of_panels) {
            let verdict = if quantity.verdict == Verdict::Resolved { Verdict::NoBand } else { quantity.verdict };
            *quantity = Quantity { band: None, verdict, ..*quantity };
        }
        self
    }
}
