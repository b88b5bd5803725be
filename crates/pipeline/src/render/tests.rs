//! Compares SIMD shading with scalar shading: the colors of eight fragments shaded at once must
//! match scalar colors bit for bit.

use super::context::RenderContext;
use super::fragment_shading::fragment_shading;
use super::image_tiles::tile_regions;
use super::mip_chains::Textures;
use super::primitive_assembly::assemble_scene;
use super::renderer::RenderBuffers;
use super::shadow_maps::ShadowMapRenderer;
use super::transmission_framebuffer::render_framebuffer;
use raster::{Fragment, Fragments, Samples, Surface, TranslucentColors};
use scene::{Origin, Scene, Style};
use scene_file::parse_scene;
use shade::Shading;
use std::path::Path;
use std::sync::Arc;

/// Shades like `Shading`, but one fragment at a time, with the default methods of `Surface`.
struct ScalarShading<'a>(&'a Shading<'a>);

impl Surface for ScalarShading<'_> {
    fn passes_alpha_test(&self, fragment: &Fragment<'_>) -> bool {
        self.0.passes_alpha_test(fragment)
    }

    fn shade(&self, fragment: &Fragment<'_>) -> [f32; 4] {
        self.0.shade(fragment)
    }

    fn is_continuous(&self, first_id: u32, second_id: u32) -> bool {
        self.0.is_continuous(first_id, second_id)
    }

    fn shade_translucent_eight(&self, fragments: &Fragments<'_>) -> TranslucentColors {
        let TranslucentColors { transmittance, .. } = self.0.shade_translucent_eight(fragments);
        TranslucentColors { color: self.shade_eight(fragments), transmittance }
    }
}

/// Loads a scene from the repository at a small size.
fn load_scene(name: &str) -> Scene {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let text = std::fs::read_to_string(folder.join(name)).expect("a scene in the repository");
    let mut file = parse_scene(name, &text).expect("a scene");
    file.image.size = (200, 130);
    let origin = Origin::from_text(name, text, folder);
    let mut scene = Scene::resolve(&origin, &file, &Default::default()).expect("a valid scene");
    // The glass ball becomes rough, so that it shows the transmission framebuffer.
    for material in
        scene.models.iter_mut().flat_map(|of| &mut Arc::make_mut(&mut of.model).materials)
    {
        if material.is_transmissive() {
            material.roughness = 0.4;
        }
    }
    scene
}

#[test]
fn simd_shading_matches_scalar_shading() {
    for name in
        ["crates.ron", "finishes.ron", "lights.ron", "panes.ron", "primitives.ron", "room.ron"]
    {
        for (samples, style) in [(1, Style::Shaded), (4, Style::Shaded), (1, Style::Flat)] {
            let mut scene = load_scene(name);
            scene.style = style;
            scene.image.samples = Samples::from_count(samples).expect("a valid sample count");
            let textures = Textures::for_models(&scene.models);
            let tile_region = tile_regions(scene.image, scene.image.pixel_rect())[0];
            let context = RenderContext::new(&scene, &textures, 1);
            let memory = RenderBuffers::default().take_frame(&context, tile_region);
            let memory = assemble_scene(&context, memory.expect("a frame")).expect("a frame");
            let shadows = ShadowMapRenderer::default();
            let framebuffer = render_framebuffer(&context, &shadows, None).expect("a framebuffer");
            let shading = fragment_shading(&scene, &memory, &shadows, None, framebuffer.as_ref());
            let frame = &memory.frame;
            let mut pictures = [(); 2].map(|()| vec![[0; 4]; 200 * 130]);
            let bits = |color: [f32; 4]| color.map(f32::to_bits);
            let background = scene.image.background;
            frame.draw(&shading, background, 1, &mut pictures[0], bits);
            frame.draw(&ScalarShading(&shading), background, 1, &mut pictures[1], bits);
            assert!(pictures[0] == pictures[1], "{name} with {samples} samples");
        }
    }
}
