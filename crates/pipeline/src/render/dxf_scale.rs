//! The scale of a scene's drawing in DXF: 1:1 in the units of the models if such a scale exists.
//!
//! ```text
//!   one parallel view     units of the models; (0, 0) is the image of the world's origin
//!   perspective, insets   millimeters of the page, from its lower left corner
//! ```
//! In a parallel view, lengths parallel to the picture plane are true, so that the front view of a
//! plate is the plate. Others are shortened according to the projection; the file is not enlarged
//! to compensate.

use drawing::Page;
use glam::DVec2;
use homog::Point;
use model::LengthUnit;
use page::{DxfOptions, DxfUnit, MILLIMETERS_PER_PIXEL};
use scene::Scene;

/// The coordinates of a page of [`draw_lines`](super::draw_lines()) in a DXF file.
#[must_use]
pub fn dxf_options(scene: &Scene, page: &Page) -> DxfOptions {
    let on_paper = DxfOptions::on_paper(page);
    let scale = scene.pixels_per_unit().filter(|_| scene.insets.is_empty());
    let Some((pixels_per_unit, origin)) = scale.zip(origin_on_page(scene, page)) else {
        return on_paper;
    };
    DxfOptions {
        unit: common_unit(scene).map(dxf_unit),
        units_per_millimeter: 1.0 / (pixels_per_unit * MILLIMETERS_PER_PIXEL),
        origin,
        ..on_paper
    }
}

/// The image of the world's origin in millimeters on the page; `None` if it is too far away for
/// coordinates to keep any digits.
fn origin_on_page(scene: &Scene, page: &Page) -> Option<DVec2> {
    /// The maximum distance, as a multiple of the page's side.
    const MAX_DISTANCE: f64 = 1e6;
    let image = scene.view_projection.world_to_clip().transform_point(Point::ORIGIN).raw();
    let ndc = image.truncate().truncate() / image.w;
    let origin = DVec2::new(1.0 + ndc.x, 1.0 - ndc.y) * 0.5 * page.size;
    (origin.abs().max_element() <= MAX_DISTANCE * page.size.max_element()).then_some(origin)
}

/// The common unit of all model files; `None` if they differ.
fn common_unit(scene: &Scene) -> Option<LengthUnit> {
    let mut units = scene.models.iter().map(|placed| placed.model.length_unit);
    let first = units.next().unwrap_or_default();
    units.all(|unit| unit == first).then_some(first)
}

const fn dxf_unit(unit: LengthUnit) -> DxfUnit {
    match unit {
        LengthUnit::Micrometer => DxfUnit::Micrometer,
        LengthUnit::Millimeter => DxfUnit::Millimeter,
        LengthUnit::Centimeter => DxfUnit::Centimeter,
        LengthUnit::Meter => DxfUnit::Meter,
        LengthUnit::Inch => DxfUnit::Inch,
        LengthUnit::Foot => DxfUnit::Foot,
    }
}
