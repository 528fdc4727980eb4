//! A run that is stored and goes on to the same bits: `cargo run --release -p sph_core --example checkpoint`.

mod tank;

use sph_core::state_bytes::{decode, encode};
use sph_core::{Domain, Fluid, Walls, wcsph};
use tank::{advance, tank, water};

const SPACING: f64 = 0.025;

/// The same input every time: a column of water that will collapse.
fn start() -> Result<(Fluid, Walls), sph_core::Breakdown> {
    let domain = Domain { gravity: [0.0, -9.81], fastest_speed: 4.5, ..Domain::default() };
    let mut fluid = Fluid::new(domain, &wcsph::Settings::default(), &water([0.5, 0.5], SPACING));
    let mut walls = tank([1.5, 1.0], SPACING);
    fluid.initialise(&mut walls)?;
    Ok((fluid, walls))
}

/// Positions and velocities, bit by bit.
fn bits(fluid: &Fluid) -> Vec<u64> {
    let p = fluid.particles();
    [&p.x, &p.y, &p.u, &p.v].into_iter().flatten().map(|value| value.to_bits()).collect()
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (mut fluid, mut walls) = start()?;
    advance(&mut fluid, &mut walls, 0.15)?;
    let file = std::env::temp_dir().join(format!("sph_core_checkpoint_{}", std::process::id()));
    std::fs::write(&file, encode(&(fluid.to_bytes(), &walls)))?;
    advance(&mut fluid, &mut walls, 0.3)?;

    // another process would begin here: the same input, then the stored state
    let (mut resumed, mut its_walls) = start()?;
    let (state, stored_walls): (Vec<u8>, Walls) = decode("the checkpoint", &std::fs::read(&file)?)?;
    stored_walls.check(&its_walls)?;
    resumed.restore_bytes(&state)?;
    its_walls = stored_walls;
    println!("resumed at {:.4} s with {} particles", resumed.time(), resumed.particles().len());
    advance(&mut resumed, &mut its_walls, 0.3)?;
    std::fs::remove_file(&file)?;

    assert_eq!((fluid.steps(), bits(&fluid)), (resumed.steps(), bits(&resumed)));
    println!("after {} steps to {:.4} s both runs have the same bits", fluid.steps(), fluid.time());
    Ok(())
}
