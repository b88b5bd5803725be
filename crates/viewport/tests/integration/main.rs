//! Tests of the public interface of `viewport`, linked into one program.

mod chapter;
mod items;
mod laws;
