//! Composition of a view from drawings of the object with different cuts, each in its own part of
//! the view.
//!
//! ```text
//!    stepped        half section     local section      broken        detail
//!   ┌───┬───┬──┐    ┌────┬╱╱╱╱┐     ┌───────────┐    ┌───╮╭───┐       ╭──╮
//!   │ 1 │ 2 │3 │    │    │╱╱╱╱│     │  ╭╱╱╱╮    │    │   ││   │      │ ╱╱ │
//!   └───┴───┴──┘    └────┴╱╱╱╱┘     └──╰╱╱╱╯────┘    └───╯╰───┘       ╰──╯
//! ```
//!
//! Views are parallel projections, so a strip of the paper shows exactly the slab of space behind
//! it. A section along a stepped plane is therefore, strip by strip, a section along one plane. No
//! line is drawn between adjacent strips or halves.

use super::SheetError;
use super::freehand::{freehand_circle, freehand_line};
use super::sheet_view::SheetView;
use super::surface_cache::SurfaceCache;
use super::view_request::ViewSide;
use drawing::{ClipArea, ClipSide, Drawing, HiddenLines, LineStyle, point_at};
use glam::DVec2;
use hidden_line::{RegionEdge, WeldedSurface, region_edges};
use homog::{ClipRange, Plane, Point, Vector, World};
use viewport::DrawingScale;

/// Half the width of the gap in a broken view, in millimeters on paper.
const HALF_BREAK: f64 = 1.5;

/// The maximum deviation of a break line from a straight line, in millimeters on paper.
const BREAK_WAVER: f64 = 1.2;

/// The maximum deviation of a local section's border from a circle, as a fraction of the radius.
const LOCAL_WAVER: f64 = 0.08;

/// Lines within this distance of the center line of a half section, in pixels of the drawing, are
/// omitted so that only the center line remains.
const CENTER_LINE_CLEARANCE: f64 = 1e-3;

/// The drawings that make up a view.
#[derive(Clone, PartialEq, Debug, Default)]
pub(super) enum Composition {
    /// A single drawing.
    #[default]
    Whole,
    /// Strips, each cut by a plane.
    Stepped {
        planes: Vec<Plane<World>>,
        /// A point on each border between strips; there is one border fewer than planes.
        borders: Vec<Point<World>>,
        /// The direction in which the strips follow each other.
        along: Vector<World>,
    },
    /// A half that is cut and a half that is not.
    Half { plane: Plane<World>, point: Point<World>, side: ViewSide },
    /// A cut region around a point, and the uncut rest.
    Local { plane: Plane<World>, center: Point<World>, radius: f64 },
    /// The two ends of a long object.
    Broken(Break),
}

/// The omitted part of a view, in object millimeters from the center of the whole view, positive to
/// the right and down.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Break {
    /// The paper axis along which the view is shortened.
    pub(super) axis: usize,
    pub(super) from: f64,
    pub(super) to: f64,
}

/// A drawing, with the freehand lines of its breaks in pixels.
pub(super) struct ComposedDrawing {
    pub(super) drawing: Drawing,
    pub(super) break_lines: Vec<Vec<DVec2>>,
}

/// The surfaces, style and view used to draw the parts of a view.
pub(super) struct PartDrawing<'a, 'm> {
    pub(super) view: &'a SheetView,
    pub(super) surfaces: &'a mut SurfaceCache<'m>,
    pub(super) style: &'a LineStyle,
    pub(super) scale: DrawingScale,
    pub(super) threads: usize,
}

impl Break {
    /// Returns the omitted length, as a vector.
    pub(super) fn length(&self) -> DVec2 {
        DVec2::AXES[self.axis] * (self.to - self.from)
    }

    /// Maps a point from the whole view to the shortened view, or returns `None` if the point is in
    /// the omitted part.
    pub(super) fn shortened(&self, point: DVec2) -> Option<DVec2> {
        let half = self.length() * 0.5;
        match point[self.axis] {
            at if at <= self.from => Some(point + half),
            at if at >= self.to => Some(point - half),
            _ => None,
        }
    }
}

