//! Picks points, edges, faces and circles by position and by name.

use super::super::Origin;
use super::super::named_nodes::{node_names, objects_below};
use glam::DVec3;
use hidden_line::{FeaturePicker, PickedFeature, WorldCircle};
use homog::{Bounds, Point, World};
use model::ModelInstance;
use scene_file::PathStep::{self, Field};
use scene_file::file::{PickFile, PlaceFile};
use scene_file::{SceneError, suggest_name};

/// Faces that meet at more than this angle, in radians, have a pickable edge.
const CREASE_ANGLE: f64 = core::f64::consts::FRAC_PI_6;

/// Directions are parallel if the sine of the angle between them is at most this.
const PARALLEL_SINE: f64 = 1e-4;

/// The fraction of the models' diagonal within which a position means a circle, however small it is.
const NEAR_FRACTION: f64 = 0.05;

/// A part of the models at which a dimension begins or ends.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum Picked {
    /// A point.
    Point(DVec3),
    /// An edge, which represents its line.
    Edge(PickedFeature),
    /// A face, which represents its plane.
    Face(PickedFeature),
}

impl Picked {
    /// Returns the part as a point.
    pub(super) fn point(&self) -> DVec3 {
        match self {
            Self::Point(point) => *point,
            Self::Edge(feature) | Self::Face(feature) => feature.point.raw(),
        }
    }

    /// Returns the name of the part in messages.
    pub(super) const fn noun(&self) -> &'static str {
        match self {
            Self::Point(_) => "the point",
            Self::Edge(_) => "the edge",
            Self::Face(_) => "the face",
        }
    }

    /// Returns the nearest points of this part and another, on the line or plane that each
    /// represents, or `None` if edges or faces are not parallel.
    pub(super) fn perpendicular_to(&self, other: &Self) -> Option<[DVec3; 2]> {
        let (a, b) = (self.point(), other.point());
        let direction = |feature: &PickedFeature| feature.direction.raw();
        let on_line = |line: &PickedFeature, from: DVec3, point: DVec3| {
            point + direction(line) * (from - point).dot(direction(line))
        };
        let on_plane = |plane: &PickedFeature, from: DVec3, point: DVec3| {
            from + direction(plane) * (point - from).dot(direction(plane))
        };
        let is_along = |one: &PickedFeature, two: &PickedFeature| {
            direction(one).cross(direction(two)).length() <= PARALLEL_SINE
        };
        let is_across = |one: &PickedFeature, two: &PickedFeature| {
            direction(one).dot(direction(two)).abs() <= PARALLEL_SINE
        };
        match (self, other) {
            (Self::Point(_), Self::Point(_)) => Some([a, b]),
            (Self::Point(_), Self::Edge(line)) => Some([a, on_line(line, a, b)]),
            (Self::Edge(line), Self::Point(_)) => Some([on_line(line, b, a), b]),
            (Self::Point(_), Self::Face(plane)) => Some([a, on_plane(plane, a, b)]),
            (Self::Face(plane), Self::Point(_)) => Some([on_plane(plane, b, a), b]),
            // Only parallel edges and faces have the same distance everywhere.
            (Self::Edge(one), Self::Edge(line)) => {
                is_along(one, line).then(|| [a, on_line(line, a, b)])
            }
            (Self::Face(one), Self::Face(plane)) => {
                is_along(one, plane).then(|| [a, on_plane(plane, a, b)])
            }
            (Self::Edge(line), Self::Face(plane)) => {
                is_across(line, plane).then(|| [a, on_plane(plane, a, b)])
            }
            (Self::Face(plane), Self::Edge(line)) => {
                is_across(line, plane).then(|| [on_plane(plane, b, a), b])
            }
        }
    }
}

/// The models in which parts are picked.
pub(super) struct Picking<'a> {
    pub(super) origin: &'a Origin,
    models: &'a [ModelInstance],
    pub(super) picker: FeaturePicker<'a>,
}

impl<'a> Picking<'a> {
    /// Sets up picking in these models.
    pub(super) fn new(origin: &'a Origin, models: &'a [ModelInstance]) -> Self {
        Self { origin, models, picker: FeaturePicker::new(models, CREASE_ANGLE) }
    }

