//! A scene as a person writes it: RON, with degrees, paths and defaults.
//!
//! These types say what a scene file may contain and nothing of what it means; [`Scene::resolve`](super::Scene::resolve) does that. Every
//! field but the models' paths may be left out. Unknown fields are errors, so that a slip of the pen is found.

mod background;
mod camera;
mod camera_path;
mod environment;
mod ground;
mod include;
mod instances;
mod light;
mod lines;
mod look;
mod material;
mod occlusion;
mod overlay;
mod passes;
mod projection;
mod section;
mod shadow;
mod sheet;
mod viewport;

pub use self::background::{BackgroundFile, FitFile};
pub use self::camera::{CameraChoice, CameraFile, DEFAULT_PADDING, FromFile, ViewFile};
pub use self::camera_path::{CameraKeyFile, CameraPathFile, CurveFile};
pub use self::environment::EnvironmentFile;
pub use self::ground::GroundFile;
pub use self::include::Paths;
pub use self::instances::{InstanceFile, InstancesFile};
pub use self::light::LightFile;
pub use self::lines::{
    CapFile, EdgeSelectionFile, FaceFillFile, HiddenFile, JoinFile, LinesFile, WidthFile,
};
pub use self::look::{ImageFile, StyleFile, ToneMappingFile};
pub use self::material::{AlphaModeFile, MaterialFile, MaterialsFile};
pub use self::occlusion::AmbientOcclusionFile;
pub use self::overlay::OverlayFile;
pub use self::passes::{PassEncodingFile, PassFile, PassesFile};
pub use self::projection::{PrincipalFile, ProjectionFile};
pub use self::section::SectionFile;
pub use self::shadow::ShadowsFile;
pub use self::sheet::{
    AngleFile, AxonometricFile, OrientationFile, PaperFile, SheetFile, SideFile, UnitFile,
};
pub use self::viewport::{BorderFile, StereoFile, ViewportFile};
pub use super::number::{FieldOfView, Finite};
use super::number::{Scale, Triple};
use crate::import;
use serde::Deserialize;

/// A scene file.
#[derive(Clone, PartialEq, Default, Debug, Deserialize)]
#[serde(rename = "Scene", deny_unknown_fields)]
pub struct SceneFile {
    /// Other scene files to begin with, in this order. Their models, lights, overlays and sections come before those of this file; of all
    /// other fields this file's goes before theirs, whole, and a later file's before an earlier one's. Paths in an included file
    /// begin at its own folder; it must lie below the folder of the scene. Default: none.
    #[serde(default)]
    pub include: Paths,
    /// The models to draw. A scene needs one; a file that is included does not. Default: none.
    #[serde(default)]
    pub models: Vec<ModelFile>,
    /// From where, and by which projection. Default: framed from a named direction, in perspective.
    #[serde(default)]
    pub camera: CameraFile,
    /// Where the camera is at which time, for `alberti animate`; pictures do not look at it, nor do lights that
    /// the scene leaves open. Default: it stays in its place.
    pub camera_path: Option<CameraPathFile>,
    /// Views of their own in parts of the picture, one over the other. Default: none.
    #[serde(default)]
    pub viewports: Vec<ViewportFile>,
    /// A pair of pictures for two eyes. Default: one picture.
    pub stereo: Option<StereoFile>,
    /// The lights. Default: those of the models; where they have none and there is no environment either, a key light from above
    /// the viewer's left shoulder, and ambient light; with an environment the key light alone, if there are to be shadows.
    pub lights: Option<Vec<LightFile>>,
    /// The shadows of all suns and spots that say nothing of theirs, those of the models too. Default: `Off`.
    pub shadows: Option<ShadowsFile>,
    /// What is below the models. Default: nothing.
    pub ground: Option<GroundFile>,
    /// Light from all around. Default: none; a bare model without lights of its own stands in a
    /// `Studio(strength: 0.6)`.
    pub environment: Option<EnvironmentFile>,
    /// Less light from all around where the picture shows something in its way. Default: none.
    pub ambient_occlusion: Option<AmbientOcclusionFile>,
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
    /// Planes that cut the models open, one after the other, in line drawings and on sheets; at most 16. Default: none.
    #[serde(default)]
    pub sections: Vec<SectionFile>,
    /// How `alberti sheet` puts the models on paper. Default: as its flags say.
    pub sheet: Option<SheetFile>,
}

/// A glTF file and where it goes: scaled, then turned, then moved.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(rename = "Model", deny_unknown_fields)]
pub struct ModelFile {
    /// The path of a `.gltf` or `.glb` file, from the folder of the scene file.
    pub path: String,
    /// The translation, in metres as glTF has them. Default: (0, 0, 0).
    #[serde(default)]
    pub translate: Triple,
    /// Turns about the x, then the y, then the z axis, in degrees. Default: (0, 0, 0).
    #[serde(default)]
    pub rotate_degrees: Triple,
    /// One factor for all axes, or one for each; none of them 0. Default: 1.
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
    /// The model many times. Default: once.
    pub instances: Option<InstancesFile>,
    /// What its materials look like, other than the model has it. Default: as it has it.
    #[serde(default)]
    pub materials: Vec<MaterialFile>,
}

/// Which scene, variant or animation of a model.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug, Deserialize)]
pub enum Choice {
    /// By its place in the file, from 0.
    Index(usize),
    /// By its name.
    Name(String),
}

impl From<Choice> for import::NameOrIndex {
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
    pub fn from_model_path(path: String) -> Self {
        let model = ModelFile {
            path,
            translate: Triple::default(),
            rotate_degrees: Triple::default(),
            scale: Scale::default(),
            scene: None,
            variant: None,
            animation: None,
            time: None,
            instances: None,
            materials: Vec::new(),
        };
        Self {
            include: Paths::default(),
            models: vec![model],
            camera: CameraFile::default(),
            camera_path: None,
            viewports: Vec::new(),
            stereo: None,
            lights: None,
            shadows: None,
            ground: None,
            environment: None,
            ambient_occlusion: None,
            style: StyleFile::default(),
            image: ImageFile::default(),
            overlays: Vec::new(),
            passes: PassesFile::default(),
            sections: Vec::new(),
            sheet: None,
        }
    }
}
