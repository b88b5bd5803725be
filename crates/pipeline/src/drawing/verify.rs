//! The self-check: a drawing against the z-buffer image of the same scene.
//!
//! The two have the stages up to clip space in common and nothing after: here is rounding to a grid, coverage of samples and
//! a depth for each pixel, there are crossings of lines. Where a line is drawn as visible, the z-buffer must show, within half
//! a pixel, something that is not in front of it: the face beside the edge, one behind it, or nothing.

use super::LineDrawing;
use super::edges::Shape;
use super::sight::Sight;
use crate::render::RenderError;
use crate::scene::Scene;
use clip::{Volume, clip_triangle};
use glam::{DVec2, DVec3};
use homog::Point;
use raster::{Cover, Frame, Samples, ScreenVertex};
use viewport::Viewport;

/// The longest side of the z-buffer image in pixels.
const LONGEST: u32 = 8192;

/// How much finer than the drawing the z-buffer image is, if it may be.
const FINER: u32 = 4;

/// How far from the edge the z-buffer may show it, in pixels of the drawing.
const NEAR: f64 = 0.5;

/// How well a drawing agrees with the z-buffer image: lengths on the screen in pixels.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Agreement {
    /// The length of all visible lines.
    pub visible: f64,
    /// The length of those of them that the z-buffer hides.
    pub denied: f64,
    /// The length of all hidden lines in the drawing.
    pub hidden: f64,
    /// The length of those of them that the z-buffer shows.
    pub shown: f64,
    /// Where visible lines are denied: by the line's place in the drawing, the length.
    pub places: Vec<(usize, f64)>,
}

impl Agreement {
    /// The share of the visible length that the z-buffer hides.
    #[must_use]
    pub fn disagreement(&self) -> f64 {
        if self.visible > 0.0 { self.denied / self.visible } else { 0.0 }
    }
}

/// Compares a drawing with the z-buffer image of its scene, at points half a pixel apart.
///
/// # Errors
/// If the picture has no pixels or is larger than can be drawn.
pub fn verify(scene: &Scene, drawing: &LineDrawing) -> Result<Agreement, RenderError> {
    let image = Image::of(scene)?;
    let mut agreement = Agreement::default();
    for (place, line) in drawing.lines.iter().enumerate() {
        let [a, b] = line.ends;
        let length = (b - a).length();
        let count = (length / NEAR).ceil().max(1.0);
        let step = length / count;
        let at = |n: f64| {
            let s = (n + 0.5) / count;
            (a + (b - a) * s, line.depths[0] + (line.depths[1] - line.depths[0]) * s)
        };
        let samples = (0..count as usize).map(|n| at(n as f64));
        if line.visible {
            let denied = samples.filter(|&(p, depth)| !image.shows(p, depth)).count() as f64 * step;
            agreement.visible += length;
            agreement.denied += denied;
            if denied > 0.0 {
                agreement.places.push((place, denied));
            }
        } else {
            let shown = samples.filter(|&(p, depth)| !image.hides(p, depth)).count() as f64 * step;
            agreement.hidden += length;
            agreement.shown += shown;
        }
    }
    Ok(agreement)
}

/// Which face is seen in each pixel.
struct Image {
    width: i64,
    height: i64,
    /// Pixels to a pixel of the drawing.
    scale: f64,
    ids: Vec<Option<u32>>,
    planes: Vec<Plane>,
}

/// The plane of a face on the screen: depth by place.
#[derive(Clone, Copy, Debug)]
struct Plane {
    through: DVec3,
    slope: DVec2,
}

impl Plane {
    fn of([a, b, c]: [DVec3; 3]) -> Self {
        let normal = (b - a).cross(c - a);
        Self { through: a, slope: -normal.truncate() / normal.z }
    }

    fn depth(&self, place: DVec2) -> f64 {
        self.through.z + self.slope.dot(place - self.through.truncate())
    }
}

impl Image {
    fn of(scene: &Scene) -> Result<Self, RenderError> {
        let (width, height) = (scene.image.width, scene.image.height);
        let finer = (LONGEST / width.max(height)).clamp(1, FINER);
        let (width, height) = (width * finer, height * finer);
        let sight = Sight::new(&scene.shot, &Viewport::image(width, height)?);
        let mut frame = Frame::new(width, height, Samples::One)?;
        let mut planes = Vec::new();
        let shape = Shape::of(scene);
        for face in &shape.faces {
            let corners = face.corners.map(|corner| sight.project(shape.points[corner as usize]));
            for piece in clip_triangle(corners, &Volume::CHAPTER).triangles() {
                let places = piece.map(|vertex| sight.place(vertex.point));
                let [Some(a), Some(b), Some(c)] = places else { continue };
                let snap = |place, k: usize| {
                    ScreenVertex::snap(Point::from_raw(place), piece[k].point.w())
                };
                let snapped = [snap(a, 0), snap(b, 1), snap(c, 2)];
                let [Some(p), Some(q), Some(r)] = snapped else { continue };
                let id = u32::try_from(planes.len()).map_err(|_| RenderError::TooManyPrimitives)?;
                frame.triangle([p, q, r], id, Cover::Solid);
                planes.push(Plane::of([a, b, c]));
            }
        }
        let ids = frame.visibility().ids;
        let scale = f64::from(finer);
        Ok(Self { width: width.into(), height: height.into(), scale, ids, planes })
    }

    /// Whether something that is not in front of a point is seen near it.
    fn shows(&self, place: DVec2, depth: f64) -> bool {
        self.near(place).any(|(at, id)| id.is_none_or(|id| !self.is_before(id, at, depth)))
    }

    /// Whether something in front of a point is seen near it.
    fn hides(&self, place: DVec2, depth: f64) -> bool {
        self.near(place).any(|(at, id)| id.is_some_and(|id| self.is_before(id, at, depth)))
    }

    /// Whether a face, continued as a plane to a place, is in front of a point there.
    fn is_before(&self, id: u32, place: DVec2, depth: f64) -> bool {
        let plane = &self.planes[id as usize];
        plane.depth(place) > depth + 1e-9 + 1e-3 * (plane.slope.x.abs() + plane.slope.y.abs())
    }

    /// What is seen within [`NEAR`] of a place of the drawing, each with that place in the image.
    fn near(&self, place: DVec2) -> impl Iterator<Item = (DVec2, Option<u32>)> {
        let at = place * self.scale;
        let reach = NEAR * self.scale;
        let (left, right) = ((at.x - reach).floor() as i64, (at.x + reach).floor() as i64);
        let (top, bottom) = ((at.y - reach).floor() as i64, (at.y + reach).floor() as i64);
        let pixels = (top..=bottom).flat_map(move |y| (left..=right).map(move |x| (x, y)));
        pixels.filter_map(move |(x, y)| {
            let center = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
            let is_near = (center - at).length() <= reach + std::f64::consts::FRAC_1_SQRT_2;
            let is_inside = (0..self.width).contains(&x) && (0..self.height).contains(&y);
            let id = || self.ids[(y * self.width + x) as usize];
            (is_near && is_inside).then(|| (at, id()))
        })
    }
}