    /// Picks a part; errors point at the end of `path`.
    pub(super) fn pick(
        &self,
        pick: &PickFile,
        path: &[PathStep<'_>],
    ) -> Result<Picked, SceneError> {
        Ok(match pick {
            PickFile::Point(point) => Picked::Point(point.0.into()),
            PickFile::Fraction(fraction) => {
                Picked::Point(point_of_box(self.bounds(None, path)?, fraction.0))
            }
            PickFile::Node { name, number, fraction } => {
                let objects = self.objects(name, *number, path, "name")?;
                Picked::Point(point_of_box(self.bounds(Some(&objects), path)?, fraction.0))
            }
            PickFile::Vertex(place) => {
                let (near, objects) = self.place(place, path)?;
                let vertex = self.picker.nearest_vertex(near, objects.as_deref());
                Picked::Point(self.found(vertex, "vertex", path)?.raw())
            }
            PickFile::Edge(place) => {
                let (near, objects) = self.place(place, path)?;
                let edge = self.picker.nearest_edge(near, objects.as_deref());
                Picked::Edge(self.found(edge, "edge", path)?)
            }
            // A length to a circle is measured to its center.
            PickFile::Circle(place) => Picked::Point(self.circle(place, path)?.center.raw()),
            PickFile::Face(place) => {
                let (near, objects) = self.place(place, path)?;
                let face = self.picker.nearest_face(near, objects.as_deref());
                Picked::Face(self.found(face, "face", path)?)
            }
        })
    }

    /// Finds the circle at a position.
    pub(super) fn circle(
        &self,
        place: &PlaceFile,
        path: &[PathStep<'_>],
    ) -> Result<WorldCircle, SceneError> {
        let (near, objects) = self.place(place, path)?;
        let objects = objects.as_deref();
        let circle = self.found(self.picker.nearest_circle(near, objects), "circle", path)?;
        // Only a given position can be wrong; the middle of a node may be far from its circles.
        if place.near.is_some() && !self.is_within_reach(&circle, near) {
            let [x, y, z] = near.raw().to_array();
            let message = format!("there is no circle near ({x}, {y}, {z})");
            return Err(self.origin.error_at(
                path,
                message,
                Some(self.advise(&circle, near, objects)),
            ));
        }
        Ok(circle)
    }

    /// Whether a position is near enough to a circle to mean it: within its radius, or a twentieth
    /// of the models' diagonal.
    fn is_within_reach(&self, circle: &WorldCircle, near: Point<World>) -> bool {
        let diagonal = self.picker.bounds(None).map_or(0.0, Bounds::diagonal);
        circle.distance_to(near) <= circle.radius.max(NEAR_FRACTION * diagonal)
    }

    /// Names the nearest circle, and the position with y and z exchanged if that is near a circle.
    fn advise(&self, nearest: &WorldCircle, near: Point<World>, objects: Option<&[u32]>) -> String {
        let name = |circle: &WorldCircle| {
            let [x, y, z] = circle.center.raw().to_array().map(rounded);
            let (radius, distance) = (rounded(circle.radius), rounded(circle.distance_to(near)));
            (format!("center ({x}, {y}, {z}), radius {radius}"), distance)
        };
        let [x, y, z] = near.raw().to_array();
        let exchanged = [[x, z, -y], [x, -z, y]].into_iter().find_map(|[x, y, z]| {
            let point = Point::new(x, y + 0.0, z + 0.0);
            let circle = self.picker.nearest_circle(point, objects)?;
            self.is_within_reach(&circle, point).then_some((point, circle))
        });
        if let Some((point, circle)) = exchanged {
            let [x, y, z] = point.raw().to_array();
            let (circle, _) = name(&circle);
            return format!("y points up here: ({x}, {y}, {z}) is near a circle with {circle}");
        }
        let (circle, distance) = name(nearest);
        format!("the nearest circle has {circle}, at a distance of {distance}")
    }

    /// Returns the part that was found, or an error if there is none.
    fn found<T>(
        &self,
        found: Option<T>,
        noun: &str,
        path: &[PathStep<'_>],
    ) -> Result<T, SceneError> {
        found.ok_or_else(|| {
            let help = match noun {
                "circle" => "a circle needs at least eight equal edges",
                _ => "there is nothing of this kind to pick",
            };
            self.origin.error_at(path, format!("there is no {noun} here"), Some(help.to_owned()))
        })
    }

    /// Returns the point that a position specifies, and the objects to pick from; `None` means all.
    fn place(
        &self,
        place: &PlaceFile,
        path: &[PathStep<'_>],
    ) -> Result<(Point<World>, Option<Vec<u32>>), SceneError> {
        let node = place.node.as_ref();
        let objects =
            node.map(|name| self.objects(name, place.number, path, "node")).transpose()?;
        let point = match (place.near, place.fraction) {
            (Some(_), Some(_)) => {
                let help = "set `near` in world space or `fraction` of a box, not both".to_owned();
                let message = "`near` and `fraction` both set the point";
                return Err(self.origin.error_at(path, message, Some(help)));
            }
            (Some(near), None) => near.0.into(),
            (None, fraction) => {
                let fraction = fraction.map_or([0.5; 3], |fraction| fraction.0);
                point_of_box(self.bounds(objects.as_deref(), path)?, fraction)
            }
        };
        Ok((Point::from_raw(point), objects))
    }

    /// Returns the box around objects.
    fn bounds(
        &self,
        objects: Option<&[u32]>,
        path: &[PathStep<'_>],
    ) -> Result<Bounds<World>, SceneError> {
        let nothing = || self.origin.error_at(path, "there is nothing to measure here", None);
        self.picker.bounds(objects).ok_or_else(nothing)
    }

    /// Returns the objects below the named node; `field` inside `path` contains the name.
    fn objects(
        &self,
        name: &str,
        number: usize,
        path: &[PathStep<'_>],
        field: &str,
    ) -> Result<Vec<u32>, SceneError> {
        let mut nodes = objects_below(self.models, |own| own == name);
        let count = nodes.len();
        let error = |field, message: String, help| {
            let path: Vec<PathStep<'_>> = path.iter().copied().chain([Field(field)]).collect();
            self.origin.error_at(&path, message, help)
        };
        if count == 0 {
            let help = suggest_name(name, &node_names(self.models));
            return Err(error(field, format!("there is no node `{name}`"), help));
        }
        if number >= count {
            let message = format!("there is no node `{name}` with number {number}");
            let help = format!("numbers start at 0; the highest is {}", count - 1);
            return Err(error("number", message, Some(help)));
        }
        Ok(nodes.swap_remove(number))
    }
}

/// Rounds a number in a message to three decimal places, without a negative zero.
fn rounded(number: f64) -> f64 {
    libm::round(number * 1e3) / 1e3 + 0.0
}

/// Returns a point in a box, where 0 is the corner with the smallest coordinates and 1 the opposite
/// corner.
fn point_of_box(bounds: Bounds<World>, fraction: [f64; 3]) -> DVec3 {
    bounds.min().raw() + bounds.size().raw() * DVec3::from(fraction)
}
