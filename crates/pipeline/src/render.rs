//! Rendering: turns a resolved scene into a picture.
//!
//! # Tour: one triangle of one model, from file to pixel
//!
//! The stages follow the textbooks (PL-1). Paths start at `crates/`; `render/` is this folder.
//!
//! 1. **Preparation.** [`Renderer::render`] (`render/renderer.rs`) makes a [`PreparedScene`]
//!    (`render/prepared_scene.rs`) with lines, overlays and insets. [`Textures`]
//!    (`render/mip_chains.rs`) holds the mip chains; `render/shadow_maps.rs` renders a depth map
//!    for each light.
//! 2. **Image tiles.** `tile_regions` (`render/image_tiles.rs`) divides a picture with a side over
//!    16,384 pixels into tiles. The view volume is narrowed to each tile.
//! 3. **Draw calls.** `PrimitiveAssembler::draw_primitive` (`render/primitive_assembly.rs`) visits
//!    each primitive of each mesh instance and assigns its primitive ids.
//! 4. **Skinning, morphing, model matrix.** `Model::skin_primitive` (`model/src/skinning.rs`) poses
//!    the vertices; `model_to_world` combines the node and instance transforms.
//! 5. **Frustum culling and back-face culling of clusters.** `ProjectedMesh::cull_clusters`
//!    (`render/projected_mesh.rs`) tests boxes with `ScreenTransform::classify_bounds`
//!    (`render/screen_transform.rs`) and normal cones with `Cluster::is_back_facing`
//!    (`raster/src/clusters.rs`).
//! 6. **Vertex transform, perspective divide, viewport, snapping.**
//!    `ProjectedMesh::project_vertices` multiplies by the model-view-projection matrix, divides by
//!    w, maps to pixels and snaps to 1/256 pixel (`raster/src/vertex_projection.rs`,
//!    `raster/src/screen_vertex.rs`).
//! 7. **Clipping against the near and far planes and the guard band.** `DrawCall::submit_triangle`
//!    (`render/draw_call.rs`) culls back faces that cross the guard band and clips in homogeneous
//!    space (`clip/src/triangle.rs`). Other back faces are culled by the sign of their area as they
//!    enter the frame: `Frame::add_mesh_runs` (`raster/src/frame.rs`).
//! 8. **Vertex processing for shading.** `VertexArrays::write_vertices`
//!    (`render/vertex_processing.rs`) computes positions, normals and tangents in world space.
//! 9. **Binning into tiles.** `bin_triangles` (`raster/src/tile_bins.rs`) sorts triangles into
//!    tiles of 64 × 64 pixels, which the threads process (`raster/src/tile_loop.rs`).
//! 10. **Coverage and depth test.** `rasterize_triangle` (`raster/src/rasterize.rs`) evaluates edge
//!     functions with the top-left rule and keeps the nearest depth of each sample. At equal depths
//!     (depth ties) the first primitive wins.
//! 11. **Visibility buffer.** A tile stores only the nearest triangle of each sample
//!     (`raster/src/tile_visibility.rs`); masked materials are alpha-tested, and translucent layers
//!     are collected and sorted.
//! 12. **Attribute interpolation.** Each visible triangle is shaded once per pixel, eight fragments
//!     at a time (`raster/src/tile_resolve.rs`), with perspective-correct barycentric weights
//!     (`shade/src/attributes.rs`).
//! 13. **BRDF and lights.** `Shading` (`shade/src/shading.rs`, set up in
//!     `render/fragment_shading.rs`) samples textures and evaluates the layered BRDF
//!     (`shade/src/brdf/layered.rs`, `shade/src/brdf/base.rs`) for the lights, the shadow maps and
//!     the prefiltered environment.
//! 14. **Tone mapping.** `ToneMapper` (`shade/src/tone_mapping.rs`) runs for each fragment.
//! 15. **Resolve and sRGB encoding.** Translucent layers are blended back to front
//!     (`raster/src/layer_blending.rs`), samples are averaged in linear light, and the result is
//!     encoded as sRGB (`shade/src/color.rs`).
//! 16. **Overlays, insets, caption.** `PreparedScene::render_region` draws lines over the surfaces,
//!     composites the insets (`render/insets.rs`) and draws the caption (`render/captions.rs`).
//!
//! | subject | file |
//! | --- | --- |
//! | fragments of one pixel | `render/pixel_inspection.rs` |
//! | passes: depth, normal, ids | `render/passes.rs` |
//! | pictures larger than memory | `render/write_png.rs` |
//! | ground, environment and backdrop | `render/ground.rs`, `render/background.rs` |
//! | screen-space ambient occlusion | `render/ambient_occlusion.rs` |
//! | refraction and rough glass | `render/transmission_framebuffer.rs` |

