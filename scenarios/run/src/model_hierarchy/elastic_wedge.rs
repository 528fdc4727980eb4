//! A wedge with elastic faces, by Wagner's load on a modal beam (THEORY EN12, EN13).

use fsi_coupling::{EndSpring, PanelEnd};
use scene::{Body, Motion, Panel, Scene, Shape, Symmetry};
use water_entry::{ElasticWedge, EntryModel, Held, Instant, OutOfRange, WedgeState};

/// Modes, and steps from touch to chine.
const MODES: usize = 8;
const STEPS: usize = 200;
/// Largest number of steps, and largest phase of the stiffest mode per step [rad]: 2.8 is unstable.
const MOST_STEPS: usize = 4000;
const LONGEST_TURN: f64 = 1.5;
/// Largest deflection over the length [-].
const DEEPEST: f64 = 0.1;
/// Places along the face at which the largest stress is looked for.
const PLACES: usize = 40;

/// The faces of a scene's wedge during its entry.
#[derive(Clone, Debug)]
pub(super) struct Faces {
    wedge: ElasticWedge,
    bent: Vec<WedgeState>,
    /// Momentum of the water [N s/m], potential at each gauge [m²/s], and values of the panel's columns, at every step.
    momenta: Vec<f64>,
    potentials: Vec<Vec<f64>>,
    columns: Vec<Vec<f64>>,
}

impl Faces {
    /// Of a scene by half whose only panel is the whole face.
    pub fn of(scene: &Scene, body: &Body) -> Result<Faces, OutOfRange> {
        let refuse = |what: &str| OutOfRange {
            what: what.into(),
            range:
                "faces that bend from keel to chine, of a wedge at constant speed without gravity, simulated by half"
                    .into(),
            next: EntryModel::Wcsph,
        };
        let (Shape::Wedge { deadrise_deg, breadth, .. }, [panel]) = (&body.shape, &body.panels[..]) else {
            return Err(refuse("other panels"));
        };
        let (half, near) = (0.5 * breadth, |a: f64, b: f64| (a - b).abs() < 1e-3 * breadth);
        let whole = near(panel.from[0], 0.0) && near(panel.from[1], 0.0) && near(panel.to[0], half);
        let steady = body.motion == Motion::ConstantVelocity && scene.gravity == [0.0, 0.0];
        if scene.symmetry != Symmetry::X || !whole || !steady || body.draught().abs() > 1e-9 * breadth {
            return Err(refuse("another panel, course or start"));
        }
        if panel.yield_stress.is_some() || panel.rupture_strain.is_some() {
            return Err(refuse("a panel that may yield or break"));
        }
        if panel.bars.is_some() {
            return Err(refuse("a panel of bars"));
        }
        if panel.end_springs().iter().any(EndSpring::acts) {
            return Err(refuse("springs or dampers at an end"));
        }
        let held = match panel.ends.map(held) {
            [Some(keel), Some(chine)] => [keel, chine],
            _ => return Err(refuse("an end that is free or on the mirror")),
        };
        let mut wedge = ElasticWedge {
            deadrise_deg: *deadrise_deg,
            speed: -body.velocity[1],
            density: scene.water().density,
            length: half,
            thickness: panel.thickness,
            section: panel.plane.section(panel.thickness),
            material: panel.material(),
            held,
            modes: MODES,
            steps: STEPS,
        };
        // high modes of stiff faces carry no deflection and need short steps
        while wedge.modes > 1 && steps_for(&wedge, panel) > MOST_STEPS {
            wedge.modes -= 1;
        }
        wedge.steps = steps_for(&wedge, panel);
        if wedge.steps > MOST_STEPS {
            return Err(refuse("an entry so slow that its faces only follow the pressure"));
        }
        let mut bent = wedge.enter().ok_or_else(|| refuse("a face that bends as fast as the water comes"))?;
        let (every, last) = (wedge.steps / STEPS, bent[bent.len() - 1].clone());
        bent = bent.into_iter().step_by(every).collect();
        if bent[bent.len() - 1].time < last.time {
            bent.push(last);
        }
        let deep = bent.iter().map(|b| wedge.deflection(b, 0.5).abs()).fold(0.0, f64::max);
        if deep > DEEPEST * half {
            return Err(refuse("a face that bends by more than a tenth of its length"));
        }
        let momenta = bent.iter().map(|b| wedge.momentum(b)).collect();
        let at = |b: &WedgeState| scene.gauges.iter().map(|g| wedge.potential(b, g.at[0].abs())).collect();
        let potentials = bent.iter().map(at).collect();
        let columns = bent.iter().map(|b| columns(&wedge, panel, b)).collect();
        Ok(Faces { wedge, bent, momenta, potentials, columns })
    }

