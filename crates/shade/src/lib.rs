#![doc = include_str!("../README.md")]

mod alpha_test;
mod ambient_occlusion;
mod approximations;
mod attributes;
mod backdrop;
mod brdf;
pub mod color;
mod draw;
mod environment;
mod environment_background;
mod fragment_lanes;
mod ground_occlusion;
mod hdr;
mod kernel_part;
mod lanes;
mod light;
mod light_shadow;
mod material_inputs;
mod material_textures;
mod output;
mod picture;
mod procedural_sky;
mod shading;
mod shading_style;
mod shadow_catcher;
mod shadow_cube;
mod shadow_map;
mod shadow_receiver;
mod studio;
mod surface_geometry;
mod texture;
mod tone_mapping;
mod transmission;
mod vector;

pub use ambient_occlusion::{AmbientOcclusion, ScreenSpace};
pub use attributes::{NORMAL, POSITION, UV, Vertex};
pub use backdrop::{Backdrop, BackdropImage, Gradient, ImageFit};
pub use draw::{Draw, DrawKind, DrawList, Tangents};
pub use environment::Environment;
pub use ground_occlusion::{GroundGrid, GroundOcclusion, HeightSlab};
pub use hdr::Panorama;
pub use light::Light;
pub use light_shadow::LightShadow;
pub use material_textures::{MaterialTexture, MaterialTextures};
pub use output::{
    AtomicFile, OutputError, PngRows, create_partial_file, encode_png, forget_partial_file,
    register_partial_file, remove_partial_files, write_file,
};
pub use picture::{Channel, Picture};
pub use procedural_sky::PreethamSky;
pub use shading::Shading;
pub use shading_style::{ShadingStyle, StyledShading};
pub use shadow_cube::ShadowCube;
pub use shadow_map::{Shadow, ShadowMap};
pub use studio::studio_radiance;
pub use texture::{MipChain, TexelEncoding};
pub use tone_mapping::{ToneMapper, ToneMapping};
pub use transmission::{ScreenProjection, TransmissionFramebuffer};
