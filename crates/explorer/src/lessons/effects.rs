//! Sentences that several lessons share, on distortion and on the near and far planes.

use crate::facts::Facts;
use crate::number_text::decimals;
use crate::words::{Sentence, sentence};

/// Describes whether the window's shape distorts the picture.
pub(super) fn distortion(facts: &Facts) -> Option<Sentence> {
    let stretch = facts.picture_aspect() / facts.window_aspect()?;
    if (stretch - 1.0).abs() < 5e-3 {
        return Some(sentence(
            "The window and the picture have the same shape, so nothing is distorted.",
            "窗口与图像的宽高比相同：没有变形。",
        ));
    }
    let (window, picture) =
        (decimals(facts.window_aspect()?, 2), decimals(facts.picture_aspect(), 2));
    let stretch = decimals(stretch, 2);
    Some(sentence(
        format!(
            "The window is {window} : 1, but the picture is {picture} : 1, so everything is {stretch} \
             times as wide as it should be."
        ),
        format!(
            "窗口为 {window} : 1，图像为 {picture} : 1：所有物体的宽度是应有宽度的 {stretch} 倍。"
        ),
    ))
}

/// Describes the parts of the model that the near and far planes clip.
pub(super) fn planes_only_clip(facts: &Facts) -> Vec<Sentence> {
    let (Some([nearest, farthest]), [Some(near), Some(far)]) = (facts.model_range, facts.planes)
    else {
        return Vec::new();
    };
    let [near_text, far_text, nearest_text, farthest_text] =
        [near, far, nearest, farthest].map(|distance| decimals(distance, 2));
    let mut all = Vec::new();
    if near > farthest {
        all.push(sentence(
            format!(
                "The near plane, at distance {near_text}, is behind the whole model and clips all of it."
            ),
            format!("近平面 {near_text}：整个模型都在近平面之前，全部被裁掉。"),
        ));
    } else if near > nearest {
        all.push(sentence(
            format!(
                "The near plane, at distance {near_text}, clips the front corner, which is at distance {nearest_text}."
            ),
            format!("近平面 {near_text}：距离 {nearest_text} 处的前角被裁掉。"),
        ));
    }
    if far < nearest {
        all.push(sentence(
            format!(
                "The far plane, at distance {far_text}, is in front of the whole model and clips all of it."
            ),
            format!("远平面 {far_text}：整个模型都在远平面之后，全部被裁掉。"),
        ));
    } else if far < farthest {
        all.push(sentence(
            format!(
                "The far plane, at distance {far_text}, clips the back, which extends to distance {farthest_text}."
            ),
            format!("远平面 {far_text}：最远到 {farthest_text} 的后部被裁掉。"),
        ));
    }
    all
}
