//! STL solids: triangles with welded vertices.

use super::facet_color::FacetColors;
use crate::polygons::{CreaseNormals, Smoothing, VertexWelder};
use files::counted;
use gltf_import::ImportWarnings;
use model::Primitive;

/// Number of pending triangles at which their corners are welded.
const WAITING_TRIANGLES: usize = 64;

/// A solid of an STL file that is being read.
#[derive(Debug, Default)]
pub(super) struct Solid {
    /// The name after `solid`, if the file is text.
    pub(super) name: Option<String>,
    /// Vertex indices of the triangles that are not pending.
    triangles: Vec<[u32; 3]>,
    /// Corners of the pending triangles, which are welded as a batch.
    waiting: Vec<[f32; 3]>,
    /// The welder, which holds the vertices.
    welder: VertexWelder,
    /// Colors of the triangles, if the file has any.
    pub(super) colors: FacetColors,
    /// The number of triangles that were skipped because a corner is not finite.
    omitted: usize,
    /// The location of the first skipped triangle.
    first_omitted: Option<String>,
}

impl Solid {
    /// Creates a solid with space for a number of triangles. A closed surface has about half as
    /// many vertices as triangles.
    pub(super) fn with_capacity(triangles: usize) -> Self {
        Self {
            triangles: Vec::with_capacity(triangles),
            welder: VertexWelder::with_capacity(triangles / 2),
            ..Self::default()
        }
    }

    /// Adds a triangle. If a corner is not finite, skips it and returns false.
    ///
    /// `locate` returns the location of the triangle for the warning.
    #[inline]
    pub(super) fn push_triangle(
        &mut self,
        corners: [[f32; 3]; 3],
        locate: impl FnOnce() -> String,
    ) -> bool {
        let is_finite = corners.as_flattened().iter().fold(true, |all, x| all & x.is_finite());
        if is_finite {
            self.waiting.extend(corners);
            if self.waiting.len() >= 3 * WAITING_TRIANGLES {
                self.weld_waiting();
            }
        } else {
            self.omitted += 1;
            self.first_omitted.get_or_insert_with(locate);
        }
        is_finite
    }

    /// Returns the number of triangles.
    pub(super) fn triangle_count(&self) -> usize {
        self.triangles.len() + self.waiting.len() / 3
    }

    /// Assigns vertices to the pending corners.
    fn weld_waiting(&mut self) {
        let vertices = self.welder.weld_all(&self.waiting);
        self.triangles.extend(vertices.as_chunks::<3>().0);
        self.waiting.clear();
    }

    /// Warns about skipped triangles.
    pub(super) fn warn_of_omissions(&self, warnings: &mut ImportWarnings) {
        if let Some(location) = &self.first_omitted {
            let triangles = counted(self.omitted, "triangle", "triangles");
            let message = format!("skipped {triangles} with corners that are not finite");
            warnings.push_warning(location, message);
        }
    }

    /// Builds the primitive: computes normals by crease angle, and splits vertices between colors.
    pub(super) fn into_primitive(mut self, crease_degrees: f64) -> Primitive {
        self.weld_waiting();
        let mut positions = self.welder.into_positions();
        let smoothing = Smoothing::CreaseAngle(crease_degrees);
        let CreaseNormals { triangles, copies, normals } =
            CreaseNormals::compute(&positions, self.triangles, smoothing);
        for &vertex in &copies {
            positions.push(positions[vertex as usize]);
        }
        let mut primitive = Primitive {
            indices: triangles.into_flattened(),
            positions,
            normals: Some(normals),
            material: Some(0),
            ..Primitive::default()
        };
        self.colors.apply_to(&mut primitive);
        primitive
    }
}
