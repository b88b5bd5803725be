//! Options with named values. Scene files, flags, help and the reference share one declaration.
//!
//! The renderer and the line drawings use the same types. Scene files use the variants' names
//! (`ThreeQuarter`); flags use lowercase with hyphens (`three-quarter`).

use super::schema::named_values;
use crate::pass::{Pass, PassEncoding};
use camera::{CameraAxes, NamedView};
use drawing::{EdgeSelection, FaceFill, HiddenLines};
use hidden_line::SilhouetteMethod;
use model::{Colormap, LengthUnit, UpAxis};
use page::{Cap, Join};
use projection::homog::PixelCenters;
use projection::{PrincipalView, SheetAngle};
use shade::{ImageFit, ToneMapping};
use sheet::{DecimalMark, DimensionUnit, ExplosionAxis, SheetFrame, TitleBlockLanguage};

/// A type whose values have names.
///
/// ```
/// use scene_file::options::NamedOption as _;
///
/// assert_eq!(shade::ToneMapping::AgX.name(), "AgX");
/// assert_eq!(shade::ToneMapping::AgX.flag_name(), "ag-x");
/// assert_eq!(drawing::HiddenLines::from_name("Dashed"), Some(drawing::HiddenLines::Dashed));
/// ```
pub trait NamedOption: Copy + PartialEq + 'static {
    /// The name of the type in scene files and in the reference.
    const TYPE_NAME: &'static str;

    /// All values, in the order in which they are listed.
    const ALL: &'static [Self];

    /// Returns the name in scene files.
    fn name(self) -> &'static str;

    /// Returns a sentence that explains the value.
    fn summary(self) -> &'static str;

    /// Returns the name in flags: lowercase, with hyphens between words.
    fn flag_name(self) -> String {
        let mut text = String::new();
        for c in self.name().chars() {
            if c.is_uppercase() && !text.is_empty() {
                text.push('-');
            }
            text.extend(c.to_lowercase());
        }
        text
    }

    /// Returns the value with this name in scene files.
    fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|value| value.name() == name)
    }

    /// Returns the value with this name in flags.
    fn from_flag_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|value| value.flag_name() == name)
    }
}

named_values! {
    /// The unit of a model's coordinates.
    LengthUnit as "Unit" {
        Meter = "1 m.",
        Centimeter = "10 mm.",
        Millimeter = "1 mm.",
        Micrometer = "0.001 mm.",
        Inch = "25.4 mm.",
        Foot = "304.8 mm.",
    }
}

named_values! {
    /// The axis that points up in a model's file.
    UpAxis as "UpAxis" {
        X = "x is up, y to the left and z to the front, as in COLLADA.",
        Y = "y is up, x to the right and z to the front: glTF, OBJ and PLY.",
        Z = "z is up, x to the right and y to the back: STL and 3MF, Blender and CAD programs.",
    }
}

named_values! {
    /// A colormap, which turns numbers into colors.
    Colormap as "Colormap" {
        Viridis = "From dark violet through green to yellow, perceptually uniform.",
        Turbo = "A rainbow from dark blue through green to dark red.",
        Inferno = "From black through red to light yellow, perceptually uniform.",
        Grayscale = "From black to white.",
        CoolWarm = "From blue through light gray to red, for values on both sides of a center.",
    }
}

named_values! {
    /// The pixel coordinates of the center of the upper left pixel.
    PixelCenters as "PixelCenters" {
        Integer = "(0, 0): OpenCV and most of computer vision. The center of 640 columns is 319.5.",
        Half = "(0.5, 0.5): OpenGL and COLMAP. The center of 640 columns is 320.",
    }
}

named_values! {
    /// The directions of a camera's axes.
    CameraAxes as "CameraAxes" {
        OpenCv = "x to the right, y down, z forward: OpenCV, COLMAP, ROS.",
        OpenGl = "x to the right, y up, z backward: OpenGL, Blender, glTF, NeRF.",
        Pytorch3d = "x to the left, y up, z forward: PyTorch3D.",
    }
}

named_values! {
    /// The edges that a line drawing shows.
    EdgeSelection as "EdgeSelection" {
        Facets = "The edges of all triangles.",
        Features = "Silhouettes, boundaries, creases, intersections of surfaces, and edges between materials.",
        Tangents = "Features; with ISO 128 line widths, edges between materials are narrow.",
        Contours = "Silhouettes and boundaries, including those in front of other surfaces.",
        Silhouette = "Only the outline against the background.",
        Outline = "Closed loops around the whole shape and its holes, for example for cutting; with `sections`, around the cuts.",
    }
}

named_values! {
    /// The treatment of hidden lines.
    HiddenLines as "HiddenLines" {
        Removed = "Hidden lines are omitted.",
        Dashed = "Hidden lines are dashed.",
        FirstLayer = "Hidden lines are dashed behind one wall (two faces) and omitted behind more; for assemblies.",
        Drawn = "Hidden lines are drawn like visible ones.",
    }
}

named_values! {
    /// The method for finding silhouettes of smooth surfaces.
    SilhouetteMethod as "Silhouettes" {
        Facets = "Triangle edges: exact for the mesh, but zigzag where it represents a curved surface.",
        Interpolated = "Across the triangles, where the interpolated normal is perpendicular to the line of sight: smooth but approximate, with possible gaps at cusps.",
    }
}

