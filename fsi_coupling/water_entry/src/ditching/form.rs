//! Shapes of the sections of a fuselage.

use serde::{Deserialize, Serialize};

use super::outline::up_to;
use crate::{OutOfRange, Section};

/// Shape of a section.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Form {
    /// The arc of a circle of this radius [m].
    Radius(f64),
    /// A wedge of this deadrise [deg].
    DeadriseDeg(f64),
    /// Half of an outline: distance from the plane of symmetry, height over the keel, from the keel outwards [m], shape (n, 2).
    Outline(Vec<[f64; 2]>),
}

impl Form {
    /// The section of a breadth [m].
    pub fn section(&self, breadth: f64) -> Result<Section, OutOfRange> {
        match self {
            Form::Radius(radius) => Section::arc(*radius, breadth),
            Form::DeadriseDeg(deadrise) => Section::wedge(*deadrise, breadth),
            Form::Outline(points) => match up_to(points, 0.5 * breadth) {
                Some(bottom) => Section::new(&bottom),
                None => Err(OutOfRange::not_a_section("an outline that is narrower than the breadth")),
            },
        }
    }

    /// Its like on a breadth that is `by` times as large.
    pub(super) fn scaled(&self, by: f64) -> Form {
        match self {
            Form::Radius(radius) => Form::Radius(by * radius),
            Form::DeadriseDeg(deadrise) => Form::DeadriseDeg(*deadrise),
            Form::Outline(points) => Form::Outline(points.iter().map(|p| p.map(|v| by * v)).collect()),
        }
    }

    /// Is it an outline?
    pub(super) fn is_outline(&self) -> bool {
        matches!(self, Form::Outline(_))
    }

    /// Its bottom on a breadth [m], from the keel to the edge [m]; an arc by chords, nothing of a form without a section.
    pub fn bottom(&self, breadth: f64) -> Vec<[f64; 2]> {
        self.section(breadth).map(|section| section.corners().to_vec()).unwrap_or_default()
    }

    /// The point of its bottom on a breadth [m] at a share of the girth from the keel [-], from there [m]; on an arc itself.
    pub fn at_girth(&self, breadth: f64, share: f64) -> [f64; 2] {
        if let Form::Radius(radius) = self {
            let angle = share * (0.5 * breadth / radius).min(1.0).asin();
            return [radius * angle.sin(), radius * (1.0 - angle.cos())];
        }
        let bottom = self.bottom(breadth);
        let length = |w: &[[f64; 2]]| (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1]);
        let mut rest = share * bottom.windows(2).map(length).sum::<f64>();
        for pair in bottom.windows(2) {
            let part = rest / length(pair);
            if part <= 1.0 {
                return [0, 1].map(|k| pair[0][k] + part * (pair[1][k] - pair[0][k]));
            }
            rest -= length(pair);
        }
        bottom.last().copied().unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_at_shares_of_the_girth() {
        let knuckled = Form::Outline(vec![[0.0, 0.0], [0.3, 0.4], [0.9, 1.2], [0.9, 2.0]]);
        let near = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-12;
        assert!(near(knuckled.at_girth(1.2, 0.5), [0.3, 0.4]), "up to a half breadth of 0.6 m the girth is 1 m");
        assert!(near(knuckled.at_girth(1.2, 1.0), [0.6, 0.8]));
        let [x, y] = Form::Radius(2.0).at_girth(2.0, 0.5);
        assert!((x.hypot(y - 2.0) - 2.0).abs() < 1e-12 && (x - 2.0 * 15.0_f64.to_radians().sin()).abs() < 1e-12);
    }
}
