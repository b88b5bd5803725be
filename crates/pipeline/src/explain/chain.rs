//! The chain of maps from the world to the screen, and what it does to points (PL-1).
//!
//! ```text
//!  World ──T, R──► View ──projection──► Clip ──÷w──► Ndc ──M_vp──► Screen
//! ```

use super::conventions::Conventions;
use super::factors;
use super::text::number;
use super::{Item, Step, Value};
use camera::Camera;
use camera::ViewProjection;
use clip::{Outcode, Volume};
use homog::{Affine, Clip, HPoint, Ndc, Point, Projective, Screen, View, World};
use viewport::{Viewport, ViewportError};

/// Camera, projection and viewport in somebody's conventions.
#[derive(Clone, Copy, Debug)]
pub struct Chain {
    camera: Camera,
    view_to_clip: Projective<View, Clip>,
    conventions: Conventions,
    viewport: Viewport,
    /// Whether the window exchanges left and right, or bottom and top.
    mirrors: bool,
}

/// A point of the world with the name it has in an explanation.
pub(super) type Named<'a, P> = (&'a str, P);

impl Chain {
    /// The chain of a picture of so many pixels.
    ///
    /// # Errors
    /// If the picture has no pixels.
    pub fn of(
        view_projection: &ViewProjection,
        (width, height): (u32, u32),
        conventions: Conventions,
    ) -> Result<Self, ViewportError> {
        let ours = Conventions::Alberti.volume();
        Ok(Self {
            camera: view_projection.camera,
            view_to_clip: ours.convert(conventions.volume(), view_projection.view_to_clip),
            conventions,
            viewport: conventions.viewport(width, height)?,
            mirrors: view_projection.mirrors(),
        })
    }

    /// From the world to view space, which looks along −z, or along +z where the conventions want it.
    #[must_use]
    pub fn world_to_view(&self) -> Affine<World, View> {
        self.camera.world_to_view().then(self.turn())
    }

    /// From the world to clip space.
    #[must_use]
    pub fn world_to_clip(&self) -> Projective<World, Clip> {
        self.world_to_view().then_project(self.view_to_clip)
    }

    /// From normalised device coordinates to pixels.
    #[must_use]
    pub fn ndc_to_screen(&self) -> Affine<Ndc, Screen> {
        self.viewport.ndc_to_screen()
    }

    /// The volume that is visible, in clip space.
    #[must_use]
    pub fn volume(&self) -> Volume {
        match self.conventions {
            Conventions::Alberti | Conventions::Chapter => Volume::CHAPTER,
            Conventions::OpenGl => Volume::OPENGL,
            Conventions::Vulkan | Conventions::Direct3d | Conventions::WebGpu => Volume::ZERO_ONE,
        }
    }

    /// Where a point of clip space is on the screen; `None` if it has no place there.
    #[must_use]
    pub fn to_screen(&self, point: HPoint<Clip>) -> Option<Point<Screen>> {
        Some(self.ndc_to_screen().point(point.divide()?))
    }

    /// Whether a triangle (a, b, c) shows the viewer the side on which its corners run counter-clockwise; `None` if it is seen
    /// edge-on. Points and lines have no back.
    pub(super) fn shows_front(&self, corners: &[HPoint<Clip>]) -> Option<bool> {
        let &[a, b, c] = corners else { return Some(true) };
        // The volume of (x, y, w) is positive if the corners run counter-clockwise in clip space with y up, also where w is
        // negative for some (Olano and Greer, 1997).
        let [a, b, c] = [a, b, c].map(|p| glam::DVec3::new(p.x(), p.y(), p.w()));
        let volume = a.dot(b.cross(c));
        let turned = self.conventions.y_runs_down() != self.mirrors;
        let upright = if turned { -volume } else { volume };
        (upright != 0.0).then_some(upright > 0.0)
    }

    /// How near a point is to the viewer: its depth in the pipeline's own volume, larger if nearer.
    pub(super) fn depth(&self, place: Point<World>) -> f64 {
        let ours = Conventions::Alberti.volume();
        let to_ours = self.conventions.volume().clip_to_clip(ours);
        let clip = to_ours.hpoint(self.world_to_clip().point(place));
        clip.divide().map_or(f64::NEG_INFINITY, Point::z)
    }

    /// From view space to clip space.
    pub(super) fn view_to_clip(&self) -> Projective<View, Clip> {
        self.view_to_clip
    }

    /// Whether view space has the scene at positive z.
    pub(super) fn looks_along_z(&self) -> bool {
        self.conventions.looks_along_z()
    }

    /// The z of the near and of the far plane after the divide.
    pub(super) fn depth_range(&self) -> [f64; 2] {
        match self.conventions {
            Conventions::Alberti | Conventions::Chapter => [1.0, -1.0],
            Conventions::OpenGl => [-1.0, 1.0],
            Conventions::Vulkan | Conventions::Direct3d | Conventions::WebGpu => [0.0, 1.0],
        }
    }

    /// Width and height of the picture in pixels.
    pub(super) fn size(&self) -> [f64; 2] {
        [self.viewport.area().width(), self.viewport.area().height()]
    }

    /// A place on the screen in pixels from the upper left corner of the picture, rows running down.
    pub(super) fn below_upper_left(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let border = self.viewport.convention().centres.border();
        let (x, y) = (x - border, y - border);
        [x, if self.rows_go_up() { self.size()[1] - y } else { y }]
    }