impl Composition {
    /// Whether strips or a half of the view are cut, so that all its hidden lines are omitted.
    pub(super) const fn is_section(&self) -> bool {
        matches!(self, Self::Stepped { .. } | Self::Half { .. })
    }

    /// Draws a view.
    pub(super) fn draw(
        &self,
        with: &mut PartDrawing<'_, '_>,
    ) -> Result<ComposedDrawing, SheetError> {
        match self {
            Self::Whole => {
                let sections = with.view.sections.clone();
                Ok(with.part(&sections)?.into())
            }
            Self::Stepped { planes, borders, along } => with.stepped(planes, borders, *along),
            Self::Half { plane, point, side } => with.half(*plane, *point, *side),
            Self::Local { plane, center, radius } => with.local(*plane, *center, *radius),
            Self::Broken(part) => with.broken(part),
        }
    }
}

impl ComposedDrawing {
    /// Returns the part of the drawing within a radius of its center, in pixels.
    pub(super) fn within_disc(self, radius: f64) -> Self {
        let area = ClipArea::Disc { center: self.drawing.size * 0.5, radius };
        let parts = |line: &Vec<DVec2>| {
            let sides = line.windows(2).map(|pair| [pair[0], pair[1]]);
            let parts = sides.flat_map(|side| {
                let intervals = area.intervals(side, ClipSide::Inside).into_iter();
                intervals.map(move |part| part.map(|t| point_at(side, t)).to_vec())
            });
            parts.collect::<Vec<_>>()
        };
        let break_lines = self.break_lines.iter().flat_map(parts).collect();
        Self { drawing: self.drawing.clipped(&area, ClipSide::Inside), break_lines }
    }
}

impl From<Drawing> for ComposedDrawing {
    fn from(drawing: Drawing) -> Self {
        Self { drawing, break_lines: Vec::new() }
    }
}

impl ViewSide {
    /// Returns the area on this side of a point, starting `inset` pixels away from it.
    fn area(self, point: DVec2, inset: f64) -> ClipArea {
        let outward = match self {
            Self::Left => -DVec2::X,
            Self::Right => DVec2::X,
            Self::Top => -DVec2::Y,
            Self::Bottom => DVec2::Y,
        };
        ClipArea::half_plane(point + outward * inset, DVec2::new(-outward.y, outward.x))
    }

    /// Returns the other side.
    const fn opposite(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Right => Self::Left,
            Self::Top => Self::Bottom,
            Self::Bottom => Self::Top,
        }
    }
}

impl PartDrawing<'_, '_> {
    /// Draws the object cut by these planes.
    fn part(&mut self, sections: &[Plane<World>]) -> Result<Drawing, SheetError> {
        let surface = self.surfaces.cut_by(sections);
        let is_uncut = sections.is_empty();
        let hidden_lines = if is_uncut { self.style.hidden_lines } else { HiddenLines::Removed };
        let style = LineStyle { hidden_lines, ..*self.style };
        self.view.draw(surface, &style, self.scale, self.threads)
    }

    /// Draws strips between borders, each cut by its plane.
    fn stepped(
        &mut self,
        planes: &[Plane<World>],
        borders: &[Point<World>],
        along: Vector<World>,
    ) -> Result<ComposedDrawing, SheetError> {
        let at: Vec<DVec2> = borders.iter().map(|point| self.view.pixel_of(*point)).collect();
        let course = self.view.direction_of(along).normalize_or(DVec2::X);
        let mut composed: Option<Drawing> = None;
        let beyond = |point: DVec2| ClipArea::half_plane(point, course.perp());
        let before = |point: DVec2| ClipArea::half_plane(point, -course.perp());
        for (index, plane) in planes.iter().enumerate() {
            // Visibility depends on the plane, so the whole view is drawn for each strip and then
            // clipped to it.
            let mut part = self.part(&[*plane])?;
            if let Some(border) = index.checked_sub(1).and_then(|previous| at.get(previous)) {
                part = part.clipped(&beyond(*border), ClipSide::Inside);
            }
            if let Some(border) = at.get(index) {
                part = part.clipped(&before(*border), ClipSide::Inside);
            }
            match &mut composed {
                Some(composed) => composed.merge(part),
                None => composed = Some(part),
            }
        }
        composed.map(Into::into).ok_or(SheetError::Empty)
    }

