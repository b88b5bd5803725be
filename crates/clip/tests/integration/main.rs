//! Tests of the public interface of `clip`, linked once.

mod chapter;
mod enumerated;
mod items;
mod laws;
mod section;
