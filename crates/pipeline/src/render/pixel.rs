//! One pixel, drawn once more with a witness: what is seen in it, from which triangles, with which weights and colours.
//!
//! It goes through the same stages as the picture, as a part of one pixel (whose bits are those of the whole), so that its
//! colour is the picture's.

use super::RenderError;
use super::assemble::assemble;
use super::occlusion::whole_screen_space;
use super::region::PartOfSheet;
use super::renderer::{Renderer, shading, styled};
use super::shadows::ShadowMemory;
use super::textures::Textures;
use crate::scene::Scene;
use model::Model;
use raster::{Eight, Fragment, Fragments, Frame, Surface};
use shade::color::SrgbEncoder;
use std::sync::{Mutex, PoisonError};

/// What one pixel of a picture is made of.
#[derive(Clone, PartialEq, Debug)]
pub struct PixelMakeup {
    /// Its colour in the picture: sRGB and straight alpha.
    pub color: [u8; 4],
    /// What was shaded for it, in the order of the scene; it may be hidden in some of the samples.
    pub fragments: Vec<SeenFragment>,
}

/// A point, line or triangle in a pixel.
#[derive(Clone, PartialEq, Debug)]
pub struct SeenFragment {
    /// Whose it is; `None` for the surroundings.
    pub owner: Option<Owner>,
    /// The shares of its corners at the pixel's centre.
    pub weights: [f32; 3],
    /// Its colour: linear, multiplied by alpha.
    pub color: [f32; 4],
}

/// The place of a point, line or triangle in a scene.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Owner {
    /// The model's number in the scene.
    pub model: usize,
    /// The node's number in the model.
    pub node: usize,
    /// The primitive's number in the mesh of the node.
    pub primitive: usize,
    /// The point's, line's or triangle's number in the primitive.
    pub item: usize,
}

/// Draws one pixel of a scene's picture and tells what it is made of; `None` outside of the picture and for line drawings, whose
/// pixels are not shaded.
///
/// # Errors
/// As [`render`](crate::render()).
pub fn pixel(scene: &Scene, x: u32, y: u32) -> Result<Option<PixelMakeup>, RenderError> {
    let image = scene.image;
    if !scene.style.shows_surfaces() || x >= image.width || y >= image.height {
        return Ok(None);
    }
    let textures = Textures::of(&scene.models);
    let one = PartOfSheet::of_pixel(image, [x, y]);
    let memory = Renderer::default().lend(scene, one, 1)?;
    let memory = assemble(scene, &textures, 1, memory)?;
    let mut shadows = ShadowMemory::default();
    shadows.render(scene, &textures, 1)?;
    let occlusion = whole_screen_space(scene, &textures, 1)?;
    let (frame, draws) = (&memory.frame, &memory.draws);
    let surface = shading(scene, draws, frame, &shadows.maps, occlusion.as_ref());
    let (color, mut seen) = match &styled(scene, &surface) {
        Some(styled) => witnessed(frame, styled, one.corner(), image.background),
        None => witnessed(frame, &surface, one.corner(), image.background),
    };
    seen.sort_by_key(|(id, ..)| *id);
    seen.dedup_by_key(|(id, ..)| *id);
    let fragments = seen.into_iter().map(|(id, weights, color)| SeenFragment {
        owner: owner(scene, id),
        weights,
        color,
    });
    Ok(Some(PixelMakeup { color, fragments: fragments.collect() }))
}

/// The name, the weights and the colour of a fragment.
type Noted = (u32, [f32; 3], [f32; 4]);

/// Draws a frame of one pixel, and notes what was shaded for it.
fn witnessed<S: Surface>(
    frame: &Frame,
    surface: &S,
    place: [u32; 2],
    background: [f32; 4],
) -> ([u8; 4], Vec<Noted>) {
    let witness = Witness { surface, place, seen: Mutex::default() };
    let mut color = [[0; 4]];
    frame.draw(&witness, background, 1, &mut color, SrgbEncoder::shared());
    (color[0], witness.seen.into_inner().unwrap_or_else(PoisonError::into_inner))
}

/// A surface that notes what is asked of it.
struct Witness<'a, S> {
    surface: &'a S,
    place: [u32; 2],
    seen: Mutex<Vec<Noted>>,
}

impl<S: Surface> Surface for Witness<'_, S> {
    fn keeps(&self, fragment: &Fragment<'_>) -> bool {
        self.surface.keeps(fragment)
    }

    fn shade(&self, fragment: &Fragment<'_>) -> [f32; 4] {
        let color = self.surface.shade(fragment);
        if [fragment.x, fragment.y] == self.place {
            let mut seen = self.seen.lock().unwrap_or_else(PoisonError::into_inner);
            seen.push((fragment.id, fragment.weights, color));
        }
        color
    }

    fn through_eight(&self, fragments: &Fragments<'_>, alphas: &Eight) -> [Eight; 3] {
        self.surface.through_eight(fragments, alphas)
    }
}

/// Whose point, line or triangle has a name; names are given in the order of what is shown.
fn owner(scene: &Scene, id: u32) -> Option<Owner> {
    let mut first = 0;
    for (model, placed) in scene.models.iter().enumerate() {
        for (instance, primitive) in placed.model.shown_primitives() {
            let item = id as usize - first;
            if item < primitive.count() {
                let number = number(&placed.model, instance.node, primitive)?;
                return Some(Owner { model, node: instance.node, primitive: number, item });
            }
            first += primitive.count();
        }
    }
    None
}

/// The number of a primitive in the mesh of a node.
fn number(model: &Model, node: usize, primitive: &model::Primitive) -> Option<usize> {
    let mesh = model.meshes.get(model.nodes.get(node)?.mesh?)?;
    mesh.primitives.iter().position(|known| std::ptr::eq(known, primitive))
}
