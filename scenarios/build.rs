//! The program carries its scenes, reference data, validation cases, charts and bands: rebuild when they change.

fn main() {
    for folder in ["scenes", "../tests/reference", "../tests/validation", "../tests/charts", "../tests/bands"] {
        println!("cargo:rerun-if-changed={folder}");
    }
}
