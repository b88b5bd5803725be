//! The up axis of a file, and the rotation that turns it to y.

use crate::{Model, Node};
use homog::{Affine, Model as ModelSpace, Point, Vector};

/// The coordinate axis that points up in a file.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Default)]
pub enum UpAxis {
    /// x, with y to the left and z to the front, as in COLLADA.
    X,
    /// y, with x to the right and z to the front, as in glTF and, by convention, OBJ and PLY.
    #[default]
    Y,
    /// z, with x to the right and y to the back, as in 3MF and, by convention, STL.
    Z,
}

impl UpAxis {
    /// Returns the letter of the axis: `x`, `y` or `z`.
    #[must_use]
    pub const fn letter(self) -> char {
        match self {
            Self::X => 'x',
            Self::Y => 'y',
            Self::Z => 'z',
        }
    }

    /// Returns the rotation to a system with y up. It is exact, because it only permutes and
    /// negates coordinates.
    fn to_y_up(self) -> Affine<ModelSpace, ModelSpace> {
        let [x, y, z] = match self {
            Self::X => [Vector::new(0.0, 1.0, 0.0), Vector::new(-1.0, 0.0, 0.0), Vector::Z],
            Self::Y => [Vector::X, Vector::Y, Vector::Z],
            Self::Z => [Vector::X, Vector::new(0.0, 0.0, -1.0), Vector::Y],
        };
        Affine::from_frame(x, y, z, Point::ORIGIN)
    }
}

impl Model {
    /// Gives every root node a parent that rotates the file's `up` axis to y.
    ///
    /// The roots themselves are not changed, because animations may set their transforms. The new
    /// nodes come last, so that the indices of all other nodes stay the same.
    pub fn rotate_roots(&mut self, up: UpAxis) {
        self.up_axis = up;
        if up == UpAxis::Y {
            return;
        }
        let to_parent = up.to_y_up();
        let mut parents = vec![None; self.nodes.len()];
        for (node, new_parent) in parents.iter_mut().enumerate() {
            let parent = self.nodes.len();
            let current = &mut self.nodes[node];
            current.to_model = current.to_model.then(to_parent);
            if current.parent.is_none() {
                (*new_parent, current.parent) = (Some(parent), Some(parent));
                let (trs, to_model, children) = (None, to_parent, vec![node]);
                self.nodes.push(Node { to_parent, to_model, trs, children, ..Node::default() });
            }
        }
        // The roots of inactive scenes have not been checked.
        let new_root =
            |node: &mut usize| *node = parents.get(*node).copied().flatten().unwrap_or(*node);
        self.roots.iter_mut().for_each(new_root);
        self.scenes.iter_mut().flat_map(|scene| &mut scene.nodes).for_each(new_root);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Mesh, Primitive};

    #[test]
    fn up_axes_are_rotated_to_y_exactly() {
        let corner = [1.0, 2.0, 3.0];
        for (up, expected) in
            [(UpAxis::X, [-2.0, 1.0, 3.0]), (UpAxis::Y, corner), (UpAxis::Z, [1.0, 3.0, -2.0])]
        {
            let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], corner.map(|x| x as f32)];
            let primitive = Primitive { indices: vec![2, 2, 2], positions, ..Primitive::default() };
            let mesh = Mesh { primitives: vec![primitive], ..Mesh::default() };
            let mut model = Model {
                meshes: vec![mesh],
                nodes: vec![Node { mesh: Some(0), ..Node::default() }],
                roots: vec![0],
                ..Model::default()
            };
            model.rotate_roots(up);
            // Only the vertex that an index refers to is a point of the scene.
            let points: Vec<_> = model.scene_points().iter().map(|p| p.raw().to_array()).collect();
            assert_eq!(points, [expected]);
            assert_eq!(model.up_axis, up);
            assert!(up.to_y_up().determinant() == 1.0);
        }
    }
}
