//! View plan: the views on a sheet, the sections that cut each view, and the annotations beside it.
//!
//! | section plane | shown in |
//! | --- | --- |
//! | faces the front, top or side view | that view, which is cut; the others show its line |
//! | edge-on in one of them | a separate view of the plane; the others show its line |
//! | oblique to all three | a separate view; an auxiliary view with an arrow shows its line |
//! | beside the object | no view, with a warning |
//!
//! Separate views and the axonometric view have no fixed position and are placed in free space.

use super::annotation::{AnnotationLayer, ViewAnnotations};
use super::composition::{ComposedDrawing, Composition, PartDrawing};
use super::dimension::{DimensionSettings, OverallSide, add_overall_dimensions};
use super::overlay_marks::ViewOverlays;
use super::requested_views::{mark_direction, unit_vector};
use super::section_line::{LetteredPlane, SectionLine, add_caption, section_line_reserve};
use super::sheet_view::{SheetView, ViewName};
use super::surface_cache::SurfaceCache;
use super::view_mark::{MarkSettings, ViewMark};
use super::view_measures::ViewMeasures;
use super::view_request::ViewPlace;
use super::{Sheet, SheetError};
use crate::SheetWarning;
use camera::NamedView;
use drawing::LineStyle;
use glam::DVec2;
use hidden_line::{idle_section_warning, retained_points};
use homog::{Bounds, Plane, Point, Vector, World};
use model::{ModelInstance, world_points};
use projection::SheetAngle;
use viewport::DrawingScale;

/// A view and the annotations beside it.
#[derive(Clone, Debug)]
pub(super) struct PlannedView {
    pub(super) view: SheetView,
    /// The sides that have an overall dimension.
    pub(super) dimensions: Vec<OverallSide>,
    /// The planes whose section lines the view shows.
    pub(super) section_lines: Vec<LetteredPlane>,
    /// The letter of the section that the view shows.
    pub(super) letter: Option<char>,
    /// The requested dimensions and center lines.
    pub(super) measures: ViewMeasures,
    /// The drawings that make up the view.
    pub(super) composition: Composition,
    /// The radius of a detail, in scene units.
    pub(super) detail_radius: Option<f64>,
    /// Marks of other views.
    pub(super) marks: Vec<ViewMark>,
    /// The points and axes of the scene's overlays.
    pub(super) overlays: ViewOverlays,
    /// The requested position of the view.
    pub(super) place: ViewPlace,
    /// The column and row around the front view, for requested views.
    pub(super) grid: Option<[i32; 2]>,
}

/// The views on a sheet.
#[derive(Clone, Debug)]
pub(super) struct ViewPlan {
    /// The front, top and side views.
    pub(super) principal: [PlannedView; 3],
    /// The views without a fixed position: sections, then the axonometric view.
    pub(super) free: Vec<PlannedView>,
    /// All views of a sheet with requests; they replace the views above.
    pub(super) requested: Vec<PlannedView>,
    /// Warnings about sections that are not shown as requested.
    pub(super) warnings: Vec<SheetWarning>,
}

/// The subject of a plan: a sheet and its models.
pub(super) struct PlanSubject<'a> {
    pub(super) sheet: &'a Sheet,
    models: &'a [ModelInstance],
    /// All points of the models.
    pub(super) points: Vec<Point<World>>,
    /// The corners of the bounding box, which have the same extents along the axes as all points.
    extreme: Vec<Point<World>>,
    /// The sections that cut something, each with its number among all sections, from 1.
    cutting: Vec<(Plane<World>, usize)>,
    /// Warnings about sections that cut nothing.
    idle: Vec<SheetWarning>,
}

