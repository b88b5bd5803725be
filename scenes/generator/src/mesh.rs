//! Indexed triangle meshes under construction, and the shapes that models are built from: quads,
//! boxes, surfaces of revolution, spheres. Triangles are counterclockwise seen from outside. Shapes
//! have the exact normals of the smooth surface they approximate, not the normals of their
//! triangles. Flat faces do not share vertices, so their edges stay sharp.

use glam::{DVec2, DVec3, dvec2, dvec3};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Attributes per vertex, and indices. `normals`, `uvs` and `colors` are either empty or as long as
/// `positions`.
#[derive(Clone, Default, Debug)]
pub struct Mesh {
    /// Positions in meters, with y up.
    pub positions: Vec<DVec3>,
    /// Normals of unit length.
    pub normals: Vec<DVec3>,
    /// Texture coordinates, v down as in glTF.
    pub uvs: Vec<DVec2>,
    /// Colors in linear light, 0 to 1.
    pub colors: Vec<[f64; 3]>,
    /// Vertex indices of the triangles, or of other primitives if the document uses the mesh for
    /// them.
    pub indices: Vec<u32>,
}

/// A point of the outline that [`Mesh::lathe`] sweeps about the y axis.
#[derive(Clone, Copy, Debug)]
pub struct OutlinePoint {
    /// Distance from the axis.
    pub radius: f64,
    /// Position along the axis.
    pub height: f64,
    /// Outward normal in the plane of radius and height.
    pub normal: DVec2,
}

impl Mesh {
    /// Adds a vertex and returns its index.
    pub fn add_vertex(&mut self, position: DVec3, normal: DVec3) -> u32 {
        self.positions.push(position);
        self.normals.push(normal);
        self.positions.len() as u32 - 1
    }

    /// Adds a triangle unless it is degenerate, as at a pole of a sphere, where two vertices
    /// coincide.
    pub fn add_triangle(&mut self, corners: [u32; 3]) {
        let [a, b, c] = corners.map(|index| self.positions[index as usize]);
        if (b - a).cross(c - a).length() > 1e-12 {
            self.indices.extend(corners);
        }
    }

    /// Adds two triangles for each cell of a grid of `columns` by `rows` vertices, stored row by
    /// row from index `first`. The front is the side from which each row runs to the right and
    /// the next row is above it.
    pub fn add_grid_triangles(&mut self, first: u32, columns: u32, rows: u32) {
        for row in 0..rows - 1 {
            for column in 0..columns - 1 {
                let a = first + row * columns + column;
                let (b, c, d) = (a + 1, a + 1 + columns, a + columns);
                self.add_triangle([a, b, c]);
                self.add_triangle([a, c, d]);
            }
        }
    }

    /// Adds a flat four-sided face, with corners counterclockwise from the lower left and texture
    /// coordinates that cover the whole square.
    pub fn add_quad(&mut self, corners: [DVec3; 4]) {
        let [a, b, c, d] = corners;
        let normal = (b - a).cross(d - a).normalize();
        let first = self.positions.len() as u32;
        for corner in [a, b, c, d] {
            self.add_vertex(corner, normal);
        }
        self.uvs.extend([dvec2(0.0, 1.0), dvec2(1.0, 1.0), dvec2(1.0, 0.0), dvec2(0.0, 0.0)]);
        self.indices.extend([0, 1, 2, 0, 2, 3].map(|corner| first + corner));
    }

    /// Adds a flat convex face, with corners counterclockwise and without texture coordinates.
    pub fn add_polygon(&mut self, corners: &[DVec3]) {
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
        let first = self.positions.len() as u32;
        for corner in corners {
            self.add_vertex(*corner, normal);
        }
        for corner in 1..corners.len() as u32 - 1 {
            self.add_triangle([first, first + corner, first + corner + 1]);
        }
    }

    /// Builds an axis-aligned box.
    #[must_use]
    pub fn cuboid(low: DVec3, high: DVec3) -> Self {
        let corner = |x: bool, y: bool, z: bool| {
            let pick = |from_high, low, high| if from_high { high } else { low };
            dvec3(pick(x, low.x, high.x), pick(y, low.y, high.y), pick(z, low.z, high.z))
        };
        let (o, i) = (false, true);
        let mut mesh = Self::default();
        for face in [
            [(o, o, i), (i, o, i), (i, i, i), (o, i, i)], // front
            [(i, o, o), (o, o, o), (o, i, o), (i, i, o)], // back
            [(i, o, i), (i, o, o), (i, i, o), (i, i, i)], // right
            [(o, o, o), (o, o, i), (o, i, i), (o, i, o)], // left
            [(o, i, i), (i, i, i), (i, i, o), (o, i, o)], // top
            [(o, o, o), (i, o, o), (i, o, i), (o, o, i)], // bottom
        ] {
            mesh.add_quad(face.map(|(x, y, z)| corner(x, y, z)));
        }
        mesh
    }

    /// Builds a box of the given size, resting on the ground and centered over `(x, z)`.
    #[must_use]
    pub fn block_on(at: DVec3, size: DVec3) -> Self {
        let half = dvec3(size.x / 2.0, 0.0, size.z / 2.0);
        Self::cuboid(at - half, at + half + dvec3(0.0, size.y, 0.0))
    }

