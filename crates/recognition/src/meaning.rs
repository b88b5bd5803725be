//! The meanings a matrix may have, with their parameters.

use super::{CameraReading, IntrinsicsReading, ViewportReading};
use homog::{Plane, View};
use projection::{
    ApexMovedFrustum, Axonometric, Convention, Frustum, NPoint, Oblique, Orthographic,
    PrincipalPlane, Window,
};

/// Angles and proportions of a perspective, read from its matrix with as many digits as matter.
#[derive(Clone, Copy, PartialEq, Debug)]
#[non_exhaustive]
pub struct Lens {
    /// Horizontal angle of view: from the left to the right edge.
    pub fov_x_degrees: f64,
    /// Vertical angle of view: from the bottom to the top edge.
    pub fov_y_degrees: f64,
    /// Width of the window by its height.
    pub aspect: f64,
    /// Focal lengths in units of half the picture's width and height: 2N/(r − l), 2N/(t − b).
    pub focal_lengths: [f64; 2],
}

/// The meaning of a matrix for column vectors.
#[derive(Clone, Copy, PartialEq, Debug)]
#[non_exhaustive]
pub enum MatrixMeaning {
    /// Everything stays where it is.
    Identity,
    /// Every point moves by a vector (HO-4).
    Translation {
        /// The vector.
        by: [f64; 3],
    },
    /// Scale about the origin.
    Scale {
        /// Along x, y and z.
        factors: [f64; 3],
    },
    /// Scale and translation along each axis, as from a window to a viewport (WI-2, WV-2).
    Windowing {
        /// Along x, y and z.
        scale: [f64; 3],
        /// Added after the scale.
        offset: [f64; 3],
    },
    /// Reflection in the plane normal · p = distance (Householder).
    Reflection {
        /// Of length 1.
        normal: [f64; 3],
        /// From the origin, along the normal.
        distance: f64,
    },
    /// Rotation about an axis through the origin.
    Rotation {
        /// Of length 1.
        axis: [f64; 3],
        /// 0 to 180, counterclockwise seen against the axis.
        angle_degrees: f64,
        /// The camera at the origin that it is, if it is one.
        camera: CameraReading,
    },
    /// The camera transform M_cam: rotation and translation (CA-2).
    Camera(CameraReading),
    /// The inverse of a camera transform: the pose of a camera in the world (C2W).
    CameraPose(CameraReading),
    /// Coordinates added to others, and a translation.
    Shear {
        /// The rows of the linear part, 1 on the diagonal.
        linear: [[f64; 3]; 3],
        /// The translation.
        offset: [f64; 3],
    },
    /// Scale of the axes, then a rotation, then a translation: a model matrix.
    ModelTransform {
        /// Applied last.
        translation: [f64; 3],
        /// Of the rotation, of length 1.
        axis: [f64; 3],
        /// Of the rotation, 0 to 180.
        angle_degrees: f64,
        /// Along x, y and z, applied first; negative where the axes are mirrored.
        scale: [f64; 3],
    },
    /// The viewport transform M_vp (VP-1 to VP-3).
    Viewport(ViewportReading),
    /// Camera intrinsics K (OpenCV).
    Intrinsics(IntrinsicsReading),
    /// The textbook's P (PE-1), with signed n and f.
    ChapterP {
        /// z of the near plane.
        n: f64,
        /// z of the far plane.
        f: f64,
    },
    /// The inverse of the textbook's P; the factor is nf if it is printed without fractions.
    ChapterPInverse {
        /// z of the near plane.
        n: f64,
        /// z of the far plane.
        f: f64,
    },
    /// A perspective: view to clip space (GL-1, PE-2, D3D-1 …).
    Perspective {
        /// Window on the near plane, near and far as distances.
        frustum: Frustum,
        /// Its angles.
        lens: Lens,
        /// The convention in which it has these parameters.
        convention: Convention,
    },
    /// The inverse of a perspective: clip to view space (IV-1).
    InversePerspective {
        /// Window on the near plane, near and far as distances.
        frustum: Frustum,
        /// Its angles.
        lens: Lens,
        /// The convention in which it has these parameters.
        convention: Convention,
    },
    /// The frustum of the WebGL lesson, its apex beside the origin (LW-1).
    ApexMoved {
        /// Window on the near plane, near and far as distances.
        frustum: ApexMovedFrustum,
        /// The convention in which it has these parameters.
        convention: Convention,
    },
    /// A perspective whose near plane is inclined (Lengyel 2005).
    ObliqueNear {
        /// The window one unit ahead of the eye.
        slopes: Window,
        /// The near plane; its normal has length 1 and points to what is visible.
        near_plane: Plane<View>,
        /// The convention in which it has these parameters.
        convention: Convention,
    },
    /// A box without foreshortening: view to clip space (OR-1, GL-3).
    Orthographic {
        /// Window, near and far as distances.
        volume: Orthographic,
        /// The convention in which it has these parameters.
        convention: Convention,
    },
    /// An oblique prism: view to clip space (VV-1).
    ObliqueVolume {
        /// Length and angle of the depth axis.
        projection: Oblique,
        /// Window on z = 0, near and far as distances.
        volume: Orthographic,
        /// The convention in which it has these parameters.
        convention: Convention,
    },
    /// The shear of an oblique projection, depth kept (OB-1).
    ObliqueShear {
        /// Length and angle of the depth axis.
        projection: Oblique,
    },
    /// An oblique or, with length 0, an orthographic projection onto a plane z = const (OB-2).
    ObliqueOntoPlane {
        /// Length, angle and plane.
        projection: Oblique,
    },
    /// The projection onto a coordinate plane (MV-1 to MV-3).
    PrincipalView {
        /// The plane.
        plane: PrincipalPlane,
    },
    /// An axonometric projection onto its picture plane (AX-1).
    AxonometricOntoPlane {
        /// Isometric, dimetric or trimetric.
        projection: Axonometric,
    },
    /// A plan oblique projection: the ground plan keeps its shape, heights rise straight up. With
    /// height 1 it is the military projection.
    Planometric {
        /// The angle by which the plan is turned, counterclockwise.
        turn_degrees: f64,
        /// How many times its length a height is drawn.
        height: f64,
        /// True if heights are z and the plan is that of x and y; otherwise heights are y.
        z_up: bool,
        /// True if the height is dropped.
        onto_plane: bool,
    },
    /// A one-, two- or three-point perspective (ONE-1, TWO-1, THREE-1).
    NPoint {
        /// Its p, q and r.
        projection: NPoint,
        /// True if z is dropped.
        onto_plane: bool,
    },
    /// The perspective projection from the origin onto a plane z = const: w = z / `plane_z`
    /// (Foley, van Dam and others 1990, equation 6.5).
    CentralOntoPlane {
        /// The plane of the picture; negative ahead of a camera that looks along −z.
        plane_z: f64,
        /// True if z is dropped.
        onto_plane: bool,
    },
    /// A camera and a perspective: world to clip space.
    CameraPerspective {
        /// Where the camera is.
        camera: CameraReading,
        /// Window on the near plane, near and far as distances.
        frustum: Frustum,
        /// Its angles.
        lens: Lens,
        /// The convention in which it has these parameters; the world is as right- or left-handed
        /// as its view space.
        convention: Convention,
    },
    /// A perspective and a viewport in one, of a window around the line of sight: view or world
    /// space to pixels (PL-1).
    PerspectiveToPixels {
        /// Width and height in pixels; depth is left as it is.
        size: [f64; 2],
        /// True if rows count from the top.
        y_down: bool,
        /// True if pixel centers have integer coordinates.
        integer_centers: bool,
        /// Where the camera is, unless the map begins in view space.
        camera: Option<CameraReading>,
        /// Window on the near plane, near and far as distances.
        frustum: Frustum,
        /// Its angles.
        lens: Lens,
        /// The convention in which it has these parameters.
        convention: Convention,
    },
    /// A camera and an orthographic box; the eye, which may be anywhere, is taken at the origin.
    CameraOrthographic {
        /// How the camera is turned.
        camera: CameraReading,
        /// Window, near and far as distances.
        volume: Orthographic,
        /// The convention in which it has these parameters; the world is as right- or left-handed
        /// as its view space.
        convention: Convention,
    },
    /// An affine map without a name.
    Affine,
    /// A projective map without a name.
    Projective,
}

impl MatrixMeaning {
    /// False for the maps of which nothing but their kind is known.
    #[must_use]
    pub const fn is_named(&self) -> bool {
        !matches!(self, Self::Affine | Self::Projective)
    }

    /// The convention in which the parameters hold, if the meaning has one.
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
