//! The program carries its scenes, reference data, validation cases and charts: rebuild when they change.

fn main() {
    for folder in ["scenes", "ditching", "../tests/reference", "../tests/validation", "../tests/charts"] {
        println!("cargo:rerun-if-changed={folder}");
    }
}
