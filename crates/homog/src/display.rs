//! Readable output of points, vectors, normals and homogeneous points, such as `(1, 0.5, -2)`.
//!
//! A precision applies to each coordinate: `{:.2}` writes `(1.00, 0.50, -2.00)`. A homogeneous
//! point has four coordinates. Negative zero is written as 0.

use crate::{HPoint, Normal, Point, Space, Vector};
use core::fmt::{Display, Formatter, Result};

fn write_tuple(f: &mut Formatter<'_>, coordinates: &[f64]) -> Result {
    for (i, c) in coordinates.iter().enumerate() {
        f.write_str(if i == 0 { "(" } else { ", " })?;
        // Adding 0 turns −0 into 0 and leaves all other numbers unchanged.
        Display::fmt(&(c + 0.0), f)?;
    }
    f.write_str(")")
}

impl<S: Space> Display for Point<S> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        write_tuple(f, &self.raw.to_array())
    }
}

impl<S: Space> Display for Vector<S> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        write_tuple(f, &self.raw.to_array())
    }
}

impl<S: Space> Display for Normal<S> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        write_tuple(f, &self.raw.to_array())
    }
}

impl<S: Space> Display for HPoint<S> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        write_tuple(f, &self.raw.to_array())
    }
}

#[cfg(test)]
mod tests {
    extern crate alloc;
    use crate::{Clip, HPoint, Point, World};
    use alloc::format;

    #[test]
    fn coordinates_are_short_and_respect_the_precision() {
        let p = Point::<World>::new(1.0, -0.0, -2.5);
        assert_eq!(format!("{p}"), "(1, 0, -2.5)");
        assert_eq!(format!("{p:.2}"), "(1.00, 0.00, -2.50)");
        assert_eq!(format!("{}", HPoint::<Clip>::new(1.0, 2.0, 3.0, 0.25)), "(1, 2, 3, 0.25)");
    }
}
