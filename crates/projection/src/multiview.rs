//! Multiview orthographic projection: front, top and side on the coordinate planes (MV-1..3; C75).
//!
//! ```text
//!        y                    top ⟂ y          third angle: top above the front view,
//!        │                      │              the right side to its right
//!        │    ⟋ front ⟂ z     ┌───┐
//!        └──── x              │top│
//!      ⟋                      ├───┼────┐
//!     z                       │frt│side│
//!                             └───┴────┘
//! ```

use crate::matrix::from_rows;
use homog::{Affine, Space, View};

/// A coordinate plane to project onto.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum PrincipalPlane {
    /// x = 0: side views.
    Yoz,
    /// y = 0: views from above and below.
    Zox,
    /// z = 0: views from the front and the back.
    Xoy,
}

impl PrincipalPlane {
    /// All three planes, in the order of the axes they drop.
    pub const ALL: [Self; 3] = [Self::Yoz, Self::Zox, Self::Xoy];

    /// Returns the classical projection, which sets the coordinate perpendicular to the plane to 0.
    /// It is singular, and applying it twice is the same as applying it once.
    #[must_use]
    pub fn onto_plane<S: Space>(self) -> Affine<S, S> {
        match self {
            Self::Yoz => Affine::scale(0.0, 1.0, 1.0),
            Self::Zox => Affine::scale(1.0, 0.0, 1.0),
            Self::Xoy => Affine::scale(1.0, 1.0, 0.0),
        }
    }
}

/// The six principal views of an object whose front faces +z and whose top faces +y.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum PrincipalView {
    /// From +z: x right, y up.
    Front,
    /// From −z.
    Back,
    /// From +x, the object's right-hand side in the front view.
    Right,
    /// From −x.
    Left,
    /// From +y, with the front at the bottom.
    Top,
    /// From −y, with the front at the top.
    Bottom,
}

impl PrincipalView {
    /// All six views.
    pub const ALL: [Self; 6] =
        [Self::Front, Self::Back, Self::Right, Self::Left, Self::Top, Self::Bottom];

    /// Returns the plane of projection.
    #[must_use]
    pub const fn plane(self) -> PrincipalPlane {
        match self {
            Self::Front | Self::Back => PrincipalPlane::Xoy,
            Self::Right | Self::Left => PrincipalPlane::Yoz,
            Self::Top | Self::Bottom => PrincipalPlane::Zox,
        }
    }

    /// Returns the rotation that maps the view's axes to x right, y up and z toward the viewer. It
    /// is exact, with entries 0 and ±1.
    #[must_use]
    pub fn depth_preserving(self) -> Affine<View, View> {
        let (x, y, z) = match self {
            Self::Front => ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]),
            Self::Back => ([-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]),
            Self::Right => ([0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]),
            Self::Left => ([0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]),
            Self::Top => ([1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]),
            Self::Bottom => ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]),
        };
        let row = |[a, b, c]: [f64; 3]| [a, b, c, 0.0];
        let rows = from_rows([row(x), row(y), row(z), [0.0, 0.0, 0.0, 1.0]]);
        Affine::from_raw(rows).unwrap_or(Affine::IDENTITY)
    }

    /// Returns the column and row of the view on a sheet, relative to the front view at (0, 0),
    /// with x to the right and y up.
    ///
    /// In third-angle projection, a view is on the side from which it is seen; in first-angle
    /// projection, it is on the opposite side. In both, the back view is at the far right.
    #[must_use]
    pub const fn sheet_position(self, angle: SheetAngle) -> (i32, i32) {
        let (x, y) = match self {
            Self::Front => (0, 0),
            Self::Right => (1, 0),
            Self::Left => (-1, 0),
            Self::Top => (0, 1),
            Self::Bottom => (0, -1),
            Self::Back => (2, 0),
        };
        match (angle, self) {
            (SheetAngle::Third, _) | (SheetAngle::First, Self::Back) => (x, y),
            (SheetAngle::First, _) => (-x, -y),
        }
    }
}

/// The layout of views on a sheet (ISO 5456-2).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum SheetAngle {
    /// The object is between the viewer and the sheet: the view from the left is on the right.
    /// Common in Europe and China.
    First,
    /// The sheet is between the viewer and the object: the view from the left is on the left.
    /// Common in America.
    Third,
}
