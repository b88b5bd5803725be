//! Cameras: conversion between points and pixels, rays, intrinsic and extrinsic parameters.

use crate::arrays;
use crate::camera_options::{read_camera, rotation_file};
use crate::failure::{Failure, Fallible};
use crate::keywords::{Keywords, plain_name};
use crate::pixel_rays::PixelRays;
use crate::rendering::check_pixel_count;
use camera::{CameraAxes, Extrinsics, ViewProjection};
use homog::PixelCenters;
use model::ModelInstance;
use numpy::PyArrayMethods;
use pipeline::{Origin, Scene, SceneFile};
use projection::{Convention, Intrinsics};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use scene_file::file::{CameraFile, Positive, ProjectionFile, Triple, ViewFile};
use scene_file::options::NamedOption as _;
use std::path::PathBuf;

/// A camera: its description and the resulting position.
#[pyclass(frozen, module = "alberti._native", name = "Camera")]
pub(crate) struct NativeCamera {
    /// The description.
    pub(crate) file: CameraFile,
    /// The width and height of its pictures, if known.
    pub(crate) size: Option<(u32, u32)>,
    /// The position, framed around the models of a picture, or `None` before the first picture.
    placed: Option<ViewProjection>,
}

/// Creates a camera from the options of the Python class `Camera`.
#[pyfunction]
pub(crate) fn make_camera(options: &Bound<'_, PyDict>) -> PyResult<NativeCamera> {
    let options = Keywords(options);
    let (file, size) = (read_camera(&options)?, options.size("size")?);
    Ok(NativeCamera { file, size, placed: None })
}

/// Creates a camera from a scene file with only a camera and an image size.
#[pyfunction]
pub(crate) fn camera_from_ron(text: &str, has_size: bool) -> PyResult<NativeCamera> {
    let file = SceneFile::from_ron(text);
    let file = file.map_err(|errors| Failure::argument("text", errors.to_message(false)))?;
    let size = has_size.then_some(file.image.size);
    Ok(NativeCamera { file: file.camera, size, placed: None })
}

impl NativeCamera {
    /// Returns the camera of a scene, with its position, so that it can be used for more pictures.
    pub(crate) fn of_scene(file: &CameraFile, scene: &Scene) -> Self {
        let view_projection = scene.view_projection;
        let mut file = file.clone();
        if matches!(file.view, ViewFile::Frame { .. }) && can_stand(&file) {
            let pose = Extrinsics::from_camera(view_projection.camera, CameraAxes::OpenGl);
            let (rotation, eye) = pose.to_pose();
            let rotation = rotation_file(rotation);
            let axes = CameraAxes::OpenGl;
            file.view = ViewFile::Pose { rotation, eye: Triple(eye), axes };
            if let Some(ProjectionFile::Orthographic { height, left: None, .. }) =
                &mut file.projection
            {
                let scale = view_projection.view_to_clip.raw().y_axis.y;
                *height = Positive::new(2.0 / scale);
            }
        }
        let size = (scene.image.width, scene.image.height);
        Self { file, size: Some(size), placed: Some(view_projection) }
    }

    /// Places the camera around models, for the given picture size.
    pub(crate) fn place(
        &self,
        size: Option<(u32, u32)>,
        models: &[ModelInstance],
    ) -> Fallible<(ViewProjection, (u32, u32))> {
        let Some(size) = size.or(self.size) else {
            let help =
                "pass size=(width, height) to the camera, or use a frame's camera: frame.camera";
            return Err(Failure::argument("size", "the camera has no size").with_help(help));
        };
        if let Some(placed) = self.placed.filter(|_| self.size == Some(size)) {
            return Ok((placed, size));
        }
        if matches!(self.file.view, ViewFile::Frame { .. }) && models.is_empty() {
            let help = "use a rendered frame's camera (frame.camera), or pass eye and target";
            let message = "the camera frames a model and has no position before rendering";
            return Err(Failure::argument("camera", message).with_help(help));
        }
        let mut file = SceneFile { camera: self.file.clone(), ..SceneFile::default() };
        file.image.size = size;
        let origin = Origin::from_text("camera", "", PathBuf::new());
        Ok((Scene::resolve_camera(&origin, &file, models)?, size))
    }

    /// Returns the rays through its pixels.
    fn rays_of_pixels(&self) -> Fallible<PixelRays> {
        let (placed, size) = self.place(None, &[])?;
        Ok(PixelRays::new(placed, size))
    }
}

/// Returns whether a camera can have a fixed pose. Classical projections cannot, because they fit
/// their windows to the models.
fn can_stand(file: &CameraFile) -> bool {
    let lens = file.projection.as_ref();
    lens.is_none_or(|lens| {
        matches!(
            lens,
            ProjectionFile::Perspective { .. }
                | ProjectionFile::Orthographic { .. }
                | ProjectionFile::Frustum { .. }
                | ProjectionFile::Intrinsics { .. }
        )
    })
}

/// Returns the directions of the camera-space axes for a named convention.
fn axes_by_name(name: &str) -> Fallible<CameraAxes> {
    let wanted = plain_name(name);
    let known = CameraAxes::ALL.iter().copied().find(|axes| plain_name(axes.name()) == wanted);
    known.ok_or_else(|| {
        let message = format!("is {name:?}, expected opencv, opengl or pytorch3d");
        Failure::argument("axes", message)
    })
}

#[pymethods]
impl NativeCamera {
    /// Returns the width and height of its pictures.
    #[getter]
    fn size(&self) -> Option<(u32, u32)> {
        self.size
    }

