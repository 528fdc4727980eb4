//! A body whose surface bends in natural modes that a file gives (THEORY CO34, BE28–BE29).

pub mod body;
pub mod interface;
pub mod spec;
