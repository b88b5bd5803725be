//! Constructors for scenes built in Rust: short forms for the most common parts.

use super::projection::NO_SHIFT;
use super::{CameraFile, LightFile, ModelFile, ProjectionFile, SceneFile, ViewFile, ViewportFile};
use crate::color::LightColor;
use crate::number::{InvalidNumber, NonNegative, Positive, Scale, Triple};

impl SceneFile {
    /// Creates a scene from these models, with defaults for everything else.
    ///
    /// ```
    /// use scene_file::SceneFile;
    /// use scene_file::file::{CameraFile, LightFile, ModelFile};
    ///
    /// let duck = ModelFile::new("duck.glb").at([0.0, 0.5, 0.0]).scaled(2.0)?;
    /// let mut scene = SceneFile::new([duck, ModelFile::new("table.glb")]);
    /// scene.camera = CameraFile::look_at([4.0, 3.0, 5.5], [0.0; 3]);
    /// scene.lights = Some(vec![LightFile::directional([-1.0, -2.0, -1.0], 2.6)?]);
    /// assert_eq!(SceneFile::from_ron(&scene.to_ron()?)?, scene);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn new(models: impl IntoIterator<Item = ModelFile>) -> Self {
        Self { models: models.into_iter().collect(), ..Self::default() }
    }
}

impl ModelFile {
    /// Creates a model from a file, with its original position and size. `path` is relative to the
    /// scene's folder.
    #[must_use]
    pub fn new(path: impl Into<String>) -> Self {
        Self {
            path: path.into(),
            translation: Triple::ZERO,
            rotation_degrees: Triple::ZERO,
            scale: Scale::ONE,
            up: None,
            unit: None,
            crease_degrees: None,
            scene: None,
            variant: None,
            animation: None,
            time: None,
            instances: None,
            scalars: None,
            materials: Vec::new(),
        }
    }

    /// Moves the model so that its origin is at the given point in the world.
    #[must_use]
    pub fn at(self, translation: impl Into<Triple>) -> Self {
        Self { translation: translation.into(), ..self }
    }

    /// Rotates the model about the x, then the y, then the z axis, by angles in degrees.
    #[must_use]
    pub fn rotated(self, degrees: impl Into<Triple>) -> Self {
        Self { rotation_degrees: degrees.into(), ..self }
    }

    /// Scales the model by one factor on all axes.
    ///
    /// # Errors
    /// Returns an error if the factor is 0 or not finite.
    pub fn scaled(self, factor: f64) -> Result<Self, InvalidNumber> {
        Ok(Self { scale: factor.try_into()?, ..self })
    }
}

impl CameraFile {
    /// Creates a perspective camera at `eye` that looks at `target`, with y up.
    #[must_use]
    pub fn look_at(eye: impl Into<Triple>, target: impl Into<Triple>) -> Self {
        let view = ViewFile::LookAt { eye: eye.into(), target: target.into(), up: Triple::Y_AXIS };
        Self { view, ..Self::default() }
    }

    /// Creates a perspective camera at `eye` that looks in the given direction, with y up.
    #[must_use]
    pub fn look_to(eye: impl Into<Triple>, gaze: impl Into<Triple>) -> Self {
        let view = ViewFile::LookTo { eye: eye.into(), gaze: gaze.into(), up: Triple::Y_AXIS };
        Self { view, ..Self::default() }
    }

    /// Replaces the camera's projection.
    #[must_use]
    pub fn with_projection(self, projection: ProjectionFile) -> Self {
        Self { projection: Some(projection), ..self }
    }
}

impl ProjectionFile {
    /// Creates a perspective projection with a vertical field of view in degrees, between a near
    /// and a far plane. If `planes` is `None`, both are fitted to the models.
    ///
    /// # Errors
    /// Returns an error if the angle is not between 0 and 180 degrees, or if a distance is not
    /// greater than 0.
    pub fn perspective(
        fov_y_degrees: f64,
        planes: impl Into<Option<[f64; 2]>>,
    ) -> Result<Self, InvalidNumber> {
        let [near, far] = planes.into().map_or([None; 2], |planes| planes.map(Some));
        Ok(Self::Perspective {
            fov_y_degrees: Some(fov_y_degrees.try_into()?),
            fov_x_degrees: None,
            fov_diagonal_degrees: None,
            shift: NO_SHIFT,
            near: near.map(Positive::try_from).transpose()?,
            far: far.map(Positive::try_from).transpose()?,
        })
    }

