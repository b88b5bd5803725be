//! Conversions to and from the types of mint, the bridge to any version of glam, nalgebra, cgmath
//! and other libraries.

use crate::{Affine, HPoint, Point, Projective, Space, Vector};
use glam::DMat4;
use mint::{ColumnMatrix4, Point3, RowMatrix4, Vector3, Vector4};

macro_rules! convert_coordinates {
    ($name:ident, $theirs:ident, $count:literal) => {
        impl<S: Space> From<$theirs<f64>> for $name<S> {
            fn from(theirs: $theirs<f64>) -> Self {
                <[f64; $count]>::from(theirs).into()
            }
        }

        impl<S: Space> From<$theirs<f32>> for $name<S> {
            fn from(theirs: $theirs<f32>) -> Self {
                <[f32; $count]>::from(theirs).into()
            }
        }

        impl<S: Space> From<$name<S>> for $theirs<f64> {
            fn from(ours: $name<S>) -> Self {
                <[f64; $count]>::from(ours).into()
            }
        }

        impl<S: Space> From<$name<S>> for $theirs<f32> {
            fn from(ours: $name<S>) -> Self {
                ours.to_f32().into()
            }
        }

        impl<S: Space> mint::IntoMint for $name<S> {
            type MintType = $theirs<f64>;
        }
    };
}
convert_coordinates!(Point, Point3, 3);
convert_coordinates!(Vector, Vector3, 3);
convert_coordinates!(HPoint, Vector4, 4);

impl<A: Space, B: Space> From<ColumnMatrix4<f64>> for Projective<A, B> {
    fn from(theirs: ColumnMatrix4<f64>) -> Self {
        Self::tagged(DMat4::from_cols_array_2d(&theirs.into()))
    }
}

impl<A: Space, B: Space> From<RowMatrix4<f64>> for Projective<A, B> {
    fn from(theirs: RowMatrix4<f64>) -> Self {
        Self::from_rows(theirs.into())
    }
}

impl<A: Space, B: Space> From<Projective<A, B>> for ColumnMatrix4<f64> {
    fn from(ours: Projective<A, B>) -> Self {
        ours.raw.to_cols_array_2d().into()
    }
}

impl<A: Space, B: Space> From<Projective<A, B>> for RowMatrix4<f64> {
    fn from(ours: Projective<A, B>) -> Self {
        ours.rows().into()
    }
}

impl<A: Space, B: Space> mint::IntoMint for Projective<A, B> {
    type MintType = ColumnMatrix4<f64>;
}

impl<A: Space, B: Space> From<Affine<A, B>> for ColumnMatrix4<f64> {
    fn from(ours: Affine<A, B>) -> Self {
        Projective::from(ours).into()
    }
}
