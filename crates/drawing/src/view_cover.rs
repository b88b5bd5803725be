//! What a view hides of itself as a whole, found before any two things are compared.

use super::edges::WeldedSurface;
use super::hidden_line::{DepthCover, TriangleMesh};
use super::options::{DrawOptions, HiddenEdges};
use super::projector::Projector;
use glam::DVec3;

/// The depths behind which nothing is visible in a view.
pub(super) struct ViewCover {
    pub(super) cover: DepthCover,
    /// Whether it is that of all faces together, up to gaps of some pixels, and not of single ones.
    is_crowd: bool,
}

impl ViewCover {
    /// The cover, if it is that of a crowd.
    pub(super) fn crowd(&self) -> Option<&DepthCover> {
        self.is_crowd.then_some(&self.cover)
    }
}

/// What a surface hides of itself: by all faces if they are a crowd, else by single ones where
/// hidden lines are not drawn.
pub(super) fn view_cover(
    surface: &WeldedSurface,
    projector: Projector,
    size: [u32; 2],
    options: &DrawOptions,
) -> Option<ViewCover> {
    if options.hidden_edges == HiddenEdges::Ignored || options.outline_only {
        return None;
    }
    let crowd = || surface.crowd_cover(projector, size);
    if let Some(cover) = (!options.is_unlimited).then(crowd).flatten() {
        return Some(ViewCover { cover, is_crowd: true });
    }
    let is_removed = options.hidden_edges == HiddenEdges::Removed;
    let cover = is_removed.then(|| surface.depth_cover(projector, size))?;
    (!cover.is_empty()).then_some(ViewCover { cover, is_crowd: false })
}

/// The triangles that hide in a view.
#[derive(Clone, Debug)]
pub(super) struct Occluding<'a> {
    pub(super) surface: &'a WeldedSurface,
    /// Those that are not hidden themselves; `None` for all.
    pub(super) visible: Option<Vec<u32>>,
}

impl Occluding<'_> {
    /// The index of a triangle in the surface.
    fn in_surface(&self, triangle: u32) -> u32 {
        self.visible.as_ref().map_or(triangle, |visible| visible[triangle as usize])
    }
}

impl TriangleMesh for Occluding<'_> {
    fn triangle_count(&self) -> u32 {
        self.visible.as_ref().map_or(self.surface.triangle_count(), |list| list.len() as u32)
    }

    fn vertex_count(&self) -> u32 {
        self.surface.vertex_count()
    }

    fn vertex_indices(&self, triangle: u32) -> [u32; 3] {
        self.surface.vertex_indices(self.in_surface(triangle))
    }

    fn position(&self, vertex: u32) -> DVec3 {
        self.surface.position(vertex)
    }

    fn object(&self, triangle: u32) -> u32 {
        self.surface.object(self.in_surface(triangle))
    }
}
