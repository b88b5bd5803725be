//! The projections of a scene file, by their names in graphics textbooks.

use crate::number::{FieldOfView, Finite, NonNegative, Positive};
use crate::schema::scene_enum;
use projection::PrincipalView;
use projection::homog::PixelCenters;

scene_enum! {
    /// A projection.
    ///
    /// The variants from `Multiview` on are the classical projections. Each fits its window around
    /// the models and, unless the view specifies a direction, shows their front.
    pub enum ProjectionFile as "Projection" {
        /// Perspective, with the eye in front of the image's center unless the lens is shifted. Set
        /// at most one field of view.
        Perspective {
            /// The vertical field of view in degrees. Default: 35, if no other field of view is
            /// set.
            fov_y_degrees: Option<FieldOfView>,
            /// The horizontal field of view in degrees. Default: from the vertical one and the
            /// aspect ratio of the image.
            fov_x_degrees: Option<FieldOfView>,
            /// The field of view from corner to corner in degrees. Default: from the vertical one
            /// and the aspect ratio of the image.
            fov_diagonal_degrees: Option<FieldOfView>,
            /// The shift of the lens to the right and up, in fractions of the image's longer side,
            /// as in Blender. Verticals stay parallel: a camera that looks straight ahead with
            /// `shift: (0, 0.2)` shows a tower without converging lines. Default: (0, 0).
            shift: (Finite, Finite) = NO_SHIFT,
            /// The distance of the near plane. Default: as far from the eye as the models allow.
            near: Option<Positive>,
            /// The distance of the far plane. Default: just behind the models.
            far: Option<Positive>,
        },
        /// Orthographic: a parallel projection, perpendicular to the image. Set the height of the
        /// window, all four of its borders, or neither.
        Orthographic {
            /// The height of the view volume in scene units. Default: from the framing.
            height: Option<Positive>,
            /// The window's left border, measured from the line of sight. Default: from the height.
            left: Option<Finite>,
            /// The window's right border. Default: from the height.
            right: Option<Finite>,
            /// The window's bottom border. Default: from the height.
            bottom: Option<Finite>,
            /// The window's top border. Default: from the height.
            top: Option<Finite>,
            /// The distance of the near plane. Default: just in front of the models.
            near: Option<Finite>,
            /// The distance of the far plane. Default: just behind the models.
            far: Option<Finite>,
        },
        /// Perspective through any window on the near plane, including an off-axis one.
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
            /// The distance of the far plane. Default: just behind the models.
            far: Option<Positive>,
        },
        /// The frustum of the WebGL lesson (createFrustum): its apex is straight behind the
        /// window's center, in the plane of the eye. Its picture differs from the picture of
        /// `Frustum` unless the window's center is on the line of sight.
        ApexMovedFrustum {
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
            /// The distance of the far plane. Default: just behind the models.
            far: Option<Positive>,
        },
        /// The perspective projection of a calibrated camera, from the entries of its matrix K:
        /// focal lengths and principal point in pixels, with rows counted from the top.
        Intrinsics {
            /// The focal length in columns.
            fx: Positive,
            /// The focal length in rows. Default: `fx`.
            fy: Option<Positive>,
            /// The column of the principal point. Default: the middle of the image.
            cx: Option<Finite>,
            /// The row of the principal point. Default: the middle of the image.
            cy: Option<Finite>,
            /// The skew: the entry of K that makes the column depend on the row. Default: 0.
            skew: Finite = Finite::ZERO,
            /// The width and height in pixels of the pictures that these numbers apply to. The
            /// image may be larger or smaller but must have the same aspect ratio. Default: the
            /// size of the image.
            size: Option<(u32, u32)>,
            /// The origin of the pixel coordinates. Default: `Integer`.
            pixel_centers: PixelCenters = PixelCenters::Integer,
            /// The distance of the near plane. Default: as far from the eye as the models allow.
            near: Option<Positive>,
            /// The distance of the far plane. Default: just behind the models.
            far: Option<Positive>,
        },
        /// One of the six principal views.
        Multiview(PrincipalView),
        /// Isometric: orthographic, all three axes foreshortened equally.
        Isometric,
        /// Dimetric: orthographic, x and y at full length and z at half, the 42°/7° projection of
        /// engineering drawing.
        Dimetric,
        /// Trimetric: orthographic, each axis foreshortened by a different factor.
        Trimetric,
        /// Orthographic, with the axes foreshortened in the ratio x:y:z.
        Axonometric {
            /// The foreshortening of the x axis.
            x: Positive,
            /// The foreshortening of the y axis.
            y: Positive,
            /// The foreshortening of the z axis.
            z: Positive,
        },
        /// Oblique: the front in true shape, depth at full length.
        Cavalier {
            /// The direction in which depth recedes, counterclockwise from the right. Default: 45.
            angle_degrees: Finite = HALF_RIGHT_ANGLE,
        },
        /// Oblique: the front in true shape, depth at half length.
        Cabinet {
            /// The direction in which depth recedes. Default: 45.
            angle_degrees: Finite = HALF_RIGHT_ANGLE,
        },
        /// Oblique: the front in true shape, depth scaled by any factor.
        Oblique {
            /// The drawn length of a unit of depth.
            length: NonNegative,
            /// The direction in which depth recedes. Default: 45.
            angle_degrees: Finite = HALF_RIGHT_ANGLE,
        },
        /// Planometric: the ground plan in true shape, heights straight up.
        Military {
            /// The rotation of the plan, counterclockwise. Default: 45.
            rotation_degrees: Finite = HALF_RIGHT_ANGLE,
            /// The drawn length of a unit of height. Default: 1.
            height: NonNegative = NonNegative::ONE,
        },
        /// One-point perspective, with the front parallel to the picture plane: lines in depth meet
        /// in one vanishing point. Picture coordinates go from −1 at the bottom to 1 at the top.
        OnePoint {
            /// The vanishing point of lines in depth. Default: slightly to the right of and above
            /// the center.
            at: (Finite, Finite) = point(0.35, 0.45),
            /// The eye's distance from the picture, in units of half the picture's height. Default:
            /// 3.
            distance: Positive = Positive::constant(3.0),
        },
        /// Two-point perspective, with verticals parallel to the picture plane. Picture coordinates
        /// are as for `OnePoint`.
        TwoPoint {
            /// The vanishing point of lines along x. Default: on the left, outside the picture.
            x: (Finite, Finite) = point(-3.2, 0.4),
            /// The vanishing point of lines along z. Default: on the right.
            z: (Finite, Finite) = point(2.4, 0.4),
            /// The position of the eye between the vanishing points, 0 at x and 1 at z. Default:
            /// 0.57, the center of the picture.
            fraction: Finite = Finite::constant(0.57),
        },
        /// Three-point perspective, with no axis parallel to the picture plane. Picture coordinates
        /// are as for `OnePoint`.
        ThreePoint {
            /// The vanishing point of lines along x. Default: on the left, above the center.
            x: (Finite, Finite) = point(-3.2, 1.2),
            /// The vanishing point of verticals. Default: far below.
            y: (Finite, Finite) = point(0.1, -5.0),
            /// The vanishing point of lines along z. Default: on the right, above the center.
            z: (Finite, Finite) = point(2.4, 1.2),
        },
        /// Perspective from the bottom row (p, q, r, 1) of the textbooks' matrix, with the models
        /// scaled to just fit in a sphere of radius 1. With r > 0 it is a reverse perspective:
        /// lines in depth diverge, and farther objects appear larger.
        NPoint {
            /// Lines along x meet at 1/p. Default: 0.
            p: Finite = Finite::ZERO,
            /// Verticals meet at 1/q. Default: 0.
            q: Finite = Finite::ZERO,
            /// Lines along z meet at 1/r. Default: 0.
            r: Finite = Finite::ZERO,
        },
    }
}

