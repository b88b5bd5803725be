//! The step for f(t): where points of a segment appear in the segment's image (IN-1, exercise 11).
//!
//! ```text
//!  f(t) = w_R t / (w_r + t (w_R − w_r))        f(0) = 0, f(1) = 1, f′ > 0
//! ```

use super::Step;
use homog::{Foreshortening, HPoint, Space};

/// The parameters at which f(t) is printed.
const SAMPLES: [(&str, f64); 5] =
    [("f_0", 0.0), ("f_1_4", 0.25), ("f_1_2", 0.5), ("f_3_4", 0.75), ("f_1", 1.0)];

/// Returns the step for f(t) of a segment, from the images of its ends before the divide.
///
/// A segment whose ends have w with different signs crosses the plane of the eye. Its image is not
/// connected, so the step states that f(t) is not defined.
pub(super) fn foreshortening_step<S: Space>(start: HPoint<S>, end: HPoint<S>) -> Step {
    let title = "f(t): where points of the segment land between the images of its ends";
    let mut step = Step::new("foreshortening", title, Some("IN-1"))
        .with_item("w_r", "w_r, of a", start.w())
        .with_item("w_R", "w_R, of b", end.w());
    let Ok(f) = Foreshortening::from_endpoints(start, end) else {
        let words = "not defined: w is 0 at an end or changes sign between the ends; clip first";
        return step.with_item("f", "f(t)", words);
    };
    for (id, t) in SAMPLES {
        if let Some(place) = f.image_parameter(t) {
            step.add_item(id, format!("f({t})"), place);
        }
    }
    for (id, t) in [("slope_0", 0.0), ("slope_1", 1.0)] {
        if let Some(slope) = f.derivative(t) {
            step.add_item(id, format!("f′({t})"), slope);
        }
    }
    step
}
