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

/// The nearest primitive at a pixel's center, as the rasterizer found it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hit {
    /// The primitive id; `u32::MAX` if there is no primitive.
    pub(super) id: u32,
    /// Barycentric weights on the snapped triangle, as used by shading.
    pub(super) weights: [f32; 3],
}

impl Hit {
    /// No primitive.
    pub(super) const MISS: Self = Self { id: u32::MAX, weights: [0.0; 3] };
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

    /// Returns the draw call of a hit's primitive.
    fn draw_of_hit(&self, hit: &Hit) -> Option<&DrawGeometry<'a>> {
        if hit.id == u32::MAX {
            return None;
        }
        let after = self.draws.partition_point(|draw| draw.first_id <= hit.id);
        self.draws.get(after.checked_sub(1)?)
    }

    /// Returns the value of an integer pass at a pixel; 0 for background pixels.
    pub(super) fn id_value(&self, pass: Pass, hit: &Hit) -> u32 {
        let Some(draw) = self.draw_of_hit(hit) else { return 0 };
        let ids = draw.owner_ids;
        match pass {
            Pass::Model => ids.model,
            Pass::Object => ids.object,
            Pass::Node => ids.node,
            Pass::Mesh => ids.mesh,
            Pass::Material => ids.material,
            _ => hit.id + 1,
        }
    }

    /// Writes the values of a floating-point pass for a pixel of the tile. Values of background
    /// pixels are left unchanged.
    ///
    /// `last` caches the previous pixel's item, because neighbors usually show the same triangle.
    pub(super) fn write_value<'s>(
        &'s self,
        pass: Pass,
        hit: &Hit,
        pixel: [u32; 2],
        last: &mut Option<HitItem<'s, 'a>>,
        values: &mut [f32],
    ) {
        if hit.id == u32::MAX {
            return;
        }
        if last.as_ref().is_none_or(|item| item.id != hit.id) {
            *last = self.item_of_hit(hit);
        }
        let Some(item) = last else { return };
        let point = self.surface_point(item, hit, pixel);
        let to_view = |point: Point<World>| self.world_to_view.transform_point(point);
        let measured = match pass {
            Pass::Depth => [-to_view(point.position).z(), 0.0, 0.0],
            Pass::Distance => [to_view(point.position).raw().length(), 0.0, 0.0],
            Pass::Position => point.position.into(),
            Pass::Normal => self.visible_normal(item, &point).to_array(),
            Pass::ViewNormal => {
                let normal = Normal::from_raw(self.visible_normal(item, &point));
                let in_view = self.world_to_view.transform_normal(normal).raw();
                in_view.normalize_or_zero().to_array()
            }
            Pass::Uv => item.uv(&point),
            _ => point.weights,
        };
        for (value, measured) in values.iter_mut().zip(measured) {
            *value = measured as f32;
        }
    }

    /// Returns the point, line or triangle of a hit, with its corners in clip space and in world
    /// space.
    fn item_of_hit(&self, hit: &Hit) -> Option<HitItem<'_, 'a>> {
        let draw = self.draw_of_hit(hit)?;
        let vertices = draw.vertex_indices((hit.id - draw.first_id) as usize)?;
        let model_positions = &draw.skinned.positions;
        let mut positions = [Point::<Model>::ORIGIN; 3];
        for (position, vertex) in positions.iter_mut().zip(vertices) {
            *position = model_point(*model_positions.get(vertex)?);
        }
        let in_clip_space = positions.map(|point| draw.model_to_clip.transform_point(point));
        let edge_normals = edge_normals(in_clip_space);
        let corners = positions.map(|point| draw.model_to_world.transform_point(point));
        Some(HitItem { id: hit.id, draw, vertices, edge_normals, corners })
    }

    /// Returns the surface point at a pixel's center. Points and lines use the rasterizer's
    /// weights, because their fragments extend beyond the primitive itself.
    fn surface_point(&self, item: &HitItem<'_, '_>, hit: &Hit, [x, y]: [u32; 2]) -> SurfacePoint {
        let weights = if item.draw.primitive.topology == Topology::Triangles {
            let center = Point::new(f64::from(x) + 0.5, f64::from(y) + 0.5, 0.0);
            let center = self.screen_to_ndc.transform_point(center).raw().with_z(1.0);
            perspective_weights(&item.edge_normals, center)
        } else {
            None
        };
        let weights = weights.unwrap_or(hit.weights.map(f64::from));
        let position = Point::from_raw(interpolate(item.corners.map(Point::raw), weights));
        SurfacePoint { weights, position }
    }

    /// Returns the unit normal of the visible side. It is interpolated for smooth surfaces, the
    /// triangle's normal for flat surfaces, and zero for points and lines.
    fn visible_normal(&self, item: &HitItem<'_, '_>, point: &SurfacePoint) -> DVec3 {
        let draw = item.draw;
        if draw.primitive.topology != Topology::Triangles {
            return DVec3::ZERO;
        }
        let [a, b, c] = item.corners.map(Point::raw);
        let is_mirrored = draw.model_to_world.determinant() < 0.0;
        let face = (b - a).cross(c - a).normalize_or_zero() * if is_mirrored { -1.0 } else { 1.0 };
        let smooth_normal = item.smooth_normal(point).filter(|_| !self.is_flat);
        let viewer = self.viewer.raw();
        let to_viewer = viewer.truncate() - point.position.raw() * viewer.w;
        let sign = if face.dot(to_viewer) < 0.0 { -1.0 } else { 1.0 };
        smooth_normal.unwrap_or(face) * sign
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
}

/// A point, line or triangle that is visible in some pixel.
pub(super) struct HitItem<'s, 'a> {
    /// The primitive id.
    id: u32,
    /// The draw call.
    draw: &'s DrawGeometry<'a>,
    /// Vertex indices.
    vertices: [usize; 3],
    /// Edge normals in (x, y, w), for computing weights at a point of the picture.
    edge_normals: [DVec3; 3],
    /// Vertex positions in world space.
    corners: [Point<World>; 3],
}

impl HitItem<'_, '_> {
    /// Returns the interpolated vertex normal in world space, or `None` if there are no vertex
    /// normals.
    fn smooth_normal(&self, point: &SurfacePoint) -> Option<DVec3> {
        let normals = self.draw.skinned.normals.as_deref()?;
        let mut vertex_normals = [DVec3::ZERO; 3];
        for (vertex_normal, vertex) in vertex_normals.iter_mut().zip(self.vertices) {
            let normal = transform_normal(self.draw.normal_to_world, *normals.get(vertex)?);
            *vertex_normal = DVec3::from_array(normal.map(f64::from));
        }
        interpolate(vertex_normals, point.weights).try_normalize()
    }

    /// Returns the interpolated texture coordinates, with 0 as the third component.
    fn uv(&self, point: &SurfacePoint) -> [f64; 3] {
        let Some(uvs) = self.draw.uvs.as_deref() else { return [0.0; 3] };
        let uv = self.vertices.map(|vertex| {
            let [u, v] = uvs.get(vertex).copied().unwrap_or_default();
            DVec3::new(u.into(), v.into(), 0.0)
        });
        interpolate(uv, point.weights).to_array()
    }
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
