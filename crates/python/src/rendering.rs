//! Rendering of pictures and passes to arrays, one by one or in parallel, with reused renderers.
//!
//! ```text
//!  options ─► SceneFile ─► Scene ─► Renderer ─► Picture, PassBuffers ─► arrays
//! ```

use crate::arrays::new_array;
use crate::detached::{run_briefly, run_detached};
use crate::failure::{Failure, Fallible};
use crate::keywords::{Keywords, not_a, plain_name};
use crate::legacy_lights::read_legacy_lights;
use crate::native_camera::NativeCamera;
use crate::scene_options::apply_options;
use crate::subject::Subject;
use homog::PixelRect;
use pipeline::render::passes::{PassBuffer, PassValues};
use pipeline::{CancelToken, Monitor, Picture, RenderContext, Renderer, Scene, SceneFile};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use scene_file::Pass;
use scene_file::file::{CameraFile, ViewFile};
use shade::Light;
use shade::color::{SrgbEncoder, srgb_to_linear_table};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

/// The maximum number of pixels in a picture. With four samples and all passes, such a picture
/// takes about four gigabytes.
const MAX_PIXELS: u64 = 1 << 26;
/// The maximum number of pixels of a picture that is rendered in the calling thread.
const MAX_BRIEF_PIXELS: u64 = 1 << 14;
/// The maximum number of points, lines and triangles in such a picture.
const MAX_BRIEF_ITEMS: usize = 10_000;

/// The maximum number of idle renderers.
const MAX_IDLE_RENDERERS: usize = 8;

/// Idle renderers, whose memory the next picture reuses.
static IDLE_RENDERERS: Mutex<Vec<Renderer>> = Mutex::new(Vec::new());

/// The subject and options of a picture.
pub(crate) struct RenderJob<'a> {
    subject: &'a Subject,
    /// The scene description, with the options of the call applied.
    file: SceneFile,
    /// Lights that scene files do not have, which shine together with those of the file.
    legacy_lights: Vec<Light>,
    /// Whether colors are requested.
    has_color: bool,
    passes: Vec<Pass>,
    threads: usize,
}

/// The result of a job.
struct RenderedJob {
    picture: Option<Picture>,
    passes: Vec<PassBuffer>,
    camera: NativeCamera,
    warnings: Vec<String>,
}

/// The arrays by pass name, the camera, and the warnings.
type FrameParts<'py> = (Bound<'py, PyDict>, NativeCamera, Vec<String>);

/// Renders a picture and the passes of a subject.
#[pyfunction]
pub(crate) fn render<'py>(
    py: Python<'py>,
    subject: &Bound<'py, Subject>,
    options: &Bound<'py, PyDict>,
) -> PyResult<FrameParts<'py>> {
    let job = RenderJob::new(subject.get(), &Keywords(options))?;
    let rendered = if job.is_brief() {
        run_briefly(py, |cancel| RenderJob { threads: 1, ..job }.render(cancel))
    } else {
        run_detached(py, |cancel| job.render(cancel))
    };
    rendered?.into_parts(py)
}

/// Renders many pictures, each on one thread, and returns them in the order of the jobs.
///
/// The first job that fails stops the others. Errors name jobs by their index, which starts at
/// `first_job`.
#[pyfunction]
#[pyo3(signature = (jobs, threads, first_job = 0))]
pub(crate) fn render_many<'py>(
    py: Python<'py>,
    jobs: Vec<(Bound<'py, Subject>, Bound<'py, PyDict>)>,
    threads: Option<usize>,
    first_job: usize,
) -> PyResult<Vec<FrameParts<'py>>> {
    let mut read = Vec::with_capacity(jobs.len());
    for (subject, options) in &jobs {
        let job = RenderJob::new(subject.get(), &Keywords(options));
        let job = job.map_err(|error| in_job(py, error, first_job + read.len()))?;
        read.push(RenderJob { threads: 1, ..job });
    }
    let workers = thread_count(threads).min(read.len());
    let rendered = run_detached(py, |cancel| render_jobs(&read, workers, first_job, cancel))?;
    rendered.into_iter().map(|job| job.into_parts(py)).collect()
}

/// Adds the index of a job to the location of an error.
fn in_job(py: Python<'_>, error: PyErr, number: usize) -> PyErr {
    let value = error.value(py);
    if let Ok(pointer) = value.getattr("pointer").and_then(|pointer| pointer.extract::<String>()) {
        // An exception without a settable location keeps the one it has.
        let _ = value.setattr("pointer", job_pointer(number, &pointer));
    }
    error
}