    /// Creates an orthographic projection through a window with left, right, bottom and top
    /// borders, between a near and a far plane.
    ///
    /// # Errors
    /// Returns an error if a number is not finite.
    pub fn orthographic(window: [f64; 4], planes: [f64; 2]) -> Result<Self, InvalidNumber> {
        let [left, right, bottom, top] = window;
        let [near, far] = planes;
        Ok(Self::Orthographic {
            height: None,
            left: Some(left.try_into()?),
            right: Some(right.try_into()?),
            bottom: Some(bottom.try_into()?),
            top: Some(top.try_into()?),
            near: Some(near.try_into()?),
            far: Some(far.try_into()?),
        })
    }

    /// Creates a perspective projection through a window on the near plane, with left, right,
    /// bottom and top borders.
    ///
    /// # Errors
    /// Returns an error if a number is not finite, or if a plane's distance is not greater than 0.
    pub fn frustum(window: [f64; 4], planes: [f64; 2]) -> Result<Self, InvalidNumber> {
        let [left, right, bottom, top] = window;
        let [near, far] = planes;
        Ok(Self::Frustum {
            left: left.try_into()?,
            right: right.try_into()?,
            bottom: bottom.try_into()?,
            top: top.try_into()?,
            near: near.try_into()?,
            far: Some(far.try_into()?),
        })
    }
}

impl ViewportFile {
    /// Creates a view of the scene in a rectangle, specified by left, top, width and height as
    /// fractions of the picture.
    ///
    /// # Errors
    /// Returns an error if one of the fractions is not between 0 and 1.
    pub fn at(rectangle: [f64; 4]) -> Result<Self, InvalidNumber> {
        let [left, top, width, height] = rectangle;
        let at = Some((left.try_into()?, top.try_into()?, width.try_into()?, height.try_into()?));
        Ok(Self { at, ..Self::default() })
    }
}

impl LightFile {
    /// Creates a white directional light, such as sunlight, that travels in the given direction.
    /// Its intensity is the illuminance in lux.
    ///
    /// # Errors
    /// Returns an error if the intensity is negative or not finite.
    pub fn directional(
        direction: impl Into<Triple>,
        intensity: f64,
    ) -> Result<Self, InvalidNumber> {
        let intensity = NonNegative::try_from(intensity)?;
        let (direction, color) = (direction.into(), LightColor::WHITE);
        Ok(Self::Directional { direction, intensity, color, shadows: None })
    }

    /// Creates a white point light. Its intensity is in candela.
    ///
    /// # Errors
    /// Returns an error if the intensity is negative or not finite.
    pub fn point(position: impl Into<Triple>, intensity: f64) -> Result<Self, InvalidNumber> {
        let intensity = NonNegative::try_from(intensity)?;
        let (position, color) = (position.into(), LightColor::WHITE);
        Ok(Self::Point { position, intensity, range: None, color, shadows: None })
    }

    /// Creates a white spot light with a cone that extends 45 degrees from its axis. Its intensity
    /// is in candela.
    ///
    /// # Errors
    /// Returns an error if the intensity is negative or not finite.
    pub fn spot(
        position: impl Into<Triple>,
        direction: impl Into<Triple>,
        intensity: f64,
    ) -> Result<Self, InvalidNumber> {
        Ok(Self::Spot {
            position: position.into(),
            direction: direction.into(),
            intensity: NonNegative::try_from(intensity)?,
            inner_cone_degrees: None,
            outer_cone_degrees: None,
            range: None,
            color: LightColor::WHITE,
            shadows: None,
        })
    }

    /// Creates white light from all directions. Its intensity is the illuminance of every surface,
    /// in lux.
    ///
    /// # Errors
    /// Returns an error if the intensity is negative or not finite.
    pub fn ambient(intensity: f64) -> Result<Self, InvalidNumber> {
        let intensity = NonNegative::try_from(intensity)?;
        Ok(Self::Ambient { intensity, color: LightColor::WHITE })
    }
}
