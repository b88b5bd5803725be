//! Sheet view: one orthographic view on a sheet, with its size in object millimeters.
//!
//! ```text
//!   points of the models ─frame─► camera, depths, size      (SheetView::frame_points)
//!   camera, window ─draw─► Drawing of 8192 pixels           (draw)
//!   drawing, scale ─placement─► millimeters on the sheet    (placement)
//! ```
//!
//! The drawing is created at a fixed resolution and scaled during layout. Pixels are only a unit,
//! because coordinates are `f64`.

use super::section_line::LetteredPlane;
use super::{Placement, SheetError};
use camera::{Basis, Camera, CameraError, FramingError, NamedView, ViewProjection, frame_parallel};
use core::fmt;
use drawing::{Drawing, FaceFill, FillOptions, LineStyle, draw_surface};
use glam::DVec2;
use hidden_line::{DrawOptions, WeldedSurface};
use homog::{Plane, Point, Vector, World};
use projection::{Convention, Orthographic};
use viewport::DrawingScale;

/// The longer side of the drawing in pixels. Only its ratio to the window matters.
const LONG_SIDE_PIXELS: f64 = 8192.0;

/// The resolution of flat fills: 300 dots per inch.
const FILL_DOTS_PER_MILLIMETER: f64 = 300.0 / viewport::MILLIMETERS_PER_INCH;

/// The resolution at which the outlines of gray fills are traced. The pixel steps are small enough
/// that even the narrowest wide line hides them.
const GRAY_DOTS_PER_MILLIMETER: f64 = 2.0 * FILL_DOTS_PER_MILLIMETER;

/// The factor by which the window is larger than the object, so that nothing touches its border.
const WINDOW_MARGIN: f64 = 1.02;

/// The content of a sheet view: the object from a named direction, or a section, detail or
/// auxiliary view with its letter.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum ViewName {
    Named(NamedView),
    Section(char),
    Detail(char),
    Auxiliary(char),
}

impl fmt::Display for ViewName {
    /// Writes the name in the form used as a prefix of layer ids.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Named(view) => view.fmt(f),
            Self::Section(letter) => write!(f, "section-{}", letter.to_ascii_lowercase()),
            Self::Detail(letter) => write!(f, "detail-{}", letter.to_ascii_lowercase()),
            Self::Auxiliary(letter) => write!(f, "auxiliary-{}", letter.to_ascii_lowercase()),
        }
    }
}

/// A parallel view of the object, from a named direction or straight at a section plane.
#[derive(Clone, Debug)]
pub(super) struct SheetView {
    pub(super) name: ViewName,
    pub(super) camera: Camera,
    /// The section planes that cut the object in this view.
    pub(super) sections: Vec<Plane<World>>,
    /// The nearest and farthest depths of the object along the view direction, in scene units.
    depths: [f64; 2],
    /// The width and height of the object in this view, in object millimeters.
    pub(super) size: DVec2,
    /// Millimeters per scene unit.
    pub(super) millimeters_per_unit: f64,
}

impl SheetView {
    /// Creates an uncut view of the given points in a named direction.
    ///
    /// # Errors
    /// Returns [`SheetError::Empty`] without points, or [`SheetError::View`] if framing fails.
    pub(super) fn frame_points(
        points: &[Point<World>],
        name: NamedView,
        unit: f64,
    ) -> Result<Self, SheetError> {
        Self::frame_from(points, ViewName::Named(name), name.basis(), unit)
    }

    /// Creates the view that looks straight at a section plane and frames the points that the plane
    /// retains.
    ///
    /// # Errors
    /// See [`frame_points`](Self::frame_points).
    pub(super) fn frame_section(
        points: &[Point<World>],
        section: LetteredPlane,
        unit: f64,
    ) -> Result<Self, SheetError> {
        let LetteredPlane { plane, letter } = section;
        let gaze = Vector::from_raw(plane.normal().raw());
        let view = Self::frame_along(points, ViewName::Section(letter), gaze, unit)?;
        Ok(view.cut_by(vec![plane]))
    }

    /// Creates a view of the given points in any direction, with the top of the models up.
    ///
    /// # Errors
    /// See [`frame_points`](Self::frame_points).
    pub(super) fn frame_along(
        points: &[Point<World>],
        name: ViewName,
        gaze: Vector<World>,
        unit: f64,
    ) -> Result<Self, SheetError> {
        let view_error = |error: CameraError| SheetError::View {
            view: name.to_string(),
            reason: error.to_string(),
        };
        let basis = Basis::from_gaze_or_fallback(gaze, Vector::Y).map_err(view_error)?;
        Self::frame_from(points, name, basis, unit)
    }

    /// Returns the part of the view within a radius of a point, in scene units.
    ///
    /// # Errors
    /// Returns [`SheetError::View`] if the camera cannot be moved to the point.
    pub(super) fn detail_around(
        &self,
        center: Point<World>,
        radius: f64,
        letter: char,
    ) -> Result<Self, SheetError> {
        let name = ViewName::Detail(letter);
        let offset = self.image_of(center) / self.millimeters_per_unit;
        let by = self.camera.right() * offset.x - self.camera.v() * offset.y;
        let camera = self.camera.moved(by).map_err(|error| SheetError::View {
            view: name.to_string(),
            reason: error.to_string(),
        })?;
        let size = DVec2::splat(2.0 * radius * self.millimeters_per_unit);
        Ok(Self { name, camera, size, ..self.clone() })
    }

