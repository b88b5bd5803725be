//! The whole of `pipeline::render`: our rasterizer with the shading of the finished program, with
//! colors in linear light.
//!
//! It does more than the peers: it evaluates materials, and converts colors from and to sRGB. It is
//! listed next to the bare rasterizer because users wait for a whole frame of the program.

use super::Peer;
use crate::scene::{AMBIENT, Part, SIZE, Scene, TOWARDS_LIGHT, Texture};
use camera::ViewProjection;
use homog::Affine;
use import::{ImportOptions, load};
use model::{
    Image, Material, Mesh, MipmapMode, Model, ModelInstance, Primitive, Sampler, Texture as Used,
    TextureInfo,
};
use pipeline::{Picture, RenderContext, Renderer, Textures};
use projection::Convention;
use raster::Samples;
use scene::ImageSpec;
use shade::Light;
use std::f32::consts::PI;
use std::path::Path;
use std::sync::Arc;

/// The whole pipeline with a scene.
pub struct Render {
    scene: pipeline::Scene,
    textures: Textures<'static>,
    renderer: Renderer,
    threads: usize,
    picture: Picture,
}

impl Render {
    /// Creates the pipeline with `samples` per pixel and this many threads.
    pub fn new(scene: &Scene, samples: Samples, threads: usize) -> Result<Self, String> {
        let lux = |share: f32| [share * PI; 3];
        let (width, height) = SIZE;
        let models = vec![ModelInstance {
            model: Arc::new(model(scene)?),
            model_to_world: Affine::IDENTITY,
        }];
        let view_projection = ViewProjection {
            camera: scene.camera,
            view_to_clip: scene.view_to_clip(Convention::CHAPTER),
        };
        let lights = vec![
            Light::Sun { to_light: TOWARDS_LIGHT, lux: lux(1.0 - AMBIENT), shadow: None },
            Light::Ambient { lux: lux(AMBIENT) },
        ];
        let image = ImageSpec { samples, ..ImageSpec::new(width, height) };
        let scene =
            pipeline::Scene { lights, ..pipeline::Scene::new(models, view_projection, image) };
        // The models are leaked, because `textures` borrows them. There are only a few.
        let models: &'static [ModelInstance] = scene.models.clone().leak();
        Ok(Self {
            scene,
            textures: Textures::for_models(models),
            renderer: Renderer::default(),
            threads,
            picture: Picture::default(),
        })
    }
}

impl Peer for Render {
    fn name(&self) -> String {
        let samples = self.scene.image.samples.count();
        if samples == 1 { "render".into() } else { format!("render {samples}x") }
    }

    fn is_comparable(&self) -> bool {
        false
    }

    fn draw(&mut self) {
        let Self { scene, textures, renderer, threads, picture } = self;
        // A scene that cannot be rendered has no pixels and matches no other picture.
        if renderer.render(&RenderContext::new(scene, textures, *threads), picture).is_err() {
            picture.pixels.clear();
        }
    }

    fn pixels(&mut self) -> Vec<[u8; 4]> {
        self.picture.pixels.clone()
    }
}

/// Returns the scene as the importer would read it, with one node, one mesh, and one primitive per
/// part.
fn model(scene: &Scene) -> Result<Model, String> {
    let one_node = one_node()?;
    let numbered = || scene.parts.iter().enumerate();
    let mesh = Mesh {
        primitives: numbered().map(|(number, part)| primitive(scene, part, number)).collect(),
        ..Mesh::default()
    };
    // Like the peers, it uses no mip maps.
    let sampler = Sampler { mipmap_mode: MipmapMode::None, ..Sampler::default() };
    let count = scene.textures.len();
    Ok(Model {
        meshes: vec![mesh],
        materials: scene.parts.iter().map(material).collect(),
        textures: (0..count).map(|image| Used { image: Some(image), sampler }).collect(),
        images: scene.textures.iter().map(|texture| Some(image(texture))).collect(),
        ..one_node
    })
}

/// Returns a model with one node that shows mesh 0 without a transform, which is the importer's
/// result for the simplest file.
fn one_node() -> Result<Model, String> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("node.gltf");
    load(&file, &ImportOptions::default()).map_err(|error| error.to_string())
}

/// Returns the part with only the vertices it uses, renumbered.
fn primitive(scene: &Scene, part: &Part, number: usize) -> Primitive {
    let mut places = vec![u32::MAX; scene.vertices.len()];
    let mut used = Vec::new();
    let indices = scene.indices[part.indices.clone()].iter().map(|&index| {
        let place = &mut places[index as usize];
        if *place == u32::MAX {
            *place = used.len() as u32;
            used.push(scene.vertices[index as usize]);
        }
        *place
    });
    let indices = indices.collect();
    Primitive {
        indices,
        positions: used.iter().map(|vertex| vertex.position).collect(),
        normals: part.lit.then(|| used.iter().map(|vertex| vertex.normal).collect()),
        uvs: part.texture.map(|_| used.iter().map(|v| v.uv).collect()).into_iter().collect(),
        material: Some(number),
        ..Primitive::default()
    }
}

fn material(part: &Part) -> Material {
    let [r, g, b] = part.tint;
    let used = |texture| TextureInfo { texture, uv_set: 0, uv_matrix: TextureInfo::IDENTITY_UV };
    Material {
        base_color: [r, g, b, 1.0],
        base_color_texture: part.texture.map(used),
        metallic: 0.0,
        double_sided: part.two_sided,
        unlit: !part.lit,
        ..Material::default()
    }
}

fn image(texture: &Texture) -> Image {
    Image { width: texture.width as u32, height: texture.height as u32, rgba: texture.rgba.clone() }
}
