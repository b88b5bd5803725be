//! Plane outcomes: which planes clipped or rejected a shape.

use crate::{Outcode, PlaneIndex};

/// The effect of one plane on a shape.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum PlaneOutcome {
    /// The plane took nothing away.
    Accepted,
    /// The plane took a part away.
    Clipped,
    /// The plane took all that was left when its turn came.
    Rejected,
}

/// The effects of all planes of a volume on a shape.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
#[non_exhaustive]
pub struct PlaneOutcomes {
    /// The planes that took a part away.
    pub clipped: Outcode,
    /// The planes that took all that was left. Of several only those with the whole shape on their
    /// outer side are named, or, if there is none, the one in whose turn nothing remained.
    pub rejected: Outcode,
}

impl PlaneOutcomes {
    /// The effect of this plane.
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