    /// Draws a half section: one half of the view is cut, and the other is not.
    fn half(
        &mut self,
        plane: Plane<World>,
        point: Point<World>,
        side: ViewSide,
    ) -> Result<ComposedDrawing, SheetError> {
        let point = self.view.pixel_of(point);
        let area = |side: ViewSide| side.area(point, CENTER_LINE_CLEARANCE);
        let mut drawing = self.part(&[plane])?.clipped(&area(side), ClipSide::Inside);
        drawing.merge(self.part(&[])?.clipped(&area(side.opposite()), ClipSide::Inside));
        Ok(drawing.into())
    }

    /// Draws a local section: the region within a freehand line is cut, and the rest is not.
    fn local(
        &mut self,
        plane: Plane<World>,
        center: Point<World>,
        radius: f64,
    ) -> Result<ComposedDrawing, SheetError> {
        let center = self.view.pixel_of(center);
        let border = freehand_circle(center, radius * self.view.pixels_per_unit(), LOCAL_WAVER);
        let area = ClipArea::Star { center, corners: border.clone() };
        let mut drawing = self.part(&[plane])?.clipped(&area, ClipSide::Inside);
        drawing.merge(self.part(&[])?.clipped(&area, ClipSide::Outside));
        let closed: Vec<DVec2> = border.iter().chain(border.first()).copied().collect();
        let break_lines = self.within_outline(&closed)?;
        Ok(ComposedDrawing { drawing, break_lines })
    }

    /// Draws the two ends of a broken view, moved toward each other.
    fn broken(&mut self, part: &Break) -> Result<ComposedDrawing, SheetError> {
        let sections = self.view.sections.clone();
        let whole = self.part(&sections)?;
        let pixels = self.view.pixels_per_unit() / self.view.millimeters_per_unit;
        let paper = pixels / self.scale.ratio();
        let (along, size) = (DVec2::AXES[part.axis], whole.size);
        let across = DVec2::AXES[1 - part.axis];
        let mut break_lines = Vec::new();
        let mut composed: Option<Drawing> = None;
        for (at, outward) in [(part.from, -1.0), (part.to, 1.0)] {
            let middle = size * 0.5 + along * (at * pixels + outward * HALF_BREAK * paper);
            let reach = across * size[1 - part.axis] * 0.5;
            let line = freehand_line([middle - reach, middle + reach], BREAK_WAVER * paper);
            let shift = part.length() * (-outward * 0.5 * pixels);
            let area = end_area(&line, along * outward);
            let end = whole.clone().clipped(&area, ClipSide::Inside).moved_by(shift);
            // The break line ends at the outline, because nothing beyond it is broken.
            let lines = self.within_outline(&line)?.into_iter();
            break_lines.extend(lines.map(|line| line.iter().map(|p| *p + shift).collect()));
            match &mut composed {
                Some(composed) => composed.merge(end),
                None => composed = Some(end),
            }
        }
        let drawing = composed.ok_or(SheetError::Empty)?;
        Ok(ComposedDrawing { drawing, break_lines })
    }

    /// Returns the parts of a polyline inside the outline of the uncut object.
    fn within_outline(&mut self, line: &[DVec2]) -> Result<Vec<Vec<DVec2>>, SheetError> {
        let (view_projection, size) = self.view.view_projection()?;
        let surface: &WeldedSurface = self.surfaces.cut_by(&[]);
        let viewport = viewport::Viewport::image_for(size[0], size[1], ClipRange::CHAPTER)
            .map_err(hidden_line::DrawError::from)?;
        let projector = hidden_line::Projector::new(&view_projection, &viewport);
        let triangles = surface.occluder_triangles().map(|vertices| vertices.map(Point::raw));
        Ok(parts_within(line, &region_edges(triangles, &projector)))
    }
}

/// Returns the area on the `outward` side of a polyline that runs across the drawing.
fn end_area(line: &[DVec2], outward: DVec2) -> ClipArea {
    const FAR: f64 = 1e6;
    let ends = [line[0], line[line.len() - 1]];
    let across = (ends[1] - ends[0]).normalize_or(outward.perp()) * FAR;
    let beyond = [ends[0] - across, ends[1] + across];
    let corners = core::iter::once(beyond[0]).chain(line.iter().copied()).chain([
        beyond[1],
        beyond[1] + outward * FAR,
        beyond[0] + outward * FAR,
    ]);
    let center = (ends[0] + ends[1]) * 0.5 + outward * (0.5 * FAR);
    ClipArea::Star { center, corners: corners.collect() }
}

