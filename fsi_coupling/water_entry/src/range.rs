//! Which bottoms each model holds for; the deadrises of boundary elements stand in `model`.

use faer::c64;

use super::curve::Piece;
use super::model::{EntryModel, OutOfRange};
use super::section::{KNUCKLE, Section};

/// Least angle at the ends of an arc for boundary elements [deg].
const LEAST_ARC_DEG: f64 = 20.0;
/// Least angle at the ends of another round bottom: that of the keel that is added to it, and some more [deg].
const LEAST_CURVE_DEG: f64 = 17.0;
/// Least angle by which a bottom turns up where the flow about a bent one leaves it for good [deg].
const LEAST_CHINE_DEG: f64 = 20.0;

impl EntryModel {
    /// Refuse a bottom outside the range of the model; it is wetted up to the half width `reach` [m].
    ///
    /// # Errors
    /// What is outside the range, the range, and the next model that covers the bottom.
    pub fn covers(self, section: &Section, reach: f64) -> Result<(), OutOfRange> {
        let Some((what, range)) = self.obstacle(section, reach) else { return Ok(()) };
        // a bottom that boundary elements do not follow may be one for a formula
        let formulas: &[EntryModel] = match self {
            EntryModel::BoundaryElement => &[EntryModel::Similarity, EntryModel::Mlm],
            _ => &[],
        };
        let dearer = EntryModel::ALL.iter().filter(|r| **r > self);
        let able = formulas.iter().chain(dearer).find(|r| r.obstacle(section, reach).is_none());
        Err(OutOfRange { what, range, next: *able.unwrap_or(&EntryModel::Wcsph) })
    }

    /// What is outside the model's range, and the range.
    fn obstacle(self, section: &Section, reach: f64) -> Option<(String, String)> {
        let [least, most] = self.deadrises();
        let steepest = section.steepest_within(reach);
        let is_wedge = section.deadrise_deg().is_some();
        match self {
            _ if !self.is_theory() => None,
            _ if self != EntryModel::BoundaryElement && section.beyond().is_some() => {
                Some((section.beyond().unwrap_or_default(), "outlines that reach no farther out than their bottom".into()))
            }
            EntryModel::BoundaryElement if section.is_round() => {
                let end = section.last_angle_deg();
                let (least, what) = match section.radius() {
                    Some(_) => (LEAST_ARC_DEG, "an arc that ends"),
                    None => (LEAST_CURVE_DEG, "a round bottom that ends"),
                };
                let range = || format!("arcs of {LEAST_ARC_DEG} degrees and more, and round bottoms that end at {LEAST_CURVE_DEG}");
                (end < least).then(|| (format!("{what} at {end:.1} degrees"), range()))
            }
            EntryModel::BoundaryElement if section.curve().is_some() && section.is_blunt() => {
                let steepest = section.steepest_followed_deg();
                (steepest < LEAST_CURVE_DEG).then(|| {
                    let range = format!("flat keels of bottoms that come to {LEAST_CURVE_DEG} degrees");
                    (format!("a bottom of {steepest:.1} degrees at most"), range)
                })
            }
            EntryModel::BoundaryElement if !is_wedge => section.not_followed(reach).map(|what| {
                let range = format!(
                    "bottoms of faces of {least} to {most} degrees, up to a knuckle of {LEAST_CHINE_DEG} degrees and more"
                );
                (what, range)
            }),
            _ if section.flat_keel().is_some() => Some(("a flat keel".into(), "bottoms with a keel, or round ones".into())),
            _ if section.meets_at_once() => {
                let deadrise = section.slopes()[0].atan().to_degrees();
                let range = "bottoms of 4 degrees and more next to their keel, or round ones".into();
                Some((format!("one of {deadrise:.2} degrees"), range))
            }
            _ if section.hollow().is_some() => {
                let [x, depth] = section.hollow().unwrap_or_default().map(in_tenths_of_millimetres);
                Some((format!("one with a hollow {depth} m deep at {x} m from the keel"), "convex bottoms".into()))
            }
            EntryModel::Similarity if !is_wedge => {
                Some(("a curved or bent bottom".into(), format!("wedges of {least} to {most} degrees")))
            }
            EntryModel::Similarity if reach > section.half_breadth() => {
                Some(("a wedge whose chines are wet".into(), "wedges as long as the spray leaves their faces".into()))
            }
            _ if steepest > most + 1e-6 || self == EntryModel::BoundaryElement && steepest < least - 1e-6 => {
                Some((format!("a face of {steepest:.2} degrees"), format!("faces of {least} to {most} degrees")))
            }
            _ => None,
        }
    }
}

