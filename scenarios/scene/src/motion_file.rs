//! `body.motion_file`: the motion of a body from a table over time.

use serde_json::{Value, json};
use settings::{Problem, require, significant};

use super::data_file::{DataFile, Fault, shortened};
use super::keys::parabola_rate;
use super::table_file::NumberTable;

const KEY: &str = "body.motion_file";
const KIND: &str = "a table of time and motion (.csv or .txt)";
/// Names of the columns of a motion: places x, y and angle, and their velocities; with the units of `displacements`.
const PLACES: [(&[&str], &str); 3] =
    [(&["x", "dx"], "m"), (&["y", "dy", "z", "heave"], "m"), (&["angle", "rotation", "pitch", "roll"], "deg")];
const SPEEDS: [(&[&str], &str); 3] =
    [(&["vx", "u"], "m/s"), (&["vy", "v", "vz"], "m/s"), (&["omega", "angular", "spin", "rate"], "deg/s")];
const TIMES: [&str; 2] = ["t", "time"];
/// Names of accelerations, which the program finds itself.
const ACCELERATIONS: [&str; 7] = ["ax", "ay", "az", "alpha", "acceleration", "accel", "acc"];

/// Difference of a mean speed between two rows from the mean of the velocities at them, over the largest velocity, up to which places and
/// velocities are one motion [-].
const ONE_MOTION: f64 = 1e-3;

/// Replaces `body.motion_file` by the rows of the table that it names, from the first row on; says which of its columns are left out.
pub(super) fn settle(given: &mut Value, scene_file: &str) -> Result<Vec<String>, Problem> {
    let Some(body) = given.get_mut("body").and_then(Value::as_object_mut) else { return Ok(Vec::new()) };
    let Some(name) = body.get("motion_file").and_then(Value::as_str).map(str::to_string) else { return Ok(Vec::new()) };
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
    let Motion { rows, rates, left_out } = rows(&file.text).map_err(|fault| file.problem(fault))?;
    body.remove("motion_file");
    body.insert("motion".into(), motion);
    body.insert("displacements".into(), json!(rows));
    if !rates.is_empty() {
        body.insert("displacement_rates".into(), json!(rates));
    }
    let notes = (!left_out.is_empty()).then(|| {
        let columns = left_out.join(", ");
        format!("{KEY} {name:?}: the accelerations {columns} are not read: those of the body follow from places and velocities")
    });
    Ok(notes.into_iter().collect())
}

/// Rows of time [s], displacement x, y [m] and rotation [deg] from the first row.
type Places = Vec<[f64; 4]>;
/// Their rates [m/s, m/s, deg/s].
type Rates = Vec<[f64; 3]>;

/// The motion of a table.
#[derive(Debug)]
struct Motion {
    rows: Places,
    /// If it gives a velocity, rates at all rows: those that it does not give are of parabolas.
    rates: Rates,
    /// Columns of accelerations.
    left_out: Vec<String>,
}

/// Refuses two columns of one quantity.
fn check_once(table: &NumberTable) -> Result<(), Fault> {
    let quantities = PLACES.iter().chain(&SPEEDS).map(|(names, _)| *names).chain([&TIMES[..]]);
    for names in quantities {
        let found: Vec<&str> = table.names.iter().map(String::as_str).filter(|name| names.contains(name)).collect();
        if let [first, second, ..] = found[..] {
            let given = format!("two columns of one quantity, {first} and {second}");
            return Err(Fault::new(table.header_line, given, "one column of each quantity"));
        }
    }
    Ok(())
}

/// Refuses velocities that are not those of the places: between two rows the mean speed is the mean of both velocities but for what their
/// change from row to row allows.
fn check_one_motion(
    table: &NumberTable,
    times: &[f64],
    values: &[f64],
    speeds: &[f64],
    names: [&str; 2],
) -> Result<(), Fault> {
    let largest = speeds.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
    let bend = |k: usize| match k {
        0 => 0.0,
        k if k + 1 == speeds.len() => 0.0,
        k => (speeds[k + 1] - 2.0 * speeds[k] + speeds[k - 1]).abs(),
    };
    for k in 0..times.len() - 1 {
        let mean = (values[k + 1] - values[k]) / (times[k + 1] - times[k]);
        let given = 0.5 * (speeds[k] + speeds[k + 1]);
        if (mean - given).abs() > ONE_MOTION * largest + 0.5 * bend(k).max(bend(k + 1)) {
            let [place, speed] = names;
            let what = format!(
                "since the row before {place} changes by {} a second and {speed} is {} in the mean, in SI units or degrees",
                significant(mean),
                significant(given)
            );
            return Err(Fault::new(
                table.rows[k + 1].0,
                what,
                format!("velocities of the places: leave {place} or {speed} out, or correct its unit"),
            ));
        }
    }
    Ok(())
}

