//! Attribute interpolation for passes: exact barycentric weights at a pixel's center and the
//! position, normal and texture coordinates computed from them, in f64.
//!
//! The rasterizer's weights are f32 and refer to vertices snapped to 1/256 pixel: good enough for
//! colors, but not for positions that must match an unprojected depth. Everything is therefore
//! recomputed for the one visible triangle of each pixel.

use crate::render::RenderError;
use crate::render::image_tiles::ImageTile;
use crate::render::screen_transform::{ScreenTransform, model_point};
use crate::render::vertex_processing::{normal_matrix, transform_normal};
use glam::{DMat3, DVec3};
use homog::{Affine, Clip, HPoint, Model, Normal, Point, Projective, Screen, View, World};
use model::{FirstIds, Primitive, SkinnedPrimitive, Topology};
use scene::{Scene, Style};
use scene_file::Pass;
use std::borrow::Cow;

/// The number of pixels whose weights are computed together.
const LANES: usize = 4;

/// The nearest primitive at each pixel's center, as the rasterizer found it: rows from the top.
pub(super) struct Visibility {
    /// Primitive ids; [`Self::NOTHING`] where there is no primitive.
    pub(super) ids: Vec<u32>,
    /// Barycentric weights on the snapped triangles, as used by shading; empty if they are not
    /// needed.
    pub(super) weights: Vec<[f32; 3]>,
}

impl Visibility {
    /// The id of a pixel without a primitive.
    pub(super) const NOTHING: u32 = u32::MAX;

    /// Returns the weights of a row of pixels; empty if they are not needed.
    pub(super) fn row_weights(&self, row: usize, width: usize) -> &[[f32; 3]] {
        self.weights.get(row * width..(row + 1) * width).unwrap_or_default()
    }
}

/// One row of a [`Visibility`].
pub(super) struct VisibleRow<'v> {
    /// Primitive ids.
    pub(super) ids: &'v [u32],
    /// Barycentric weights; empty if they are not needed.
    pub(super) weights: &'v [[f32; 3]],
    /// The column and row of the first pixel in the tile.
    pub(super) first_pixel: [u32; 2],
}

impl<'v> VisibleRow<'v> {
    /// Iterates over the longest parts that show the same primitive, and their first columns; parts
    /// without a primitive are left out.
    fn runs(&self) -> impl Iterator<Item = (usize, &'v [u32])> {
        let mut column = 0;
        self.ids.chunk_by(|a, b| a == b).filter_map(move |run| {
            let first = column;
            column += run.len();
            (run[0] != Visibility::NOTHING).then_some((first, run))
        })
    }
}

/// Neighboring pixels of a row that show the same primitive.
struct Run<'v> {
    /// The column and row of the first pixel in the tile.
    first_pixel: [u32; 2],
    /// The number of pixels.
    length: usize,
    /// The pixels' barycentric weights; empty if they are not needed.
    weights: &'v [[f32; 3]],
}

/// All primitives of a scene, by ascending primitive id.
pub(super) struct SceneGeometry<'a> {
    /// The draw calls in scene order.
    draws: Vec<DrawGeometry<'a>>,
    /// The view transform, for depths and view-space normals.
    world_to_view: Affine<World, View>,
    /// The eye, or the direction toward it.
    viewer: HPoint<World>,
    /// The inverse viewport transform of the tile.
    screen_to_ndc: Affine<Screen, homog::Ndc>,
    /// Whether the style shades triangles flat, so that vertex normals are ignored.
    is_flat: bool,
}

/// The ids of the parts of a scene that contain a primitive, each counted from 1 through all models.
#[derive(Clone, Copy)]
struct OwnerIds {
    model: u32,
    object: u32,
    node: u32,
    mesh: u32,
    /// 0 for the default material.
    material: u32,
}

/// The draw call of one primitive of one mesh instance.
struct DrawGeometry<'a> {
    /// The id of the first point, line or triangle.
    first_id: u32,
    /// The ids of the parts of the scene that contain the primitive.
    owner_ids: OwnerIds,
    /// The primitive, with its indices and topology.
    primitive: &'a Primitive,
    /// The posed positions and normals.
    skinned: SkinnedPrimitive<'a>,
    /// The texture coordinates `TEXCOORD_0`.
    uvs: Option<Cow<'a, [[f32; 2]]>>,
    /// The model matrix.
    model_to_world: Affine<Model, World>,
    /// The model-view-projection matrix of the tile.
    model_to_clip: Projective<Model, Clip>,
    /// The normal matrix.
    normal_to_world: DMat3,
}

