//! Conventions of graphics APIs: canonical view volume, handedness of view space, and pixel
//! coordinates. They do not change the picture, but they change the numbers in an explanation.
//!
//! | conventions | NDC z, near to far | y in clip space | view space |
//! | --- | --- | --- | --- |
//! | alberti, chapter, chapter-y-down | +1 to −1 | up | looks along −z |
//! | OpenGL | −1 to +1 | up | looks along −z |
//! | Vulkan | 0 to 1 | down | looks along −z |
//! | Direct3D | 0 to 1 | up | looks along +z |
//! | WebGPU, Metal | 0 to 1 | up | looks along −z |
//!
//! A conversion between two rows is one matrix C after the projection, M' = C · M_proj. It scales
//! and offsets z (for example z' = (w − z)/2 from +1 … −1 to 0 … 1) and sets the sign of y. The
//! frustum in the world and the pixel under a point stay the same; matrices, outcodes and depth
//! values change.

use homog::NdcY;
use homog::{Affine, PixelConvention, View};
use projection::{Convention, Handedness};
use std::str::FromStr;
use viewport::{DepthRange, Rectangle, Viewport, ViewportError};

/// The conventions of a textbook or of a graphics API.
///
/// Each value fixes four choices: the canonical volume, the handedness of view space, the pixel
/// convention of the viewport and its depth range.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum ApiConventions {
    /// The program's default: the chapter's volume with near at z = +1, pixels as in image files,
    /// and depth 1 at the near plane.
    #[default]
    Alberti,
    /// Shirley and others, chapters 7 and 8: near at z = +1, integer pixel centers, y up, z
    /// unchanged.
    ///
    /// The viewport matrix is M_vp of the chapter, with x from −1/2 to width − 1/2.
    Chapter,
    /// The chapter's conventions, with pixel rows counted from the top (VP-2, exercise 1).
    ChapterYDown,
    /// OpenGL: near at z = −1, y up, depth 0 at the near plane.
    OpenGl,
    /// Vulkan: near at z = 0, y down in clip space.
    ///
    /// Framebuffer rows count from the top, as in image files, because the two flips of y cancel.
    Vulkan,
    /// Direct3D: near at z = 0, view space looks along +z.
    Direct3d,
    /// Metal and WebGPU: near at z = 0, y up.
    WebGpu,
}

impl ApiConventions {
    /// All conventions.
    pub const ALL: [Self; 7] = [
        Self::Alberti,
        Self::Chapter,
        Self::ChapterYDown,
        Self::OpenGl,
        Self::Vulkan,
        Self::Direct3d,
        Self::WebGpu,
    ];

