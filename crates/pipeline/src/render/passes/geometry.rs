//! From a triangle and a pixel to numbers: the exact weights, and what they make of what the corners carry.

use super::pass::Pass;
use crate::render::RenderError;
use crate::render::image_tiles::ImageTile;
use crate::render::screen_transform::{ScreenTransform, model_point};
use crate::render::vertex_processing::{normal_matrix, transform_normal};
use crate::scene::{Scene, Style};
use glam::{DMat3, DVec3};
use homog::{Affine, Clip, HPoint, Model, Normal, Point, Projective, Screen, View, World};
use model::{Primitive, SkinnedPrimitive, Topology};
use std::borrow::Cow;

/// What is nearest in a pixel, as the rasteriser tells it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hit {
    pub(super) id: u32,
    /// The shares of the corners, as they are used for shading.
    pub(super) weights: [f32; 3],
}

impl Hit {
    pub(super) const MISS: Self = Self { id: u32::MAX, weights: [0.0; 3] };
}

/// All primitives of a scene, in the order of their numbers.
pub(super) struct SceneGeometry<'a> {
    draws: Vec<DrawGeometry<'a>>,
    world_to_view: Affine<World, View>,
    viewer: HPoint<World>,
    screen_to_ndc: Affine<Screen, homog::Ndc>,
    is_flat: bool,
}

/// A primitive of a mesh at one of its places.
struct DrawGeometry<'a> {
    first_id: u32,
    /// The numbers of model, node, mesh and material; 0 for none, else the index and one.
    owner_ids: [u32; 4],
    primitive: &'a Primitive,
    posed: SkinnedPrimitive<'a>,
    uvs: Option<Cow<'a, [[f32; 2]]>>,
    model_to_world: Affine<Model, World>,
    model_to_clip: Projective<Model, Clip>,
    /// The way of normals to the world.
    normal_to_world: DMat3,
}

impl<'a> SceneGeometry<'a> {
    pub(super) fn new(scene: &'a Scene, sheet: ImageTile) -> Result<Self, RenderError> {
        let stage = ScreenTransform::for_tile(scene, sheet)?;
        let mut draws = Vec::new();
        let mut first_id = 0;
        for (number, placed) in (1..).zip(&scene.models) {
            let model = &placed.model;
            for (instance, primitive) in model.scene_primitives() {
                let posed = model.skin_primitive(instance, primitive);
                let model_to_world = posed.to_model.then(placed.model_to_world);
                let index = |at: Option<usize>| at.map_or(0, |at| at as u32 + 1);
                let mesh = index(model.nodes[instance.node].mesh);
                let owners = [number, index(Some(instance.node)), mesh, index(primitive.material)];
                draws.push(DrawGeometry {
                    first_id,
                    owner_ids: owners,
                    primitive,
                    uvs: model.morph_uvs(instance, primitive, 0),
                    model_to_world,
                    model_to_clip: stage.model_to_clip(model_to_world),
                    normal_to_world: normal_matrix(model_to_world),
                    posed,
                });
                let count = u32::try_from(primitive.item_count()).ok();
                let next = count.and_then(|count| first_id.checked_add(count));
                first_id = next.ok_or(RenderError::TooManyPrimitives)?;
            }
        }
        Ok(Self {
            draws,
            world_to_view: scene.view_projection.camera.world_to_view(),
            viewer: scene.view_projection.viewer(),
            screen_to_ndc: stage.screen_to_ndc(),
            is_flat: scene.style == Style::Flat,
        })
    }

    fn draw_of_hit(&self, hit: &Hit) -> Option<&DrawGeometry<'a>> {
        if hit.id == u32::MAX {
            return None;
        }
        let after = self.draws.partition_point(|part| part.first_id <= hit.id);
        self.draws.get(after.checked_sub(1)?)
    }

    /// The whole number that a pass has for a pixel.
    pub(super) fn id_value(&self, pass: Pass, hit: &Hit) -> u32 {
        let Some(part) = self.draw_of_hit(hit) else { return 0 };
        let [model, node, mesh, material] = part.owner_ids;
        match pass {
            Pass::Model => model,
            Pass::Node => node,
            Pass::Mesh => mesh,
            Pass::Material => material,
            _ => hit.id + 1,
        }
    }

    /// The measures that a pass has for the pixel at `place` of the sheet.
    pub(super) fn write_value(&self, pass: Pass, hit: &Hit, place: [u32; 2], values: &mut [f32]) {
        let Some(part) = self.draw_of_hit(hit) else { return };
        let Some(point) = self.surface_point(part, hit, place) else { return };
        let to_view = |place: Point<World>| self.world_to_view.transform_point(place);
        let measured = match pass {
            Pass::Depth => [-to_view(point.position).z(), 0.0, 0.0],
            Pass::Distance => [to_view(point.position).raw().length(), 0.0, 0.0],
            Pass::Position => point.position.into(),
            Pass::Normal => self.visible_normal(part, &point).to_array(),
            Pass::ViewNormal => {
                let normal = Normal::from_raw(self.visible_normal(part, &point));
                let turned = self.world_to_view.transform_normal(normal).raw();
                turned.normalize_or_zero().to_array()
            }
            Pass::Uv => part.uv(&point),
            _ => point.weights,
        };
        for (value, measured) in values.iter_mut().zip(measured) {
            *value = measured as f32;
        }
    }

    /// What is seen at the pixel's centre.
    fn surface_point(
        &self,
        part: &DrawGeometry<'_>,
        hit: &Hit,
        [x, y]: [u32; 2],
    ) -> Option<SurfacePoint> {
        let vertices = part.vertex_indices((hit.id - part.first_id) as usize)?;
        let model_positions = &part.posed.positions;
        let mut positions = [Point::<Model>::ORIGIN; 3];
        for (place, vertex) in positions.iter_mut().zip(vertices) {
            *place = model_point(*model_positions.get(vertex)?);
        }
        let weights = if part.primitive.topology == Topology::Triangles {
            let center = Point::new(f64::from(x) + 0.5, f64::from(y) + 0.5, 0.0);
            let center = self.screen_to_ndc.transform_point(center).raw().with_z(1.0);
            perspective_weights(
                positions.map(|place| part.model_to_clip.transform_point(place)),
                center,
            )
        } else {
            None
        };
        let weights = weights.unwrap_or(hit.weights.map(f64::from));
        let corners = positions.map(|place| part.model_to_world.transform_point(place));
        let place = Point::from_raw(interpolate(corners.map(Point::raw), weights));
        Some(SurfacePoint { vertices, corners, weights, position: place })
    }

    /// The unit normal on the side that is seen.
    fn visible_normal(&self, part: &DrawGeometry<'_>, spot: &SurfacePoint) -> DVec3 {
        if part.primitive.topology != Topology::Triangles {
            return DVec3::ZERO;
        }
        let [a, b, c] = spot.corners.map(Point::raw);
        let is_mirrored = part.model_to_world.determinant() < 0.0;
        let face = (b - a).cross(c - a).normalize_or_zero() * if is_mirrored { -1.0 } else { 1.0 };
        let smooth_normal = part.smooth_normal(spot).filter(|_| !self.is_flat);
        let viewer = self.viewer.raw();
        let to_viewer = viewer.truncate() - spot.position.raw() * viewer.w;
        let sign = if face.dot(to_viewer) < 0.0 { -1.0 } else { 1.0 };
        smooth_normal.unwrap_or(face) * sign
    }
}

