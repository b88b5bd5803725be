//! A scene as a person writes it: RON, with degrees, paths and defaults.
//!
//! These types say what a scene file may contain and nothing of what it means; [`Scene::resolve`](super::Scene::resolve) does that. Every
//! field but the models' paths may be left out. Unknown fields are errors, so that a slip of the pen is found.

pub use super::number::Finite;
use super::number::{FieldOfView, NonNegative, Positive, Scale, Triple};
use crate::import;
use camera::NamedView;
use serde::Deserialize;

/// A scene file.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(rename = "Scene", deny_unknown_fields)]
pub struct SceneFile {
    /// The models to draw.
    pub models: Vec<ModelFile>,
    /// From where, and by which projection. Default: framed from a named direction, in perspective.
    #[serde(default)]
    pub camera: CameraFile,
    /// The lights. Default: a key light from above the viewer's left shoulder, and ambient light.
    pub lights: Option<Vec<LightFile>>,
    /// How surfaces are drawn. Default: `Shaded`.
    #[serde(default)]
    pub style: StyleFile,
    /// The picture. Default: 960 × 720 pixels, transparent.
    #[serde(default)]
    pub image: ImageFile,
}

/// A glTF file and where it goes: scaled, then turned, then moved.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(rename = "Model", deny_unknown_fields)]
pub struct ModelFile {
    /// The path of a `.gltf` or `.glb` file, from the folder of the scene file.
    pub path: String,
    /// The translation.
    #[serde(default)]
    pub translate: Triple,
    /// Turns about the x, then the y, then the z axis.
    #[serde(default)]
    pub rotate_degrees: Triple,
    /// One factor for all axes, or one for each.
    #[serde(default)]
    pub scale: Scale,
    /// The scene of the model that is shown. Default: its default scene, else its first.
    pub scene: Option<Choice>,
    /// The variant of the model's materials. Default: none.
    pub variant: Option<Choice>,
    /// The animation that poses the model. Default: the first, if there is a `time`; else none.
    pub animation: Option<Choice>,
    /// The time of the animation in seconds. Default: 0, if there is an `animation`.
    pub time: Option<Finite>,
}

/// Which scene, variant or animation of a model.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug, Deserialize)]
pub enum Choice {
    /// By its place in the file, from 0.
    Index(usize),
    /// By its name.
    Name(String),
}

impl From<Choice> for import::Choice {
    fn from(choice: Choice) -> Self {
        match choice {
            Choice::Index(at) => Self::Index(at),
            Choice::Name(name) => Self::Name(name),
        }
    }
}

/// The camera: where it is, and how it projects.
#[derive(Clone, PartialEq, Debug, Default, Deserialize)]
#[serde(rename = "Camera", deny_unknown_fields, default)]
pub struct CameraFile {
    /// Where the eye is and where it looks.
    pub view: ViewFile,
    /// The projection; a camera of the model's brings its own. Default: perspective.
    pub projection: Option<ProjectionFile>,
}

/// Where the eye is and where it looks.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(rename = "View", deny_unknown_fields)]
pub enum ViewFile {
    /// From a place towards another.
    LookAt {
        /// The place of the eye.
        eye: Triple,
        /// The place looked at, which becomes the centre of the picture.
        target: Triple,
        /// The view-up vector: the direction that is to point up in the picture. Default: y.
        #[serde(default = "Triple::y_axis")]
        up: Triple,
    },
    /// From a place in a direction.
    LookTo {
        /// The place of the eye.
        eye: Triple,
        /// The direction of gaze.
        gaze: Triple,
        /// The view-up vector. Default: y.
        #[serde(default = "Triple::y_axis")]
        up: Triple,
    },
    /// From a direction, at the distance at which everything just fits.
    Frame {
        /// Where from.
        #[serde(default)]
        from: FromFile,
        /// The margin on each side, in per cent of the picture's side. Default: 5.
        #[serde(default = "usual_padding")]
        padding_percent: NonNegative,
    },
    /// A camera of the first model that has cameras.
    FromModel(CameraChoice),
}

impl Default for ViewFile {
    fn default() -> Self {
        Self::Frame { from: FromFile::default(), padding_percent: USUAL_PADDING }
    }
}

/// The margin, in per cent, of framed pictures that name none.
pub const USUAL_PADDING: NonNegative = NonNegative::FIVE;

fn usual_padding() -> NonNegative {
    USUAL_PADDING
}

/// The direction a picture is framed from.
#[derive(Clone, PartialEq, Debug, Default, Deserialize)]
#[serde(rename = "From")]
pub enum FromFile {
    /// The side that faces +z, which is the front in glTF.
    Front,
    /// The side that faces −z.
    Back,
    /// The side that faces −x.
    Left,
    /// The side that faces +x.
    Right,
    /// The side that faces +y.
    Top,
    /// The side that faces −y.
    Bottom,
    /// From the front, a little from the right and from above.
    #[default]
    ThreeQuarter,
    /// From the front, the right and above alike, so that all three axes are shortened alike.
    Isometric,
    /// x and y shortened alike, z twice as much: 7° and 42° on the page.
    Dimetric,
    /// Each axis shortened by a factor of its own.
    Trimetric,
    /// From the direction of a vector: (1, 0, 0) is from the right.
    Direction(Triple),
}

