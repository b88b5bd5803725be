//! Length dimensions beside a view: single lengths, chains on one line, and parallel lengths from a
//! baseline (ISO 129-1).
//!
//! ```text
//!     chain                      baseline
//!       │◄─20─►│◄──35──►│          │◄──────55──────►│
//!       │      │        │          │◄─20─►│         │
//!       ┌──────┬────────┐          ┌──────┬─────────┐
//! ```
//!
//! If two arrowheads do not fit between extension lines, oblique strokes replace the inner
//! arrowheads of a chain. A number that does not fit is placed beyond the end of the line, or
//! farther out with a leader.

use super::annotation::{AnnotationLayer, AnnotationShape, AnnotationText};
use super::collision::{convex_overlap, reach_between, text_outline};
use super::dimension::{
    ARROW_LENGTH, EXTENSION_GAP, EXTENSION_OVERHANG, LINE_DISTANCE, TEXT_GAP, arrowhead,
};
use super::dimension_board::{Candidate, DimensionBoard};
use super::measure::{ViewDimension, ViewMeasure};
use glam::DVec2;
use page::{Label, TextAlign};

/// The distance between dimension lines, in character heights.
const ROW_DISTANCE: f64 = 2.2;

/// The number of rows to try on each side.
const MAX_ROWS: u32 = 30;

/// The minimum length between arrowheads, in arrowhead lengths.
const LEAST_BETWEEN_ARROWS: f64 = 3.5;

/// Half the side of the square whose diagonal is an oblique stroke, in character heights.
const STROKE: f64 = 0.3;

/// The length reserved for the extension lines of later rows, in character heights.
const FAR: f64 = 200.0;

/// The number of levels to try for a number with a leader.
const TEXT_LEVELS: u32 = 6;

/// Lengths on one dimension line.
struct LengthRow<'a> {
    /// The measured points, sorted by position along the line, in millimeters on paper.
    feet: &'a [DVec2],
    /// The unit vector along the line, in the reading direction of the numbers.
    along: DVec2,
    /// The unit vector from the part to the line.
    outward: DVec2,
    /// The position of the line along `outward`.
    level: f64,
    /// The numbers for the lengths between neighboring points.
    texts: &'a [String],
    letters: f64,
    /// Whether a single number that does not fit is placed before the line instead of after it.
    is_text_first: bool,
}

impl DimensionBoard {
    /// Returns the free positions for lengths: one for a chain, or one for each length from a
    /// baseline.
    pub(super) fn length_candidates(&self, dimension: &ViewDimension) -> Vec<Option<Candidate>> {
        let ViewMeasure::Lengths { feet, along, is_baseline, .. } = &dimension.measure else {
            return Vec::new();
        };
        let along = *along;
        let ratio = self.settings.scale.ratio();
        let mut feet: Vec<DVec2> = feet.iter().map(|foot| *foot * ratio).collect();
        let sides = self.sides(dimension, &feet, along);
        if !is_baseline {
            feet.sort_by(|a, b| a.dot(along).total_cmp(&b.dot(along)));
            return vec![self.row_candidate(dimension, &feet, along, &sides)];
        }
        let base = feet.remove(0);
        // Baseline dimensions are nested, with the shortest closest to the part.
        feet.sort_by(|a, b| {
            let [a, b] = [a, b].map(|foot| (*foot - base).dot(along).abs());
            a.total_cmp(&b)
        });
        let on_side = |outward: &DVec2| {
            let rows = self.baseline_rows(dimension, base, &feet, along, *outward);
            rows.into_iter().collect::<Option<Vec<Candidate>>>()
        };
        // All lengths are on the same side. If there is no room for one of them, none is drawn.
        match sides.iter().find_map(on_side) {
            Some(rows) => rows.into_iter().map(Some).collect(),
            None => vec![None],
        }
    }

    /// Returns the free positions for the lengths from a baseline on one side, with the shortest
    /// next to the part.
    fn baseline_rows(
        &self,
        dimension: &ViewDimension,
        base: DVec2,
        feet: &[DVec2],
        along: DVec2,
        outward: DVec2,
    ) -> Vec<Option<Candidate>> {
        let mut board = self.clone();
        let reach = outward * (FAR * self.settings.letters);
        let mut rows = Vec::new();
        for (index, foot) in feet.iter().enumerate() {
            let mut pair = [base, *foot];
            pair.sort_by(|a, b| a.dot(along).total_cmp(&b.dot(along)));
            // The extension lines of later rows will pass this one.
            let mut trial = board.clone();
            feet[index + 1..].iter().for_each(|foot| trial.reserve_line([*foot, *foot + reach]));
            let row = trial.row_candidate(dimension, &pair, along, &[outward]);
            row.iter().for_each(|row| board.take(row));
            rows.push(row);
        }
        rows
    }

