//! Conventions of graphics APIs: canonical view volume, handedness of view space, pixel
//! coordinates. The picture does not depend on them, the numbers of an explanation do.
//!
//! | conventions | NDC z, near to far | y in clip space | view space |
//! | --- | --- | --- | --- |
//! | alberti, chapter | +1 to −1 | up | looks along −z |
//! | OpenGL | −1 to +1 | up | looks along −z |
//! | Vulkan | 0 to 1 | down | looks along −z |
//! | Direct3D | 0 to 1 | up | looks along +z |
//! | WebGPU, Metal | 0 to 1 | up | looks along −z |

use homog::{Affine, PixelConvention, View};
use projection::{Convention, Handedness, NdcY};
use std::str::FromStr;
use viewport::{DepthRange, Rectangle, Viewport, ViewportError};

/// The conventions of a textbook or of a graphics API.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum ApiConventions {
    /// The program's own: the chapter's volume, near at z = +1; pixels as in image files, depth 1
    /// at the near plane.
    #[default]
    Alberti,
    /// Shirley and others, chapters 7 and 8: near at z = +1, integer pixel centers, y up, z
    /// unchanged.
    Chapter,
    /// OpenGL: near at z = −1, y up, depth 0 at the near plane.
    OpenGl,
    /// Vulkan: near at z = 0, y down in clip space.
    Vulkan,
    /// Direct3D: near at z = 0, view space looks along +z.
    Direct3d,
    /// Metal and WebGPU: near at z = 0, y up.
    WebGpu,
}

impl ApiConventions {
    /// All conventions.
    pub const ALL: [Self; 6] =
        [Self::Alberti, Self::Chapter, Self::OpenGl, Self::Vulkan, Self::Direct3d, Self::WebGpu];

    /// The name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Alberti => "alberti",
            Self::Chapter => "chapter",
            Self::OpenGl => "opengl",
            Self::Vulkan => "vulkan",
            Self::Direct3d => "direct3d",
            Self::WebGpu => "webgpu",
        }
    }

    /// The canonical view volume.
    #[must_use]
    pub const fn canonical_volume(self) -> Convention {
        match self {
            Self::Alberti | Self::Chapter => Convention::CHAPTER,
            Self::OpenGl => Convention::OPENGL,
            Self::Vulkan => Convention::VULKAN,
            Self::Direct3d => Convention::DIRECT3D,
            Self::WebGpu => Convention::WEBGPU,
        }
    }

    /// The change of view space from −z to the direction of gaze of the conventions.
    pub(super) fn view_flip(self) -> Affine<View, View> {
        Affine::scale(1.0, 1.0, if self.looks_along_z() { -1.0 } else { 1.0 })
    }

    /// Whether view space looks along +z (left-handed).
    pub(super) fn looks_along_z(self) -> bool {
        self.canonical_volume().handedness() == Handedness::Left
    }

    /// Whether y runs down in clip space.
    pub(super) fn y_runs_down(self) -> bool {
        self.canonical_volume().ndc_y() == NdcY::Down
    }

    /// The viewport that covers an image.
    pub(super) fn viewport(self, width: u32, height: u32) -> Result<Viewport, ViewportError> {
        let (pixels, depth) = match self {
            Self::Alberti => (PixelConvention::IMAGE, DepthRange::ZERO_ONE),
            Self::Chapter => return Viewport::chapter(width, height),
            Self::OpenGl => (PixelConvention::OPENGL, DepthRange::ZERO_ONE),
            // In Vulkan y runs down already in clip space: nothing is left to flip.
            Self::Vulkan => (PixelConvention::OPENGL, DepthRange::KEEP),
            Self::Direct3d | Self::WebGpu => (PixelConvention::IMAGE, DepthRange::KEEP),
        };
        let area = Rectangle::from_size(width.into(), height.into())?;
        Ok(Viewport::new(area, pixels, depth))
    }
}

impl FromStr for ApiConventions {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        let known = Self::ALL.into_iter().find(|conventions| conventions.name() == name);
        known.ok_or_else(|| format!("there are no conventions `{name}`"))
    }
}

/// The common name of a canonical volume.
pub(super) fn volume_name(volume: Convention) -> &'static str {
    const NAMES: [(Convention, &str); 9] = [
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
    ];
    NAMES.iter().find(|(named, _)| *named == volume).map_or("another convention", |(_, name)| name)
}
