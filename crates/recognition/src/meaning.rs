//! The possible meanings of a matrix, with their parameters.

use super::{CameraReading, IntrinsicsReading, ViewportReading};
use homog::{Plane, View};
use projection::{
    ApexMovedFrustum, Axonometric, Convention, Frustum, NPoint, Oblique, Orthographic,
    PrincipalPlane, Window,
};

/// The angles and proportions of a perspective projection, read from its matrix at full precision.
#[derive(Clone, Copy, PartialEq, Debug)]
#[non_exhaustive]
pub struct Lens {
    /// The horizontal angle of view in degrees, from the left to the right edge.
    pub fov_x_degrees: f64,
    /// The vertical angle of view in degrees, from the bottom to the top edge.
    pub fov_y_degrees: f64,
    /// The ratio of the window's width to its height.
    pub aspect: f64,
    /// The focal lengths in units of half the picture's width and height: 2N/(r − l), 2N/(t − b).
    pub focal_lengths: [f64; 2],
}

/// The meaning of a matrix for column vectors.
#[derive(Clone, Copy, PartialEq, Debug)]
#[non_exhaustive]
pub enum MatrixMeaning {
    /// The identity.
    Identity,
    /// A translation (HO-4).
    Translation {
        /// The translation vector.
        by: [f64; 3],
    },
    /// A scale about the origin.
    Scale {
        /// The factors along x, y and z.
        factors: [f64; 3],
    },
    /// A scale and translation along each axis, as from a window to a viewport (WI-2, WV-2).
    Windowing {
        /// The scale along x, y and z.
        scale: [f64; 3],
        /// The offset, applied after the scale.
        offset: [f64; 3],
    },
    /// A reflection in the plane normal · p = distance (Householder).
    Reflection {
        /// The normal, with length 1.
        normal: [f64; 3],
        /// The distance from the origin along the normal.
        distance: f64,
    },
    /// A rotation about an axis through the origin.
    Rotation {
        /// The axis, with length 1.
        axis: [f64; 3],
        /// The angle in degrees, from 0 to 180, counterclockwise when the axis points at the
        /// viewer.
        angle_degrees: f64,
        /// The equivalent camera at the origin.
        camera: CameraReading,
    },
    /// The camera transform M_cam: rotation and translation (CA-2).
    Camera(CameraReading),
    /// The inverse of a camera transform: the pose of a camera in the world (C2W).
    CameraPose(CameraReading),
    /// A shear, which adds multiples of coordinates to other coordinates, and a translation.
    Shear {
        /// The rows of the linear part, with 1 on the diagonal.
        linear: [[f64; 3]; 3],
        /// The translation.
        offset: [f64; 3],
    },
    /// A model matrix: a scale along the axes, then a rotation, then a translation.
    ModelTransform {
        /// The translation, applied last.
        translation: [f64; 3],
        /// The axis of the rotation, with length 1.
        axis: [f64; 3],
        /// The angle of the rotation in degrees, from 0 to 180.
        angle_degrees: f64,
        /// The scale along x, y and z, applied first; negative if the axes are mirrored.
        scale: [f64; 3],
    },
    /// The viewport transform M_vp (VP-1 to VP-3).
    Viewport(ViewportReading),
    /// The camera intrinsics K (OpenCV).
    Intrinsics(IntrinsicsReading),
    /// The textbook's P (PE-1; Shirley and Marschner, ch. 8), with signed n and f.
    ChapterP {
        /// The z of the near plane.
        n: f64,
        /// The z of the far plane.
        f: f64,
    },
    /// The inverse of the textbook's P; the factor is nf if it is printed without fractions.
    ChapterPInverse {
        /// The z of the near plane.
        n: f64,
        /// The z of the far plane.
        f: f64,
    },
    /// A perspective projection from view to clip space, such as GL-1, PE-2 or D3D-1.
    Perspective {
        /// The window on the near plane, with near and far as distances.
        frustum: Frustum,
        /// Its angles and proportions.
        lens: Lens,
        /// The convention in which the parameters are expressed.
        convention: Convention,
    },
    /// The inverse of a perspective projection, from clip to view space (IV-1).
    InversePerspective {
        /// The window on the near plane, with near and far as distances.
        frustum: Frustum,
        /// Its angles and proportions.
        lens: Lens,
        /// The convention in which the parameters are expressed.
        convention: Convention,
    },
    /// The frustum of the WebGL lesson, with its apex beside the origin (LW-1).
    ApexMoved {
        /// The window on the near plane, with near and far as distances.
        frustum: ApexMovedFrustum,
        /// The convention in which the parameters are expressed.
        convention: Convention,
    },
    /// A perspective projection with an inclined near plane (Lengyel 2005).
    ObliqueNear {
        /// The window at distance 1 in front of the eye.
        slopes: Window,
        /// The near plane; its normal has length 1 and points to the visible side.
        near_plane: Plane<View>,
        /// The convention in which the parameters are expressed.
        convention: Convention,
    },
    /// An orthographic projection, from view to clip space (OR-1, GL-3).
    Orthographic {
        /// The window, with near and far as distances.
        volume: Orthographic,
        /// The convention in which the parameters are expressed.
        convention: Convention,
    },
    /// An oblique projection, from view to clip space (VV-1).
    ObliqueVolume {
        /// The length and angle of the depth axis.
        projection: Oblique,
        /// The window on z = 0, with near and far as distances.
        volume: Orthographic,
        /// The convention in which the parameters are expressed.
        convention: Convention,
    },
    /// The depth-preserving shear of an oblique projection (OB-1).
    ObliqueShear {
        /// The length and angle of the depth axis.
        projection: Oblique,
    },
    /// An oblique projection onto a plane z = const (OB-2), or an orthographic projection if the
    /// length is 0.
    ObliqueOntoPlane {
        /// The length, angle and plane.
        projection: Oblique,
    },
    /// The projection onto a coordinate plane (MV-1 to MV-3).
    PrincipalView {
        /// The coordinate plane.
        plane: PrincipalPlane,
    },
    /// An axonometric projection onto its picture plane (AX-1).
    AxonometricOntoPlane {
        /// The orientation, which may be isometric, dimetric or trimetric.
        projection: Axonometric,
    },
    /// A plan oblique projection: the ground plan keeps its shape, and heights are drawn
    /// vertically. It is the military projection if the height factor is 1.
    Planometric {
        /// The angle in degrees by which the plan is rotated counterclockwise.
        turn_degrees: f64,
        /// The scale factor of heights.
        height: f64,
        /// True if heights are z and the plan is in x and y; otherwise heights are y.
        z_up: bool,
        /// True if the height is dropped.
        onto_plane: bool,
    },
    /// A one-, two- or three-point perspective projection (ONE-1, TWO-1, THREE-1).
    NPoint {
        /// The terms p, q and r.
        projection: NPoint,
        /// True if z is dropped.
        onto_plane: bool,
    },
    /// The perspective projection from the origin onto a plane z = const: w = z / `plane_z`
    /// (Foley, van Dam and others 1990, equation 6.5).
    CentralOntoPlane {
        /// The z of the picture plane; negative in front of a camera that looks along −z.
        plane_z: f64,
        /// True if z is dropped.
        onto_plane: bool,
    },
    /// A camera and a perspective projection, from world to clip space.
    CameraPerspective {
        /// The camera in the world.
        camera: CameraReading,
        /// The window on the near plane, with near and far as distances.
        frustum: Frustum,
        /// Its angles and proportions.
        lens: Lens,
        /// The convention in which the parameters are expressed. The world has the handedness of
        /// its view space.
        convention: Convention,
    },
    /// A perspective projection and a viewport in one matrix, from view or world space to pixels
    /// (PL-1). The window is centered on the line of sight.
    PerspectiveToPixels {
        /// The width and height in pixels; depth is unchanged.
        size: [f64; 2],
        /// True if rows count from the top.
        y_down: bool,
        /// True if pixel centers have integer coordinates.
        integer_centers: bool,
        /// The camera in the world, or `None` if the map starts in view space.
        camera: Option<CameraReading>,
        /// The window on the near plane, with near and far as distances.
        frustum: Frustum,
        /// Its angles and proportions.
        lens: Lens,
        /// The convention in which the parameters are expressed.
        convention: Convention,
    },
    /// A camera and an orthographic projection. The matrix does not determine the eye, which is
    /// placed at the origin.
    CameraOrthographic {
        /// The orientation of the camera.
        camera: CameraReading,
        /// The window, with near and far as distances.
        volume: Orthographic,
        /// The convention in which the parameters are expressed. The world has the handedness of
        /// its view space.
        convention: Convention,
    },
    /// An unnamed affine map.
    Affine,
    /// An unnamed projective map.
    Projective,
}

impl MatrixMeaning {
    /// Returns whether the meaning is more specific than an unnamed affine or projective map.
    #[must_use]
    pub const fn is_named(&self) -> bool {
        !matches!(self, Self::Affine | Self::Projective)
    }

    /// Returns the convention of the parameters, if the meaning has a convention.
    #[must_use]
    pub const fn convention(&self) -> Option<Convention> {
        match self {
            Self::Perspective { convention, .. }
            | Self::InversePerspective { convention, .. }
            | Self::ApexMoved { convention, .. }
            | Self::ObliqueNear { convention, .. }
            | Self::Orthographic { convention, .. }
            | Self::ObliqueVolume { convention, .. }
            | Self::CameraPerspective { convention, .. }
            | Self::PerspectiveToPixels { convention, .. }
            | Self::CameraOrthographic { convention, .. } => Some(*convention),
            _ => None,
        }
    }
}
