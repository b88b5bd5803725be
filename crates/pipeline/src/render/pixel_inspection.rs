//! One pixel, drawn once more with a witness: what is seen in it, from which triangles, with which weights and colours.
//!
//! It goes through the same stages as the picture, as a part of one pixel (whose bits are those of the whole), so that its
//! colour is the picture's.

use super::RenderError;
use super::ambient_occlusion::build_full_ssao_buffer;
use super::image_tiles::TileRegion;
use super::mip_chains::Textures;
use super::primitive_assembly::assemble_scene;
use super::renderer::{Renderer, fragment_shading, style_surface};
use super::shadow_maps::ShadowMapRenderer;
use crate::scene::Scene;
use model::Model;
use raster::{F32x8, Fragment, Fragments, Frame, Surface};
use shade::color::SrgbEncoder;
use std::sync::{Mutex, PoisonError};

/// What one pixel of a picture is made of.
#[derive(Clone, PartialEq, Debug)]
pub struct PixelFragments {
    /// Its colour in the picture: sRGB and straight alpha.
    pub color: [u8; 4],
    /// What was shaded for it, in the order of the scene; it may be hidden in some of the samples.
    pub fragments: Vec<ShadedFragment>,
}

/// A point, line or triangle in a pixel.
#[derive(Clone, PartialEq, Debug)]
pub struct ShadedFragment {
    /// Whose it is; `None` for the surroundings.
    pub source: Option<FragmentSource>,
    /// The shares of its corners at the pixel's centre.
    pub weights: [f32; 3],
    /// Its colour: linear, multiplied by alpha.
    pub color: [f32; 4],
}

/// The place of a point, line or triangle in a scene.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct FragmentSource {
    /// The model's number in the scene.
    pub model: usize,
    /// The node's number in the model.
    pub node: usize,
    /// The primitive's number in the mesh of the node.
    pub primitive: usize,
    /// The point's, line's or triangle's number in the primitive.
    pub element: usize,
}

/// Draws one pixel of a scene's picture and tells what it is made of; `None` outside of the picture and for line drawings, whose
/// pixels are not shaded.
///
/// # Errors
/// As [`render`](crate::render()).
pub fn inspect_pixel(scene: &Scene, x: u32, y: u32) -> Result<Option<PixelFragments>, RenderError> {
    let image = scene.image;
    if !scene.style.draws_surfaces() || x >= image.width || y >= image.height {
        return Ok(None);
    }
    let textures = Textures::for_models(&scene.models);
    let pixel_region = TileRegion::for_pixel(image, [x, y]);
    let memory = Renderer::default().take_buffers(scene, pixel_region, 1)?;
    let memory = assemble_scene(scene, &textures, 1, memory)?;
    let mut shadows = ShadowMapRenderer::default();
    shadows.render_maps(scene, &textures, 1)?;
    let occlusion = build_full_ssao_buffer(scene, &textures, 1)?;
    let (frame, draws) = (&memory.frame, &memory.draws);
    let surface = fragment_shading(scene, draws, frame, &shadows.maps, occlusion.as_ref());
    let (color, mut seen) = match &style_surface(scene, &surface) {
        Some(styled) => {
            record_fragments(frame, styled, pixel_region.offset_in_tile(), image.background)
        }
        None => record_fragments(frame, &surface, pixel_region.offset_in_tile(), image.background),
    };
    seen.sort_by_key(|(id, ..)| *id);
    seen.dedup_by_key(|(id, ..)| *id);
    let fragments = seen.into_iter().map(|(id, weights, color)| ShadedFragment {
        source: find_source(scene, id),
        weights,
        color,
    });
    Ok(Some(PixelFragments { color, fragments: fragments.collect() }))
}

/// The name, the weights and the colour of a fragment.
type RecordedFragment = (u32, [f32; 3], [f32; 4]);

/// Draws a frame of one pixel, and notes what was shaded for it.
fn record_fragments<S: Surface>(
    frame: &Frame,
    surface: &S,
    pixel: [u32; 2],
    background: [f32; 4],
) -> ([u8; 4], Vec<RecordedFragment>) {
    let witness = Recorder { surface, place: pixel, fragments: Mutex::default() };
    let mut color = [[0; 4]];
    frame.draw(&witness, background, 1, &mut color, SrgbEncoder::shared());
    (color[0], witness.fragments.into_inner().unwrap_or_else(PoisonError::into_inner))
}

/// A surface that notes what is asked of it.
struct Recorder<'a, S> {
    surface: &'a S,
    place: [u32; 2],
    fragments: Mutex<Vec<RecordedFragment>>,
}

impl<S: Surface> Surface for Recorder<'_, S> {
    fn passes_alpha_test(&self, fragment: &Fragment<'_>) -> bool {
        self.surface.passes_alpha_test(fragment)
    }

    fn shade(&self, fragment: &Fragment<'_>) -> [f32; 4] {
        let color = self.surface.shade(fragment);
        if [fragment.x, fragment.y] == self.place {
            let mut seen = self.fragments.lock().unwrap_or_else(PoisonError::into_inner);
            seen.push((fragment.id, fragment.weights, color));
        }
        color
    }

    fn transmittance_eight(&self, fragments: &Fragments<'_>, alphas: &F32x8) -> [F32x8; 3] {
        self.surface.transmittance_eight(fragments, alphas)
    }
}

/// Whose point, line or triangle has a name; names are given in the order of what is shown.
fn find_source(scene: &Scene, id: u32) -> Option<FragmentSource> {
    let mut first_id = 0;
    for (model, placed) in scene.models.iter().enumerate() {
        for (instance, primitive) in placed.model.scene_primitives() {
            let element = id as usize - first_id;
            if element < primitive.item_count() {
                let number = primitive_index(&placed.model, instance.node, primitive)?;
                return Some(FragmentSource {
                    model,
                    node: instance.node,
                    primitive: number,
                    element,
                });
            }
            first_id += primitive.item_count();
        }
    }
    None
}

/// The number of a primitive in the mesh of a node.
fn primitive_index(model: &Model, node: usize, primitive: &model::Primitive) -> Option<usize> {
    let mesh = model.meshes.get(model.nodes.get(node)?.mesh?)?;
    mesh.primitives.iter().position(|known| std::ptr::eq(known, primitive))
}
