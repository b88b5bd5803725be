//! Labels: lines of text on a page, drawn as pen strokes.
//!
//! ```text
//!    ↑ height
//!    │  HIM      anchor: the start, middle or end of the text on its baseline
//!    ●───────►   direction: along the baseline
//! ```

use super::page::{Group, GroupContent, Ink, Pen, Polyline, TextLine, to_micrometers};
use super::stroke_font::{CAP_HEIGHT, typeset_line};
use glam::DVec2;

/// The alignment of text relative to its anchor.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum TextAlign {
    /// The text starts at the anchor.
    #[default]
    Start,
    /// The text is centered on the anchor.
    Middle,
    /// The text ends at the anchor.
    End,
}

/// A line of text on a page.
///
/// ```
/// use page::{Label, TextAlign};
/// use glam::DVec2;
///
/// let label = Label::new("150", DVec2::new(100.0, 50.0), 3.5).with_align(TextAlign::Middle);
/// assert!(label.fit_to_width(5.0).width() <= 5.0 + 1e-9);
/// assert!(!label.strokes().is_empty());
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Label<'a> {
    /// The text; characters missing from the font become boxes.
    pub text: &'a str,
    /// The anchor on the baseline, in millimeters.
    pub anchor: DVec2,
    /// The height of capitals in millimeters.
    pub height: f64,
    /// The direction of the baseline, a unit vector: (1, 0) to the right, (0, −1) upward.
    pub direction: DVec2,
    /// The part of the text that is at the anchor.
    pub align: TextAlign,
}

impl<'a> Label<'a> {
    /// Creates a label that starts at a point and runs to the right.
    #[must_use]
    pub const fn new(text: &'a str, anchor: DVec2, height: f64) -> Self {
        Self { text, anchor, height, direction: DVec2::X, align: TextAlign::Start }
    }

    /// Returns the label with the given alignment.
    #[must_use]
    pub const fn with_align(self, align: TextAlign) -> Self {
        Self { align, ..self }
    }

    /// Returns the label with the given direction.
    #[must_use]
    pub const fn with_direction(self, along: DVec2) -> Self {
        Self { direction: along, ..self }
    }

    /// Returns the label, with its height reduced if the text would be wider than `width`, in
    /// millimeters.
    #[must_use]
    pub fn fit_to_width(self, width: f64) -> Self {
        let own = self.width();
        if own > width { Self { height: self.height * width / own, ..self } } else { self }
    }

    /// Returns the width of the text in millimeters, between the centers of the first and last
    /// strokes.
    #[must_use]
    pub fn width(&self) -> f64 {
        typeset_line(self.text).width * self.height / CAP_HEIGHT
    }

    /// Returns the pen for the label. Its strokes are a tenth of the label's height wide.
    #[must_use]
    pub fn pen(&self, ink: Ink) -> Pen {
        Pen::solid(self.height / CAP_HEIGHT, ink)
    }

    /// Returns the start of the baseline for text of the given width.
    fn start(&self, width: f64) -> DVec2 {
        let part = match self.align {
            TextAlign::Start => 0.0,
            TextAlign::Middle => 0.5,
            TextAlign::End => 1.0,
        };
        self.anchor - self.direction * (width * part)
    }

    /// Returns the text as a separate group, marked as text.
    #[must_use]
    pub fn group(&self) -> Group {
        let width = self.width();
        let start = self.start(width);
        let line = TextLine {
            text: self.text.to_owned(),
            baseline: [start, start + self.direction * width].map(to_micrometers),
            height: to_micrometers(DVec2::splat(self.height))[0],
        };
        let content = GroupContent::Text(line);
        Group { strokes: self.strokes(), content, ..Group::default() }
    }

    /// Returns the strokes of the text on the page.
    #[must_use]
    pub fn strokes(&self) -> Vec<Polyline> {
        let set = typeset_line(self.text);
        let scale = self.height / CAP_HEIGHT;
        let up = DVec2::new(self.direction.y, -self.direction.x);
        let start = self.start(set.width * scale);
        let on_page = |point: &DVec2| start + (self.direction * point.x + up * point.y) * scale;
        let line = |stroke: &Vec<DVec2>| {
            let points: Vec<DVec2> = stroke.iter().map(on_page).collect();
            Polyline::through_points(&points, false)
        };
        set.strokes.iter().filter_map(line).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::to_millimeters;

    fn bounds(label: &Label<'_>) -> [DVec2; 2] {
        let points = label.strokes().into_iter().flat_map(|line| line.points).map(to_millimeters);
        let far = DVec2::splat(1e9);
        points.fold([far, -far], |[low, high], point| [low.min(point), high.max(point)])
    }

    #[test]
    fn labels_align_at_their_anchor() {
        let at = DVec2::new(100.0, 50.0);
        let label = Label::new("HIM", at, 5.0);
        let [low, high] = bounds(&label);
        assert_eq!((low, high.y), (DVec2::new(100.0, 45.0), 50.0));
        assert!((high.x - low.x - label.width()).abs() < 1e-3);
        let [low, high] = bounds(&label.with_align(TextAlign::End));
        assert!((high.x - 100.0).abs() < 1e-3 && (low.x - 100.0 + label.width()).abs() < 1e-3);
        // For upward text, the letters are to the left of the baseline.
        let [low, high] = bounds(&label.with_direction(-DVec2::Y).with_align(TextAlign::Middle));
        assert!((low.x - 95.0).abs() < 1e-3 && (high.x - 100.0).abs() < 1e-3);
        assert!((low.y + high.y - 100.0).abs() < 2e-3);
    }

    #[test]
    fn wide_labels_are_reduced_to_fit() {
        let label = Label::new("a rather long title", DVec2::ZERO, 5.0);
        assert!((label.fit_to_width(20.0).width() - 20.0).abs() < 1e-9);
        assert_eq!(label.fit_to_width(1e3), label);
    }
}
