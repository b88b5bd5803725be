//! Convention list: the conventions that are tried for a matrix, each with its rarity.

use homog::NdcY;
use projection::Convention;

const DOWN: NdcY = NdcY::Down;

/// All sixteen combinations of depth range, depth direction, handedness and y direction, with
/// common conventions first.
///
/// The second number is a cost in addition to the digits of the parameters. Reversed left-handed
/// depth in [−1, 1], which no graphics API uses, is the rarest.
pub(crate) const CONVENTIONS: [(Convention, u32); 16] = [
    (Convention::OPENGL, 0),
    (Convention::CHAPTER, 1),
    (Convention::WEBGPU, 1),
    (Convention::VULKAN, 1),
    (Convention::DIRECT3D, 1),
    (Convention::WEBGPU.reversed(), 2),
    (Convention::VULKAN.reversed(), 2),
    (Convention::DIRECT3D.reversed(), 2),
    (Convention::OPENGL.left_handed(), 2),
    (Convention::OPENGL.left_handed().with_ndc_y(DOWN), 2),
    (Convention::DIRECT3D.with_ndc_y(DOWN), 2),
    (Convention::OPENGL.with_ndc_y(DOWN), 3),
    (Convention::DIRECT3D.reversed().with_ndc_y(DOWN), 3),
    (Convention::CHAPTER.with_ndc_y(DOWN), 4),
    (Convention::CHAPTER.left_handed(), 4),
    (Convention::CHAPTER.left_handed().with_ndc_y(DOWN), 4),
];

/// Returns the conventions for a camera in the world: all conventions that look along −z, and those
/// that look along +z with y up.
///
/// A view space that looks along +z with y down is a right-handed view space rotated about x, so
/// the same matrix product can also be read with a view space that looks along −z.
pub(crate) fn placed_conventions() -> impl Iterator<Item = (Convention, u32)> {
    CONVENTIONS
        .into_iter()
        .filter(|(convention, _)| convention.ahead() < 0.0 || convention.top() > 0.0)
}

/// Returns the conventions whose view space looks in the z direction `ahead`, −1 or +1.
pub(crate) fn conventions_looking(ahead: f64) -> impl Iterator<Item = (Convention, u32)> {
    CONVENTIONS.into_iter().filter(move |(convention, _)| convention.ahead() == ahead)
}