impl ViewPlan {
    /// Plans the views of models cut by section planes.
    ///
    /// # Errors
    /// Returns [`SheetError::Empty`] if there is nothing to draw, [`SheetError::View`] if a view
    /// has no valid camera, or [`SheetError::Request`] if a requested view is not possible.
    pub(super) fn new(
        sheet: &Sheet,
        models: &[ModelInstance],
        sections: &[Plane<World>],
    ) -> Result<Self, SheetError> {
        let subject = PlanSubject::new(sheet, models, sections);
        let named = |name| subject.named_view(name);
        let planes = subject.planes();
        let side = side_view(sheet, &planes, named)?;
        let mut principal =
            [named(NamedView::Front)?, named(NamedView::Top)?, side].map(PlannedView::plain);
        let (mut free, warnings) = subject.assign_sections(&mut principal)?;
        if sheet.dimensions {
            // In first-angle projection the top view is below the front view, so the width is
            // dimensioned above the front view. In third-angle projection it is the other way
            // around.
            let first = sheet.projection_angle == SheetAngle::First;
            let across = if first { OverallSide::Above } else { OverallSide::Below };
            principal[0].dimensions = vec![across, OverallSide::Left];
            principal[2].dimensions = vec![across];
        }
        if let Some(name) = sheet.axonometric_view {
            free.push(PlannedView::plain(subject.cut_view(name)?));
        }
        let mut plan = Self { principal, free, requested: Vec::new(), warnings };
        // Requests may replace all views, so measures and overlays are added afterward.
        plan.add_requests(&subject)?;
        plan.add_measures(sheet, models);
        plan.add_overlays(sheet, models);
        Ok(plan)
    }
}

impl<'a> PlanSubject<'a> {
    /// Collects the points of models, and the sections that cut them.
    fn new(sheet: &'a Sheet, models: &'a [ModelInstance], sections: &[Plane<World>]) -> Self {
        let points = world_points(models);
        let idle = |plane, number| idle_section_warning(&points, plane, number);
        let numbered = || sections.iter().copied().zip(1..);
        let warnings = numbered().filter_map(|(plane, number)| idle(plane, number));
        let warnings = warnings.map(SheetWarning::from).collect();
        let cutting =
            numbered().filter(|(plane, number)| idle(*plane, *number).is_none()).collect();
        // For views along the axes, the corners of the bounding box have the same extents as all
        // points.
        let corners = Bounds::from_points(points.iter().copied()).map(Bounds::corners);
        let extreme = corners.map(Vec::from).unwrap_or_default();
        Self { sheet, models, points, extreme, cutting, idle: warnings }
    }

    /// Returns the number of millimeters per scene unit.
    pub(super) const fn unit(&self) -> f64 {
        self.sheet.millimeters_per_unit
    }

    /// Returns the planes of the sections that cut something.
    fn planes(&self) -> Vec<Plane<World>> {
        self.cutting.iter().map(|(plane, _)| *plane).collect()
    }

    /// Returns the uncut view along an axis.
    fn named_view(&self, name: NamedView) -> Result<SheetView, SheetError> {
        SheetView::frame_points(&self.extreme, name, self.unit())
    }

    /// Returns the axonometric view of the parts that all sections retain.
    fn cut_view(&self, name: NamedView) -> Result<SheetView, SheetError> {
        let planes = self.planes();
        let retained =
            (!planes.is_empty()).then(|| retained_points(self.models, &planes, &self.sheet.uncut));
        let points = retained.as_ref().unwrap_or(&self.points);
        Ok(SheetView::frame_points(points, name, self.unit())?.cut_by(planes))
    }

    /// Returns an uncut view in any direction.
    pub(super) fn auxiliary_view(
        &self,
        gaze: Vector<World>,
        letter: char,
    ) -> Result<PlannedView, SheetError> {
        let name = ViewName::Auxiliary(letter);
        let view = SheetView::frame_along(&self.points, name, gaze, self.unit())?;
        Ok(PlannedView::plain(view))
    }

    /// Returns the views with the given names, including their sections and overall dimensions, and
    /// the section views.
    pub(super) fn named_views(
        &self,
        names: &[(NamedView, &ViewPlace)],
    ) -> Result<(Vec<PlannedView>, Vec<SheetWarning>), SheetError> {
        let mut along_axes = Vec::new();
        let mut axonometric = Vec::new();
        for (name, place) in names {
            let is_principal = NamedView::PRINCIPAL.contains(name);
            let view = if is_principal { self.named_view(*name) } else { self.cut_view(*name) };
            let planned = PlannedView { place: (*place).clone(), ..PlannedView::plain(view?) };
            if is_principal { along_axes.push(planned) } else { axonometric.push(planned) }
        }
        let (free, warnings) = self.assign_sections(&mut along_axes)?;
        if self.sheet.dimensions {
            add_dimensions(&mut along_axes, self.sheet.projection_angle);
        }
        Ok((along_axes.into_iter().chain(free).chain(axonometric).collect(), warnings))
    }

