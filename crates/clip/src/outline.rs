//! Outlines: the edges of a section cut, joined into closed loops.

use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use homog::{Point, Space};

/// The outline of a cut face.
#[derive(Clone, PartialEq, Debug)]
pub struct Outline<S: Space> {
    /// Closed loops; the last point connects to the first. Seen from the positive side of the
    /// plane, outer loops are counterclockwise and holes clockwise, provided that the triangles of
    /// the surface are counterclockwise seen from outside.
    pub loops: Vec<Vec<Point<S>>>,
    /// Chains that do not close because the surface has a boundary. Closed surfaces have none.
    pub open: Vec<Vec<Point<S>>>,
}

impl<S: Space> Outline<S> {
    /// Joins edges whose endpoints are exactly equal, such as the edges from
    /// [`crate::CutTriangle::edge`].
    ///
    /// Edges are joined end to start where possible. Where the winding of the surface is
    /// inconsistent, they are reversed.
    ///
    /// ```
    /// use clip::{Outline, cut_triangle};
    /// use homog::{Normal, Plane, Point, World};
    /// let tip = Point::<World>::new(0.0, 2.0, 0.0);
    /// let base = [(1.0, 0.0), (0.0, -1.0), (-1.0, 0.0), (0.0, 1.0)];
    /// let base = base.map(|(x, z)| Point::new(x, 0.0, z));
    /// let sides = (0..4).map(|i| [base[i], base[(i + 1) % 4], tip]);
    /// let half_way = Plane::through(Point::new(0.0, 1.0, 0.0), Normal::new(0.0, -1.0, 0.0));
    /// let edges: Vec<_> = sides.filter_map(|side| cut_triangle(side, half_way).edge()).collect();
    /// let outline = Outline::from_edges(&edges);
    /// assert_eq!((outline.loops.len(), outline.loops[0].len(), outline.open.len()), (1, 4, 0));
    /// ```
    #[must_use]
    pub fn from_edges(edges: &[[Point<S>; 2]]) -> Self {
        let mut chains = EdgeChains::new(edges);
        let mut outline = Self { loops: Vec::new(), open: Vec::new() };
        for first in 0..edges.len() {
            if chains.used[first] {
                continue;
            }
            let chain = chains.take_chain(first);
            match chain.as_slice() {
                [start, .., end] if start == end => {
                    if chain.len() > 3 {
                        outline.loops.push(chain[1..].to_vec());
                    }
                }
                _ => outline.open.push(chain),
            }
        }
        outline
    }

    /// Returns whether every edge is part of a loop.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        self.open.is_empty()
    }
}

/// The exact coordinates of a point, with −0 replaced by 0.
type PointKey = [u64; 3];

fn point_key<S: Space>(point: Point<S>) -> PointKey {
    point.raw().to_array().map(|x| (x + 0.0).to_bits())
}

struct EdgeChains<'a, S: Space> {
    edges: &'a [[Point<S>; 2]],
    /// The edges at each point, beginning with the edges that start there.
    at: BTreeMap<PointKey, Vec<usize>>,
    used: Vec<bool>,
}

impl<'a, S: Space> EdgeChains<'a, S> {
    fn new(edges: &'a [[Point<S>; 2]]) -> Self {
        let mut at: BTreeMap<PointKey, Vec<usize>> = BTreeMap::new();
        for end in 0..2 {
            for (i, edge) in edges.iter().enumerate() {
                at.entry(point_key(edge[end])).or_default().push(i);
            }
        }
        Self { edges, at, used: edges.iter().map(|[a, b]| a == b).collect() }
    }

    /// Returns the longest chain that contains this edge, up to the point where it closes.
    fn take_chain(&mut self, first: usize) -> Vec<Point<S>> {
        self.used[first] = true;
        let mut chain = self.edges[first].to_vec();
        self.extend_chain(&mut chain);
        if chain.first() != chain.last() {
            // The chain did not close, so it may continue at its other end.
            chain.reverse();
            self.extend_chain(&mut chain);
            chain.reverse();
        }
        chain
    }

    fn extend_chain(&mut self, chain: &mut Vec<Point<S>>) {
        while let [start, .., end] = chain.as_slice() {
            let next = if start == end { None } else { self.take_next_edge(*end) };
            let Some(next) = next else { return };
            chain.push(next);
        }
    }

    /// Takes an unused edge at this point and returns its other end.
    fn take_next_edge(&mut self, point: Point<S>) -> Option<Point<S>> {
        let edges = self.at.get(&point_key(point))?;
        let next = *edges.iter().find(|&&edge| !self.used[edge])?;
        self.used[next] = true;
        let [start, end] = self.edges[next];
        Some(if start == point { end } else { start })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use homog::World;

    fn edges(pairs: &[(u8, u8)]) -> Vec<[Point<World>; 2]> {
        let place = |i: u8| Point::new(f64::from(i % 4), f64::from(i / 4), 0.0);
        pairs.iter().map(|&(a, b)| [place(a), place(b)]).collect()
    }

    #[test]
    fn scattered_edges_are_joined() {
        let two_squares =
            edges(&[(0, 1), (10, 14), (5, 4), (14, 15), (1, 5), (11, 10), (4, 0), (15, 11)]);
        let outline = Outline::from_edges(&two_squares);
        assert!(outline.is_closed());
        assert_eq!(outline.loops.iter().map(Vec::len).collect::<Vec<_>>(), [4, 4]);
    }

    #[test]
    fn reversed_edges_are_turned_around() {
        let outline = Outline::from_edges(&edges(&[(0, 1), (5, 1), (4, 5), (0, 4)]));
        assert_eq!((outline.loops.len(), outline.open.len()), (1, 0));
    }

    #[test]
    fn open_surfaces_have_open_outlines() {
        let outline = Outline::from_edges(&edges(&[(1, 2), (0, 1), (2, 6), (8, 8)]));
        assert!(outline.loops.is_empty() && !outline.is_closed());
        assert_eq!(outline.open[0].len(), 4);
        assert_eq!(outline.open[0][0], Point::ORIGIN);
        assert!(Outline::<World>::from_edges(&[]).is_closed());
    }

    #[test]
    fn two_opposite_edges_are_not_a_loop() {
        let outline = Outline::from_edges(&edges(&[(0, 1), (1, 0)]));
        assert_eq!(outline, Outline { loops: Vec::new(), open: Vec::new() });
    }
}