    /// The wedge at `times` [s] up to when its chines get wet.
    pub fn instants(&self, times: &[f64]) -> Vec<Instant> {
        let end = self.bent[self.bent.len() - 1].time;
        let at = |&time: &f64| {
            let (k, share) = self.between(time);
            let wetted = self.bent[k].wetted + share * (self.bent[k + 1].wetted - self.bent[k].wetted);
            let (speed, force) = (self.wedge.speed, self.rate(k, |k| self.momenta[k]));
            Instant { time, draught: speed * time, speed, rate: 0.0, force, wetted }
        };
        times.iter().take_while(|time| **time <= end).map(at).collect()
    }

    /// Values of the panel's columns, then of the gauges, at a time [s].
    pub fn values(&self, time: f64) -> Vec<f64> {
        let (k, share) = self.between(time);
        let column = |c: usize| self.columns[k][c] + share * (self.columns[k + 1][c] - self.columns[k][c]);
        let pressure = |g: usize| 0.0 - self.wedge.density * self.rate(k, |k| self.potentials[k][g]);
        let (panel, gauges) = (self.columns[k].len(), self.potentials[k].len());
        (0..panel).map(column).chain((0..gauges).map(pressure)).collect()
    }

    /// The step that a time is in, and how far in it.
    fn between(&self, time: f64) -> (usize, f64) {
        let k = self.bent.partition_point(|b| b.time <= time).clamp(1, self.bent.len() - 1) - 1;
        (k, (time - self.bent[k].time) / (self.bent[k + 1].time - self.bent[k].time))
    }

    /// d/dt of a quantity in step k.
    fn rate(&self, k: usize, of: impl Fn(usize) -> f64) -> f64 {
        (of(k + 1) - of(k)) / (self.bent[k + 1].time - self.bent[k].time)
    }
}

/// How the modal beam holds an end; its membrane force is zero. `None` for an end that it does not have.
fn held(end: PanelEnd) -> Option<Held> {
    match end {
        PanelEnd::Clamped | PanelEnd::Guided => Some(Held::Clamped),
        PanelEnd::Pinned | PanelEnd::Sliding => Some(Held::Pinned),
        PanelEnd::Free | PanelEnd::Mirror => None,
    }
}

/// Steps from touch to chine that the stiffest mode allows, dry: ω = (kL)² √(D/m)/L².
fn steps_for(wedge: &ElasticWedge, panel: &Panel) -> usize {
    let ElasticWedge { thickness, material, length, .. } = wedge;
    let half = match wedge.held {
        [Held::Pinned, Held::Pinned] => 0.0,
        [Held::Clamped, Held::Clamped] => 0.5,
        _ => 0.25,
    };
    let root = (wedge.modes as f64 + half) * std::f64::consts::PI;
    let stiffness = panel.plane.modulus(material) * thickness.powi(2) / 12.0;
    let turn = root.powi(2) * (stiffness / material.density).sqrt() / length.powi(2);
    let lasts = std::f64::consts::FRAC_2_PI * wedge.deadrise_deg.to_radians().tan() * length / wedge.speed;
    ((turn * lasts / LONGEST_TURN).ceil() as usize).max(STEPS)
}

/// Values of the panel's columns, in the order of [`Panel::columns`].
fn columns(wedge: &ElasticWedge, panel: &Panel, bent: &WedgeState) -> Vec<f64> {
    let (sin, cos) = wedge.deadrise_deg.to_radians().sin_cos();
    let modulus = panel.plane.modulus(&wedge.material);
    let watched = panel.watch.iter().flat_map(|&place| {
        let (w, strain) = (wedge.deflection(bent, place), wedge.strain(bent, place));
        let moment = -modulus * wedge.thickness.powi(2) / 6.0 * strain; // D d²w/dx²
        [-w * sin, w * cos, w, moment, strain, -strain]
    });
    let places = (0..=PLACES).map(|i| i as f64 / PLACES as f64);
    let largest = places.map(|place| wedge.strain(bent, place).abs()).fold(0.0, f64::max);
    watched.chain([modulus * largest]).collect()
}
