//! Section cuts in a scene file: planes, and which side of each is taken away.

use crate::scene::number::Triple;
use serde::Deserialize;

/// A plane that cuts the models open. Line drawings and sheets show the cut; other styles show the models whole.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(rename = "Section", deny_unknown_fields)]
pub struct SectionFile {
    /// A point of the plane, in the world. Default: the origin.
    #[serde(default)]
    pub point: Triple,
    /// The direction of the side that is taken away, at right angles to the plane; its length does not matter, but is not 0.
    pub normal: Triple,
}

impl SectionFile {
    /// The section through a point that takes away what is in a direction; `None` if a number is none or there is no direction.
    #[must_use]
    pub fn new(point: [f64; 3], normal: [f64; 3]) -> Option<Self> {
        let is_finite = point.iter().chain(&normal).all(|number| number.is_finite());
        let has_direction = normal.iter().any(|number| *number != 0.0);
        (is_finite && has_direction)
            .then_some(Self { point: Triple(point), normal: Triple(normal) })
    }
}
