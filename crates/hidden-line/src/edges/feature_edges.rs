//! Feature edges that do not depend on the viewer: the creases and boundaries of each object,
//! joined into smooth chains.
//!
//! The rims of holes and shafts are such chains. The `circles` module finds circles among them.

use super::half_edges::HalfEdge;
use super::welded_surface::WeldedSurface;
use glam::DVec3;
use std::collections::BTreeMap;

/// The cosine of 30 degrees, the maximum turn within a chain. A sharper corner is the corner of a
/// polygon, not part of a circle.
const CHAIN_COSINE: f64 = 0.866;

/// A crease or boundary of an object.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct FeatureEdge {
    /// The indices of the end vertices.
    pub(crate) ends: [u32; 2],
    pub(crate) object: u32,
}

/// A chain of consecutive edges of one object, open or closed.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct FeatureChain {
    pub(crate) points: Vec<DVec3>,
    pub(crate) is_closed: bool,
    pub(crate) object: u32,
}

impl WeldedSurface {
    /// Returns the creases sharper than `crease_angle`, in radians, and the boundaries, by object.
    ///
    /// An edge where several objects touch is tested for each of them.
    pub(crate) fn feature_edges(&self, crease_angle: f64) -> Vec<FeatureEdge> {
        let mesh = self.mesh();
        let normals: Vec<DVec3> = mesh
            .faces
            .iter()
            .map(|face| {
                let [a, b, c] = face.vertices.map(|vertex| mesh.points[vertex as usize]);
                (b - a).cross(c - a).normalize_or_zero()
            })
            .collect();
        let crease_cosine = libm::cos(crease_angle);
        let along = |side: &HalfEdge| {
            let normal = normals[side.face() as usize];
            if side.is_forward() { normal } else { -normal }
        };
        let mut features = Vec::new();
        self.for_each_edge(|ends, sides| {
            let mut objects: Vec<u32> =
                sides.iter().map(|side| mesh.faces[side.face() as usize].object).collect();
            objects.sort_unstable();
            objects.dedup();
            for object in objects {
                let own = sides.iter().filter(|s| mesh.faces[s.face() as usize].object == object);
                let own: Vec<DVec3> = own.map(along).collect();
                let is_feature = match own[..] {
                    [one, other] => one.dot(-other) < crease_cosine,
                    _ => true,
                };
                if is_feature {
                    features.push(FeatureEdge { ends, object });
                }
            }
        });
        features.sort_by_key(|edge| (edge.object, edge.ends));
        features.dedup();
        features
    }

    /// Joins the feature edges into smooth chains.
    pub(crate) fn feature_chains(&self, edges: &[FeatureEdge]) -> Vec<FeatureChain> {
        let of_objects = edges.chunk_by(|a, b| a.object == b.object);
        of_objects.flat_map(|edges| chains_of_object(edges, &self.mesh().points)).collect()
    }
}

/// Joins the edges of one object into chains.
///
/// Two edges at a vertex are joined if each is the straightest continuation of the other.
fn chains_of_object(edges: &[FeatureEdge], points: &[DVec3]) -> Vec<FeatureChain> {
    let mut at_vertex: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
    for (index, edge) in edges.iter().enumerate() {
        for end in edge.ends {
            at_vertex.entry(end).or_default().push(index);
        }
    }
    let other_end = |edge: usize, end: u32| {
        let [a, b] = edges[edge].ends;
        if a == end { b } else { a }
    };
    let away = |edge: usize, from: u32| {
        let (start, end) = (points[from as usize], points[other_end(edge, from) as usize]);
        (end - start).normalize_or_zero()
    };
    let straightest = |edge: usize, at: u32| {
        let onward = -away(edge, at);
        let others = at_vertex[&at].iter().copied().filter(|other| *other != edge);
        let turns = others.map(|other| (away(other, at).dot(onward), other));
        let best = turns.max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)))?;
        (best.0 > CHAIN_COSINE).then_some(best.1)
    };
    let next = |edge: usize, at: u32| {
        let next = straightest(edge, at)?;
        (straightest(next, at) == Some(edge)).then_some(next)
    };
    let (mut is_used, mut chains) = (vec![false; edges.len()], Vec::new());
    for first in 0..edges.len() {
        if is_used[first] {
            continue;
        }
        is_used[first] = true;
        let [start, end] = edges[first].ends;
        let mut vertices = vec![start, end];
        let (object, mut is_closed) = (edges[first].object, false);
        for forward in [true, false] {
            let (mut edge, mut at) = (first, if forward { end } else { start });
            while let Some(following) = next(edge, at) {
                if is_used[following] {
                    is_closed |= forward && following == first;
                    break;
                }
                is_used[following] = true;
                at = other_end(following, at);
                edge = following;
                vertices.push(at);
            }
            if is_closed {
                break;
            }
            vertices.reverse();
        }
        if is_closed {
            vertices.pop();
        }
        let points = vertices.into_iter().map(|vertex| points[vertex as usize]).collect();
        chains.push(FeatureChain { points, is_closed, object });
    }
    chains
}
