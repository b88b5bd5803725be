//! The copies of a model in a scene file.

use crate::scene::number::{Finite, NonNegative, Scale, Triple};
use serde::Deserialize;

/// A model many times. The model is scaled and turned first, as it says itself; then each copy goes to its place; then all of them
/// are moved together by the model's `translate`. A scene has 100,000 copies at most.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(rename = "Instances", deny_unknown_fields)]
pub enum InstancesFile {
    /// In rows, columns and layers: the first copy where the model is, the others beside it.
    Grid {
        /// How many along x, y and z, each at least 1.
        count: (u32, u32, u32),
        /// How far each is from the one before it along x, y and z, in the world's units.
        step: Triple,
    },
    /// On a circle around where the model is.
    Circle {
        /// How many, at least 1.
        count: u32,
        /// The radius in the world's units.
        radius: NonNegative,
        /// The axis of the circle, which is at right angles to it; its length does not matter, but is not 0. Default: y, a level circle.
        #[serde(default = "Triple::y_axis")]
        axis: Triple,
        /// Where the first copy is, in degrees, counter-clockwise around the axis: 0 is towards x; about the axis x, towards y. Default: 0.
        #[serde(default)]
        start_degrees: Finite,
        /// The angle that the copies divide: of a whole turn the last is one step before the first, else it is at the end. Default: 360.
        #[serde(default = "full_circle")]
        sweep_degrees: Finite,
        /// Whether each copy turns with its place, so that all show the same side to the middle. Default: true.
        #[serde(default = "yes")]
        turned: bool,
    },
    /// Each at a place of its own.
    List(Vec<InstanceFile>),
}

/// One copy: scaled, then turned, then moved.
#[derive(Clone, Copy, PartialEq, Debug, Default, Deserialize)]
#[serde(rename = "Instance", deny_unknown_fields, default)]
pub struct InstanceFile {
    /// The translation in the world's units. Default: (0, 0, 0).
    pub translate: Triple,
    /// Turns about the x, then the y, then the z axis, in degrees. Default: (0, 0, 0).
    pub rotate_degrees: Triple,
    /// One factor for all axes, or one for each; none of them 0. Default: 1.
    pub scale: Scale,
}

fn full_circle() -> Finite {
    Finite::known(360.0)
}

const fn yes() -> bool {
    true
}
