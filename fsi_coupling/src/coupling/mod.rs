//! Fluid and bodies, stepped together: the step ([`coupled`]), the coupling schemes ([`scheme`]), contact, joints ([`links`]),
//! audits, and rules for the force on a body ([`force_rules`]).

mod balance;
pub mod bending_entry;
#[cfg(test)]
mod column_tests;
mod contact;
pub mod coupled;
pub mod error;
pub mod force_rules;
pub mod links;
pub mod penetration;
pub mod placed_bodies;
pub mod quasi_newton;
pub mod relaxation_zone;
pub mod scheme;
pub mod stability_estimate;

pub use balance::MomentumAudit;
