//! Animations: which numbers of which nodes change with time, and posing a model at a time.
//!
//! A curve has values at key times; what it is between two of them, its interpolation says (glTF 2.0 appendix C):
//!
//! ```text
//!  Step                Linear              CubicSpline
//!        ┌───•              •                  ╭─•      a value and two tangents at each key: the curve leaves a key
//!  •─────┘               ╱                   ╱          along the one and arrives along the other
//!                     •                   •─╯
//! ```
//!
//! Before the first key and after the last the values stand still. Rotations turn at constant speed about one axis.

use super::{Model, Parts};
use homog::Affine;

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

/// A property of a node that changes with time.
#[derive(Clone, PartialEq, Debug)]
pub struct Channel {
    /// The node.
    pub node: usize,
    /// Its property.
    pub property: Property,
    /// How it changes.
    pub curve: Curve,
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

/// Values at key times. All numbers are finite.
#[derive(Clone, PartialEq, Debug)]
pub struct Curve {
    /// What the values are between the keys.
    pub interpolation: Interpolation,
    /// The times of the keys in seconds, rising; at least one.
    pub times: Vec<f32>,
    /// `width` numbers for each key; for cubic splines three times as many: tangent before, value, tangent behind.
    pub values: Vec<f32>,
    /// The numbers of one value.
    pub width: usize,
}

/// What the values of a curve are between two keys.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Interpolation {
    /// That of the earlier key.
    Step,
    /// On the straight way from one to the other.
    Linear,
    /// On a cubic Hermite spline.
    CubicSpline,
}

impl Model {
    /// Poses the nodes as an animation has them at a time. What it does not change keeps its place; nodes that would leave
    /// the range of numbers do as well. Nothing happens if there is no such animation.
    pub fn pose(&mut self, animation: usize, seconds: f64) {
        let Some(Animation { channels, .. }) = self.animations.get(animation) else { return };
        for Channel { node, property, curve } in channels {
            let Some(node) = self.nodes.get_mut(*node) else { continue };
            let value = curve.at(seconds, *property);
            if *property == Property::Weights {
                node.weights = Some(value.iter().map(|&weight| weight as f32).collect());
            } else if let Some(parts) = &mut node.parts {
                set(parts, *property, &value);
            }
        }
        self.place_nodes();
    }

    /// Tells every node its place anew, parents first.
    fn place_nodes(&mut self) {
        let mut open: Vec<usize> =
            (0..self.nodes.len()).filter(|&at| self.nodes[at].parent.is_none()).collect();
        while let Some(at) = open.pop() {
            let above =
                self.nodes[at].parent.map_or(Affine::IDENTITY, |up| self.nodes[up].to_model);
            let node = &mut self.nodes[at];
            let posed = node.parts.and_then(|parts| parts.to_parent());
            let candidates = [posed.unwrap_or(node.to_parent), node.to_parent, Affine::IDENTITY];
            let fits = candidates.into_iter().find(|map| map.then(above).is_finite());
            node.to_parent = fits.unwrap_or(Affine::IDENTITY);
            node.to_model = node.to_parent.then(above);
            open.extend(&node.children);
        }
    }
}

fn set(parts: &mut Parts, property: Property, value: &[f64]) {
    match (property, value) {
        (Property::Translation, &[x, y, z]) => parts.translation = [x, y, z],
        (Property::Rotation, &[x, y, z, w]) => parts.rotation = [x, y, z, w],
        (Property::Scale, &[x, y, z]) => parts.scale = [x, y, z],
        _ => {}
    }
}

