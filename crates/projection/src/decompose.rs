//! Recovers the projection from a 4×4 matrix.
//!
//! ```text
//!                         last row (p, q, r, s)
//!            ┌────────────────────┴──────────────────────┐
//!      p = q = r = 0: parallel                      else: central
//!      rows at right angles?                        eye: where x, y and w vanish
//!        unrotated    → orthographic                  at the origin, unrotated → frustum
//!        rotated      → axonometric, placed           elsewhere, centered     → apex moved (LW-1)
//!      z in x and y   → oblique                       anywhere, rotated      → placed
//!      no inverse     → classical: the center is the null vector of the matrix
//! ```
//!
//! A matrix and its multiples define the same map, so a common factor is removed first and
//! reported. A matrix does not identify its convention: the OpenGL matrix of (N, F) is the
//! zero-to-one matrix of (2FN/(F+N), F). Therefore the caller must specify the convention;
//! [`readings`] tries all named conventions.

use crate::placement::{self, Placement};
use crate::{
    ApexMovedFrustum, Axonometric, Classical, Convention, Frustum, NPoint, Oblique, Orthographic,
    ProjectionError, Window,
};
use glam::{DMat4, DVec3, DVec4};
use homog::{Affine, Clip, HPoint, Normal, Plane, Projective, View};
use thiserror::Error;

/// The projection that a matrix was recognized as.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Decomposed {
    /// A perspective projection from the origin. If its window is centered, it converts to
    /// [`crate::Perspective`].
    Frustum(Frustum),
    /// The frustum of the WebGL lesson, whose apex is not at the origin (LW-1).
    ApexMoved(ApexMovedFrustum),
    /// A perspective projection from another position or orientation: a camera and a lens in one
    /// matrix.
    PlacedFrustum {
        /// The map to camera space.
        placement: Affine<View, View>,
        /// The lens.
        frustum: Frustum,
    },
    /// A perspective projection whose near plane is inclined (Lengyel).
    ObliqueNear {
        /// The map to camera space; the identity if there is no camera.
        placement: Affine<View, View>,
        /// The window at distance 1 in front of the eye.
        slopes: Window,
        /// The near plane in camera space; its normal has length 1 and points to the visible side.
        near_plane: Plane<View>,
    },
    /// An axis-aligned box.
    Orthographic(Orthographic),
    /// A depth-preserving classical projection, and its view volume.
    Classical {
        /// The projection.
        projection: Classical,
        /// The window on the picture, and the near and far planes.
        volume: Orthographic,
    },
    /// An orthographic projection whose rotation is not axonometric: a camera and a box in one
    /// matrix.
    PlacedOrthographic {
        /// The map to camera space.
        placement: Affine<View, View>,
        /// The box.
        volume: Orthographic,
    },
    /// The depth-preserving map of an n-point perspective, without a view volume.
    NPoint(NPoint),
    /// A singular classical projection, which drops a dimension.
    Flat {
        /// The center of projection, which is the null vector of the matrix. Its w is 0 if the
        /// projectors are parallel.
        center: HPoint<View>,
        /// The projection, if it drops z in one of the known ways.
        projection: Option<Classical>,
    },
}

/// The result of [`decompose`].
#[derive(Clone, Copy, PartialEq, Debug)]
#[non_exhaustive]
pub struct Decomposition {
    /// The projection, with the factor removed.
    pub kind: Decomposed,
    /// The common factor that was removed. It is negative if w is negative in front of the eye, as
    /// in M_per of the textbook (Shirley and Marschner, ch. 8): divide by it before clipping
    /// (PE-3).
    pub factor: f64,
}

impl Decomposition {
    /// Returns whether the parts that were not checked by a builder are finite.
    fn is_finite(&self) -> bool {
        let kind = match self.kind {
            Decomposed::PlacedFrustum { placement, .. }
            | Decomposed::PlacedOrthographic { placement, .. } => placement.is_finite(),
            Decomposed::ObliqueNear { placement, near_plane, .. } => {
                placement.is_finite() && near_plane.raw().is_finite()
            }
            Decomposed::Flat { center, .. } => center.is_finite(),
            _ => true,
        };
        kind && self.factor.is_finite()
    }
}

