//! Loads models and scenes from files and memory, and combines subjects.

use crate::arrays;
use crate::detached::run_detached;
use crate::failure::{Failure, Fallible};
use crate::keywords::{Keywords, not_a};
use crate::subject::Subject;
use glam::DMat4;
use homog::Affine;
use import::{ImportOptions, Limits, NameOrIndex, load, load_bytes};
use model::{Model, ModelInstance};
use pipeline::Origin;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use scene::{ResolveOptions, select_animation};
use scene_file::file::Choice;
use std::path::PathBuf;
use std::sync::Arc;

/// The source of a model: a file, or its content.
#[derive(FromPyObject)]
enum Source {
    #[pyo3(transparent)]
    Bytes(Vec<u8>),
    #[pyo3(transparent)]
    Path(PathBuf),
}

/// Options for loading and posing a model.
struct LoadRequest {
    import: ImportOptions,
    animation: Option<Choice>,
    time: Option<f64>,
}

/// Loads a model from a file, or from its bytes under the name `name`.
#[pyfunction]
pub(crate) fn load_model(
    py: Python<'_>,
    source: &Bound<'_, PyAny>,
    name: &str,
    options: &Bound<'_, PyDict>,
) -> PyResult<Subject> {
    let source: Source = source.extract()?;
    let request = load_request(&Keywords(options))?;
    run_detached(py, |_| -> Fallible<Subject> {
        let (loaded, (origin, file)) = match &source {
            Source::Bytes(bytes) => {
                let (origin, file) = Origin::from_model_bytes(name, Vec::new());
                (load_bytes(name, bytes, &request.import), (origin, file))
            }
            Source::Path(path) => (load(path, &request.import), Origin::from_model_path(path)),
        };
        let mut model = loaded?;
        if request.animation.is_some() || request.time.is_some() {
            pose_model(&mut model, request.animation.as_ref(), request.time)?;
        }
        Ok(Subject::new(origin, file, vec![place_model(model)]))
    })
}

/// Loads a scene from its file, or from text with paths relative to `folder`.
#[pyfunction]
pub(crate) fn load_scene(
    py: Python<'_>,
    path: PathBuf,
    text: Option<String>,
    options: &Bound<'_, PyDict>,
) -> PyResult<Subject> {
    let import = load_request(&Keywords(options))?.import;
    run_detached(py, move |_| -> Fallible<Subject> {
        let allowed = &import.allow_outside;
        let (origin, file) = match text {
            None => Origin::read_scene_allowing(&path, allowed)?,
            Some(text) => Origin::from_text("scene", text, path).parse_with_includes(allowed)?,
        };
        Subject::from_scene(origin, file, ResolveOptions::with_import(import))
    })
}

/// Combines several subjects, each with a pose: a 4 × 4 matrix from its world to the common world.
#[pyfunction]
pub(crate) fn compose(parts: Vec<(Bound<'_, Subject>, Bound<'_, PyAny>)>) -> PyResult<Subject> {
    let mut models = Vec::new();
    for (index, (part, pose)) in parts.iter().enumerate() {
        let name = format!("poses[{index}]");
        let pose = affine_map(&name, pose)?;
        for placed in &part.get().models {
            let model_to_world = placed.model_to_world.then(pose);
            if !model_to_world.is_finite() {
                let message = "is not finite when combined with the poses in the scene";
                return Err(Failure::argument(name, message).into());
            }
            models.push(ModelInstance { model: Arc::clone(&placed.model), model_to_world });
        }
    }
    let (origin, file) = Origin::from_model_bytes("scene", Vec::new());
    Ok(Subject::new(origin, file, models))
}

/// Combines subjects like [`compose`], with the poses in one array (N, 4, 4).
#[pyfunction]
pub(crate) fn compose_array(
    parts: Vec<Bound<'_, Subject>>,
    poses: &Bound<'_, PyAny>,
) -> PyResult<Subject> {
    let parts = parts.iter().flat_map(|part| part.get().models.clone()).collect();
    let (origin, file) = Origin::from_model_bytes("scene", Vec::new());
    with_pose_array(&Subject::new(origin, file, parts), poses)
}

/// Returns the subject with each model in another place: a pose (4, 4) in `poses` from its own
/// coordinates to the world. Nothing is loaded or prepared again.
#[pyfunction]
pub(crate) fn move_models(
    subject: &Bound<'_, Subject>,
    poses: &Bound<'_, PyAny>,
) -> PyResult<Subject> {
    with_pose_array(subject.get(), poses)
}

/// Returns the subject with the poses of an array (N, 4, 4), one for each model.
fn with_pose_array(subject: &Subject, poses: &Bound<'_, PyAny>) -> PyResult<Subject> {
    let numbers = arrays::real_array::<f64>("poses", poses, "float64")?;
    let count = subject.models.len();
    if numbers.shape != [count, 4, 4] {
        let wanted = format!("({count}, 4, 4)");
        return Err(arrays::wrong_shape("poses", &numbers.shape, &wanted).into());
    }
    let matrices = numbers.values.as_chunks::<16>().0.iter().enumerate();
    let read = |(index, entries): (usize, &[f64; 16])| {
        let map = Affine::from_raw(DMat4::from_cols_array(entries).transpose());
        let is_affine = entries[12..] == [0.0, 0.0, 0.0, 1.0];
        let map = map.filter(|map| is_affine && map.is_finite() && map.inverse().is_some());
        map.ok_or_else(|| {
            let message = "is not an invertible matrix with the last row [0, 0, 0, 1]";
            Failure::argument(format!("poses[{index}]"), message)
        })
    };
    Ok(subject.with_poses(matrices.map(read).collect::<Fallible<_>>()?))
}

