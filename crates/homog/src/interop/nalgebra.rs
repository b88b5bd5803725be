//! Conversions to and from the types of nalgebra.

use crate::{Affine, HPoint, Point, Projective, Space, Vector};
use glam::DMat4;
use nalgebra::{Isometry3, Matrix4, Perspective3, Point3, Vector3, Vector4};

macro_rules! convert_coordinates {
    ($name:ident, $theirs:ident, $count:literal) => {
        impl<S: Space> From<$theirs<f64>> for $name<S> {
            fn from(theirs: $theirs<f64>) -> Self {
                <[f64; $count]>::from(theirs).into()
            }
        }

        impl<S: Space> From<$name<S>> for $theirs<f64> {
            fn from(ours: $name<S>) -> Self {
                <[f64; $count]>::from(ours).into()
            }
        }
    };
}
convert_coordinates!(Point, Point3, 3);
convert_coordinates!(Vector, Vector3, 3);
convert_coordinates!(HPoint, Vector4, 4);

impl<A: Space, B: Space> From<Matrix4<f64>> for Projective<A, B> {
    fn from(theirs: Matrix4<f64>) -> Self {
        Self::tagged(DMat4::from_cols_array_2d(&theirs.into()))
    }
}

/// `Perspective3` follows the OpenGL conventions.
impl<A: Space, B: Space> From<Perspective3<f64>> for Projective<A, B> {
    fn from(theirs: Perspective3<f64>) -> Self {
        theirs.to_homogeneous().into()
    }
}

impl<A: Space, B: Space> From<Projective<A, B>> for Matrix4<f64> {
    fn from(ours: Projective<A, B>) -> Self {
        ours.raw.to_cols_array_2d().into()
    }
}

impl<A: Space, B: Space> From<Isometry3<f64>> for Affine<A, B> {
    fn from(theirs: Isometry3<f64>) -> Self {
        Self::tagged(DMat4::from_cols_array_2d(&theirs.to_homogeneous().into()))
    }
}

impl<A: Space, B: Space> From<Affine<A, B>> for Matrix4<f64> {
    fn from(ours: Affine<A, B>) -> Self {
        ours.raw.to_cols_array_2d().into()
    }
}
