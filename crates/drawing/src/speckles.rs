//! Speckles: lines too short to show anything, which are left out.
//!
//! ```text
//!   ──────╮  ·          a chain that is shorter than a pen is wide is a dot
//!         ╰─────·──     a stub of a crease or a crossing beside longer lines
//! ```
//!
//! On scanned surfaces single facets are silhouettes, and bodies that touch cross each other here
//! and there by the width of a rounding. What bridges a gap between longer lines stays, however
//! short.

use super::page::PagePoint;
use super::polyline_chain::PolylineChain;

/// The least length of chains on paper, in millimeters: about the width of a line on a screen.
pub(super) const LEAST_CHAIN_LENGTH: f64 = 0.3;

/// The treatment of short chains of a layer.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum ShortChains {
    /// They are drawn.
    Retained,
    /// They are left out where all lines connected with them are shorter than this together, in
    /// millimeters.
    RemovedAlone(f64),
    /// They are left out unless both of their ends are on longer lines.
    Removed(f64),
}

/// Removes speckles, by the rule of each layer.
pub(super) fn remove_speckles(
    chains: Vec<PolylineChain>,
    rule: impl Fn(u32) -> ShortChains,
) -> Vec<PolylineChain> {
    let least = |chain: &PolylineChain| match rule(chain.layer) {
        ShortChains::Retained => 0.0,
        ShortChains::RemovedAlone(least) | ShortChains::Removed(least) => least,
    };
    let lengths: Vec<f64> = chains.iter().map(|chain| chain.polyline.length()).collect();
    if chains.iter().zip(&lengths).all(|(chain, length)| *length >= least(chain)) {
        return chains;
    }
    let together = connected_lengths(&chains, &lengths);
    let mut long_points: Vec<PagePoint> = Vec::new();
    for (chain, length) in chains.iter().zip(&lengths) {
        if *length >= least(chain) {
            long_points.extend(&chain.polyline.points);
        }
    }
    long_points.sort_unstable();
    let is_on_long = |point: Option<&PagePoint>| {
        point.is_some_and(|point| long_points.binary_search(point).is_ok())
    };
    let is_kept = |(index, chain): (usize, &PolylineChain)| {
        let points = &chain.polyline.points;
        let bridges =
            || !chain.polyline.closed && is_on_long(points.first()) && is_on_long(points.last());
        match rule(chain.layer) {
            ShortChains::Retained => true,
            ShortChains::RemovedAlone(least) => together[index] >= least,
            ShortChains::Removed(least) => lengths[index] >= least || bridges(),
        }
    };
    let kept: Vec<bool> = chains.iter().enumerate().map(is_kept).collect();
    let mut kept = kept.into_iter();
    chains.into_iter().filter(|_| kept.next() == Some(true)).collect()
}

/// For each chain the length of all chains that are connected with it by common points.
fn connected_lengths(chains: &[PolylineChain], lengths: &[f64]) -> Vec<f64> {
    let mut corners: Vec<(PagePoint, usize)> = Vec::new();
    for (index, chain) in chains.iter().enumerate() {
        corners.extend(chain.polyline.points.iter().map(|point| (*point, index)));
    }
    corners.sort_unstable();
    // Union-find: each chain points to an earlier one that it is connected with, or to itself.
    let mut parents: Vec<usize> = (0..chains.len()).collect();
    for pair in corners.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
        let [a, b] = [pair[0].1, pair[1].1].map(|chain| root_of(&mut parents, chain));
        parents[a.max(b)] = a.min(b);
    }
    let mut totals = vec![0.0; chains.len()];
    for (index, length) in lengths.iter().enumerate() {
        totals[root_of(&mut parents, index)] += length;
    }
    (0..chains.len()).map(|index| totals[root_of(&mut parents, index)]).collect()
}

/// The first chain of a connected set; the path to it is halved.
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
    use crate::Polyline;

    /// A chain of a layer through points on one line, given in micrometers.
    fn chain(layer: u32, xs: &[i32]) -> PolylineChain {
        let points = xs.iter().map(|x| [*x, 0]).collect();
        PolylineChain { layer, object: 0, polyline: Polyline { points, closed: false } }
    }

    #[test]
    fn dots_and_stubs_go_and_bridges_stay() {
        let chains = vec![
            chain(0, &[0, 5000]),
            chain(1, &[5000, 5100]),
            chain(0, &[5100, 9000]),
            chain(1, &[9000, 9100]),
            chain(0, &[20_000, 20_100]),
            chain(0, &[20_100, 20_150]),
            chain(2, &[30_000, 30_010]),
        ];
        let rule = |layer| match layer {
            0 => ShortChains::RemovedAlone(0.3),
            1 => ShortChains::Removed(0.3),
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
