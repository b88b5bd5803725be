//! The viewing pipeline from a glTF model to a picture.

mod canvas;
mod color;
pub mod import;
pub mod model;
mod output;
mod picture;
pub mod render;
pub mod scene;
pub mod shade;

pub use output::OutputError;
pub use picture::Picture;
pub use render::{RenderError, render};
pub use scene::{Origin, ResolveError, Scene, SceneError, SceneFile};
