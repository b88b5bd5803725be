//! Assemblies: the parts of models, parts lists, masses and exploded views.
//!
//! ```text
//!   models ─part─► parts ─geometry─► identical ─parts_list─► items: number, quantity, name …
//!                    │                                           │
//!                    └─explosion─► moves ─exploded_models─┐      └─part_model─► one sheet each
//!                                                         ▼
//!                                      exploded view with the paths of the parts
//! ```
//!
//! Each instance of a node with a mesh is a part. The objects of a drawing are the same parts in
//! the same order.

mod explosion;
mod geometry;
mod part;
mod part_model;
mod part_shapes;
mod parts_list;
mod removal;
mod volume;

pub(crate) use explosion::MAX_EXPLODED_PARTS;
pub use explosion::{ExplosionAxis, ExplosionSettings};
pub(crate) use part::{Part, gather_parts};
pub use part_model::explode_models;
pub(crate) use part_model::{PATHS, exploded_models, part_model};
pub(crate) use part_shapes::PartShapes;
pub use parts_list::{PartDensity, PartPlace, PartsList, PartsListItem};

/// The pages of a sheet that show its models as an assembly of parts; by default, there are none.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct AssemblyPages {
    /// Whether to draw a parts list: on the assembly page if it fits there, otherwise on separate
    /// pages.
    pub parts_list: bool,
    /// Whether to add a page that shows the assembly with item numbers in balloons.
    pub balloons: bool,
    /// The settings for moving the parts apart on that page, or `None` to keep them in place. An
    /// exploded view is drawn even without balloons.
    pub explosion: Option<ExplosionSettings>,
    /// Whether to add a page with the principal views of each item in the list.
    pub part_sheets: bool,
    /// The densities used for the masses in the list; if empty, the list has no masses.
    pub densities: Vec<PartDensity>,
}

impl AssemblyPages {
    /// Whether the assembly has a page with a view.
    #[must_use]
    pub const fn has_view(&self) -> bool {
        self.balloons || self.explosion.is_some()
    }

    /// Whether the assembly has any pages.
    #[must_use]
    pub const fn has_pages(&self) -> bool {
        self.has_view() || self.parts_list || self.part_sheets
    }
}
