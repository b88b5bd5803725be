//! Serialization with serde: points and vectors are arrays of their coordinates, and matrices are
//! arrays of their rows, as printed in textbooks.

use crate::{Affine, HPoint, Normal, Plane, Point, Projective, Space, Vector};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

macro_rules! as_array {
    ($name:ident, $count:literal) => {
        impl<S: Space> Serialize for $name<S> {
            fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
                self.raw.to_array().serialize(serializer)
            }
        }

        impl<'de, S: Space> Deserialize<'de> for $name<S> {
            fn deserialize<R: Deserializer<'de>>(deserializer: R) -> Result<Self, R::Error> {
                let coordinates = <[f64; $count]>::deserialize(deserializer)?;
                Ok(Self::tagged(coordinates.into()))
            }
        }
    };
}
as_array!(Point, 3);
as_array!(Vector, 3);
as_array!(Normal, 3);
as_array!(HPoint, 4);
as_array!(Plane, 4);

impl<A: Space, B: Space> Serialize for Projective<A, B> {
    fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
        self.rows().serialize(serializer)
    }
}

impl<'de, A: Space, B: Space> Deserialize<'de> for Projective<A, B> {
    fn deserialize<R: Deserializer<'de>>(deserializer: R) -> Result<Self, R::Error> {
        <[[f64; 4]; 4]>::deserialize(deserializer).map(Self::from_rows)
    }
}

impl<A: Space, B: Space> Serialize for Affine<A, B> {
    fn serialize<W: Serializer>(&self, serializer: W) -> Result<W::Ok, W::Error> {
        self.rows().serialize(serializer)
    }
}

impl<'de, A: Space, B: Space> Deserialize<'de> for Affine<A, B> {
    fn deserialize<R: Deserializer<'de>>(deserializer: R) -> Result<Self, R::Error> {
        let rows = <[[f64; 4]; 4]>::deserialize(deserializer)?;
        let refusal = || R::Error::custom("the last row of an affine map must be 0, 0, 0, 1");
        Self::from_rows(rows).ok_or_else(refusal)
    }
}
