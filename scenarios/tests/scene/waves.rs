//! Wave makers and beaches: what is refused, and what is warned of.

use run::{load, load_text};

use super::{TANK, sets};

/// The message that refuses the scene `wave_maker` with overrides.
fn refusal(changes: &[&str]) -> String {
    match load("wave_maker", &sets(changes)) {
        Ok(_) => format!("{changes:?} is not refused"),
        Err(error) => format!("{error}").replace('\n', " "),
    }
}

#[test]
fn waves_that_cannot_be_made_are_refused() {
    #[rustfmt::skip]
    let table: &[(&[&str], &[&str])] = &[
        (&["tank.wave_maker.height=0.4"], &["`tank.wave_maker.height` = 0.4", "below 0.3326 m", "breaks"]),
        (&["tank.wave_maker.height=0"], &["`tank.wave_maker.height` = 0", "above 0"]),
        (&["tank.wave_maker.period=1.5"], &["`tank.wave_maker.length` = 3", "absent beside period = 1.5 s"]),
        (&["tank.wave_maker={ height = 0.07 }"], &["`tank.wave_maker.period` is missing", "or their length"]),
        (&["tank.wave_maker={ height = 0.07, period = 0 }"], &["`tank.wave_maker.period` = 0", "above 0"]),
        (&["tank.wave_maker={ height = 0.02, length = 40 }", "tank.width=0.8", "tank.beach.length=0.4", "observe.level=[]", "tank.depth=0.1"], &["`tank.wave_maker.height`", "stroke of at most"]),
        (&["solver=incompressible_thesis"], &["`solver`", "loses momentum"]),
        (&["gravity=[0, 0]"], &["`gravity` = [0, 0]", "a number below 0"]),
        (&["symmetry=x"], &["`symmetry` = \"x\"", "\"none\" with a [tank.wave_maker]"]),
        (&["gravity=[0.5, -9.81]"], &["`gravity` = [0.5, -9.81]", "a number below 0"]),
        (&["tank.water_width=10"], &["`tank.water_width` = 10", "tank.width = 36 m"]),
        (&["tank.height=0.51"], &["`tank.height` = 0.51", "above the crests"]),
        (&["observe.level=[-17.9]"], &["`observe.level` = -17.9", "4 spacings right"]),
        (&["gauges=[{ name = \"wall\", on = \"fixed\", at = [-18.0, -0.2] }]"], &["`gauges[0].at`", "4 spacings right"]),
        (&["tank.beach.length=50"], &["`tank.beach.length` = 50", "less than the 36 m"]),
        (&["tank.beach.length=0"], &["`tank.beach.length` = 0", "above 0"]),
        (&["tank.wave_maker.relaxation=0"], &["`tank.wave_maker.relaxation` = 0", "above 0"]),
        (&["tank.wave_maker.relaxation=0.05"], &["`tank.wave_maker.relaxation` = 0.05", "at least 0.09 m"]),
        (&["tank.wave_maker.relaxation=32"], &["`tank.wave_maker.relaxation` = 32", "below 31.5 m"]),
        (&["tank.wave_maker.heigth=1"], &["unknown key `tank.wave_maker.heigth`", "`tank.wave_maker.height`"]),
    ];
    for (changes, fragments) in table {
        let message = refusal(changes);
        for fragment in *fragments {
            assert!(message.contains(fragment), "{changes:?}: no {fragment:?} in {message}");
        }
    }
}

/// The line of a file is named.
#[test]
fn a_refusal_names_the_line() {
    let text = format!("{TANK}[tank.wave_maker]\nheight = 0.3\nlength = 1.0\n");
    let message = load_text("tank.toml", &text, &[]).map(|_| ()).expect_err("a breaking wave").to_string();
    assert!(message.starts_with("tank.toml:8"), "{message}");
}

#[test]
fn doubtful_waves_are_warned_of() {
    for (change, fragment) in [
        ("tank.beach.length=1.5", "0.5 wavelengths"),
        ("tank.wave_maker.height=0.2", "of the height of breaking"),
        ("projection.calming=0.15", "of the waves' height per wavelength: 0.02 would take"),
        ("tank.wave_maker.relaxation=2", "0.6667 wavelengths"),
        ("time.end=20", "early for the gauge at x = 12 m"),
        ("resolution.spacing=0.03", "spacings high lose height"),
    ] {
        let warnings = load("wave_maker", &sets(&[change])).expect("a scene that runs").warnings.join("\n");
        assert!(warnings.contains(fragment), "{change}: {warnings}");
    }
    assert!(load("wave_maker", &[]).expect("a built-in scene").warnings.is_empty());
    let text = format!("{TANK}[tank.wave_maker]\nheight = 0.1\nperiod = 1.0\n");
    let warnings = load_text("tank.toml", &text, &[]).expect("a tank without a beach").warnings.join("\n");
    assert!(warnings.contains("come back from the right wall"), "{warnings}");
}