mod ambient_occlusion;
mod background;
mod captions;
mod context;
mod draw_call;
mod dxf_scale;
mod fragment_shading;
mod ground;
mod image_tiles;
mod insets;
mod line_drawing;
mod mip_chains;
mod panel;
pub mod passes;
mod pixel_inspection;
mod prepared_scene;
mod primitive_assembly;
mod projected_mesh;
mod renderer;
mod repeated_models;
mod screen_transform;
mod shadow_maps;
#[cfg(test)]
mod tests;
mod transmission_framebuffer;
mod vertex_inputs;
mod vertex_processing;
mod write_png;

pub use context::RenderContext;
pub use dxf_scale::dxf_options;
pub use line_drawing::draw_lines;
pub use mip_chains::Textures;
pub use panel::render_panel;
pub use passes::{Pass, PassBuffer, render_passes};
pub use pixel_inspection::{FragmentSource, PixelFragments, ShadedFragment, inspect_pixel};
pub use prepared_scene::PreparedScene;
pub use renderer::Renderer;
pub use write_png::{BitDepth, WritePngError, rows_per_band};

use crate::Picture;
use scene::Scene;

/// The reason why a scene cannot be rendered.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RenderError {
    /// The picture's size is out of range.
    #[error(transparent)]
    Raster(#[from] raster::RasterError),
    /// The picture's viewport is invalid.
    #[error(transparent)]
    Viewport(#[from] viewport::ViewportError),
    /// The lines of the scene cannot be drawn.
    #[error(transparent)]
    Draw(hidden_line::DrawError),
    /// The [monitor](raster::Monitor) requested cancellation.
    #[error("rendering was canceled")]
    Canceled,
    /// The picture is larger than one tile, but ambient occlusion needs the whole depth buffer.
    #[error("ambient occlusion supports pictures up to {0} x {0} pixels", raster::MAX_SIDE)]
    OcclusionTooLarge,
    /// The scene has more points, lines and triangles than there are primitive ids.
    #[error("a scene can have at most {} points, lines and triangles", u32::MAX)]
    TooManyPrimitives,
}

impl From<hidden_line::DrawError> for RenderError {
    fn from(error: hidden_line::DrawError) -> Self {
        match error {
            hidden_line::DrawError::Canceled => Self::Canceled,
            error => Self::Draw(error),
        }
    }
}

/// Renders a scene with up to `threads` threads. The number of threads does not change the picture.
///
/// ```
/// # use pipeline::scene::file::{CameraFile, LightFile};
/// # use pipeline::Scene;
/// # let scene = Scene::builder()
/// #     .mesh([[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 0.0]], [0, 1, 2])
/// #     .camera(CameraFile::look_at([0.0, 0.0, 4.0], [0.0; 3]))
/// #     .light(LightFile::directional([0.0, 0.0, -1.0], 2.0)?)
/// #     .size(64, 48)
/// #     .build()?;
/// let picture = pipeline::render(&scene, 2)?;
/// assert_eq!((picture.width, picture.height), (64, 48));
/// // The triangle is in the middle, and the corner shows the background.
/// assert_ne!(picture.pixel(32, 24), picture.pixel(0, 0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// This is a shortcut for one picture. A [`Renderer`] is faster for several pictures and can be
/// timed, observed and canceled.
///
/// # Errors
/// Returns an error if the picture's size is out of range, or if the scene has too many primitives.
pub fn render(scene: &Scene, threads: usize) -> Result<Picture, RenderError> {
    image_tiles::validate_region(scene.image, scene.image.pixel_rect())?;
    let textures = Textures::for_scene(scene);
    let mut picture = Picture::default();
    Renderer::default().render(&RenderContext::new(scene, &textures, threads), &mut picture)?;
    Ok(picture)
}
