//! The crate embeds its scenes and reference tables: rebuild when they change.

fn main() {
    for folder in ["scenes", "reference"] {
        println!("cargo:rerun-if-changed={folder}");
    }
}
