//! Each line once: where pieces lie on each other, only the most important is drawn.
//!
//! ```text
//!   visible  ├────────┤                     ├────────┤
//!   hidden       ├────────────┤      ─►              ├────┤
//!   hidden                ├───────┤                       ├──┤   one piece with the one before, if of one object
//! ```
//! In a front view the edges of the back run exactly behind those of the front; drawn twice they would be darker, and their
//! dashes would fill each other's gaps. The order of importance is that of technical drawing: visible lines go before hidden ones
//! (ISO 128-2). Pieces of one object and layer that continue each other become one.

use glam::DVec2;
use std::collections::BTreeMap;

/// A straight piece of a line on the page, in millimetres.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Piece {
    pub(super) ends: [DVec2; 2],
    /// The layer, the most important first.
    pub(super) layer: u32,
    /// The object it belongs to.
    pub(super) object: u32,
}

/// Pieces nearer to each other than this are one, in millimetres. It is the size of a step of the page's grid.
const STEP: f64 = 1e-3;

/// Slopes that differ by less are one: over the longest sheet, 1.2 m, that is less than a step.
const SLOPE_STEP: f64 = 0.5e-6;

/// What is shorter, in millimetres, is left alone: its direction says too little.
const SHORTEST: f64 = 0.02;

/// A piece on its supporting line: from `start` to `end` along the axis the line runs along.
#[derive(Clone, Copy, Debug)]
struct Span {
    layer: u32,
    object: u32,
    /// Where the piece stands in the input.
    place: usize,
    ends: [DVec2; 2],
    from: f64,
    to: f64,
}

/// The supporting line, rounded so that pieces of one line share it: whether it is steep, its slope, where it meets the axis.
type Support = (bool, i64, i64);

/// Removes what is covered by something more important, and joins what continues each other. The result is in the order of the
/// input.
pub(super) fn once(pieces: &[Piece]) -> Vec<Piece> {
    let centre = centre(pieces);
    let mut kept: Vec<(usize, Piece)> = Vec::with_capacity(pieces.len());
    let mut spans: Vec<(Support, Span)> = Vec::new();
    for (place, piece) in pieces.iter().enumerate() {
        match support(piece, centre) {
            Some((support, from, to, ends)) => {
                let Piece { layer, object, .. } = *piece;
                spans.push((support, Span { layer, object, place, ends, from, to }));
            }
            None => kept.push((place, *piece)),
        }
    }
    spans.sort_unstable_by(|(one, a), (two, b)| {
        let of_span = |span: &Span| (span.layer, span.object);
        one.cmp(two)
            .then(of_span(a).cmp(&of_span(b)))
            .then(a.from.total_cmp(&b.from))
            .then(a.place.cmp(&b.place))
    });
    for line in spans.chunk_by(|(a, _), (b, _)| a == b) {
        uncover(line, &mut kept);
    }
    kept.sort_by_key(|(place, _)| *place);
    kept.into_iter().map(|(_, piece)| piece).collect()
}

/// A middle of everything, about which errors of slope count least.
fn centre(pieces: &[Piece]) -> DVec2 {
    let bounds = |f: fn(DVec2, DVec2) -> DVec2, start: f64| {
        pieces.iter().flat_map(|piece| piece.ends).fold(DVec2::splat(start), f)
    };
    let (least, greatest) = (bounds(DVec2::min, f64::INFINITY), bounds(DVec2::max, -f64::INFINITY));
    let middle = (least + greatest) * 0.5;
    if middle.is_finite() { middle } else { DVec2::ZERO }
}

/// The line that carries a piece, and from where to where the piece goes on it.
fn support(piece: &Piece, centre: DVec2) -> Option<(Support, f64, f64, [DVec2; 2])> {
    let [a, b] = piece.ends.map(|end| end - centre);
    let along = b - a;
    let steep = along.y.abs() > along.x.abs();
    let turned = |v: DVec2| if steep { DVec2::new(v.y, v.x) } else { v };
    let (a, along) = (turned(a), turned(along));
    if !(along.x.abs() >= SHORTEST && along.is_finite()) {
        return None;
    }
    let slope = along.y / along.x;
    let height = a.y - a.x * slope;
    let round = |value: f64, step: f64| libm::round(value / step) as i64;
    let support = (steep, round(slope, SLOPE_STEP), round(height, STEP));
    let (from, to) = (a.x, a.x + along.x);
    let [start, end] = piece.ends;
    let forward = from <= to;
    let ends = if forward { [start, end] } else { [end, start] };
    Some((support, from.min(to), from.max(to), ends))
}

/// The parts of one line's spans, sorted by importance and then along the line, that nothing before them covers.
fn uncover(line: &[(Support, Span)], kept: &mut Vec<(usize, Piece)>) {
    let mut covered = Covered::default();
    for equals in line.chunk_by(|(_, a), (_, b)| (a.layer, a.object) == (b.layer, b.object)) {
        let joined = joined(equals.iter().map(|(_, span)| *span));
        joined.iter().for_each(|span| covered.visible_parts(span, kept));
        joined.into_iter().for_each(|span| covered.add(span));
    }
}

/// The covered parts of a line by their beginnings; none touches another.
#[derive(Default)]
struct Covered(BTreeMap<i64, Span>);

/// A whole number that is ordered as the number is.
fn order(number: f64) -> i64 {
    let bits = number.to_bits() as i64;
    bits ^ (((bits >> 63) as u64) >> 1) as i64
}

