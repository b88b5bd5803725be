//! The scale of a drawing in DXF: 1:1 in the units of the models, if such a scale exists.
//!
//! ```text
//!   one parallel view     units of the models; (0, 0) is the image of the world's origin
//!   perspective, insets   millimeters of the page, from its lower left corner
//! ```
//! In a parallel view, lengths parallel to the picture plane are true, so the front view of a plate
//! has the size of the plate. Other lengths are foreshortened by the projection, and the file is
//! not enlarged to compensate.

use drawing::Page;
use glam::DVec2;
use homog::Point;
use model::LengthUnit;
use page::{DxfOptions, DxfUnit, MILLIMETERS_PER_PIXEL};
use scene::Scene;

/// Returns the DXF unit, scale and origin for a page from [`draw_lines`](super::draw_lines()).
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

/// Returns the image of the world origin in millimeters on the page, or `None` if it is so far away
/// that coordinates would lose all precision.
fn origin_on_page(scene: &Scene, page: &Page) -> Option<DVec2> {
    /// The maximum distance, as a multiple of the page's longer side.
    const MAX_DISTANCE: f64 = 1e6;
    let image = scene.view_projection.world_to_clip().transform_point(Point::ORIGIN).raw();
    let ndc = image.truncate().truncate() / image.w;
    let origin = DVec2::new(1.0 + ndc.x, 1.0 - ndc.y) * 0.5 * page.size;
    (origin.abs().max_element() <= MAX_DISTANCE * page.size.max_element()).then_some(origin)
}

/// Returns the common unit of all model files, or `None` if their units differ.
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
