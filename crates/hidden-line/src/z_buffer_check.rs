//! Verification of a line drawing against the z-buffer image of the same scene.
//!
//! The two share the welded surface and the stages up to clip space, but nothing after that. The
//! z-buffer rounds to a grid, samples coverage and stores a depth for each pixel; the drawing
//! intersects lines with faces. Where a segment is drawn as visible, the z-buffer must show, within
//! half a pixel, the face at the edge, a face behind it, or the background.
//!
//! ```text
//!   drawing       ●───────●───────●   points half a pixel apart
//!   z-buffer  ▓▓▓▓░░░░░░░░░░░░▒▒▒▒    ids of the nearest faces, at 4 × the resolution
//! ```

use super::EdgeClass;
use super::EdgeSegment;
use super::edges::WeldedSurface;
use super::face_raster::rasterize_faces;
use super::projector::Projector;
use crate::{DrawError, Subject};
use glam::{DMat4, DVec2, DVec3};
use homog::{ClipRange, Point};
use viewport::Viewport;

/// The maximum side of the z-buffer image in pixels.
const MAX_Z_BUFFER_SIDE: u32 = 8192;

/// Z-buffer pixels per drawing pixel, if the maximum side allows it.
const SUPERSAMPLING: u32 = 4;

/// The distance from a point within which the z-buffer may show it, in drawing pixels.
const SEARCH_RADIUS: f64 = 0.5;

/// The distance from a point within which the z-buffer must show a reason for the line, in drawing
/// pixels. It is larger than [`SEARCH_RADIUS`], so that a gap of half a pixel beside an edge is not
/// mistaken for a missing reason.
const REASON_RADIUS: f64 = 1.0;

/// The cosine of the angle, a thousandth of a radian, below which planes count as parallel. Rounding
/// of positions tilts small faces of a flat wall by less, and all edges that are drawn bend more.
const PARALLEL_COSINE: f64 = 1.0 - 5e-7;

/// The agreement of a drawing with the z-buffer image, as lengths on the screen in pixels.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Agreement {
    /// The length of all visible segments of the drawing.
    pub visible_length: f64,
    /// The length of the parts of visible segments that the z-buffer hides.
    pub denied_length: f64,
    /// The length of all hidden segments of the drawing.
    pub hidden_length: f64,
    /// The length of the parts of hidden segments that the z-buffer shows.
    pub contradicted_length: f64,
    /// The index of each visible segment with denied parts, and the length of these parts.
    pub denied_segments: Vec<(usize, f64)>,
    /// The length of the visible segments on flat parts of the z-buffer image, where it shows no
    /// edge within a pixel.
    pub groundless_length: f64,
    /// The visible segments with a groundless part: their indices, and the length of that part.
    pub groundless_segments: Vec<(usize, f64)>,
}

impl Agreement {
    /// Returns the fraction of the visible length that the z-buffer hides.
    #[must_use]
    pub fn disagreement_ratio(&self) -> f64 {
        if self.visible_length > 0.0 { self.denied_length / self.visible_length } else { 0.0 }
    }
}