/// The reason why a matrix is not a projection in the given convention.
#[derive(Clone, Copy, PartialEq, Debug, Error)]
#[non_exhaustive]
pub enum DecomposeError {
    /// An entry is NaN or infinite.
    #[error("the entry in row {row}, column {column} is not a finite number")]
    NotFinite {
        /// The row, counted from 0.
        row: usize,
        /// The column, counted from 0.
        column: usize,
    },
    /// More than one dimension is lost.
    #[error("the matrix has rank {rank}; a projection has rank 3 or 4")]
    RankTooLow {
        /// The rank of the matrix.
        rank: usize,
    },
    /// The x and y axes of the picture are not perpendicular, or the depth depends on the position
    /// in an unknown way.
    #[error(
        "the axes of the picture are not at right angles: \
         no supported projection has this shear"
    )]
    Sheared,
    /// The near and far planes are invalid in this convention.
    #[error(
        "in this convention, near and far would be {near} and {far}, but 0 < near < far is required"
    )]
    DepthRange {
        /// The distance that the matrix maps to the near depth.
        near: f64,
        /// The distance that the matrix maps to the far depth.
        far: f64,
    },
    /// The builder rejects the recovered parameters.
    #[error(transparent)]
    Refused(#[from] ProjectionError),
}

/// Returns the projection that has this matrix (for column vectors) in the given convention.
///
/// ```
/// use projection::{Convention, Decomposed, Frustum, decompose};
/// let made = Frustum::new(-1.0, 3.0, -2.0, 1.0, 2.0, 6.0)?;
/// let rows = made.view_to_clip(Convention::VULKAN).rows().map(|row| row.map(|entry| -5.0 * entry));
/// let found = decompose(homog::Projective::from_rows(rows), Convention::VULKAN)?;
/// assert_eq!(found.factor, -5.0);
/// let Decomposed::Frustum(found) = found.kind else { panic!("a frustum") };
/// assert!((found.far() - 6.0).abs() < 1e-12 && (found.window().left() + 1.0).abs() < 1e-12);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
///
/// # Errors
/// Returns an error if an entry is not finite or the matrix is not a projection in this convention.
pub fn decompose(
    view_to_clip: Projective<View, Clip>,
    convention: Convention,
) -> Result<Decomposition, DecomposeError> {
    let matrix = view_to_clip.raw();
    check_finite(matrix)?;
    let found = decompose_recognized(matrix, convention)?;
    let lost = ProjectionError::Unrepresentable { what: "projection in this matrix" };
    if found.is_finite() { Ok(found) } else { Err(lost.into()) }
}

fn decompose_recognized(
    matrix: DMat4,
    convention: Convention,
) -> Result<Decomposition, DecomposeError> {
    let largest = matrix.to_cols_array().iter().fold(0.0, |size: f64, entry| size.max(entry.abs()));
    if largest == 0.0 {
        return Err(DecomposeError::RankTooLow { rank: 0 });
    }
    if let Some(rank) = placement::lost_rank(matrix * (1.0 / largest)) {
        return decompose_onto_plane(matrix, rank);
    }
    if let Some((projection, factor)) = bare_npoint(matrix) {
        return Ok(Decomposition { kind: Decomposed::NPoint(projection), factor });
    }
    let last = matrix.row(3);
    if placement::is_negligible(last.truncate(), DVec4::splat(last.w)) {
        let kind = decompose_parallel(matrix * (1.0 / last.w), convention)?;
        return Ok(Decomposition { kind, factor: last.w });
    }
    decompose_central(matrix, convention)
}

/// Returns every named convention in which the matrix is a valid projection, with that projection.
pub fn readings(
    view_to_clip: Projective<View, Clip>,
) -> impl Iterator<Item = (Convention, Decomposition)> {
    let named = [
        Convention::OPENGL,
        Convention::CHAPTER,
        Convention::WEBGPU,
        Convention::WEBGPU.reversed(),
        Convention::VULKAN,
        Convention::VULKAN.reversed(),
        Convention::DIRECT3D,
        Convention::DIRECT3D.reversed(),
        Convention::OPENGL.left_handed(),
    ];
    named.into_iter().filter_map(move |c| Some((c, decompose(view_to_clip, c).ok()?)))
}

fn check_finite(matrix: DMat4) -> Result<(), DecomposeError> {
    for row in 0..4 {
        for column in 0..4 {
            if !matrix.col(column)[row].is_finite() {
                return Err(DecomposeError::NotFinite { row, column });
            }
        }
    }
    Ok(())
}

/// Recognizes the identity with (p, q, r, 1) as its bottom row, up to a factor.
fn bare_npoint(matrix: DMat4) -> Option<(NPoint, f64)> {
    let factor = matrix.w_axis.w;
    let unit = matrix * (1.0 / factor);
    let bare = unit.row(0) == DVec4::X && unit.row(1) == DVec4::Y && unit.row(2) == DVec4::Z;
    let [p, q, r, _] = unit.row(3).to_array();
    Some((NPoint::new(p, q, r).ok()?, factor)).filter(|_| bare)
}