    fn turn(&self) -> Affine<View, View> {
        let z = if self.conventions.looks_along_z() { -1.0 } else { 1.0 };
        Affine::scale(1.0, 1.0, z)
    }

    /// The camera's two factors, and the points in view space.
    pub(super) fn camera_step(&self, points: &[Named<'_, Point<World>>]) -> Step {
        let mut step =
            Step::new("camera", "Camera: from the world to view space", Some("CA-1, CA-2"))
                .with("eye", "eye", <[f64; 3]>::from(self.camera.eye()))
                .with("gaze", "gaze", <[f64; 3]>::from(self.camera.gaze()))
                .with("translation", "T, the eye to the origin", self.camera.translation().rows())
                .with("rotation", "R, u v w to the axes", self.camera.rotation().rows());
        if self.conventions.looks_along_z() {
            step = step.with("turn", "z turned over", self.turn().rows());
        }
        step = step.with("world_to_view", "M_cam, the product", self.world_to_view().rows());
        let ahead = if self.conventions.looks_along_z() { 1.0 } else { -1.0 };
        for (name, point) in points {
            let view = self.world_to_view().point(*point);
            step = step
                .with(format!("view{}", suffix(name)), titled("view", name), <[f64; 3]>::from(view))
                .with(
                    format!("distance{}", suffix(name)),
                    titled("distance ahead", name),
                    ahead * view.z(),
                );
        }
        step
    }

    /// The projection's factors, and the points in clip space with their outcodes.
    pub(super) fn projection_step(&self, points: &[Named<'_, Point<World>>]) -> Step {
        let mut step = Step::new("projection", "Projection: from view to clip space", None);
        factors::describe(&mut step, self.view_to_clip, self.conventions);
        step = step.with("view_to_clip", "the whole projection", self.view_to_clip.rows()).with(
            "world_to_clip",
            "projection after M_cam",
            self.world_to_clip().rows(),
        );
        for (name, point) in points {
            let clip = self.world_to_clip().point(*point);
            step = step.with(
                format!("clip{}", suffix(name)),
                titled("clip", name),
                <[f64; 4]>::from(clip),
            );
        }
        step
    }

    /// The outcodes of points of clip space.
    pub(super) fn outcode_step(&self, points: &[Named<'_, HPoint<Clip>>]) -> Step {
        let mut step =
            Step::new("outcodes", "Outcodes: which planes each is outside of", Some("CL-1"));
        for (name, point) in points {
            let code = self.volume().outcode(*point);
            let words = format!("{:06b}, {}", code.bits(), planes(code));
            step = step.with(format!("outcode{}", suffix(name)), titled("outcode", name), words);
        }
        step
    }

    /// The divide and the viewport, for points that are inside the view volume.
    pub(super) fn screen_steps(&self, points: &[Named<'_, HPoint<Clip>>]) -> [Step; 2] {
        let mut divide = Step::new("divide", "The divide by w", Some("HO-1"));
        let mut screen = Step::new(
            "viewport",
            "Viewport: to pixels",
            Some("VP-1, VP-2, VP-3, DP-1"),
        )
        .with("ndc_to_screen", "M_vp", self.ndc_to_screen().rows());
        for (name, point) in points {
            let Some(ndc) = point.divide() else {
                divide.items.push(at_infinity(name));
                continue;
            };
            let place = <[f64; 3]>::from(self.ndc_to_screen().point(ndc));
            divide = divide.with(
                format!("ndc{}", suffix(name)),
                titled("ndc", name),
                <[f64; 3]>::from(ndc),
            );
            screen = screen
                .with(format!("screen{}", suffix(name)), titled("x, y, depth", name), place)
                .with(format!("pixel{}", suffix(name)), titled("pixel", name), self.pixel(place));
        }
        [divide, screen]
    }

    /// The pixel in words: column and row, as this program and image files count them.
    fn pixel(&self, [x, y, _]: [f64; 3]) -> String {
        let pixels = self.viewport.convention();
        let (border, height) = (pixels.centres.border(), self.viewport.area().height());
        let (column, row) = (libm::floor(x - border), libm::floor(y - border));
        let from_top = if self.rows_go_up() { height - 1.0 - row } else { row };
        let side = if self.rows_go_up() { "; row 0 is the lowest here" } else { "" };
        format!("column {}, row {} from the top{side}", number(column), number(from_top))
    }

    fn rows_go_up(&self) -> bool {
        matches!(self.conventions, Conventions::Chapter | Conventions::OpenGl)
    }
}

fn at_infinity(name: &str) -> Item {
    let words = "w is 0: it is at infinity and has no place on the screen";
    Item {
        id: format!("ndc{}", suffix(name)),
        name: titled("ndc", name),
        value: Value::from(words),
    }
}

/// The planes of an outcode in words.
pub(super) fn planes(code: Outcode) -> String {
    if code.is_inside() {
        return "inside".to_owned();
    }
    let names: Vec<String> = code.planes().map(|plane| plane.to_string()).collect();
    format!("outside of {}", names.join(", "))
}

fn suffix(name: &str) -> String {
    if name.is_empty() { String::new() } else { format!("_{name}") }
}

fn titled(what: &str, name: &str) -> String {
    if name.is_empty() { what.to_owned() } else { format!("{what} of {name}") }
}
