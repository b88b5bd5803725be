//! The viewing pipeline from a glTF model to a picture.
//!
//! Making a picture takes three steps:
//!
//! 1. Describe it in a [`SceneFile`], read from a file or built from defaults.
//! 2. Resolve the description into a [`Scene`], with models loaded and all defaults filled in.
//! 3. Render the scene.
//!
//! ```no_run
//! use pipeline::{Origin, Scene, render};
//! // Or Origin::read_scene("scene.ron".as_ref())?
//! let (origin, mut file) = Origin::from_model_path("model.glb".as_ref());
//! file.image.size = (256, 256);
//! let scene = Scene::resolve(&origin, &file, &Default::default())?;
//! let picture = render(&scene, 2)?; // two threads; the number does not change the picture
//! let center: Option<[u8; 4]> = picture.pixel(128, 128); // sRGB, straight alpha
//! picture.write_png("thumb.png".as_ref())?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | purpose | start with | example |
//! | --- | --- | --- |
//! | a picture in memory, or a PNG | [`render()`] | `examples/thumbnail.rs` |
//! | lines as SVG, PDF, DXF, PNG | [`draw_lines`], [`drawing::Page`] | `examples/isometric.rs` |
//! | a drawing sheet with scaled views | [`scene::resolve_sheet`] | its documentation |
//! | a frame sequence of one scene | [`sequence::Sequence`] | `examples/turntable.rs` |
//! | depth, normal and id of each pixel | [`mod@render::passes`] | `examples/depth_map.rs` |
//! | many pictures without allocation | [`Renderer`] | its documentation |
//! | pictures larger than memory | [`PreparedScene::write_png`] | its documentation |
//! | every step of a point, triangle or pixel in the pipeline | the crate `explain` | |
//! | lessons: projections, sweeps, depth curves | the crate `explorer` | |
//! | models from memory | [`Origin::from_text_in_memory`], [`import::load_bytes`], [`Scene::from_models`] | |
//! | the syntax of scene files | [`scene::reference`] | |
//! | a tour of the stages, with the file of each | [`mod@render`] | |
//!
//! A [`Monitor`] observes a rendering, and a [`CancelToken`] stops it. A sequence also stops if the
//! function that receives its pictures returns an error.
//!
//! The crate prints nothing. Any number of scenes, renderers and pictures can coexist, and each can
//! be sent to another thread. Errors are typed and state the problem, its location and a remedy.

mod cancel;
pub mod render;
pub mod sequence;

pub use cancel::CancelToken;
pub use drawing;
pub use files::{AtomicFile, OutputError, write_file};
pub use hidden_line;
pub use homog::PixelRect;
pub use import;
pub use model;
pub use model::Timings;
pub use picture::{self, Channel, Picture, PngRows, encode_png};
pub use raster::{Monitor, Workers};
pub use render::{
    PreparedScene, RenderContext, RenderError, Renderer, Textures, WritePngError, draw_lines,
    dxf_options, render,
};
pub use scene::{
    self, MAX_IMAGE_SIDE, Origin, ResolveError, Scene, SceneError, SceneErrors, SceneFile, options,
};
pub use shade::{self, FrameChannel};
#[cfg(feature = "sheets")]
pub use sheet;

/// The examples of the README, compiled as documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

#[cfg(test)]
mod tests {
    /// A compile-time check: the body only needs to type-check.
    #[test]
    fn everything_can_be_sent_to_another_thread() {
        fn assert_send_sync<T: Send + Sync + 'static>() {}
        assert_send_sync::<(crate::Origin, crate::SceneFile, crate::Scene)>();
        assert_send_sync::<(picture::Picture, model::Timings, crate::CancelToken)>();
        assert_send_sync::<(crate::Renderer, crate::sequence::Sequence)>();
        assert_send_sync::<(drawing::Page, hidden_line::LineDrawing, sheet::Sheet)>();
        assert_send_sync::<(crate::SceneError, crate::ResolveError, crate::RenderError)>();
        assert_send_sync::<(files::OutputError, import::ImportError)>();
        assert_send_sync::<import::ImportOptions>();
    }
}
