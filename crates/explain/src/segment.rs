//! Explains a segment: clipping against the view volume before the divide (CL-2).
//!
//! ```text
//!  p(t) = a + t (b − a) in clip space;  each plane cuts at t = d(a) / (d(a) − d(b))
//! ```
//! d is the signed distance from a plane, such as w − x for the right plane. The visible part runs
//! from the largest t at which the segment enters to the smallest at which it leaves (Liang and
//! Barsky, 1984).

use super::foreshortening::foreshortening_step;
use super::plain_text::format_number;
use super::transform_chain::{TransformChain, describe_outcode};
use super::{Explanation, Step};
use clip::{Volume, clip_segment, segment_outcomes};
use homog::{Clip, HPoint, Point, World};

/// Follows a world segment through every stage.
///
/// t is a parameter in clip space before the divide, so it is affine in the world: t = 0.5 is the
/// midpoint of the world segment, not of its image. The screen steps show the ends of the visible
/// part, labeled `start` and `end`.
#[must_use]
pub fn explain_segment(chain: &TransformChain, ends: [Point<World>; 2]) -> Explanation {
    let named = [("a", ends[0]), ("b", ends[1])];
    let [a, b] = ends.map(|end| chain.world_to_clip().transform_point(end));
    let mut steps = vec![
        chain.camera_step(&named),
        chain.projection_step(&named),
        chain.outcode_step(&[("a", a), ("b", b)]),
    ];
    steps.push(foreshortening_step(a, b));
    let volume = chain.clip_volume();
    let clipped = clip_segment(a, b, &volume);
    steps.push(clip_step(chain, a, b, clipped.as_ref()));
    let verdict = match &clipped {
        Some(left) => {
            steps.extend(chain.screen_steps(&[("start", left.start), ("end", left.end)]));
            let percentage = 100.0 * (left.t1 - left.t0);
            format!(
                "{}% of it, from t = {} to t = {}, is inside the view volume.",
                format_number(percentage),
                format_number(left.t0),
                format_number(left.t1)
            )
        }
        None => {
            format!("None of it is in the picture: it is {}.", describe_rejection(a, b, &volume))
        }
    };
    Explanation { subject: "A segment from a to b".to_owned(), steps, verdict }
}

/// Returns the clipping step: the planes through which the visible part enters and leaves.
///
/// `left` is `None` for a segment rejected trivially or because its interval is empty (t₀ > t₁);
/// the step then names the planes that reject it.
fn clip_step(
    chain: &TransformChain,
    a: HPoint<Clip>,
    b: HPoint<Clip>,
    left: Option<&clip::ClippedSegment>,
) -> Step {
    let step = Step::new("clip", "Clipping, in homogeneous space", Some("CL-2"));
    let Some(left) = left else {
        let why = describe_rejection(a, b, &chain.clip_volume());
        return step.with_item("rejected", "rejected", why);
    };
    let plane = |plane: Option<clip::PlaneIndex>, otherwise: &str| {
        plane.map_or_else(|| otherwise.to_owned(), |plane| format!("the {plane} plane"))
    };
    step.with_item("enters", "enters through", plane(left.enter, "nothing: a is inside"))
        .with_item("leaves", "leaves through", plane(left.exit, "nothing: b is inside"))
        .with_item("t", "from t to t", [left.t0, left.t1])
        .with_item("start", "start, clip", <[f64; 4]>::from(left.start))
        .with_item("end", "end, clip", <[f64; 4]>::from(left.end))
}

/// Describes why a segment is rejected.
///
/// Two planes can reject a segment that passes outside a corner of the volume, although it is not
/// completely outside either of them.
fn describe_rejection(a: HPoint<Clip>, b: HPoint<Clip>, volume: &Volume) -> String {
    let planes = describe_outcode(segment_outcomes(a, b, volume).rejected);
    let is_outside = !(volume.outcode(a) & volume.outcode(b)).is_inside();
    if is_outside { planes } else { planes.replacen("outside", "rejected by", 1) }
}
