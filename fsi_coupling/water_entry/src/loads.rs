//! Loads of a section at a draught, by each theory: F = A(h) V² + M(h) dV/dt, and the pressures.

use std::f64::consts::{FRAC_PI_2, PI};

use super::model::{EntryModel, OutOfRange};
use super::section::Section;
use super::similarity::SimilarityFlow;

/// Draughts that loads are tabled at.
const NODES: usize = 400;
/// Widest wetted half width in the table, over the half breadth at the chines.
const WIDEST: f64 = 40.0;
/// The finest node stands at this share of the half breadth.
const FINEST: f64 = 1e-4;

/// Load of a section per metre, for water of density ρ = 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Load {
    /// Half width of the wetted bottom c [m].
    pub wetted: f64,
    /// dc/dh [-].
    pub spreading: f64,
    /// A: force over V² [m].
    pub slam: f64,
    /// M: force over dV/dt [m²].
    pub added_mass: f64,
}

/// Loads of a section at any draught (THEORY EN3–EN5, EN8).
#[derive(Clone, Debug)]
pub struct Loads {
    model: EntryModel,
    section: Section,
    flow: Option<SimilarityFlow>,
    /// [h, c, A, M/c²], from the least draught.
    table: Vec<[f64; 4]>,
}

impl Loads {
    /// Loads of a section by a theory.
    ///
    /// # Errors
    /// A model that is no formula, or does not hold for this section from its first touch on.
    pub fn new(model: EntryModel, section: &Section) -> Result<Loads, OutOfRange> {
        model.covers(section, 0.0)?;
        if !model.is_formula() {
            return Err(OutOfRange {
                what: format!("\"{}\"", model.name()),
                range: "loads at a draught by \"von_karman\", \"wagner\", \"mlm\" or \"similarity\"".into(),
                next: EntryModel::Mlm,
            });
        }
        let flow = match (model, section.deadrise_deg()) {
            (EntryModel::Similarity, Some(deadrise)) => SimilarityFlow::solve(deadrise),
            _ => None,
        };
        Ok(Loads::tabled(model, section, flow))
    }

    /// Loads of a convex section on its way to a flow by boundary elements: the modified Logvinovich model, also with a flat keel, which is wet from
    /// contact on.
    pub fn before_flow(section: &Section) -> Loads {
        Loads::tabled(EntryModel::Mlm, &section.convex(), None)
    }

    fn tabled(model: EntryModel, section: &Section, flow: Option<SimilarityFlow>) -> Loads {
        let b = section.half_breadth();
        let ratio = (WIDEST / FINEST).powf(1.0 / (NODES - 2) as f64);
        let flat = section.flat_keel().unwrap_or(0.0);
        let mut widths: Vec<f64> = (0..NODES - 1).map(|k| flat + b * FINEST * ratio.powi(k as i32)).collect();
        widths.retain(|c| *c < 0.999 * b || *c > 1.001 * b && model != EntryModel::VonKarman);
        widths.insert(widths.partition_point(|c| *c < b), b); // loads have a corner where the chines get wet
        let mut loads = Loads { model, section: section.clone(), flow, table: Vec::new() };
        let row = |c: f64| {
            let (h, Load { slam, added_mass, .. }) = loads.at_width(c);
            [h, c, slam, added_mass / (c * c)]
        };
        let mut table: Vec<[f64; 4]> = widths.into_iter().map(row).collect();
        let [_, c, slam, mass] = table[0];
        let round = table[1][1] / c < 0.9 * table[1][0] / table[0][0]; // A of a round bottom does not begin with nothing
        table.insert(0, [0.0, flat, if round || flat > 0.0 { slam } else { 0.0 }, mass]);
        loads.table = table;
        loads
    }

    /// The theory.
    pub fn model(&self) -> EntryModel {
        self.model
    }

    /// The section.
    pub fn section(&self) -> &Section {
        &self.section
    }

    /// The exact flow, where the theory has one.
    pub fn flow(&self) -> Option<&SimilarityFlow> {
        self.flow.as_ref()
    }

    /// The load at a draught h [m].
    pub fn at(&self, draught: f64) -> Load {
        let after = self.table.partition_point(|row| row[0] <= draught).clamp(1, self.table.len() - 1);
        let ([h0, c0, a0, m0], [h1, c1, a1, m1]) = (self.table[after - 1], self.table[after]);
        if draught <= 0.0 {
            return Load::default();
        }
        if draught > h1 {
            // a plate of the breadth, or the last that was tabled
            let slam = if self.model == EntryModel::VonKarman { 0.0 } else { a1 };
            return Load { wetted: c1, spreading: 0.0, slam, added_mass: m1 * c1 * c1 };
        }
        let share = (draught - h0) / (h1 - h0);
        let between = |from: f64, to: f64| from + share * (to - from);
        let wetted = between(c0, c1);
        Load {
            wetted,
            spreading: (c1 - c0) / (h1 - h0),
            slam: between(a0, a1),
            added_mass: between(m0, m1) * wetted * wetted,
        }
    }

