//! Tables of all cases and of the pressures: `cases.csv`, `pressure_envelope.csv`.

use std::collections::BTreeSet;

use super::cases::Case;
use super::findings::Findings;
use super::record::Record;

/// Columns before the numbers.
const HEAD: &str = "case,loading,mass_kg,centre_m,pitch_deg,sink_m_per_s,forward_m_per_s,wave_height_m,wave_length_m,peak_period_s,seed,heading_deg,\
    phase_deg,state,ended,reason,lost";

fn number(value: Option<f64>) -> String {
    value.map_or(String::new(), |value| value.to_string())
}

/// A text that holds commas and quotes.
fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('"', "\"\""))
}

/// A row for each case; numbers in the units of their names' table, empty where there are none.
pub fn cases_csv(cases: &[Case], records: &[Record]) -> String {
    let names: BTreeSet<&String> = records.iter().flat_map(|record| record.numbers.keys()).collect();
    let unit = |name: &&String| {
        let unit = super::quantity::Quantity::of(name).unit;
        format!(
            ",{name}_{}",
            match unit {
                "°" => "deg".into(),
                "-" => "ratio".into(),
                unit => unit.replace(' ', "").replace('/', "_per_").replace('³', "3"),
            }
        )
    };
    let head = names.iter().map(unit).collect::<String>();
    let row = |(case, record): (&Case, &Record)| {
        let keys = [
            case.number.to_string(),
            case.loading.clone(),
            case.mass_kg.to_string(),
            case.centre_m.to_string(),
            case.pitch_deg.to_string(),
            case.sink_m_per_s.to_string(),
            case.forward_m_per_s.map_or(String::new(), |v| format!("{v:.6}")),
            case.wave_height_m.to_string(),
            number(case.wave_length_m),
            number(case.peak_period_s),
            case.seed.map_or(String::new(), |seed| seed.to_string()),
            number(case.heading_deg),
            number(case.phase_deg),
            case.state.clone(),
            record.ended.words().into(),
            record.message.as_deref().map_or(String::new(), quoted),
            record.lost.iter().map(|(name, time)| format!("{name} {time}")).collect::<Vec<_>>().join("; "),
        ];
        let cell = |name: &&String| record.numbers.get(*name).map_or(String::new(), |[value, _]| format!("{value:e}"));
        let numbers = names.iter().map(cell);
        keys.into_iter().chain(numbers).collect::<Vec<_>>().join(",") + "\n"
    };
    format!("{HEAD}{head}\n") + &cases.iter().zip(records).map(row).collect::<String>()
}

/// A row for each cell of the bottom.
pub fn pressure_csv(findings: &Findings) -> String {
    let head = "x_from_m,x_to_m,girth_from,girth_to,mean_pressure_Pa,time_s,case\n".to_string();
    let of_place = |(k, cells): (usize, &Vec<super::Extreme>)| {
        let [from, to] = [findings.places_m[k], findings.places_m[k + 1]];
        let cell = |(j, worst): (usize, &super::Extreme)| {
            let [low, high] = [j, j + 1].map(|j| j as f64 / cells.len() as f64);
            let case = if worst.case == 0 { String::new() } else { worst.case.to_string() };
            format!("{from:.4},{to:.4},{low},{high},{:e},{},{case}\n", worst.value, worst.time_s)
        };
        cells.iter().enumerate().map(cell).collect::<String>()
    };
    head + &findings.envelope.pressure.iter().enumerate().map(of_place).collect::<String>()
}