/// Returns the location of an argument of a job, or of a position in its scene file.
fn job_pointer(number: usize, place: &str) -> String {
    match place {
        "" => format!("jobs[{number}]"),
        place if place.contains([' ', '/']) => format!("jobs[{number}], {place}"),
        argument => format!("jobs[{number}].{argument}"),
    }
}

/// Blends colors over white in linear light, as with a white background, and drops alpha: (…, 4)
/// becomes (…, 3).
#[pyfunction]
pub(crate) fn over_white<'py>(
    py: Python<'py>,
    rgba: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    let picture = read_picture(rgba)?;
    let (light_of, encoder) = (srgb_to_linear_table(), SrgbEncoder::shared());
    let over = |channel: u8, alpha: u8| match alpha {
        0 => 255,
        255 => channel,
        _ => {
            let alpha = f32::from(alpha) / 255.0;
            encoder.encode(light_of[usize::from(channel)] * alpha + (1.0 - alpha))
        }
    };
    let mut colors = Vec::with_capacity(3 * picture.pixels.len());
    for [r, g, b, alpha] in &picture.pixels {
        colors.extend([over(*r, *alpha), over(*g, *alpha), over(*b, *alpha)]);
    }
    new_array(py, colors, &[picture.height as usize, picture.width as usize, 3])
}

/// Encodes colors (height, width, 4) as a PNG file.
#[pyfunction]
pub(crate) fn encode_png<'py>(
    py: Python<'py>,
    rgba: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, pyo3::types::PyBytes>> {
    let picture = read_picture(rgba)?;
    let bytes = py.detach(|| picture.to_png());
    Ok(pyo3::types::PyBytes::new(py, &bytes))
}

/// Encodes whole numbers from 0 to 65535 (height, width) as a 16-bit grayscale PNG file.
#[pyfunction]
pub(crate) fn encode_gray_png<'py>(
    py: Python<'py>,
    codes: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, pyo3::types::PyBytes>> {
    use numpy::{PyArray2, PyArrayMethods as _, PyUntypedArrayMethods as _};
    let wrong = || PyErr::from(Failure::argument("codes", "expected uint16 (height, width)"));
    let array = codes.cast::<PyArray2<u16>>().map_err(|_| wrong())?;
    let [height, width] = *array.shape() else { return Err(wrong()) };
    let (Ok(width), Ok(height)) = (u32::try_from(width), u32::try_from(height)) else {
        return Err(wrong());
    };
    let codes = array.to_vec()?;
    let encode = || -> Result<Vec<u8>, png::EncodingError> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, width, height);
        encoder.set_color(png::ColorType::Grayscale);
        encoder.set_depth(png::BitDepth::Sixteen);
        let big_endian: Vec<u8> = codes.iter().flat_map(|code| code.to_be_bytes()).collect();
        encoder.write_header()?.write_image_data(&big_endian)?;
        Ok(bytes)
    };
    let bytes = py.detach(encode).map_err(|_| wrong())?;
    Ok(pyo3::types::PyBytes::new(py, &bytes))
}

/// Reads a picture from colors with alpha.
pub(crate) fn read_picture(rgba: &Bound<'_, PyAny>) -> PyResult<Picture> {
    use numpy::{PyArray3, PyArrayMethods as _, PyUntypedArrayMethods as _};
    let wrong = |_| PyErr::from(Failure::argument("rgba", "expected uint8 (height, width, 4)"));
    let array = rgba.cast::<PyArray3<u8>>().map_err(wrong)?;
    let [height, width, 4] = *array.shape() else { return Err(wrong_picture()) };
    let (Ok(width), Ok(height)) = (u32::try_from(width), u32::try_from(height)) else {
        return Err(wrong_picture());
    };
    let values = array.to_vec()?;
    let mut picture = Picture::default();
    picture.resize(width, height);
    picture.pixels.copy_from_slice(values.as_chunks::<4>().0);
    Ok(picture)
}

/// Returns the error for an array that is not a picture.
fn wrong_picture() -> PyErr {
    Failure::argument("rgba", "expected uint8 (height, width, 4)").into()
}

/// Reads the number of threads; the default is one per processor.
pub(crate) fn thread_count(given: Option<usize>) -> usize {
    let processors = || thread::available_parallelism().map_or(1, usize::from);
    given.unwrap_or_else(processors).clamp(1, 1024)
}