    /// Cuts the views along the axes that face a section, marks the section line in the others, and
    /// returns separate views for the remaining sections.
    fn assign_sections(
        &self,
        views: &mut [PlannedView],
    ) -> Result<(Vec<PlannedView>, Vec<SheetWarning>), SheetError> {
        let (mut free, mut warnings) = (Vec::new(), self.idle.clone());
        let (mut letters, mut lettered, mut oblique) = ('A'..='Z', Vec::new(), Vec::new());
        for &(plane, number) in &self.cutting {
            let faces =
                |one: &&mut PlannedView| one.letter.is_none() && one.view.faces_section(plane);
            let letter = letters.next().unwrap_or('Z');
            if let Some(facing) = views.iter_mut().find(faces) {
                facing.view.sections.push(plane);
                facing.letter = Some(letter);
            } else if views.iter().any(|one| one.view.sees_edge_of(plane)) {
                let retained = retained_points(self.models, &[plane], &self.sheet.uncut);
                let section = LetteredPlane { plane, letter };
                let view = SheetView::frame_section(&retained, section, self.unit())?;
                free.push(PlannedView::plain(view).with_letter(letter));
            } else {
                // Oblique planes are handled last, so that the letters of their auxiliary views
                // follow the others.
                oblique.push((LetteredPlane { plane, letter }, number));
                continue;
            }
            lettered.push(LetteredPlane { plane, letter });
        }
        for (section, number) in oblique {
            let auxiliary = letters.next().unwrap_or('Z');
            match self.oblique_section(views, section, auxiliary)? {
                Some(both) => free.extend(both),
                None => warnings.push(SheetWarning::SectionOblique { number }),
            }
        }
        for one in views {
            let own = one.letter;
            let others = lettered.iter().filter(|section| Some(section.letter) != own);
            one.section_lines = others.copied().collect();
        }
        Ok((free, warnings))
    }

    /// Returns the view of a section plane that is oblique to all views, and an auxiliary view that
    /// sees the plane edge-on and shows its line. Returns `None` if no view can show the direction
    /// of the auxiliary view.
    fn oblique_section(
        &self,
        views: &mut [PlannedView],
        section: LetteredPlane,
        auxiliary: char,
    ) -> Result<Option<[PlannedView; 2]>, SheetError> {
        let LetteredPlane { plane, letter } = section;
        let normal = Vector::from_raw(plane.normal().raw());
        // The auxiliary view looks horizontally along the plane, so the top view shows its
        // direction at full length.
        let level = unit_vector(normal.cross(Vector::Y)).unwrap_or(Vector::X);
        if !mark_direction(views, level, auxiliary) {
            return Ok(None);
        }
        let retained = retained_points(self.models, &[plane], &self.sheet.uncut);
        let view = SheetView::frame_section(&retained, section, self.unit())?;
        let mut auxiliary = self.auxiliary_view(level, auxiliary)?;
        auxiliary.section_lines = vec![section];
        Ok(Some([auxiliary, PlannedView::plain(view).with_letter(letter)]))
    }
}

/// Dimensions the width, height and depth of the models, each in the first view that shows it.
fn add_dimensions(views: &mut [PlannedView], angle: SheetAngle) {
    let across = if angle == SheetAngle::First { OverallSide::Above } else { OverallSide::Below };
    let rank = |one: &PlannedView| match one.view.name {
        ViewName::Named(NamedView::Front) => 0,
        ViewName::Named(NamedView::Back) => 1,
        ViewName::Named(NamedView::Left | NamedView::Right) => 2,
        _ => 3,
    };
    let mut order: Vec<usize> = (0..views.len()).collect();
    order.sort_by_key(|at| rank(&views[*at]));
    let mut shown = [false; 3];
    for at in order {
        let camera = views[at].view.camera;
        for (side, direction) in [(across, camera.right()), (OverallSide::Left, camera.v())] {
            let seen = direction.raw().abs();
            let axis = (0..3).find(|axis| seen[*axis] > 0.5).unwrap_or(0);
            if !core::mem::replace(&mut shown[axis], true) {
                views[at].dimensions.push(side);
            }
        }
    }
}

