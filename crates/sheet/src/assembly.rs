//! Assemblies: the parts of models, their list, their masses, and the moves that part them.
//!
//! ```text
//!   models ─part─► parts ─geometry─► equal ones ─parts_list─► items: number, quantity, name …
//!                    │                                           │
//!                    └─explosion─► moves ─exploded_models─┐      └─part_model─► one sheet each
//!                                                         ▼
//!                                      exploded view with the paths of the parts
//! ```
//!
//! A part is a node with a mesh, once for each of its instances. Objects of drawings are the same
//! nodes in the same order.

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

/// The pages of a sheet that show its models as an assembly of parts. Default: none.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct AssemblyPages {
    /// Whether a parts list is drawn: on the page of the assembly if it fits there, else on pages
    /// of its own.
    pub parts_list: bool,
    /// Whether a page shows the assembly with the number of each item of the list in a balloon.
    pub balloons: bool,
    /// How far the parts are moved apart on that page; `None` for parts in their places. An
    /// exploded view has a page with or without balloons.
    pub explosion: Option<ExplosionSettings>,
    /// Whether each item of the list has a page with its principal views.
    pub part_sheets: bool,
    /// The densities from which the masses of the list follow; without any it has no masses.
    pub densities: Vec<PartDensity>,
}

impl AssemblyPages {
    /// Whether the assembly has a page with a view.
    #[must_use]
    pub const fn has_view(&self) -> bool {
        self.balloons || self.explosion.is_some()
    }

    /// Whether it has any page.
    #[must_use]
    pub const fn has_pages(&self) -> bool {
        self.has_view() || self.parts_list || self.part_sheets
    }
}
