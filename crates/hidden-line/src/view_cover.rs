//! Occlusion in a whole view, computed before any two faces are compared.

use super::edges::WeldedSurface;
use super::options::{DrawOptions, HiddenEdges};
use super::projector::Projector;
use super::visibility::{DepthCover, TriangleMesh};
use glam::DVec3;

/// The depths behind which nothing is visible in one view.
pub(super) struct ViewCover {
    pub(super) cover: DepthCover,
    /// Whether the cover is formed by all faces together, up to gaps of a few pixels, not by single
    /// faces.
    is_crowd: bool,
}

impl ViewCover {
    /// Returns the cover if it is formed by a crowd of faces.
    pub(super) fn crowd(&self) -> Option<&DepthCover> {
        self.is_crowd.then_some(&self.cover)
    }
}

/// Computes the cover of a surface. All faces form it together if they are a crowd; otherwise
/// single faces form it, but only if hidden lines are removed.
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

/// The occluding triangles of a view.
#[derive(Clone, Debug)]
pub(super) struct Occluding<'a> {
    pub(super) surface: &'a WeldedSurface,
    /// The occluders used instead of the triangles of the surface if the faces are a crowd.
    pub(super) parts: Option<VisibleParts>,
}

/// The parts of triangles that a crowd does not hide. In a soup of long triangles, an edge meets
/// only a few of these parts.
#[derive(Clone, Debug)]
pub(super) struct VisibleParts {
    corners: Vec<[DVec3; 3]>,
    /// The triangle of the surface that contains each part.
    triangles: Vec<u32>,
}

impl VisibleParts {
    pub(super) fn new(surface: &WeldedSurface, crowd: &DepthCover) -> Self {
        let (corners, triangles) = surface.visible_parts(crowd);
        Self { corners, triangles }
    }
}

impl TriangleMesh for Occluding<'_> {
    fn triangle_count(&self) -> u32 {
        self.parts
            .as_ref()
            .map_or_else(|| self.surface.triangle_count(), |parts| parts.corners.len() as u32)
    }

    fn vertex_count(&self) -> u32 {
        match &self.parts {
            Some(_) => 3 * self.triangle_count(),
            None => self.surface.vertex_count(),
        }
    }

    fn vertex_indices(&self, triangle: u32) -> [u32; 3] {
        match &self.parts {
            Some(_) => [0, 1, 2].map(|corner| 3 * triangle + corner),
            None => self.surface.vertex_indices(triangle),
        }
    }

    fn position(&self, vertex: u32) -> DVec3 {
        match &self.parts {
            Some(parts) => parts.corners[vertex as usize / 3][vertex as usize % 3],
            None => self.surface.position(vertex),
        }
    }

    fn object(&self, triangle: u32) -> u32 {
        let part_of = |parts: &VisibleParts| parts.triangles[triangle as usize];
        self.surface.object(self.parts.as_ref().map_or(triangle, part_of))
    }
}