impl<'a> SceneGeometry<'a> {
    /// Collects the posed draw calls of a scene, with the same ids as the frame of the tile.
    pub(super) fn new(scene: &'a Scene, tile: ImageTile) -> Result<Self, RenderError> {
        let transform = ScreenTransform::for_tile(scene, tile)?;
        let mut draws = Vec::new();
        let mut first_id = 0;
        let mut object = 0;
        let narrow = |id: usize| u32::try_from(id).map_err(|_| RenderError::TooManyPrimitives);
        let first_ids = FirstIds::of_models(&scene.models);
        for ((model_id, model_instance), first) in (1..).zip(&scene.models).zip(first_ids) {
            let model = &model_instance.model;
            for instance in model.mesh_instances() {
                object += 1;
                let Some(mesh) = model.nodes[instance.node].mesh else { continue };
                for primitive in &model.meshes[mesh].primitives {
                    let skinned = model.skin_primitive(instance, primitive);
                    let model_to_world = skinned.to_model.then(model_instance.model_to_world);
                    draws.push(DrawGeometry {
                        first_id,
                        owner_ids: OwnerIds {
                            model: model_id,
                            object: narrow(object)?,
                            node: narrow(first.node + instance.node)?,
                            mesh: narrow(first.mesh + mesh)?,
                            material: narrow(
                                primitive.material.map_or(0, |index| first.material + index),
                            )?,
                        },
                        primitive,
                        uvs: model.morph_uvs(instance, primitive, 0),
                        model_to_world,
                        model_to_clip: transform.model_to_clip(model_to_world),
                        normal_to_world: normal_matrix(model_to_world),
                        skinned,
                    });
                    let count = u32::try_from(primitive.item_count()).ok();
                    let next = count.and_then(|count| first_id.checked_add(count));
                    first_id = next.ok_or(RenderError::TooManyPrimitives)?;
                }
            }
        }
        Ok(Self {
            draws,
            world_to_view: scene.view_projection.camera.world_to_view(),
            viewer: scene.view_projection.viewer(),
            screen_to_ndc: transform.screen_to_ndc(),
            is_flat: scene.style == Style::Flat,
        })
    }

    /// Whether a primitive is a point or a line, whose values depend on the rasterizer's weights.
    pub(super) fn needs_weights(&self) -> bool {
        self.draws.iter().any(|draw| draw.primitive.topology != Topology::Triangles)
    }

