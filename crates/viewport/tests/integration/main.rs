//! Tests of the public interface of `viewport`, linked once.

mod chapter;
mod items;
mod laws;
