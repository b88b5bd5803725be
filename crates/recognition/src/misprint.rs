//! Known misprints of projection matrices, and their corrections.
//!
//! Some of these matrices are misprinted in books, lessons and slides, and programs copy the
//! errors. [`misprint_of`] compares a matrix with all known misprints of the intended projection,
//! so its result is certain. [`crate::recognize`] has only the sixteen numbers, so it weighs
//! misprints against other readings.

use glam::{DMat4, DVec4};
use homog::{Clip, Projective, View};
use projection::{ApexMovedFrustum, Convention, Frustum, Orthographic, Perspective};

/// A known misprint. Most descriptions begin with the number of the misprint, from M1 to M28, and
/// its row in the formula collection's table of misprints, in parentheses.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
#[non_exhaustive]
pub enum Misprint {
    /// M4 (7): P is missing from M_vp M_orth P M_cam; w stays 1 and nothing is foreshortened.
    PerspectiveLeftOut,
    /// M6 (9): the third row of a translation repeats t_y where t_z belongs.
    RepeatedTranslation,
    /// M8 (16): the textbook's depth (near +1; Shirley and Marschner, ch. 8) where OpenGL's depth
    /// (near −1) is intended, or vice versa.
    DepthReversed,
    /// M8, PE-3: the textbook's original sign, with w < 0 in front of the eye.
    NegativeW,
    /// M11 (18): the third row of M_cam's translation is (0, 0, 0, −z_e), so every z becomes the
    /// same.
    ThirdRowFlat,
    /// M12 (32): the offsets are in the fourth column, so the matrix is not glFrustum but a
    /// projection with its apex moved (LW-1).
    ApexMoved,
    /// M14 (26): the bottom row is (0, 0, −1, 1) instead of (0, 0, −1, 0). For a camera that looks along
    /// +z, it is (0, 0, 1, 1).
    BottomRowOne,
    /// M15 (33): the depth offset of Ortho has the wrong sign, so near and far map outside [−1, 1].
    OrthoOffsetSign,
    /// M16 (34): (right − left)/(right − left) = 1 instead of (right + left)/(right − left).
    FrustumOffsetOne,
    /// M17 (35): tan(fovy)/2 instead of tan(fovy/2).
    HalfOfTangent,
    /// M19 (43): the angle is in degrees instead of radians.
    Degrees,
    /// The last row has the wrong sign: w is the distance behind the eye, but the depth row is for
    /// points in front of it.
    LastRowNegated,
    /// One entry has the wrong sign.
    WrongSign,
    /// One row, but not the last, has the wrong sign.
    RowNegated,
    /// Two entries are exchanged.
    EntriesExchanged,
    /// Two rows are exchanged.
    RowsExchanged,
    /// Two columns are exchanged.
    ColumnsExchanged,
    /// (24): the matrix is for row vectors but is used with column vectors.
    Transposed,
}

/// The intended projection, in OpenGL's convention.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum IntendedProjection {
    /// glFrustum.
    Frustum(Frustum),
    /// gluPerspective.
    Perspective(Perspective),
    /// glOrtho.
    Orthographic(Orthographic),
}

impl Misprint {
    /// All misprints.
    pub const ALL: [Self; 18] = [
        Self::PerspectiveLeftOut,
        Self::RepeatedTranslation,
        Self::DepthReversed,
        Self::NegativeW,
        Self::ThirdRowFlat,
        Self::ApexMoved,
        Self::BottomRowOne,
        Self::OrthoOffsetSign,
        Self::FrustumOffsetOne,
        Self::HalfOfTangent,
        Self::Degrees,
        Self::LastRowNegated,
        Self::WrongSign,
        Self::RowNegated,
        Self::EntriesExchanged,
        Self::RowsExchanged,
        Self::ColumnsExchanged,
        Self::Transposed,
    ];