    /// Returns the draw call of a primitive.
    fn draw_of_primitive(&self, id: u32) -> Option<&DrawGeometry<'a>> {
        let after = self.draws.partition_point(|draw| draw.first_id <= id);
        self.draws.get(after.checked_sub(1)?)
    }

    /// Writes the values of an integer pass for a row of pixels with these primitive ids.
    /// Background pixels are left unchanged.
    pub(super) fn write_ids(&self, pass: Pass, ids: &[u32], values: &mut [u32]) {
        let row = VisibleRow { ids, weights: &[], first_pixel: [0, 0] };
        for (first, run) in row.runs() {
            let Some(draw) = self.draw_of_primitive(run[0]) else { continue };
            let ids = draw.owner_ids;
            let value = match pass {
                Pass::Model => ids.model,
                Pass::Object => ids.object,
                Pass::Node => ids.node,
                Pass::Mesh => ids.mesh,
                Pass::Material => ids.material,
                _ => run[0] + 1,
            };
            values[first..first + run.len()].fill(value);
        }
    }

    /// Writes the values of a floating-point pass for a row of pixels. Values of background pixels
    /// are left unchanged.
    ///
    /// Returns whether all other pixels have a value. If not, the rasterizer's weights are missing.
    pub(super) fn write_row(&self, pass: Pass, row: &VisibleRow<'_>, values: &mut [f32]) -> bool {
        let count = pass.channels();
        let mut is_complete = true;
        for (first, ids) in row.runs() {
            let Some(item) = self.visible_item(pass, ids[0]) else { continue };
            let [left, y] = row.first_pixel;
            let run = Run {
                first_pixel: [left + first as u32, y],
                length: ids.len(),
                weights: row.weights.get(first..first + ids.len()).unwrap_or_default(),
            };
            let values = &mut values[first * count..(first + ids.len()) * count];
            is_complete &= self.write_run(pass, &item, &run, values);
        }
        is_complete
    }

    /// Writes the values of neighboring pixels that show the same primitive.
    fn write_run(&self, pass: Pass, item: &VisibleItem, run: &Run<'_>, values: &mut [f32]) -> bool {
        let to_view = |point: &SurfacePoint| self.world_to_view.transform_point(point.position);
        match pass {
            Pass::Depth => self.fill_run(item, run, values, |point| [-to_view(point).z()]),
            Pass::Distance => {
                self.fill_run(item, run, values, |point| [to_view(point).raw().length()])
            }
            Pass::Position => self.fill_run(item, run, values, |point| point.position.into()),
            Pass::Normal => {
                let normal = |point: &SurfacePoint| self.visible_normal(item, point).to_array();
                self.fill_run(item, run, values, normal)
            }
            Pass::ViewNormal => self.fill_run(item, run, values, |point| {
                let normal = Normal::from_raw(self.visible_normal(item, point));
                let in_view = self.world_to_view.transform_normal(normal).raw();
                in_view.normalize_or_zero().to_array()
            }),
            Pass::Uv => self.fill_run(item, run, values, |point| {
                let [u, v, _] =
                    interpolate(item.attributes.unwrap_or_default(), point.weights).to_array();
                [u, v]
            }),
            _ => self.fill_run(item, run, values, |point| point.weights),
        }
    }

    /// Writes the measured values at the centers of neighboring pixels.
    ///
    /// Computing four pixels together takes half the time: their divisions overlap.
    #[inline(always)]
    fn fill_run<const N: usize>(
        &self,
        item: &VisibleItem,
        run: &Run<'_>,
        values: &mut [f32],
        measure: impl Fn(&SurfacePoint) -> [f64; N],
    ) -> bool {
        let write = |weights: [f64; 3], values: &mut [f32; N]| {
            let position = Point::from_raw(interpolate(item.corners.map(Point::raw), weights));
            let measured = measure(&SurfacePoint { weights, position });
            *values = measured.map(|value| value as f32);
        };
        let mut is_complete = true;
        let chunks = values.as_chunks_mut::<N>().0[..run.length].chunks_mut(LANES);
        for (first, chunk) in (0..).step_by(LANES).zip(chunks) {
            match self.exact_weights(item, run, first) {
                Some(weights) => {
                    for (values, weights) in chunk.iter_mut().zip(weights) {
                        write(weights, values);
                    }
                }
                None => {
                    is_complete &= self.fill_slowly(item, run, first, chunk, &write);
                }
            }
        }
        is_complete
    }

    /// Writes the values of a few pixels, some of which have no exact weights.
    #[cold]
    fn fill_slowly<const N: usize>(
        &self,
        item: &VisibleItem,
        run: &Run<'_>,
        first: usize,
        values: &mut [[f32; N]],
        write: &impl Fn([f64; 3], &mut [f32; N]),
    ) -> bool {
        let mut is_complete = true;
        for (column, values) in (first..).zip(values) {
            let exact = item.edge_normals.as_ref().and_then(|edge_normals| {
                perspective_weights(edge_normals, self.pixel_center(run, column))
            });
            // Fragments of points and lines extend beyond the primitive itself.
            let weights = exact.or_else(|| Some(run.weights.get(column)?.map(f64::from)));
            match weights {
                Some(weights) => write(weights, values),
                None => is_complete = false,
            }
        }
        is_complete
    }

    /// Returns the center of a run's pixel in normalized device coordinates, with 1 as z.
    #[inline(always)]
    fn pixel_center(&self, run: &Run<'_>, column: usize) -> DVec3 {
        let [left, y] = run.first_pixel;
        let center = [f64::from(left + column as u32) + 0.5, f64::from(y) + 0.5];
        self.screen_to_ndc.transform_point(Point::new(center[0], center[1], 0.0)).raw().with_z(1.0)
    }

    /// Returns the weights of [`LANES`] neighboring pixels, or `None` if one has none: points and
    /// lines, and triangles that are seen edge-on.
    #[inline(always)]
    fn exact_weights(
        &self,
        item: &VisibleItem,
        run: &Run<'_>,
        first: usize,
    ) -> Option<[[f64; 3]; LANES]> {
        let edge_normals = item.edge_normals.as_ref()?;
        let mut all = [[0.0; 3]; LANES];
        for (lane, weights) in all.iter_mut().enumerate() {
            let center = self.pixel_center(run, first + lane);
            *weights = edge_normals.map(|normal| normal.dot(center).max(0.0));
        }
        let factors = all.map(|weights| 1.0 / (weights[0] + weights[1] + weights[2]));
        let mut is_finite = true;
        for (weights, factor) in all.iter_mut().zip(factors) {
            *weights = weights.map(|weight| weight * factor);
            is_finite &= weights.iter().all(|weight| weight.is_finite());
        }
        is_finite.then_some(all)
    }

    /// Returns a point, line or triangle with what a pass needs.
    fn visible_item(&self, pass: Pass, id: u32) -> Option<VisibleItem> {
        let draw = self.draw_of_primitive(id)?;
        let vertices = draw.vertex_indices((id - draw.first_id) as usize)?;
        let model_positions = &draw.skinned.positions;
        let mut positions = [Point::<Model>::ORIGIN; 3];
        for (position, vertex) in positions.iter_mut().zip(vertices) {
            *position = model_point(*model_positions.get(vertex)?);
        }
        let in_clip_space = positions.map(|point| draw.model_to_clip.transform_point(point));
        let corners = positions.map(|point| draw.model_to_world.transform_point(point));
        let is_normal = matches!(pass, Pass::Normal | Pass::ViewNormal);
        let is_triangle = draw.primitive.topology == Topology::Triangles;
        Some(VisibleItem {
            edge_normals: is_triangle.then(|| edge_normals(in_clip_space)),
            face_normal: if is_normal { draw.face_normal(corners) } else { DVec3::ZERO },
            attributes: match pass {
                Pass::Normal | Pass::ViewNormal if !self.is_flat => draw.vertex_normals(vertices),
                Pass::Uv => draw.vertex_uvs(vertices),
                _ => None,
            },
            corners,
        })
    }

    /// Returns the unit normal of the visible side. It is interpolated for smooth surfaces, the
    /// triangle's normal for flat surfaces, and zero for points and lines.
    fn visible_normal(&self, item: &VisibleItem, point: &SurfacePoint) -> DVec3 {
        if item.edge_normals.is_none() {
            return DVec3::ZERO;
        }
        let smooth = |normals| interpolate(normals, point.weights).try_normalize();
        let viewer = self.viewer.raw();
        let to_viewer = viewer.truncate() - point.position.raw() * viewer.w;
        let sign = if item.face_normal.dot(to_viewer) < 0.0 { -1.0 } else { 1.0 };
        item.attributes.and_then(smooth).unwrap_or(item.face_normal) * sign
    }
}

