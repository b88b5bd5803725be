//! The step for a stereo pair: the positions of both eyes, and where each sees the subject (C65).
//!
//! ```text
//!  parallax = x of the right eye − x of the left eye, in pixels
//!    0 at the convergence distance, negative for nearer points, positive for farther ones
//! ```

use super::transform_chain::TransformChain;
use super::{Explanation, Step};
use homog::{Point, World};

impl Explanation {
    /// Returns the explanation with a step for the eyes of a stereo pair: left, then right.
    ///
    /// `point` is the subject, whose position in both pictures gives the parallax; without a point,
    /// the step has only the eyes and their matrices. Coordinates are in each eye's own picture.
    #[must_use]
    pub fn with_stereo_pair(
        mut self,
        eyes: &[TransformChain; 2],
        point: Option<Point<World>>,
    ) -> Self {
        let title = "Stereo: the left and the right eye";
        let mut step = Step::new("stereo", title, Some("PE-3, PL-1"));
        for (side, chain) in ["left", "right"].into_iter().zip(eyes) {
            let eye = <[f64; 3]>::from(chain.eye());
            step.add_item(format!("eye_{side}"), format!("{side} eye"), eye);
            let projection = chain.view_to_clip().rows();
            step.add_item(format!("projection_{side}"), format!("projection, {side}"), projection);
        }
        if let Some(point) = point {
            add_parallax(&mut step, eyes, point);
        }
        self.steps.push(step);
        self
    }
}

/// Adds a point's positions in both pictures, and their difference.
fn add_parallax(step: &mut Step, eyes: &[TransformChain; 2], point: Point<World>) {
    let seen = |chain: &TransformChain| {
        chain.project_to_screen(chain.world_to_clip().transform_point(point))
    };
    let [Some(left), Some(right)] = [seen(&eyes[0]), seen(&eyes[1])] else {
        return step.add_item("parallax", "parallax", "none: the point is in the plane of an eye");
    };
    step.add_item("screen_left", "x, y, depth, left", <[f64; 3]>::from(left));
    step.add_item("screen_right", "x, y, depth, right", <[f64; 3]>::from(right));
    step.add_item("parallax", "parallax in pixels", right.x() - left.x());
}
