//! Animations: which numbers of a model change with time. [`Model::pose`](super::Model::pose) sets them.

use super::{Curve, Field, UvPart};

/// An animation of the file.
#[derive(Clone, PartialEq, Debug)]
pub struct Animation {
    /// The name in the file, if it has one.
    pub name: Option<String>,
    /// What changes.
    pub channels: Vec<Channel>,
    /// The time of the last key in seconds.
    pub duration_seconds: f64,
}

/// Something that changes with time.
#[derive(Clone, PartialEq, Debug)]
pub struct Channel {
    /// What it is.
    pub target: Target,
    /// How it changes.
    pub curve: Curve,
}

/// What a channel changes. All numbers in it are those of existing things.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Target {
    /// A property of a node.
    Node {
        /// The node.
        node: usize,
        /// Its property.
        property: Property,
    },
    /// One of the weights of a node.
    NodeWeight {
        /// The node.
        node: usize,
        /// The morph target.
        target: usize,
    },
    /// The weights of a mesh, for all nodes that have none of their own.
    MeshWeights {
        /// The mesh.
        mesh: usize,
        /// The morph target, or all of them.
        target: Option<usize>,
    },
    /// Numbers of a material, light or camera.
    Field {
        /// Which numbers.
        field: Field,
        /// The number of the material, light or camera.
        of: usize,
    },
    /// The way a texture lies.
    Texture {
        /// The entry of [`Model::uv_transforms`](super::Model::uv_transforms).
        transform: usize,
        /// Which part of it.
        part: UvPart,
    },
}

/// What of a node an animation changes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Property {
    /// The translation, three numbers.
    Translation,
    /// The rotation, a quaternion.
    Rotation,
    /// The scale, three numbers.
    Scale,
    /// The weights of the morph targets, a number for each.
    Weights,
}