    /// Returns a scene file with only this camera and its size, for pickling.
    fn to_ron(&self) -> PyResult<String> {
        let mut file = SceneFile { camera: self.file.clone(), ..SceneFile::default() };
        file.image.size = self.size.unwrap_or(file.image.size);
        file.to_ron().map_err(|error| Failure::argument("camera", error.to_string()).into())
    }

    /// Returns whether two cameras have the same description and size.
    fn equals(&self, other: &Bound<'_, Self>) -> bool {
        let other = other.get();
        self.file == other.file && self.size == other.size
    }

    /// Returns the matrix K, with pixel centers at integers.
    fn intrinsics<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let (placed, (width, height)) = self.place(None, &[])?;
        let size = [width, height];
        let lens = Intrinsics::from_view_to_clip(placed.view_to_clip, Convention::CHAPTER, size);
        let lens = lens.map_err(|error| Failure::argument("camera", error.to_string()))?;
        let rows = lens.in_pixel_centers(PixelCenters::Integer).to_rows();
        // Without skew, this entry may be −0.
        let entries = rows.as_flattened().iter().map(|entry| entry + 0.0).collect();
        arrays::new_array(py, entries, &[3, 3])
    }

    /// Returns R and t from the world to the camera.
    fn extrinsics<'py>(
        &self,
        py: Python<'py>,
        axes: &str,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let placed = self.place(self.size.or(Some((1, 1))), &[])?.0;
        let extrinsics = Extrinsics::from_camera(placed.camera, axes_by_name(axes)?);
        let rotation = extrinsics.rotation().as_flattened().to_vec();
        Ok((
            arrays::new_array(py, rotation, &[3, 3])?,
            arrays::new_array(py, extrinsics.translation().to_vec(), &[3])?,
        ))
    }

    /// Returns the matrix from view space to clip space in OpenGL's convention.
    fn projection_matrix<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let placed = self.place(None, &[])?.0;
        let matrix = Convention::CHAPTER.convert(Convention::OPENGL, placed.view_to_clip);
        let rows = matrix.raw().transpose().to_cols_array();
        arrays::new_array(py, rows.to_vec(), &[4, 4])
    }

    /// Returns the pixel coordinates and depths of world points.
    fn project<'py>(
        &self,
        py: Python<'py>,
        points: &Bound<'py, PyAny>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let points = arrays::real_array::<f64>("points", points, "float64")?;
        let points = arrays::rows_of::<f64, 3>("points", points, "N")?;
        let rays = self.rays_of_pixels()?;
        let (pixels, depths): (Vec<[f64; 2]>, Vec<f64>) =
            points.into_iter().map(|point| rays.project(point)).unzip();
        let count = depths.len();
        Ok((
            arrays::new_array(py, pixels.into_flattened(), &[count, 2])?,
            arrays::new_array(py, depths, &[count])?,
        ))
    }

    /// Returns the world points at pixel coordinates and depths.
    fn unproject_pixels<'py>(
        &self,
        py: Python<'py>,
        pixels: &Bound<'py, PyAny>,
        depth: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let pixels = arrays::real_array::<f64>("pixels", pixels, "float64")?;
        let pixels = arrays::rows_of::<f64, 2>("pixels", pixels, "N")?;
        let depths = arrays::real_array::<f64>("depth", depth, "float64")?;
        if depths.shape != [pixels.len()] {
            let wanted = format!("({},), one per pixel", pixels.len());
            return Err(arrays::wrong_shape("depth", &depths.shape, &wanted).into());
        }
        let rays = self.rays_of_pixels()?;
        let pairs = pixels.iter().zip(&depths.values);
        let points: Vec<[f64; 3]> =
            pairs.map(|(pixel, depth)| rays.point_at(*pixel, *depth)).collect();
        let count = points.len();
        arrays::new_array(py, points.into_flattened(), &[count, 3])
    }

    /// Returns the world points of all pixels in a depth image; NaN where the depth is infinite.
    fn unproject_image<'py>(
        &self,
        py: Python<'py>,
        depth: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let depths = arrays::real_array::<f64>("depth", depth, "float64")?;
        let rays = self.rays_of_pixels()?;
        let [width, height] = rays.size;
        if depths.shape != [height, width] {
            let wanted = format!("({height}, {width}), the size of the camera's pictures");
            return Err(arrays::wrong_shape("depth", &depths.shape, &wanted).into());
        }
        let points: Vec<[f64; 3]> = py.detach(|| {
            let pixels = rays.pixels().zip(&depths.values);
            pixels.map(|(pixel, depth)| rays.point_at(pixel, *depth)).collect()
        });
        arrays::new_array(py, points.into_flattened(), &[height, width, 3])
    }

    /// Converts a depth image to distances along the rays.
    fn distances<'py>(
        &self,
        py: Python<'py>,
        depth: &Bound<'py, numpy::PyArray2<f32>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let rays = self.rays_of_pixels()?;
        let [width, height] = rays.size;
        let depths = depth.to_vec()?;
        let distances: Vec<f32> = py.detach(|| {
            let pixels = rays.pixels().zip(&depths);
            pixels.map(|(pixel, depth)| rays.distance(pixel, *depth)).collect()
        });
        arrays::new_array(py, distances, &[height, width])
    }

    /// Returns the origins and unit directions of the rays through the centers of all pixels.
    fn rays<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let rays = self.rays_of_pixels()?;
        let [width, height] = rays.size;
        check_pixel_count(width as u64, height as u64)?;
        let (origins, directions): (Vec<[f64; 3]>, Vec<[f64; 3]>) =
            py.detach(|| rays.pixels().map(|pixel| rays.ray(pixel)).unzip());
        let shape = [height, width, 3];
        Ok((
            arrays::new_array(py, origins.into_flattened(), &shape)?,
            arrays::new_array(py, directions.into_flattened(), &shape)?,
        ))
    }
}
