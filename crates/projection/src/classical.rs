//! Classical projections as matrices for rendering, with depth preserved.
//!
//! The classical projections drop z, so their matrices are singular and visibility cannot be
//! decided. With depth preserved and a view volume around the object, each becomes an ordinary
//! matrix from view space to clip space (PR-1, C89).

use crate::{
    Axonometric, Convention, NPoint, Oblique, Orthographic, Planometric, PrincipalView,
    ProjectionError,
};
use homog::{Affine, Clip, Projective, Space, View};

/// One of the planar projections of the textbooks.
///
/// ```
/// use homog::Point;
/// use projection::{Axonometric, Classical, Convention, Orthographic};
/// let picture = Classical::from(Axonometric::dimetric_42_7());
/// let volume = Orthographic::new(-2.0, 2.0, -2.0, 2.0, -5.0, 5.0)?;
/// let view_to_clip = picture.view_to_clip(volume, Convention::CHAPTER)?;
/// assert_eq!(view_to_clip.transform_point(Point::ORIGIN).divide(), Some(Point::ORIGIN));
/// # Ok::<(), projection::ProjectionError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Classical {
    /// A principal view.
    Multiview(PrincipalView),
    /// An orthographic projection onto an inclined plane.
    Axonometric(Axonometric),
    /// A parallel projection, oblique to the plane z = const.
    Oblique(Oblique),
    /// A parallel projection, oblique to the ground.
    Planometric(Planometric),
    /// A central projection.
    NPoint(NPoint),
}

impl Classical {
    /// Returns the singular matrix of the textbook, which drops z.
    #[must_use]
    pub fn onto_plane(self) -> Projective<View, View> {
        match self {
            Self::Multiview(view) => {
                view.depth_preserving().then(Affine::scale(1.0, 1.0, 0.0)).into()
            }
            Self::Axonometric(axonometric) => axonometric.onto_plane().into(),
            Self::Oblique(oblique) => oblique.onto_plane().into(),
            Self::Planometric(plan) => plan.onto_plane().into(),
            Self::NPoint(perspective) => perspective.onto_plane(),
        }
    }

    /// Returns the depth-preserving variant, in which x and y match the picture and points with
    /// larger z are nearer to the viewer.
    #[must_use]
    pub fn depth_preserving(self) -> Projective<View, View> {
        match self {
            Self::Multiview(view) => view.depth_preserving().into(),
            Self::Axonometric(axonometric) => axonometric.depth_preserving().into(),
            Self::Oblique(oblique) => oblique.depth_preserving().into(),
            Self::Planometric(plan) => plan.depth_preserving().into(),
            Self::NPoint(perspective) => perspective.depth_preserving(),
        }
    }

    /// Returns the inverse of [`depth_preserving`](Self::depth_preserving), in closed form.
    #[must_use]
    pub fn depth_preserving_inverse(self) -> Projective<View, View> {
        match self {
            // Every view is a rotation, so the transpose is the inverse.
            Self::Multiview(view) => {
                Projective::from_raw(view.depth_preserving().raw().transpose())
            }
            Self::Axonometric(axonometric) => axonometric.depth_preserving_inverse().into(),
            Self::Oblique(oblique) => oblique.depth_preserving_inverse().into(),
            Self::Planometric(plan) => plan.depth_preserving_inverse().into(),
            Self::NPoint(perspective) => perspective.depth_preserving_inverse(),
        }
    }

    /// Returns the complete projection.
    ///
    /// `volume` is the visible part of the picture. Its window is in the picture plane, and the
    /// near and far distances are measured from that plane away from the viewer. For perspective
    /// projections, they are measured along the line x = y = 0 before the divide.
    ///
    /// # Errors
    /// Returns an error if the near or far plane of a perspective projection is behind its eye, or
    /// the product of the matrices is out of the range of f64.
    pub fn view_to_clip(
        self,
        volume: Orthographic,
        convention: Convention,
    ) -> Result<Projective<View, Clip>, ProjectionError> {
        let right_handed = convention.right_handed();
        let fit = self.picture_box(volume)?.view_to_clip(right_handed);
        check_finite_map(right_handed.convert(convention, self.depth_preserving().then(fit)))
    }

    /// Returns the inverse of [`view_to_clip`](Self::view_to_clip), in closed form.
    ///
    /// # Errors
    /// See [`view_to_clip`](Self::view_to_clip).
    pub fn clip_to_view(
        self,
        volume: Orthographic,
        convention: Convention,
    ) -> Result<Projective<Clip, View>, ProjectionError> {
        let right_handed = convention.right_handed();
        let unfit = self.picture_box(volume)?.clip_to_view(right_handed);
        let inverse =
            convention.clip_to_clip(right_handed).then(unfit).then(self.depth_preserving_inverse());
        let turn = Affine::<View, View>::scale(1.0, 1.0, right_handed.ahead() * convention.ahead());
        check_finite_map(inverse.then(turn))
    }

    /// Returns the image of the volume after the divide, which is also a box.
    fn picture_box(self, volume: Orthographic) -> Result<Orthographic, ProjectionError> {
        let Self::NPoint(perspective) = self else { return Ok(volume) };
        let image = |parameter, distance: f64| {
            let behind = ProjectionError::OutOfRange {
                parameter,
                value: distance,
                allowed: "in front of the eye, where r z + 1 > 0 with z = −distance",
            };
            perspective.depth_on_axis(-distance).map(|z| -z).ok_or(behind)
        };
        let (near, far) = (image("near", volume.near())?, image("far", volume.far())?);
        Orthographic::from_window(volume.window(), near, far)
    }
}

fn check_finite_map<A: Space, B: Space>(
    map: Projective<A, B>,
) -> Result<Projective<A, B>, ProjectionError> {
    map.is_finite().then_some(map).ok_or(ProjectionError::Unrepresentable { what: "projection" })
}

impl From<PrincipalView> for Classical {
    fn from(view: PrincipalView) -> Self {
        Self::Multiview(view)
    }
}

impl From<Axonometric> for Classical {
    fn from(axonometric: Axonometric) -> Self {
        Self::Axonometric(axonometric)
    }
}

impl From<Oblique> for Classical {
    fn from(oblique: Oblique) -> Self {
        Self::Oblique(oblique)
    }
}

impl From<Planometric> for Classical {
    fn from(plan: Planometric) -> Self {
        Self::Planometric(plan)
    }
}

impl From<NPoint> for Classical {
    fn from(perspective: NPoint) -> Self {
        Self::NPoint(perspective)
    }
}
