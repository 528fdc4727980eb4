//! Forces of connectors and their tangents (THEORY BE27).

use super::{Arms, Equations, System};
use crate::linear_algebra::Bordered;
use crate::model::{Beam, Between, Connection, Rows};

/// Entries between degrees of freedom: places of row and column, and the value.
type Entry = ([(usize, usize); 2], f64);

/// `left`^T D `right` with a diagonal D, over the degrees of freedom of a connection.
fn product<'a>(
    connection: &'a Connection,
    left: &'a Rows,
    diagonal: [f64; 3],
    right: &'a Rows,
) -> impl Iterator<Item = Entry> + 'a {
    let place = |k: usize| (if k < 3 { connection.node } else { connection.body }, k % 3);
    let value = move |i: usize, j: usize| (0..3).map(|k| left[k][i] * diagonal[k] * right[k][j]).sum::<f64>();
    (0..36).map(move |k| ([place(k / 6), place(k % 6)], value(k / 6, k % 6)))
}

impl Equations {
    /// Entries of the connectors' stiffness in the undeformed model, by equations.
    pub fn connector_stiffness(&self, beam: &Beam, connections: &[Connection], mut add: impl FnMut(usize, usize, f64)) {
        let (arms, still) = (self.links.arms(), vec![[0.0; 3]; beam.nodes().len()]);
        for connection in connections {
            let rows = connection.between(beam, &still, &still).rows;
            for (places, value) in product(connection, &rows, connection.connector.stiffness, &rows) {
                self.scatter_entry(places, value, [&arms, &arms], &mut add);
            }
        }
    }
}

impl System {
    /// Adds the mean elastic forces over a step with the `weight` of its end; returns their work beyond the change of the elastic
    /// energy \[J\]. `tangent`: adds the derivative by the displacement at the end.
    pub fn add_connector_forces(
        &self,
        [from, to]: [&[[f64; 3]]; 2],
        weight: f64,
        forces: &mut [[f64; 3]],
        mut tangent: Option<(Arms, &mut Bordered)>,
    ) -> f64 {
        let mut dissipated = 0.0;
        for connection in &self.supports.connections {
            let [before, after] = [from, to].map(|q| connection.deformation(&self.beam, q));
            let stiffness = connection.connector.stiffness;
            let over = connection.between(&self.beam, from, to);
            let generalised = [0, 1, 2].map(|k| stiffness[k] * ((1.0 - weight) * before[k] + weight * after[k]));
            connection.add_forces(&over.rows, generalised, forces);
            dissipated += (weight - 0.5) * 2.0 * connection.energy([0, 1, 2].map(|k| after[k] - before[k]));
            if let Some((arms, matrix)) = &mut tangent {
                let end = connection.between(&self.beam, to, to).rows;
                let scaled = stiffness.map(|k| weight * k);
                self.add_entries(product(connection, &over.rows, scaled, &end), *arms, matrix);
                self.add_connector_rotation(connection, &over, generalised, 0.5, (*arms, &mut *matrix));
            }
        }
        dissipated
    }

    /// Adds the elastic forces at a displacement, and `factor` times their derivative by it to a matrix.
    pub fn add_connector_forces_at(
        &self,
        q: &[[f64; 3]],
        forces: &mut [[f64; 3]],
        mut tangent: Option<(f64, Arms, &mut Bordered)>,
    ) {
        for connection in &self.supports.connections {
            let (deformation, stiffness) = (connection.deformation(&self.beam, q), connection.connector.stiffness);
            let here = connection.between(&self.beam, q, q);
            let generalised = [0, 1, 2].map(|k| stiffness[k] * deformation[k]);
            connection.add_forces(&here.rows, generalised, forces);
            if let Some((factor, arms, matrix)) = &mut tangent {
                let scaled = stiffness.map(|k| *factor * k);
                self.add_entries(product(connection, &here.rows, scaled, &here.rows), *arms, matrix);
                self.add_connector_rotation(connection, &here, generalised, *factor, (*arms, &mut *matrix));
            }
        }
    }

    /// Adds the derivative of B^T g at constant g: the force F turns by `share` of the body's rotation, and its arm grows by `share`
    /// of the displacement.
    fn add_connector_rotation(
        &self,
        connection: &Connection,
        Between { rows: [axis, normal, _], arm }: &Between,
        generalised: [f64; 3],
        share: f64,
        (arms, matrix): (Arms, &mut Bordered),
    ) {
        let (node, body) = (connection.node, connection.body);
        let [x, y] = [0, 1].map(|k| axis[k] * generalised[0] + normal[k] * generalised[1]);
        let turned = [((node, 0), -y), ((node, 1), x), ((body, 0), y), ((body, 1), -x)];
        let symmetric =
            turned.into_iter().flat_map(|(place, value)| [([place, (body, 2)], value), ([(body, 2), place], value)]);
        let own = ([(body, 2), (body, 2)], -(arm[0] * x + arm[1] * y));
        self.add_entries(symmetric.chain([own]).map(|(places, value)| (places, share * value)), arms, matrix);
    }

    /// Adds the forces of the dampers, and of Rayleigh's `stiffness_damping` \[s\] on the springs, at velocities `v` over a step.
    pub fn add_damper_forces(
        &self,
        [from, to]: [&[[f64; 3]]; 2],
        v: &[[f64; 3]],
        stiffness_damping: f64,
        forces: &mut [[f64; 3]],
    ) {
        for connection in &self.supports.connections {
            let rows = connection.between(&self.beam, from, to).rows;
            let (rate, damping) = (connection.rate(&rows, v), damping_of(connection, stiffness_damping));
            connection.add_forces(&rows, [0, 1, 2].map(|k| damping[k] * rate[k]), forces);
        }
    }

    /// Adds `factor` times the derivative of the dampers' forces by velocity.
    pub fn add_damper_tangent(
        &self,
        q: &[[f64; 3]],
        stiffness_damping: f64,
        factor: f64,
        arms: Arms,
        matrix: &mut Bordered,
    ) {
        for connection in &self.supports.connections {
            let rows = connection.between(&self.beam, q, q).rows;
            let damping = damping_of(connection, stiffness_damping).map(|damping| factor * damping);
            self.add_entries(product(connection, &rows, damping, &rows), arms, matrix);
        }
    }

    fn add_entries(&self, entries: impl Iterator<Item = Entry>, arms: Arms, matrix: &mut Bordered) {
        for (places, value) in entries.filter(|(_, value)| *value != 0.0) {
            self.equations.scatter_entry(places, value, arms, |row, column, value| matrix.add(row, column, value));
        }
    }
}

/// Coefficients of a connection's dampers, with Rayleigh's damping of its springs.
fn damping_of(connection: &Connection, stiffness_damping: f64) -> [f64; 3] {
    let Connection { connector, .. } = connection;
    [0, 1, 2].map(|k| connector.damping[k] + stiffness_damping * connector.stiffness[k])
}
