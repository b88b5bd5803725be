//! The transform chain from world to screen in the conventions of a graphics API, and the steps
//! that points take through it (PL-1).
//!
//! ```text
//!  World ──T, R──► View ──projection──► Clip ──÷w──► Ndc ──M_vp──► Screen
//! ```
//!
//! Matrices act on column vectors; read the figure from left to right and the product M = M_vp ·
//! M_proj · M_cam from right to left.

use super::chapter_matrices::ChapterMatrices;
use super::conventions::ApiConventions;
use super::plain_text::format_number;
use super::projection_factors;
use super::{ExplanationEntry, ItemValue, Step};
use camera::{Camera, ViewProjection, ViewTransform};
use clip::{Outcode, Volume};
use homog::{Affine, Clip, HPoint, Ndc, Point, Projective, Screen, View, World};
use projection::Intrinsics;
use viewport::{Viewport, ViewportError};

/// Camera, projection and viewport in the conventions of a graphics API.
///
/// The projection is converted once, when the chain is built; all steps then share a convention.
#[derive(Clone, Copy, Debug)]
pub struct TransformChain {
    /// The camera, whose view space looks along −z.
    camera: Camera,
    /// The projection, converted to the conventions.
    view_to_clip: Projective<View, Clip>,
    /// The conventions of all coordinates.
    conventions: ApiConventions,
    /// The viewport, with its pixel convention.
    viewport: Viewport,
    /// Columns and rows of the picture.
    size: [u32; 2],
    /// The transform from world to clip to screen in these conventions.
    transform: ViewTransform,
    /// Whether the window swaps left and right, or bottom and top; front faces then wind clockwise.
    is_mirrored: bool,
}

/// A point with its label in an explanation; the label of a single point is empty.
pub(super) type NamedPoint<'a, P> = (&'a str, P);

impl TransformChain {
    /// Creates the chain for a picture of width × height pixels.
    ///
    /// The projection is converted from the pipeline's own volume by `Convention::convert`; in
    /// left-handed conventions, the camera is composed with a flip of z. The map from world to clip
    /// space is the product of the two in f64.
    ///
    /// # Errors
    /// Returns an error if the picture has no pixels.
    pub fn new(
        view_projection: &ViewProjection,
        size: (u32, u32),
        conventions: ApiConventions,
    ) -> Result<Self, ViewportError> {
        let ViewProjection { camera, view_to_clip } = *view_projection;
        let own_volume = ApiConventions::Alberti.canonical_volume();
        let view_to_clip = own_volume.convert(conventions.canonical_volume(), view_to_clip);
        let (width, height) = size;
        let viewport = conventions.image(width, height)?;
        let world_to_view = camera.world_to_view().then(conventions.view_flip());
        let transform = ViewTransform::with_world_to_clip(
            world_to_view.then_project(view_to_clip),
            viewport.ndc_to_screen(),
            view_projection.viewer(),
        );
        let is_mirrored = view_projection.is_mirrored();
        let size = [width, height];
        Ok(Self { camera, view_to_clip, conventions, viewport, size, transform, is_mirrored })
    }

    /// Returns the transform from world to view space (looking along +z if left-handed, else −z).
    #[must_use]
    pub fn world_to_view(&self) -> Affine<World, View> {
        self.camera.world_to_view().then(self.conventions.view_flip())
    }

    /// Returns the transform from world to clip space.
    #[must_use]
    pub fn world_to_clip(&self) -> Projective<World, Clip> {
        self.transform.world_to_clip()
    }

    /// Returns the viewport transform: normalized device coordinates to pixels.
    #[must_use]
    pub fn ndc_to_screen(&self) -> Affine<Ndc, Screen> {
        self.transform.ndc_to_screen()
    }

    /// Returns the view volume in clip space, which is used for clipping.
    #[must_use]
    pub fn clip_volume(&self) -> Volume {
        match self.conventions {
            ApiConventions::Alberti | ApiConventions::Chapter | ApiConventions::ChapterYDown => {
                Volume::CHAPTER
            }
            ApiConventions::OpenGl => Volume::OPENGL,
            ApiConventions::Vulkan | ApiConventions::Direct3d | ApiConventions::WebGpu => {
                Volume::ZERO_ONE
            }
        }
    }

