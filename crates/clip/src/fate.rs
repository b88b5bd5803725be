//! What each plane did: the reasons behind a result of clipping.

use crate::{Outcode, PlaneIndex};

/// What one plane did to a shape.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Fate {
    /// The plane took nothing away.
    Kept,
    /// The plane took a part away.
    Cut,
    /// The plane took all that was left when its turn came.
    Rejected,
}

/// What every plane of a volume did to a shape.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub struct Fates {
    /// The planes that took a part away.
    pub cut: Outcode,
    /// The planes that took all that was left. Of several only those with the whole shape on their outer side are
    /// named, or, if there is none, the one in whose turn nothing remained.
    pub rejected: Outcode,
}

impl Fates {
    /// What this plane did.
    #[must_use]
    pub fn of(self, plane: PlaneIndex) -> Fate {
        if self.rejected.contains(plane) {
            Fate::Rejected
        } else if self.cut.contains(plane) {
            Fate::Cut
        } else {
            Fate::Kept
        }
    }

    pub(crate) fn rejected(by: Outcode) -> Self {
        Self { cut: Outcode::INSIDE, rejected: by }
    }
}
