//! Tests of the public interface of `pipeline`, linked into a single program.

mod analytic;
mod floor;
mod furnace;
mod ground;
mod occlusion;
mod picture;
mod pixels;
mod point_shadows;
mod renderer;
mod shadows;
