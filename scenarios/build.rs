//! The program carries its scenes, reference data, validation cases, charts and maps: rebuild when they change.

fn main() {
    for folder in ["scenes", "../tests/reference", "../tests/validation", "../tests/charts", "../tests/maps"] {
        println!("cargo:rerun-if-changed={folder}");
    }
}
