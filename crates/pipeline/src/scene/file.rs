//! A scene as a person writes it: RON, with degrees, paths and defaults.
//!
//! These types say what a scene file may contain and nothing of what it means; [`Scene::resolve`](super::Scene::resolve) does that. Every
//! field but the models' paths may be left out. Unknown fields are errors, so that a slip of the pen is found.

mod camera;
mod environment;
mod light;
mod lines;
mod look;
mod overlay;
mod passes;
mod projection;
mod sheet;

pub use self::camera::{CameraChoice, CameraFile, FromFile, USUAL_PADDING, ViewFile};
pub use self::environment::EnvironmentFile;
pub use self::light::LightFile;
pub use self::lines::{CapFile, HiddenFile, JoinFile, LinesFile, ShownFile, WidthFile};
pub use self::look::{BackgroundFile, ImageFile, StyleFile, ToneMappingFile};
pub use self::overlay::OverlayFile;
pub use self::passes::{PassEncodingFile, PassFile, PassesFile};
pub use self::projection::{PrincipalFile, ProjectionFile};
pub use self::sheet::{
    AngleFile, AxonometricFile, OrientationFile, PaperFile, SheetFile, SideFile, UnitFile,
};
pub use super::number::Finite;
use super::number::{Scale, Triple};
use crate::import;
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
    /// The lights. Default: those of the models; where they have none and there is no environment either, a key light from above
    /// the viewer's left shoulder, and ambient light.
    pub lights: Option<Vec<LightFile>>,
    /// Light from all around. Default: none.
    pub environment: Option<EnvironmentFile>,
    /// How surfaces are drawn. Default: `Shaded`.
    #[serde(default)]
    pub style: StyleFile,
    /// The picture. Default: 960 × 720 pixels, transparent.
    #[serde(default)]
    pub image: ImageFile,
    /// What is drawn over the picture. Default: nothing.
    #[serde(default)]
    pub overlays: Vec<OverlayFile>,
    /// What is written of each pixel besides its colour. Default: nothing.
    #[serde(default)]
    pub passes: PassesFile,
    /// How `alberti sheet` puts the models on paper. Default: as its flags say.
    pub sheet: Option<SheetFile>,
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
            environment: None,
            style: StyleFile::default(),
            image: ImageFile::default(),
            overlays: Vec::new(),
            passes: PassesFile::default(),
            sheet: None,
        }
    }
}
