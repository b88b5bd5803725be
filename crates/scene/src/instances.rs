//! Instances of a model: grids, circles and lists of transforms.
//!
//! ```text
//!   model ─scale, rotate─► ─transform of the instance─► ─translate─► world
//! ```

use super::Origin;
use homog::{Affine, Model as ModelSpace, Vector, World};
use model::Model;
use model::ModelInstance;
use scene_file::PathStep::{self, Field, Index};
use scene_file::SceneError;
use scene_file::file::{Finite, InstanceFile, InstancesFile, ModelFile, Scale, SceneFile, Triple};
use std::sync::Arc;

/// The maximum number of instances of all models in a scene.
pub(super) const MAX_INSTANCES: usize = 100_000;
/// The maximum number of vertices in all instances of one model. Framing keeps their world
/// positions, 24 bytes each: 800 MB at this limit.
const MAX_INSTANCE_VERTICES: usize = 1 << 25;

/// The transform of an instance within its model's space.
type InstanceTransform = Affine<ModelSpace, ModelSpace>;

/// Checks the number of instances before anything is loaded. Products saturate, so that counts of 4
/// billion along each axis do not wrap around to a small number.
///
/// # Errors
/// Returns an error if a model has no instances, or the scene has more than [`MAX_INSTANCES`].
pub(super) fn check_instance_counts(origin: &Origin, file: &SceneFile) -> Result<(), SceneError> {
    let mut total = 0_usize;
    for (number, entry) in file.models.iter().enumerate() {
        let count = checked_instance_count(origin, number, entry)?;
        total = total.saturating_add(count);
        if total > MAX_INSTANCES {
            let message =
                format!("too many model instances: {total}; at most {MAX_INSTANCES} are allowed");
            let help = Some("use fewer instances, or combine several models into one".to_owned());
            return Err(origin.error_at(&instances_path(number, &[]), message, help));
        }
    }
    Ok(())
}

/// Returns the path of a model's `instances`, or of a value in them.
fn instances_path<'a>(number: usize, rest: &[PathStep<'a>]) -> Vec<PathStep<'a>> {
    [&[Field("models"), Index(number), Field("instances")], rest].concat()
}

/// Counts a model's instances.
///
/// # Errors
/// Returns an error if the model has no instances.
fn checked_instance_count(
    origin: &Origin,
    number: usize,
    entry: &ModelFile,
) -> Result<usize, SceneError> {
    let copies = entry.instance_count();
    if copies > 0 {
        return Ok(copies);
    }
    let field = Field("count");
    let at = match &entry.instances {
        Some(InstancesFile::List(_)) | None => instances_path(number, &[]),
        Some(_) => instances_path(number, &[field]),
    };
    let help = Some("use at least 1; for a single instance, remove `instances`".to_owned());
    Err(origin.error_at(&at, "the model has no instances", help))
}

/// Places the instances of a model, which all share its data.
///
/// model_to_world = T · I · R · S: first the model's scale and rotation, then the transform of the
/// instance, then the model's translation.
///
/// # Errors
/// Returns an error if the instances have too many vertices in total, or the axis of a circle is
/// (0, 0, 0).
pub(super) fn instantiate_model(
    origin: &Origin,
    number: usize,
    entry: &ModelFile,
    model: &Arc<Model>,
) -> Result<Vec<ModelInstance>, SceneError> {
    let own = scale_then_rotate(entry.scale, entry.rotation_degrees);
    let there = Affine::<ModelSpace, World>::translation(Vector::from(entry.translation.0));
    let Some(instances) = &entry.instances else {
        return Ok(vec![ModelInstance {
            model: Arc::clone(model),
            model_to_world: own.then(there),
        }]);
    };
    let mut vertices = 0_usize;
    model.for_each_scene_point(|_| vertices += 1);
    let all = vertices.saturating_mul(entry.instance_count());
    if all > MAX_INSTANCE_VERTICES {
        let message = format!(
            "too many instance vertices: {all}; at most {MAX_INSTANCE_VERTICES} are allowed"
        );
        let help = Some("use fewer instances or a simpler model".to_owned());
        return Err(origin.error_at(&instances_path(number, &[]), message, help));
    }
    let ways = instance_transforms(origin, number, instances)?;
    let copy = |way: InstanceTransform| ModelInstance {
        model: Arc::clone(model),
        model_to_world: own.then(way).then(there),
    };
    Ok(ways.into_iter().map(copy).collect())
}

