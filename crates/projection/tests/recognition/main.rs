//! Recognition of matrices: a table of 120 from books, interfaces and programs, half of
//! them wrong, and 10,000 random ones.
// Test names say what they check.
#![allow(missing_docs)]

mod formulas;
mod planar;
mod random_matrices;
mod right_matrices;
mod table;
mod wrong_matrices;
