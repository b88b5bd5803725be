//! Camera paths: camera keyframes, interpolated with Catmull–Rom splines.
//!
//! ```text
//!  keys (tᵢ, vᵢ) ─► v(t), ten numbers: eye, target, up, field of view ─► LookAt + projection
//! ```
//! Each number is interpolated separately. The eye and the target move along splines and determine
//! the orientation, so the target stays in the center of the picture between keys too. A path whose
//! last key repeats the values of its first is closed: its spline is periodic and is smooth at that
//! key too.

use super::view_projection::resolve_view_projection;
use super::{ImageSpec, Origin, Scene};
use camera::ViewProjection;
use model::ModelInstance;
use scene_file::PathStep::{self, Field, Index};
use scene_file::SceneError;
use scene_file::file::{
    CameraFile, CameraKeyFile, CurveFile, FieldOfView, ProjectionFile, SceneFile, Triple, ViewFile,
};

/// The maximum number of keyframes in a path.
const MAX_KEYS: usize = 10_000;
/// The values of a keyframe: eye, target and view-up vector in world space (three each), and the
/// vertical field of view in degrees.
type KeyValues = [f64; 10];

/// The path of a camera over time.
#[derive(Clone, PartialEq, Debug)]
pub struct CameraPath {
    /// The keyframes, at least two: strictly increasing times in seconds, with the values at each.
    keys: Vec<(f64, KeyValues)>,
    /// The interpolation: linear, or Catmull–Rom.
    curve: CurveFile,
    /// The camera of the scene, whose projection the path uses.
    camera: CameraFile,
}

impl CameraPath {
    /// Resolves the camera path of a scene file; returns `None` without one.
    ///
    /// # Errors
    /// Returns an error if there are fewer than 2 or more than 10,000 keys, if their times do not
    /// increase, or if a key has a field of view but the projection has none. The error points at
    /// the cause.
    pub fn from_scene_file(origin: &Origin, file: &SceneFile) -> Result<Option<Self>, SceneError> {
        let Some(path) = &file.camera_path else { return Ok(None) };
        let fault = |rest: &[PathStep<'_>], message: String, help: &str| {
            let at = [&[Field("camera_path"), Field("keys")], rest].concat();
            origin.error_at(&at, message, Some(help.to_owned()))
        };
        if !(2..=MAX_KEYS).contains(&path.keys.len()) {
            let message = format!("invalid number of camera path keys: {}", path.keys.len());
            return Err(fault(&[], message, "use 2 to 10,000 keys"));
        }
        for (at, pair) in (1..).zip(path.keys.windows(2)) {
            let [before, after] = [pair[0].time.value(), pair[1].time.value()];
            if before >= after {
                let message = format!("key times must increase, but {after} s follows {before} s");
                return Err(fault(&[Index(at), Field("time")], message, "sort the keys by time"));
            }
        }
        // A scene without a projection gets the default perspective, whose angle a path may
        // animate.
        let usual = match &file.camera.projection {
            None => Some(FieldOfView::DEFAULT),
            Some(projection) => vertical_field_of_view(projection),
        };
        let angled = path.keys.iter().position(|key| key.fov_y_degrees.is_some());
        if let (None, Some(at)) = (usual, angled) {
            let message = "the scene's projection has no vertical field of view".to_owned();
            let help = "remove fov_y_degrees from the keys, or choose projection: Perspective()";
            return Err(fault(&[Index(at), Field("fov_y_degrees")], message, help));
        }
        // Without an angle this value is unused, because the check above rejects keys that set one.
        let usual = usual.unwrap_or_default();
        let keys = path.keys.iter().map(|key| (key.time.value(), key_values(key, usual))).collect();
        Ok(Some(Self { keys, curve: path.curve, camera: file.camera.clone() }))
    }

