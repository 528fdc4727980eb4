//! The program embeds its scenes, cases and ditching models: rebuild when they change.

fn main() {
    for folder in ["cases", "scenes", "ditching", "templates"] {
        println!("cargo:rerun-if-changed={folder}");
    }
}
