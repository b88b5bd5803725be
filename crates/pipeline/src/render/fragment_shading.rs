//! Fragment shading: the scene's lights, environment and style as a [`Surface`](raster::Surface)
//! that the rasterizer calls for each visible fragment.
//!
//! The rasterizer calls the surface for each triangle that is visible in a pixel, not for each
//! triangle that covers the pixel. Shading is deferred until the visibility buffer of a tile is
//! complete. Styles wrap the physically based shading and use only its alpha test and geometry.

use super::renderer::FrameMemory;
use super::shadow_maps::ShadowMapRenderer;
use model::Colormap;
use scene::{Scene, Style};
use shade::{AmbientOcclusion, Shading, ShadingStyle, StyledShading, TransmissionFramebuffer};

/// Sets up physically based shading for the fragments of an assembled frame.
pub(super) fn fragment_shading<'a>(
    scene: &'a Scene,
    memory: &'a FrameMemory<'a>,
    shadows: &'a ShadowMapRenderer,
    occlusion: Option<&'a AmbientOcclusion>,
    transmission_framebuffer: Option<&'a TransmissionFramebuffer>,
) -> Shading<'a> {
    Shading {
        draws: &memory.draws,
        backdrop: scene.backdrop.as_deref(),
        lights: &scene.lights,
        shadows: &shadows.maps,
        ground_occlusion: shadows.ground_occlusion.as_ref(),
        occlusion,
        transmission_framebuffer,
        environment: scene.environment.as_deref(),
        tone_mapper: scene.tone_mapper,
        viewer: scene.view_projection.viewer(),
        has_eight_bits: false,
        simd_level: memory.frame.simd_level(),
    }
}

/// Returns the shading of a style that overrides the materials, such as clay, matcap, toon (cel) or
/// X-ray (`shade/src/shading_style.rs`). Returns `None` for styles that show the materials and for
/// line drawings.
pub(super) fn style_shading<'a>(
    scene: &Scene,
    shading: &'a Shading<'a>,
) -> Option<StyledShading<'a>> {
    let camera = scene.view_projection.camera;
    let style = match scene.style {
        Style::Unlit => ShadingStyle::Unlit,
        Style::Gouraud => ShadingStyle::Gouraud,
        Style::Clay => ShadingStyle::Clay,
        Style::Matcap => ShadingStyle::Matcap,
        Style::Normals => ShadingStyle::Normals,
        Style::Depth(colormap) => depth_style(scene, colormap),
        Style::UvChecker => ShadingStyle::UvChecker,
        Style::Ids => ShadingStyle::Ids,
        Style::Toon => ShadingStyle::Toon,
        Style::XRay => ShadingStyle::XRay,
        Style::Shaded | Style::Flat | Style::Wireframe | Style::Lines(_) => return None,
    };
    let axes = [camera.u(), camera.v(), camera.w()];
    let world_to_view = axes.map(|axis| axis.raw().as_vec3().to_array());
    let eye_position = camera.eye().raw().as_vec3().to_array();
    Some(StyledShading { shading, style, world_to_view, eye_position })
}

/// Returns the depth style, whose colors run from the nearest to the farthest vertex of the scene.
fn depth_style(scene: &Scene, colormap: Option<Colormap>) -> ShadingStyle {
    let world_to_view = scene.view_projection.camera.world_to_view();
    let (mut near, mut far) = (f64::INFINITY, f64::NEG_INFINITY);
    for point in scene.world_points() {
        let depth = -world_to_view.transform_point(point).z();
        (near, far) = (near.min(depth), far.max(depth));
    }
    // Nothing behind the eye is visible, so the ramp never starts behind the eye.
    ShadingStyle::Depth { near: near.max(0.0) as f32, far: far as f32, colormap }
}
