//! Pixel inspection: the fragments of a pixel with their triangles, barycentric weights and colors.
//!
//! The pixel is rendered again as a region of 1 × 1 pixel, bit for bit as in the picture, with a
//! surface that records every shading call.
//!
//! The result answers "why does this pixel have this color?": it lists the triangles and nodes
//! visible in the pixel, their barycentric weights, and the linear color that each contributes.

use super::RenderError;
use super::context::RenderContext;
use super::fragment_shading::{fragment_shading, style_shading};
use super::image_tiles::TileRegion;
use super::mip_chains::Textures;
use super::primitive_assembly::assemble_scene;
use super::renderer::RenderBuffers;
use super::shadow_maps::ShadowMapRenderer;
use super::transmission_framebuffer::{compute_whole_occlusion, render_framebuffer};
use model::Model;
use raster::{Fragment, Fragments, Frame, Surface, TranslucentColors};
use scene::Scene;
use shade::FrameChannel;
use std::sync::{Mutex, PoisonError};

/// One pixel of a picture and its fragments.
#[derive(Clone, PartialEq, Debug)]
pub struct PixelFragments {
    /// The color in the picture, in sRGB with straight alpha.
    pub color: [u8; 4],
    /// The shaded fragments in scene order. Neighboring triangles of a smooth surface share a
    /// color, and only the shaded triangle is listed. With several samples per pixel, a fragment
    /// may be hidden in some samples.
    pub fragments: Vec<ShadedFragment>,
}

/// A shaded fragment: one point, line or triangle in the pixel.
#[derive(Clone, PartialEq, Debug)]
pub struct ShadedFragment {
    /// The source primitive; `None` for the environment, the backdrop and the ground.
    pub source: Option<FragmentSource>,
    /// The barycentric weights of its vertices at the pixel's center.
    pub weights: [f32; 3],
    /// The linear color, premultiplied by alpha.
    pub color: [f32; 4],
}

/// The indices that identify one point, line or triangle in a scene.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct FragmentSource {
    /// Index of the model in the scene.
    pub model: usize,
    /// Index of the node in the model.
    pub node: usize,
    /// Index of the primitive in the node's mesh.
    pub primitive: usize,
    /// Index of the point, line or triangle in the primitive.
    pub element: usize,
}

/// Renders one pixel of a scene's picture and lists its fragments. Returns `None` outside the
/// picture and for line drawings, which have no fragments.
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
/// let pixel = pipeline::render::inspect_pixel(&scene, 32, 24)?.ok_or("inside")?;
/// let triangle = pixel.fragments[0].source.ok_or("of a model")?;
/// assert_eq!((triangle.model, triangle.element), (0, 0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Returns the same errors as [`render`](crate::render()).
pub fn inspect_pixel(scene: &Scene, x: u32, y: u32) -> Result<Option<PixelFragments>, RenderError> {
    let image = scene.image;
    if !scene.style.draws_surfaces() || x >= image.width || y >= image.height {
        return Ok(None);
    }
    let textures = Textures::for_models(&scene.models);
    let pixel_region = TileRegion::for_pixel(image, [x, y]);
    let context = RenderContext::new(scene, &textures, 1);
    let memory = RenderBuffers::default().take_frame(&context, pixel_region)?;
    let memory = assemble_scene(&context, memory)?;
    // Even for one pixel, shadows, occlusion and the light behind glass depend on the whole
    // picture.
    let mut shadows = ShadowMapRenderer::default();
    shadows.render_maps(&context)?;
    let occlusion = compute_whole_occlusion(&context)?;
    let occlusion = occlusion.as_ref();
    let framebuffer = render_framebuffer(&context, &shadows, occlusion)?;
    let shading = fragment_shading(scene, &memory, &shadows, occlusion, framebuffer.as_ref());
    let (frame, offset) = (&memory.frame, pixel_region.offset_in_tile());
    let styled = style_shading(scene, &shading);
    let surface: &dyn Surface = styled.as_ref().map_or(&shading as _, |styled| styled as _);
    let (color, mut recorded) = record_fragments(frame, surface, offset, image.background);
    // A fragment can be shaded repeatedly if clipping split its triangle or the pixel has several
    // samples.
    recorded.sort_by_key(|(id, ..)| *id);
    recorded.dedup_by_key(|(id, ..)| *id);
    let fragments = recorded.into_iter().map(|(id, weights, color)| {
        let source = find_source(scene, id);
        ShadedFragment { source, weights, color }
    });
    Ok(Some(PixelFragments { color, fragments: fragments.collect() }))
}

/// The primitive id, weights and color of a shading call.
type RecordedFragment = (u32, [f32; 3], [f32; 4]);

/// Draws a frame of one pixel and records the shading calls.
fn record_fragments(
    frame: &Frame,
    surface: &dyn Surface,
    pixel: [u32; 2],
    background: [f32; 4],
) -> ([u8; 4], Vec<RecordedFragment>) {
    let recorder = Recorder { surface, pixel, fragments: Mutex::default() };
    let mut color = [[0; 4]];
    u8::draw_frame(frame, &recorder, background, 1, &mut color);
    (color[0], recorder.fragments.into_inner().unwrap_or_else(PoisonError::into_inner))
}

/// A surface that forwards to another surface and records the fragments shaded in one pixel.
///
/// The mutex is needed because the rasterizer shades from several threads through a shared
/// reference.
struct Recorder<'a> {
    /// The wrapped surface.
    surface: &'a dyn Surface,
    /// The pixel whose fragments are recorded.
    pixel: [u32; 2],
    /// The recorded shading calls, in any order.
    fragments: Mutex<Vec<RecordedFragment>>,
}

impl Surface for Recorder<'_> {
    fn passes_alpha_test(&self, fragment: &Fragment<'_>) -> bool {
        self.surface.passes_alpha_test(fragment)
    }

    fn shade(&self, fragment: &Fragment<'_>) -> [f32; 4] {
        let color = self.surface.shade(fragment);
        if [fragment.x, fragment.y] == self.pixel {
            let mut fragments = self.fragments.lock().unwrap_or_else(PoisonError::into_inner);
            fragments.push((fragment.id, fragment.weights, color));
        }
        color
    }

    fn is_continuous(&self, first_id: u32, second_id: u32) -> bool {
        self.surface.is_continuous(first_id, second_id)
    }

    fn shade_translucent_eight(&self, fragments: &Fragments<'_>) -> TranslucentColors {
        let TranslucentColors { transmittance, .. } =
            self.surface.shade_translucent_eight(fragments);
        TranslucentColors { color: self.shade_eight(fragments), transmittance }
    }
}

/// Finds the source of a primitive id. Ids count points, lines and triangles in scene order,
/// including culled primitives.
fn find_source(scene: &Scene, id: u32) -> Option<FragmentSource> {
    let mut first_id = 0;
    for (model, model_instance) in scene.models.iter().enumerate() {
        for (instance, primitive) in model_instance.model.scene_primitives() {
            let element = id as usize - first_id;
            if element < primitive.item_count() {
                let node = instance.node;
                let primitive = primitive_index(&model_instance.model, node, primitive)?;
                return Some(FragmentSource { model, node, primitive, element });
            }
            first_id += primitive.item_count();
        }
    }
    None
}

/// Returns the index of a primitive in the mesh of a node.
fn primitive_index(model: &Model, node: usize, primitive: &model::Primitive) -> Option<usize> {
    let mesh = model.meshes.get(model.nodes.get(node)?.mesh?)?;
    mesh.primitives.iter().position(|known| std::ptr::eq(known, primitive))
}
