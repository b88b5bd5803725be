//! Labels: text on a page, as strokes.

use super::font::{CAPITAL, set};
use super::page::{Ink, Pen, Polyline};
use glam::DVec2;

/// Where text stands from the place it is put at.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Align {
    /// It begins there.
    #[default]
    Start,
    /// Its middle is there.
    Middle,
    /// It ends there.
    End,
}

/// A line of text on a page.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Label<'a> {
    /// The text; characters the font has not are boxes.
    pub text: &'a str,
    /// The place on the baseline, in millimetres.
    pub at: DVec2,
    /// The height of capitals in millimetres.
    pub height: f64,
    /// The direction of the baseline, a unit vector: (1, 0) to the right, (0, −1) upwards.
    pub along: DVec2,
    /// Which part of the text is at that place.
    pub align: Align,
}

impl<'a> Label<'a> {
    /// A label that begins at a place and runs to the right.
    #[must_use]
    pub const fn new(text: &'a str, at: DVec2, height: f64) -> Self {
        Self { text, at, height, along: DVec2::X, align: Align::Start }
    }

    /// The same with another part of the text at its place.
    #[must_use]
    pub const fn aligned(self, align: Align) -> Self {
        Self { align, ..self }
    }

    /// The same in another direction.
    #[must_use]
    pub const fn along(self, along: DVec2) -> Self {
        Self { along, ..self }
    }

    /// The same, made smaller where it would be wider than this, in millimetres.
    #[must_use]
    pub fn no_wider_than(self, width: f64) -> Self {
        let own = self.width();
        if own > width { Self { height: self.height * width / own, ..self } } else { self }
    }

    /// The width of the text in millimetres, from the middle of the first stroke to that of the last.
    #[must_use]
    pub fn width(&self) -> f64 {
        set(self.text).width * self.height / CAPITAL
    }

    /// The pen that goes with its height: a tenth of it.
    #[must_use]
    pub fn pen(&self, ink: Ink) -> Pen {
        Pen::of_width(self.height / CAPITAL, ink)
    }

    /// The strokes of the text.
    #[must_use]
    pub fn strokes(&self) -> Vec<Polyline> {
        let set = set(self.text);
        let scale = self.height / CAPITAL;
        let part = match self.align {
            Align::Start => 0.0,
            Align::Middle => 0.5,
            Align::End => 1.0,
        };
        let up = DVec2::new(self.along.y, -self.along.x);
        let start = self.at - self.along * (set.width * scale * part);
        let on_page = |point: &DVec2| start + (self.along * point.x + up * point.y) * scale;
        let line = |stroke: &Vec<DVec2>| {
            let points: Vec<DVec2> = stroke.iter().map(on_page).collect();
            Polyline::through(&points, false)
        };
        set.strokes.iter().filter_map(line).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::millimetres;

    fn bounds(label: &Label<'_>) -> [DVec2; 2] {
        let points = label.strokes().into_iter().flat_map(|line| line.points).map(millimetres);
        let far = DVec2::splat(1e9);
        points.fold([far, -far], |[low, high], point| [low.min(point), high.max(point)])
    }

    #[test]
    fn labels_stand_where_they_are_put() {
        let at = DVec2::new(100.0, 50.0);
        let label = Label::new("HIM", at, 5.0);
        let [low, high] = bounds(&label);
        assert_eq!((low, high.y), (DVec2::new(100.0, 45.0), 50.0));
        assert!((high.x - low.x - label.width()).abs() < 1e-3);
        let [low, high] = bounds(&label.aligned(Align::End));
        assert!((high.x - 100.0).abs() < 1e-3 && (low.x - 100.0 + label.width()).abs() < 1e-3);
        // Upwards: what was above the baseline is at its left.
        let [low, high] = bounds(&label.along(-DVec2::Y).aligned(Align::Middle));
        assert!((low.x - 95.0).abs() < 1e-3 && (high.x - 100.0).abs() < 1e-3);
        assert!((low.y + high.y - 100.0).abs() < 2e-3);
    }

    #[test]
    fn a_label_is_made_to_fit() {
        let label = Label::new("a rather long title", DVec2::ZERO, 5.0);
        assert!((label.no_wider_than(20.0).width() - 20.0).abs() < 1e-9);
        assert_eq!(label.no_wider_than(1e3), label);
    }
}
