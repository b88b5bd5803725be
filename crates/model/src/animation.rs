//! Animations: which numbers of a model change with time. [`Model::pose`](crate::Model::pose) sets them.

mod curve;
pub(crate) mod object_model;
mod pose;

pub use curve::{AnimationCurve, Interpolation};
pub use object_model::ObjectProperty;

use crate::UvTransformPart;

/// An animation of the file.
#[derive(Clone, PartialEq, Debug)]
pub struct Animation {
    /// The name in the file, if it has one.
    pub name: Option<String>,
    /// What changes.
    pub channels: Vec<AnimationChannel>,
    /// The time of the last key in seconds.
    pub duration_seconds: f64,
}

/// Something that changes with time.
#[derive(Clone, PartialEq, Debug)]
pub struct AnimationChannel {
    /// What it is.
    pub target: AnimationTarget,
    /// How it changes.
    pub curve: AnimationCurve,
}

/// What a channel changes. All numbers in it are those of existing things.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum AnimationTarget {
    /// A property of a node.
    Node {
        /// The node.
        node: usize,
        /// Its property.
        property: NodeProperty,
    },
    /// One of the weights of a node.
    NodeMorphWeight {
        /// The node.
        node: usize,
        /// The morph target.
        target: usize,
    },
    /// The weights of a mesh, for all nodes that have none of their own.
    MeshMorphWeights {
        /// The mesh.
        mesh: usize,
        /// The morph target, or all of them.
        target: Option<usize>,
    },
    /// Numbers of a material, light or camera.
    ObjectProperty {
        /// Which numbers.
        property: ObjectProperty,
        /// The number of the material, light or camera.
        index: usize,
    },
    /// The way a texture lies.
    TextureTransform {
        /// The entry of [`Model::uv_transforms`](crate::Model::uv_transforms).
        transform: usize,
        /// Which part of it.
        part: UvTransformPart,
    },
}

/// What of a node an animation changes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum NodeProperty {
    /// The translation, three numbers.
    Translation,
    /// The rotation, a quaternion.
    Rotation,
    /// The scale, three numbers.
    Scale,
    /// The weights of the morph targets, a number for each.
    Weights,
}
