//! structure_fe
