//! The program carries its scenes, reference data and validation cases: rebuild when they change.

fn main() {
    for folder in ["scenes", "../tests/reference", "../tests/validation"] {
        println!("cargo:rerun-if-changed={folder}");
    }
}
