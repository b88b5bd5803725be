//! A scene as written in RON, before its paths, angles and defaults are resolved.
//!
//! These types define what a scene file may contain; the crate `scene` resolves it. Only the
//! models' paths are required. Unknown fields are errors, so misspelled names are caught.

mod assembly;
mod background;
mod camera;
mod camera_path;
mod constructors;
mod derived;
mod dimension;
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
mod scalars;
mod section;
mod shadow;
mod sheet;
mod sheet_view;
mod viewport;

pub use self::assembly::{DensityFile, ExplodedFile};
pub use self::background::BackgroundFile;
pub use self::camera::{
    CameraChoice, CameraFile, DEFAULT_PADDING, FromFile, RotationFile, ViewFile,
};
pub use self::camera_path::{CameraKeyFile, CameraPathFile, CurveFile};
pub(super) use self::dimension::is_dimensions_list;
pub use self::dimension::{DimensionFile, DimensionView, DimensionsFile, PickFile, PlaceFile};
pub use self::environment::EnvironmentFile;
pub use self::ground::GroundFile;
pub use self::include::Paths;
pub use self::instances::{InstanceFile, InstancesFile};
pub use self::light::LightFile;
pub use self::lines::{LinesFile, WidthFile};
pub use self::look::{ImageFile, StyleFile};
pub use self::material::{AlphaModeFile, MaterialFile, MaterialsFile};
pub use self::occlusion::AmbientOcclusionFile;
pub use self::overlay::OverlayFile;
pub use self::passes::PassesFile;
pub use self::projection::ProjectionFile;
pub use self::scalars::ScalarsFile;
pub use self::section::SectionFile;
pub use self::shadow::ShadowsFile;
pub use self::sheet::{AxonometricView, PageOrientation, PaperSize, SheetFile, SideView};
pub use self::sheet_view::{AxisFile, SheetViewFile, ViewSideFile};
pub use self::viewport::{BorderFile, StereoFile, ViewportFile, ViewportsScale};
pub use super::color::{Color, LightColor};
pub use super::number::{
    CreaseAngle, FieldOfView, Finite, Fraction, HandDrawn, HatchSpacing, InvalidNumber, LabelSize,
    NonNegative, Percent, PointSize, Positive, Scale, Softness, Triple,
};
use super::schema::{scene_enum, scene_struct};
use model::{Colormap, LengthUnit, UpAxis};

scene_struct! {
    /// A scene file. It consists of the name of this struct and its fields in parentheses:
    /// `Scene(models: [(path: "model.glb")], style: Shaded)`.
    pub struct SceneFile as "Scene" {
        /// Other scene files to include, in this order. Their models, lights, overlays, sections
        /// and viewports come before this file's own. Every other field set in this file replaces
        /// theirs, and later files replace the fields of earlier ones. Paths in an included file
        /// are relative to its folder, which must be inside the scene's folder. Default: none.
        pub include: Paths = Paths(Vec::new()),
        /// The models to draw. A scene needs at least one; an included file does not. Default:
        /// none.
        pub models: Vec<ModelFile> = Vec::new(),
        /// The camera and its projection. Default: framed from a named direction, in perspective.
        pub camera: CameraFile = CameraFile::default(),
        /// The motion of the camera, for `alberti animate`. Pictures without `--time` ignore it,
        /// and so do default lights. Default: the camera does not move.
        pub camera_path: Option<CameraPathFile> = None,
        /// Separate views in parts of the picture, drawn in this order. Default: none.
        pub viewports: Vec<ViewportFile> = Vec::new(),
        /// The scale of the viewports. Default: `Individual`.
        pub viewports_scale: ViewportsScale = ViewportsScale::Individual,
        /// A stereo pair. Default: one picture.
        pub stereo: Option<StereoFile> = None,
        /// The lights. Default: the models' lights. If the models have none, a scene without an
        /// environment gets ambient light and a key light from above the viewer's left shoulder. A
        /// scene with an environment gets only the key light, and only if there are shadows.
        pub lights: Option<Vec<LightFile>> = None,
        /// A factor for the intensity of all lights: the scene's, the models' and the key light. An
        /// environment has a separate `strength`. Default: 1.
        pub light_intensity: NonNegative = NonNegative::ONE,
        /// The shadows of all directional, point and spot lights that do not set their own,
        /// including the models' lights. Default: `Off`.
        pub shadows: Option<ShadowsFile> = None,
        /// The ground below the models. Default: none.
        pub ground: Option<GroundFile> = None,
        /// Light from all directions. Default: none; a model without a scene file and without
        /// lights is lit by `Studio(strength: 0.45)` and a key light.
        pub environment: Option<EnvironmentFile> = None,
        /// Screen-space ambient occlusion. Default: none.
        pub ambient_occlusion: Option<AmbientOcclusionFile> = None,
        /// The style, which defines how surfaces are drawn. Default: `Shaded`.
        pub style: StyleFile = StyleFile::Shaded,
        /// The colormap of the style `Depth`. Its last color is for the nearest vertex of the
        /// models, and its first for the farthest. Default: grays, brighter toward the viewer.
        pub depth_colormap: Option<Colormap> = None,
        /// The image: its size, background and sampling. Default: 960 × 720 pixels, transparent.
        pub image: ImageFile = ImageFile::default(),
        /// Annotations drawn over the picture. Default: none.
        pub overlays: Vec<OverlayFile> = Vec::new(),
        /// A line of text below the view, centered in a strip of 28 pixels along the bottom of the
        /// picture; the view fills the rest. The text is drawn with strokes, as on drawings, and
        /// shrinks if it is too long. The strip has the background color, or the center color of a
        /// gradient. Default: none.
        pub caption: Option<String> = None,
        /// Passes: data for each pixel in addition to its color. Default: none.
        pub passes: PassesFile = PassesFile::default(),
        /// Up to 16 section planes that cut the models open, one after another, in line drawings
        /// and on sheets. Default: none.
        pub sections: Vec<SectionFile> = Vec::new(),
        /// The layout for `alberti sheet`. Default: from its flags.
        pub sheet: Option<SheetFile> = None,
    }
}

