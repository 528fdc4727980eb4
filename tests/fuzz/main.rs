//! Wrong input of every kind: each is accepted or refused with its place, its key and what is expected. It never ends in a panic, an
//! abort, a hang or a huge allocation.
//!
//! `cargo test` replays `corpus`, every input that ever failed. `tests/fuzz/nightly SECONDS` draws new ones at random; an input that
//! fails is kept in `corpus` and becomes a test.

mod mutate;
mod seeds;
mod targets;
mod watch;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use std::{env, fs};

use mutate::Random;
use seeds::Seeds;
use targets::{Input, Target};
use watch::Watch;

/// Kinds of failures after which a random search stops.
const MOST_FAILURES: usize = 40;

fn corpus() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus")
}

#[test]
fn every_input_that_ever_failed_is_accepted_or_refused() {
    let mut failures = Vec::new();
    let watch = Watch::start(None);
    for target in Target::ALL {
        let Ok(folder) = fs::read_dir(corpus().join(target.name())) else { continue };
        for file in folder {
            let path = file.expect("an entry").path();
            let text = fs::read_to_string(&path).expect("a text");
            if let Err(why) = watch.judge(&Input { target, text }) {
                failures.push(format!("{}: {why}", path.display()));
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// A few inputs at random in every test run; many with `FUZZ_SECONDS`, from `FUZZ_SEED` on.
#[test]
fn inputs_at_random_are_accepted_or_refused() {
    let number = |name: &str| env::var(name).ok().and_then(|text| text.parse::<u64>().ok());
    let (seconds, seed) = (number("FUZZ_SECONDS"), number("FUZZ_SEED").unwrap_or(1));
    let only = env::var("FUZZ_TARGET").ok();
    let targets: Vec<Target> =
        Target::ALL.into_iter().filter(|target| only.as_deref().is_none_or(|name| name == target.name())).collect();
    let seeds = Seeds::read();
    let keep = seconds.map(|_| corpus());
    let (watch, mut random) = (Watch::start(keep.clone()), Random::new(seed));
    let (start, length) = (Instant::now(), Duration::from_secs(seconds.unwrap_or(2)));
    let mut made: BTreeMap<&str, (u64, u64, f64)> = BTreeMap::new();
    let (mut kinds, mut failures) = (BTreeSet::new(), Vec::new());
    while start.elapsed() < length && failures.len() < MOST_FAILURES {
        let target = *random.pick(&targets);
        let input = seeds.draw(&mut random, target);
        let begun = Instant::now();
        let judged = watch.judge(&input);
        let (count, accepted, slowest) = made.entry(input.target.name()).or_default();
        *count += 1;
        *slowest = slowest.max(begun.elapsed().as_secs_f64());
        match judged {
            Ok(is_accepted) => *accepted += u64::from(is_accepted),
            Err(why) if kinds.insert(kind(&input, &why)) => {
                let path = keep.as_ref().map(|folder| input.keep(folder));
                let place = path.map_or(format!("{:?}", input.text), |path| path.display().to_string());
                println!("FAILED {place}: {why}");
                failures.push(format!("{place}: {why}"));
            }
            Err(_) => {}
        }
    }
    for (name, (count, accepted, slowest)) in made {
        println!("{name}: {count} inputs, {accepted} accepted, slowest {slowest:.2} s");
    }
    assert!(failures.is_empty(), "seed {seed}: {}", failures.join("\n"));
}

/// What one failure has in common with others: the text without what was given.
fn kind(input: &Input, why: &str) -> String {
    let place = why.split(" at ").nth(1).filter(|_| why.starts_with("panic")).unwrap_or(why);
    let letters: String = place.chars().filter(|c| c.is_ascii_alphabetic() || *c == ':').take(60).collect();
    let line: String = if why.starts_with("panic") { place.chars().take(80).collect() } else { String::new() };
    format!("{} {letters} {line}", input.target.name())
}