/// Compares the segments of a drawing with the z-buffer image of its scene, at points half a pixel
/// apart.
///
/// Each point is unprojected with its depth and compared with the planes of the faces that the
/// image shows within half a pixel. A visible point is denied if all these planes are in front of
/// it; a hidden point is contradicted if none of them is. Disagreement below about 0.2% of the
/// length is normal, because the image resolves a quarter of a pixel.
///
/// A visible point is groundless if all faces within a pixel are in one plane and belong to one
/// connected surface and material. Hatching, facets, marked edges and line primitives need no such reason.
/// Contours that are interpolated across facets run inside them, so ignore their groundless parts.
/// Where the cut faces of bodies overlap, the image shows one of them, so the outlines of the
/// others can be groundless. So can edges where walls inside a body meet its surface.
///
/// # Errors
/// Fails if the image has no pixels or exceeds the maximum z-buffer size.
pub fn verify_with_z_buffer(
    subject: &Subject<'_>,
    segments: &[EdgeSegment],
) -> Result<Agreement, DrawError> {
    let image = ZBufferImage::rasterize_subject(subject)?;
    let mut agreement = Agreement::default();
    for (index, segment) in segments.iter().enumerate() {
        let length = segment.ends[0].distance(segment.ends[1]);
        let fraction = |is_counted: &dyn Fn(DVec2, f64) -> bool| {
            let (mut counted, mut count) = (0_u32, 0_u32);
            for (point, depth) in sample_points(segment) {
                count += 1;
                counted += u32::from(is_counted(point, depth));
            }
            length * f64::from(counted) / f64::from(count)
        };
        if !segment.visible {
            agreement.hidden_length += length;
            agreement.contradicted_length += fraction(&|p, depth| !image.hides_point(p, depth));
            continue;
        }
        let denied = fraction(&|p, depth| !image.shows_point(p, depth));
        agreement.visible_length += length;
        agreement.denied_length += denied;
        if denied > 0.0 {
            agreement.denied_segments.push((index, denied));
        }
        if needs_reason(segment.class) {
            let groundless = fraction(&|p, depth| image.is_flat_near(p, depth));
            agreement.groundless_length += groundless;
            if groundless > 0.0 {
                agreement.groundless_segments.push((index, groundless));
            }
        }
    }
    Ok(agreement)
}

/// Returns points on a segment about half a pixel apart, with their depths.
fn sample_points(segment: &EdgeSegment) -> impl Iterator<Item = (DVec2, f64)> {
    let ([a, b], [near, far]) = (segment.ends, segment.depths);
    let count = ((b - a).length() / SEARCH_RADIUS).ceil().max(1.0);
    (0..count as usize).map(move |n| {
        let s = (n as f64 + 0.5) / count;
        (a + (b - a) * s, near + (far - near) * s)
    })
}

/// Whether lines of a class are drawn only where the surface changes.
const fn needs_reason(class: EdgeClass) -> bool {
    matches!(
        class,
        EdgeClass::Silhouette
            | EdgeClass::Boundary
            | EdgeClass::Crease
            | EdgeClass::Intersection
            | EdgeClass::Section
            | EdgeClass::Tangent
    )
}

/// An image of the face visible in each pixel, at a multiple of the drawing's resolution.
struct ZBufferImage {
    width: i64,
    height: i64,
    /// Image pixels per drawing pixel.
    scale: f64,
    ids: Vec<Option<u32>>,
    /// The planes of the faces by id.
    planes: Vec<FacePlane>,
    /// The shells and materials of the faces by id.
    owners: Vec<[u32; 2]>,
    /// The transform from drawing points with depth to world space.
    to_world: DMat4,
    /// The distance, in world units, below which a point is considered to be in a plane.
    touching: f64,
}

/// The plane of a face: the normal facing the viewer, and the distance from the origin along it.
#[derive(Clone, Copy, Debug)]
struct FacePlane {
    normal: DVec3,
    offset: f64,
}

impl FacePlane {
    /// Returns the plane of a triangle, oriented toward the viewer.
    ///
    /// The viewer's side is the side where depth increases. It is derived from the matrix rather
    /// than from the projector's viewer, which hidden-line removal uses, so that a wrong viewer is
    /// detected. The row vector (n, −offset) in the world becomes (n, −offset) · M⁻¹ on the screen;
    /// its third component is the rate of change with depth.
    fn from_triangle([a, b, c]: [DVec3; 3], screen_to_world: &DMat4) -> Self {
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let offset = normal.dot(a);
        let along_depth = screen_to_world.z_axis.dot(normal.extend(-offset));
        let sign = along_depth.signum();
        Self { normal: normal * sign, offset: offset * sign }
    }
}