/// A length [m], rounded for a message.
fn in_tenths_of_millimetres(length: f64) -> f64 {
    (1e4 * length).round() / 1e4
}

impl Section {
    /// Corners from the keel to where the flow by boundary elements leaves the bottom for good: its chine, or a face that is too steep.
    pub(super) fn followed(&self) -> &[[f64; 2]] {
        let [_, most] = EntryModel::BoundaryElement.deadrises();
        if self.radius().is_some() {
            return self.corners();
        }
        if self.curve().is_some() {
            let leaves = |k: &usize| self.turn(*k) > KNUCKLE && self.slopes()[*k].atan().to_degrees() > most;
            let last = (1..self.slopes().len()).find(leaves).unwrap_or(self.slopes().len());
            return &self.corners()[..=last];
        }
        let faces = self.slopes().iter().take_while(|slope| slope.atan().to_degrees() <= most + 1e-6).count();
        &self.corners()[..=faces]
    }

    /// Its pieces up to there; knuckles are not rounded.
    pub(super) fn followed_line(&self) -> Vec<Piece> {
        let end = self.followed_half_breadth() * (1.0 - 1e-9);
        let point = |[x, y]: [f64; 2]| c64::new(x, y);
        match self.curve() {
            Some(line) => line.iter().take_while(|piece| piece.from.re < end).copied().collect(),
            None => self.followed().windows(2).map(|ends| Piece::straight(point(ends[0]), point(ends[1]))).collect(),
        }
    }

    /// Has the bottom no keel about which a flow could begin: is it round, flat or nearly flat next to its keel? A wedge is none.
    pub(super) fn is_blunt(&self) -> bool {
        let [least, _] = EntryModel::BoundaryElement.deadrises();
        let is_flat = || self.deadrise_deg().is_none() && self.slopes()[0] < (least - 1e-6).to_radians().tan();
        self.is_round() || is_flat()
    }

    /// Angle of the first face, or of the first place of a curve, that needs no added keel [deg].
    pub(super) fn first_steep_deg(&self) -> Option<f64> {
        let [least, most] = EntryModel::BoundaryElement.deadrises();
        let angles = self.followed_line().into_iter().filter(|piece| piece.last_angle().to_degrees() >= least - 1e-6);
        angles.map(|piece| if piece.round { most } else { piece.angle.to_degrees() }).next()
    }

    /// Angle of the steepest place that is followed [deg].
    pub(super) fn steepest_followed_deg(&self) -> f64 {
        self.followed_line().iter().map(|piece| piece.last_angle().to_degrees()).fold(0.0, f64::max)
    }

    /// Is the bottom straight from the keel to where the flow leaves it?
    pub(super) fn is_followed_as_wedge(&self) -> bool {
        self.radius().is_none() && self.followed().len() == 2
    }

    /// The end of the first face [m].
    pub(super) fn first_face(&self) -> [f64; 2] {
        self.corners()[1]
    }

    /// Deadrises of the faces that boundary elements follow [deg].
    pub fn followed_deadrises(&self) -> impl Iterator<Item = f64> + '_ {
        self.slopes()[..self.followed().len() - 1].iter().map(|slope| slope.atan().to_degrees())
    }

    /// Half breadth where the flow leaves the bottom [m].
    pub fn followed_half_breadth(&self) -> f64 {
        self.followed()[self.followed().len() - 1][0]
    }

    /// The face of a bent bottom, wetted up to the half width `reach` [m], that boundary elements do not follow.
    fn not_followed(&self, reach: f64) -> Option<String> {
        let [least, _] = EntryModel::BoundaryElement.deadrises();
        let angle = |k: usize| self.slopes()[k].atan().to_degrees();
        let faces = self.followed().len() - 1;
        // flatter faces next to the keel are followed where a steeper one comes after them
        let first = (0..faces).find(|k| angle(*k) >= least - 1e-6).unwrap_or(0);
        let flat = (first..faces).find(|k| angle(*k) < least - 1e-6);
        let steep = (faces == 0).then_some(0);
        let further = faces < self.slopes().len() && faces > 0;
        let bend = further.then(|| angle(faces) - angle(faces - 1)).filter(|turn| *turn < LEAST_CHINE_DEG);
        flat.or(steep).map(|k| format!("one with a face of {:.2} degrees", angle(k))).or_else(|| {
            let [x, _] = self.followed()[faces];
            bend.filter(|_| reach > x).map(|turn| {
                format!(
                    "one that turns up by {turn:.1} degrees to {:.1} degrees at {} m",
                    angle(faces),
                    in_tenths_of_millimetres(x)
                )
            })
        })
    }
}
