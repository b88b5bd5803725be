//! Checks whether all numbers in a result are finite.

use glam::DMat4;
use homog::{
    Affine, Bounds, HLine2, HPoint, HPoint1, HPoint2, HPointKind, Homography, Normal, Plane, Point,
    Projective, Space, Vector,
};

/// A result made of numbers.
pub trait Finite {
    fn finite(&self) -> bool;
}

impl Finite for f64 {
    fn finite(&self) -> bool {
        self.is_finite()
    }
}

impl<T: Finite, const N: usize> Finite for [T; N] {
    fn finite(&self) -> bool {
        self.iter().all(Finite::finite)
    }
}

impl<T: Finite> Finite for Vec<T> {
    fn finite(&self) -> bool {
        self.iter().all(Finite::finite)
    }
}

impl<T: Finite> Finite for Option<T> {
    fn finite(&self) -> bool {
        self.as_ref().is_none_or(Finite::finite)
    }
}

impl<T: Finite, E> Finite for Result<T, E> {
    fn finite(&self) -> bool {
        self.as_ref().is_ok_and(Finite::finite) || self.is_err()
    }
}

impl<A: Finite, B: Finite> Finite for (A, B) {
    fn finite(&self) -> bool {
        self.0.finite() && self.1.finite()
    }
}

impl<A: Finite, B: Finite, C: Finite> Finite for (A, B, C) {
    fn finite(&self) -> bool {
        self.0.finite() && self.1.finite() && self.2.finite()
    }
}

impl<A: Finite, B: Finite, C: Finite, D: Finite> Finite for (A, B, C, D) {
    fn finite(&self) -> bool {
        self.0.finite() && self.1.finite() && self.2.finite() && self.3.finite()
    }
}

impl<S: Space> Finite for Point<S> {
    fn finite(&self) -> bool {
        self.is_finite()
    }
}

impl<S: Space> Finite for Vector<S> {
    fn finite(&self) -> bool {
        self.is_finite()
    }
}

impl<S: Space> Finite for HPoint<S> {
    fn finite(&self) -> bool {
        self.is_finite()
    }
}

impl<S: Space> Finite for Normal<S> {
    fn finite(&self) -> bool {
        self.raw().is_finite()
    }
}

impl<S: Space> Finite for Plane<S> {
    fn finite(&self) -> bool {
        self.raw().is_finite()
    }
}

impl<S: Space> Finite for Bounds<S> {
    fn finite(&self) -> bool {
        (self.corners(), self.center()).finite()
    }
}

impl<S: Space> Finite for HPointKind<S> {
    fn finite(&self) -> bool {
        match self {
            Self::Finite(place) => place.is_finite(),
            Self::AtInfinity(direction) => direction.is_finite(),
            Self::Invalid => true,
        }
    }
}

impl Finite for DMat4 {
    fn finite(&self) -> bool {
        self.is_finite()
    }
}

impl<A: Space, B: Space> Finite for Affine<A, B> {
    fn finite(&self) -> bool {
        self.is_finite()
    }
}

impl<A: Space, B: Space> Finite for Projective<A, B> {
    fn finite(&self) -> bool {
        self.is_finite()
    }
}

impl Finite for Homography {
    fn finite(&self) -> bool {
        self.raw().is_finite()
    }
}

impl Finite for HPoint1 {
    fn finite(&self) -> bool {
        (self.x, self.h).finite()
    }
}

impl Finite for HPoint2 {
    fn finite(&self) -> bool {
        self.raw().is_finite()
    }
}

impl Finite for HLine2 {
    fn finite(&self) -> bool {
        self.raw().is_finite()
    }
}
