//! The `splashdown` command: a thin shell over the `scenarios` crate.

use std::process::ExitCode;

fn main() -> ExitCode {
    scenarios::cli::main()
}
