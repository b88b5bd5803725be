//! The exercises, by subject.

mod camera;
mod clipping;
mod depth;
mod foreshortening;
mod homogeneous;
mod parallel;
mod perspective;
mod screen;
mod windowing;

use super::Exercise;

/// All exercises, ordered by number.
pub(super) static EXERCISES: [&Exercise; 24] = [
    &windowing::ROWS_FROM_THE_TOP,
    &windowing::ONE_WINDOWING,
    &perspective::THIRD_ROW_OF_P,
    &perspective::ORDER_OF_DEPTHS,
    &homogeneous::MULTIPLES_OF_A_POINT,
    &perspective::INVERSE_OF_P,
    &perspective::NEAR_CORNER,
    &perspective::P_OF_ONE_AND_TWO,
    &perspective::IMAGE_OF_A_POINT,
    &camera::CAMERA_ABOVE,
    &foreshortening::IMAGE_PARAMETER,
    &homogeneous::PLACE_OF_A_POINT,
    &camera::CAMERA_COORDINATES,
    &parallel::CABINET,
    &homogeneous::VANISHING_POINT,
    &depth::DEPTH_ZERO,
    &depth::REVERSED_DEPTH,
    &clipping::CLIPPED_SEGMENT,
    &clipping::OUTCODE,
    &screen::PIXEL_POSITION,
    &windowing::WINDOW_TO_VIEWPORT,
    &screen::TOP_LEFT_RULE,
    &foreshortening::ATTRIBUTE,
    &foreshortening::MIDDLE_OF_THE_IMAGE,
];
