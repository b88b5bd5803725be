//! The projections of a scene file, by the names they have in the textbooks.

use crate::scene::number::{FieldOfView, Finite, NonNegative, Positive};
use serde::Deserialize;

/// A projection.
///
/// Those from `Multiview` on are the classical ones. Each of them finds its own window, so that everything is in the picture; and
/// unless the view says otherwise it sees the front of the models.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(rename = "Projection", deny_unknown_fields)]
pub enum ProjectionFile {
    /// Perspective, the eye in front of the picture's centre.
    Perspective {
        /// The vertical opening angle in degrees. Default: 35.
        #[serde(default)]
        fov_y_degrees: FieldOfView,
        /// The distance of the near plane. Default: as far out as the scene allows.
        near: Option<Positive>,
        /// The distance of the far plane. Default: just behind everything.
        far: Option<Positive>,
    },
    /// Parallel, at right angles to the picture.
    Orthographic {
        /// The height of the view volume in the scene's units. Default: what the framing asks for.
        height: Option<Positive>,
        /// The distance of the near plane. Default: just before everything.
        near: Option<Finite>,
        /// The distance of the far plane. Default: just behind everything.
        far: Option<Finite>,
    },
    /// Perspective through any window on the near plane, also one beside the line of sight.
    Frustum {
        /// The window's left border.
        left: Finite,
        /// The window's right border.
        right: Finite,
        /// The window's bottom border.
        bottom: Finite,
        /// The window's top border.
        top: Finite,
        /// The distance of the window, which is the near plane.
        near: Positive,
        /// The distance of the far plane. Default: just behind everything.
        far: Option<Positive>,
    },
    /// One of the six principal views.
    Multiview(PrincipalFile),
    /// Orthographic, all three axes shortened alike.
    Isometric,
    /// Orthographic, x and y in full and z by half: the 42°/7° of engineering drawing.
    Dimetric,
    /// Orthographic, each axis shortened by a factor of its own.
    Trimetric,
    /// Orthographic, the axes shortened as x : y : z.
    Axonometric {
        /// The part of the x axis.
        x: Positive,
        /// The part of the y axis.
        y: Positive,
        /// The part of the z axis.
        z: Positive,
    },
    /// Oblique: the front in true shape, depth in full.
    Cavalier {
        /// The direction in which depth recedes, from the right counterclockwise. Default: 45.
        #[serde(default = "half_right_angle")]
        angle_degrees: Finite,
    },
    /// Oblique: the front in true shape, depth by half.
    Cabinet {
        /// The direction in which depth recedes. Default: 45.
        #[serde(default = "half_right_angle")]
        angle_degrees: Finite,
    },
    /// Oblique: the front in true shape, depth by any factor.
    Oblique {
        /// The drawn length of a unit of depth.
        length: NonNegative,
        /// The direction in which depth recedes. Default: 45.
        #[serde(default = "half_right_angle")]
        angle_degrees: Finite,
    },
    /// Oblique: the ground plan in true shape, heights straight up.
    Military {
        /// How far the plan is turned, counterclockwise. Default: 45.
        #[serde(default = "half_right_angle")]
        turn_degrees: Finite,
        /// The drawn length of a unit of height. Default: 1.
        #[serde(default = "whole")]
        height: NonNegative,
    },
    /// Perspective with the front parallel to the picture: lines in depth meet in one point. Places on the picture go from −1 at its
    /// bottom to 1 at its top.
    OnePoint {
        /// Where lines in depth meet. Default: a little to the right and above the middle.
        #[serde(default = "usual_one_point")]
        at: (Finite, Finite),
        /// The distance of the eye from the picture, in half heights of it. Default: 3.
        #[serde(default = "usual_distance")]
        distance: Positive,
    },
    /// Perspective with uprights parallel to the picture. Places as for `OnePoint`.
    TwoPoint {
        /// Where lines along x meet. Default: at the left, outside of the picture.
        #[serde(default = "usual_two_point_x")]
        x: (Finite, Finite),
        /// Where lines along z meet. Default: at the right.
        #[serde(default = "usual_two_point_z")]
        z: (Finite, Finite),
        /// Where between the two the eye is opposite, 0 at x and 1 at z. Default: 0.57, the middle of the picture.
        #[serde(default = "usual_fraction")]
        fraction: Finite,
    },
    /// Perspective with no axis parallel to the picture. Places as for `OnePoint`.
    ThreePoint {
        /// Where lines along x meet. Default: at the left, above the middle.
        #[serde(default = "usual_three_point_x")]
        x: (Finite, Finite),
        /// Where uprights meet. Default: far below.
        #[serde(default = "usual_three_point_y")]
        y: (Finite, Finite),
        /// Where lines along z meet. Default: at the right, above the middle.
        #[serde(default = "usual_three_point_z")]
        z: (Finite, Finite),
    },
    /// Perspective by the bottom row (p, q, r, 1) of the textbooks' matrix, with the models scaled so that they just fit into a sphere
    /// of radius 1.
    NPoint {
        /// 1/p is where lines along x meet. Default: 0.
        #[serde(default = "nothing")]
        p: Finite,
        /// 1/q is where uprights meet. Default: 0.
        #[serde(default = "nothing")]
        q: Finite,
        /// 1/r is where lines along z meet. Default: 0.
        #[serde(default = "nothing")]
        r: Finite,
    },
}