scene_struct! {
    /// A model and its transform: scale, then rotation, then translation.
    pub struct ModelFile as "Model" {
        /// The path of a `.gltf`, `.glb`, `.stl`, `.obj`, `.ply` or `.3mf` file, relative to the
        /// scene file's folder.
        pub path: String,
        /// The translation, in the file's unit: meters in glTF. Default: (0, 0, 0).
        pub translation: Triple = Triple::ZERO,
        /// Rotations about the x, then the y, then the z axis, in degrees. Default: (0, 0, 0).
        pub rotation_degrees: Triple = Triple::ZERO,
        /// One scale factor for all axes, or one for each; none may be 0. Default: 1.
        pub scale: Scale = Scale::ONE,
        /// The axis that points up in the file; the model is rotated so that it becomes y. Default:
        /// z for STL and 3MF, y for all others.
        pub up: Option<UpAxis>,
        /// The unit of the file, for sheets. Default: the unit the file declares, otherwise
        /// millimeters for STL and 3MF and meters for all others.
        pub unit: Option<LengthUnit>,
        /// The largest angle at which adjacent faces are shaded as one smooth surface, in degrees
        /// from 0 to 180. It applies only if the file has no normals. Default: 30.
        pub crease_degrees: Option<Finite>,
        /// The scene in the glTF file. Default: its default scene, otherwise its first.
        pub scene: Option<Choice>,
        /// The variant of the model's materials (KHR_materials_variants). Default: none.
        pub variant: Option<Choice>,
        /// The animation that poses the model. Default: the first if there is a `time`, otherwise
        /// none.
        pub animation: Option<Choice>,
        /// The animation time in seconds. Default: 0, if there is an `animation`.
        pub time: Option<Finite>,
        /// Instances of the model. Default: one.
        pub instances: Option<InstancesFile>,
        /// Colors from a scalar attribute of the vertices. Default: as in the model.
        pub scalars: Option<ScalarsFile>,
        /// Overrides for the model's materials. Default: none.
        pub materials: Vec<MaterialFile> = Vec::new(),
    }
}

scene_enum! {
    /// One of a model's scenes, variants or animations.
    #[derive(Eq, PartialOrd, Ord)]
    pub enum Choice as "Choice" {
        /// By index in the file, from 0.
        Index(usize),
        /// By name.
        Name(String),
    }
}

impl SceneFile {
    /// Returns a scene with one model and all defaults.
    #[must_use]
    pub fn from_model_path(path: String) -> Self {
        Self::new([ModelFile::new(path)])
    }
}
