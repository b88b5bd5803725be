//! Tests of the public interface of `scene`, linked once.

mod dimensions;
mod lenses;
mod loading;
mod views;
