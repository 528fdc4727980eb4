//! Tables of a landing's page: pressures along the girth, windows, flotation.

use report::run_page::quantity::{Unit, digits, with_unit};
use report::{Block, Chart, Curve, Mark, Table, row};
use water_entry::ditching::PressureMap;

use super::flotation::{Flotation, SillTime};
use super::landed::{Landed, seconds};
use super::windows::WindowLoad;

/// Cells of the map that a line of the page's table spans.
const CELLS: usize = 2;

/// What of these a landing has.
pub(super) fn blocks(landed: &Landed) -> Vec<Block> {
    let structure = &landed.summary.structure;
    let windows = (!structure.windows.is_empty()).then(|| Block::Table(windows_table(&structure.windows)));
    let map = landed.map.as_ref().map(|map| Block::Table(map_table(map)));
    let afloat = structure.flotation.iter().flat_map(|afloat| {
        [Block::Text(sentence(afloat)), Block::Table(sills_table(afloat))].into_iter().chain(chart(afloat))
    });
    windows.into_iter().chain(map).chain(afloat).collect()
}

fn windows_table(windows: &[WindowLoad]) -> Table {
    let line = |w: &WindowLoad| {
        let ends = format!("{} to {}", digits(w.ends_m[0]), digits(w.ends_m[1]));
        row(&[
            &w.name,
            &ends,
            &digits(w.area_m2),
            &with_unit(w.mean_pressure_pa.value, "Pa"),
            &digits(w.mean_pressure_pa.time_s),
        ])
    };
    let head = ["window", "from the nose [m]", "area of one side [m²]", "largest mean pressure", "time [s]"];
    Table::new("Windows: largest mean pressure", &head, windows.iter().map(line).collect())
}

fn map_table(map: &PressureMap) -> Table {
    let of_line = |first: usize| {
        let cells = first..(first + CELLS).min(map.mean.len());
        let means = (0..map.shares).map(|k| cells.clone().map(|c| map.mean[c][k][0]).fold(0.0, f64::max));
        (map.places[first], map.places[cells.end], means.collect::<Vec<f64>>())
    };
    let lines: Vec<_> = (0..map.mean.len()).step_by(CELLS).map(of_line).collect();
    let unit = Unit::of("Pa", lines.iter().flat_map(|(.., means)| means).fold(0.0, |most: f64, v| most.max(*v)));
    let pressed = lines.iter().filter(|(.., means)| means.iter().any(|mean| *mean > 0.0));
    let rows = pressed.map(|(from, to, means)| {
        let ends = format!("{} to {}", digits(*from), digits(*to));
        std::iter::once(ends).chain(means.iter().map(|v| digits(unit.scale * v))).collect()
    });
    let share = |k: usize| format!("{} %", digits(100.0 * (k as f64 + 1.0) / map.shares as f64));
    let heads = (0..map.shares).map(|k| format!("up to {}", share(k)));
    let head: Vec<String> = std::iter::once("from the nose [m]".to_string()).chain(heads).collect();
    let title = format!(
        "Largest mean pressure [{}] on cells along the fuselage and the girth, from the keel to the edge (0 to 100 %); pressure_map.csv has \
         smaller cells and the times",
        unit.name
    );
    Table::new(title, &head.iter().map(String::as_str).collect::<Vec<_>>(), rows.collect())
}

fn sentence(afloat: &Flotation) -> String {
    if !afloat.floats {
        return "After the stop the fuselage sinks at once, or has no trim within 31 degrees.".into();
    }
    let sinks = afloat.sinks_at_s.map_or("It floats to the end of the time asked for.".to_string(), |t| {
        format!("It sinks, or finds no trim within 31 degrees, {} after the stop.", seconds(t))
    });
    format!(
        "After the stop it floats with the water {} over the body axis at the centre of mass, at a trim of {}°, nose up; the volume of the \
         fuselage is {} times what its mass displaces. {sinks} Buoyancy of wing and engines is left out, so are waves, roll and air that cannot \
         escape; water runs through one space from nose to tail.",
        with_unit(afloat.waterline_m, "m"),
        digits(afloat.trim_deg),
        digits(afloat.reserve)
    )
}

fn sills_table(afloat: &Flotation) -> Table {
    let line = |s: &SillTime| {
        let reached = s.reached_s.map_or("stays dry".to_string(), seconds);
        row(&[&s.name, &digits(s.area_m2), &digits(s.over_water_m), &reached])
    };
    let head = ["opening", "area [m²]", "sill over the water after the stop [m]", "sill under water after"];
    Table::new("Flotation: openings, and panels that gave way", &head, afloat.openings.iter().map(line).collect())
}

fn chart(afloat: &Flotation) -> Option<Block> {
    let curve = |k: usize, label: &str| {
        Curve::new(label, Mark::Line, afloat.series.iter().map(|row| [row[0], row[k]]).collect::<Vec<_>>())
    };
    let curves = vec![curve(2, "water over the body axis at the centre of mass [m]"), curve(3, "trim, nose up [°]")];
    (afloat.series.len() > 1).then(|| Block::Chart(Chart::new("Flotation", "time after the stop [s]", "", curves)))
}