named_values! {
    /// The fill of the faces under the lines.
    FaceFill as "FaceFill" {
        None = "No fill: the paper shows through.",
        Flat = "Each face in one tone of its color, lit from above the viewer's left shoulder, as a 300 dpi image under the lines.",
        Hatching = "Hatch lines, closer together where the light of `Flat` leaves the face darker. They are as exact as the edges.",
        ShadeHatching = "Hatch lines that depend only on the light, not on the colors of the materials.",
        Gray = "Each face in a gray as bright as its base color, regardless of the light. Cuts stay blank.",
        PartHatching = "Hatch lines per object: neighbors differ in angle or spacing. With sections, only the cuts are hatched.",
    }
}

named_values! {
    /// The direction in which the parts of an exploded view move.
    ExplosionAxis as "ExplosionAxis" {
        Auto = "Along the axis on which the most parts line up with the largest part; in a tie, the axis on which they move the least.",
        X = "To the left and to the right.",
        Y = "Up and down.",
        Z = "To the front and to the back.",
        All = "Each part moves away from the largest part, along the axis on which the two are farthest apart.",
    }
}

named_values! {
    /// The shape of line ends.
    Cap as "Cap" {
        Butt = "At the end point.",
        Round = "With a half disc around the end point.",
        Square = "Half a line width beyond the end point.",
    }
}

named_values! {
    /// The shape of line joins.
    Join as "Join" {
        Miter = "The outer edges meet in a point.",
        Round = "With a disc around the corner.",
        Bevel = "The corner is cut off.",
    }
}

named_values! {
    /// The tone mapping curve, which brings light beyond 1 into the range of the picture.
    ToneMapping as "ToneMapping" {
        None = "No curve: light beyond 1 is clipped.",
        Neutral = "Khronos PBR Neutral: colors are unchanged except for highlights.",
        Aces = "ACES filmic, using Hill's fit.",
        AgX = "AgX by Sobotka.",
    }
}

named_values! {
    /// The way a picture is scaled to fit the image.
    ImageFit as "Fit" {
        Stretch = "Stretched to the size of the image.",
        Cover = "The smallest size that covers the whole image; the excess is cropped equally on both sides.",
        Contain = "The largest size that fits into the image, centered.",
    }
}

named_values! {
    /// A pass: data about the nearest surface at the center of each pixel.
    Pass as "Pass" {
        Depth = "The distance from the eye along the view axis, in scene units.",
        Distance = "The distance from the eye, in scene units.",
        Normal = "The unit normal in world space, on the visible side, without normal maps.",
        ViewNormal = "The unit normal in view space: x to the right, y up, z toward the viewer.",
        Position = "The position in world space, in scene units.",
        Uv = "The texture coordinates of `TEXCOORD_0`.",
        Barycentric = "The barycentric coordinates in the triangle, from 0 to 1; they add up to 1.",
        Id = "The index of the point, line or triangle in the scene, from 1; 0 for the background.",
        Model = "The index of the model in the scene, from 1.",
        Object = "The object, an instance of a mesh: counted from 1 through all models.",
        Node = "The node, counted from 1 through all models.",
        Mesh = "The mesh, counted from 1 through all different models.",
        Material = "The material, counted like meshes; 0 for the default material.",
        Overdraw = "The number of fragments that cover the pixel center, including hidden ones.",
        Coverage = "The fraction of the pixel's samples that are covered, from 0 to 1.",
    }
}

named_values! {
    /// The file format of passes.
    PassEncoding as "PassEncoding" {
        Png = "16-bit PNG; the text chunk `Description` explains the codes.",
        Npy = "NumPy arrays: f32, or u32 for whole numbers.",
        Exr = "OpenEXR images: f32, or u32 for whole numbers.",
    }
}

named_values! {
    /// One of the six principal views.
    PrincipalView as "Multiview" {
        Front = "From +z.",
        Back = "From −z.",
        Left = "From −x.",
        Right = "From +x.",
        Top = "From +y.",
        Bottom = "From −y.",
    }
}

named_values! {
    /// A view with a name.
    NamedView as "NamedView" {
        Front = "From +z, which is the front in glTF.",
        Back = "From −z.",
        Left = "From −x.",
        Right = "From +x.",
        Top = "From +y.",
        Bottom = "From −y.",
        Isometric = "From (1, 1, 1): all three axes equally foreshortened.",
        Dimetric = "x and y equally foreshortened, z half as long: 7° and 42° on the page.",
        Trimetric = "A different foreshortening factor on each axis.",
        ThreeQuarter = "From the front, slightly from the right and from above.",
    }
}

named_values! {
    /// The border around the drawing area of a sheet (ISO 5457).
    SheetFrame as "Frame" {
        Plain = "A line with a mark at the middle of each side.",
        Zones = "The plain border with zone letters, zone numbers and trimming marks.",
    }
}

named_values! {
    /// The language of a title block's field names.
    TitleBlockLanguage as "Language" {
        English = "English.",
        German = "German.",
        Chinese = "Simplified Chinese.",
    }
}

named_values! {
    /// The unit in which lengths are written on a sheet.
    DimensionUnit as "DimensionUnit" {
        Millimeter = "Millimeters.",
        Inch = "Decimal inches.",
        FootInch = "Feet and inches, with sixteenths of an inch.",
    }
}

named_values! {
    /// The decimal separator.
    DecimalMark as "DecimalMark" {
        Point = "12.5, as in English.",
        Comma = "12,5, as in most other languages.",
    }
}

named_values! {
    /// The arrangement of views on a sheet (ISO 5456-2).
    SheetAngle as "ProjectionAngle" {
        First = "First angle: the top view is below the front view.",
        Third = "Third angle: the top view is above the front view.",
    }
}
