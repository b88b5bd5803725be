//! Turns the requests for a sheet into planned views.
//!
//! | request | result |
//! | --- | --- |
//! | named views | the views on the sheet, instead of the front, top, side and axonometric views |
//! | half section, local section, break | a different composition of a view |
//! | detail, auxiliary view, stepped section | a separate view, marked in other views |
//!
//! Views along the axes are placed around the front view as in ISO 5456-2, unless they have their
//! own position or scale.

use super::SheetError;
use super::composition::{Break, Composition};
use super::section_line::PARALLEL_TOLERANCE;
use super::sheet_view::{SheetView, ViewName};
use super::stepped_line::{SteppedLine, check_steps};
use super::view_mark::ViewMark;
use super::view_plan::{PlanSubject, PlannedView, ViewPlan};
use super::view_request::{ViewPlace, ViewRequest, ViewSide};
use crate::SheetWarning;
use camera::NamedView;
use glam::{DVec2, DVec3};
use homog::{Bounds, Normal, Plane, Point, Vector, World};
use projection::SheetAngle;

/// The maximum number of requests per sheet. A longer list is probably a mistake, and each request
/// takes space and time.
const MAX_REQUESTS: usize = 24;

/// The state of planning: the views and warnings so far, and the unused letters.
struct RequestPlanner<'a> {
    subject: &'a PlanSubject<'a>,
    views: Vec<PlannedView>,
    warnings: Vec<SheetWarning>,
    letters: std::ops::RangeInclusive<char>,
}

/// Returns the column and row of a view along an axis, with the front view at (0, 0), or `None` for
/// other views.
fn grid_place(name: NamedView, angle: SheetAngle) -> Option<[i32; 2]> {
    // In first-angle projection a view is placed opposite the side from which it is seen.
    let across = if angle == SheetAngle::First { 1 } else { -1 };
    match name {
        NamedView::Front => Some([0, 0]),
        NamedView::Left => Some([across, 0]),
        NamedView::Right => Some([-across, 0]),
        NamedView::Top => Some([0, across]),
        NamedView::Bottom => Some([0, -across]),
        NamedView::Back => Some([2, 0]),
        _ => None,
    }
}

impl ViewPlan {
    /// Plans the requests of a sheet. Changes nothing if there are no requests.
    ///
    /// # Errors
    /// Returns [`SheetError::Request`] if a request cannot be fulfilled.
    pub(super) fn add_requests(&mut self, subject: &PlanSubject<'_>) -> Result<(), SheetError> {
        let requests = &subject.sheet.views;
        if requests.is_empty() {
            return Ok(());
        }
        if let Some(request) = requests.get(MAX_REQUESTS) {
            let reason = format!("a sheet can have at most {MAX_REQUESTS} views");
            let (number, view) = (MAX_REQUESTS + 1, request.title());
            return Err(SheetError::Request { number, view, reason });
        }
        let names: Vec<(NamedView, &ViewPlace)> = requests
            .iter()
            .filter_map(|request| match request {
                ViewRequest::Named { view, place } => Some((*view, place)),
                _ => None,
            })
            .collect();
        // If only details and sections are requested, they apply to the default views.
        let views = if names.is_empty() {
            self.principal.iter().chain(&self.free).cloned().collect()
        } else {
            let (views, warnings) = subject.named_views(&names)?;
            self.warnings = warnings;
            views
        };
        // Letters continue after the letters of the sections.
        let lettered = views.iter().filter_map(|view| view.letter).max();
        let first = lettered.map_or('A', |last| char::from_u32(u32::from(last) + 1).unwrap_or('Z'));
        let mut planner =
            RequestPlanner { subject, views, warnings: Vec::new(), letters: first..='Z' };
        planner.assign_places();
        // Marks depend on compositions, so composition changes are planned first.
        for is_change in [true, false] {
            for (request, number) in requests.iter().zip(1..) {
                if request.place().is_none() == is_change {
                    planner.plan(request, number)?;
                }
            }
        }
        self.warnings.append(&mut planner.warnings);
        self.requested = planner.views;
        Ok(())
    }
}

