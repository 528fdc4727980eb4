//! The region of water that a host embeds.

use std::fmt::Display;

use sph_core::{Domain, FluidSettings, SchemeSettings, projection, wcsph};

use super::error::HostError;

/// Courant number at which the water's step breaks down (THEORY WC16) [-].
const BREAKDOWN_CFL: f64 = 1.2;

/// A rectangular basin of water at rest, and its scheme.
#[derive(Clone, Debug, PartialEq)]
pub struct FluidElementSpec {
    /// Finest particle spacing dx [m].
    pub spacing: f64,
    /// Half width of the basin, from its middle to either side wall [m].
    pub reach: f64,
    /// Depth of the water at rest [m].
    pub depth: f64,
    /// Height of the still-water line in the host's frame [m].
    pub still_water: f64,
    /// Middle of the basin [m]; `None`: the middle of the wet surface.
    pub middle: Option<f64>,
    /// Height of the side walls above still water [m]; `None`: 0.25 depth.
    pub rim: Option<f64>,
    /// Ratio of successive layers outside the fine zone, 1 to 1.5; 1 is uniform [-].
    pub growth: f64,
    /// Half width of the fine zone, about the middle of the wet surface [m]; `None`: 1.6 times half the wet surface's breadth, 10 spacings
    /// at least.
    pub fine_half_width: Option<f64>,
    /// Depth of the fine zone below still water [m]; `None`: half the wet surface's breadth, 4 spacings at least.
    pub fine_depth: Option<f64>,
    /// Acceleration of gravity on the water [x, y]; the host's own weight is the host's [m/s²].
    pub gravity: [f64; 2],
    /// Largest expected speed of the flow, such as the spray root's (pi/2) V/tan(deadrise) [m/s]; required unless the scheme has a speed of
    /// sound.
    pub fastest_speed: Option<f64>,
    /// The water.
    pub water: FluidSettings,
    /// The scheme.
    pub scheme: ElementScheme,
    /// Steps of the water above which a step of the host is refused [-].
    pub most_substeps: f64,
}

/// What gives the pressure, with its settings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ElementScheme {
    /// An equation of state.
    WeaklyCompressible(wcsph::Settings),
    /// A projection.
    Projection(projection::Settings),
}

impl Default for ElementScheme {
    fn default() -> ElementScheme {
        ElementScheme::WeaklyCompressible(wcsph::Settings::default())
    }
}

impl ElementScheme {
    /// Courant number of a step of the water [-].
    pub fn courant_number(&self) -> f64 {
        match self {
            ElementScheme::WeaklyCompressible(scheme) => scheme.courant_number(),
            ElementScheme::Projection(projection) => projection.courant_number(),
        }
    }
}

impl FluidElementSpec {
    /// The three lengths that have no default [m]: the finest spacing, the basin's half width and its depth. A speed is needed too:
    /// `fastest_speed` or [`FluidElementSpec::with_sound_speed`].
    pub fn new(spacing: f64, reach: f64, depth: f64) -> FluidElementSpec {
        FluidElementSpec {
            spacing,
            reach,
            depth,
            still_water: 0.0,
            middle: None,
            rim: None,
            growth: 1.1,
            fine_half_width: None,
            fine_depth: None,
            gravity: [0.0, -9.81],
            fastest_speed: None,
            water: FluidSettings::default(),
            scheme: ElementScheme::default(),
            most_substeps: 100_000.0,
        }
    }

    /// The same, weakly compressible with a numerical speed of sound [m/s].
    pub fn with_sound_speed(mut self, sound_speed: f64) -> FluidElementSpec {
        let scheme = match self.scheme {
            ElementScheme::WeaklyCompressible(scheme) => scheme,
            ElementScheme::Projection(_) => wcsph::Settings::default(),
        };
        self.scheme = ElementScheme::WeaklyCompressible(wcsph::Settings { sound_speed: sound_speed.into(), ..scheme });
        self
    }