    /// Applies the divide and the viewport transform to a clip-space point; `None` if w is 0.
    #[must_use]
    pub fn project_to_screen(&self, point: HPoint<Clip>) -> Option<Point<Screen>> {
        self.transform.project_to_screen(point)
    }

    /// Whether a triangle shows its front, the side on which its vertices run counterclockwise;
    /// `None` if it is seen edge-on. Points and lines have no back.
    ///
    /// Because the test comes before the divide, it needs no clipping: the sign is correct even for
    /// triangles that cross the plane of the eye. A flip of y (Vulkan) and a mirrored window each
    /// invert it; two flips cancel.
    pub(super) fn is_front_facing(&self, corners: &[HPoint<Clip>]) -> Option<bool> {
        let &[a, b, c] = corners else { return Some(true) };
        // The determinant of the (x, y, w) rows is positive for counterclockwise triangles in clip
        // space with y up, even if w < 0 at some vertices (Olano and Greer, 1997).
        let [a, b, c] = [a, b, c].map(|p| glam::DVec3::new(p.x(), p.y(), p.w()));
        let volume = a.dot(b.cross(c));
        let is_flipped = self.conventions.y_runs_down() != self.is_mirrored;
        let upright_volume = if is_flipped { -volume } else { volume };
        (upright_volume != 0.0).then_some(upright_volume > 0.0)
    }

    /// Returns a point's depth in the pipeline's own volume: larger is nearer, in any convention.
    ///
    /// Points with w = 0 give −∞ and are never the nearest.
    pub(super) fn nearness(&self, point: Point<World>) -> f64 {
        let own_volume = ApiConventions::Alberti.canonical_volume();
        let to_own_volume = self.conventions.canonical_volume().clip_to_clip(own_volume);
        let clip = to_own_volume.transform_hpoint(self.world_to_clip().transform_point(point));
        clip.divide().map_or(f64::NEG_INFINITY, Point::z)
    }

    /// Returns the position of the eye.
    pub(super) fn eye(&self) -> Point<World> {
        self.camera.eye()
    }

    /// Returns the projection matrix: view to clip space.
    pub(super) fn view_to_clip(&self) -> Projective<View, Clip> {
        self.view_to_clip
    }

    /// Whether visible points have positive z in view space.
    pub(super) fn looks_along_z(&self) -> bool {
        self.conventions.looks_along_z()
    }

    /// Returns the NDC z of the near and far planes.
    pub(super) fn depth_range(&self) -> [f64; 2] {
        match self.conventions {
            ApiConventions::Alberti | ApiConventions::Chapter | ApiConventions::ChapterYDown => {
                [1.0, -1.0]
            }
            ApiConventions::OpenGl => [-1.0, 1.0],
            ApiConventions::Vulkan | ApiConventions::Direct3d | ApiConventions::WebGpu => {
                [0.0, 1.0]
            }
        }
    }

    /// Returns the textbook's matrices, for its own conventions and the projections it covers.
    fn chapter_matrices(&self) -> Option<ChapterMatrices> {
        let is_textbook = self.conventions.is_textbook();
        is_textbook.then(|| ChapterMatrices::from_projection(self.view_to_clip)).flatten()
    }

    /// Returns the width and height of the picture in pixels.
    pub(super) fn image_size(&self) -> [f64; 2] {
        [self.viewport.area().width(), self.viewport.area().height()]
    }

    /// Converts screen coordinates to pixels from the upper left corner of the image, with y down.
    pub(super) fn image_coordinates(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let border = self.viewport.convention().centers.image_border();
        let (x, y) = (x - border, y - border);
        [x, if self.rows_run_up() { self.image_size()[1] - y } else { y }]
    }