impl ProjectionFile {
    /// A perspective projection with all defaults.
    pub const PERSPECTIVE: Self = Self::Perspective {
        fov_y_degrees: None,
        fov_x_degrees: None,
        fov_diagonal_degrees: None,
        shift: NO_SHIFT,
        near: None,
        far: None,
    };
    /// An orthographic projection with all defaults.
    pub const ORTHOGRAPHIC: Self = Self::Orthographic {
        height: None,
        left: None,
        right: None,
        bottom: None,
        top: None,
        near: None,
        far: None,
    };

    /// Returns a cavalier projection with all defaults.
    #[must_use]
    pub const fn cavalier() -> Self {
        Self::Cavalier { angle_degrees: HALF_RIGHT_ANGLE }
    }

    /// Returns a cabinet projection with all defaults.
    #[must_use]
    pub const fn cabinet() -> Self {
        Self::Cabinet { angle_degrees: HALF_RIGHT_ANGLE }
    }

    /// Returns a military projection with all defaults.
    #[must_use]
    pub const fn military() -> Self {
        Self::Military { rotation_degrees: HALF_RIGHT_ANGLE, height: NonNegative::ONE }
    }

    /// Returns a one-point perspective with all defaults.
    #[must_use]
    pub const fn one_point() -> Self {
        Self::OnePoint { at: point(0.35, 0.45), distance: Positive::constant(3.0) }
    }

    /// Returns a two-point perspective with all defaults.
    #[must_use]
    pub const fn two_point() -> Self {
        Self::TwoPoint { x: point(-3.2, 0.4), z: point(2.4, 0.4), fraction: Finite::constant(0.57) }
    }

    /// Returns a three-point perspective with all defaults.
    #[must_use]
    pub const fn three_point() -> Self {
        Self::ThreePoint { x: point(-3.2, 1.2), y: point(0.1, -5.0), z: point(2.4, 1.2) }
    }

    /// Whether this is one of the classical projections, which fit their windows to the models.
    #[must_use]
    pub fn is_classical(&self) -> bool {
        !matches!(
            self,
            Self::Perspective { .. }
                | Self::Orthographic { .. }
                | Self::Frustum { .. }
                | Self::ApexMovedFrustum { .. }
                | Self::Intrinsics { .. }
        )
    }
}

/// The shift of a lens centered on the picture.
pub(super) const NO_SHIFT: (Finite, Finite) = point(0.0, 0.0);

/// 45 degrees, the usual direction of depth in oblique drawings.
const HALF_RIGHT_ANGLE: Finite = Finite::constant(45.0);

/// Returns a point in picture coordinates.
const fn point(x: f64, y: f64) -> (Finite, Finite) {
    (Finite::constant(x), Finite::constant(y))
}