    /// EN44: force over V² and ρ, at a draught h [m], of a section by the modified Logvinovich model whose wetted half width grows `growth` times
    /// as fast as at the speed V [m]; never suction.
    pub(crate) fn slam_growing(&self, draught: f64, growth: f64) -> f64 {
        let (section, c) = (&self.section, self.at(draught).wetted);
        if c <= 0.0 {
            return 0.0;
        }
        mlm(section, c, draught, growth / section.wagner_slope(c), c.min(section.half_breadth()))[0].max(0.0)
    }

    /// Pressure [Pa] on the face at distance x from the plane of symmetry [m], at draught h [m], speed V [m/s] and its rate
    /// dV/dt [m/s²], in water of density ρ [kg/m³]. Von Karman's momentum has none: `None`.
    pub fn pressure(&self, x: f64, draught: f64, speed: f64, rate: f64, density: f64) -> Option<f64> {
        if self.model == EntryModel::VonKarman {
            return None;
        }
        let Load { wetted: c, spreading, .. } = self.at(draught);
        let x = x.abs();
        if draught <= 0.0 || x > self.section.half_breadth() {
            return Some(0.0);
        }
        if let Some(flow) = &self.flow {
            let quasi_steady = 0.5 * speed * speed * flow.pressure_coefficient(x / draught);
            let added = if x < c { rate * ((c * c - x * x).sqrt() + self.section.height(x) - draught) } else { 0.0 };
            return Some(density * (quasi_steady + added));
        }
        let [over_v2, over_rate] = self.pressure_factors(x, draught, [c, spreading]);
        Some(density * (over_v2 * speed * speed + over_rate * rate))
    }

    /// Pressure over ρV² [-] and over ρ dV/dt [m] by Wagner's or the modified Logvinovich model, at a distance x from the plane of symmetry [m] and a
    /// draught h [m], under a wetted half width c [m] that grows by dc/dh [-].
    pub(crate) fn pressure_factors(&self, x: f64, draught: f64, [c, spreading]: [f64; 2]) -> [f64; 2] {
        if x >= c {
            return [0.0; 2];
        }
        let root = (c * c - x * x).sqrt();
        let (over_v2, over_rate) = (spreading * c / root, root);
        if self.model != EntryModel::Mlm {
            return [over_v2, over_rate];
        }
        let slope = self.section.slope(x);
        let across = 1.0 / (1.0 + slope * slope);
        let over_v2 = over_v2 - 0.5 * (across * (c / root).powi(2) + 1.0 - across);
        if over_v2 < 0.0 { [0.0; 2] } else { [over_v2, over_rate + self.section.height(x) - draught] }
    }

    /// The draught at which c is wet, and the load there.
    fn at_width(&self, c: f64) -> (f64, Load) {
        let (section, b) = (&self.section, self.section.half_breadth());
        let (draught, spreading) = match self.model {
            EntryModel::VonKarman => (section.height(c), 1.0 / section.slope(c).max(1e-12)),
            _ => (section.wagner_draught(c), 1.0 / section.wagner_slope(c)),
        };
        let wet = c.min(b);
        let [slam, added_mass] = match self.model {
            EntryModel::VonKarman => [PI * c * spreading, FRAC_PI_2 * c * c], // EN4
            EntryModel::Wagner => wagner(c, spreading, wet),
            EntryModel::Similarity => {
                let flow = self.flow.as_ref().map_or(0.0, |flow| flow.force_coefficient);
                [flow * draught, mlm(section, c, draught, spreading, wet)[1]] // EN8
            }
            _ => mlm(section, c, draught, spreading, wet),
        };
        (draught, Load { wetted: c, spreading, slam, added_mass })
    }
}

/// LM4 (Wagner 1932): ∫ c ċ/√(c² − x²) and ∫ √(c² − x²) over |x| < wet.
fn wagner(c: f64, spreading: f64, wet: f64) -> [f64; 2] {
    let angle = (wet / c).asin();
    [2.0 * spreading * c * angle, wet * (c * c - wet * wet).max(0.0).sqrt() + c * c * angle]
}

/// EN5 (Korobkin 2004): the same with the square terms and the body's shape, over |x| < wet where the part over V² is above
/// nothing. With x = c sin θ the pieces of a straight bottom integrate to θ, artanh(sin θ) and sin θ.
fn mlm(section: &Section, c: f64, draught: f64, spreading: f64, wet: f64) -> [f64; 2] {
    let (mut slam, mut mass) = (0.0, wagner(c, spreading, wet)[1]);
    for [from, to, height, slope] in section.pieces().take_while(|[from, ..]| *from < wet) {
        let (from, to) = (from, to.min(wet));
        let across = 1.0 / (1.0 + slope * slope);
        // p > 0 ⇔ ½ across q² − spreading q + ½ (1 − across) < 0 for q = c/√(c² − x²) = 1/cos θ
        let largest = (spreading + (spreading * spreading - across * (1.0 - across)).max(0.0).sqrt()) / across;
        let end = c * (1.0 - 1.0 / (largest * largest)).max(0.0).sqrt();
        let (sin0, sin1) = (from / c, to.min(end) / c);
        if sin1 > sin0 {
            let dense = |s: f64| spreading * c * s.asin() - 0.5 * across * c * s.atanh() - 0.5 * (1.0 - across) * c * s;
            slam += 2.0 * (dense(sin1) - dense(sin0));
        }
        mass += 2.0 * (to - from) * (height - draught + 0.5 * slope * (to - from));
    }
    [slam, mass]
}