/// Reads an invertible matrix whose last row is 0, 0, 0, 1.
///
/// # Errors
/// Returns an error if the matrix is not finite or not of this form.
pub(crate) fn affine_map<A: homog::Space, B: homog::Space>(
    name: &str,
    value: &Bound<'_, PyAny>,
) -> PyResult<Affine<A, B>> {
    let rows = arrays::matrix::<4, 4>(name, value)?;
    if rows[3] != [0.0, 0.0, 0.0, 1.0] {
        let message = format!("its last row is {:?}, expected [0, 0, 0, 1]", rows[3]);
        return Err(Failure::argument(name, message).into());
    }
    let raw = DMat4::from_cols_array_2d(&rows).transpose();
    let map = Affine::from_raw(raw).filter(|map| map.inverse().is_some());
    map.ok_or_else(|| Failure::argument(name, "the matrix is not invertible").into())
}

/// Places a model at the origin of the world.
pub(crate) fn place_model(model: Model) -> ModelInstance {
    let model_to_world = Affine::scale(1.0, 1.0, 1.0);
    ModelInstance { model: Arc::new(model), model_to_world }
}

/// Poses a model with an animation at a time in seconds; 0 by default.
pub(crate) fn pose_model(
    model: &mut Model,
    animation: Option<&Choice>,
    time: Option<f64>,
) -> Fallible<()> {
    let chosen = select_animation(model, animation);
    let animation = chosen
        .map_err(|(message, help)| Failure { help, ..Failure::argument("animation", message) })?;
    model.apply_animation(animation, time.unwrap_or(0.0));
    Ok(())
}

/// Reads the loading options.
fn load_request(options: &Keywords<'_, '_>) -> PyResult<LoadRequest> {
    let name_or_index = |name: &str| -> PyResult<Option<NameOrIndex>> {
        Ok(choice(options, name)?.map(scene::name_or_index))
    };
    let import = ImportOptions {
        limits: limits(options)?,
        lenient: options.flag("lenient")?,
        up: options.named("up")?,
        length_unit: options.named("unit")?,
        crease_angle: crease_angle(options)?,
        scene: name_or_index("scene")?,
        variant: name_or_index("variant")?,
        ..ImportOptions::default()
    };
    Ok(LoadRequest {
        import,
        animation: choice(options, "animation")?,
        time: options.number("time")?,
    })
}

/// Reads the crease angle in degrees.
pub(crate) fn crease_angle(options: &Keywords<'_, '_>) -> PyResult<Option<f64>> {
    let angle = options.number("crease")?;
    if let Some(angle) = angle.filter(|angle| !(0.0..=180.0).contains(angle)) {
        let message = format!("is {angle}, expected an angle from 0 to 180 degrees");
        return Err(Failure::argument("crease", message).into());
    }
    Ok(angle)
}

/// Reads a selection by name or index.
pub(crate) fn choice(options: &Keywords<'_, '_>, name: &str) -> PyResult<Option<Choice>> {
    let Some(value) = options.value(name)? else { return Ok(None) };
    if let Ok(index) = value.extract::<usize>() {
        return Ok(Some(Choice::Index(index)));
    }
    match value.extract::<String>() {
        Ok(text) => Ok(Some(Choice::Name(text))),
        Err(_) => Err(not_a(name, &value, "a name or an index").into()),
    }
}

/// Returns the importer limits: the defaults, overridden by `limits`.
pub(crate) fn limits(options: &Keywords<'_, '_>) -> PyResult<Limits> {
    let mut limits = Limits::default();
    let Some(value) = options.value("limits")? else { return Ok(limits) };
    let Ok(given) = value.cast::<PyDict>() else {
        return Err(not_a("limits", &value, "a dictionary").into());
    };
    for (key, value) in given {
        let name = key.extract::<String>();
        let name = name.map_err(|_| not_a("limits", &key, "the name of a limit"))?;
        let argument = format!("limits[{name:?}]");
        let Ok(number) = value.extract::<u64>() else {
            return Err(not_a(&argument, &value, "a whole number of at least 0").into());
        };
        let size = usize::try_from(number).unwrap_or(usize::MAX);
        match name.as_str() {
            "file_bytes" => limits.file_bytes = number,
            "total_bytes" => limits.total_bytes = number,
            "json_depth" => limits.json_depth = size.min(127),
            "json_values" => limits.json_values = size,
            "array_bytes" => limits.array_bytes = number,
            "array_growth" => limits.array_growth = number,
            "image_side" => limits.image_side = u32::try_from(number).unwrap_or(u32::MAX),
            "image_texels" => limits.image_texels = number,
            "nodes" => limits.nodes = size,
            "node_depth" => limits.node_depth = size,
            "scene_items" => limits.scene_items = number,
            _ => return Err(Failure::argument(argument, "unknown limit").into()),
        }
    }
    Ok(limits)
}
