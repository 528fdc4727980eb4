//! Fluid and bodies, stepped together: the step, its schemes, contact, and the audits.

#[cfg(test)]
mod column_tests;
mod contact;
pub mod coupled;
pub mod error;
pub mod force_rules;
pub mod penetration;
pub mod quasi_newton;
pub mod refinement;
mod retry;
pub mod scheme;
pub mod stability_estimate;
pub mod work_audit;
