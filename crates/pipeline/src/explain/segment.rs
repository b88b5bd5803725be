//! A segment: where each plane of the view volume cuts it, before the divide (CL-2).

use super::chain::{Chain, planes};
use super::text::number;
use super::{Explanation, Step};
use clip::{clip_segment, segment_fates};
use homog::{Clip, HPoint, Point, World};

/// Follows a segment of the world through every stage.
#[must_use]
pub fn explain_segment(chain: &Chain, ends: [Point<World>; 2]) -> Explanation {
    let named = [("a", ends[0]), ("b", ends[1])];
    let [a, b] = ends.map(|end| chain.world_to_clip().point(end));
    let mut steps = vec![
        chain.camera_step(&named),
        chain.projection_step(&named),
        chain.outcode_step(&[("a", a), ("b", b)]),
    ];
    let volume = chain.volume();
    let left = clip_segment(a, b, &volume);
    steps.push(clip_step(chain, a, b, left.as_ref()));
    let verdict = match &left {
        Some(left) => {
            steps.extend(chain.screen_steps(&[("start", left.start), ("end", left.end)]));
            let share = 100.0 * (left.t1 - left.t0);
            format!(
                "{} % of it, from t = {} to t = {}, is inside the view volume.",
                number(share),
                number(left.t0),
                number(left.t1)
            )
        }
        None => {
            let by = segment_fates(a, b, &volume).rejected;
            format!("None of it is in the picture: it is {}.", planes(by))
        }
    };
    Explanation { subject: "A segment from a to b".to_owned(), steps, verdict }
}

fn clip_step(
    chain: &Chain,
    a: HPoint<Clip>,
    b: HPoint<Clip>,
    left: Option<&clip::ClippedSegment>,
) -> Step {
    let step = Step::new("clip", "Clipping, in homogeneous space", Some("CL-2"));
    let Some(left) = left else {
        let by = segment_fates(a, b, &chain.volume()).rejected;
        return step.with("rejected", "rejected", planes(by));
    };
    let plane = |plane: Option<clip::PlaneIndex>, otherwise: &str| {
        plane.map_or_else(|| otherwise.to_owned(), |plane| format!("the {plane} plane"))
    };
    step.with("enters", "enters through", plane(left.enter, "nothing: a is inside"))
        .with("leaves", "leaves through", plane(left.exit, "nothing: b is inside"))
        .with("t", "from t to t", [left.t0, left.t1])
        .with("start", "start, clip", <[f64; 4]>::from(left.start))
        .with("end", "end, clip", <[f64; 4]>::from(left.end))
}