    /// Returns the name on the command line.
    ///
    /// Names are in lower case, without spaces; `FromStr` accepts exactly these names.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Alberti => "alberti",
            Self::Chapter => "chapter",
            Self::ChapterYDown => "chapter-y-down",
            Self::OpenGl => "opengl",
            Self::Vulkan => "vulkan",
            Self::Direct3d => "direct3d",
            Self::WebGpu => "webgpu",
        }
    }

    /// Describes the depth range, direction of y, handedness and pixel centers in one line.
    #[must_use]
    pub const fn summary(self) -> &'static str {
        match self {
            Self::Alberti => {
                "near at z = 1, far at -1; y up; looks along -z (right-handed); pixel rows from the \
                 top, centers at half-integers, depth 1 to 0"
            }
            Self::Chapter => {
                "the textbook: near at z = 1, far at -1; y up; looks along -z (right-handed); pixel \
                 rows from the bottom, centers at integers"
            }
            Self::ChapterYDown => {
                "the textbook, but with pixel rows from the top (exercise 1); centers at integers"
            }
            Self::OpenGl => {
                "near at z = -1, far at 1; y up; looks along -z (right-handed); pixel rows from the \
                 bottom, centers at half-integers, depth 0 to 1"
            }
            Self::Vulkan => {
                "near at z = 0, far at 1; y down; looks along -z (right-handed); pixel rows from the \
                 top, centers at half-integers"
            }
            Self::Direct3d => {
                "near at z = 0, far at 1; y up; looks along +z (left-handed); pixel rows from the \
                 top, centers at half-integers"
            }
            Self::WebGpu => {
                "also Metal: near at z = 0, far at 1; y up; looks along -z (right-handed); pixel \
                 rows from the top, centers at half-integers"
            }
        }
    }

    /// Returns the canonical view volume.
    ///
    /// It holds the NDC range of z, the direction of y and the handedness of view space. None of
    /// these conventions is reversed-z in the sense of Vulkan or Direct3D; the chapter's near plane
    /// at +1 gives the same depth order.
    #[must_use]
    pub const fn canonical_volume(self) -> Convention {
        match self {
            Self::Alberti | Self::Chapter | Self::ChapterYDown => Convention::CHAPTER,
            Self::OpenGl => Convention::OPENGL,
            Self::Vulkan => Convention::VULKAN,
            Self::Direct3d => Convention::DIRECT3D,
            Self::WebGpu => Convention::WEBGPU,
        }
    }

    /// Returns the map from a view space that looks along −z to the view space of the conventions:
    /// diag(1, 1, ±1).
    ///
    /// The map is its own inverse. With −1, it swaps right-handed and left-handed coordinates.
    pub(super) fn view_flip(self) -> Affine<View, View> {
        Affine::scale(1.0, 1.0, if self.looks_along_z() { -1.0 } else { 1.0 })
    }

    /// Whether view space looks along +z (left-handed).
    pub(super) fn looks_along_z(self) -> bool {
        self.canonical_volume().handedness() == Handedness::Left
    }

    /// Whether matrices are shown as the textbook prints them: P, M_orth, M_per.
    pub(super) fn is_textbook(self) -> bool {
        matches!(self, Self::Chapter | Self::ChapterYDown)
    }

    /// Whether y points down in clip space.
    pub(super) fn y_runs_down(self) -> bool {
        self.canonical_volume().ndc_y() == NdcY::Down
    }

    /// Returns the positions of pixel centers and the direction of rows.
    #[must_use]
    pub const fn pixel_convention(self) -> PixelConvention {
        match self {
            Self::Chapter => PixelConvention::CHAPTER,
            Self::ChapterYDown => PixelConvention::CHAPTER_Y_DOWN,
            Self::OpenGl => PixelConvention::OPENGL,
            Self::Alberti | Self::Vulkan | Self::Direct3d | Self::WebGpu => PixelConvention::IMAGE,
        }
    }

    /// Returns the map from NDC z to the depth of a pixel.
    ///
    /// OpenGL maps −1 … +1 to 0 … 1, as `glDepthRange(0, 1)` does, and so does Alberti. The others,
    /// with NDC z in 0 … 1 or as in the chapter, leave z unchanged.
    #[must_use]
    pub const fn depth_range(self) -> DepthRange {
        match self {
            Self::Alberti | Self::OpenGl => DepthRange::ZERO_ONE,
            Self::Chapter | Self::ChapterYDown | Self::Vulkan | Self::Direct3d | Self::WebGpu => {
                DepthRange::KEEP
            }
        }
    }

    /// Returns the formula ids for the viewport and its depth.
    #[must_use]
    pub const fn viewport_formulas(self) -> &'static str {
        match self {
            Self::Chapter => "VP-1",
            Self::ChapterYDown => "VP-2",
            Self::Alberti | Self::OpenGl => "VP-3, DP-1",
            Self::Vulkan | Self::Direct3d | Self::WebGpu => "VP-3",
        }
    }

    /// Returns the viewport that covers a whole image.
    ///
    /// # Errors
    /// Returns an error if the width or height is 0.
    pub(super) fn image(self, width: u32, height: u32) -> Result<Viewport, ViewportError> {
        Ok(self.viewport(Rectangle::from_size(width.into(), height.into())?))
    }

    /// Returns the viewport for a rectangle of the image.
    #[must_use]
    pub const fn viewport(self, area: Rectangle) -> Viewport {
        let range = self.canonical_volume().range();
        Viewport::new(area, self.pixel_convention(), range, self.depth_range())
    }
}

impl FromStr for ApiConventions {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        let known = Self::ALL.into_iter().find(|conventions| conventions.name() == name);
        known.ok_or_else(|| format!("unknown conventions `{name}`"))
    }
}

/// Returns the common name of a canonical volume.
///
/// Looks up the volume in a table of common volumes, plain and reversed. A custom convention has no
/// entry and is called `another convention`.
pub(super) fn volume_name(volume: Convention) -> &'static str {
    const OPENCV: Convention = Convention::OPENGL.left_handed().with_ndc_y(NdcY::Down);
    const NAMES: [(Convention, &str); 16] = [
        (Convention::OPENGL, "OpenGL (near −1, far +1)"),
        (Convention::CHAPTER, "the textbook (near +1, far −1)"),
        (Convention::WEBGPU, "Metal and WebGPU (near 0, far 1)"),
        (Convention::WEBGPU.reversed(), "Metal and WebGPU with reversed depth (near 1, far 0)"),
        (Convention::VULKAN, "Vulkan (near 0, far 1, y down)"),
        (Convention::VULKAN.reversed(), "Vulkan with reversed depth (near 1, far 0, y down)"),
        (Convention::DIRECT3D, "Direct3D (near 0, far 1, looks along +z)"),
        (
            Convention::DIRECT3D.reversed(),
            "Direct3D with reversed depth (near 1, far 0, looks along +z)",
        ),
        (Convention::OPENGL.left_handed(), "OpenGL's volume seen along +z"),
        (OPENCV, "an OpenCV or COLMAP camera in OpenGL's volume (x right, y down, looks along +z)"),
        (
            Convention::DIRECT3D.with_ndc_y(NdcY::Down),
            "depth from 0 to 1 with y down and looking along +z, as in OpenCV or COLMAP",
        ),
        (Convention::OPENGL.with_ndc_y(NdcY::Down), "OpenGL's volume with y down"),
        (
            Convention::DIRECT3D.reversed().with_ndc_y(NdcY::Down),
            "depth from 1 to 0 with y down and looking along +z",
        ),
        (Convention::CHAPTER.with_ndc_y(NdcY::Down), "the textbook's volume with y down"),
        (Convention::CHAPTER.left_handed(), "the textbook's volume seen along +z"),
        (
            Convention::CHAPTER.left_handed().with_ndc_y(NdcY::Down),
            "the textbook's volume with y down seen along +z",
        ),
    ];
    NAMES.iter().find(|(named, _)| *named == volume).map_or("another convention", |(_, name)| name)
}