    /// Builds the surface that an outline sweeps about the y axis, in `segments` steps. The outline
    /// goes from the bottom up along the outside, so that the outside is to its right.
    #[must_use]
    pub fn lathe(outline: &[OutlinePoint], segments: u32) -> Self {
        let mut mesh = Self::default();
        for turned in outline {
            for step in 0..=segments {
                let (z, x) = libm::sincos(TAU * f64::from(step % segments) / f64::from(segments));
                let out = dvec3(x, 0.0, -z);
                mesh.add_vertex(
                    out * turned.radius + DVec3::Y * turned.height,
                    out * turned.normal.x + DVec3::Y * turned.normal.y,
                );
            }
        }
        mesh.add_grid_triangles(0, segments + 1, outline.len() as u32);
        mesh
    }

    /// Builds a sphere about the origin, with `segments` around the axis and half as many from pole
    /// to pole.
    #[must_use]
    pub fn sphere(radius: f64, segments: u32) -> Self {
        let rings = segments / 2;
        let outline: Vec<OutlinePoint> = (0..=rings)
            .map(|ring| {
                let latitude = FRAC_PI_2 * (2.0 * f64::from(ring) / f64::from(rings) - 1.0);
                let (sine, cosine) = libm::sincos(latitude);
                // Exactly on the axis, so that degenerate triangles at the poles are recognized.
                let cosine = if ring == 0 || ring == rings { 0.0 } else { cosine };
                OutlinePoint {
                    radius: radius * cosine,
                    height: radius * sine,
                    normal: dvec2(cosine, sine),
                }
            })
            .collect();
        Self::lathe(&outline, segments)
    }

    /// Builds a closed round post from the ground up, with different radii at the bottom and top.
    #[must_use]
    pub fn post(bottom: f64, top: f64, height: f64, segments: u32) -> Self {
        Self::lathe(
            &sharp_outline(&[(0.0, 0.0), (bottom, 0.0), (top, height), (0.0, height)]),
            segments,
        )
    }

    /// Appends another mesh, which must have the same attributes.
    pub fn append(&mut self, other: &Self) {
        let first = self.positions.len() as u32;
        self.positions.extend(&other.positions);
        self.normals.extend(&other.normals);
        self.uvs.extend(&other.uvs);
        self.colors.extend(&other.colors);
        self.indices.extend(other.indices.iter().map(|index| first + index));
    }

    /// Returns the mesh translated by `by`.
    #[must_use]
    pub fn translated(mut self, by: DVec3) -> Self {
        for position in &mut self.positions {
            *position += by;
        }
        self
    }

    /// Returns the mesh without texture coordinates, for materials without textures.
    #[must_use]
    pub fn without_uvs(mut self) -> Self {
        self.uvs.clear();
        self
    }
}

/// Returns an outline of straight pieces with sharp corners between them: each corner appears
/// twice, once for the piece below and once for the piece above.
#[must_use]
pub fn sharp_outline(points: &[(f64, f64)]) -> Vec<OutlinePoint> {
    let mut outline = Vec::new();
    for pair in points.windows(2) {
        let [(r0, h0), (r1, h1)] = [pair[0], pair[1]];
        let normal = dvec2(h1 - h0, r0 - r1).normalize();
        outline.push(OutlinePoint { radius: r0, height: h0, normal });
        outline.push(OutlinePoint { radius: r1, height: h1, normal });
    }
    outline
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Computes the signed volume by the divergence theorem; it is positive if all faces point
    /// outward.
    fn volume(mesh: &Mesh) -> f64 {
        let corner = |index: u32| mesh.positions[index as usize];
        let faces = mesh.indices.chunks_exact(3);
        faces.map(|t| corner(t[0]).dot(corner(t[1]).cross(corner(t[2]))) / 6.0).sum()
    }

    #[test]
    fn faces_point_outward_and_volumes_are_correct() {
        let cuboid = Mesh::cuboid(dvec3(1.0, 2.0, 3.0), dvec3(2.0, 4.0, 6.0));
        assert!((volume(&cuboid) - 6.0).abs() < 1e-12);
        let ball = volume(&Mesh::sphere(1.0, 64));
        assert!((ball / (TAU * 2.0 / 3.0) - 1.0).abs() < 0.01, "{ball}");
        let post = volume(&Mesh::post(1.0, 1.0, 2.0, 64));
        assert!((post / TAU - 1.0).abs() < 0.01, "{post}");
    }

    #[test]
    fn normals_agree_with_their_faces() {
        for mesh in [
            Mesh::sphere(2.0, 16),
            Mesh::post(1.0, 0.5, 2.0, 12),
            Mesh::cuboid(-DVec3::ONE, DVec3::ONE),
        ] {
            for face in mesh.indices.chunks_exact(3) {
                let [a, b, c] = [face[0], face[1], face[2]].map(|i| mesh.positions[i as usize]);
                let flat = (b - a).cross(c - a).normalize();
                assert!(face.iter().all(|&i| mesh.normals[i as usize].dot(flat) > 0.8));
            }
        }
    }
}
