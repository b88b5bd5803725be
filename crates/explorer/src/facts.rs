//! The facts of a state: numbers that sentences and tests use.

use crate::model_store::LoadedScene;
use crate::triangle_survey::Survey;
use camera::ViewProjection;
use homog::{HPoint, Point, View, World};
use projection::{Convention, ViewVolume};
use serde_json::{Value as Json, json};

/// The planes of the view volume, in the order of outcodes.
pub(crate) const PLANES: [&str; 6] = ["left", "right", "bottom", "top", "near", "far"];

/// Numbers that describe a state.
#[derive(Clone, Debug)]
pub(crate) struct Facts {
    /// The size of the view in pixels.
    pub(crate) size: [u32; 2],
    pub(crate) view_projection: ViewProjection,
    pub(crate) survey: Survey,
    /// The number of triangles in the models, and the number that were classified.
    pub(crate) triangles: [usize; 2],
    /// The center of projection in view space; `None` in a parallel projection.
    pub(crate) apex: Option<Point<View>>,
    /// The window on the near plane in view space: left, right, bottom and top.
    pub(crate) window: Option<[f64; 4]>,
    /// The distances of the near and far planes along the gaze.
    pub(crate) planes: [Option<f64>; 2],
    /// The minimum and maximum distances of the models along the gaze.
    pub(crate) model_range: Option<[f64; 2]>,
    /// The scene and its models.
    pub(crate) loaded: LoadedScene,
}

impl Facts {
    /// Computes the facts of a scene's first view.
    pub(crate) fn new(loaded: &LoadedScene) -> Self {
        let view = Self::without_survey(loaded);
        let triangles = &loaded.models.triangles.counted;
        let survey = Survey::new(&view.view_projection, triangles);
        Self { survey, model_range: model_range(&view.view_projection, triangles), ..view }
    }

    /// Computes the facts of a scene's first view except for the survey and the model range.
    pub(crate) fn without_survey(loaded: &LoadedScene) -> Self {
        let scene = loaded.views()[0];
        let view_projection = scene.view_projection;
        let volume = ViewVolume::new(view_projection.view_to_clip, Convention::CHAPTER);
        let corners = volume.corners();
        let corner = |at: usize| corners.and_then(|corners| corners[at].divide());
        let window = corner(0).zip(corner(2));
        let triangles = &loaded.models.triangles;
        Self {
            size: [scene.image.width, scene.image.height - scene.image.caption_height],
            view_projection,
            survey: Survey::default(),
            triangles: [triangles.count, triangles.counted.len()],
            apex: volume.eye().and_then(HPoint::divide),
            window: window.map(|(low, high)| [low.x(), high.x(), low.y(), high.y()]),
            planes: [0, 4].map(|at| corner(at).map(|corner| -corner.z())),
            model_range: None,
            loaded: loaded.clone(),
        }
    }

    /// Returns the horizontal and vertical field of view in degrees, or `None` in a parallel
    /// projection.
    pub(crate) fn opening_angles(&self) -> Option<[f64; 2]> {
        let (apex, [left, right, bottom, top]) = (self.apex?, self.window?);
        let distance = self.planes[0]? + apex.z();
        let angle = |low: f64, high: f64| {
            (libm::atan2(high, distance) - libm::atan2(low, distance)).to_degrees()
        };
        Some([angle(left - apex.x(), right - apex.x()), angle(bottom - apex.y(), top - apex.y())])
    }

    /// Returns the aspect ratio of the window on the near plane.
    pub(crate) fn window_aspect(&self) -> Option<f64> {
        let [left, right, bottom, top] = self.window?;
        Some((right - left) / (top - bottom))
    }

    /// Returns the aspect ratio of the view in pixels.
    pub(crate) fn picture_aspect(&self) -> f64 {
        f64::from(self.size[0]) / f64::from(self.size[1])
    }

    /// Returns the NDC depth at a distance along the gaze. In the pipeline's canonical volume, the
    /// near plane is at 1.
    pub(crate) fn depth_at(&self, distance: f64) -> Option<f64> {
        let point = Point::<View>::new(0.0, 0.0, -distance);
        Some(self.view_projection.view_to_clip.transform_point(point).divide()?.z())
    }

    /// Returns the facts as JSON.
    pub(crate) fn to_json(&self) -> Json {
        let Survey { inside, clipped, outside, clipped_by, outside_of, behind_eye } = self.survey;
        let by_plane = |counts: [usize; 6]| -> Json {
            PLANES
                .iter()
                .zip(counts)
                .map(|(name, count)| ((*name).to_owned(), count.into()))
                .collect::<serde_json::Map<_, _>>()
                .into()
        };
        let world = |point: Point<View>| -> Point<World> {
            self.view_projection.camera.view_to_world().transform_point(point)
        };
        json!({
            "triangles": self.triangles[0],
            "counted": self.triangles[1],
            "is_reduced": self.triangles[0] != self.triangles[1],
            "inside": inside,
            "clipped": clipped,
            "outside": outside,
            "clipped_by": by_plane(clipped_by),
            "outside_of": by_plane(outside_of),
            "behind_eye": behind_eye,
            "near": self.planes[0],
            "far": self.planes[1],
            "window": self.window,
            "window_aspect": self.window_aspect(),
            "picture_aspect": self.picture_aspect(),
            "fov_x_degrees": self.opening_angles().map(|angles| angles[0]),
            "fov_y_degrees": self.opening_angles().map(|angles| angles[1]),
            "apex_view": self.apex.map(<[f64; 3]>::from),
            "apex": self.apex.map(|apex| <[f64; 3]>::from(world(apex))),
            "model_near": self.model_range.map(|range| range[0]),
            "model_far": self.model_range.map(|range| range[1]),
        })
    }
}

/// Returns the minimum and maximum distances of the corners along the gaze.
fn model_range(view: &ViewProjection, triangles: &[[Point<World>; 3]]) -> Option<[f64; 2]> {
    let world_to_view = view.camera.world_to_view();
    let distances =
        triangles.iter().flatten().map(|point| -world_to_view.transform_point(*point).z());
    let (near, far) = distances
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(near, far), d| (near.min(d), far.max(d)));
    (near <= far).then_some([near, far])
}
