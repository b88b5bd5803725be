//! View plan: which views a sheet has, which sections cut each of them, and what is written beside
//! it.
//!
//! | section plane | where it is shown |
//! | --- | --- |
//! | faced by the front, top or side view | that view is cut, the others have its line |
//! | edge-on in one of them | a view of its own onto the plane, and its line in the others |
//! | oblique to all three | the axonometric view alone, with a warning |
//! | beside the object | nowhere, with a warning |
//!
//! Views of their own and the axonometric view have no fixed place and stand where the sheet is
//! free.

use super::annotation::{AnnotationLayer, ViewAnnotations};
use super::dimension::{DimensionSettings, OverallSide, add_overall_dimensions};
use super::section_line::{SectionLine, add_caption, section_line_reserve};
use super::sheet_view::{SheetView, ViewName};
use super::view_measures::ViewMeasures;
use super::{Sheet, SheetError};
use crate::Warning;
use crate::retained_points::{idle_section_warning, retained_points};
use camera::NamedView;
use homog::{Bounds, Plane, World};
use model::{ModelInstance, world_points};
use projection::SheetAngle;
use viewport::DrawingScale;

/// A section plane and its letter.
type LetteredPlane = (Plane<World>, char);

/// A view and what is written beside it.
#[derive(Clone, Debug)]
pub(super) struct PlannedView {
    pub(super) view: SheetView,
    /// The sides with an overall dimension.
    dimensions: Vec<OverallSide>,
    /// The planes whose lines the view shows.
    section_lines: Vec<LetteredPlane>,
    /// The letter of the section that the view shows.
    letter: Option<char>,
    /// The dimensions and center lines that were asked for.
    pub(super) measures: ViewMeasures,
}

/// The views of a sheet.
#[derive(Clone, Debug)]
pub(super) struct ViewPlan {
    /// Front, top and side view.
    pub(super) principal: [PlannedView; 3],
    /// Views without a fixed place: of sections, then the axonometric one.
    pub(super) free: Vec<PlannedView>,
    /// Sections that are not shown as was asked for.
    pub(super) warnings: Vec<Warning>,
}

impl ViewPlan {
    /// The views of models cut by section planes.
    ///
    /// # Errors
    /// [`SheetError::Empty`] if there is nothing to draw, [`SheetError::View`] if a view has no
    /// camera.
    pub(super) fn new(
        sheet: &Sheet,
        models: &[ModelInstance],
        sections: &[Plane<World>],
    ) -> Result<Self, SheetError> {
        let points = world_points(models);
        let unit = sheet.millimeters_per_unit;
        let idle = |plane, number| idle_section_warning(&points, plane, number);
        let numbered = || sections.iter().copied().zip(1..);
        let mut warnings: Vec<Warning> =
            numbered().filter_map(|(plane, number)| idle(plane, number)).collect();
        let cutting: Vec<(Plane<World>, usize)> =
            numbered().filter(|(plane, number)| idle(*plane, *number).is_none()).collect();
        let planes: Vec<Plane<World>> = cutting.iter().map(|(plane, _)| *plane).collect();
        // Along the axes the corners of the bounding box have the extents of all points.
        let corners = Bounds::from_points(points.iter().copied()).map(Bounds::corners);
        let extreme = corners.as_ref().map_or(points.as_slice(), |corners| corners);
        let named = |name| SheetView::frame_points(extreme, name, unit);
        let [front, top] = [named(NamedView::Front)?, named(NamedView::Top)?];
        let side = side_view(sheet, &planes, named)?;
        let mut principal = [front, top, side].map(PlannedView::plain);
        let mut free = Vec::new();
        let (mut letters, mut lettered) = ('A'..='Z', Vec::new());
        for &(plane, number) in &cutting {
            let faces =
                |one: &&mut PlannedView| one.letter.is_none() && one.view.faces_section(plane);
            let letter = letters.next().unwrap_or('Z');
            if let Some(facing) = principal.iter_mut().find(faces) {
                facing.view.sections.push(plane);
                facing.letter = Some(letter);
            } else if principal.iter().any(|one| one.view.sees_edge_of(plane)) {
                let retained = retained_points(models, &[plane]);
                let view = SheetView::frame_section(&retained, (plane, letter), unit)?;
                free.push(PlannedView { letter: Some(letter), ..PlannedView::plain(view) });
            } else {
                warnings.push(Warning::SectionOblique { number });
                continue;
            }
            lettered.push((plane, letter));
        }
        for one in &mut principal {
            let own = one.letter;
            one.section_lines = lettered.iter().copied().filter(|(_, a)| Some(*a) != own).collect();
        }
        if sheet.dimensions {
            let first = sheet.projection_angle == SheetAngle::First;
            let across = if first { OverallSide::Above } else { OverallSide::Below };
            principal[0].dimensions = vec![across, OverallSide::Left];
            principal[2].dimensions = vec![across];
        }
        if let Some(name) = sheet.axonometric_view {
            let left = if planes.is_empty() { points } else { retained_points(models, &planes) };
            let view = SheetView::frame_points(&left, name, unit)?;
            free.push(PlannedView::plain(view.cut_by(planes)));
        }
        let mut plan = Self { principal, free, warnings };
        plan.add_measures(sheet, models);
        Ok(plan)
    }
}