/// Returns the error for a picture that is too large for memory.
pub(crate) fn check_pixel_count(width: u64, height: u64) -> Fallible<()> {
    if width * height <= MAX_PIXELS {
        return Ok(());
    }
    let message = format!("{width} x {height} pixels exceed the limit of {MAX_PIXELS}");
    let help = "render it in parts, or use the command `alberti render`, which has no such limit";
    Err(Failure::limit("size", message, help))
}

/// Reads the requested passes: whether colors are among them, and the other names.
fn read_passes(options: &Keywords<'_, '_>) -> PyResult<(bool, Vec<Pass>)> {
    let Some(value) = options.value("passes")? else { return Ok((true, Vec::new())) };
    let names = value.extract::<String>().map(|name| vec![name]);
    let Ok(names) = names.or_else(|_| value.extract::<Vec<String>>()) else {
        return Err(not_a("passes", &value, "pass names").into());
    };
    let (mut has_color, mut passes) = (false, Vec::new());
    for name in names {
        let wanted = plain_name(&name);
        if wanted == "rgb" || wanted == "rgba" {
            has_color = true;
            continue;
        }
        let known = Pass::ALL.into_iter().find(|pass| means_pass(&wanted, *pass));
        let Some(pass) = known else {
            let names = Pass::ALL.map(python_name).join(", ");
            let message = format!("has {name:?}, expected rgb, rgba, {names}");
            return Err(Failure::argument("passes", message).into());
        };
        if !passes.contains(&pass) {
            passes.push(pass);
        }
    }
    Ok((has_color, passes))
}

/// Returns the name of a pass in Python: `ids`, `view_normal` and so on.
fn python_name(pass: Pass) -> String {
    match pass {
        Pass::Id => "ids".to_owned(),
        Pass::Model | Pass::Object | Pass::Node | Pass::Mesh | Pass::Material => {
            format!("{}_ids", pass.name())
        }
        _ => pass.name().replace('-', "_"),
    }
}

/// Returns whether a normalized name refers to this pass: its name in Python or in flags.
fn means_pass(wanted: &str, pass: Pass) -> bool {
    wanted == plain_name(pass.name()) || wanted == plain_name(&python_name(pass))
}

impl<'a> RenderJob<'a> {
    /// Reads the options of a call.
    fn new(subject: &'a Subject, options: &Keywords<'_, '_>) -> PyResult<Self> {
        let mut file = apply_options(subject, options)?;
        // Without anything to frame, every camera shows only the background.
        if subject.is_empty() && matches!(file.camera.view, ViewFile::Frame { .. }) {
            file.camera = CameraFile::look_at([2.0, 1.0, 2.0], [0.0; 3]);
        }
        let (width, height) = file.image.size;
        check_pixel_count(width.into(), height.into())?;
        let (has_color, passes) = read_passes(options)?;
        let threads = thread_count(options.count("threads")?);
        let legacy_lights = read_legacy_lights(options)?;
        Ok(Self { subject, file, legacy_lights, has_color, passes, threads })
    }

    /// Whether rendering takes only a few milliseconds.
    ///
    /// Only on Linux with glibc do all Python threads have a stack as large as a worker's.
    fn is_brief(&self) -> bool {
        let (width, height) = self.file.image.size;
        cfg!(all(target_os = "linux", target_env = "gnu"))
            && u64::from(width) * u64::from(height) <= MAX_BRIEF_PIXELS
            && self.subject.item_counts().iter().sum::<usize>() <= MAX_BRIEF_ITEMS
    }

    /// Renders the picture and the passes.
    fn render(&self, cancel: &CancelToken) -> Fallible<RenderedJob> {
        let mut scene = self.subject.resolve(&self.file)?;
        scene.lights.extend(&self.legacy_lights);
        let mut renderer = IdleRenderer::take();
        let (picture, passes, warnings) = self.render_scene(&scene, &mut renderer.0, cancel)?;
        let camera = NativeCamera::of_scene(&self.file.camera, &scene);
        Ok(RenderedJob { picture, passes, camera, warnings })
    }

    /// Renders `scene` with `renderer`.
    fn render_scene(
        &self,
        scene: &Scene,
        renderer: &mut Renderer,
        cancel: &CancelToken,
    ) -> Fallible<(Option<Picture>, Vec<PassBuffer>, Vec<String>)> {
        let textures = self.subject.textures();
        let monitor: Arc<dyn Monitor> = Arc::new(cancel.clone());
        let context = RenderContext::new(scene, textures, self.threads).with_monitor(&monitor);
        let (mut picture, mut warnings) = (None, Vec::new());
        if self.has_color {
            let mut colors = Picture::default();
            let found = renderer.render(&context, &mut colors)?;
            warnings = found.iter().map(ToString::to_string).collect();
            picture = Some(colors);
        }
        let passes = if self.passes.is_empty() {
            Vec::new()
        } else {
            let all = PixelRect::from_size(scene.image.width, scene.image.height);
            renderer.render_passes(&context, all, &self.passes)?
        };
        Ok((picture, passes, warnings))
    }
}

