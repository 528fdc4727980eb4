//! The program carries the reference data and validation cases: rebuild when they change.

fn main() {
    for folder in ["../tests/reference", "../tests/validation"] {
        println!("cargo:rerun-if-changed={folder}");
    }
}