/// Returns a scale followed by rotations about the fixed axes x, y and z, in this order: R_z · R_y
/// · R_x · S.
fn scale_then_rotate(scale: Scale, rotation_degrees: Triple) -> InstanceTransform {
    let [sx, sy, sz] = scale.0;
    let [rx, ry, rz] = rotation_degrees.0.map(f64::to_radians);
    InstanceTransform::scale(sx, sy, sz)
        .then(InstanceTransform::rotation_x(rx))
        .then(InstanceTransform::rotation_y(ry))
        .then(InstanceTransform::rotation_z(rz))
}

/// Returns a translation.
fn translate_by(by: [f64; 3]) -> InstanceTransform {
    InstanceTransform::translation(Vector::from(by))
}

/// Returns the transform of each instance, relative to the model.
fn instance_transforms(
    origin: &Origin,
    number: usize,
    instances: &InstancesFile,
) -> Result<Vec<InstanceTransform>, SceneError> {
    match instances {
        InstancesFile::Grid { count: (across, up, deep), step } => {
            Ok(grid_transforms([*across, *up, *deep], step.0))
        }
        InstancesFile::List(list) => {
            let way = |copy: &InstanceFile| {
                scale_then_rotate(copy.scale, copy.rotation_degrees)
                    .then(translate_by(copy.translation.0))
            };
            Ok(list.iter().map(way).collect())
        }
        InstancesFile::Circle {
            count,
            radius,
            axis,
            start_degrees,
            sweep_degrees,
            rotate_copies,
        } => {
            let at = || {
                let help =
                    Some("use an axis such as (0, 1, 0), for a horizontal circle".to_owned());
                let message = "the axis of the circle must not be (0, 0, 0)";
                origin.error_at(&instances_path(number, &[Field("axis")]), message, help)
            };
            let axis = normalize_vector(axis.0).ok_or_else(at)?;
            let angles = circle_angles(*count, *start_degrees, *sweep_degrees);
            let ring = CircleLayout { axis, radius: radius.value(), rotate_copies: *rotate_copies };
            angles.map(|angle| ring.transform_at(angle).ok_or_else(at)).collect()
        }
    }
}

/// Returns the translations of a grid, x fastest, then y, then z. They are multiples of the step
/// rather than sums, so that errors do not accumulate.
fn grid_transforms([across, up, deep]: [u32; 3], step: [f64; 3]) -> Vec<InstanceTransform> {
    let mut ways = Vec::new();
    for z in 0..deep {
        for y in 0..up {
            for x in 0..across {
                let [dx, dy, dz] = step;
                ways.push(translate_by([f64::from(x) * dx, f64::from(y) * dy, f64::from(z) * dz]));
            }
        }
    }
    ways
}

/// Returns the angles of instances on a circle, in radians.
///
/// A full turn is divided by the count, since its two ends coincide. An arc is divided by the count
/// minus one, so that both ends have an instance.
fn circle_angles(count: u32, start: Finite, sweep: Finite) -> impl Iterator<Item = f64> {
    let (start, sweep) = (start.value(), sweep.value());
    let is_whole = sweep.abs() >= 360.0;
    let steps = f64::from(if is_whole { count } else { count.saturating_sub(1).max(1) });
    (0..count).map(move |at| (start + sweep * (f64::from(at) / steps)).to_radians())
}

/// Instances on a circle around an axis through the origin.
struct CircleLayout {
    /// The axis through the model's origin, a unit vector.
    axis: [f64; 3],
    /// The radius in world units.
    radius: f64,
    /// Whether instances rotate with their angle or keep the orientation of the model.
    rotate_copies: bool,
}

impl CircleLayout {
    /// Returns the transform at an angle in radians: translation to the circle, then rotation about
    /// the axis. For instances that do not rotate, it is only the translation that results from
    /// both.
    fn transform_at(&self, angle: f64) -> Option<InstanceTransform> {
        let turn = InstanceTransform::rotation(Vector::from(self.axis), angle)?;
        let out = self.zero_degree_direction()?.map(|c| c * self.radius);
        if self.rotate_copies {
            return Some(translate_by(out).then(turn));
        }
        let there = turn.transform_vector(Vector::from(out)).raw();
        Some(translate_by(there.to_array()))
    }

    /// Returns the unit vector toward 0°, perpendicular to the axis.
    ///
    /// It is the projection of x onto the plane of the circle (Gram–Schmidt), or of y if the axis
    /// is within 26° of x, where the projection of x would be short.
    fn zero_degree_direction(&self) -> Option<[f64; 3]> {
        let [x, y, z] = self.axis;
        let candidates = [([1.0, 0.0, 0.0], x), ([0.0, 1.0, 0.0], y), ([0.0, 0.0, 1.0], z)];
        let (from, along) = candidates.into_iter().find(|(_, along)| along.abs() < 0.9)?;
        normalize_vector([from[0] - along * x, from[1] - along * y, from[2] - along * z])
    }
}