    /// Returns the step with the view transform's two factors, and the points in view space.
    ///
    /// M_cam = R · T (CA-1): the translation of the eye to the origin, then the rotation whose rows
    /// are u, v, w. Left-handed conventions add diag(1, 1, −1). The distance of a point is measured
    /// along the gaze, positive ahead of the eye, and is not its Euclidean distance.
    pub(super) fn camera_step(&self, points: &[NamedPoint<'_, Point<World>>]) -> Step {
        let mut step =
            Step::new("camera", "Camera: from the world to view space", Some("CA-1, CA-2"))
                .with_item("eye", "eye", <[f64; 3]>::from(self.camera.eye()))
                .with_item("gaze", "gaze", <[f64; 3]>::from(self.camera.gaze()))
                .with_item("u", "u, to the right", <[f64; 3]>::from(self.camera.u()))
                .with_item("v", "v, up", <[f64; 3]>::from(self.camera.v()))
                .with_item("w", "w, against the gaze", <[f64; 3]>::from(self.camera.w()))
                .with_item(
                    "translation",
                    "T, which moves the eye to the origin",
                    self.camera.translation().rows(),
                )
                .with_item("rotation", "R, with rows u, v, w", self.camera.rotation().rows());
        if self.conventions.looks_along_z() {
            step = step.with_item("turn", "flip of z", self.conventions.view_flip().rows());
        }
        step = step.with_item("world_to_view", "M_cam, the product", self.world_to_view().rows());
        let ahead = if self.conventions.looks_along_z() { 1.0 } else { -1.0 };
        for (name, point) in points {
            let view = self.world_to_view().transform_point(*point);
            step = step
                .with_item(
                    format!("view{}", id_suffix(name)),
                    label_with_name("view", name),
                    <[f64; 3]>::from(view),
                )
                .with_item(
                    format!("distance{}", id_suffix(name)),
                    label_with_name("distance ahead", name),
                    ahead * view.z(),
                );
        }
        step
    }

    /// Returns the step with the projection's factors, and the points in clip space.
    ///
    /// The formula ids depend on the kind of projection and are added with the factors. Clip
    /// coordinates have four components; w is the distance ahead for a perspective projection and 1
    /// for a parallel one.
    pub(super) fn projection_step(&self, points: &[NamedPoint<'_, Point<World>>]) -> Step {
        let mut step = Step::new("projection", "Projection: from view to clip space", None);
        projection_factors::add_projection_factors(&mut step, self.view_to_clip, self.conventions);
        let page = self.chapter_matrices();
        let names = match page.filter(ChapterMatrices::turns_w) {
            Some(_) => ["−M_per, w > 0 ahead, for clipping", "−M_per M_cam"],
            None => ["the whole projection", "projection after M_cam"],
        };
        step = step.with_item("view_to_clip", names[0], self.view_to_clip.rows()).with_item(
            "world_to_clip",
            names[1],
            self.world_to_clip().rows(),
        );
        for (name, point) in points {
            self.add_clip_items(&mut step, name, self.world_to_clip().transform_point(*point));
        }
        step
    }

    /// Adds a clip-space point; in the textbook's conventions, also with the textbook's signs.
    pub(super) fn add_clip_items(&self, step: &mut Step, name: &str, clip: HPoint<Clip>) {
        if let Some(page) = self.chapter_matrices() {
            let product = if page.turns_w() { "M_per M_cam p" } else { "M_orth M_cam p" };
            let (id, label) =
                (format!("page_clip{}", id_suffix(name)), label_with_name(product, name));
            step.add_item(id, label, <[f64; 4]>::from(page.page_clip(clip)));
        }
        let (id, label) = (format!("clip{}", id_suffix(name)), label_with_name("clip", name));
        step.add_item(id, label, <[f64; 4]>::from(clip));
    }

    /// Returns the intrinsics of a perspective projection that looks straight ahead, with picture
    /// rows counted from the top.
    fn intrinsics(&self) -> Option<Intrinsics> {
        let volume = self.conventions.canonical_volume();
        Intrinsics::from_view_to_clip(self.view_to_clip, volume, self.size).ok()
    }

    /// Returns the step with the outcodes of clip-space points.
    ///
    /// A bit is set if the signed distance of the point from a plane is negative, such as w − x for
    /// the right plane (Cohen and Sutherland). Bits are printed in binary and as plane names.
    pub(super) fn outcode_step(&self, points: &[NamedPoint<'_, HPoint<Clip>>]) -> Step {
        let mut step = Step::new(
            "outcodes",
            "Outcodes: the planes that each point is outside of",
            Some("CL-1"),
        );
        for (name, point) in points {
            let code = self.clip_volume().outcode(*point);
            let words = format!("{:06b}, {}", code.bits(), describe_outcode(code));
            step = step.with_item(
                format!("outcode{}", id_suffix(name)),
                label_with_name("outcode", name),
                words,
            );
        }
        step
    }

    /// Divides clip-space points by w and maps them to the viewport.
    ///
    /// Returns the divide step and the viewport step. A point at infinity appears only in the
    /// divide step. Points outside the volume are mapped too: their coordinates show how far
    /// outside they are. The conventions determine the range and direction of depth.
    pub(super) fn screen_steps(&self, points: &[NamedPoint<'_, HPoint<Clip>>]) -> [Step; 2] {
        let mut divide = Step::new("divide", "The divide by w", Some("HO-1"));
        let mut screen = Step::new(
            "viewport",
            "Viewport: to pixels",
            Some(self.conventions.viewport_formulas()),
        )
        .with_item("ndc_to_screen", "M_vp", self.ndc_to_screen().rows());
        if let Some(lens) = self.intrinsics() {
            screen.add_item(
                "intrinsics",
                "K, pixel centers at half-integers",
                ItemValue::PlanarMatrix(lens.to_rows()),
            );
        }
        let page = self.chapter_matrices();
        if let Some(page) = page {
            page.add_products(&mut screen, self.world_to_view(), self.ndc_to_screen());
        }
        for (name, point) in points {
            let Some(ndc) = point.divide() else {
                divide.items.push(infinity_item(name));
                continue;
            };
            let position = <[f64; 3]>::from(self.ndc_to_screen().transform_point(ndc));
            divide = divide.with_item(
                format!("ndc{}", id_suffix(name)),
                label_with_name("ndc", name),
                <[f64; 3]>::from(ndc),
            );
            if let Some(page) = page {
                let undivided = self.ndc_to_screen().raw() * page.page_clip(*point).raw();
                let id = format!("page_screen{}", id_suffix(name));
                screen.add_item(id, label_with_name("M p", name), undivided.to_array());
            }
            screen = screen
                .with_item(
                    format!("screen{}", id_suffix(name)),
                    label_with_name("x, y, depth", name),
                    position,
                )
                .with_item(
                    format!("pixel{}", id_suffix(name)),
                    label_with_name("pixel", name),
                    self.describe_pixel(position),
                );
        }
        [divide, screen]
    }

    /// Describes the pixel in words: column and row from the top, as in image files.
    ///
    /// The numbers are the floors of the coordinates relative to the image border; for points
    /// outside the picture, the column or row is negative or beyond the last.
    fn describe_pixel(&self, [x, y, _]: [f64; 3]) -> String {
        let pixels = self.viewport.convention();
        let (border, height) = (pixels.centers.image_border(), self.viewport.area().height());
        let (column, row) = (libm::floor(x - border), libm::floor(y - border));
        let from_top = if self.rows_run_up() { height - 1.0 - row } else { row };
        let side = if self.rows_run_up() { "; row 0 is at the bottom here" } else { "" };
        format!(
            "column {}, row {} from the top{side}",
            format_number(column),
            format_number(from_top)
        )
    }

    /// Whether pixel rows count from the bottom.
    fn rows_run_up(&self) -> bool {
        matches!(self.conventions, ApiConventions::Chapter | ApiConventions::OpenGl)
    }
}

/// Returns the item for a point whose w is 0.
///
/// The item has the id of the NDC coordinates but contains text, because a direction or a point in
/// the plane of the eye has no image.
fn infinity_item(name: &str) -> ExplanationEntry {
    let words = "w is 0: the point is at infinity and has no screen position";
    ExplanationEntry {
        id: format!("ndc{}", id_suffix(name)),
        name: label_with_name("ndc", name),
        value: ItemValue::from(words),
    }
}

/// Describes an outcode in words: `inside`, or `outside the near and left planes`.
pub(super) fn describe_outcode(code: Outcode) -> String {
    if code.is_inside() {
        return "inside".to_owned();
    }
    let names: Vec<String> = code.planes().map(|plane| plane.to_string()).collect();
    match names.as_slice() {
        [first @ .., last] if !first.is_empty() => {
            format!("outside the {} and {last} planes", first.join(", "))
        }
        _ => format!("outside the {} plane", names.join("")),
    }
}

/// Returns the suffix of an item's id for a labeled point.
///
/// It is `_a` for the point a, and empty for a single point.
fn id_suffix(name: &str) -> String {
    if name.is_empty() { String::new() } else { format!("_{name}") }
}

/// Returns the label of an item for a labeled point.
///
/// It is `clip of a` for the point a, and `clip` for a single point.
fn label_with_name(what: &str, name: &str) -> String {
    if name.is_empty() { what.to_owned() } else { format!("{what} of {name}") }
}
