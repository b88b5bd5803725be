//! Surface cache: the welded surfaces of a sheet, one for each combination of sections shown in its
//! views.
//!
//! Welding and finding intersections depend on the models and sections, not on the viewer. The
//! three principal views of an uncut object share one surface, but a sectional view needs a
//! separate surface.

use hidden_line::WeldedSurface;
use homog::{Plane, World};
use model::ModelInstance;

/// Welded surfaces of the same models, keyed by the section planes that cut them.
pub(super) struct SurfaceCache<'a> {
    models: &'a [ModelInstance],
    /// The objects that sections do not cut.
    uncut: &'a [u32],
    /// The surfaces in the order of first use. A sheet has few views, so a linear search is cheap.
    surfaces: Vec<(Vec<Plane<World>>, WeldedSurface)>,
}

impl<'a> SurfaceCache<'a> {
    /// Creates an empty cache for the given models.
    pub(super) fn new(models: &'a [ModelInstance], uncut: &'a [u32]) -> Self {
        Self { models, uncut, surfaces: Vec::new() }
    }

    /// Returns the surface cut by the given planes, which is welded on demand.
    pub(super) fn cut_by(&mut self, sections: &[Plane<World>]) -> &WeldedSurface {
        let cached = self.surfaces.iter().position(|(planes, _)| planes == sections);
        let index = cached.unwrap_or_else(|| {
            self.surfaces
                .push((sections.to_vec(), WeldedSurface::new(self.models, sections, self.uncut)));
            self.surfaces.len() - 1
        });
        &self.surfaces[index].1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homog::{Normal, Point};

    #[test]
    fn views_with_the_same_sections_share_a_surface() {
        let plane = Plane::through(Point::ORIGIN, Normal::new(0.0, 0.0, 1.0));
        let mut cache = SurfaceCache::new(&[], &[]);
        for sections in [&[][..], &[plane], &[], &[plane]] {
            assert!(cache.cut_by(sections).object_names().is_empty());
        }
        assert_eq!(cache.surfaces.len(), 2);
        assert_eq!(cache.surfaces[1].0, [plane]);
    }
}