impl DrawGeometry<'_> {
    /// Returns the vertex indices of a point, line or triangle. Points and lines repeat their last
    /// index.
    fn vertex_indices(&self, item: usize) -> Option<[usize; 3]> {
        let count = self.primitive.topology.vertices_per_item();
        let indices = self.primitive.indices.get(item * count..(item + 1) * count)?;
        Some([0, 1, 2].map(|k: usize| indices[k.min(count - 1)] as usize))
    }

    /// Returns the unit normal of a triangle with these corners, on the front side.
    fn face_normal(&self, corners: [Point<World>; 3]) -> DVec3 {
        let [a, b, c] = corners.map(Point::raw);
        let is_mirrored = self.model_to_world.determinant() < 0.0;
        (b - a).cross(c - a).normalize_or_zero() * if is_mirrored { -1.0 } else { 1.0 }
    }

    /// Returns three vertex normals in world space, or `None` if there are none.
    fn vertex_normals(&self, vertices: [usize; 3]) -> Option<[DVec3; 3]> {
        let normals = self.skinned.normals.as_deref()?;
        let mut vertex_normals = [DVec3::ZERO; 3];
        for (vertex_normal, vertex) in vertex_normals.iter_mut().zip(vertices) {
            let normal = transform_normal(self.normal_to_world, *normals.get(vertex)?);
            *vertex_normal = DVec3::from_array(normal.map(f64::from));
        }
        Some(vertex_normals)
    }

    /// Returns the texture coordinates of three vertices, with 0 as the third component.
    fn vertex_uvs(&self, vertices: [usize; 3]) -> Option<[DVec3; 3]> {
        let uvs = self.uvs.as_deref()?;
        Some(vertices.map(|vertex| {
            let [u, v] = uvs.get(vertex).copied().unwrap_or_default();
            DVec3::new(u.into(), v.into(), 0.0)
        }))
    }
}

