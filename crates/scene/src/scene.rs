//! A resolved scene: models, camera, lights, drawing style, and surroundings.

use super::{Ground, Inset};
use camera::ViewProjection;
use drawing::{LineStyle, Overlay};
use homog::{PixelRect, Plane, Point, World};
use model::{Colormap, ModelInstance};
use raster::Samples;
use shade::{Backdrop, Environment, Light, ToneMapper};
use std::sync::Arc;

/// A resolved scene: the complete input of a renderer.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The models with their transforms.
    pub models: Vec<ModelInstance>,
    /// The camera and projection.
    pub view_projection: ViewProjection,
    /// The lights.
    pub lights: Vec<Light>,
    /// The ground below the models.
    pub ground: Option<Ground>,
    /// Light from all directions.
    pub environment: Option<Arc<Environment>>,
    /// The distance up to which surfaces occlude light from all directions, in world units; `None`
    /// without ambient occlusion.
    pub occlusion_radius: Option<f64>,
    /// Exposure and tone mapping.
    pub tone_mapper: ToneMapper,
    /// The style of surfaces.
    pub style: Style,
    /// The picture to render.
    pub image: ImageSpec,
    /// Separate views in parts of the picture, in the order in which they are drawn over it.
    pub insets: Vec<Inset>,
    /// The gradient or image behind the models, over the background color.
    pub backdrop: Option<Arc<Backdrop>>,
    /// The overlays, drawn over the picture.
    pub overlays: Vec<Overlay>,
    /// The text below the view, in the strip along the bottom of the image.
    pub caption: Option<String>,
    /// Planes that cut the models open in line drawings; their unit normals point to the retained
    /// half.
    pub sections: Vec<Plane<World>>,
    /// The indices of the objects that the planes do not cut, in ascending order. Objects are nodes
    /// with a mesh, counted over all models.
    pub uncut: Vec<u32>,
    /// Whether lines are drawn without work limits.
    pub unlimited_lines: bool,
}

impl Scene {
    /// Creates a scene of models seen through a camera, shaded with their own materials, without
    /// lights or surroundings.
    ///
    /// To set other fields, write `Scene { lights, ..Scene::new(…) }`.
    #[must_use]
    pub fn new(
        models: Vec<ModelInstance>,
        view_projection: ViewProjection,
        image: ImageSpec,
    ) -> Self {
        Self {
            models,
            view_projection,
            lights: Vec::new(),
            ground: None,
            environment: None,
            occlusion_radius: None,
            tone_mapper: ToneMapper::default(),
            style: Style::Shaded,
            image,
            insets: Vec::new(),
            backdrop: None,
            overlays: Vec::new(),
            caption: None,
            sections: Vec::new(),
            uncut: Vec::new(),
            unlimited_lines: false,
        }
    }

    /// Returns every vertex used by a point, line or triangle of the scene, in world space.
    #[must_use]
    pub fn world_points(&self) -> Vec<Point<World>> {
        model::world_points(&self.models)
    }

    /// Whether every pixel of the picture must be opaque, because the backgrounds of the scene and
    /// of all insets are.
    #[must_use]
    pub fn has_opaque_background(&self) -> bool {
        let is_opaque = |scene: &Self| scene.image.background[3] >= 1.0;
        is_opaque(self) && self.insets.iter().all(|inset| is_opaque(&inset.scene))
    }

    /// Whether a light casts shadows, or the ground shows occlusion from the models.
    #[must_use]
    pub fn casts_shadows(&self) -> bool {
        let has_occlusion = self.ground.is_some_and(|ground| ground.occlusion.is_some());
        has_occlusion || self.lights.iter().any(|light| light.shadow().is_some())
    }

    /// Returns the model names, without duplicates.
    #[must_use]
    pub fn model_names(&self) -> String {
        model::model_names(&self.models)
    }