    /// Returns the times of the first and last keys, in seconds.
    #[must_use]
    pub fn time_range(&self) -> [f64; 2] {
        let time = |key: Option<&(f64, KeyValues)>| key.map_or(0.0, |key| key.0);
        [time(self.keys.first()), time(self.keys.last())]
    }

    /// Returns the camera at a time in seconds; outside the range, at the first or last keyframe.
    ///
    /// A cubic curve can overshoot its keys, so the field of view is clamped to 0.01° … 179°.
    #[must_use]
    pub fn camera_at(&self, time: f64) -> CameraFile {
        let numbers = self.interpolate_keys(time);
        let triple = |at: usize| Triple([numbers[at], numbers[at + 1], numbers[at + 2]]);
        let view = ViewFile::LookAt { eye: triple(0), target: triple(3), up: triple(6) };
        let mut camera = CameraFile { view, ..self.camera.clone() };
        let projection = camera.projection.get_or_insert(ProjectionFile::PERSPECTIVE);
        let is_vertical = vertical_field_of_view(projection).is_some();
        if let ProjectionFile::Perspective { fov_y_degrees, .. } = projection
            && is_vertical
        {
            // A curve may overshoot its keys.
            *fov_y_degrees = FieldOfView::new(numbers[9].clamp(0.01, 179.0));
        }
        camera
    }

    /// Returns the view-projection at a time in seconds, for models that are loaded and posed.
    ///
    /// # Errors
    /// Returns an error if the eye and the target coincide, or up is parallel to the gaze, for
    /// example between keys; the message gives the time.
    pub fn view_projection_at(
        &self,
        origin: &Origin,
        time: f64,
        models: &[ModelInstance],
        image: ImageSpec,
    ) -> Result<ViewProjection, SceneError> {
        resolve_view_projection(origin, &self.camera_at(time), models, image).map_err(|error| {
            let message = format!("at {:.3} s on the camera path: {}", time, error.message);
            origin.error_at(&[Field("camera_path"), Field("keys")], message, error.help)
        })
    }

    /// Moves the camera of a scene to its position at a time in seconds. Lights and insets do not
    /// move.
    ///
    /// # Errors
    /// Returns an error if the eye and the target coincide there, or up is parallel to the gaze.
    pub fn place_camera(
        &self,
        origin: &Origin,
        time: f64,
        scene: &mut Scene,
    ) -> Result<(), SceneError> {
        let view_projection = self.view_projection_at(origin, time, &scene.models, scene.image)?;
        scene.view_projection = view_projection;
        Ok(())
    }

    /// Computes the values at a time. Outside the keyframes, they are the values of the first or
    /// last keyframe. Between keyframes they are interpolated, linearly or with a cubic Hermite
    /// curve with Catmull–Rom slopes.
    ///
    /// s = (t − tᵢ)/(tᵢ₊₁ − tᵢ), and slopes per second are scaled by the length of the interval.
    /// Binary search finds the interval, in O(log keys).
    fn interpolate_keys(&self, time: f64) -> KeyValues {
        let after = self.keys.partition_point(|key| key.0 <= time);
        let (Some(before), Some(&(end, to))) = (after.checked_sub(1), self.keys.get(after)) else {
            let nearest = if after == 0 { self.keys.first() } else { self.keys.last() };
            return nearest.map_or([0.0; 10], |key| key.1);
        };
        let (start, from) = self.keys[before];
        let part = (time - start) / (end - start);
        std::array::from_fn(|k| match self.curve {
            CurveFile::Linear => from[k] + (to[k] - from[k]) * part,
            CurveFile::Smooth => {
                let slopes =
                    [before, after].map(|at| self.catmull_rom_slope(at, k) * (end - start));
                interpolate_hermite([from[k], to[k]], slopes, part)
            }
        })
    }

