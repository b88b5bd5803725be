//! Removes speckles: lines that are too short to show anything.
//!
//! ```text
//!   ──────╮  ·          a dot: a chain shorter than the pen is wide
//!         ╰─────·──     a stub of a crease or intersection next to longer lines
//! ```
//!
//! On scanned surfaces, single facets can be silhouettes, and rounding errors make touching bodies
//! intersect in places. An edge that bridges a gap between longer lines stays, however short.

use super::polyline_chain::PolylineChain;
use page::PagePoint;

/// The minimum length of chains on paper, in millimeters: about the width of a line on a screen.
pub(super) const LEAST_CHAIN_LENGTH: f64 = 0.3;

/// The treatment of a layer's short chains. Each number is the length, in millimeters, below which
/// a chain is short.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum ShortChains {
    /// Drawn.
    Retained,
    /// Removed if the total length of all connected chains is also below this length.
    RemovedAlone(f64),
    /// Like `RemovedAlone`, but also removed if they branch off a longer line and have a free end.
    RemovedAtEnds(f64),
    /// Removed unless both of their ends are on longer lines.
    RemovedUnlessBridge(f64),
    /// Always removed.
    Removed(f64),
}

impl ShortChains {
    /// Returns the minimum length of chains that are always drawn.
    fn least_length(self) -> f64 {
        match self {
            Self::Retained => 0.0,
            Self::RemovedAlone(least)
            | Self::RemovedAtEnds(least)
            | Self::RemovedUnlessBridge(least)
            | Self::Removed(least) => least,
        }
    }
}

/// Removes speckles by the rule for each layer.
pub(super) fn remove_speckles(
    chains: Vec<PolylineChain>,
    rule: impl Fn(u32) -> ShortChains,
) -> Vec<PolylineChain> {
    let lengths: Vec<f64> = chains.iter().map(|chain| chain.polyline.length()).collect();
    let is_long: Vec<bool> = chains
        .iter()
        .zip(&lengths)
        .map(|(chain, length)| *length >= rule(chain.layer).least_length())
        .collect();
    if is_long.iter().all(|long| *long) {
        return chains;
    }
    let contacts = Contacts::new(&chains);
    let together = contacts.connected_lengths(&lengths);
    let is_kept = |(index, chain): (usize, &PolylineChain)| {
        if is_long[index] {
            return true;
        }
        let points = &chain.polyline.points;
        let ends = [points[0], points[points.len() - 1]];
        let on_long = ends.map(|end| contacts.others_at(end, index).any(|other| is_long[other]));
        let is_free = ends.map(|end| contacts.others_at(end, index).next().is_none());
        let is_stub = on_long[0] && is_free[1] || on_long[1] && is_free[0];
        match rule(chain.layer) {
            ShortChains::Retained => true,
            ShortChains::RemovedAlone(least) => together[index] >= least,
            ShortChains::RemovedAtEnds(least) => together[index] >= least && !is_stub,
            ShortChains::RemovedUnlessBridge(_) => !chain.polyline.closed && on_long == [true; 2],
            ShortChains::Removed(_) => false,
        }
    };
    let kept: Vec<bool> = chains.iter().enumerate().map(is_kept).collect();
    let mut kept = kept.into_iter();
    chains.into_iter().filter(|_| kept.next() == Some(true)).collect()
}

/// The chains at each point, sorted so that chains at one point are neighbors.
struct Contacts {
    corners: Vec<(PagePoint, usize)>,
    count: usize,
}

impl Contacts {
    /// Collects the points of all chains.
    fn new(chains: &[PolylineChain]) -> Self {
        let mut corners: Vec<(PagePoint, usize)> = Vec::new();
        for (index, chain) in chains.iter().enumerate() {
            corners.extend(chain.polyline.points.iter().map(|point| (*point, index)));
        }
        corners.sort_unstable();
        Self { corners, count: chains.len() }
    }

    /// Returns the chains at a point, except `chain`.
    fn others_at(&self, point: PagePoint, chain: usize) -> impl Iterator<Item = usize> {
        let first = self.corners.partition_point(|(other, _)| *other < point);
        let here = self.corners[first..].iter().take_while(move |(other, _)| *other == point);
        here.map(|(_, other)| *other).filter(move |other| *other != chain)
    }

    /// Returns, for each chain, the total length of all chains connected to it by common points.
    fn connected_lengths(&self, lengths: &[f64]) -> Vec<f64> {
        // Union-find: each chain points to an earlier connected chain, or to itself.
        let mut parents: Vec<usize> = (0..self.count).collect();
        for pair in self.corners.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
            let [a, b] = [pair[0].1, pair[1].1].map(|chain| root_of(&mut parents, chain));
            parents[a.max(b)] = a.min(b);
        }
        let mut totals = vec![0.0; self.count];
        for (index, length) in lengths.iter().enumerate() {
            totals[root_of(&mut parents, index)] += length;
        }
        (0..self.count).map(|index| totals[root_of(&mut parents, index)]).collect()
    }
}

/// Returns the first chain of a connected set and halves the path to it.
fn root_of(parents: &mut [usize], mut chain: usize) -> usize {
    while parents[chain] != chain {
        parents[chain] = parents[parents[chain]];
        chain = parents[chain];
    }
    chain
}

#[cfg(test)]
mod tests {
    use super::*;
    use page::Polyline;

    /// Returns a chain in a layer through collinear points, in micrometers.
    fn chain(layer: u32, xs: &[i32]) -> PolylineChain {
        let points = xs.iter().map(|x| [*x, 0]).collect();
        PolylineChain { layer, object: 0, polyline: Polyline { points, closed: false } }
    }

    #[test]
    fn dots_and_stubs_are_removed_and_bridges_stay() {
        let chains = vec![
            chain(0, &[0, 5000]),
            chain(1, &[5000, 5100]),
            chain(0, &[5100, 9000]),
            chain(1, &[9000, 9100]),
            chain(0, &[20_000, 20_100]),
            chain(0, &[20_100, 20_150]),
            chain(2, &[30_000, 30_010]),
            chain(0, &[-100, 0]),
            chain(3, &[5000, 5100]),
        ];
        let rule = |layer| match layer {
            0 => ShortChains::RemovedAtEnds(0.3),
            1 => ShortChains::RemovedUnlessBridge(0.3),
            3 => ShortChains::Removed(0.3),
            _ => ShortChains::Retained,
        };
        let kept = remove_speckles(chains.clone(), rule);
        let expected = [0, 1, 2, 6].map(|index| chains[index].clone());
        assert_eq!(kept, expected);
    }

    #[test]
    fn short_lines_of_one_outline_stay_together() {
        let steps: Vec<PolylineChain> =
            (0..10).map(|k| chain(k as u32 % 2, &[k * 100, k * 100 + 100])).collect();
        let kept = remove_speckles(steps.clone(), |_| ShortChains::RemovedAlone(0.3));
        assert_eq!(kept, steps);
        let dot = remove_speckles(steps[..2].to_vec(), |_| ShortChains::RemovedAlone(0.3));
        assert_eq!(dot, []);
    }
}