    /// Returns the possible sides of a dimension line: the requested side, or both sides, starting
    /// with the side that has the shorter extension lines.
    fn sides(&self, dimension: &ViewDimension, feet: &[DVec2], along: DVec2) -> Vec<DVec2> {
        let above = DVec2::new(along.y, -along.x);
        let wanted = dimension.side.map(|side| side.outward().dot(above));
        match wanted {
            Some(part) if part > 1e-9 => return vec![above],
            Some(part) if part < -1e-9 => return vec![-above],
            _ => {}
        }
        let longest = |outward: DVec2| {
            let level = self.level_beside(feet, along, outward);
            feet.iter().fold(0.0, |most: f64, foot| most.max(level - foot.dot(outward)))
        };
        if longest(-above) < longest(above) - 1e-6 {
            vec![-above, above]
        } else {
            vec![above, -above]
        }
    }

    /// Returns how far the part extends in the direction `outward` beside a length.
    fn level_beside(&self, feet: &[DVec2], along: DVec2, outward: DVec2) -> f64 {
        let is_upright = along.x.abs() < 1e-9 || along.y.abs() < 1e-9;
        let places = feet.iter().map(|foot| foot.dot(along));
        let [low, high] = places.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], at| {
            [low.min(at), high.max(at)]
        });
        // Beside a slanted length, only the adjacent portion of the hull counts.
        let room = if is_upright { f64::INFINITY } else { 3.0 * self.settings.letters };
        let hull = reach_between(&self.hull, along, [low - room, high + room], outward);
        let of_feet = feet.iter().map(|foot| foot.dot(outward));
        of_feet.fold(hull.unwrap_or(f64::NEG_INFINITY), f64::max)
    }

    /// Returns the free position closest to the part for lengths on one line.
    fn row_candidate(
        &self,
        dimension: &ViewDimension,
        feet: &[DVec2],
        along: DVec2,
        sides: &[DVec2],
    ) -> Option<Candidate> {
        let ViewMeasure::Lengths { prefix, .. } = &dimension.measure else { return None };
        let scale = self.settings.scale;
        let lengths: Vec<f64> = feet
            .windows(2)
            .map(|pair| scale.to_object_length((pair[1] - pair[0]).dot(along)))
            .collect();
        // There is no length between points at the same position.
        if lengths.iter().any(|length| *length < 1e-6) {
            return None;
        }
        let number = |length: &f64| format!("{prefix}{}", self.length_text(dimension, *length));
        let texts: Vec<String> = lengths.iter().map(number).collect();
        let letters = self.settings.letters;
        for &outward in sides {
            let nearest = self.level_beside(feet, along, outward) + LINE_DISTANCE * letters;
            for row in 0..MAX_ROWS {
                let level = nearest + f64::from(row) * ROW_DISTANCE * letters;
                for is_text_first in [false, true] {
                    let (texts, letters) = (&texts, letters);
                    let row =
                        LengthRow { feet, along, outward, level, texts, letters, is_text_first };
                    let candidate = row.candidate().filter(|candidate| self.is_free(candidate));
                    if candidate.is_some() {
                        return candidate;
                    }
                }
            }
        }
        None
    }
}