/// Returns the view beside the front view: the requested view or the projection angle's default, or
/// the opposite of the default if only that view faces a section.
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
    /// Plans a view without annotations.
    pub(super) fn plain(view: SheetView) -> Self {
        Self {
            view,
            dimensions: Vec::new(),
            section_lines: Vec::new(),
            letter: None,
            measures: ViewMeasures::default(),
            composition: Composition::Whole,
            detail_radius: None,
            marks: Vec::new(),
            overlays: ViewOverlays::default(),
            place: ViewPlace::default(),
            grid: None,
        }
    }

    /// Sets the letter of the section that the view shows.
    pub(super) fn with_letter(self, letter: char) -> Self {
        Self { letter: Some(letter), ..self }
    }

    /// Adds the lines of all sections that other views show.
    pub(super) fn with_lines_of(self, others: &[Self]) -> Self {
        let shown = others.iter().filter_map(|one| {
            Some(LetteredPlane { plane: *one.view.sections.first()?, letter: one.letter? })
        });
        Self { section_lines: shown.collect(), ..self }
    }

    /// Whether the view is one of the six views along the axes.
    pub(super) fn is_along_axis(&self) -> bool {
        matches!(self.view.name, ViewName::Named(name) if NamedView::PRINCIPAL.contains(&name))
    }

    /// Whether the view is uncut and is either along an axis or a detail.
    pub(super) fn is_outside_view(&self) -> bool {
        let is_outside = match self.view.name {
            ViewName::Named(_) => self.is_along_axis(),
            ViewName::Detail(_) => true,
            ViewName::Section(_) | ViewName::Auxiliary(_) => false,
        };
        is_outside && self.view.sections.is_empty() && !self.composition.is_section()
    }

    /// Whether anything is cut open in the view.
    pub(super) fn is_cut(&self) -> bool {
        !self.view.sections.is_empty()
            || self.composition.is_section()
            || matches!(self.composition, Composition::Local { .. })
    }

    /// Whether the view can have requested dimensions and center lines. Axonometric views, broken
    /// views and details cannot.
    pub(super) fn takes_measures(&self) -> bool {
        let is_axonometric = matches!(self.view.name, ViewName::Named(_)) && !self.is_along_axis();
        let is_broken = matches!(self.composition, Composition::Broken(_));
        !is_axonometric && !is_broken && self.detail_radius.is_none()
    }

    /// Returns the name for messages, such as `isometric view` or `section A-A`.
    pub(super) fn title(&self) -> String {
        match self.view.name {
            ViewName::Named(name) => format!("{name} view"),
            ViewName::Section(letter) => format!("section {letter}-{letter}"),
            ViewName::Detail(letter) => format!("detail {letter}"),
            ViewName::Auxiliary(letter) => format!("auxiliary view {letter}"),
        }
    }

    /// Returns the view as it was before a part was omitted.
    pub(super) fn drawn_view(&self) -> SheetView {
        self.view.with_size(self.view.size + self.left_out())
    }

    /// Returns the horizontal and vertical lengths omitted from the view, in object millimeters.
    fn left_out(&self) -> DVec2 {
        match &self.composition {
            Composition::Broken(part) => part.length(),
            _ => DVec2::ZERO,
        }
    }

    /// Returns the annotations beside the view, at a scale.
    pub(super) fn annotate(&self, sheet: &Sheet, scale: DrawingScale) -> ViewAnnotations {
        let letters = sheet.lettering_height();
        let half = self.view.size * scale.ratio() * 0.5;
        let object = [-half, half];
        let mark_settings = MarkSettings { ratio: scale.ratio(), object, letters };
        let lines = self.lines_of_sections(scale);
        let mut annotations = ViewAnnotations::default();
        lines.iter().for_each(|line| line.annotate(&mut annotations));
        self.marks.iter().for_each(|mark| mark.annotate(&mut annotations, &mark_settings));
        let of_lines = if lines.is_empty() { 0.0 } else { section_line_reserve(letters) };
        let of_marks = self.marks.iter().map(|mark| mark.reserve(&mark_settings));
        let settings = DimensionSettings {
            letters,
            scale,
            format: sheet.length_format(),
            reserved: of_marks.fold(of_lines.max(self.measures.reserve()), f64::max),
            not_shown: self.left_out() + self.measures.round_excess,
        };
        self.measures.annotate(&mut annotations, &self.dimensions, half, &settings);
        add_overall_dimensions(&mut annotations, &self.dimensions, half, &settings);
        // Letters and captions come after everything with a fixed position.
        lines.iter().for_each(|line| line.add_letters(&mut annotations, object, letters));
        self.marks.iter().for_each(|mark| mark.add_letters(&mut annotations, &mark_settings));
        for (layer, caption) in self.captions(scale) {
            add_caption(&mut annotations, layer, &caption, object, letters);
        }
        // A view larger than the paper has too many positions to search, so it gets no overlays.
        let paper = DVec2::new(sheet.paper.width(), sheet.paper.height());
        if (half * 2.0).cmple(paper).all() {
            self.overlays.annotate(&mut annotations, &mark_settings);
        }
        annotations
    }

    /// Returns the lines of the sections that the view sees edge-on.
    fn lines_of_sections(&self, scale: DrawingScale) -> Vec<SectionLine> {
        let view = self.drawn_view();
        let in_view = |section: &LetteredPlane| SectionLine::in_view(&view, scale, *section);
        let lines = self.section_lines.iter().filter_map(in_view);
        let shortened = |line: SectionLine| match &self.composition {
            Composition::Broken(part) => line.shortened(part, scale),
            _ => Some(line),
        };
        lines.filter_map(shortened).collect()
    }

    /// Returns the lines of text below the view.
    fn captions(&self, scale: DrawingScale) -> Vec<(AnnotationLayer, String)> {
        let mut captions = Vec::new();
        if let Some(letter) = self.letter {
            captions.push((AnnotationLayer::CutNames, format!("{letter}-{letter}")));
        }
        let own = match (&self.place.caption, self.view.name) {
            (Some(caption), _) => Some(caption.clone()).filter(|caption| !caption.is_empty()),
            (None, ViewName::Detail(letter)) => Some(format!("{letter} ({scale})")),
            (None, ViewName::Auxiliary(letter)) => Some(letter.to_string()),
            _ => None,
        };
        captions.extend(own.map(|text| (AnnotationLayer::ViewNames, text)));
        captions
    }

    /// Returns the annotations from [`annotate`](Self::annotate), plus a note of the view's scale,
    /// which differs from the sheet's.
    pub(super) fn annotate_with_scale(
        &self,
        sheet: &Sheet,
        scale: DrawingScale,
    ) -> ViewAnnotations {
        let (mut annotations, letters) = (self.annotate(sheet, scale), sheet.lettering_height());
        // The caption of a detail already contains its scale.
        if self.detail_radius.is_some() && self.place.caption.is_none() {
            return annotations;
        }
        let half = self.view.size * scale.ratio() * 0.5;
        let layer = AnnotationLayer::ScaleNotes;
        add_caption(&mut annotations, layer, &scale.to_string(), [-half, half], letters);
        annotations
    }

    /// Draws the view from its parts.
    pub(super) fn draw(
        &self,
        surfaces: &mut SurfaceCache<'_>,
        style: &LineStyle,
        scale: DrawingScale,
        threads: usize,
    ) -> Result<ComposedDrawing, SheetError> {
        let view = &self.drawn_view();
        let composed =
            self.composition.draw(&mut PartDrawing { view, surfaces, style, scale, threads })?;
        Ok(match self.detail_radius {
            Some(radius) => composed.within_disc(radius * view.pixels_per_unit()),
            None => composed,
        })
    }
}