    /// Returns the foreshortened image of a world direction, with x to the right and y down.
    pub(super) fn direction_of(&self, direction: Vector<World>) -> DVec2 {
        let seen = self.camera.rotation().transform_vector(direction).raw();
        DVec2::new(seen.x, -seen.y)
    }

    /// Returns the size of the drawing in pixels.
    fn pixel_size(&self) -> DVec2 {
        let window = self.window_size();
        (window * (LONG_SIDE_PIXELS / window.max_element())).ceil().max(DVec2::ONE)
    }

    /// Returns the number of drawing pixels per scene unit, along the longer side.
    pub(super) fn pixels_per_unit(&self) -> f64 {
        LONG_SIDE_PIXELS / self.window_size().max_element()
    }

    /// Returns the position of a world point in the drawing, in pixels.
    pub(super) fn pixel_of(&self, point: Point<World>) -> DVec2 {
        let (window, pixels) = (self.window_size(), self.pixel_size());
        (self.image_of(point) / self.millimeters_per_unit / window + 0.5) * pixels
    }

    /// Returns the view with the object cut by the given planes.
    pub(super) fn cut_by(self, sections: Vec<Plane<World>>) -> Self {
        Self { sections, ..self }
    }

    /// Returns the view with a different size, in object millimeters.
    pub(super) fn with_size(&self, size: DVec2) -> Self {
        Self { size, ..self.clone() }
    }

    /// Creates the view of the given points with a camera of the given orientation.
    fn frame_from(
        points: &[Point<World>],
        name: ViewName,
        basis: Basis,
        unit: f64,
    ) -> Result<Self, SheetError> {
        let framing_error = |error: FramingError| match error {
            FramingError::NoPoints => SheetError::Empty,
            error => SheetError::View { view: name.to_string(), reason: error.to_string() },
        };
        let framed =
            frame_parallel(points.iter().copied(), basis, 1.0, 0.0).map_err(framing_error)?;
        let world_to_view = framed.camera.world_to_view();
        let extents =
            points.iter().map(|&point| world_to_view.transform_point(point).raw().truncate());
        let half = extents.fold(DVec2::ZERO, |most, point| most.max(point.abs()));
        let (camera, depths, sections) = (framed.camera, [framed.near, framed.far], Vec::new());
        let size = half * 2.0 * unit;
        Ok(Self { name, camera, sections, depths, size, millimeters_per_unit: unit })
    }

    /// Returns the width and height of the window in scene units. Neither is zero, even if the
    /// object is flat.
    fn window_size(&self) -> DVec2 {
        let size = self.size / self.millimeters_per_unit;
        let least = size.max_element().max(self.depths[1] - self.depths[0]).max(1e-9) * 0.02;
        (size * WINDOW_MARGIN).max(DVec2::splat(least))
    }

    /// Returns the line drawing of the view.
    pub(super) fn draw(
        &self,
        surface: &WeldedSurface,
        style: &LineStyle,
        scale: DrawingScale,
        threads: usize,
    ) -> Result<Drawing, SheetError> {
        let (view_projection, size) = self.view_projection()?;
        let window = self.window_size();
        // Millimeters on paper per pixel.
        let pixel = scale.to_paper_length(window.max_element() * self.millimeters_per_unit)
            / LONG_SIDE_PIXELS;
        let dots = match style.face_fill {
            FaceFill::Gray => GRAY_DOTS_PER_MILLIMETER,
            _ => FILL_DOTS_PER_MILLIMETER,
        };
        let options =
            DrawOptions { hatch_spacing: style.hatch_spacing / pixel, ..style.to_draw_options() };
        let fill = FillOptions { scale: dots * pixel, ..style.to_fill_options() };
        Ok(draw_surface(surface, &view_projection, size, &options, &fill, threads)?)
    }

    /// Returns the camera with its view volume, and the size of the drawing in pixels. The depth
    /// range gets a margin of 2% of the extent.
    ///
    /// # Errors
    /// Returns [`SheetError::View`] if the view volume is invalid.
    pub(super) fn view_projection(&self) -> Result<(ViewProjection, [u32; 2]), SheetError> {
        let window = self.window_size();
        let half = window * 0.5;
        let margin = (self.depths[1] - self.depths[0]).max(window.max_element()) * 0.02;
        let (near, far) = (self.depths[0] - margin, self.depths[1] + margin);
        let volume = Orthographic::new(-half.x, half.x, -half.y, half.y, near, far);
        let volume = volume.map_err(|error| SheetError::View {
            view: self.name.to_string(),
            reason: error.to_string(),
        })?;
        let view_to_clip = volume.view_to_clip(Convention::CHAPTER);
        let size = self.pixel_size().to_array().map(|side| side as u32);
        Ok((ViewProjection { camera: self.camera, view_to_clip }, size))
    }

    /// Returns the placement of the view's drawing on the sheet, at this scale and centered at
    /// `center`.
    pub(super) fn placement(
        &self,
        drawing: &Drawing,
        scale: DrawingScale,
        center: DVec2,
    ) -> Placement {
        let window = self.window_size() * self.millimeters_per_unit;
        let window = DVec2::new(scale.to_paper_length(window.x), scale.to_paper_length(window.y));
        Placement { corner: center - window * 0.5, scale: window / drawing.size }
    }
}