/// The motion of a table.
fn rows(text: &str) -> Result<Motion, Fault> {
    let table = NumberTable::parse(text)?;
    let last = table.rows.last().map_or(1, |(line, _)| *line);
    if table.rows.len() < 2 {
        return Err(Fault::new(last, format!("{} rows", table.rows.len()), "two rows at least"));
    }
    let head = |expected: &str| {
        let expected = format!("{expected}{}", table.decimal_commas());
        Fault::new(table.header_line.max(1), format!("the columns {}", shortened(&table.names.join(", "))), expected)
    };
    check_once(&table)?;
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
            (Some(values), speeds_given) => {
                let name = |names: &[&str]| table.column(names).map_or("", |k| table.names[k].as_str());
                let names = [name(places), name(speeds)];
                speeds_given.as_ref().map_or(Ok(()), |v| check_one_motion(&table, &times, &values, v, names))?;
                values.iter().map(|value| value - values[0]).collect()
            }
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
    let left_out = table.names.iter().filter(|name| ACCELERATIONS.contains(&name.as_str())).cloned().collect();
    Ok(Motion { rows: motion, rates, left_out })
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
        let read = |text: &str| rows(text).map(|motion| (motion.rows, motion.rates)).expect("rows");
        let (found, rates) = read("t [ms]; y [mm]; angle [rad]\n0; 5; 0\n10; 4; 0,1\n");
        assert!((found[1][0] - 0.01).abs() < 1e-15 && (found[1][2] + 1e-3).abs() < 1e-15, "{found:?}");
        assert!((found[1][3] - 0.1_f64.to_degrees()).abs() < 1e-12);
        assert!(rates.is_empty(), "places alone");
        let (found, rates) = read("time_s,body.vy_m_per_s\n0,-1\n0.5,-1\n1,-3\n");
        assert_eq!(found, [[0.0, 0.0, 0.0, 0.0], [0.5, 0.0, -0.5, 0.0], [1.0, 0.0, -1.5, 0.0]]);
        assert_eq!(rates, [[0.0, -1.0, 0.0], [0.0, -1.0, 0.0], [0.0, -3.0, 0.0]]);
    }

    /// y = −t² with its velocities is one motion at any rows; with the speeds of another one, or in another unit, it is not.
    #[test]
    fn velocities_that_are_not_those_of_the_places_are_refused() {
        let table = |factor: f64| {
            let row = |k: i32| {
                let t = 0.1 * f64::from(k);
                format!("{t},{},{}\n", -t * t, -2.0 * t * factor)
            };
            format!("t,y,vy\n{}", (0..6).map(row).collect::<String>())
        };
        assert_eq!(rows(&table(1.0)).expect("one motion").rates[5][1], -1.0);
        let fault = rows(&table(1.1)).expect_err("another speed");
        assert!(fault.expected.contains("leave y or vy out"), "{fault:?}");
        assert_eq!(rows(&table(1000.0)).expect_err("mm/s").line, 3);
        // a sine of twenty rows a period is smooth enough
        let row = |k: i32| {
            let t = 0.05 * f64::from(k);
            let phase = std::f64::consts::TAU * t;
            format!("{t},{},{}\n", phase.sin(), std::f64::consts::TAU * phase.cos())
        };
        let sine = format!("t,y,vy\n{}", (0..41).map(row).collect::<String>());
        assert!(rows(&sine).is_ok(), "{:?}", rows(&sine));
    }

    #[test]
    fn a_quantity_given_twice_is_refused_and_accelerations_are_reported() {
        for header in ["t,y,y", "t,y,heave", "t,vy,v", "t,time,y"] {
            let fault = rows(&format!("{header}\n0,0,0\n1,1,1\n")).expect_err(header);
            assert!(fault.line == 1 && fault.given.contains("two columns of one quantity"), "{header}: {fault:?}");
        }
        assert_eq!(rows("t,y,ay\n0,0,0\n1,-1,-2\n").expect("rows").left_out, ["ay"]);
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