/// Returns the parts of a polyline inside the region bounded by directed edges.
fn parts_within(line: &[DVec2], edges: &[RegionEdge]) -> Vec<Vec<DVec2>> {
    let mut parts: Vec<Vec<DVec2>> = Vec::new();
    let mut is_open = false;
    for side in line.windows(2).map(|pair| [pair[0], pair[1]]) {
        let step = side[1] - side[0];
        let mut cuts = vec![0.0, 1.0];
        for edge in edges {
            let along = edge.ends[1] - edge.ends[0];
            let across = step.perp_dot(along);
            let (t, s) = (
                (edge.ends[0] - side[0]).perp_dot(along) / across,
                (edge.ends[0] - side[0]).perp_dot(step) / across,
            );
            // Parallel lines do not cross, and their parameters are not finite.
            if across != 0.0 && (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t) {
                cuts.push(t);
            }
        }
        cuts.sort_by(f64::total_cmp);
        cuts.dedup();
        for pair in cuts.windows(2) {
            let ends = [pair[0], pair[1]].map(|t| point_at(side, t));
            // No edge crosses this piece, so testing its midpoint is enough.
            let is_inside = winding_number((ends[0] + ends[1]) * 0.5, edges) != 0;
            match parts.last_mut() {
                Some(part) if is_inside && is_open => part.push(ends[1]),
                _ if is_inside => parts.push(ends.to_vec()),
                _ => {}
            }
            is_open = is_inside;
        }
    }
    parts
}

/// Returns the winding number of directed edges around a point, computed along a ray to the right.
fn winding_number(point: DVec2, edges: &[RegionEdge]) -> i32 {
    let crossing = |edge: &RegionEdge| {
        let [a, b] = edge.ends;
        if (a.y > point.y) == (b.y > point.y) {
            return 0;
        }
        let x = a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x);
        let turn = if b.y > a.y { edge.winding } else { -edge.winding };
        if x > point.x { turn } else { 0 }
    };
    edges.iter().map(crossing).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_at_the_outline() {
        let corners = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]].map(DVec2::from);
        let edges: Vec<RegionEdge> = (0..4)
            .map(|k| RegionEdge { ends: [corners[k], corners[(k + 1) % 4]], winding: 1 })
            .collect();
        let line = [[-5.0, 5.0], [5.0, 5.0], [5.0, 20.0]].map(DVec2::from);
        let expected = [[0.0, 5.0], [5.0, 5.0], [5.0, 10.0]].map(DVec2::from).to_vec();
        assert_eq!(parts_within(&line, &edges), [expected]);
        assert_eq!(parts_within(&[[20.0, 0.0], [20.0, 9.0]].map(DVec2::from), &edges).len(), 0);
    }

    #[test]
    fn a_break_moves_both_ends_toward_the_middle() {
        let part = Break { axis: 0, from: -10.0, to: 30.0 };
        let at = |x: f64| part.shortened(DVec2::new(x, 7.0)).map(|point| point.x);
        assert_eq!(
            [at(-50.0), at(-10.0), at(0.0), at(30.0), at(50.0)].map(|x| x.unwrap_or(99.0)),
            [-30.0, 10.0, 99.0, 10.0, 30.0]
        );
    }

    #[test]
    fn view_sides_follow_the_paper_axes() {
        let point = DVec2::new(40.0, 30.0);
        for (side, inside) in [
            (ViewSide::Left, [-5.0, 0.0]),
            (ViewSide::Right, [5.0, 0.0]),
            (ViewSide::Top, [0.0, -5.0]),
            (ViewSide::Bottom, [0.0, 5.0]),
        ] {
            let inside = DVec2::from(inside);
            for (side, expected) in [(side, true), (side.opposite(), false)] {
                assert_eq!(side.area(point, 0.0).contains(point + inside), expected, "{side:?}");
            }
        }
    }
}