impl From<NamedView> for FromFile {
    fn from(view: NamedView) -> Self {
        match view {
            NamedView::Front => Self::Front,
            NamedView::Back => Self::Back,
            NamedView::Left => Self::Left,
            NamedView::Right => Self::Right,
            NamedView::Top => Self::Top,
            NamedView::Bottom => Self::Bottom,
            NamedView::ThreeQuarter => Self::ThreeQuarter,
            NamedView::Isometric => Self::Isometric,
            NamedView::Dimetric => Self::Dimetric,
            NamedView::Trimetric => Self::Trimetric,
        }
    }
}

/// Which camera of a model.
#[derive(Clone, PartialEq, Eq, Debug, Deserialize)]
pub enum CameraChoice {
    /// By its place in the file, from 0.
    Index(usize),
    /// By its own name or that of its node.
    Name(String),
}

/// A projection.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(rename = "Projection", deny_unknown_fields)]
pub enum ProjectionFile {
    /// Perspective, the eye in front of the picture's centre.
    Perspective {
        /// The vertical opening angle. Default: 35.
        #[serde(default)]
        fov_y_degrees: FieldOfView,
        /// The distance of the near plane. Default: as far out as the scene allows.
        near: Option<Positive>,
        /// The distance of the far plane. Default: just behind everything.
        far: Option<Positive>,
    },
    /// Parallel, at right angles to the picture.
    Orthographic {
        /// The height of the view volume in the scene's units. Default: what the framing asks for.
        height: Option<Positive>,
        /// The distance of the near plane. Default: just before everything.
        near: Option<Finite>,
        /// The distance of the far plane. Default: just behind everything.
        far: Option<Finite>,
    },
    /// Perspective through any window on the near plane, also one beside the line of sight.
    Frustum {
        /// The window's left border.
        left: Finite,
        /// The window's right border.
        right: Finite,
        /// The window's bottom border.
        bottom: Finite,
        /// The window's top border.
        top: Finite,
        /// The distance of the window, which is the near plane.
        near: Positive,
        /// The distance of the far plane. Default: just behind everything.
        far: Option<Positive>,
    },
}

impl ProjectionFile {
    /// Perspective with every default.
    pub const PERSPECTIVE: Self =
        Self::Perspective { fov_y_degrees: FieldOfView::USUAL, near: None, far: None };
    /// Orthographic with every default.
    pub const ORTHOGRAPHIC: Self = Self::Orthographic { height: None, near: None, far: None };
}

/// A light.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(rename = "Light", deny_unknown_fields)]
pub enum LightFile {
    /// Light from very far away: parallel rays.
    Sun {
        /// The direction in which the light travels.
        direction: Triple,
        /// The illuminance of a surface that faces the light; a white one then shows `lux` / π.
        lux: NonNegative,
        /// Red, green and blue, linear. Default: white.
        #[serde(default = "Triple::ones")]
        color: Triple,
    },
    /// Light from a point, weaker with the square of the distance.
    Point {
        /// Where it is.
        position: Triple,
        /// The luminous intensity: the illuminance at distance 1.
        candela: NonNegative,
        /// Red, green and blue, linear. Default: white.
        #[serde(default = "Triple::ones")]
        color: Triple,
    },
    /// The same light from everywhere.
    Ambient {
        /// The illuminance of every surface.
        lux: NonNegative,
        /// Red, green and blue, linear. Default: white.
        #[serde(default = "Triple::ones")]
        color: Triple,
    },
}

/// How surfaces are drawn.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Deserialize)]
#[serde(rename = "Style")]
pub enum StyleFile {
    /// Lit, with the smooth normals of the file.
    #[default]
    Shaded,
    /// Lit, each triangle with one normal.
    Flat,
    /// The edges of all triangles, the hidden ones too.
    Wireframe,
}

/// The picture.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(rename = "Image", deny_unknown_fields, default)]
pub struct ImageFile {
    /// Width and height in pixels.
    pub size: (u32, u32),
    /// What is seen where no model is.
    pub background: BackgroundFile,
    /// Coverage samples per pixel: 1, 4, 8 or 16.
    pub samples: u32,
}

impl Default for ImageFile {
    fn default() -> Self {
        Self { size: (960, 720), background: BackgroundFile::Transparent, samples: 4 }
    }
}

/// What is seen where no model is.
#[derive(Clone, PartialEq, Eq, Debug, Default, Deserialize)]
#[serde(rename = "Background")]
pub enum BackgroundFile {
    /// Nothing: alpha is 0.
    #[default]
    Transparent,
    /// A colour as on a web page: `#rgb` or `#rrggbb`.
    Color(String),
}

impl SceneFile {
    /// A scene of one model with every default.
    #[must_use]
    pub fn showing(path: String) -> Self {
        let model = ModelFile {
            path,
            translate: Triple::default(),
            rotate_degrees: Triple::default(),
            scale: Scale::default(),
            scene: None,
            variant: None,
            animation: None,
            time: None,
        };
        Self {
            models: vec![model],
            camera: CameraFile::default(),
            lights: None,
            style: StyleFile::default(),
            image: ImageFile::default(),
        }
    }
}