impl Curve {
    /// The value at a time; a rotation is a quaternion of any length but 0, or 0 where two opposite ones meet.
    #[must_use]
    pub fn at(&self, seconds: f64, property: Property) -> Vec<f64> {
        let after = self.times.partition_point(|&time| f64::from(time) <= seconds);
        let (from, to) = (after.saturating_sub(1), after.min(self.times.len().saturating_sub(1)));
        if from == to {
            return self.value(from).to_vec();
        }
        let [start, end] = [from, to].map(|key| f64::from(self.times[key]));
        let (length, part) = (end - start, (seconds - start) / (end - start));
        match (self.interpolation, property) {
            (Interpolation::Step, _) => self.value(from).to_vec(),
            (Interpolation::Linear, Property::Rotation) => {
                slerp(&self.value(from), &self.value(to), part)
            }
            (Interpolation::Linear, _) => {
                weighted(&[(1.0 - part, self.value(from)), (part, self.value(to))])
            }
            (Interpolation::CubicSpline, _) => {
                let (t, t2, t3) = (part, part * part, part * part * part);
                weighted(&[
                    (2.0 * t3 - 3.0 * t2 + 1.0, self.value(from)),
                    (length * (t3 - 2.0 * t2 + t), self.row(3 * from + 2)),
                    (-2.0 * t3 + 3.0 * t2, self.value(to)),
                    (length * (t3 - t2), self.row(3 * to)),
                ])
            }
        }
    }

    /// The value at a key.
    fn value(&self, key: usize) -> Vec<f64> {
        match self.interpolation {
            Interpolation::CubicSpline => self.row(3 * key + 1),
            _ => self.row(key),
        }
    }

    fn row(&self, row: usize) -> Vec<f64> {
        let numbers = self.values.get(row * self.width..).unwrap_or(&[]);
        numbers.iter().take(self.width).map(|&number| f64::from(number)).collect()
    }
}

fn weighted(rows: &[(f64, Vec<f64>)]) -> Vec<f64> {
    let width = rows.iter().map(|(_, row)| row.len()).min().unwrap_or(0);
    (0..width).map(|at| rows.iter().map(|(weight, row)| weight * row[at]).sum()).collect()
}