/// Decomposes a matrix of rank 3, whose null vector is the center of projection.
fn decompose_onto_plane(matrix: DMat4, rank: usize) -> Result<Decomposition, DecomposeError> {
    let center = placement::null_vector(matrix)
        .filter(|_| rank == 3)
        .ok_or(DecomposeError::RankTooLow { rank })?;
    let (x, y, w) = (matrix.row(0), matrix.row(1), matrix.row(3));
    let factor = if w.w == 0.0 { 1.0 } else { w.w };
    let drops_z = matrix.row(2) == DVec4::ZERO;
    let projection =
        if drops_z { recognize_onto_plane(x / factor, y / factor, w / factor) } else { None };
    Ok(Decomposition {
        kind: Decomposed::Flat { center: HPoint::from_raw(center), projection },
        factor,
    })
}

/// Returns the classical projection that has these rows and drops z.
fn recognize_onto_plane(x: DVec4, y: DVec4, w: DVec4) -> Option<Classical> {
    if x == DVec4::X && y == DVec4::Y && w != DVec4::W {
        return NPoint::new(w.x, w.y, w.z).ok().map(Into::into).filter(|_| w.w == 1.0);
    }
    if w != DVec4::W || x.w != 0.0 || y.w != 0.0 {
        return None;
    }
    if x.truncate().with_z(0.0) == DVec3::X && y.truncate().with_z(0.0) == DVec3::Y {
        let direction = homog::Vector::new(x.z, y.z, -1.0);
        return Oblique::by_direction(direction, 0.0).ok().map(Into::into);
    }
    let (x, y) = (x.truncate(), y.truncate());
    upright_axonometric([x, y, x.cross(y)]).map(Into::into)
}

/// Returns the axonometric projection whose rotation has these rows, if any.
fn upright_axonometric([x, y, z]: [DVec3; 3]) -> Option<Axonometric> {
    let axonometric = Axonometric::by_normal(Normal::from_raw(z)).ok()?;
    let turn = axonometric.depth_preserving().raw();
    let same = |row: usize, ours: DVec3| (turn.row(row).truncate() - ours).length() < 1e-9;
    (same(0, x) && same(1, y) && same(2, z)).then_some(axonometric)
}

/// Decomposes a parallel projection, in which w = 1 everywhere.
fn decompose_parallel(matrix: DMat4, convention: Convention) -> Result<Decomposed, DecomposeError> {
    let mut columns = matrix;
    columns.z_axis *= -convention.ahead();
    // From here on, the camera looks along −z.
    let (x, y, z) = (columns.row(0), columns.row(1) * convention.top(), columns.row(2));
    if placement::maps_axes_separately(x, y, z) {
        let volume = decompose_upright_box(x.x, x.w, y.y, y.w, (-z.z, z.w), convention)?;
        let (slant_x, slant_y) = (x.z / x.x, y.z / y.y);
        if slant_x == 0.0 && slant_y == 0.0 {
            return Ok(Decomposed::Orthographic(volume));
        }
        let direction = homog::Vector::new(slant_x, slant_y, -1.0);
        let projection = Oblique::by_direction(direction, 0.0)?.into();
        return Ok(Decomposed::Classical { projection, volume });
    }
    decompose_rotated_box([x, y, z], convention)
}

/// Decomposes x' = ax x + tx, y' = ay y + ty, depth' = factor D + offset, where `depth` is
/// (factor, offset).
fn decompose_upright_box(
    ax: f64,
    tx: f64,
    ay: f64,
    ty: f64,
    depth: (f64, f64),
    convention: Convention,
) -> Result<Orthographic, DecomposeError> {
    let (factor, offset) = depth;
    let near = (convention.near_depth() - offset) / factor;
    let far = (convention.far_depth() - offset) / factor;
    let window = Window::new((-1.0 - tx) / ax, (1.0 - tx) / ax, (-1.0 - ty) / ay, (1.0 - ty) / ay)?;
    Ok(Orthographic::from_window(window, near, far)?)
}

fn decompose_rotated_box(
    rows: [DVec4; 3],
    convention: Convention,
) -> Result<Decomposed, DecomposeError> {
    let [x, y, z] = rows.map(DVec4::truncate);
    let right = placement::unit_vector(x).ok_or(DecomposeError::Sheared)?;
    let out = placement::unit_vector(right.cross(y)).ok_or(DecomposeError::Sheared)?;
    let up = out.cross(right);
    let square = placement::is_perpendicular(y, right)
        && placement::is_perpendicular(z, right)
        && placement::is_perpendicular(z, up);
    if !square {
        return Err(DecomposeError::Sheared);
    }
    let depth = (-z.dot(out), rows[2].w);
    let volume =
        decompose_upright_box(x.dot(right), rows[0].w, y.dot(up), rows[1].w, depth, convention)?;
    if let Some(axonometric) = upright_axonometric([right, up, out]) {
        return Ok(Decomposed::Classical { projection: axonometric.into(), volume });
    }
    let turn =
        DMat4::from_cols(right.extend(0.0), up.extend(0.0), out.extend(0.0), DVec4::W).transpose();
    let placement = Affine::from_raw(turn).ok_or(DecomposeError::Sheared)?;
    Ok(Decomposed::PlacedOrthographic { placement, volume })
}