    /// Returns the number of the misprint, from M1 to M28, or `None` if it is unnumbered.
    #[must_use]
    pub const fn id(self) -> Option<&'static str> {
        match self {
            Self::PerspectiveLeftOut => Some("M4"),
            Self::RepeatedTranslation => Some("M6"),
            Self::DepthReversed | Self::NegativeW => Some("M8"),
            Self::ThirdRowFlat => Some("M11"),
            Self::ApexMoved => Some("M12"),
            Self::BottomRowOne => Some("M14"),
            Self::OrthoOffsetSign => Some("M15"),
            Self::FrustumOffsetOne => Some("M16"),
            Self::HalfOfTangent => Some("M17"),
            Self::Degrees => Some("M19"),
            Self::LastRowNegated
            | Self::WrongSign
            | Self::RowNegated
            | Self::EntriesExchanged
            | Self::RowsExchanged
            | Self::ColumnsExchanged
            | Self::Transposed => None,
        }
    }

    /// Returns whether one step undoes the misprint: a sign flipped, a row negated, or an exchange.
    #[must_use]
    pub const fn takes_one_step(self) -> bool {
        matches!(
            self,
            Self::LastRowNegated
                | Self::WrongSign
                | Self::RowNegated
                | Self::EntriesExchanged
                | Self::RowsExchanged
                | Self::ColumnsExchanged
        )
    }

    /// Returns a description of the error, in one sentence.
    #[must_use]
    pub const fn description(self) -> &'static str {
        match self {
            Self::PerspectiveLeftOut => {
                "P is missing: w stays 1, so dividing by it foreshortens nothing"
            }
            Self::RepeatedTranslation => {
                "the third row repeats the second row's offset: t_y where t_z belongs"
            }
            Self::DepthReversed => "x and y are correct, but near and far are swapped in depth",
            Self::NegativeW => "w is negative in front of the eye",
            Self::ThirdRowFlat => {
                "the third row ignores z: every point gets the same depth, and there is no inverse"
            }
            Self::ApexMoved => {
                "the offsets are in the last column: the apex moves behind the window's center"
            }
            Self::BottomRowOne => "the last entry is 1 instead of 0, so w is the distance plus 1",
            Self::OrthoOffsetSign => {
                "the depth offset has the wrong sign: the box appears to be behind the eye"
            }
            Self::FrustumOffsetOne => {
                "the x offset is 1, which is correct only for a window that begins at 0"
            }
            Self::HalfOfTangent => "the tangent was halved instead of the angle",
            Self::Degrees => "the angle was read as radians but is in degrees",
            Self::LastRowNegated => {
                "the last row is negated: w does not match the depth row, so no plane in \
                 front of the eye maps to the near or far depth"
            }
            Self::WrongSign => "one entry has the wrong sign",
            Self::RowNegated => "one row has the wrong sign",
            Self::EntriesExchanged => "two entries are exchanged",
            Self::RowsExchanged => "two rows are exchanged",
            Self::ColumnsExchanged => "two columns are exchanged",
            Self::Transposed => "rows and columns are swapped: this matrix is for row vectors",
        }
    }

    /// Returns the remedy, in one sentence.
    #[must_use]
    pub const fn remedy(self) -> &'static str {
        match self {
            Self::PerspectiveLeftOut => "use M_per = M_orth P instead of M_orth",
            Self::RepeatedTranslation => "end the third row with t_z",
            Self::DepthReversed => {
                "multiply by diag(1, 1, −1, 1) on the left, or name the intended convention"
            }
            Self::NegativeW => "multiply the matrix by −1 before clipping; the map stays the same",
            Self::ThirdRowFlat => "make the translation's third row (0, 0, 1, −z)",
            Self::ApexMoved => {
                "for an eye at the origin, put (right+left)/(right−left) into the third column; \
                 keep the matrix if the apex is meant to move"
            }
            Self::BottomRowOne => "set the last entry to 0",
            Self::OrthoOffsetSign => "end the third row with −(far+near)/(far−near)",
            Self::FrustumOffsetOne => "make the first row's third entry (right+left)/(right−left)",
            Self::HalfOfTangent => "use the entries 1/(aspect tan(fovy/2)) and 1/tan(fovy/2)",
            Self::Degrees => "convert first: radians = degrees π/180",
            Self::LastRowNegated => "negate the last row",
            Self::WrongSign => "flip the sign of this entry",
            Self::RowNegated => "negate this row",
            Self::EntriesExchanged => "exchange these two entries",
            Self::RowsExchanged => "exchange these two rows",
            Self::ColumnsExchanged => "exchange these two columns",
            Self::Transposed => "transpose the matrix",
        }
    }

    /// Returns the intended matrix with this misprint, or `None` if the misprint does not apply.
    #[must_use]
    pub fn misprinted_matrix(self, wanted: IntendedProjection) -> Option<Projective<View, Clip>> {
        self.misprint(wanted.correct_matrix().raw(), wanted).map(Projective::from_raw)
    }

    fn misprint(self, right: DMat4, wanted: IntendedProjection) -> Option<DMat4> {
        match (self, wanted) {
            (Self::Transposed, _) => Some(right.transpose()),
            (Self::DepthReversed, _) => {
                Some(DMat4::from_diagonal(DVec4::new(1.0, 1.0, -1.0, 1.0)) * right)
            }
            (Self::OrthoOffsetSign, IntendedProjection::Orthographic(_)) => {
                Some(with_entry(right, 2, 3, -right.w_axis.z))
            }
            (_, IntendedProjection::Orthographic(_)) => None,
            (Self::HalfOfTangent, IntendedProjection::Perspective(lens)) => {
                with_half_tangent(lens, right)
            }
            (Self::Degrees, IntendedProjection::Perspective(lens)) => {
                with_degrees_as_radians(lens, right)
            }
            (Self::NegativeW, _) => Some(-right),
            (Self::LastRowNegated, _) => Some(with_entry(right, 3, 2, -right.z_axis.w)),
            (Self::BottomRowOne, _) => Some(with_entry(right, 3, 3, 1.0)),
            (Self::PerspectiveLeftOut, _) => without_p(wanted.frustum()?),
            (Self::ApexMoved, _) => apex_moved(wanted.frustum()?),
            (Self::FrustumOffsetOne, IntendedProjection::Frustum(_)) => {
                Some(with_entry(right, 0, 2, 1.0))
            }
            (
                Self::ThirdRowFlat
                | Self::RepeatedTranslation
                | Self::FrustumOffsetOne
                | Self::HalfOfTangent
                | Self::Degrees
                | Self::WrongSign
                | Self::RowNegated
                | Self::EntriesExchanged
                | Self::RowsExchanged
                | Self::ColumnsExchanged
                | Self::OrthoOffsetSign,
                _,
            ) => None,
        }
    }
}

