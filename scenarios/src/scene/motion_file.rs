//! `body.motion_file`: the motion of a body from a table over time.

use fsi_coupling::settings::{Problem, require};
use serde_json::{Value, json};

use super::data_file::{DataFile, Fault, shortened};
use super::settings::parabola_rate;
use super::table_file::NumberTable;

const KEY: &str = "body.motion_file";
const KIND: &str = "a table of time and motion (.csv or .txt)";
/// Names of the columns of a motion: places x, y and angle, and their velocities; with the units of `displacements`.
const PLACES: [(&[&str], &str); 3] =
    [(&["x", "dx"], "m"), (&["y", "dy", "z", "heave"], "m"), (&["angle", "rotation", "pitch", "roll"], "deg")];
const SPEEDS: [(&[&str], &str); 3] =
    [(&["vx", "u"], "m/s"), (&["vy", "v", "vz"], "m/s"), (&["omega", "angular", "spin", "rate"], "deg/s")];
const TIMES: [&str; 2] = ["t", "time"];

/// Replaces `body.motion_file` by the rows of the table that it names, from the first row on.
pub(super) fn settle(given: &mut Value, scene_file: &str) -> Result<(), Problem> {
    let Some(body) = given.get_mut("body").and_then(Value::as_object_mut) else { return Ok(()) };
    let Some(name) = body.get("motion_file").and_then(Value::as_str).map(str::to_string) else { return Ok(()) };
    let beside = |key: &str| body.get(key).is_some();
    require(
        !beside("displacements") && !beside("displacement_rates"),
        KEY,
        format_args!("{name:?}"),
        "no body.displacements beside it",
    )?;
    let motion = body.get("motion").cloned().unwrap_or_else(|| json!("tabulated"));
    require(motion == "tabulated", KEY, format_args!("{name:?}"), "motion = \"tabulated\" beside it")?;
    let file = DataFile::read(scene_file, KEY, &name, KIND)?;
    let (rows, rates) = rows(&file.text).map_err(|fault| file.problem(fault))?;
    body.remove("motion_file");
    body.insert("motion".into(), motion);
    body.insert("displacements".into(), json!(rows));
    if !rates.is_empty() {
        body.insert("displacement_rates".into(), json!(rates));
    }
    Ok(())
}

/// Rows of time [s], displacement x, y [m] and rotation [deg] from the first row.
type Places = Vec<[f64; 4]>;
/// Their rates [m/s, m/s, deg/s].
type Rates = Vec<[f64; 3]>;

/// The places of a table; and, if it gives a velocity, rates at all rows: those that it does not give are of parabolas.
fn rows(text: &str) -> Result<(Places, Rates), Fault> {
    let table = NumberTable::parse(text)?;
    let last = table.rows.last().map_or(1, |(line, _)| *line);
    if table.rows.len() < 2 {
        return Err(Fault::new(last, format!("{} rows", table.rows.len()), "two rows at least"));
    }
    let head = |expected: &str| {
        let expected = format!("{expected}{}", table.decimal_commas());
        Fault::new(table.header_line.max(1), format!("the columns {}", shortened(&table.names.join(", "))), expected)
    };
    let time = table.column(&TIMES).ok_or_else(|| head("a header that names a column of time, t or time"))?;
    let column = |names: &[&str], unit: &str| -> Result<Option<Vec<f64>>, Fault> {
        let Some(k) = table.column(names) else { return Ok(None) };
        let factor = table.factor(k, unit)?;
        Ok(Some(table.rows.iter().map(|(_, row)| factor * row[k]).collect()))
    };
    let factor = table.factor(time, "s")?;
    let times: Vec<f64> = table.rows.iter().map(|(_, row)| factor * row[time]).collect();
    if let Some(k) = times.windows(2).position(|pair| pair[1] <= pair[0]) {
        let (line, row) = &table.rows[k + 1];
        return Err(Fault::new(*line, format!("the time {}", row[time]), "a time after that of the row before"));
    }
    let mut motion = vec![[0.0; 4]; times.len()];
    motion.iter_mut().zip(&times).for_each(|(row, time)| row[0] = *time);
    let mut given: [Option<Vec<f64>>; 3] = Default::default();
    let mut found = 0;
    for (k, ((places, length), (speeds, speed))) in PLACES.iter().zip(SPEEDS).enumerate() {
        given[k] = column(speeds, speed)?;
        let values = match (column(places, length)?, &given[k]) {
            (Some(values), _) => values.iter().map(|value| value - values[0]).collect(),
            (None, Some(speeds)) => integral(&times, speeds),
            (None, None) => continue,
        };
        found += 1;
        motion.iter_mut().zip(values).for_each(|(row, value)| row[k + 1] = value);
    }
    if found == 0 {
        return Err(head("a header that names x, y or angle, or the velocities vx, vy or omega"));
    }
    let rate = |row: usize, k: usize| given[k].as_ref().map_or_else(|| parabola_rate(&motion, row, k + 1), |v| v[row]);
    let rates = match given.iter().any(Option::is_some) {
        true => (0..motion.len()).map(|row| [0, 1, 2].map(|k| rate(row, k))).collect(),
        false => Rates::new(),
    };
    Ok((motion, rates))
}

/// Integral over time from the first row, of values that are linear between rows.
fn integral(times: &[f64], values: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    let steps = times.windows(2).zip(values.windows(2)).map(|(t, v)| 0.5 * (t[1] - t[0]) * (v[0] + v[1]));
    let after = steps.map(|step| {
        sum += step;
        sum
    });
    std::iter::once(0.0).chain(after).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_and_velocities_are_read_in_their_units() {
        let (found, rates) = rows("t [ms]; y [mm]; angle [rad]\n0; 5; 0\n10; 4; 0,1\n").expect("rows");
        assert!((found[1][0] - 0.01).abs() < 1e-15 && (found[1][2] + 1e-3).abs() < 1e-15, "{found:?}");
        assert!((found[1][3] - 0.1_f64.to_degrees()).abs() < 1e-12);
        assert!(rates.is_empty(), "places alone");
        let (found, rates) = rows("time_s,body.vy_m_per_s\n0,-1\n0.5,-1\n1,-3\n").expect("rows");
        assert_eq!(found, [[0.0, 0.0, 0.0, 0.0], [0.5, 0.0, -0.5, 0.0], [1.0, 0.0, -1.5, 0.0]]);
        assert_eq!(rates, [[0.0, -1.0, 0.0], [0.0, -1.0, 0.0], [0.0, -3.0, 0.0]]);
    }

    #[test]
    fn times_that_fall_and_columns_without_names_are_refused_with_their_line() {
        for (text, line, part) in [
            ("t,y\n0,0\n1,1\n1,2\n", 4, "a time after"),
            ("0,0\n1,1\n", 1, "a column of time"),
            ("t,q\n0,0\n1,1\n", 1, "names x, y or angle"),
            ("t,y\n0,0\n", 2, "two rows"),
            ("t [kg],y\n0,0\n1,1\n", 1, "a unit like s"),
        ] {
            let fault = rows(text).expect_err(text);
            assert!(fault.line == line && fault.expected.contains(part), "{text}: {fault:?}");
        }
    }
}
