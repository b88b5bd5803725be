//! That shading eight fragments at once changes nothing.

use super::assemble::assemble;
use super::region::sheets;
use super::renderer::Memory;
use super::{Renderer, Textures};
use crate::scene::{Origin, Scene, Style, parse};
use raster::{Eight, Fragment, Fragments, Samples, Surface};
use shade::Shading;
use std::path::Path;

/// Shades as `Shading` does, but one fragment after the other.
struct OneByOne<'a>(&'a Shading<'a>);

impl Surface for OneByOne<'_> {
    fn keeps(&self, fragment: &Fragment<'_>) -> bool {
        self.0.keeps(fragment)
    }

    fn shade(&self, fragment: &Fragment<'_>) -> [f32; 4] {
        self.0.shade(fragment)
    }

    fn through_eight(&self, fragments: &Fragments<'_>, alphas: &Eight) -> [Eight; 3] {
        self.0.through_eight(fragments, alphas)
    }
}

/// A scene of the project, small.
fn scene(name: &str) -> Scene {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let text = std::fs::read_to_string(folder.join(name)).expect("a scene of the project");
    let mut file = parse(name, &text).expect("a scene");
    file.image.size = (200, 130);
    let origin = Origin::of_text(name, text, folder);
    Scene::resolve(&origin, &file, &Default::default()).expect("a scene that makes sense")
}

#[test]
fn eight_fragments_at_once_have_the_colours_of_one_by_one() {
    for name in ["crates.ron", "lights.ron", "panes.ron", "primitives.ron", "room.ron"] {
        for (samples, style) in [(1, Style::Shaded), (4, Style::Shaded), (1, Style::Flat)] {
            let mut scene = scene(name);
            scene.style = style;
            scene.image.samples = Samples::from_count(samples).expect("a number of samples");
            let textures = Textures::of(&scene.models);
            let whole = sheets(scene.image, scene.image.rect())[0];
            let memory = Renderer::default().lend(&scene, whole, 1).expect("a frame");
            let Memory { frame, draws, .. } =
                assemble(&scene, &textures, 1, memory).expect("a frame");
            let viewer = scene.view_projection.viewer();
            let instructions = frame.instructions();
            let shading = Shading {
                painting: None,
                draws: &draws,
                lights: &scene.lights,
                shadows: &[],
                occlusion: None,
                environment: scene.environment.as_deref(),
                develop: scene.develop,
                viewer,
                instructions,
            };
            let mut pictures = [(); 2].map(|()| vec![[0; 4]; 200 * 130]);
            let bits = |color: [f32; 4]| color.map(f32::to_bits);
            let background = scene.image.background;
            frame.draw(&shading, background, 1, &mut pictures[0], bits);
            frame.draw(&OneByOne(&shading), background, 1, &mut pictures[1], bits);
            assert!(pictures[0] == pictures[1], "{name} with {samples} samples");
        }
    }
}