impl ZBufferImage {
    /// Rasterizes the welded surface of a subject.
    fn rasterize_subject(subject: &Subject<'_>) -> Result<Self, DrawError> {
        let [width, height] = subject.size;
        let drawing_projector = Projector::new(&subject.view_projection, &subject.viewport()?);
        let finer = (MAX_Z_BUFFER_SIDE / width.max(height)).clamp(1, SUPERSAMPLING);
        let (width, height) = (width * finer, height * finer);
        let projector = Projector::new(
            &subject.view_projection,
            &Viewport::image_for(width, height, ClipRange::CHAPTER)?,
        );
        let to_world = drawing_projector.world_to_screen().inverse();
        let surface = WeldedSurface::new(subject.models, subject.sections, subject.uncut);
        let mut planes = Vec::new();
        let triangles = surface.occluder_triangles().map(|triangle| {
            let vertices = triangle.map(Point::raw);
            planes.push(FacePlane::from_triangle(vertices, &to_world));
            vertices
        });
        let ids = rasterize_faces(triangles, &projector, [width, height])?;
        Ok(Self {
            width: width.into(),
            height: height.into(),
            scale: f64::from(finer),
            ids,
            planes,
            owners: surface.shells_and_materials(),
            to_world,
            touching: surface.touch_tolerance().world,
        })
    }

    /// Whether something visible near a point is not in front of it.
    fn shows_point(&self, point: DVec2, depth: f64) -> bool {
        let at = self.unproject_point(point, depth);
        self.face_ids_near(point, SEARCH_RADIUS)
            .any(|id| id.is_none_or(|id| !self.is_face_in_front(id, at)))
    }

    /// Whether something visible near a point is in front of it.
    fn hides_point(&self, point: DVec2, depth: f64) -> bool {
        let at = self.unproject_point(point, depth);
        self.face_ids_near(point, SEARCH_RADIUS)
            .any(|id| id.is_some_and(|id| self.is_face_in_front(id, at)))
    }

    /// Maps a point of the drawing, with its depth, to world space.
    fn unproject_point(&self, point: DVec2, depth: f64) -> DVec3 {
        let at = self.to_world * point.extend(depth).extend(1.0);
        at.truncate() / at.w
    }

    /// Whether the plane of a face is in front of a point, by more than a touching distance.
    fn is_face_in_front(&self, id: u32, at: DVec3) -> bool {
        let FacePlane { normal, offset } = self.planes[id as usize];
        normal.dot(at) - offset < -self.touching
    }

    /// Whether everything visible near a point is one flat face, or several in one plane with the
    /// same shell and material.
    fn is_flat_near(&self, point: DVec2, depth: f64) -> bool {
        let mut ids = self.face_ids_near(point, REASON_RADIUS);
        let Some(Some(first)) = ids.next() else { return false };
        let at = self.unproject_point(point, depth);
        let mut last = first;
        ids.all(|id| {
            let Some(id) = id else { return false };
            // Most neighbors show the same face.
            let is_alike = id == last || id == first || self.are_coplanar(id, first, at);
            last = id;
            is_alike
        })
    }

    /// Whether two faces have the same shell and material, and the same plane near a point.
    fn are_coplanar(&self, one: u32, other: u32, at: DVec3) -> bool {
        let [a, b] = [one, other].map(|id| self.planes[id as usize]);
        let [from_a, from_b] = [a, b].map(|plane| plane.normal.dot(at) - plane.offset);
        self.owners[one as usize] == self.owners[other as usize]
            && a.normal.dot(b.normal) > PARALLEL_COSINE
            && (from_a - from_b).abs() <= self.touching
    }

    /// Returns the ids of the pixels within a radius of a point of the drawing, both in drawing
    /// pixels, or `None` for pixels without a face.
    fn face_ids_near(&self, point: DVec2, radius: f64) -> impl Iterator<Item = Option<u32>> {
        let at = point * self.scale;
        let radius = radius * self.scale;
        let (left, right) = ((at.x - radius).floor() as i64, (at.x + radius).floor() as i64);
        let (top, bottom) = ((at.y - radius).floor() as i64, (at.y + radius).floor() as i64);
        let pixels = (top..=bottom).flat_map(move |y| (left..=right).map(move |x| (x, y)));
        pixels.filter_map(move |(x, y)| {
            let center = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
            let is_near = (center - at).length() <= radius + std::f64::consts::FRAC_1_SQRT_2;
            let is_inside = (0..self.width).contains(&x) && (0..self.height).contains(&y);
            let id = || self.ids[(y * self.width + x) as usize];
            (is_near && is_inside).then(id)
        })
    }
}