    /// Refuses a value out of its range.
    pub(super) fn check(&self) -> Result<(), HostError> {
        let above_zero = [
            ("spacing", Some(self.spacing)),
            ("reach", Some(self.reach)),
            ("depth", Some(self.depth)),
            ("fine_half_width", self.fine_half_width),
            ("fine_depth", self.fine_depth),
            ("fastest_speed", self.fastest_speed),
            ("water.density", Some(self.water.density)),
            ("water.smoothing_ratio", Some(self.water.smoothing_ratio)),
        ];
        for (key, value) in above_zero.into_iter().filter_map(|(key, value)| Some((key, value?))) {
            require(value > 0.0 && value.is_finite(), key, value, "a finite number above 0")?;
        }
        let not_negative = [("rim", self.rim), ("water.kinematic_viscosity", Some(self.water.kinematic_viscosity))];
        for (key, value) in not_negative.into_iter().filter_map(|(key, value)| Some((key, value?))) {
            require(value >= 0.0 && value.is_finite(), key, value, "a finite number, 0 or above")?;
        }
        let finite = [self.still_water, self.middle.unwrap_or(0.0), self.gravity[0], self.gravity[1]];
        let wrong = finite.into_iter().find(|value| !value.is_finite());
        require(wrong.is_none(), "still_water, middle, gravity", wrong.unwrap_or_default(), "finite numbers")?;
        require((1.0..=1.5).contains(&self.growth), "growth", self.growth, "a number from 1 to 1.5")?;
        require(self.most_substeps >= 1.0, "most_substeps", self.most_substeps, "a number of 1 or more")?;
        let speed = self.speed_of_sound();
        let expected = "a number above 0 [m/s], or a speed of sound";
        require(speed > 0.0 && speed.is_finite(), "fastest_speed", "none", expected)?;
        let cfl = self.scheme.courant_number();
        let expected = format_args!("a number above 0 and below {BREAKDOWN_CFL}");
        require(cfl > 0.0 && cfl < BREAKDOWN_CFL, "cfl", cfl, expected)
    }

    /// Speed of sound c₀ [m/s]; of a projection ten times `fastest_speed`, which no node may exceed.
    pub fn speed_of_sound(&self) -> f64 {
        let fastest = self.fastest_speed.unwrap_or(f64::NAN);
        match &self.scheme {
            ElementScheme::WeaklyCompressible(scheme) => scheme.speed_of_sound(fastest),
            ElementScheme::Projection(_) => 10.0 * fastest,
        }
    }

    /// The water and the space it moves in.
    pub fn domain(&self) -> Domain {
        Domain {
            fluid: self.water,
            gravity: self.gravity,
            fastest_speed: self.fastest_speed.unwrap_or(0.1 * self.speed_of_sound()),
            starts_level: true,
            ..Domain::default()
        }
    }

    /// The scheme's settings.
    pub fn settings(&self) -> Box<dyn SchemeSettings> {
        match self.scheme {
            ElementScheme::WeaklyCompressible(scheme) => {
                Box::new(wcsph::Settings { sound_speed: self.speed_of_sound().into(), ..scheme })
            }
            ElementScheme::Projection(projection) => Box::new(projection),
        }
    }

    /// The water's step at rest [s] (THEORY WC12, PR14).
    pub(super) fn step_at_rest(&self) -> f64 {
        let h = self.water.smoothing_ratio * self.spacing;
        let own = match self.scheme {
            ElementScheme::WeaklyCompressible(_) => self.scheme.courant_number() * h / self.speed_of_sound(),
            ElementScheme::Projection(projection) => projection.step_at_rest(h, &self.domain()),
        };
        own.min(0.125 * h * h / self.water.kinematic_viscosity)
    }
}

fn require(holds: bool, key: &'static str, given: impl Display, expected: impl Display) -> Result<(), HostError> {
    let wrong = || HostError::Value { key, given: given.to_string(), expected: expected.to_string() };
    if holds { Ok(()) } else { Err(wrong()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bad_values_are_refused_with_their_name_given_and_expected() {
        let spec = FluidElementSpec::new(0.05, 1.0, 0.5).with_sound_speed(40.0);
        assert_eq!(spec.check(), Ok(()));
        let said = |change: fn(&mut FluidElementSpec)| {
            let mut changed = spec.clone();
            change(&mut changed);
            changed.check().expect_err("refused").to_string()
        };
        assert_eq!(said(|s| s.spacing = -1.0), "`spacing` = -1: expected a finite number above 0");
        assert_eq!(said(|s| s.growth = 2.0), "`growth` = 2: expected a number from 1 to 1.5");
        assert_eq!(said(|s| s.water.density = f64::NAN), "`water.density` = NaN: expected a finite number above 0");
        assert!(said(|s| s.gravity[1] = f64::INFINITY).contains("expected finite numbers"));
        assert!(said(|s| s.scheme = ElementScheme::default()).starts_with("`fastest_speed` = none: expected"));
        let fast = |s: &mut FluidElementSpec| {
            s.scheme = ElementScheme::WeaklyCompressible(wcsph::Settings {
                cfl: 1.2.into(),
                sound_speed: 40.0.into(),
                ..wcsph::Settings::default()
            });
        };
        assert_eq!(said(fast), "`cfl` = 1.2: expected a number above 0 and below 1.2");
    }

    #[test]
    fn the_speed_of_sound_is_ten_times_the_fastest_speed() {
        let spec = FluidElementSpec { fastest_speed: Some(4.5), ..FluidElementSpec::new(0.05, 2.0, 1.0) };
        assert_eq!(spec.speed_of_sound(), 45.0);
    }
}
