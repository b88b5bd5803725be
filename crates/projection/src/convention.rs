//! Conventions: the viewing direction of the camera and the extent of clip space.
//!
//! ```text
//!  convention      looks along   NDC y   near at   far at
//!  CHAPTER             −z          up        +1        −1      the textbook, with w > 0 (PE-3)
//!  OPENGL              −z          up        −1        +1      glFrustum, WebGL
//!  VULKAN              −z         down        0         1
//!  DIRECT3D            +z          up         0         1      D3DX…LH
//!  METAL, WEBGPU       −z          up         0         1
//! ```
//!
//! All conventions have w > 0 in front of the eye. A projection is described once, without a
//! convention, and can be written as a matrix in any convention. [`Convention::convert`] converts
//! matrices from other sources.

use crate::ProjectionError;
use glam::DMat4;
use homog::{Clip, ClipRange, NdcY, Projective, View};

/// The direction along the z axis in which the camera looks.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Handedness {
    /// View space is right-handed: x right, y up, looking along −z.
    Right,
    /// View space is left-handed: x right, y up, looking along +z.
    Left,
}

/// The layout of view space and clip space (C30, C100).
///
/// # Guarantees
/// Both depths are in [−1, 1] and at least 10⁻⁶ apart.
///
/// ```
/// use projection::Convention;
/// let z_buffer = Convention::WEBGPU.reversed();
/// assert_eq!((z_buffer.near_depth(), z_buffer.far_depth()), (1.0, 0.0));
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Convention {
    handedness: Handedness,
    range: ClipRange,
}

impl Convention {
    /// The canonical volume of the textbook (Shirley and Marschner, ch. 8) in its w > 0 form
    /// (PE-3): [−1, 1]³ with near at +1 and far at −1.
    pub const CHAPTER: Self = Self::new(Handedness::Right, ClipRange::CHAPTER);
    /// OpenGL and WebGL (GL-1): near at −1, far at +1.
    pub const OPENGL: Self = Self::new(Handedness::Right, ClipRange::OPENGL);
    /// Vulkan: y down, near at 0, far at 1.
    pub const VULKAN: Self = Self::new(Handedness::Right, ClipRange::VULKAN);
    /// Direct3D, as in its helper library (D3D-1): left-handed, near at 0, far at 1.
    pub const DIRECT3D: Self = Self::new(Handedness::Left, ClipRange::ZERO_ONE);
    /// Metal with a right-handed view space: near at 0, far at 1.
    pub const METAL: Self = Self::new(Handedness::Right, ClipRange::ZERO_ONE);
    /// WebGPU with a right-handed view space (D3D-2): near at 0, far at 1.
    pub const WEBGPU: Self = Self::METAL;

    /// Creates a convention from its handedness and clip range.
    #[must_use]
    pub const fn new(handedness: Handedness, range: ClipRange) -> Self {
        Self { handedness, range }
    }

    /// Returns the extent of clip space, for the viewport and the clip volume.
    #[must_use]
    pub const fn range(self) -> ClipRange {
        self.range
    }

    /// Returns this convention with the near and far depths swapped (reversed z).
    #[must_use]
    pub const fn reversed(self) -> Self {
        Self { range: self.range.reversed(), ..self }
    }

    /// Returns this convention for a view space that looks along −z.
    #[must_use]
    pub const fn right_handed(self) -> Self {
        self.with_handedness(Handedness::Right)
    }

    /// Returns this convention for a view space that looks along +z.
    #[must_use]
    pub const fn left_handed(self) -> Self {
        self.with_handedness(Handedness::Left)
    }

    /// Returns this convention with the given handedness of view space.
    #[must_use]
    pub const fn with_handedness(self, handedness: Handedness) -> Self {
        Self { handedness, ..self }
    }

    /// Returns this convention with the given direction of y after the divide.
    #[must_use]
    pub const fn with_ndc_y(self, ndc_y: NdcY) -> Self {
        Self { range: self.range.with_y(ndc_y), ..self }
    }