    /// Computes the slope of a value at a key, per second (Catmull and Rom, 1974, at unequal
    /// times).
    ///
    /// mᵢ = (vᵢ₊₁ − vᵢ₋₁)/(tᵢ₊₁ − tᵢ₋₁). The first and last keys use the one-sided difference in an
    /// open path, and the difference across the seam in a closed one. Equal slopes on both sides of
    /// a key make the motion C¹: its velocity does not jump.
    fn catmull_rom_slope(&self, at: usize, number: usize) -> f64 {
        let last = self.keys.len() - 1;
        if (at == 0 || at == last) && self.is_closed() {
            let [(first_time, _), (start, from)] = [self.keys[0], self.keys[last - 1]];
            let [(end, to), (last_time, _)] = [self.keys[1], self.keys[last]];
            let seconds = (last_time - start) + (end - first_time);
            return (to[number] - from[number]) / seconds;
        }
        let (start, from) = self.keys[at.saturating_sub(1)];
        let (end, to) = self.keys[(at + 1).min(last)];
        (to[number] - from[number]) / (end - start)
    }

    /// Whether the last key repeats the values of the first.
    fn is_closed(&self) -> bool {
        let values = |key: Option<&(f64, KeyValues)>| key.map(|key| key.1);
        values(self.keys.first()) == values(self.keys.last())
    }
}

/// Returns the vertical field of view of `Perspective`, or `None` if another angle is set.
fn vertical_field_of_view(projection: &ProjectionFile) -> Option<FieldOfView> {
    match projection {
        ProjectionFile::Perspective {
            fov_y_degrees,
            fov_x_degrees: None,
            fov_diagonal_degrees: None,
            ..
        } => Some(fov_y_degrees.unwrap_or_default()),
        _ => None,
    }
}

/// Returns the values of a keyframe; `usual` is the field of view for keyframes without one.
fn key_values(key: &CameraKeyFile, usual: FieldOfView) -> KeyValues {
    let [[a, b, c], [d, e, f], [g, h, i]] = [key.eye.0, key.target.0, key.up.0];
    [a, b, c, d, e, f, g, h, i, key.fov_y_degrees.unwrap_or(usual).value()]
}

