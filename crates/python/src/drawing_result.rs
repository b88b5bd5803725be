//! Line drawings: pages as SVG, PDF and DXF, and the segments of edges as arrays.

use crate::arrays::new_array;
use crate::detached::run_detached;
use crate::failure::Fallible;
use crate::keywords::Keywords;
use crate::native_camera::NativeCamera;
use crate::rendering::thread_count;
use crate::scene_options::apply_options;
use crate::subject::Subject;
use drawing::Page;
use hidden_line::EdgeClass;
use pipeline::{Scene, Timings, draw_lines, dxf_options};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// A drawing: its page, and the scene that it shows.
#[pyclass(frozen, module = "alberti._native", name = "Drawing")]
pub(crate) struct NativeDrawing {
    page: Page,
    scene: Scene,
    camera: scene_file::file::CameraFile,
    threads: usize,
}

/// Draws the lines of a subject.
#[pyfunction]
pub(crate) fn draw(
    py: Python<'_>,
    subject: &Bound<'_, Subject>,
    options: &Bound<'_, PyDict>,
) -> PyResult<NativeDrawing> {
    let options = Keywords(options);
    let subject = subject.get();
    let file = apply_options(subject, &options)?;
    let threads = thread_count(options.count("threads")?);
    run_detached(py, |_| -> Fallible<NativeDrawing> {
        let scene = subject.resolve(&file)?;
        let page = draw_lines(&scene, threads, &Timings::default())?;
        Ok(NativeDrawing { page, scene, camera: file.camera, threads })
    })
}

/// Returns the name of an edge class.
const fn class_name(class: EdgeClass) -> &'static str {
    match class {
        EdgeClass::Silhouette => "silhouette",
        EdgeClass::Boundary => "boundary",
        EdgeClass::Crease => "crease",
        EdgeClass::Intersection => "intersection",
        EdgeClass::Section => "section",
        EdgeClass::Marked => "marked",
        EdgeClass::Tangent => "tangent",
        EdgeClass::Line => "line",
        EdgeClass::Hatching => "hatching",
        EdgeClass::Facet => "facet",
    }
}

#[pymethods]
impl NativeDrawing {
    /// Returns the page as an SVG file.
    fn svg(&self, py: Python<'_>) -> String {
        py.detach(|| self.page.to_svg())
    }

    /// Returns the page as a PDF file.
    fn pdf<'py>(&self, py: Python<'py>) -> Bound<'py, pyo3::types::PyBytes> {
        let bytes = py.detach(|| page::to_pdf(std::slice::from_ref(&self.page)));
        pyo3::types::PyBytes::new(py, &bytes)
    }

    /// Returns the page as a DXF file: in the model's unit if the view is parallel, otherwise in
    /// millimeters on paper.
    fn dxf<'py>(&self, py: Python<'py>) -> Bound<'py, pyo3::types::PyBytes> {
        let bytes = py.detach(|| self.page.to_dxf(&dxf_options(&self.scene, &self.page)));
        pyo3::types::PyBytes::new(py, &bytes)
    }

    /// Returns warnings about missing parts.
    fn warnings(&self) -> Vec<String> {
        self.page.warnings.iter().map(ToString::to_string).collect()
    }

    /// Returns the camera, with its position.
    fn camera(&self) -> NativeCamera {
        NativeCamera::of_scene(&self.camera, &self.scene)
    }

    /// Returns the object names and the segments: endpoints (N, 2, 2) in pixels with y down,
    /// visibility (N,), class names, objects (N,) and edges (N,).
    fn lines<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let style = self.scene.style.line_style();
        let (options, fill) = (style.to_draw_options(), style.to_fill_options());
        let drawing = run_detached(py, |_| -> Fallible<_> {
            Ok(drawing::draw(&self.scene.drawing_subject(), &options, &fill, self.threads)?)
        })?;
        let segments = &drawing.segments;
        let count = segments.len();
        // Converts pixel coordinates with the origin at the corner to coordinates in which the
        // center of the first pixel is (0, 0).
        let ends = segments.iter().flat_map(|segment| segment.ends);
        let ends: Vec<f64> = ends.flat_map(|end| [end.x - 0.5, end.y - 0.5]).collect();
        let visible: Vec<bool> = segments.iter().map(|segment| segment.visible).collect();
        let classes: Vec<&str> = segments.iter().map(|segment| class_name(segment.class)).collect();
        let objects: Vec<u32> = segments.iter().map(|segment| segment.object).collect();
        let edges: Vec<u32> = segments.iter().map(|segment| segment.edge).collect();
        let lines = PyDict::new(py);
        lines.set_item("ends", new_array(py, ends, &[count, 2, 2])?)?;
        lines.set_item("visible", new_array(py, visible, &[count])?)?;
        lines.set_item("class", classes)?;
        lines.set_item("object", new_array(py, objects, &[count])?)?;
        lines.set_item("edge", new_array(py, edges, &[count])?)?;
        lines.set_item("names", drawing.objects)?;
        Ok(lines)
    }
}