impl IntendedProjection {
    /// Returns the correct matrix, in OpenGL's convention.
    #[must_use]
    pub fn correct_matrix(self) -> Projective<View, Clip> {
        let c = Convention::OPENGL;
        match self {
            Self::Frustum(frustum) => frustum.view_to_clip(c),
            Self::Perspective(lens) => lens.view_to_clip(c),
            Self::Orthographic(volume) => volume.view_to_clip(c),
        }
    }

    fn frustum(self) -> Option<Frustum> {
        match self {
            Self::Frustum(frustum) => Some(frustum),
            Self::Perspective(lens) => Some(lens.to_frustum()),
            Self::Orthographic(_) => None,
        }
    }
}

fn with_entry(matrix: DMat4, row: usize, column: usize, value: f64) -> DMat4 {
    let mut changed = matrix;
    changed.col_mut(column)[row] = value;
    changed
}

fn with_scale(matrix: DMat4, scale_x: f64, scale_y: f64) -> DMat4 {
    with_entry(with_entry(matrix, 0, 0, scale_x), 1, 1, scale_y)
}

fn with_half_tangent(lens: Perspective, right: DMat4) -> Option<DMat4> {
    let half = libm::tan(lens.fov_y()) / 2.0;
    let printed = with_scale(right, 1.0 / (half * lens.aspect()), 1.0 / half);
    printed.is_finite().then_some(printed)
}

fn with_degrees_as_radians(lens: Perspective, right: DMat4) -> Option<DMat4> {
    let half = libm::tan(0.5 * lens.fov_y().to_degrees());
    let printed = with_scale(right, 1.0 / (half * lens.aspect()), 1.0 / half);
    printed.is_finite().then_some(printed)
}

fn without_p(frustum: Frustum) -> Option<DMat4> {
    let volume = Orthographic::from_window(frustum.window(), frustum.near(), frustum.far()).ok()?;
    Some(volume.view_to_clip(Convention::OPENGL).raw())
}

fn apex_moved(frustum: Frustum) -> Option<DMat4> {
    let (w, near, far) = (frustum.window(), frustum.near(), frustum.far());
    let lesson = ApexMovedFrustum::new(w.left(), w.right(), w.bottom(), w.top(), near, far).ok()?;
    Some(lesson.view_to_clip(Convention::OPENGL).raw())
}

/// Returns the misprint that turns the intended matrix into `view_to_clip`, or `None` if that
/// matrix is correct up to a positive factor or wrong in an unknown way. Entries may differ by one
/// part in a million, as in f32 programs.
///
/// ```
/// use projection::Orthographic;
/// use recognition::{Misprint, IntendedProjection, misprint_of};
/// let volume = Orthographic::new(-1.0, 3.0, -2.0, 1.0, 2.0, 6.0)?;
/// let wanted = IntendedProjection::Orthographic(volume);
/// let mut rows = wanted.correct_matrix().rows();
/// rows[2][3] = 2.0; // + (far + near)/(far − near)
/// let slide = homog::Projective::from_rows(rows);
/// assert_eq!(misprint_of(slide, wanted), Some(Misprint::OrthoOffsetSign));
/// # Ok::<(), projection::ProjectionError>(())
/// ```
#[must_use]
pub fn misprint_of(
    view_to_clip: Projective<View, Clip>,
    wanted: IntendedProjection,
) -> Option<Misprint> {
    let (matrix, right) = (view_to_clip.raw(), wanted.correct_matrix().raw());
    if nearly_equal(matrix, right) {
        return None;
    }
    Misprint::ALL.into_iter().find(|misprint| {
        misprint.misprint(right, wanted).is_some_and(|printed| nearly_equal(matrix, printed))
    })
}

/// Returns whether two matrices are equal up to a positive factor, within one part in a million.
fn nearly_equal(ours: DMat4, theirs: DMat4) -> bool {
    let size =
        |m: DMat4| m.to_cols_array().iter().fold(0.0, |size: f64, entry| size.max(entry.abs()));
    let (a, b) = (ours * (1.0 / size(ours)), theirs * (1.0 / size(theirs)));
    a.is_finite() && (a - b).to_cols_array().iter().all(|gap| gap.abs() < 1e-6)
}
