//! Explains a homogeneous point (x, y, z, w): the multiples of a point and the points at infinity
//! (HO-1, HO-2, HO-5, VN-1).
//!
//! ```text
//!  w ≠ 0   (hx, hy, hz, h) ~ (x, y, z, 1)   every multiple has one image: M (h p) = h (M p)
//!  w = 0   a direction                      its image is a vanishing point
//! ```

use super::plain_text::format_number;
use super::transform_chain::{TransformChain, describe_outcode};
use super::{Explanation, Step};
use homog::{Clip, HPoint, World};

/// Follows a homogeneous world point through every stage up to the divide.
///
/// The four numbers stay undivided until the divide step, so a factor h is visible in all of them.
/// Outcodes are computed for the multiple with w = 1, since −p and p have different outcodes. A
/// point with w = 0 is a direction: it is not clipped, and the divide gives its vanishing point.
///
/// # Errors
/// Returns an error if all four numbers are 0, because they do not represent a point.
pub fn explain_homogeneous_point(
    chain: &TransformChain,
    point: HPoint<World>,
) -> Result<Explanation, String> {
    let numbers = <[f64; 4]>::from(point);
    if numbers == [0.0; 4] {
        return Err("(0, 0, 0, 0) is neither a point nor a direction".to_owned());
    }
    let [x, y, z, w] = numbers.map(format_number);
    let view = chain.world_to_view().raw() * point.raw();
    let clip = chain.world_to_clip().transform_hpoint(point);
    let mut projection = chain.projection_step(&[]);
    chain.add_clip_items(&mut projection, "", clip);
    let mut steps = vec![
        homogeneous_step(point),
        chain.camera_step(&[]).with_item("view", "view", view.to_array()),
        projection,
    ];
    let verdict = if point.w() == 0.0 {
        describe_vanishing_point(chain, clip)
    } else {
        let normalized = HPoint::from_raw(clip.raw() / point.w());
        steps.push(chain.outcode_step(&[("", normalized)]));
        let code = chain.clip_volume().outcode(normalized);
        format!("Relative to the view volume, it is {}.", describe_outcode(code))
    };
    steps.extend(chain.screen_steps(&[("", clip)]));
    Ok(Explanation {
        subject: format!("The homogeneous point ({x}, {y}, {z}, {w}) in world space"),
        steps,
        verdict,
    })
}

/// Returns the step with the point that the four numbers represent.
pub(super) fn homogeneous_step<S: homog::Space>(point: HPoint<S>) -> Step {
    let step = Step::new("homogeneous", "The four numbers", Some("HO-1, HO-2")).with_item(
        "numbers",
        "x, y, z, w",
        <[f64; 4]>::from(point),
    );
    match point.divide() {
        Some(divided) => step
            .with_item("stands_for", "the point", <[f64; 3]>::from(divided))
            .with_item("multiple", "times", point.w()),
        None => step.with_item("stands_for", "the direction", point.raw().truncate().to_array()),
    }
}

/// Describes the vanishing point of a direction in words.
fn describe_vanishing_point(chain: &TransformChain, clip: HPoint<Clip>) -> String {
    match chain.project_to_screen(clip) {
        Some(screen) => {
            let [x, y, _] = <[f64; 3]>::from(screen).map(format_number);
            format!("Lines in this direction vanish at pixel position ({x}, {y}).")
        }
        None => "Lines in this direction stay parallel in the picture: w is 0.".to_owned(),
    }
}
