//! Memory of arrays, counted.

/// Memory that a vector occupies [bytes].
pub(crate) fn of_vector<T>(vector: &Vec<T>) -> usize {
    vector.capacity() * size_of::<T>()
}
