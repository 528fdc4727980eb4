//! Layers of a section through its thickness, with its area and second moment (THEORY BE25).

use super::Section;

/// Layers of a rectangle: the interaction of force and moment is within 0.4 % of that of the rectangle.
pub(crate) const LAYERS: usize = 20;

/// Layers: their distances to the left of the axis \[m\] and areas \[m^2\]; the first `count` are.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Layers {
    count: usize,
    places: [f64; LAYERS],
    areas: [f64; LAYERS],
}

impl Layers {
    /// Of a rectangle, equal layers at their middles, stretched so that sum a eta^2 = I. Of a bar of any profile, a layer at each outer
    /// fibre and one on the axis, which A, I and the fibres determine; none where I > A |eta_1 eta_2|, which no profile has
    /// (Bhatia & Davis 2000).
    pub fn new(section: &Section) -> Option<Self> {
        let (area, [right, left]) = (section.area(), section.fibres());
        let (mut places, mut areas) = ([0.0; LAYERS], [0.0; LAYERS]);
        if section.is_rectangle() {
            let n = LAYERS as f64;
            let stretched = section.thickness() * n / (n * n - 1.0).sqrt();
            for (k, place) in places.iter_mut().enumerate() {
                *place = stretched * ((k as f64 + 0.5) / n - 0.5);
            }
            return Some(Self { count: LAYERS, places, areas: [area / n; LAYERS] });
        }
        let second_moment = section.second_moment();
        let web = area + second_moment / (right * left);
        if !(right < 0.0 && left > 0.0 && web >= 0.0) {
            return None;
        }
        places[..3].copy_from_slice(&[right, 0.0, left]);
        let flange = |fibre: f64| second_moment / (fibre.abs() * (left - right));
        areas[..3].copy_from_slice(&[flange(right), web, flange(left)]);
        Some(Self { count: 3, places, areas })
    }

    /// Places and areas.
    pub fn iter(&self) -> impl Iterator<Item = (f64, f64)> {
        let all = self.places.iter().copied().zip(self.areas.iter().copied());
        all.take(self.count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::BarSection;

    #[test]
    fn layers_have_area_and_second_moment_of_their_section() {
        let bar = |second_moment: f64| {
            let shear_modulus = 8e10;
            Section::bar(BarSection { area: 0.003, second_moment, shear_modulus, fibres: [-0.02, 0.05] })
        };
        for section in [Section::strip(0.01), Section::rectangular(0.02, 0.3), bar(1.1e-6)] {
            let layers = Layers::new(&section).unwrap();
            let moment = |power: i32| layers.iter().map(|(eta, area)| area * eta.powi(power)).sum::<f64>();
            assert!((moment(0) / section.area() - 1.0).abs() < 1e-14);
            assert!(moment(1).abs() < 1e-16);
            assert!((moment(2) / section.second_moment() - 1.0).abs() < 1e-14);
            assert!(layers.iter().all(|(eta, area)| area >= 0.0 && 2.0 * eta.abs() < 2.5 * section.thickness()));
        }
        assert!(Layers::new(&bar(3.1e-6)).is_none());
    }
}
