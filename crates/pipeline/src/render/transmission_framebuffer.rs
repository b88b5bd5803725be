//! Renders the transmission framebuffer: everything that may be visible behind refracting and rough
//! glass, in linear light.
//!
//! It covers the whole picture even if only a region is rendered, because refraction and roughness
//! bring in light from outside the region. `shade::TransmissionFramebuffer` performs the lookup.

use super::RenderError;
use super::ambient_occlusion::{OcclusionBuffers, compute_full_occlusion, compute_occlusion};
use super::context::RenderContext;
use super::fragment_shading::fragment_shading;
use super::image_tiles::{TileRegion, tile_regions};
use super::primitive_assembly::assemble_behind_glass;
use super::renderer::RenderBuffers;
use super::screen_transform::{ScreenTransform, volume_center};
use super::shadow_maps::ShadowMapRenderer;
use model::Material;
use raster::Surface;
use scene::{ImageSpec, Scene};
use shade::{AmbientOcclusion, ScreenProjection, ToneMapper, TransmissionFramebuffer};

/// The maximum side of a framebuffer in texels. For larger pictures the size is halved until it
/// fits, because each texel takes 21 bytes.
const MAX_FRAMEBUFFER_SIDE: u32 = 4096;

/// Whether a scene's picture needs a transmission framebuffer, which is the case if some glass
/// refracts or is rough and the style shows materials.
pub(super) fn needs_framebuffer(scene: &Scene) -> bool {
    let bends_light = |model: &model::Model| {
        // Most models have no such material, so there is no need to search for its uses.
        model.materials.iter().any(Material::bends_transmitted_light)
            && model.scene_primitives().any(|(_, primitive)| {
                let material = primitive.material.map(|index| &model.materials[index]);
                material.is_some_and(Material::bends_transmitted_light)
            })
    };
    !scene.style.overrides_materials()
        && scene.models.iter().any(|instance| bends_light(&instance.model))
}

/// Computes the ambient occlusion of the whole picture from all surfaces except glass and blended
/// surfaces.
///
/// # Errors
/// Returns an error if the picture is larger than one image tile, or if the scene has too many
/// primitives.
pub(super) fn compute_whole_occlusion(
    context: &RenderContext<'_>,
) -> Result<Option<AmbientOcclusion>, RenderError> {
    let scene = context.scene;
    if scene.occlusion_radius.is_none() || !needs_framebuffer(scene) {
        return compute_full_occlusion(context);
    }
    let [whole] = tile_regions(scene.image, scene.image.pixel_rect())[..] else {
        return Err(RenderError::OcclusionTooLarge);
    };
    let memory = RenderBuffers::default().take_frame(context, whole)?;
    // The rasterizer treats refracting glass as opaque, so it would occlude in this depth buffer.
    let memory = assemble_behind_glass(context, memory)?;
    compute_occlusion(context, &memory, &mut OcclusionBuffers::default())
}

/// Renders the framebuffer of a scene's whole picture, or returns `None` if none is needed.
///
/// # Errors
/// Returns an error if the scene has too many primitives.
pub(super) fn render_framebuffer(
    context: &RenderContext<'_>,
    shadows: &ShadowMapRenderer,
    occlusion: Option<&AmbientOcclusion>,
) -> Result<Option<TransmissionFramebuffer>, RenderError> {
    if !needs_framebuffer(context.scene) {
        return Ok(None);
    }
    let mut scene = context.scene.clone();
    [scene.image.width, scene.image.height] = framebuffer_size(scene.image);
    // The framebuffer contains linear light and not picture colors, because glass is tone mapped
    // together with the light behind it.
    scene.tone_mapper = ToneMapper::default();
    let context = context.with_scene(&scene);
    let whole = TileRegion::for_whole(scene.image);
    let memory = RenderBuffers::default().take_frame(&context, whole)?;
    let memory = assemble_behind_glass(&context, memory)?;
    let shading = fragment_shading(&scene, &memory, shadows, occlusion, None);
    let surface: &dyn Surface = &shading;
    let mut texels = vec![[0.0; 4]; whole.pixel_count()];
    let linear = |color: [f32; 4]| color;
    memory.frame.draw(&surface, [0.0; 4], context.threads, &mut texels, linear);
    let projection = screen_projection(&scene)?;
    let (backdrop, background) = (scene.backdrop.as_deref(), scene.image.background);
    let threads = context.threads;
    Ok(Some(TransmissionFramebuffer::new(projection, texels, backdrop, background, threads)))
}

/// Returns the size of the framebuffer in texels: the picture's size or a fraction of it.
fn framebuffer_size(image: ImageSpec) -> [u32; 2] {
    let longer = image.width.max(image.height);
    let halvings = longer.div_ceil(MAX_FRAMEBUFFER_SIDE).next_power_of_two();
    [image.width, image.height].map(|side| side.div_ceil(halvings))
}

/// Returns the mapping from the world to the texels of a framebuffer.
fn screen_projection(scene: &Scene) -> Result<ScreenProjection, RenderError> {
    let ImageSpec { width, height, .. } = scene.image;
    let view = &scene.view_projection;
    let world_to_screen = ScreenTransform::new(view, width, height)?.world_to_screen();
    Ok(ScreenProjection::new([width, height], world_to_screen, volume_center(view)))
}
