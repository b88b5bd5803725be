//! Viewing rays: the line of sight of any pixel (CA-3).
//!
//! ```text
//!  perspective: all from the eye           parallel: all in one direction,
//!                                          from the window's plane
//!     ╱│  (us, vs, −d)                       │──►  (us, vs, −d)
//!  e ──┼───────────────►                     │──►
//!     ╲│  window at distance d               │──►
//!
//!  us = left + (right − left) · (x − x₀)/nx
//!  vs = bottom + (top − bottom) · (y − y₀)/ny     from the top down if y runs down
//!  x₀ = y₀ = −½ if pixel centres are integers, 0 if they are halves
//! ```
//!
//! This is the inverse of the viewing pipeline, for those who go from the picture to the world.

use crate::{Camera, CameraError, Window};
use homog::{Point, Vector, View, World};

/// Where the centre of pixel (i, j) is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum PixelCenters {
    /// At (i, j), as in the chapter: the picture reaches from −½ to n − ½.
    Integers,
    /// At (i + ½, j + ½), as in OpenGL, Vulkan and Direct3D since version 10: the picture reaches
    /// from 0 to n.
    Halves,
}

/// Which way y runs in the picture.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum VerticalAxis {
    /// y = 0 is the lowest row, as in the chapter and in OpenGL.
    Up,
    /// y = 0 is the uppermost row, as in image files, Vulkan and Direct3D.
    Down,
}

/// The pixels of a picture and how they are counted.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct PixelGrid {
    /// Pixels across, at least 1.
    pub nx: u32,
    /// Pixels from top to bottom, at least 1.
    pub ny: u32,
    /// Where their centres are.
    pub centers: PixelCenters,
    /// Which way they are counted vertically.
    pub y: VerticalAxis,
}

impl PixelGrid {
    /// The chapter's pixels: centres at integers, y up.
    #[must_use]
    pub const fn chapter(nx: u32, ny: u32) -> Self {
        Self { nx, ny, centers: PixelCenters::Integers, y: VerticalAxis::Up }
    }

    /// The pixels of image files: centres at halves, y down.
    #[must_use]
    pub const fn image(nx: u32, ny: u32) -> Self {
        Self { nx, ny, centers: PixelCenters::Halves, y: VerticalAxis::Down }
    }

    /// The place (x, y) of the picture as parts of its width, from the left, and of its height,
    /// from below.
    fn parts(self, x: f64, y: f64) -> [f64; 2] {
        let shift = if self.centers == PixelCenters::Integers { 0.5 } else { 0.0 };
        let (across, along) = ((x + shift) / f64::from(self.nx), (y + shift) / f64::from(self.ny));
        match self.y {
            VerticalAxis::Up => [across, along],
            VerticalAxis::Down => [across, 1.0 - along],
        }
    }
}

/// A half-line in the world.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Ray {
    /// Where it begins: the eye, or a point of the window's plane for parallel rays.
    pub origin: Point<World>,
    /// Where it goes: a unit vector.
    pub direction: Vector<World>,
}

impl Ray {
    /// The point at `distance` along the ray.
    #[must_use]
    pub fn at(self, distance: f64) -> Point<World> {
        self.origin + self.direction * distance
    }
}

/// The rays of all pixels of a picture.
///
/// ```
/// use camera::{Basis, Camera, PixelGrid, Rays, Window};
/// use homog::{Point, Vector};
/// let camera = Camera::new(Point::new(0.0, 0.0, 5.0), Basis::WORLD)?;
/// let window = Window { left: -1.0, right: 1.0, bottom: -1.0, top: 1.0, distance: 1.0 };
/// let rays = Rays::perspective(camera, window, PixelGrid::image(3, 3))?;
/// let middle = rays.pixel(1, 1);
/// assert_eq!((middle.origin, middle.direction), (camera.eye(), -Vector::Z));
/// # Ok::<(), camera::CameraError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Rays {
    camera: Camera,
    window: Window,
    grid: PixelGrid,
    /// The common direction in view space; `None` for rays from the eye.
    projectors: Option<Vector<View>>,
}

impl Rays {
    /// Rays from the eye through the window.
    ///
    /// # Errors
    /// A window that is empty, not finite or not in front of the eye; a grid without pixels.
    pub fn perspective(
        camera: Camera,
        window: Window,
        grid: PixelGrid,
    ) -> Result<Self, CameraError> {
        window.check_perspective()?;
        check_grid(grid)?;
        Ok(Self { camera, window, grid, projectors: None })
    }

    /// Rays along the gaze, beginning on the window's plane; at distance 0 that is the plane of the
    /// eye.
    ///
    /// # Errors
    /// A window that is empty or not finite; a grid without pixels.
    pub fn parallel(camera: Camera, window: Window, grid: PixelGrid) -> Result<Self, CameraError> {
        Self::oblique(camera, window, grid, -Vector::Z)
    }

    /// Rays along `projectors`, a direction in view space with z < 0, beginning on the window's
    /// plane.
    ///
    /// # Errors
    /// As [`parallel`](Self::parallel); projectors that are not finite, or with z ≥ 0.
    pub fn oblique(
        camera: Camera,
        window: Window,
        grid: PixelGrid,
        projectors: Vector<View>,
    ) -> Result<Self, CameraError> {
        window.check_edges()?;
        check_grid(grid)?;
        match projectors.normalized() {
            Some(unit) if unit.z() < 0.0 => {
                Ok(Self { camera, window, grid, projectors: Some(unit) })
            }
            _ => Err(CameraError::Projectors { direction: projectors }),
        }
    }

    /// The ray through the centre of pixel (i, j). Pixels outside the picture have rays too.
    #[must_use]
    pub fn pixel(&self, i: u32, j: u32) -> Ray {
        let half = if self.grid.centers == PixelCenters::Halves { 0.5 } else { 0.0 };
        self.through(f64::from(i) + half, f64::from(j) + half)
    }

    /// The ray through the place (x, y) of the picture, in the grid's own coordinates; `None` if
    /// they are not finite, or so far outside that the ray is not.
    #[must_use]
    pub fn at(&self, x: f64, y: f64) -> Option<Ray> {
        let ray = self.through(x, y);
        (ray.origin.is_finite() && ray.direction.is_finite()).then_some(ray)
    }

    fn through(&self, x: f64, y: f64) -> Ray {
        let Window { left, right, bottom, top, distance } = self.window;
        let [across, along] = self.grid.parts(x, y);
        let [x, y] = [left + (right - left) * across, bottom + (top - bottom) * along];
        let on_window = Vector::<View>::new(x, y, -distance);
        let (eye, basis) = (self.camera.eye(), self.camera.basis());
        match self.projectors {
            None => {
                // Ahead of the eye and hence not zero; scaled first, so that no square overflows.
                let unit = on_window.normalized().unwrap_or(-Vector::Z);
                let direction = basis.to_world(unit);
                Ray { origin: eye, direction: direction / direction.length() }
            }
            Some(along) => {
                Ray { origin: eye + basis.to_world(on_window), direction: basis.to_world(along) }
            }
        }
    }
}

fn check_grid(grid: PixelGrid) -> Result<(), CameraError> {
    let PixelGrid { nx, ny, .. } = grid;
    if nx > 0 && ny > 0 { Ok(()) } else { Err(CameraError::EmptyGrid { nx, ny }) }
}
