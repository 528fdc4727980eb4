//! Force on a wedge that falls into water, by three theories: `cargo run --release -p water_entry --example falling_wedge`.
//!
//! A wedge of 30 degrees, 0.5 m broad and of 241 kg/m (the size of Zhao, Faltinsen & Aarsnes 1996) touches the water at 6.15 m/s.
//! Wagner's formula (1932) has the water's pile-up and gives too much at this deadrise. The modified Logvinovich model (Korobkin
//! 2004) adds the pressure's square terms. Boundary elements solve the nonlinear potential flow and are the reference here.

use water_entry::{Entry, EntryModel, FlowEntry, Loads, OutOfRange, Section, SectionMotion};

fn main() -> Result<(), OutOfRange> {
    let section = Section::wedge(30.0, 0.5)?;
    let (motion, draught, speed, gravity, density) = (SectionMotion::Free(241.0), 0.0, 6.15, 9.81, 1000.0);
    // the chines get wet at 15 ms
    let times: Vec<f64> = (0..=7).map(|k| 0.002 * f64::from(k)).collect();

    let by = |model: EntryModel| {
        let loads = Loads::new(model, &section)?;
        let steep = false;
        let motion = motion.clone();
        Entry { loads: &loads, motion, draught, speed, gravity, density, buoyancy: true, steep }.solve(&times)
    };
    let (wagner, mlm) = (by(EntryModel::Wagner)?, by(EntryModel::Mlm)?);
    let (flow, history, ended) =
        FlowEntry { section: &section, motion, draught, speed, gravity, density }.solve(&times)?;
    assert!(ended.is_none(), "followed to the end");

    println!("time ms  draught mm  speed m/s   Wagner kN/m  MLM kN/m  boundary elements kN/m  pressure at 50 mm kPa");
    for (k, now) in flow.iter().enumerate() {
        println!(
            "{:7.1}  {:10.1}  {:9.3}  {:12.2}  {:8.2}  {:22.2}  {:21.1}",
            1e3 * now.time,
            1e3 * now.draught,
            now.speed,
            1e-3 * wagner[k].force,
            1e-3 * mlm[k].force,
            1e-3 * now.force,
            1e-3 * history.pressure(now.time, 0.05)
        );
    }
    let last = flow.len() - 1;
    let [too_much, near] = [&wagner, &mlm].map(|theory| theory[last].force / flow[last].force - 1.0);
    println!("at the end: Wagner {:+.1} %, MLM {:+.1} % against boundary elements", 100.0 * too_much, 100.0 * near);
    assert!(too_much > 0.2 && near.abs() < 0.1);
    Ok(())
}