/// The rotation at a part of the shorter way from one to another, at constant speed.
fn slerp(from: &[f64], to: &[f64], part: f64) -> Vec<f64> {
    let unit = |q: &[f64]| {
        let length = libm::sqrt(q.iter().map(|x| x * x).sum());
        q.iter().map(|x| if length > 0.0 { x / length } else { 0.0 }).collect::<Vec<_>>()
    };
    let (from, to) = (unit(from), unit(to));
    let cosine: f64 = from.iter().zip(&to).map(|(a, b)| a * b).sum();
    let side = if cosine < 0.0 { -1.0 } else { 1.0 };
    let angle = libm::acos(cosine.abs().min(1.0));
    let sine = libm::sin(angle);
    // Where both are nearly the same the straight way is as good, and there is no division by nearly nothing.
    let (first, second) = if sine < 1e-6 {
        (1.0 - part, part)
    } else {
        (libm::sin(angle * (1.0 - part)) / sine, libm::sin(angle * part) / sine)
    };
    weighted(&[(first, from), (side * second, to)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Node;
    use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_8};

    fn curve(interpolation: Interpolation, times: &[f32], values: &[f32], width: usize) -> Curve {
        Curve { interpolation, times: times.to_vec(), values: values.to_vec(), width }
    }

    fn near(found: &[f64], due: &[f64]) -> bool {
        found.len() == due.len() && found.iter().zip(due).all(|(a, b)| (a - b).abs() < 1e-7)
    }

    #[test]
    fn steps_and_lines_stand_still_outside() {
        let [times, values] = [&[1.0, 2.0, 4.0], &[10.0, 20.0, 0.0]];
        for (seconds, step, line) in [
            (-1.0, 10.0, 10.0),
            (1.0, 10.0, 10.0),
            (1.5, 10.0, 15.0),
            (2.0, 20.0, 20.0),
            (3.5, 20.0, 5.0),
            (4.0, 0.0, 0.0),
            (f64::INFINITY, 0.0, 0.0),
        ] {
            let at = |kind| curve(kind, times, values, 1).at(seconds, Property::Weights);
            assert_eq!(at(Interpolation::Step), [step], "at {seconds}");
            assert_eq!(at(Interpolation::Linear), [line], "at {seconds}");
        }
        let one = curve(Interpolation::Linear, &[3.0], &[7.0, 8.0, 9.0], 3);
        assert_eq!(one.at(0.0, Property::Scale), [7.0, 8.0, 9.0]);
    }

    #[test]
    fn splines_are_the_cubics_they_were_made_of() {
        // x³ at 1 and 3: slopes 3 and 27; the tangents outside are never looked at.
        let keys = [99.0, 1.0, 3.0, 27.0, 27.0, 99.0];
        let spline = curve(Interpolation::CubicSpline, &[1.0, 3.0], &keys, 1);
        for x in [1.0, 1.25, 2.0, 2.75, 3.0] {
            assert!(near(&spline.at(x, Property::Weights), &[x * x * x]), "at {x}");
        }
        assert_eq!(spline.at(0.0, Property::Weights), [1.0]);
        assert_eq!(spline.at(9.0, Property::Weights), [27.0]);
    }

    #[test]
    fn a_pose_moves_nodes_and_what_hangs_on_them() {
        let node = |parent: Option<usize>, children: &[usize], parts: Parts| Node {
            name: None,
            to_parent: parts.to_parent().unwrap(),
            parts: Some(parts),
            to_model: Affine::IDENTITY,
            parent,
            children: children.to_vec(),
            mesh: None,
            places: None,
            weights: None,
            skin: None,
            camera: None,
        };
        let above = Parts { scale: [2.0; 3], ..Parts::default() };
        let below = Parts { translation: [1.0, 0.0, 0.0], ..Parts::default() };
        let channel = |node: usize, property: Property, values: &[f32], width: usize| {
            let curve = curve(Interpolation::Linear, &[0.0, 1.0], values, width);
            Channel { node, property, curve }
        };
        let largest = f32::MAX;
        let channels = vec![
            channel(0, Property::Translation, &[0.0, 0.0, 0.0, 0.0, 8.0, 0.0], 3),
            channel(1, Property::Rotation, &[0.0; 8], 4),
            channel(1, Property::Weights, &[0.0, 1.0, 1.0, 0.0], 2),
            channel(9, Property::Scale, &[largest; 6], 3),
        ];
        let mut model = Model {
            nodes: vec![node(None, &[1], above), node(Some(0), &[], below)],
            roots: vec![0],
            animations: vec![Animation { name: None, channels, duration_seconds: 1.0 }],
            ..Model::default()
        };
        model.pose(1, 0.0);
        assert_eq!(model.nodes[1].to_model, Affine::IDENTITY, "there is no such animation");
        model.pose(0, 0.25);
        let origin = model.instances()[1].node_to_model.point(homog::Point::ORIGIN);
        assert_eq!(<[f64; 3]>::from(origin), [2.0, 2.0, 0.0], "what is no rotation is not used");
        assert_eq!(model.nodes[1].to_model, model.instances()[1].node_to_model);
        assert_eq!(model.nodes[1].weights, Some(vec![0.25, 0.75]));
    }

    #[test]
    fn rotations_turn_at_constant_speed_on_the_shorter_way() {
        let (c, s) = (FRAC_1_SQRT_2 as f32, FRAC_1_SQRT_2 as f32);
        for sign in [1.0, -1.0] {
            // From rest to a quarter about y, written as one quaternion and as its opposite.
            let values = [0.0, 0.0, 0.0, 1.0, 0.0, sign * s, 0.0, sign * c];
            let turn = curve(Interpolation::Linear, &[0.0, 2.0], &values, 4);
            let due = [0.0, libm::sin(FRAC_PI_8), 0.0, libm::cos(FRAC_PI_8)];
            assert!(near(&turn.at(1.0, Property::Rotation), &due), "{sign}");
        }
        let still = curve(Interpolation::Linear, &[0.0, 1.0], &[0.0, 0.0, 0.6, 0.8].repeat(2), 4);
        assert!(near(&still.at(0.3, Property::Rotation), &[0.0, 0.0, 0.6, 0.8]));
    }
}
