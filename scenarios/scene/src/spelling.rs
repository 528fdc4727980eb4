//! The known word nearest to a misspelt one.

/// The word nearest to `given`, if it differs by no more than a third of its letters.
pub fn nearest<'a>(given: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let given = given.strip_suffix(".toml").unwrap_or(given).to_lowercase();
    let cost = |word: &str| strsim::damerau_levenshtein(&given, word);
    let near = known.into_iter().map(|word| (cost(word), word)).min_by_key(|(cost, _)| *cost)?;
    (3 * near.0 <= given.chars().count().max(near.1.len())).then_some(near.1)
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn a_third_of_the_letters_may_differ() {
        let known = ["wedge", "dam_break", "column"];
        assert_eq!(nearest("wegde", known), Some("wedge"));
        assert_eq!(nearest("dambreak.toml", known), Some("dam_break"));
        assert_eq!(nearest("gate", known), None);
    }
}