/// Decomposes a central projection, in which w varies.
fn decompose_central(
    matrix: DMat4,
    convention: Convention,
) -> Result<Decomposition, DecomposeError> {
    let mut columns = matrix;
    columns.z_axis *= -convention.ahead();
    // From here on, the camera looks along −z, and y points up.
    if convention.top() < 0.0 {
        columns = DMat4::from_diagonal(DVec4::new(1.0, -1.0, 1.0, 1.0)) * columns;
    }
    let last = columns.row(3).truncate();
    let length = homog::Vector::<View>::from_raw(last).length();
    let unturned = placement::is_negligible(last.with_z(0.0), DVec4::splat(last.z));
    let with_factor = |factor: f64| {
        let placement =
            Placement::from_matrix(columns * (1.0 / factor)).ok_or(DecomposeError::Sheared)?;
        Ok(Decomposition { kind: decompose_frustum(placement, convention)?, factor })
    };
    match with_factor(if unturned && last.z > 0.0 { -length } else { length }) {
        // The sign of w is arbitrary: a rotated camera with w < 0 in front of it looks in the
        // opposite direction.
        Err(DecomposeError::DepthRange { near, .. }) if near < 0.0 && !unturned => {
            with_factor(-length)
        }
        found => found,
    }
}

fn decompose_frustum(
    found: Placement,
    convention: Convention,
) -> Result<Decomposed, DecomposeError> {
    let Placement { scale, center, depth, .. } = found;
    let slopes = Window::new(
        (center.x - 1.0) / scale.x,
        (center.x + 1.0) / scale.x,
        (center.y - 1.0) / scale.y,
        (center.y + 1.0) / scale.y,
    )?;
    let along = depth.truncate();
    if !placement::is_negligible(along.with_z(0.0), DVec4::splat(along.length())) {
        let near_plane = inclined_near_plane(depth, convention);
        return Ok(Decomposed::ObliqueNear { placement: found.as_affine(), slopes, near_plane });
    }
    let (near, far) = depth_planes(-depth.z, depth.w, convention)?;
    let frustum = Frustum::from_slopes(slopes, near, far)?;
    Ok(recognize_frustum(found, frustum)
        .unwrap_or(Decomposed::PlacedFrustum { placement: found.as_affine(), frustum }))
}

/// Returns the near plane of a depth row, where z' = w · near depth and w is the distance −z.
fn inclined_near_plane(depth: DVec4, convention: Convention) -> Plane<View> {
    let plane = depth + DVec4::Z * convention.near_depth();
    let inwards = (convention.far_depth() - convention.near_depth()).signum();
    Plane::from_raw(plane * (inwards / plane.truncate().length()))
}

/// Returns the named projection of an unrotated camera whose eye is at the origin, or in the plane
/// z = 0 if the window is centered.
fn recognize_frustum(found: Placement, frustum: Frustum) -> Option<Decomposed> {
    let (eye, w, near) = (found.eye, frustum.window(), frustum.near());
    let size = DVec4::new(w.width(), w.height(), near, 0.0);
    if !found.is_upright() || !placement::is_negligible(DVec3::Z * eye.z, size) {
        return None;
    }
    if placement::is_negligible(eye, size) {
        return Some(Decomposed::Frustum(frustum));
    }
    let centered = placement::is_negligible(found.center.extend(0.0), DVec4::ONE);
    let (l, r) = (w.left() + eye.x, w.right() + eye.x);
    let (b, t) = (w.bottom() + eye.y, w.top() + eye.y);
    let moved = ApexMovedFrustum::new(l, r, b, t, near, frustum.far()).ok()?;
    centered.then_some(Decomposed::ApexMoved(moved))
}

/// Returns the distances at which factor + offset/D equals the near and far depths.
fn depth_planes(
    factor: f64,
    offset: f64,
    convention: Convention,
) -> Result<(f64, f64), DecomposeError> {
    let near = offset / (convention.near_depth() - factor);
    let gap = convention.far_depth() - factor;
    // If rounding hides a very distant far plane, it counts as infinite.
    let endless = gap.abs() <= 16.0 * f64::EPSILON;
    let far = if endless { f64::INFINITY } else { offset / gap };
    let sensible = near > 0.0 && near < far;
    sensible.then_some((near, far)).ok_or(DecomposeError::DepthRange { near, far })
}
