//! Tangent generation with MikkTSpace, as required by glTF 2.0 §3.7.2.1 for primitives without
//! tangents.
//!
//! Tangents are per triangle corner, not per shared vertex: two triangles that share a vertex may
//! need different tangents there, at a seam or where the texture is mirrored. So there is one
//! tangent per index.
//!
//! Source: M. S. Mikkelsen, *Simulation of Wrinkled Surfaces Revisited*, 2008, implemented by the
//! `bevy_mikktspace` crate, which works in single precision. We supply its arccosine from `libm`,
//! so that all machines compute identical bits.

use crate::{Primitive, Topology};
use bevy_mikktspace::{Geometry, Ops, TangentSpace, generate_tangents};
use glam::DVec3;
use std::borrow::Cow;
use std::panic::{AssertUnwindSafe, catch_unwind};

impl Primitive {
    /// Returns the unit tangents of a normal map's tangent frame, one for each of the
    /// [`indices`](Self::indices), with the handedness of the bitangent (1 or −1) in w.
    ///
    /// `uv_set` is the texture coordinate set that the normal map uses. Flat normals replace
    /// missing normals. Returns `None` for points and lines, for a missing set, and for shapes that
    /// the algorithm rejects. The result for the first requested set is cached in the primitive, so
    /// that all frames of an animation share it.
    #[must_use]
    pub fn mikktspace_tangents(&self, uv_set: usize) -> Option<Cow<'_, [[f32; 4]]>> {
        let (cached_set, cached) =
            self.derived.tangents.get_or_init(|| (uv_set, self.run_mikktspace(uv_set)));
        if *cached_set == uv_set {
            return cached.as_deref().map(Cow::Borrowed);
        }
        self.run_mikktspace(uv_set).map(Cow::Owned)
    }

    /// Runs the algorithm. A panic inside it is treated as a failure.
    ///
    /// Triangles with degenerate texture coordinates have the x axis as their tangent.
    fn run_mikktspace(&self, uv_set: usize) -> Option<Vec<[f32; 4]>> {
        let uvs = self.uvs.get(uv_set).filter(|_| self.topology == Topology::Triangles)?;
        // The default for triangles with degenerate texture coordinates.
        let tangents = vec![[1.0, 0.0, 0.0, 1.0]; self.indices.len()];
        let mut input = MikktspaceInput { primitive: self, uvs, tangents };
        // The crate assumes well-formed geometry, which an untrusted file may not have.
        let done = catch_unwind(AssertUnwindSafe(|| generate_tangents(&mut input).is_ok()));
        done.unwrap_or(false).then_some(input.tangents)
    }
}

/// An adapter that presents a primitive to `bevy_mikktspace` and collects its tangents.
///
/// The algorithm calls its methods for each corner of each face.
struct MikktspaceInput<'a> {
    /// The triangles, whose indices are valid.
    primitive: &'a Primitive,
    /// Texture coordinates for the normal map, one per vertex.
    uvs: &'a [[f32; 2]],
    /// The tangents so far, one per index.
    tangents: Vec<[f32; 4]>,
}

impl MikktspaceInput<'_> {
    /// Returns the vertex at corner 0, 1 or 2 of a triangle.
    fn vertex_index(&self, face: usize, corner: usize) -> usize {
        self.primitive.indices[3 * face + corner] as usize
    }

    /// Returns the geometric normal of a triangle, or +z if it is degenerate.
    fn face_normal(&self, face: usize) -> [f32; 3] {
        let corner = |k| self.primitive.positions[self.vertex_index(face, k)].map(f64::from);
        let [a, b, c] = [0, 1, 2].map(|k| DVec3::from(corner(k)));
        (b - a).cross(c - a).normalize_or(DVec3::Z).as_vec3().to_array()
    }
}

