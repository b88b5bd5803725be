//! Keyframe animations: channels that change nodes, morph weights, materials, lights and cameras.
//!
//! [`Model::apply_animation`](crate::Model::apply_animation) poses a model at a given time.

mod curve;
pub mod object_model;
mod pose;

pub use curve::{AnimationCurve, Interpolation};
pub use object_model::ObjectProperty;

use crate::UvTransformPart;

/// A keyframe animation.
#[derive(Clone, PartialEq, Debug)]
pub struct Animation {
    /// The name in the file, if it has one.
    pub name: Option<String>,
    /// The channels, in the order in which they are applied.
    pub channels: Vec<AnimationChannel>,
    /// Time of the last keyframe in any channel, in seconds.
    pub duration_seconds: f64,
}

/// An animation channel: a property and the curve it follows.
#[derive(Clone, PartialEq, Debug)]
pub struct AnimationChannel {
    /// The animated property.
    pub target: AnimationTarget,
    /// The value of the property over time.
    pub curve: AnimationCurve,
}

/// The target of an animation channel. All indices are in range.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum AnimationTarget {
    /// The translation, rotation, scale or morph weights of a node.
    Node {
        /// Index of the node.
        node: usize,
        /// The property of the node.
        property: NodeProperty,
    },
    /// A single morph weight of a node.
    NodeMorphWeight {
        /// Index of the node.
        node: usize,
        /// Index of the morph target.
        target: usize,
    },
    /// Morph weights of a mesh, for all nodes that do not override them.
    MeshMorphWeights {
        /// Index of the mesh.
        mesh: usize,
        /// Index of the morph target, or `None` for all targets.
        target: Option<usize>,
    },
    /// A property of a material, light or camera (KHR_animation_pointer).
    ObjectProperty {
        /// The property.
        property: ObjectProperty,
        /// Index of the material, light or camera.
        index: usize,
    },
    /// A texture transform.
    TextureTransform {
        /// Index into [`Model::uv_transforms`](crate::Model::uv_transforms).
        transform: usize,
        /// The property of the transform.
        part: UvTransformPart,
    },
}

/// An animatable property of a node.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum NodeProperty {
    /// Translation, three numbers.
    Translation,
    /// Rotation, a quaternion.
    Rotation,
    /// Scale, three numbers.
    Scale,
    /// Morph target weights, one number per target.
    Weights,
}
