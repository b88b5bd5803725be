//! DXF output: writes a page as a Drawing Exchange Format file in ASCII, version R2000 (AC1015).
//!
//! ```text
//!   HEADER     version, unit, extents, the next handle
//!   CLASSES    the classes of the objects
//!   TABLES     line types, layers, the text style, …      each record has a handle and an owner
//!   BLOCKS     *Model_Space, which owns the entities, and *Paper_Space
//!   ENTITIES   LWPOLYLINE, LINE, CIRCLE, ARC, HATCH, TEXT
//!   OBJECTS    the dictionaries and layouts that readers require
//! ```
//!
//! | on the page | in the file |
//! | --- | --- |
//! | layer and object | a layer (`visible-crease.shaft`) with the pen color, width and line type |
//! | polyline | LWPOLYLINE or LINE; arcs become bulges, ARC or CIRCLE: see `arcs` |
//! | text | TEXT in the font `txt`, fitted to its width in the other formats |
//! | hatching | HATCH with its pattern and outlines |
//! | filled area | HATCH, solid |
//! | image | omitted: the format cannot embed images |
//!
//! Each color is the nearest of AutoCAD's 255. Blacks and whites are color 7, which contrasts with
//! the screen. Characters outside ASCII are written as codes: Ø is `\U+00D8`. The file has no
//! dates: identical pages give identical bytes.

mod color_index;
mod entities;
mod layers;
mod skeleton;
mod tags;

use crate::page::{Page, PageContent, to_micrometers};
use entities::EntityWriter;
use glam::DVec2;
use layers::LayerTable;
use tags::TagWriter;

/// The unit of a drawing, recorded in the header variable `$INSUNITS`.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum DxfUnit {
    /// 25.4 mm.
    Inch,
    /// 304.8 mm.
    Foot,
    /// 1 mm.
    Millimeter,
    /// 10 mm.
    Centimeter,
    /// 1000 mm.
    Meter,
    /// 0.001 mm.
    Micrometer,
}

/// Options for the coordinates and arcs of a DXF file.
///
/// ```
/// use page::{DxfOptions, Page};
/// use glam::DVec2;
///
/// let a4: Page = Page::new(DVec2::new(210.0, 297.0), "empty", None);
/// let options = DxfOptions::on_paper(&a4);
/// assert_eq!(options.origin, DVec2::new(0.0, 297.0));
/// assert!(a4.to_dxf(&options).starts_with(b"0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1015\n"));
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct DxfOptions {
    /// The unit of the drawing, or `None` if it is unknown.
    pub unit: Option<DxfUnit>,
    /// Drawing units per millimeter of the page, greater than 0.
    pub units_per_millimeter: f64,
    /// The page point that becomes (0, 0), in millimeters from the upper left corner of the page.
    /// In the file, y points up.
    pub origin: DVec2,
    /// The tolerance for arcs, in millimeters on the page. Points within this distance of a circle
    /// become an arc. With 0, all lines are straight.
    pub arc_tolerance: f64,
}

impl DxfOptions {
    /// The default tolerance for arcs: 0.005 mm.
    pub const DEFAULT_ARC_TOLERANCE: f64 = 0.005;

    /// Returns options for coordinates in millimeters on paper, measured from its lower left
    /// corner.
    #[must_use]
    pub const fn on_paper<W>(page: &Page<W>) -> Self {
        Self {
            unit: Some(DxfUnit::Millimeter),
            units_per_millimeter: 1.0,
            origin: DVec2::new(0.0, page.size.y),
            arc_tolerance: Self::DEFAULT_ARC_TOLERANCE,
        }
    }
}

impl<W> Page<W> {
    /// Writes the page as a DXF file; images are skipped.
    #[must_use]
    pub fn to_dxf(&self, options: &DxfOptions) -> Vec<u8> {
        write_page(self.content(), options)
    }
}

fn write_page(page: PageContent<'_>, options: &DxfOptions) -> Vec<u8> {
    let layers = LayerTable::new(page, options.units_per_millimeter);
    let mut entities = EntityWriter::new(options);
    for (index, layer) in page.layers.iter().enumerate() {
        for (at, group) in layer.groups.iter().enumerate() {
            let scale = layers.line_type_scale(index, at);
            entities.write_group(layers.name(index, at), scale, group);
        }
    }
    let corner = to_micrometers(page.size);
    let bounds = entities.bounds().unwrap_or_else(|| {
        entities::bounds_of([[0, corner[1]], [corner[0], 0]].map(|point| entities.place(point)))
    });
    let (entities, next_handle) = entities.finish();
    let mut file = TagWriter::default();
    skeleton::write_header(&mut file, options.unit, bounds, next_handle);
    skeleton::write_tables(&mut file, &layers, bounds);
    file.begin_section("ENTITIES");
    file.append(&entities);
    file.end_section();
    skeleton::write_objects(&mut file, bounds);
    file.finish()
}

#[cfg(test)]
mod tests;
