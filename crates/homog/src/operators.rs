//! Operators: products of maps, points and vectors as written in textbooks, and sums of vectors.
//!
//! `map * point` is `map.transform_point(point)`. `second * first` is the map that applies `first`,
//! then `second`, as in a matrix product. [`Affine::then`] chains maps in the opposite order: the
//! order in which a point passes through them.

use crate::{Affine, HPoint, Normal, Point, Projective, Space, Vector};
use core::iter::Sum;
use core::ops::{AddAssign, DivAssign, Mul, MulAssign, SubAssign};

impl<A: Space, B: Space> Mul<Point<A>> for Affine<A, B> {
    type Output = Point<B>;
    fn mul(self, point: Point<A>) -> Point<B> {
        self.transform_point(point)
    }
}

impl<A: Space, B: Space> Mul<Vector<A>> for Affine<A, B> {
    type Output = Vector<B>;
    fn mul(self, vector: Vector<A>) -> Vector<B> {
        self.transform_vector(vector)
    }
}

impl<A: Space, B: Space> Mul<Normal<A>> for Affine<A, B> {
    type Output = Normal<B>;
    fn mul(self, normal: Normal<A>) -> Normal<B> {
        self.transform_normal(normal)
    }
}

impl<A: Space, B: Space, C: Space> Mul<Affine<A, B>> for Affine<B, C> {
    type Output = Affine<A, C>;
    fn mul(self, first: Affine<A, B>) -> Affine<A, C> {
        first.then(self)
    }
}

impl<A: Space, B: Space, C: Space> Mul<Projective<A, B>> for Affine<B, C> {
    type Output = Projective<A, C>;
    fn mul(self, first: Projective<A, B>) -> Projective<A, C> {
        first.then(self)
    }
}

impl<A: Space, B: Space> Mul<Point<A>> for Projective<A, B> {
    type Output = HPoint<B>;
    fn mul(self, point: Point<A>) -> HPoint<B> {
        self.transform_point(point)
    }
}

impl<A: Space, B: Space> Mul<HPoint<A>> for Projective<A, B> {
    type Output = HPoint<B>;
    fn mul(self, point: HPoint<A>) -> HPoint<B> {
        self.transform_hpoint(point)
    }
}

impl<A: Space, B: Space, C: Space> Mul<Projective<A, B>> for Projective<B, C> {
    type Output = Projective<A, C>;
    fn mul(self, first: Projective<A, B>) -> Projective<A, C> {
        first.then(self)
    }
}

impl<A: Space, B: Space, C: Space> Mul<Affine<A, B>> for Projective<B, C> {
    type Output = Projective<A, C>;
    fn mul(self, first: Affine<A, B>) -> Projective<A, C> {
        first.then_project(self)
    }
}

impl<S: Space> Mul<Vector<S>> for f64 {
    type Output = Vector<S>;
    fn mul(self, vector: Vector<S>) -> Vector<S> {
        vector * self
    }
}

impl<S: Space> AddAssign for Vector<S> {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<S: Space> SubAssign for Vector<S> {
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl<S: Space> MulAssign<f64> for Vector<S> {
    fn mul_assign(&mut self, by: f64) {
        *self = *self * by;
    }
}

impl<S: Space> DivAssign<f64> for Vector<S> {
    fn div_assign(&mut self, by: f64) {
        *self = *self / by;
    }
}

impl<S: Space> AddAssign<Vector<S>> for Point<S> {
    fn add_assign(&mut self, by: Vector<S>) {
        *self = *self + by;
    }
}

impl<S: Space> SubAssign<Vector<S>> for Point<S> {
    fn sub_assign(&mut self, by: Vector<S>) {
        *self = *self - by;
    }
}

impl<S: Space> Sum for Vector<S> {
    fn sum<I: Iterator<Item = Self>>(vectors: I) -> Self {
        vectors.fold(Self::ZERO, |sum, vector| sum + vector)
    }
}

/// The origin.
impl<S: Space> Default for Point<S> {
    fn default() -> Self {
        Self::ORIGIN
    }
}

/// The zero vector.
impl<S: Space> Default for Vector<S> {
    fn default() -> Self {
        Self::ZERO
    }
}

/// The identity.
impl<A: Space, B: Space> Default for Affine<A, B> {
    fn default() -> Self {
        Self::IDENTITY
    }
}

/// The identity.
impl<A: Space, B: Space> Default for Projective<A, B> {
    fn default() -> Self {
        Affine::IDENTITY.into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Clip, Model, View, World};

    #[test]
    fn products_match_the_named_methods() {
        let placed = Affine::<Model, World>::translation(Vector::new(1.0, 2.0, 3.0));
        let seen = Affine::<World, View>::rotation_z(0.5);
        let lens = Projective::<View, Clip>::from_rows([
            [2.0, 0.0, 0.0, 0.0],
            [0.0, 2.0, 0.0, 0.0],
            [0.0, 0.0, 1.0, 2.0],
            [0.0, 0.0, -1.0, 0.0],
        ]);
        let p = Point::<Model>::new(0.5, -1.0, -4.0);
        assert_eq!(placed * p, placed.transform_point(p));
        assert_eq!(seen * placed, placed.then(seen));
        assert_eq!(lens * seen * placed, placed.then(seen).then_project(lens));
        assert_eq!(lens * (seen * (placed * p)), (lens * (seen * placed)) * p);
        let v = Vector::<Model>::new(3.0, 4.0, 0.0);
        assert_eq!(placed * v, Vector::new(3.0, 4.0, 0.0));
        let mut moved = p;
        moved += 2.0 * v;
        moved -= v / 2.0;
        assert_eq!(moved.distance(p), 7.5);
        assert_eq!([v, v].into_iter().sum::<Vector<Model>>(), v * 2.0);
    }
}
