//! The spaces a point passes through on its way to the screen, as types; and how to add one.
//!
//! ```text
//! Model ──► World ──► View ──► Clip ──÷w──► Ndc ──► Screen
//! ```
//!
//! A space is a tag without values. It costs nothing at run time and makes it a compile error to
//! add a world vector to a view point or to hand clip coordinates to the viewport.

use core::fmt::Debug;

/// A coordinate space: one of the six tags of this crate, or one declared by
/// [`space!`](crate::space).
pub trait Space: Copy + Clone + PartialEq + Debug + Send + Sync + 'static {
    /// The space a homogeneous point of this space is in once it has been divided by its w.
    /// `Ndc` for `Clip`, the space itself everywhere else.
    type Divided: Space;
    /// The name people read in tables and messages.
    const NAME: &'static str;
}

/// Declares a coordinate space: of a light, of a bone, of a second world.
///
/// ```
/// use homog::{Affine, Point, World};
/// homog::space!(
///     /// The space of a lamp, which shines along its −z.
///     pub Lamp, "lamp"
/// );
/// let world_to_lamp = Affine::<World, Lamp>::translation([0.0, -3.0, 0.0].into());
/// let p: Point<Lamp> = world_to_lamp * Point::<World>::new(1.0, 3.0, 0.0);
/// assert_eq!(p, Point::new(1.0, 0.0, 0.0));
/// ```
///
/// A third argument is the space after the divide, for clip spaces: `space!(LampClip, "lamp clip",
/// LampNdc)`.
#[macro_export]
macro_rules! space {
    ($(#[$doc:meta])* $visibility:vis $tag:ident, $name:expr) => {
        $crate::space!($(#[$doc])* $visibility $tag, $name, $tag);
    };
    ($(#[$doc:meta])* $visibility:vis $tag:ident, $name:expr, $divided:ty) => {
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Eq, Debug)]
        $visibility enum $tag {}
        impl $crate::Space for $tag {
            type Divided = $divided;
            const NAME: &'static str = $name;
        }
    };
}

space! {
    /// The coordinates a model was made in.
    pub Model, "Model"
}
space! {
    /// The common space of all models, lights and cameras: right-handed, any unit.
    pub World, "World"
}
space! {
    /// Camera space: right-handed, the eye at the origin, x right, y up, looking along −z.
    pub View, "View"
}
space! {
    /// Homogeneous coordinates after the projection and before the divide. Visible points have
    /// w > 0 and −w ≤ x, y, z ≤ w (or the range of the convention at hand).
    pub Clip, "Clip", Ndc
}
space! {
    /// Normalized device coordinates, the canonical view volume: [−1, 1]³ in the pipeline.
    pub Ndc, "Ndc"
}
space! {
    /// Pixels and depth.
    pub Screen, "Screen"
}
