//! Shells: the connected parts of a surface.

use super::welded_surface::WeldedSurface;
use crate::visibility::TriangleMesh;

/// A union-find structure over faces, with path halving.
struct Shells(Vec<u32>);

impl Shells {
    /// Returns the representative of a face's shell.
    fn find(&mut self, mut face: u32) -> u32 {
        while self.0[face as usize] != face {
            let above = self.0[self.0[face as usize] as usize];
            self.0[face as usize] = above;
            face = above;
        }
        face
    }

    /// Joins the shells of two faces. The lower number represents both.
    fn join(&mut self, one: u32, other: u32) {
        let [a, b] = [self.find(one), self.find(other)];
        self.0[a.max(b) as usize] = a.min(b);
    }
}

impl WeldedSurface {
    /// Returns the shell and the material of each triangle of
    /// [`occluder_triangles`](Self::occluder_triangles). Slivers have no shell.
    ///
    /// Faces are in the same shell if they are connected across edges with exactly two faces.
    /// Bodies of one object that touch along an edge are therefore separate shells.
    pub(crate) fn shells_and_materials(&self) -> Vec<[u32; 2]> {
        let faces = &self.mesh().faces;
        let mut shells = Shells((0..faces.len() as u32).collect());
        self.for_each_edge(|_, sides| {
            if let [one, other] = sides {
                shells.join(one.face(), other.face());
            }
        });
        let owners = faces.iter().zip(0..).map(|(face, at)| [shells.find(at), face.material]);
        let mut owners: Vec<[u32; 2]> = owners.collect();
        owners.resize(self.triangle_count() as usize, [u32::MAX; 2]);
        owners
    }
}