impl RequestPlanner<'_> {
    /// Assigns grid positions around the front view to the views along the axes.
    fn assign_places(&mut self) {
        let angle = self.subject.sheet.projection_angle;
        for one in &mut self.views {
            let is_own = one.place.at.is_some() || one.place.scale.is_some();
            one.grid = match one.view.name {
                ViewName::Named(name) if !is_own => grid_place(name, angle),
                _ => None,
            };
        }
    }

    /// Plans one request, numbered from 1.
    fn plan(&mut self, request: &ViewRequest, number: usize) -> Result<(), SheetError> {
        let planned = match request {
            ViewRequest::Named { view, .. } => self.check_named(*view),
            ViewRequest::Detail { of, center, radius, place } => {
                self.add_detail(*of, *center, *radius, place)
            }
            ViewRequest::Stepped { removed, corners, place } => {
                self.add_stepped(*removed, corners, place)
            }
            ViewRequest::Auxiliary { facing, place } => self.add_auxiliary(*facing, place),
            ViewRequest::HalfSection { of, point, side } => self.halve(*of, *point, *side),
            ViewRequest::LocalSection { of, center, radius } => {
                self.cut_locally(*of, *center, *radius)
            }
            ViewRequest::Broken { of, axis, from, to } => self.shorten(*of, *axis, [*from, *to]),
        };
        planned.map_err(|reason| match reason {
            Fault::Request(reason) => SheetError::Request { number, view: request.title(), reason },
            Fault::Sheet(error) => error,
        })
    }

    /// Returns a letter not used by another view.
    fn next_letter(&mut self) -> Result<char, Fault> {
        self.letters.next().ok_or_else(|| fault("the views can have at most 26 letters"))
    }

    /// Checks that a view is requested only once.
    fn check_named(&self, name: NamedView) -> Result<(), Fault> {
        let alike = self.views.iter().filter(|one| one.view.name == ViewName::Named(name));
        if alike.count() > 1 { Err(fault("this view is requested twice")) } else { Ok(()) }
    }

    /// Returns the index of a view, by name.
    fn index_of(&self, name: NamedView) -> Result<usize, Fault> {
        let is_it = |one: &PlannedView| one.view.name == ViewName::Named(name);
        self.views.iter().position(is_it).ok_or_else(|| {
            let own = self.views.iter().filter_map(|one| match one.view.name {
                ViewName::Named(name) => Some(name.name()),
                _ => None,
            });
            let own: Vec<&str> = own.collect();
            fault(format!("the sheet has no {name} view; it has {}", own.join(", ")))
        })
    }

    /// Returns the index of a view along an axis that is not yet broken or partly cut.
    fn index_of_whole(&self, name: NamedView) -> Result<usize, Fault> {
        let index = self.index_of(name)?;
        let one = &self.views[index];
        if one.composition != Composition::Whole {
            return Err(fault(format!("the {name} view is already broken or partly cut")));
        }
        Ok(index)
    }

    /// Adds a detail of a view, and the circle around the detail.
    fn add_detail(
        &mut self,
        of: NamedView,
        center: Point<World>,
        radius: f64,
        place: &ViewPlace,
    ) -> Result<(), Fault> {
        let index = self.index_of(of)?;
        check_radius(radius)?;
        let mother = &self.views[index];
        let whole = mother.drawn_view();
        let offset = whole.image_of(center);
        let reach = whole.size * 0.5 + radius * whole.millimeters_per_unit;
        if !offset.is_finite() || offset.abs().cmpge(reach).any() {
            return Err(fault("its circle is outside the view"));
        }
        let shown = match &mother.composition {
            Composition::Broken(part) => part.shortened(offset),
            _ => Some(offset),
        };
        let Some(at) = shown else {
            return Err(fault("its center is in the omitted part of the view"));
        };
        // A detail is on one side of a break, so the detail itself needs no break.
        let composition = match &mother.composition {
            Composition::Broken(_) => Composition::Whole,
            other => other.clone(),
        };
        let letter = self.next_letter()?;
        let view = whole.detail_around(center, radius, letter)?;
        let on_paper = radius * view.millimeters_per_unit;
        let circle = |center, letter| ViewMark::Circle { center, radius: on_paper, letter };
        self.views[index].marks.push(circle(at, Some(letter)));
        self.views.push(PlannedView {
            composition,
            detail_radius: Some(radius),
            marks: vec![circle(DVec2::ZERO, None)],
            place: place.clone(),
            ..PlannedView::plain(view)
        });
        Ok(())
    }

    /// Adds an auxiliary view of an oblique face, and its arrow.
    fn add_auxiliary(&mut self, facing: Vector<World>, place: &ViewPlace) -> Result<(), Fault> {
        let gaze =
            -unit_vector(facing).ok_or_else(|| fault("its direction must not be (0, 0, 0)"))?;
        let letter = self.next_letter()?;
        let auxiliary = self.subject.auxiliary_view(gaze, letter)?.with_lines_of(&self.views);
        let marked = mark_direction(&mut self.views, gaze, letter);
        if !marked {
            return Err(fault("no view on the sheet shows its direction from the side"));
        }
        self.views.push(PlannedView { place: place.clone(), ..auxiliary });
        Ok(())
    }

    /// Cuts one half of a view.
    fn halve(
        &mut self,
        of: NamedView,
        point: Option<Point<World>>,
        side: ViewSide,
    ) -> Result<(), Fault> {
        let index = self.index_of_whole(of)?;
        let center = Bounds::from_points(self.subject.points.iter().copied());
        let point = point.or(center.map(Bounds::center)).unwrap_or(Point::ORIGIN);
        let plane = self.cutting_plane(index, point)?;
        let one = &mut self.views[index];
        let axis = if matches!(side, ViewSide::Left | ViewSide::Right) { 1 } else { 0 };
        one.marks.push(ViewMark::CenterLine { through: one.view.image_of(point), axis });
        one.composition = Composition::Half { plane, point, side };
        Ok(())
    }

    /// Cuts a view around a point.
    fn cut_locally(
        &mut self,
        of: NamedView,
        center: Point<World>,
        radius: f64,
    ) -> Result<(), Fault> {
        let index = self.index_of_whole(of)?;
        check_radius(radius)?;
        let plane = self.cutting_plane(index, center)?;
        self.views[index].composition = Composition::Local { plane, center, radius };
        Ok(())
    }

    /// Returns the plane through a point that faces a view, or a fault if the plane misses the
    /// models or the view is already cut.
    fn cutting_plane(&self, index: usize, point: Point<World>) -> Result<Plane<World>, Fault> {
        let one = &self.views[index];
        if !one.view.sections.is_empty() {
            return Err(fault("a section already cuts this view"));
        }
        let [x, y, z] = one.view.camera.gaze().raw().to_array();
        let plane = Plane::through(point, Normal::new(x, y, z));
        let heights = || self.subject.points.iter().map(|point| plane.evaluate(*point));
        if !heights().any(|height| height > 0.0) || !heights().any(|height| height < 0.0) {
            return Err(fault("its plane misses the models and cuts nothing"));
        }
        Ok(plane)
    }

    /// Breaks one view, or all views along the axes that show the broken axis at its true length.
    fn shorten(&mut self, of: Option<NamedView>, axis: usize, ends: [f64; 2]) -> Result<(), Fault> {
        let direction = Vector::from_raw(DVec3::AXES[axis.min(2)]);
        let shows = |one: &PlannedView| {
            let seen = one.view.direction_of(direction);
            one.is_along_axis() && (seen.length() - 1.0).abs() < PARALLEL_TOLERANCE
        };
        let indices: Vec<usize> = match of {
            Some(name) => vec![self.index_of_whole(name)?],
            None => (0..self.views.len()).filter(|at| shows(&self.views[*at])).collect(),
        };
        if indices.is_empty() || !indices.iter().all(|at| shows(&self.views[*at])) {
            return Err(fault("this view does not show the axis at its true length"));
        }
        for index in indices {
            let one = &mut self.views[index];
            if one.composition != Composition::Whole {
                return Err(fault("the view is already broken or partly cut"));
            }
            let at = |end: f64| one.view.image_of(Point::from_raw(DVec3::AXES[axis.min(2)] * end));
            let paper_axis = usize::from(one.view.direction_of(direction).x.abs() < 0.5);
            let [a, b] = ends.map(|end| at(end)[paper_axis]);
            let part = Break { axis: paper_axis, from: a.min(b), to: a.max(b) };
            let half = one.view.size[paper_axis] * 0.5;
            if !(-half < part.from && part.from < part.to && part.to < half) {
                return Err(fault("the omitted part must be inside the models"));
            }
            one.view.size -= part.length();
            one.composition = Composition::Broken(part);
        }
        Ok(())
    }

    /// Adds a section along parallel planes, and its section line.
    fn add_stepped(
        &mut self,
        removed: Vector<World>,
        corners: &[Point<World>],
        place: &ViewPlace,
    ) -> Result<(), Fault> {
        let removed =
            unit_vector(removed).ok_or_else(|| fault("its direction must not be (0, 0, 0)"))?;
        let along = check_steps(removed, corners)?;
        let letter = self.next_letter()?;
        let [x, y, z] = (-removed).raw().to_array();
        let pieces = corners.chunks(2).map(|piece| Plane::through(piece[0], Normal::new(x, y, z)));
        let planes: Vec<Plane<World>> = pieces.collect();
        let borders: Vec<Point<World>> =
            corners[1..corners.len() - 1].iter().step_by(2).copied().collect();
        let line = SteppedLine { corners, removed, across: removed.cross(along), letter };
        // Counting runs the iterator to the end, which marks every view.
        let marks = self.views.iter_mut().map(|one| line.mark(one)).filter(|marked| *marked);
        if marks.count() == 0 {
            self.warnings
                .push(SheetWarning::CutLineNotShown { section: format!("{letter}-{letter}") });
        }
        let first = planes[0];
        let composition = Composition::Stepped { planes, borders, along };
        let faces = |one: &&mut PlannedView| {
            one.is_outside_view()
                && one.composition == Composition::Whole
                && one.view.faces_section(first)
        };
        // A requested position or caption needs a separate view. If neither is requested, a view
        // that faces the planes is cut.
        let has_place = *place != ViewPlace::default();
        if let Some(facing) = self.views.iter_mut().filter(|_| !has_place).find(faces) {
            facing.composition = composition;
            *facing = facing.clone().with_letter(letter);
            return Ok(());
        }
        let name = ViewName::Section(letter);
        let subject = self.subject;
        let view = SheetView::frame_along(&subject.points, name, -removed, subject.unit())?;
        let planned = PlannedView { composition, place: place.clone(), ..PlannedView::plain(view) };
        self.views.push(planned.with_letter(letter));
        Ok(())
    }
}

