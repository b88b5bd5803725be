//! Plane outcomes: the planes that clipped or rejected a shape.

use crate::{Outcode, PlaneIndex};

/// The effect of one plane on a shape.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum PlaneOutcome {
    /// The plane removed nothing.
    Accepted,
    /// The plane removed a part.
    Clipped,
    /// The plane removed everything that was left when it was applied.
    Rejected,
}

/// The effects of all planes of a volume on a shape.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
#[non_exhaustive]
pub struct PlaneOutcomes {
    /// The planes that removed a part.
    pub clipped: Outcode,
    /// The planes that rejected the shape: every plane that the whole shape is outside of or, if
    /// there is no such plane, the planes after which nothing remained.
    pub rejected: Outcode,
}

impl PlaneOutcomes {
    /// Returns the effect of this plane.
    #[must_use]
    pub fn outcome_of(self, plane: PlaneIndex) -> PlaneOutcome {
        if self.rejected.contains(plane) {
            PlaneOutcome::Rejected
        } else if self.clipped.contains(plane) {
            PlaneOutcome::Clipped
        } else {
            PlaneOutcome::Accepted
        }
    }

    pub(crate) fn from_rejected(by: Outcode) -> Self {
        Self { clipped: Outcode::INSIDE, rejected: by }
    }
}