/// Evaluates the cubic Hermite polynomial with these values and slopes at 0 and 1, in Horner form.
///
/// p(t) = p₀ + t (m₀ + t (3Δ − 2m₀ − m₁ + t (m₀ + m₁ − 2Δ))) with Δ = p₁ − p₀.
fn interpolate_hermite([from, to]: [f64; 2], [out, into]: [f64; 2], t: f64) -> f64 {
    let change = to - from;
    let bend = 3.0 * change - 2.0 * out - into;
    let twist = out + into - 2.0 * change;
    from + t * (out + t * (bend + t * twist))
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene_file::parse_scene;

    fn path(fields: &str) -> Result<CameraPath, String> {
        let text = format!("Scene(models: [(path: \"a.glb\")], camera_path: ({fields}))");
        let file = parse_scene("a.ron", &text).map_err(|error| error.to_string())?;
        let origin = Origin::from_text("a.ron", text, std::path::PathBuf::new());
        let path =
            CameraPath::from_scene_file(&origin, &file).map_err(|error| error.to_string())?;
        path.ok_or_else(|| "no path".to_owned())
    }

    fn eye(path: &CameraPath, time: f64) -> [f64; 3] {
        match path.camera_at(time).view {
            ViewFile::LookAt { eye, .. } => eye.0,
            other => panic!("{other:?}"),
        }
    }

    const KEYS: &str = "keys: [
        (time: 0, eye: (0, 0, 0), target: (0, 0, 9)),
        (time: 1, eye: (2, 0, 1), target: (0, 0, 9)),
        (time: 3, eye: (6, 0, 9), target: (0, 0, 9), fov_y_degrees: 55),
    ]";

    #[test]
    fn linear_paths_are_straight_and_stop_at_their_ends() {
        let path = path(&format!("{KEYS}, curve: Linear")).expect("a path");
        assert_eq!(path.time_range(), [0.0, 3.0]);
        for (time, expected) in [
            (-1.0, [0.0; 3]),
            (0.5, [1.0, 0.0, 0.5]),
            (2.0, [4.0, 0.0, 5.0]),
            (9.0, [6.0, 0.0, 9.0]),
        ] {
            assert_eq!(eye(&path, time), expected, "{time}");
        }
        let Some(ProjectionFile::Perspective { fov_y_degrees, .. }) =
            path.camera_at(2.0).projection
        else {
            panic!("a perspective");
        };
        assert_eq!(fov_y_degrees.map(FieldOfView::value), Some(45.0));
    }

    #[test]
    fn smooth_paths_pass_through_their_keys_without_jumps_in_speed() {
        let path = path(KEYS).expect("a path");
        for (time, expected) in [(0.0, [0.0; 3]), (1.0, [2.0, 0.0, 1.0]), (3.0, [6.0, 0.0, 9.0])] {
            assert_eq!(eye(&path, time), expected, "{time}");
        }
        // x grows by 2 per second at all keys, and therefore also between them.
        assert!((eye(&path, 2.3)[0] - 4.6).abs() < 1e-12);
        // z has the same speed just before and just after the second key: 3 per second.
        let step = 1e-6;
        let speed = |from: f64| (eye(&path, from + step)[2] - eye(&path, from)[2]) / step;
        assert!((speed(1.0 - step) - 3.0).abs() < 1e-4 && (speed(1.0) - 3.0).abs() < 1e-4);
    }

    /// Creates a circular path around the origin in the plane y = 0, with radius 1 and `count` keys
    /// one second apart, followed by the first key again.
    fn circle(count: u32) -> CameraPath {
        let key = |number: u32| {
            let angle = core::f64::consts::TAU * f64::from(number % count) / f64::from(count);
            let (sine, cosine) = libm::sincos(angle);
            format!("(time: {number}, eye: ({sine}, 0, {cosine}), target: (0, 0, 0))")
        };
        let keys: Vec<String> = (0..=count).map(key).collect();
        path(&format!("keys: [{}]", keys.join(", "))).expect("a path")
    }

    #[test]
    fn closed_paths_are_smooth_at_their_seam() {
        for count in [3, 4, 8, 12] {
            let path = circle(count);
            let distance = |time: f64| glam::DVec3::from(eye(&path, time)).length();
            // The distance of the middle of the Hermite curve with slopes along the circle. The
            // sine and cosine are of half the angle between keys.
            let (sine, cosine) = libm::sincos(core::f64::consts::PI / f64::from(count));
            let expected = cosine * (1.0 + 0.5 * sine * sine);
            for segment in 0..count {
                let middle = distance(f64::from(segment) + 0.5);
                assert!((middle - expected).abs() < 1e-9, "{count}, {segment}: {middle}");
            }
            // The velocity at the end equals the velocity at the beginning.
            let (step, end) = (1e-6, f64::from(count));
            let speed = |from: f64| {
                let [a, b] = [from, from + step].map(|time| glam::DVec3::from(eye(&path, time)));
                (b - a) / step
            };
            assert!((speed(0.0) - speed(end - step)).length() < 1e-4, "{count}");
        }
        // The errors that the reference states for circles.
        for (count, error) in [(8, 0.01), (12, 0.002)] {
            let path = circle(count);
            let radius = |step: u32| glam::DVec3::from(eye(&path, 0.01 * f64::from(step))).length();
            assert!((0..100 * count).all(|step| (radius(step) - 1.0).abs() < error), "{count}");
        }
    }

    #[test]
    fn invalid_paths_are_rejected() {
        for (fields, told) in [
            ("keys: []", "camera path keys: 0"),
            (
                "keys: [(time: 0, eye: (0, 0, 0), target: (0, 0, 9)), (time: 0, eye: (0, 0, 0), target: (0, 0, 9))]",
                "key times must increase",
            ),
        ] {
            let error = path(fields).expect_err(fields);
            assert!(error.contains(told), "{error}");
        }
    }
}
