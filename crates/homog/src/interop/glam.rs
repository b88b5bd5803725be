//! Conversions to and from the types of the glam version that this crate uses.
//!
//! `from_raw` and `raw` cost nothing, because a point is stored as a `DVec3`. For another version
//! of glam, convert through arrays or `mint`.

use crate::{
    Affine, HLine2, HPoint, HPoint2, Homography, Normal, Plane, Point, Projective, Space, Vector,
};
use glam::{DAffine3, DMat3, DMat4, DVec3, DVec4, Mat4, Vec3};

macro_rules! raw_coordinates {
    ($name:ident, $raw:ty, $what:literal) => {
        impl<S: Space> $name<S> {
            #[doc = concat!("Tags ", $what, " with a space, which the caller chooses.")]
            #[must_use]
            pub const fn from_raw(raw: $raw) -> Self {
                Self::tagged(raw)
            }

            #[doc = concat!("Returns the ", $what, ", without their space.")]
            #[must_use]
            pub const fn raw(self) -> $raw {
                self.raw
            }
        }

        impl<S: Space> From<$raw> for $name<S> {
            fn from(raw: $raw) -> Self {
                Self::tagged(raw)
            }
        }

        impl<S: Space> From<$name<S>> for $raw {
            fn from(value: $name<S>) -> Self {
                value.raw
            }
        }
    };
}
raw_coordinates!(Point, DVec3, "plain coordinates");
raw_coordinates!(Vector, DVec3, "plain coordinates");
raw_coordinates!(Normal, DVec3, "plain coordinates");
raw_coordinates!(HPoint, DVec4, "four plain coordinates");
raw_coordinates!(Plane, DVec4, "four plain coefficients (a, b, c, d)");

impl<S: Space> From<Vec3> for Point<S> {
    fn from(raw: Vec3) -> Self {
        Self::tagged(raw.as_dvec3())
    }
}

impl<S: Space> From<Vec3> for Vector<S> {
    fn from(raw: Vec3) -> Self {
        Self::tagged(raw.as_dvec3())
    }
}

impl<A: Space, B: Space> Projective<A, B> {
    /// Tags a matrix with its two spaces, which the caller chooses.
    #[must_use]
    pub const fn from_raw(raw: DMat4) -> Self {
        Self::tagged(raw)
    }

    /// Returns the matrix, without its spaces.
    #[must_use]
    pub const fn raw(self) -> DMat4 {
        self.raw
    }
}

impl<A: Space, B: Space> From<DMat4> for Projective<A, B> {
    fn from(raw: DMat4) -> Self {
        Self::tagged(raw)
    }
}

impl<A: Space, B: Space> From<Mat4> for Projective<A, B> {
    fn from(raw: Mat4) -> Self {
        Self::tagged(raw.as_dmat4())
    }
}

impl<A: Space, B: Space> From<Projective<A, B>> for DMat4 {
    fn from(map: Projective<A, B>) -> Self {
        map.raw
    }
}

impl<A: Space, B: Space> Affine<A, B> {
    /// Tags a matrix with its two spaces, or returns `None` if its bottom row is not exactly
    /// (0, 0, 0, 1).
    #[must_use]
    pub fn from_raw(raw: DMat4) -> Option<Self> {
        Self::from_matrix(raw)
    }

    /// Returns the matrix, without its spaces. Its bottom row is (0, 0, 0, 1).
    #[must_use]
    pub const fn raw(self) -> DMat4 {
        self.raw
    }
}

impl<A: Space, B: Space> From<DAffine3> for Affine<A, B> {
    fn from(map: DAffine3) -> Self {
        Self::tagged(DMat4::from_mat3_translation(map.matrix3, map.translation))
    }
}

impl<A: Space, B: Space> From<Affine<A, B>> for DMat4 {
    fn from(map: Affine<A, B>) -> Self {
        map.raw
    }
}

macro_rules! raw_plane {
    ($name:ident, $raw:ty, $from:literal, $to:literal) => {
        impl $name {
            #[doc = $from]
            #[must_use]
            pub const fn from_raw(raw: $raw) -> Self {
                Self::tagged(raw)
            }

            #[doc = $to]
            #[must_use]
            pub const fn raw(self) -> $raw {
                self.raw
            }
        }
    };
}
raw_plane!(HPoint2, DVec3, "Creates a point from (x, y, h).", "Returns (x, y, h).");
raw_plane!(HLine2, DVec3, "Creates a line from (a, b, c).", "Returns (a, b, c).");
raw_plane!(Homography, DMat3, "Creates a map from its matrix.", "Returns the matrix.");