impl Covered {
    /// Covers a span too.
    fn add(&mut self, mut span: Span) {
        while let Some((&at, last)) = self.0.range(..=order(span.to + STEP)).next_back() {
            if last.to + STEP < span.from {
                break;
            }
            if last.from < span.from {
                (span.from, span.ends[0]) = (last.from, last.ends[0]);
            }
            if last.to > span.to {
                (span.to, span.ends[1]) = (last.to, last.ends[1]);
            }
            self.0.remove(&at);
        }
        self.0.insert(order(span.from), span);
    }

    /// Keeps what of a span is beside all that is covered.
    fn visible_parts(&self, span: &Span, kept: &mut Vec<(usize, Piece)>) {
        let mut rest = *span;
        let mut keep = |from: f64, to: f64, ends| {
            if to - from > 2.0 * STEP {
                let piece = Piece { ends, layer: span.layer, object: span.object };
                kept.push((span.place, piece));
            }
        };
        let (from, to) = (order(span.from), order(span.to));
        let before = self.0.range(..from).next_back().filter(|(_, cover)| cover.to > span.from);
        for (_, cover) in before.into_iter().chain(self.0.range(from..to.max(from))) {
            keep(rest.from, cover.from, [rest.ends[0], cover.ends[0]]);
            (rest.from, rest.ends[0]) = (cover.to, cover.ends[1]);
        }
        keep(rest.from, rest.to, rest.ends);
    }
}

/// Spans in order of their beginnings, those that touch made one.
fn joined(spans: impl Iterator<Item = Span>) -> Vec<Span> {
    let mut joined: Vec<Span> = Vec::new();
    for span in spans {
        match joined.last_mut() {
            Some(last) if span.from <= last.to + STEP => {
                last.place = last.place.min(span.place);
                if span.to > last.to {
                    (last.to, last.ends[1]) = (span.to, span.ends[1]);
                }
            }
            _ => joined.push(span),
        }
    }
    joined
}

#[cfg(test)]
mod tests {
    use super::*;

    fn piece(layer: u32, object: u32, [x0, y0, x1, y1]: [f64; 4]) -> Piece {
        Piece { ends: [DVec2::new(x0, y0), DVec2::new(x1, y1)], layer, object }
    }

    /// The pieces on the line y = x/2, by their x.
    fn of(pieces: &[(u32, u32, f64, f64)]) -> Vec<(u32, u32, f64, f64)> {
        let on_line = |&(layer, object, a, b): &_| piece(layer, object, [a, a / 2.0, b, b / 2.0]);
        let round = |x: f64| libm::round(x * 1e6) / 1e6;
        let pieces: Vec<Piece> = pieces.iter().map(on_line).collect();
        let rest = once(&pieces);
        rest.iter().map(|p| (p.layer, p.object, round(p.ends[0].x), round(p.ends[1].x))).collect()
    }

    #[test]
    fn what_is_visible_covers_what_is_hidden() {
        let rest = of(&[(1, 0, 4.0, 9.0), (0, 0, 0.0, 5.0), (1, 1, 8.0, 12.0)]);
        assert_eq!(rest, [(1, 0, 5.0, 9.0), (0, 0, 0.0, 5.0), (1, 1, 9.0, 12.0)]);
        // From both sides, and from the middle; backwards too.
        let rest = of(&[(2, 0, 10.0, 0.0), (1, 0, 4.0, 5.0), (0, 3, -1.0, 1.0), (0, 4, 8.0, 20.0)]);
        let parts = [(2, 0, 1.0, 4.0), (2, 0, 5.0, 8.0)];
        assert_eq!(rest[..2], parts);
        assert_eq!(rest[2..], [(1, 0, 4.0, 5.0), (0, 3, -1.0, 1.0), (0, 4, 8.0, 20.0)]);
    }

    #[test]
    fn what_continues_itself_is_one_and_equal_lines_are_drawn_once() {
        assert_eq!(of(&[(0, 0, 0.0, 1.0), (0, 0, 1.0, 2.0), (0, 0, 0.5, 3.0)]), [(0, 0, 0.0, 3.0)]);
        assert_eq!(of(&[(0, 0, 0.0, 1.0), (0, 0, 1.0, 0.0)]), [(0, 0, 0.0, 1.0)]);
        // Other objects keep their own lines, and layers too.
        let apart = [(0, 0, 0.0, 1.0), (0, 1, 1.0, 2.0), (1, 1, 2.0, 3.0)];
        assert_eq!(of(&apart), apart);
    }

    #[test]
    fn a_hundred_thousand_pieces_on_one_line_take_no_long_time() {
        let count = 100_000_u32;
        let at = |k: u32| f64::from(k) * 0.25;
        let many: Vec<Piece> =
            (0..count).map(|k| piece(0, count - k, [at(k), 0.0, at(k) + 0.5, 0.0])).collect();
        let rest = once(&many);
        // The object with the least number is the last: it goes before the one it overlaps, and so on.
        assert_eq!(rest.len(), many.len());
        let length: f64 = rest.iter().map(|piece| (piece.ends[1] - piece.ends[0]).length()).sum();
        assert!((length - at(count) - 0.25).abs() < 1e-6, "{length}");
    }

    #[test]
    fn neighbours_and_crossings_are_left_alone() {
        let pieces = [
            piece(0, 0, [0.0, 0.0, 10.0, 0.0]),
            piece(1, 0, [0.0, 0.01, 10.0, 0.01]),
            piece(1, 0, [5.0, -5.0, 5.0, 5.0]),
            piece(1, 0, [0.0, 0.0, 10.0, 0.01]),
            piece(1, 0, [3.0, 0.0, 3.001, 0.0]),
        ];
        assert_eq!(once(&pieces), pieces);
        assert_eq!(once(&[]), []);
    }
}