/// One of the six principal views.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Deserialize)]
#[serde(rename = "Multiview")]
pub enum PrincipalFile {
    /// From +z.
    Front,
    /// From −z.
    Back,
    /// From −x.
    Left,
    /// From +x.
    Right,
    /// From +y.
    Top,
    /// From −y.
    Bottom,
}

impl ProjectionFile {
    /// Perspective with every default.
    pub const PERSPECTIVE: Self =
        Self::Perspective { fov_y_degrees: FieldOfView::USUAL, near: None, far: None };
    /// Orthographic with every default.
    pub const ORTHOGRAPHIC: Self = Self::Orthographic { height: None, near: None, far: None };

    /// Cavalier with every default.
    #[must_use]
    pub fn cavalier() -> Self {
        Self::Cavalier { angle_degrees: half_right_angle() }
    }

    /// Cabinet with every default.
    #[must_use]
    pub fn cabinet() -> Self {
        Self::Cabinet { angle_degrees: half_right_angle() }
    }

    /// Military with every default.
    #[must_use]
    pub fn military() -> Self {
        Self::Military { turn_degrees: half_right_angle(), height: whole() }
    }

    /// One-point perspective with every default.
    #[must_use]
    pub fn one_point() -> Self {
        Self::OnePoint { at: usual_one_point(), distance: usual_distance() }
    }

    /// Two-point perspective with every default.
    #[must_use]
    pub fn two_point() -> Self {
        let (x, z) = (usual_two_point_x(), usual_two_point_z());
        Self::TwoPoint { x, z, fraction: usual_fraction() }
    }

    /// Three-point perspective with every default.
    #[must_use]
    pub fn three_point() -> Self {
        let (x, y, z) = (usual_three_point_x(), usual_three_point_y(), usual_three_point_z());
        Self::ThreePoint { x, y, z }
    }

    /// Whether it is one of the classical projections, which find their own windows.
    #[must_use]
    pub fn is_classical(&self) -> bool {
        !matches!(self, Self::Perspective { .. } | Self::Orthographic { .. } | Self::Frustum { .. })
    }
}

fn place(x: f64, y: f64) -> (Finite, Finite) {
    (Finite::known(x), Finite::known(y))
}

fn nothing() -> Finite {
    Finite::known(0.0)
}

fn half_right_angle() -> Finite {
    Finite::known(45.0)
}

fn whole() -> NonNegative {
    NonNegative::ONE
}

fn usual_one_point() -> (Finite, Finite) {
    place(0.35, 0.45)
}

fn usual_distance() -> Positive {
    Positive::known(3.0)
}

fn usual_two_point_x() -> (Finite, Finite) {
    place(-3.2, 0.4)
}

fn usual_two_point_z() -> (Finite, Finite) {
    place(2.4, 0.4)
}

fn usual_fraction() -> Finite {
    Finite::known(0.57)
}

fn usual_three_point_x() -> (Finite, Finite) {
    place(-3.2, 1.2)
}

fn usual_three_point_y() -> (Finite, Finite) {
    place(0.1, -5.0)
}

fn usual_three_point_z() -> (Finite, Finite) {
    place(2.4, 1.2)
}