impl LengthRow<'_> {
    /// Returns a point on the dimension line.
    fn line_point(&self, at: usize) -> DVec2 {
        let foot = self.feet[at];
        foot + self.outward * (self.level - foot.dot(self.outward))
    }

    /// Returns the length of arrowheads.
    fn arrow(&self) -> f64 {
        ARROW_LENGTH * self.letters
    }

    /// Returns the unit vector that points up from the baseline of the numbers.
    fn above(&self) -> DVec2 {
        DVec2::new(self.along.y, -self.along.x)
    }

    /// Returns the length of the line between a point and the next one.
    fn interval(&self, at: usize) -> f64 {
        (self.feet[at + 1] - self.feet[at]).dot(self.along)
    }

    /// Whether the space between a point and the next one is too narrow for two arrowheads.
    fn is_narrow(&self, at: usize) -> bool {
        self.interval(at) <= LEAST_BETWEEN_ARROWS * self.arrow()
    }

    /// Whether a point in a chain gets an oblique stroke because arrowheads do not fit beside it.
    fn is_stroke(&self, at: usize) -> bool {
        let is_inside = at > 0 && at + 1 < self.feet.len();
        is_inside && (self.is_narrow(at - 1) || self.is_narrow(at))
    }

    /// Returns all lines and numbers, or `None` if no level has room for a number with a leader.
    fn candidate(&self) -> Option<Candidate> {
        let mut candidate = Candidate::default();
        self.add_extension_lines(&mut candidate);
        self.add_terminators(&mut candidate);
        let last = self.feet.len() - 2;
        let outside = |narrow: bool| if narrow { 2.0 * self.arrow() } else { 0.0 };
        let mut tails = [outside(self.is_narrow(0)), outside(self.is_narrow(last))];
        for (at, text) in self.texts.iter().enumerate() {
            let width = Label::new(text, DVec2::ZERO, self.letters).width();
            let beside = if self.is_stroke(at) || self.is_stroke(at + 1) { 1.0 } else { 0.5 };
            if width <= self.interval(at) - beside * self.letters {
                let middle = (self.line_point(at) + self.line_point(at + 1)) * 0.5;
                self.add_text(&mut candidate, text, middle, TextAlign::Middle);
                continue;
            }
            // A single length has free space at both ends; `is_text_first` selects the first end.
            let is_end = at == last && !(last == 0 && self.is_text_first);
            if is_end || at == 0 {
                // The text must clear the extension line, which extends above the dimension line.
                let tail = &mut tails[usize::from(is_end)];
                let beyond = if *tail > 0.0 { *tail } else { 0.5 * self.letters };
                let sense = if is_end { 1.0 } else { -1.0 };
                let end = self.line_point(if is_end { at + 1 } else { at });
                let align = if is_end { TextAlign::Start } else { TextAlign::End };
                self.add_text(&mut candidate, text, end + self.along * (sense * beyond), align);
                // The dimension line extends below the text.
                *tail = beyond + width;
            } else {
                self.add_raised_text(&mut candidate, at, text)?;
            }
        }
        let ends = [
            self.line_point(0) - self.along * tails[0],
            self.line_point(last + 1) + self.along * tails[1],
        ];
        candidate.push_line(ends);
        candidate.span = Some(ends);
        Some(candidate)
    }

    /// Adds the extension lines, which start slightly away from the points and end slightly beyond
    /// the line.
    fn add_extension_lines(&self, candidate: &mut Candidate) {
        for (at, foot) in self.feet.iter().enumerate() {
            let gap = EXTENSION_GAP * self.letters;
            if self.level - foot.dot(self.outward) > gap {
                let end = self.line_point(at) + self.outward * (EXTENSION_OVERHANG * self.letters);
                candidate.push_line([*foot + self.outward * gap, end]);
            }
        }
    }

    /// Adds arrowheads or, at inner points next to narrow lengths, oblique strokes. If the first or
    /// last length is narrow, its arrowhead at the end of the line is outside.
    fn add_terminators(&self, candidate: &mut Candidate) {
        let last = self.feet.len() - 1;
        for at in 0..=last {
            let tip = self.line_point(at);
            let before = at.checked_sub(1).map(|before| self.is_narrow(before));
            let after = (at < last).then(|| self.is_narrow(at));
            if self.is_stroke(at) {
                let half = (self.along + self.above()) * (STROKE * self.letters);
                candidate.push_line([tip - half, tip + half]);
                continue;
            }
            for (is_narrow, into) in [(before, -self.along), (after, self.along)] {
                let Some(is_narrow) = is_narrow else { continue };
                let into = if is_narrow { -into } else { into };
                let head = AnnotationShape::Head(arrowhead(tip, into, self.arrow()));
                candidate.push(AnnotationLayer::Dimensions, head);
            }
        }
    }

    /// Adds a number above a point on the line.
    fn add_text(&self, candidate: &mut Candidate, text: &str, at: DVec2, align: TextAlign) {
        let anchor = at + self.above() * (TEXT_GAP * self.letters);
        let text = self.text(text, anchor, align);
        candidate.push(AnnotationLayer::DimensionTexts, AnnotationShape::Text(text));
    }

    /// Returns a number with its anchor on the baseline.
    fn text(&self, text: &str, anchor: DVec2, align: TextAlign) -> AnnotationText {
        let (height, direction) = (self.letters, self.along);
        AnnotationText { text: text.to_owned(), anchor, height, direction, align }
    }

    /// Adds a number that is too wide for its space, farther out and with a leader.
    fn add_raised_text(&self, candidate: &mut Candidate, at: usize, text: &str) -> Option<()> {
        let middle = (self.line_point(at) + self.line_point(at + 1)) * 0.5;
        // If the text's up direction points away from the part, its baseline faces the part.
        let own_height = if self.outward.dot(self.above()) > 0.0 { 0.0 } else { 1.0 };
        for level in 0..TEXT_LEVELS {
            let raised = 0.9 + 1.5 * f64::from(level);
            let anchor = middle + self.outward * ((raised + own_height) * self.letters);
            let text = self.text(text, anchor, TextAlign::Middle);
            let leader = [middle, middle + self.outward * ((raised - 0.3) * self.letters)];
            let outline = text_outline(&text, 0.2 * self.letters);
            let is_free = candidate.shapes.iter().all(|(_, shape)| match shape {
                AnnotationShape::Text(other) => {
                    let other = text_outline(other, 0.1 * self.letters);
                    !convex_overlap(&other, &outline) && !convex_overlap(&other, &leader)
                }
                // The leader may cross lines, but the text may not.
                AnnotationShape::Line(ends) => !convex_overlap(ends, &outline),
                _ => true,
            });
            if is_free {
                candidate.push_line(leader);
                candidate.push(AnnotationLayer::DimensionTexts, AnnotationShape::Text(text));
                return Some(());
            }
        }
        None
    }
}