impl Geometry<PortableMath> for MikktspaceInput<'_> {
    fn num_faces(&self) -> usize {
        self.primitive.item_count()
    }

    fn num_vertices_of_face(&self, _face: usize) -> usize {
        3
    }

    fn position(&self, face: usize, corner: usize) -> [f32; 3] {
        self.primitive.positions[self.vertex_index(face, corner)]
    }

    fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
        let vertex = self.vertex_index(face, corner);
        self.primitive.normals.as_ref().map_or_else(|| self.face_normal(face), |all| all[vertex])
    }

    /// Returns the texture coordinates with v negated, because v points up in MikkTSpace and down
    /// in glTF. Bitangents then point up in the image, as normal maps expect.
    fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
        let [u, v] = self.uvs[self.vertex_index(face, corner)];
        [u, -v]
    }

    fn set_tangent(&mut self, space: Option<TangentSpace>, face: usize, corner: usize) {
        if let Some(space) = space {
            self.tangents[3 * face + corner] = space.tangent_encoded();
        }
    }
}

/// A square root and an arccosine that are bit-identical on all machines.
struct PortableMath;

impl Ops for PortableMath {
    fn sqrt(x: f32) -> f32 {
        x.sqrt()
    }

    fn acos(x: f32) -> f32 {
        libm::acos(f64::from(x)) as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::DerivedData;

    /// Returns a unit square in the plane z = 0 that faces +z, with texture coordinates at (0, 0),
    /// (1, 0), (1, 1) and (0, 1).
    fn textured_square(uvs: [[f32; 2]; 4]) -> Primitive {
        Primitive {
            indices: vec![0, 1, 2, 0, 2, 3],
            positions: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
            normals: Some(vec![[0.0, 0.0, 1.0]; 4]),
            uvs: vec![uvs.to_vec()],
            ..Primitive::default()
        }
    }

    #[test]
    fn tangents_follow_u_and_bitangents_point_up_in_the_image() {
        // cross(normal, tangent) · w must point in the direction in which v decreases (glTF 2.0
        // §3.7.2.1, §3.9.3).
        for (uvs, tangent) in [
            // Unchanged: u increases along x, and v decreases along y.
            ([[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]], [1.0, 0.0, 0.0, 1.0]),
            // Mirrored: u decreases along x.
            ([[1.0, 1.0], [0.0, 1.0], [0.0, 0.0], [1.0, 0.0]], [-1.0, 0.0, 0.0, -1.0]),
            // Upside down.
            ([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], [1.0, 0.0, 0.0, -1.0]),
            // A quarter turn: u increases along y, and v decreases along −x.
            ([[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]], [0.0, 1.0, 0.0, 1.0]),
        ] {
            let square = textured_square(uvs);
            let tangents = square.mikktspace_tangents(0).unwrap();
            for actual in tangents.iter() {
                let near = actual.iter().zip(tangent).all(|(a, b): (_, f32)| (a - b).abs() < 1e-6);
                assert!(near, "{uvs:?}: {actual:?}");
            }
            assert_eq!(tangents.len(), 6);
            let derived = DerivedData::default();
            let flat = Primitive { normals: None, derived, ..square.clone() };
            assert_eq!(
                flat.mikktspace_tangents(0).unwrap(),
                tangents,
                "flat normals give the same result here"
            );
        }
    }

    #[test]
    fn tangents_are_cached_and_differ_by_coordinate_set() {
        let [along_x, along_y] = [
            [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]],
            [[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]],
        ];
        let both =
            Primitive { uvs: vec![along_x.to_vec(), along_y.to_vec()], ..textured_square(along_x) };
        let first = both.mikktspace_tangents(0).unwrap();
        assert!(
            matches!(both.mikktspace_tangents(0), Some(Cow::Borrowed(cached)) if cached == &*first)
        );
        assert_eq!(both.mikktspace_tangents(1), textured_square(along_y).mikktspace_tangents(0));
        assert_ne!(both.mikktspace_tangents(1).unwrap(), first);
    }

    #[test]
    fn degenerate_shapes_do_not_panic() {
        let one_point = textured_square([[0.5; 2]; 4]);
        assert_eq!(one_point.mikktspace_tangents(0).map(|tangents| tangents.len()), Some(6));
        assert_eq!(one_point.mikktspace_tangents(1), None);
        let flat = Primitive {
            positions: vec![[f32::MAX; 3]; 4],
            derived: DerivedData::default(),
            ..one_point
        };
        assert_eq!(flat.mikktspace_tangents(0).map(|tangents| tangents.len()), Some(6));
        let line = Primitive { topology: Topology::Lines, derived: DerivedData::default(), ..flat };
        assert_eq!(line.mikktspace_tangents(0), None);
    }
}
