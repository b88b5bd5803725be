//! Section planes in a scene file.

use crate::number::Triple;
use crate::schema::scene_struct;

scene_struct! {
    /// A section plane that cuts the models open. Line drawings and sheets show the section; other
    /// styles show the models whole.
    pub struct SectionFile as "Section" {
        /// A point on the plane, in world space. Default: the origin.
        pub point: Triple = Triple::ZERO,
        /// The plane's normal, which points into the half that is removed. Its length does not
        /// matter but must not be 0.
        pub normal: Triple,
        /// The names of nodes, such as shafts, bolts and ribs, that no section cuts. They and their
        /// descendants are drawn whole, without hatching. `*` matches any characters. The lists of
        /// all sections are combined. Default: none.
        pub uncut: Vec<String> = Vec::new(),
    }
}

impl SectionFile {
    /// Creates a section plane through `point` that removes the half into which `normal` points.
    /// Returns `None` if a number is not finite or `normal` is 0.
    #[must_use]
    pub fn new(point: [f64; 3], normal: [f64; 3]) -> Option<Self> {
        let is_finite = point.iter().chain(&normal).all(|number| number.is_finite());
        let has_direction = normal.iter().any(|number| *number != 0.0);
        (is_finite && has_direction).then_some(Self {
            point: Triple(point),
            normal: Triple(normal),
            uncut: Vec::new(),
        })
    }
}
