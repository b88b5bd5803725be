//! Explanation of points and segments under a single matrix, without a scene, for the textbook's
//! examples and exercises (HO-3, PE-1, IN-1).
//!
//! ```text
//!  p = (x, y, z, w) ──M──► M p ──÷ its w──► the image       a segment adds f(t)
//! ```

use super::foreshortening::foreshortening_step;
use super::homogeneous_point::homogeneous_step;
use super::plain_text::format_number;
use super::{Explanation, Step};
use homog::{Clip, HPoint, Projective, View};
use projection::{ProjectionError, chapter};

/// A matrix with the steps that explain where it comes from.
#[derive(Clone, PartialEq, Debug)]
pub struct BareMap {
    /// The map.
    map: Projective<View, Clip>,
    /// The steps that precede the mapping of a point.
    steps: Vec<Step>,
}

impl BareMap {
    /// Creates the map of a matrix for column vectors, passed row by row.
    #[must_use]
    pub fn from_rows(rows: [[f64; 4]; 4]) -> Self {
        let map = Projective::from_rows(rows);
        let step = Step::new("map", "The matrix", Some("HO-3"))
            .with_item("matrix", "M", rows)
            .with_item("kind", "it is", map.classify().to_string());
        Self { map, steps: vec![step] }
    }

    /// Creates the textbook's P for the planes z = `near` and z = `far` (PE-1), with its inverse.
    ///
    /// The numbers are z-coordinates, negative ahead of the camera; both may be positive, as in
    /// exercise 8. The product of P and nf P⁻¹ is nf times the identity (exercise 6).
    ///
    /// # Errors
    /// Returns an error if a number is 0 or not finite, or if the planes are equal or on different
    /// sides of the eye.
    pub fn from_planes(near: f64, far: f64) -> Result<Self, ProjectionError> {
        let p = chapter::p(near, far)?;
        let inverse = chapter::p_inverse_scaled(near, far)?;
        let step = Step::new("map", "P keeps z on the planes z = n and z = f", Some("PE-1"))
            .with_item("n", "n", near)
            .with_item("f", "f", far)
            .with_item("matrix", "P", p.rows())
            .with_item("scaled_inverse", "n f P⁻¹", inverse.rows())
            .with_item("product", "P times n f P⁻¹", inverse.then(p).rows())
            .with_item("unscaled", "command for P⁻¹", format!("alberti matrix --p {near},{far}"));
        Ok(Self { map: Projective::from_raw(p.raw()), steps: vec![step] })
    }

    /// Explains the images of homogeneous points; two points are the endpoints of a segment.
    ///
    /// # Errors
    /// Returns an error if all four coordinates of a point are 0.
    pub fn explain_points(&self, points: &[HPoint<View>]) -> Result<Explanation, String> {
        let mut steps = self.steps.clone();
        let labels: &[&str] = if let [_] = points { &[""] } else { &["a", "b"] };
        let images: Vec<HPoint<Clip>> =
            points.iter().map(|point| self.map.transform_hpoint(*point)).collect();
        if points.iter().any(|point| <[f64; 4]>::from(*point) == [0.0; 4]) {
            return Err("(0, 0, 0, 0) is neither a point nor a direction".to_owned());
        }
        if let [point] = points {
            steps.push(homogeneous_step(*point));
        }
        if !points.is_empty() {
            steps.push(image_step(labels, points, &images));
        }
        if let [start, end] = images[..] {
            steps.push(foreshortening_step(start, end));
        }
        let verdict = match images[..] {
            [image] => describe_image(image),
            [] => "Use --point or --segment to map a point or a segment.".to_owned(),
            [start, end] => describe_segment(start.w(), end.w()).to_owned(),
            _ => "Every point is mapped.".to_owned(),
        };
        Ok(Explanation { subject: "A map without a scene".to_owned(), steps, verdict })
    }
}

/// Returns the step with the images of points, before and after the divide.
fn image_step(labels: &[&str], points: &[HPoint<View>], images: &[HPoint<Clip>]) -> Step {
    let mut step = Step::new("image", "The image: M p, divided by its w", Some("HO-1, HO-3"));
    for ((label, point), image) in labels.iter().zip(points).zip(images) {
        let id = |what: &str| match *label {
            "" => what.to_owned(),
            label => format!("{what}_{label}"),
        };
        let (p, divided) = match *label {
            "" => ("p", "divided".to_owned()),
            label => (label, format!("M {label}, divided")),
        };
        step.add_item(id("point"), p, <[f64; 4]>::from(*point));
        step.add_item(id("image"), format!("M {p}"), <[f64; 4]>::from(*image));
        match image.divide() {
            Some(image) => step.add_item(id("divided"), divided, <[f64; 3]>::from(image)),
            None => step.add_item(id("divided"), divided, "w is 0: at infinity"),
        }
    }
    step
}

/// Describes the image of a segment in words, from w at its ends.
fn describe_segment(start: f64, end: f64) -> &'static str {
    if start * end > 0.0 {
        "Both ends are mapped; f(t) gives the images of the points between them."
    } else if start == 0.0 || end == 0.0 {
        "An end with w = 0 maps to infinity, so the image has no end there: clip the segment first."
    } else {
        "Each end has an image, but w changes sign between them: the segment crosses the plane \
         of the eye, where w is 0. The line between the two images is not the image of the segment, \
         so clip the segment first."
    }
}

/// Describes the image of one point in words.
fn describe_image(image: HPoint<Clip>) -> String {
    match image.divide() {
        Some(divided) => {
            let [x, y, z] = <[f64; 3]>::from(divided).map(format_number);
            format!("It maps to ({x}, {y}, {z}).")
        }
        None => "It maps to infinity: its w is 0.".to_owned(),
    }
}