/// Marks a viewing direction in the view that foreshortens it least. Returns `false` if no view
/// shows it well enough.
pub(super) fn mark_direction(views: &mut [PlannedView], gaze: Vector<World>, letter: char) -> bool {
    let shortening = |one: &PlannedView| one.view.camera.gaze().dot(gaze).abs();
    let along_axes = views.iter_mut().filter(|one| one.is_along_axis());
    let best = along_axes.min_by(|a, b| shortening(a).total_cmp(&shortening(b)));
    let Some(one) = best.filter(|one| shortening(one) < 0.99) else { return false };
    let gaze = one.view.direction_of(gaze).normalize_or(DVec2::X);
    one.marks.push(ViewMark::Direction { gaze, letter });
    true
}

/// Checks that a radius is a valid length.
fn check_radius(radius: f64) -> Result<(), Fault> {
    let is_length = radius.is_finite() && radius > 0.0;
    if is_length { Ok(()) } else { Err(fault("its radius must be greater than 0")) }
}

/// Returns the unit vector of a direction, or `None` if the direction is zero or not finite.
pub(super) fn unit_vector(direction: Vector<World>) -> Option<Vector<World>> {
    // Scale the vector first, so that squares do not overflow or underflow.
    let raw = direction.raw();
    let scaled = raw / raw.abs().max_element();
    scaled.is_finite().then(|| Vector::from_raw(scaled.normalize()))
}

/// The reason why a request cannot be fulfilled.
pub(super) enum Fault {
    Request(String),
    Sheet(SheetError),
}

impl From<SheetError> for Fault {
    fn from(error: SheetError) -> Self {
        Self::Sheet(error)
    }
}

/// Returns a fault in the request itself.
pub(super) fn fault(reason: impl Into<String>) -> Fault {
    Fault::Request(reason.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn views_are_arranged_around_the_front_view() {
        let place = |name| [SheetAngle::First, SheetAngle::Third].map(|a| grid_place(name, a));
        assert_eq!(place(NamedView::Left), [Some([1, 0]), Some([-1, 0])]);
        assert_eq!(place(NamedView::Right), [Some([-1, 0]), Some([1, 0])]);
        assert_eq!(place(NamedView::Top), [Some([0, 1]), Some([0, -1])]);
        assert_eq!(place(NamedView::Bottom), [Some([0, -1]), Some([0, 1])]);
        assert_eq!(place(NamedView::Back), [Some([2, 0]); 2]);
        assert_eq!(place(NamedView::Isometric), [None; 2]);
    }
}