    /// Returns the input for a line drawing of the scene.
    #[must_use]
    pub fn drawing_subject(&self) -> hidden_line::Subject<'_> {
        hidden_line::Subject {
            models: &self.models,
            view_projection: self.view_projection,
            size: [self.image.width, self.image.height],
            caption_height: self.image.caption_height,
            sections: &self.sections,
            uncut: &self.uncut,
        }
    }
}

/// The style of surfaces.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Style {
    /// Lit, with smooth normals if the model has them.
    Shaded,
    /// Lit, with one normal per triangle.
    Flat,
    /// The base colors of the materials, without light.
    Unlit,
    /// Gouraud shading: lit at the vertices and interpolated.
    Gouraud,
    /// Matte clay.
    Clay,
    /// A material capture of glazed clay.
    Matcap,
    /// Normals as colors.
    Normals,
    /// Depth: nearer surfaces are brighter or, with a colormap, closer to its last color.
    Depth(Option<Colormap>),
    /// A checkerboard from texture coordinates.
    UvChecker,
    /// A color for each part.
    Ids,
    /// Toon (cel) shading: three steps of light, with outlines.
    Toon,
    /// X-ray: translucent surfaces.
    XRay,
    /// The edges of all triangles.
    Wireframe,
    /// A line drawing.
    Lines(LineStyle),
}

impl Style {
    /// Returns the style's settings for lines.
    #[must_use]
    pub const fn line_style(self) -> LineStyle {
        match self {
            Self::Wireframe => LineStyle::WIREFRAME,
            Self::Lines(style) => style,
            _ => LineStyle::HIDDEN_REMOVED,
        }
    }

    /// Whether surfaces are drawn rather than only lines.
    #[must_use]
    pub const fn draws_surfaces(self) -> bool {
        !matches!(self, Self::Wireframe | Self::Lines(_))
    }

    /// Whether colors represent data: normals, depths, texture coordinates or parts.
    #[must_use]
    pub const fn is_false_color(self) -> bool {
        matches!(self, Self::Normals | Self::Depth(_) | Self::UvChecker | Self::Ids)
    }

    /// Whether the style replaces the appearance of the materials.
    #[must_use]
    pub const fn overrides_materials(self) -> bool {
        self.draws_surfaces() && !matches!(self, Self::Shaded | Self::Flat)
    }
}

/// The maximum width or height of a picture in pixels. Above 16,384 pixels per side, pictures are
/// rendered region by region.
pub const MAX_IMAGE_SIDE: u32 = 1 << 20;

/// The picture to render.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ImageSpec {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels, including the caption.
    pub height: u32,
    /// The height in pixels of the caption strip along the bottom; 0 without a caption.
    pub caption_height: u32,
    /// The background color: linear, premultiplied by alpha.
    pub background: [f32; 4],
    /// Whether the background is the white paper that line drawings have by default. Pages in
    /// vector formats omit it.
    pub is_blank_paper: bool,
    /// The blur of the environment as background, from 0 to 1; `None` for another background.
    pub environment_blur: Option<f32>,
    /// Coverage samples per pixel.
    pub samples: Samples,
    /// The maximum number of samples for anisotropic texture filtering, along the longer axis of a
    /// pixel's footprint, from 1 to 8.
    pub max_anisotropy: u32,
    /// The size of points in pixels, from 1 to 256.
    pub point_size: f64,
}

impl ImageSpec {
    /// Specifies a picture of this size in pixels on a transparent background, with one sample per
    /// pixel.
    #[must_use]
    pub const fn new(width: u32, height: u32) -> Self {
        Self {
            width,
            height,
            caption_height: 0,
            background: [0.0; 4],
            is_blank_paper: false,
            environment_blur: None,
            samples: Samples::One,
            max_anisotropy: 1,
            point_size: 3.0,
        }
    }

    /// Returns the rectangle of all pixels of the picture.
    #[must_use]
    pub const fn pixel_rect(self) -> PixelRect {
        PixelRect::from_size(self.width, self.height)
    }
}