/// A point, line or triangle that is visible in some pixel.
struct VisibleItem {
    /// Edge normals in (x, y, w), for computing weights at a point of the picture; `None` for
    /// points and lines.
    edge_normals: Option<[DVec3; 3]>,
    /// The unit normal of the triangle in world space, if the pass needs it.
    face_normal: DVec3,
    /// The vertex normals in world space, or the texture coordinates with 0 as the third
    /// component, if the pass needs them and the primitive has them.
    attributes: Option<[DVec3; 3]>,
    /// Vertex positions in world space.
    corners: [Point<World>; 3],
}

/// A point on a primitive.
struct SurfacePoint {
    /// Barycentric weights.
    weights: [f64; 3],
    /// The position in world space.
    position: Point<World>,
}

/// Returns the weighted sum of three vertex attributes.
fn interpolate([a, b, c]: [DVec3; 3], weights: [f64; 3]) -> DVec3 {
    a * weights[0] + b * weights[1] + c * weights[2]
}

/// Returns the normals of the planes through the origin and each edge of a triangle, in (x, y, w).
/// The normal q × r belongs to the edge opposite p, and so on. All normals point toward the
/// triangle.
///
/// Their dot products with a point (x, y, 1) of the picture are that point's scaled weights.
fn edge_normals(corners: [HPoint<Clip>; 3]) -> [DVec3; 3] {
    let [p, q, r] = corners.map(|corner| DVec3::new(corner.x(), corner.y(), corner.w()));
    let normals = [q.cross(r), r.cross(p), p.cross(q)];
    // Corrects for the winding: the signed volume spanned by the triangle and the origin has the
    // sign of the winding.
    let sign = if normals[0].dot(p) < 0.0 { -1.0 } else { 1.0 };
    normals.map(|normal| normal * sign)
}

/// Returns the perspective-correct barycentric weights of a triangle at a point (x, y, 1) of the
/// picture, or `None` if the triangle is seen edge-on.
///
/// Up to a factor, the point is the weighted sum of the vertices' (x, y, w), so the weights are its
/// dot products with the edge normals. Vertices are not divided by w and may be behind the eye.
/// Negative weights of points just outside are clamped to 0.
fn perspective_weights(edge_normals: &[DVec3; 3], point: DVec3) -> Option<[f64; 3]> {
    let weights = edge_normals.map(|normal| normal.dot(point).max(0.0));
    let factor = 1.0 / (weights[0] + weights[1] + weights[2]);
    let weights = weights.map(|weight| weight * factor);
    weights.iter().all(|weight| weight.is_finite()).then_some(weights)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_are_recovered_from_the_projected_point() {
        let corners = [[-3.0, -1.0, 0.0, 2.0], [4.0, -2.0, 0.0, 5.0], [0.5, 6.0, 0.0, 9.0]];
        let corners = corners.map(|[x, y, z, w]| HPoint::new(x, y, z, w));
        for expected in [[0.2, 0.3, 0.5], [1.0, 0.0, 0.0], [0.05, 0.9, 0.05]] {
            let at = |k: fn(HPoint<Clip>) -> f64| -> f64 {
                corners.iter().zip(expected).map(|(corner, weight)| k(*corner) * weight).sum()
            };
            let w = at(HPoint::w);
            let point = DVec3::new(at(HPoint::x) / w, at(HPoint::y) / w, 1.0);
            for order in [[0, 1, 2], [0, 2, 1]] {
                let actual = perspective_weights(&edge_normals(order.map(|k| corners[k])), point)
                    .expect("weights");
                for (weight, k) in actual.into_iter().zip(order) {
                    assert!((weight - expected[k]).abs() < 1e-14, "{actual:?} {expected:?}");
                }
            }
        }
        let no_area = edge_normals([corners[0]; 3]);
        assert_eq!(perspective_weights(&no_area, DVec3::Z), None, "degenerate triangle");
    }
}
