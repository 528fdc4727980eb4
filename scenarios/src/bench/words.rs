//! What was measured, as text.

use std::collections::BTreeMap;

use run::summary::PhaseTime;
use sph_core::Phase;

use super::{Bench, Block, Column, LogCost, OneAndAll};

/// Width of the bar of phases in letters.
const BAR: usize = 60;
/// Phases that take less of every block are not shown [ns].
const UNSEEN_NS: f64 = 0.05;
/// Timers of a smaller share are not shown.
const UNSEEN: f64 = 0.0005;

/// The table for people.
pub fn in_words(b: &Bench) -> String {
    let mut lines = vec![format!("splashdown {}, {} threads, {}", b.version, b.threads, b.extent)];
    let one_and_all = |what: &str, v: OneAndAll, unit: &str| {
        format!("  {what:<34} {:8.1} {unit} with 1 thread, {:8.1} with {}", v.one, v.all, b.threads)
    };
    let fused = if b.calibration.fused { "fused" } else { "not fused" };
    lines.push("machine".into());
    lines.push(one_and_all("triad a = b + s c", b.calibration.triad_gb_per_s, "GB/s"));
    let arithmetic = format!("multiply and add, {fused}");
    lines.push(one_and_all(&arithmetic, b.calibration.multiply_add_gflop_per_s, "GFLOP/s"));
    lines.push("forces per core-second, a block of fluid on 1 thread: whole step, sums over pairs alone".into());
    lines.extend(b.blocks.iter().map(block));
    lines.push("where the time of a force goes, a block of fluid on 1 thread [ns]".into());
    lines.extend(phases_of_blocks(&b.blocks));
    if let Some(s) = b.speedup {
        lines.push(format!("{} threads against 1, {} particles: {:.2}", s.threads, s.particles, s.speedup));
    }
    lines.push(format!("memory: {:.0} bytes a particle", b.memory.bytes_per_particle));
    lines.extend(
        b.memory.peak_resident_bytes.map(|most| format!("  most held by the process: {:.0} MB", 1e-6 * most as f64)),
    );
    lines.push("dam break, column of 1 m x 2 m, dx = 0.01 m".into());
    lines.extend(b.columns.iter().map(column));
    lines.push("log on over log off".into());
    lines.extend(b.log.iter().map(log));
    for column in &b.columns {
        lines.push(format!("where the time goes, {}", column.solver));
        lines.extend(flame(&column.phases));
    }
    lines.join("\n")
}

fn block(b: &Block) -> String {
    format!(
        "  {:>9} particles, {:.1} neighbours, {:<14} {:6.3} million, {:6.3} million; over {}: {:.2}",
        b.particles,
        b.neighbours,
        b.path,
        1e-6 * b.evaluations_per_core_second,
        1e-6 * b.sweeps_only_per_core_second,
        super::block::PATHS[0].name,
        b.over_reference
    )
}

/// A table of phases: a row a block.
fn phases_of_blocks(blocks: &[Block]) -> Vec<String> {
    let seen = |phase: &Phase| blocks.iter().any(|b| b.phases_ns.get(phase.name()).is_some_and(|&ns| ns >= UNSEEN_NS));
    let phases: Vec<&str> = Phase::ALL.into_iter().filter(seen).map(Phase::name).collect();
    let line = |particles: String, way: &str, of_phases: Vec<String>, sum: String| {
        let cells: String = of_phases.iter().map(|cell| format!(" {cell:>11}")).collect();
        format!("  {particles:>9} {way:<14}{cells} {sum:>7}")
    };
    let head = line("particles".into(), "", phases.iter().map(|name| name.to_string()).collect(), "sum".into());
    let row = |b: &Block| {
        let ns = |name: &&str| format!("{:.1}", b.phases_ns.get(name).copied().unwrap_or(0.0));
        let sum = format!("{:.1}", b.phases_ns.values().sum::<f64>());
        line(b.particles.to_string(), b.path, phases.iter().map(ns).collect(), sum)
    };
    std::iter::once(head).chain(blocks.iter().map(row)).collect()
}

fn column(c: &Column) -> String {
    format!(
        "  {:<20} {:8.1} s a simulated second ({} steps, {:.4} s simulated, {} threads)",
        c.solver, c.wall_s_per_simulated_s, c.steps, c.simulated_s, c.threads
    )
}

fn log(l: &LogCost) -> String {
    format!("  {:<20} {:6.3} ({:.0} steps a frame, {} threads)", l.scene, l.on_over_off, l.steps_per_frame, l.threads)
}

/// A bar a phase, each beginning where the one before it ends.
fn flame(phases: &BTreeMap<&'static str, PhaseTime>) -> Vec<String> {
    let mut from = 0.0;
    let known = Phase::ALL.into_iter().filter_map(|phase| Some((phase, phases.get(phase.name())?)));
    let known = known.filter(|(_, time)| time.share >= UNSEEN);
    let line = |(phase, time): (Phase, &PhaseTime)| {
        let cell = |share: f64| (BAR as f64 * share).round() as usize;
        let (start, end) = (cell(from), cell(from + time.share));
        from += time.share;
        let bar = format!("{}{}", " ".repeat(start), "█".repeat(end - start));
        format!("  {:<12} {:5.1} % |{bar:<BAR$}|", phase.name(), 100.0 * time.share)
    };
    known.map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_follow_each_other_and_fill_the_line() {
        let time = |share: f64| PhaseTime { seconds: share, share };
        let phases = BTreeMap::from([("momentum", time(0.5)), ("density", time(0.3)), ("log", time(0.2))]);
        let lines = flame(&phases);
        assert!(lines[0].starts_with("  density") && lines[1].starts_with("  momentum"), "{lines:?}");
        let count = |line: &String, letter: char| line.chars().filter(|c| *c == letter).count();
        assert_eq!(lines.iter().map(|line| count(line, '█')).sum::<usize>(), BAR);
        let column = |line: &String| line.chars().position(|c| c == '█');
        assert_eq!(column(&lines[1]), column(&lines[0]).map(|at| at + 18));
    }
}
