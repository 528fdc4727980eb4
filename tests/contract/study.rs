//! `splashdown study`: files, keys, and what it refuses.

use serde_json::Value;

use crate::command::Workplace;

const COARSE: [&str; 8] =
    ["study", "wedge_constant", "--set", "time.end=1.0", "--spacings", "0.1,0.07,0.05", "--sound-speeds", "25,50"];
const OUT: [&str; 3] = ["--out", "out", "--quiet"];

/// Two files; every pair of spacing and sound speed, coarsest first; the same JSON on stdout; a verdict in words that
/// agrees with `converged`. A second study does not replace the first without the option for it.
#[test]
fn a_study_writes_its_numbers_and_its_page() {
    let place = Workplace::new();
    let quantity = ["--quantity", "similarity/impulse_coefficient", "--json"];
    let arguments = [&COARSE[..], &quantity, &OUT].concat();
    let ended = place.run(&arguments);
    assert_eq!(ended.code, Some(0), "{}", ended.message);
    let study: Value = serde_json::from_str(&place.text("out/study.json")).expect("JSON");
    assert_eq!(serde_json::from_str::<Value>(&ended.stdout).expect("JSON on stdout"), study);
    let points = study["points"].as_array().expect("a list");
    let number = |v: &Value, key: &str| v[key].as_f64().unwrap_or_else(|| panic!("{key} in {v}"));
    let grid: Vec<[f64; 2]> =
        points.iter().map(|p| [number(p, "spacing_m"), number(p, "sound_speed_m_per_s")]).collect();
    assert_eq!(grid, [[0.1, 25.0], [0.1, 50.0], [0.07, 25.0], [0.07, 50.0], [0.05, 25.0], [0.05, 50.0]]);
    let fit = &study["fit"];
    for key in ["extrapolated", "order_used", "discretisation_error", "sound_speed_error", "uncertainty", "scatter"] {
        number(fit, key);
    }
    // the slower sound loses force to compressibility, at every spacing
    assert!(points.chunks(2).all(|p| number(&p[0], "value") < number(&p[1], "value")), "{study}");
    assert!(number(fit, "sound_speed_error") < 0.0, "{fit}");
    let converged = fit["converged"].as_bool().expect("true or false");
    let page = place.text("out/study.html");
    assert_eq!(page.contains("not converged"), !converged);
    assert!(page.matches("<svg").count() == 2 && !page.contains("src=\"http"), "two charts, no network");

    let again = place.run(&arguments);
    assert_eq!(again.code, Some(2));
    again.says(&["already holds a study", "--force"]);
}

#[test]
fn a_study_refuses_what_it_cannot_use() {
    let place = Workplace::new();
    let refused = |arguments: &[&str], says: &[&str]| {
        let ended = place.run(&[arguments, &OUT].concat());
        assert_eq!(ended.code, Some(2), "{}", ended.message);
        ended.says(says);
        assert!(!place.path("out/study.json").exists());
    };
    let known = ["--quantity similarity/force", "expected the path of a number", "similarity/force_coefficient"];
    refused(&[&COARSE[..], &["--quantity", "similarity/force"]].concat(), &known);
    let value = ["--quantity", "time_end_s", "--spacings"];
    let with = |spacings: &'static str| [&["study", "wedge_constant"], &value[..], &[spacings]].concat();
    refused(&with("0.1,0.1"), &["--spacings 0.1,0.1", "different finite numbers above 0"]);
    refused(&with("0.1,0"), &["--spacings 0.1,0", "above 0"]);
    refused(&with("0.1,9"), &["resolution.spacing", "thinner than its walls"]);
}
