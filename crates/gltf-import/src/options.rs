//! Options for loading files.

use crate::{Limits, NameOrIndex, ScalarColors};
use model::{LengthUnit, Timings, UpAxis};
use std::path::{Path, PathBuf};

/// A function that returns a model by name, in a binary glTF file.
pub type LessonModel = fn(&str) -> Option<Vec<u8>>;

/// Options for loading a file.
#[derive(Clone, Debug, Default)]
pub struct ImportOptions {
    /// The maximum sizes that are accepted.
    pub limits: Limits,
    /// The folder to which referenced files are confined. Default: the folder of the file itself.
    pub root: Option<PathBuf>,
    /// Additional folders that may contain referenced files; `..` and symbolic links may lead
    /// there. Default: none.
    pub allow_outside: Vec<PathBuf>,
    /// Whether to skip broken, missing or unknown data with a warning instead of failing, as long
    /// as something remains to load. Limits still apply. Default: no.
    pub lenient: bool,
    /// The active scene. Default: the file's default scene, or else its first.
    pub scene: Option<NameOrIndex>,
    /// The active material variant (KHR_materials_variants). Default: none.
    pub variant: Option<NameOrIndex>,
    /// Vertex colors from a scalar attribute. Default: the colors and materials in the file.
    pub scalars: Option<ScalarColors>,
    /// Which images to read and decode. Default: visible images.
    pub images: ImageLoading,
    /// The axis that points up in the file. Default: z for STL and 3MF, y for other formats.
    pub up: Option<UpAxis>,
    /// The unit of the file's coordinates. Default: the unit declared in the file, or else the
    /// convention of its format; see [`LengthUnit`].
    pub length_unit: Option<LengthUnit>,
    /// The largest angle between the normals of two faces that are shaded as one smooth surface, in
    /// degrees, for files without normals. Default: 30.
    pub crease_angle: Option<f64>,
    /// Models that the program contains: `lesson:house` in place of a path loads the file that this
    /// function returns for `house`. Default: none.
    pub lesson_model: Option<LessonModel>,
    /// Timings for the loading stages. Default: none.
    pub timings: Timings,
}

/// Which images of a file are read and decoded.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum ImageLoading {
    /// Images that visible surfaces use are decoded; no other images are read.
    #[default]
    Decode,
    /// No image is decoded, but all image headers are read.
    Headers,
}

/// The crease angle in degrees if the options do not specify one.
const DEFAULT_CREASE_ANGLE: f64 = 30.0;

impl ImportOptions {
    /// Returns the content of a lesson model, such as `lesson:house`; `None` if the path has
    /// another form or there is no such model.
    #[must_use]
    pub fn lesson_model_at(&self, path: &Path) -> Option<Vec<u8>> {
        let name = path.file_name()?.to_str()?.strip_prefix("lesson:")?;
        self.lesson_model?(name)
    }

    /// Returns the crease angle in degrees, in [0, 180].
    #[must_use]
    pub fn crease_degrees(&self) -> f64 {
        let angle = self.crease_angle.filter(|angle| angle.is_finite());
        angle.unwrap_or(DEFAULT_CREASE_ANGLE).clamp(0.0, 180.0)
    }
}
