//! `splashdown bench`: that it measures what it says, not how fast this machine is.

use serde_json::Value;

use crate::command::Workplace;

#[test]
fn a_quick_bench_measures_every_row() {
    let place = Workplace::new();
    let ended = place.run(&["bench", "--quick", "--json", "--quiet", "--threads", "2", "--out", "bench.json"]);
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    let bench: Value = serde_json::from_str(&ended.stdout).expect("JSON on stdout");
    assert_eq!(serde_json::from_str::<Value>(&place.text("bench.json")).expect("JSON in the file"), bench);
    assert_eq!([&bench["extent"], &bench["threads"]], [&Value::from("quick"), &Value::from(2)]);
    let positive = |path: &str| {
        let value = bench.pointer(path).and_then(Value::as_f64);
        let value = value.unwrap_or_else(|| panic!("{path} is not a number in {bench}"));
        assert!(value > 0.0 && value.is_finite(), "{path} = {value}");
        value
    };
    for what in ["triad_gb_per_s", "multiply_add_gflop_per_s"] {
        for threads in ["one", "all"] {
            positive(&format!("/calibration/{what}/{threads}"));
        }
    }
    let blocks = bench["blocks"].as_array().expect("blocks");
    assert!(blocks.len() >= 2, "{blocks:?}");
    for k in 0..blocks.len() {
        let whole = positive(&format!("/blocks/{k}/evaluations_per_core_second"));
        let interactions = positive(&format!("/blocks/{k}/sweeps_only_per_core_second"));
        assert!(interactions > whole, "the interactions are a part of the step: {interactions}, {whole}");
        let neighbours = positive(&format!("/blocks/{k}/neighbours"));
        assert!((25.0..31.0).contains(&neighbours), "{neighbours} neighbours");
        positive(&format!("/blocks/{k}/over_reference"));
        let phases = bench["blocks"][k]["phases_ns"].as_object().expect("phases");
        let sum: f64 = phases.values().map(|ns| ns.as_f64().expect("nanoseconds")).sum();
        assert!((0.3..1.001).contains(&(1e-9 * whole * sum)), "phases fill the step: {phases:?}, {whole} a second");
        assert!(["search", "pack", "density", "momentum", "integration"].iter().all(|name| phases.contains_key(*name)));
    }
    let paths: Vec<&str> = blocks.iter().take(3).filter_map(|block| block["path"].as_str()).collect();
    assert_eq!(paths, ["one at a time", "side by side", "split-explicit"]);
    assert_eq!(bench["blocks"][0]["over_reference"], 1.0);
    positive("/speedup/speedup");
    let bytes = positive("/memory/bytes_per_particle");
    assert!((200.0..4000.0).contains(&bytes), "{bytes} bytes a particle");
    for (k, solver) in ["weakly_compressible", "incompressible"].into_iter().enumerate() {
        assert_eq!(bench["columns"][k]["solver"], solver);
        assert_eq!(bench["columns"][k]["particles"], 20_000);
        positive(&format!("/columns/{k}/wall_s_per_simulated_s"));
        let phases = bench["columns"][k]["phases"].as_object().expect("phases");
        let shares: f64 = phases.values().map(|phase| phase["share"].as_f64().expect("a share")).sum();
        assert!((shares - 1.0).abs() < 1e-9, "{phases:?}");
    }
    for k in 0..2 {
        positive(&format!("/log/{k}/on_over_off"));
    }
}
