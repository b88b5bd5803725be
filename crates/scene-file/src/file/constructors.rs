//! Scenes written in Rust: short forms for what most of them have.

use super::{CameraFile, LightFile, ModelFile, ProjectionFile, SceneFile, ViewFile};
use crate::color::LightColor;
use crate::number::{InvalidNumber, NonNegative, Scale, Triple};

impl SceneFile {
    /// A scene of these models with every default.
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
    /// The model in a file, where and as large as it is there. `path` begins at the folder of the
    /// scene.
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

    /// Moved so that its origin is at a point of the world.
    #[must_use]
    pub fn at(self, translation: impl Into<Triple>) -> Self {
        Self { translation: translation.into(), ..self }
    }

    /// Turned about the x, then the y, then the z axis, by angles in degrees.
    #[must_use]
    pub fn rotated(self, degrees: impl Into<Triple>) -> Self {
        Self { rotation_degrees: degrees.into(), ..self }
    }

    /// Scaled by one factor for all axes.
    ///
    /// # Errors
    /// If the factor is 0 or not finite.
    pub fn scaled(self, factor: f64) -> Result<Self, InvalidNumber> {
        Ok(Self { scale: factor.try_into()?, ..self })
    }
}

impl CameraFile {
    /// A camera at `eye` that looks at `target`, with y upwards, in perspective.
    #[must_use]
    pub fn look_at(eye: impl Into<Triple>, target: impl Into<Triple>) -> Self {
        let view = ViewFile::LookAt { eye: eye.into(), target: target.into(), up: Triple::Y_AXIS };
        Self { view, ..Self::default() }
    }

    /// The camera with another projection.
    #[must_use]
    pub fn with_projection(self, projection: ProjectionFile) -> Self {
        Self { projection: Some(projection), ..self }
    }
}

impl LightFile {
    /// White light from infinity, such as the sun's, that travels in a direction; its illuminance
    /// is in lux.
    ///
    /// # Errors
    /// If the intensity is negative or not finite.
    pub fn directional(
        direction: impl Into<Triple>,
        intensity: f64,
    ) -> Result<Self, InvalidNumber> {
        let intensity = NonNegative::try_from(intensity)?;
        let (direction, color) = (direction.into(), LightColor::WHITE);
        Ok(Self::Directional { direction, intensity, color, shadows: None })
    }

    /// A white point light; its intensity is in candela.
    ///
    /// # Errors
    /// If the intensity is negative or not finite.
    pub fn point(position: impl Into<Triple>, intensity: f64) -> Result<Self, InvalidNumber> {
        let intensity = NonNegative::try_from(intensity)?;
        let (position, color) = (position.into(), LightColor::WHITE);
        Ok(Self::Point { position, intensity, range: None, color, shadows: None })
    }

    /// A white spot light with a cone of 45 degrees around its axis; its intensity is in candela.
    ///
    /// # Errors
    /// If the intensity is negative or not finite.
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

    /// White light from all directions; the illuminance of every surface is in lux.
    ///
    /// # Errors
    /// If the intensity is negative or not finite.
    pub fn ambient(intensity: f64) -> Result<Self, InvalidNumber> {
        let intensity = NonNegative::try_from(intensity)?;
        Ok(Self::Ambient { intensity, color: LightColor::WHITE })
    }
}