impl DrawGeometry<'_> {
    /// The vertices of a point, line or triangle; corners that it lacks repeat the last.
    fn vertex_indices(&self, item: usize) -> Option<[usize; 3]> {
        let count = self.primitive.topology.vertices_per_item();
        let indices = self.primitive.indices.get(item * count..(item + 1) * count)?;
        Some([0, 1, 2].map(|k: usize| indices[k.min(count - 1)] as usize))
    }

    fn smooth_normal(&self, spot: &SurfacePoint) -> Option<DVec3> {
        let normals = self.posed.normals.as_deref()?;
        let mut vertex_normals = [DVec3::ZERO; 3];
        for (carried, vertex) in vertex_normals.iter_mut().zip(spot.vertices) {
            let normal = transform_normal(self.normal_to_world, *normals.get(vertex)?);
            *carried = DVec3::from_array(normal.map(f64::from));
        }
        interpolate(vertex_normals, spot.weights).try_normalize()
    }

    fn uv(&self, spot: &SurfacePoint) -> [f64; 3] {
        let Some(uvs) = self.uvs.as_deref() else { return [0.0; 3] };
        let uv = spot.vertices.map(|vertex| {
            let [u, v] = uvs.get(vertex).copied().unwrap_or_default();
            DVec3::new(u.into(), v.into(), 0.0)
        });
        interpolate(uv, spot.weights).to_array()
    }
}

/// A place on a primitive.
struct SurfacePoint {
    vertices: [usize; 3],
    corners: [Point<World>; 3],
    weights: [f64; 3],
    position: Point<World>,
}

fn interpolate([a, b, c]: [DVec3; 3], weights: [f64; 3]) -> DVec3 {
    a * weights[0] + b * weights[1] + c * weights[2]
}

/// The shares of a triangle's corners at a place of the picture, given as (x, y, 1) after the divide: the place is the sum of
/// (x, y, w) of the corners times their shares, but for a factor. No share is negative; `None` if the triangle is seen edge-on.
fn perspective_weights(corners: [HPoint<Clip>; 3], place: DVec3) -> Option<[f64; 3]> {
    let [p, q, r] = corners.map(|corner| DVec3::new(corner.x(), corner.y(), corner.w()));
    let edge_values = [q.cross(r), r.cross(p), p.cross(q)].map(|normal| normal.dot(place));
    let total = edge_values[0] + edge_values[1] + edge_values[2];
    // Whichever way the corners run, the sum has the sign of the shares.
    let weights = edge_values.map(|part| (part / total).max(0.0));
    let sum = weights[0] + weights[1] + weights[2];
    let weights = weights.map(|share| share / sum);
    weights.iter().all(|share| share.is_finite()).then_some(weights)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_are_those_of_the_place_before_the_divide() {
        let corners = [[-3.0, -1.0, 0.0, 2.0], [4.0, -2.0, 0.0, 5.0], [0.5, 6.0, 0.0, 9.0]];
        let corners = corners.map(|[x, y, z, w]| HPoint::new(x, y, z, w));
        for due in [[0.2, 0.3, 0.5], [1.0, 0.0, 0.0], [0.05, 0.9, 0.05]] {
            let at = |k: fn(HPoint<Clip>) -> f64| -> f64 {
                corners.iter().zip(due).map(|(corner, share)| k(*corner) * share).sum()
            };
            let w = at(HPoint::w);
            let place = DVec3::new(at(HPoint::x) / w, at(HPoint::y) / w, 1.0);
            for turned in [[0, 1, 2], [0, 2, 1]] {
                let actual =
                    perspective_weights(turned.map(|k| corners[k]), place).expect("shares");
                for (share, k) in actual.into_iter().zip(turned) {
                    assert!((share - due[k]).abs() < 1e-14, "{actual:?} {due:?}");
                }
            }
        }
        assert_eq!(perspective_weights([corners[0]; 3], DVec3::Z), None, "no area");
    }
}
