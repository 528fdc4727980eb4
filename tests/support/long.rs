//! Long variants of tests: more cases, finer water, later ends. A test run takes a share of them, `tests/nightly` all.

/// Whether tests take their long variants: the environment has `LONG=1`.
pub fn long() -> bool {
    std::env::var("LONG").is_ok_and(|value| value == "1")
}

/// The cases of every run, and with `LONG=1` those of the long variant after them.
pub fn with_long<T: Clone>(usual: &[T], more: &[T]) -> Vec<T> {
    [usual, if long() { more } else { &[] }].concat()
}
