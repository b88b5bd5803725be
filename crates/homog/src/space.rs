//! The six spaces a point passes through on its way to the screen, as types.
//!
//! ```text
//! Model ──► World ──► View ──► Clip ──÷w──► Ndc ──► Screen
//! ```
//!
//! A space is a tag without values. It costs nothing at run time and makes it a compile error to
//! add a world vector to a view point or to hand clip coordinates to the viewport.

use core::fmt::Debug;

/// A coordinate space: one of the six tags of this module.
pub trait Space: Copy + Clone + PartialEq + Debug + Send + Sync + 'static + sealed::Sealed {
    /// The space a homogeneous point of this space is in once it has been divided by its w.
    /// `Ndc` for `Clip`, the space itself everywhere else.
    type Divided: Space;
    /// The name people read in tables and messages.
    const NAME: &'static str;
}

mod sealed {
    pub trait Sealed {}
}

macro_rules! space {
    ($(#[$doc:meta])* $tag:ident divides to $divided:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Eq, Debug)]
        pub enum $tag {}
        impl sealed::Sealed for $tag {}
        impl Space for $tag {
            type Divided = $divided;
            const NAME: &'static str = stringify!($tag);
        }
    };
}

space! {
    /// The coordinates a model was made in.
    Model divides to Model
}
space! {
    /// The common space of all models, lights and cameras: right-handed, any unit.
    World divides to World
}
space! {
    /// Camera space: right-handed, the eye at the origin, x right, y up, looking along −z.
    View divides to View
}
space! {
    /// Homogeneous coordinates after the projection and before the divide. Visible points have
    /// w > 0 and −w ≤ x, y, z ≤ w (or the range of the convention at hand).
    Clip divides to Ndc
}
space! {
    /// Normalised device coordinates, the canonical view volume: [−1, 1]³ in the pipeline.
    Ndc divides to Ndc
}
space! {
    /// Pixels and depth.
    Screen divides to Screen
}