/// The view beside the front view: the one that was asked for, else that of the projection angle,
/// or its opposite if only that faces a section.
fn side_view(
    sheet: &Sheet,
    planes: &[Plane<World>],
    named: impl Fn(NamedView) -> Result<SheetView, SheetError>,
) -> Result<SheetView, SheetError> {
    let usual = match (sheet.side_view, sheet.projection_angle) {
        (Some(name), _) => return named(name),
        (None, SheetAngle::First) => [NamedView::Left, NamedView::Right],
        (None, SheetAngle::Third) => [NamedView::Right, NamedView::Left],
    };
    let [first, other] = [named(usual[0])?, named(usual[1])?];
    let faces = |view: &SheetView| planes.iter().any(|plane| view.faces_section(*plane));
    Ok(if !faces(&first) && faces(&other) { other } else { first })
}

impl PlannedView {
    /// A view with nothing beside it.
    fn plain(view: SheetView) -> Self {
        let (dimensions, section_lines, letter) = (Vec::new(), Vec::new(), None);
        Self { view, dimensions, section_lines, letter, measures: ViewMeasures::default() }
    }

    /// Whether the view is one of the six along the axes, not cut.
    pub(super) fn is_outside_view(&self) -> bool {
        let is_principal =
            matches!(self.view.name, ViewName::Named(name) if NamedView::PRINCIPAL.contains(&name));
        is_principal && self.view.sections.is_empty()
    }

    /// The name for messages, such as `isometric view` or `section A-A`.
    pub(super) fn title(&self) -> String {
        match self.view.name {
            ViewName::Named(name) => format!("{name} view"),
            ViewName::Section(letter) => format!("section {letter}-{letter}"),
        }
    }

    /// The annotations beside the view at a scale.
    pub(super) fn annotate(&self, sheet: &Sheet, scale: DrawingScale) -> ViewAnnotations {
        let letters = sheet.lettering_height();
        let half = self.view.size * scale.ratio() * 0.5;
        let object = [-half, half];
        let in_view = |plane: &LetteredPlane| SectionLine::in_view(&self.view, scale, *plane);
        let lines: Vec<SectionLine> = self.section_lines.iter().filter_map(in_view).collect();
        let mut annotations = ViewAnnotations::default();
        lines.iter().for_each(|line| line.annotate(&mut annotations));
        let settings = DimensionSettings {
            letters,
            scale,
            unit: sheet.dimension_unit,
            reserved: if lines.is_empty() {
                self.measures.reserve()
            } else {
                section_line_reserve(letters)
            },
        };
        self.measures.annotate(&mut annotations, (&self.dimensions, half), &settings);
        add_overall_dimensions(&mut annotations, &self.dimensions, half, &settings);
        lines.iter().for_each(|line| line.add_letters(&mut annotations, object, letters));
        if let Some(letter) = self.letter {
            let name = format!("{letter}-{letter}");
            let layer = AnnotationLayer::CutNames;
            add_caption(&mut annotations, layer, &name, (object, letters));
        }
        annotations
    }

    /// As [`annotate`](Self::annotate), with a note of the scale, which is not that of the sheet.
    pub(super) fn annotate_with_scale(
        &self,
        sheet: &Sheet,
        scale: DrawingScale,
    ) -> ViewAnnotations {
        let (mut annotations, letters) = (self.annotate(sheet, scale), sheet.lettering_height());
        let half = self.view.size * scale.ratio() * 0.5;
        let layer = AnnotationLayer::ScaleNotes;
        add_caption(&mut annotations, layer, &scale.to_string(), ([-half, half], letters));
        annotations
    }
}