impl RenderedJob {
    /// Converts the result to arrays.
    fn into_parts(self, py: Python<'_>) -> PyResult<FrameParts<'_>> {
        let arrays = PyDict::new(py);
        if let Some(picture) = self.picture {
            let shape = [picture.height as usize, picture.width as usize, 4];
            arrays.set_item("rgba", new_array(py, picture.pixels.into_flattened(), &shape)?)?;
        }
        for PassBuffer { pass, width, height, values } in self.passes {
            let (height, width) = (height as usize, width as usize);
            let shape = [height, width, pass.channels()];
            let shape = if pass.channels() == 1 { &shape[..2] } else { &shape[..] };
            let array = match values {
                PassValues::Floats(values) => new_array(py, values, shape)?,
                PassValues::Integers(values) => new_array(py, values, shape)?,
            };
            arrays.set_item(python_name(pass), array)?;
        }
        Ok((arrays, self.camera, self.warnings))
    }
}

/// A renderer that returns to the pool when it is dropped, except during a panic.
struct IdleRenderer(Renderer);

impl IdleRenderer {
    /// Takes a renderer from the pool, or creates one.
    fn take() -> Self {
        let mut idle = IDLE_RENDERERS.lock().unwrap_or_else(PoisonError::into_inner);
        Self(idle.pop().unwrap_or_default())
    }
}

impl Drop for IdleRenderer {
    fn drop(&mut self) {
        if thread::panicking() {
            return;
        }
        let mut idle = IDLE_RENDERERS.lock().unwrap_or_else(PoisonError::into_inner);
        if idle.len() < MAX_IDLE_RENDERERS {
            idle.push(std::mem::take(&mut self.0));
        }
    }
}

/// Renders jobs with this number of workers, each of which takes the next pending job.
fn render_jobs(
    jobs: &[RenderJob<'_>],
    workers: usize,
    first_job: usize,
    cancel: &CancelToken,
) -> Fallible<Vec<RenderedJob>> {
    let next = AtomicUsize::new(0);
    let work = || {
        let mut done = Vec::new();
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            let Some(job) = jobs.get(number).filter(|_| !cancel.is_canceled()) else {
                return Ok(done);
            };
            match job.render(cancel) {
                Ok(rendered) => done.push((number, rendered)),
                Err(failure) => {
                    cancel.cancel();
                    let pointer = job_pointer(first_job + number, &failure.pointer);
                    return Err((number, Failure { pointer, ..failure }));
                }
            }
        }
    };
    let results: Vec<Result<Vec<_>, (usize, Failure)>> = thread::scope(|scope| {
        let spawn = |_| {
            let builder = thread::Builder::new().stack_size(8 << 20);
            builder.spawn_scoped(scope, work)
        };
        let threads: Vec<_> = (0..workers).filter_map(|number| spawn(number).ok()).collect();
        if threads.is_empty() {
            return vec![work()];
        }
        let join = |thread: thread::ScopedJoinHandle<'_, _>| {
            thread.join().unwrap_or_else(|panic| Err((usize::MAX, Failure::internal(&*panic))))
        };
        threads.into_iter().map(join).collect()
    });
    let mut rendered = Vec::with_capacity(jobs.len());
    let mut first_failure: Option<(usize, Failure)> = None;
    for result in results {
        match result {
            Ok(done) => rendered.extend(done),
            // A job that was canceled because of another failure ranks after that failure.
            Err(failure)
                if first_failure.as_ref().is_none_or(|first| is_cause(&failure, first)) =>
            {
                first_failure = Some(failure);
            }
            Err(_) => {}
        }
    }
    if let Some((_, failure)) = first_failure {
        return Err(failure);
    }
    rendered.sort_by_key(|(number, _)| *number);
    Ok(rendered.into_iter().map(|(_, job)| job).collect())
}

/// Returns whether a failure ranks before another: cancellations come last, then by job index.
fn is_cause(one: &(usize, Failure), other: &(usize, Failure)) -> bool {
    let is_stopped = |failure: &Failure| failure.message.contains("canceled");
    (is_stopped(&one.1), one.0) < (is_stopped(&other.1), other.0)
}
