//! The program embeds its cases, ditching models and templates: rebuild when they change.

fn main() {
    for folder in ["cases", "ditching", "rules", "templates"] {
        println!("cargo:rerun-if-changed={folder}");
    }
}
