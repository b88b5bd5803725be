//! Tests of the public interface of `raster`, linked into one program.

mod coverage;
mod depth;
mod drawing;
mod frames;
mod front;
mod many_triangles;