    /// Returns this convention with different depths for the near and far planes.
    ///
    /// # Errors
    /// Returns an error unless both depths are in [−1, 1] and at least 10⁻⁶ apart.
    pub fn with_depths(self, near_depth: f64, far_depth: f64) -> Result<Self, ProjectionError> {
        Ok(Self { range: self.range.with_depths(near_depth, far_depth)?, ..self })
    }

    /// Returns the handedness of view space.
    #[must_use]
    pub const fn handedness(self) -> Handedness {
        self.handedness
    }

    /// Returns the direction of y after the divide.
    #[must_use]
    pub const fn ndc_y(self) -> NdcY {
        self.range.y()
    }

    /// Returns the depth of the near plane after the divide.
    #[must_use]
    pub const fn near_depth(self) -> f64 {
        self.range.near_depth()
    }

    /// Returns the depth of the far plane after the divide.
    #[must_use]
    pub const fn far_depth(self) -> f64 {
        self.range.far_depth()
    }

    /// Returns the z of a view-space point at distance 1 in front of the eye: −1 or +1.
    #[must_use]
    pub const fn ahead(self) -> f64 {
        match self.handedness {
            Handedness::Right => -1.0,
            Handedness::Left => 1.0,
        }
    }

    /// Returns the y coordinate of the window's top edge after the divide: +1 or −1.
    #[must_use]
    pub const fn top(self) -> f64 {
        self.range.top()
    }

    /// Converts a projection matrix from this convention to `to`.
    ///
    /// Flips of y and z are exact. The depth is remapped linearly, which is exact between the
    /// conventions of this module. View space gets the handedness of `to`; if it differs, the z
    /// axis of the scene is flipped.
    ///
    /// ```
    /// use projection::{Convention, Fov, Perspective};
    /// let lens = Perspective::new(Fov::Vertical(0.7), 1.5, 0.1, 100.0)?;
    /// let (from, to) = (Convention::OPENGL, Convention::CHAPTER);
    /// assert_eq!(from.convert(to, lens.view_to_clip(from)), lens.view_to_clip(to));
    /// # Ok::<(), projection::ProjectionError>(())
    /// ```
    #[must_use]
    pub fn convert(self, to: Self, view_to_clip: Projective<View, Clip>) -> Projective<View, Clip> {
        let mut rows = view_to_clip.raw().transpose();
        if self.ndc_y() != to.ndc_y() {
            rows.y_axis = -rows.y_axis;
        }
        let (factor, offset) = self.depth_remap(to);
        rows.z_axis = rows.z_axis * factor + rows.w_axis * offset;
        let mut columns = rows.transpose();
        if self.handedness != to.handedness {
            columns.z_axis = -columns.z_axis;
        }
        Projective::from_raw(columns)
    }

    /// Returns the map from this convention's clip space to the clip space of `to`. It changes only
    /// y and depth, because view space stays the same.
    #[must_use]
    pub fn clip_to_clip(self, to: Self) -> Projective<Clip, Clip> {
        let (factor, offset) = self.depth_remap(to);
        let mut map = DMat4::IDENTITY;
        map.y_axis.y = self.top() * to.top();
        map.z_axis.z = factor;
        map.w_axis.z = offset;
        Projective::from_raw(map)
    }

    /// Returns the factor and offset of the linear map between the depths of two conventions.
    fn depth_remap(self, to: Self) -> (f64, f64) {
        let length = self.far_depth() - self.near_depth();
        let factor = (to.far_depth() - to.near_depth()) / length;
        let offset =
            (to.near_depth() * self.far_depth() - to.far_depth() * self.near_depth()) / length;
        (factor, offset)
    }
}

/// Extracts the part that the viewport and the clip volume need.
impl From<Convention> for ClipRange {
    fn from(convention: Convention) -> Self {
        convention.range
    }
}
