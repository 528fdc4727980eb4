//! Bodies in the waves of a wave maker: means and harmonics of loads and motions.

use super::quantity::{digits, with_unit};
use super::record::{BodyInWaves, Harmonics, Record};
use crate::{Block, Table};

/// A text and a table per body; nothing without waves.
pub(super) fn waves_section(record: &Record) -> Vec<Block> {
    record.waves.bodies.iter().flat_map(of_body).collect()
}

fn of_body(body: &BodyInWaves) -> Vec<Block> {
    let amplitude = |what: &str, value: Option<f64>| value.map(|a| format!(" {what} {}.", with_unit(a, "m")));
    let amplitudes: String = [
        amplitude("Amplitude of the incident waves", body.incident_m),
        amplitude("Reflected", body.reflected_m),
        amplitude("Transmitted", body.transmitted_m),
    ]
    .into_iter()
    .flatten()
    .collect();
    let [from, to] = body.window_s;
    let bars = match body.fx.first_band {
        Some(_) => {
            "the band (GE29), of the means of moment and motions the 95 % interval by the scatter from period to period"
        }
        None => {
            "the 95 % interval of their mean by the scatter from period to period; it does not include the error of the spacing"
        }
    };
    let text = format!(
        "{}: mean and harmonics over {} periods, {from:.2} to {to:.2} s. ± is {bars}. The mean is less that before the waves.{amplitudes} Over a: per metre of incident \
         amplitude, mean and second harmonic per square metre. By theory: linear potential theory.",
        body.body, body.periods
    );
    let rows = [
        ("force along x, N/m", &body.fx),
        ("force along y, N/m", &body.fy),
        ("moment, N", &body.moment),
        ("x of the centre of mass, m", &body.x_m),
        ("y of the centre of mass, m", &body.y_m),
        ("angle, deg", &body.angle_deg),
    ];
    let shown = rows.into_iter().filter(|(_, h)| h.first > 0.0).map(|(name, h)| row_of(name, h));
    let head = [
        "load or motion",
        "mean",
        "first harmonic",
        "second harmonic",
        "mean over a²",
        "first over a",
        "second over a²",
    ];
    vec![Block::Text(text), Block::Table(Table::new(format!("{} in waves", body.body), &head, shown.collect()))]
}

fn row_of(name: &str, h: &Harmonics) -> Vec<String> {
    let with = |value: f64, band: Option<f64>, interval: f64| {
        format!("{} ± {}", digits(value), digits(band.unwrap_or(interval)))
    };
    let over = |value: Option<f64>| value.map_or("–".into(), digits);
    let per = h.per_amplitude;
    vec![
        name.into(),
        with(h.mean, h.mean_band, h.mean_plus_minus),
        with(h.first, h.first_band, h.first_plus_minus),
        with(h.second, h.second_band, h.second_plus_minus),
        over(per.map(|p| p.mean)),
        over(per.and_then(|p| p.mean_by_theory)),
        over(per.map(|p| p.first)),
        over(per.and_then(|p| p.first_by_theory)),
        over(per.map(|p| p.second)),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_body_in_waves_has_a_row_for_each_load_that_varies() {
        let fx = Harmonics { mean: 1.5, first: 30.0, first_plus_minus: 0.5, ..Harmonics::default() };
        let body =
            BodyInWaves { body: "hull".into(), periods: 6, incident_m: Some(0.02), fx, ..BodyInWaves::default() };
        let mut record = Record::default();
        assert!(waves_section(&record).is_empty());
        record.waves.bodies = vec![body];
        let blocks = waves_section(&record);
        let Block::Table(table) = &blocks[1] else { panic!("a table") };
        assert_eq!(table.rows.len(), 1);
        assert_eq!(&table.rows[0][..3], ["force along x, N/m", "1.50 ± 0", "30.0 ± 0.500"]);
    }
}