/// Returns the vector scaled to length 1, or `None` if it is 0.
fn normalize_vector(v: [f64; 3]) -> Option<[f64; 3]> {
    // Scale first, so that no square overflows or underflows.
    let largest = v.iter().fold(0.0_f64, |most, c| most.max(c.abs()));
    let v = v.map(|c| c / largest);
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    (largest > 0.0 && length > 0.0).then(|| v.map(|c| c / length))
}

#[cfg(test)]
mod tests {
    use super::*;
    use homog::Point;
    use scene_file::parse_scene;

    /// Returns the positions of the model's point (0, 0, 1) in the instances.
    fn instance_points(model: &str) -> Result<Vec<[f64; 3]>, String> {
        let text = format!("Scene(models: [(path: \"a.glb\", {model})])");
        let file = parse_scene("a.ron", &text).map_err(|error| error.to_string())?;
        let origin = Origin::from_text("a.ron", text, std::path::PathBuf::new());
        check_instance_counts(&origin, &file).map_err(|error| error.to_string())?;
        let model = Arc::new(Model::default());
        let placed = instantiate_model(&origin, 0, &file.models[0], &model)
            .map_err(|error| error.to_string())?;
        assert_eq!(placed.len(), file.models[0].instance_count());
        let there = |placed: &ModelInstance| {
            let point = placed.model_to_world.transform_point(Point::new(0.0, 0.0, 1.0)).raw();
            point.to_array().map(|c| libm::round(c * 1e9) / 1e9 + 0.0)
        };
        Ok(placed.iter().map(there).collect())
    }

    #[test]
    fn grids_start_at_the_model_and_advance_along_x_first() {
        let places = instance_points(
            "translation: (10, 0, 0), scale: 2, instances: Grid(count: (2, 1, 2), step: (3, 0, -5))",
        );
        let expected = [[10.0, 0.0, 2.0], [13.0, 0.0, 2.0], [10.0, 0.0, -3.0], [13.0, 0.0, -3.0]];
        assert_eq!(places.expect("places"), expected);
    }

    #[test]
    fn instances_on_a_circle_rotate_with_their_position_unless_disabled() {
        // Counterclockwise from above, x maps to -z, and the instance's front rotates with it.
        let turned = instance_points("instances: Circle(count: 4, radius: 2)").expect("places");
        assert_eq!(
            turned,
            [[2.0, 0.0, 1.0], [1.0, 0.0, -2.0], [-2.0, 0.0, -1.0], [-1.0, 0.0, 2.0]]
        );
        let still = instance_points(
            "translation: (0, 1, 0), instances: Circle(count: 2, radius: 2, rotate_copies: false)",
        );
        assert_eq!(still.expect("places"), [[2.0, 1.0, 1.0], [-2.0, 1.0, 1.0]]);
        let arc = "instances: Circle(count: 3, radius: 1, axis: (0, 0, 5), sweep_degrees: 180, start_degrees: 90)";
        let arc = instance_points(arc).expect("places");
        assert_eq!(arc, [[0.0, 1.0, 1.0], [-1.0, 0.0, 1.0], [0.0, -1.0, 1.0]]);
    }

    #[test]
    fn listed_instances_are_scaled_then_rotated_then_moved() {
        let list = "instances: List([(scale: 3, rotation_degrees: (0, 90, 0), translation: (0, 0, 1)), ()])";
        assert_eq!(instance_points(list).expect("places"), [[3.0, 0.0, 1.0], [0.0, 0.0, 1.0]]);
    }

    #[test]
    fn mistakes_are_reported_at_their_position() {
        for (model, told, mark) in [
            ("instances: Grid(count: (2, 0, 2), step: (1, 1, 1))", "no instances", "(2, 0, 2)"),
            ("instances: Circle(count: 0, radius: 1)", "no instances", "0"),
            ("instances: List([])", "no instances", "List([])"),
            (
                "instances: Circle(count: 3, radius: 1, axis: (0, 0, 0))",
                "must not be (0, 0, 0)",
                "(0, 0, 0)",
            ),
            (
                "instances: Grid(count: (4294967295, 4294967295, 4294967295), step: (1, 1, 1))",
                "at most 100000",
                "Grid(count: (4294967295, 4294967295, 4294967295), step: (1, 1, 1))",
            ),
        ] {
            let error = instance_points(model).expect_err(model);
            assert!(error.contains(told), "{error}");
            let underlined = "^".repeat(mark.len());
            assert!(
                error.lines().any(|line| line.trim_end().ends_with(&format!(" {underlined}"))),
                "{error}"
            );
        }
    }
}
