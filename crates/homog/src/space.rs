//! Types for the spaces that a point passes through to reach the screen, and a macro for more.
//!
//! ```text
//! Model ──► World ──► View ──► Clip ──÷w──► Ndc ──► Screen
//! ```
//!
//! A space is a tag without values that costs nothing at run time. Adding a world vector to a view
//! point, or passing clip coordinates to the viewport, is a compile error.

use core::fmt::Debug;

/// A coordinate space: one of the six tags of this crate, or one declared by
/// [`space!`](crate::space).
pub trait Space: Copy + Clone + PartialEq + Debug + Send + Sync + 'static {
    /// The space of a homogeneous point after the divide by w: `Ndc` for `Clip`, and the space
    /// itself otherwise.
    type Divided: Space;
    /// The name shown in tables and messages.
    const NAME: &'static str;
}

/// Declares a coordinate space, for example for a light, a bone or a second world.
///
/// ```
/// use homog::{Affine, Point, World};
/// homog::space!(
///     /// The space of a lamp, which shines along its −z axis.
///     pub Lamp, "lamp"
/// );
/// let world_to_lamp = Affine::<World, Lamp>::translation([0.0, -3.0, 0.0].into());
/// let p: Point<Lamp> = world_to_lamp * Point::<World>::new(1.0, 3.0, 0.0);
/// assert_eq!(p, Point::new(1.0, 0.0, 0.0));
/// ```
///
/// A third argument names the space after the divide, for clip spaces: `space!(LampClip, "lamp
/// clip", LampNdc)`.
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
    /// The coordinates in which a model was created.
    pub Model, "Model"
}
space! {
    /// The common space of all models, lights and cameras: right-handed, in any unit.
    pub World, "World"
}
space! {
    /// Camera space: right-handed, with the eye at the origin looking along −z, x to the right and
    /// y up.
    pub View, "View"
}
space! {
    /// Homogeneous coordinates after the projection and before the divide. Visible points have w >
    /// 0 and −w ≤ x, y, z ≤ w (or the range of the convention in use).
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
