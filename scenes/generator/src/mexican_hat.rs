//! The Mexican hat: a height field over a square grid.
//!
//! Grid indices map to `[-1, 1]²` by `x = 2i/(rows−1) − 1`, `z = 2j/(columns−1) − 1`. The height is
//! `sin(R)/R` with `R = 2π√(x² + z²)`. It is 1 in the middle. The first trough is a circle with
//! radius 0.715, and the second crest, with radius 1.229, crosses only the corners. Angel's
//! *Interactive Computer Graphics* draws the same surface.

use crate::document::{Document, PrimitiveMode};
use crate::mesh::Mesh;
use crate::palette::{BRICK, CLAY, CREAM, Color, INK, OCHRE, SAND, SKY, TEAL, color_ramp};
use glam::{DVec3, dvec3};
use serde_json::json;
use std::f64::consts::TAU;

const ROWS: u32 = 49;
const COLUMNS: u32 = 49;
/// The vertical scale: the peak is about as high as half the width of the brim.
const HEIGHT: f64 = 0.9;

/// Builds the surface with vertex colors by height.
pub(crate) fn hat_surface() -> Document {
    let mut mesh = Mesh::default();
    for (x, z) in grid_points() {
        let hat = HatPoint::at(x, z);
        mesh.add_vertex(dvec3(x, HEIGHT * hat.height, z), hat.normal());
        mesh.colors.push(height_color(hat.height));
    }
    mesh.add_grid_triangles(0, COLUMNS, ROWS);
    let mut document = Document::default();
    let material = document.add_double_sided("coloured by height", Color(255, 255, 255));
    let mesh = document.add_mesh("Mexican hat", &[(&mesh, material)]);
    document.add_root("Mexican hat", Some(mesh), json!({}));
    document
}

/// Builds every second row and column of the grid as polylines, each a LINE_STRIP without indices.
pub(crate) fn hat_lines() -> Document {
    let mut document = Document::default();
    let ink = document.add_material("ink", INK);
    let vertices: Vec<DVec3> =
        grid_points().map(|(x, z)| dvec3(x, HEIGHT * HatPoint::at(x, z).height, z)).collect();
    let strip = |places: Vec<u32>| {
        let positions = places.iter().map(|place| vertices[*place as usize]).collect();
        Mesh { positions, ..Mesh::default() }
    };
    let row = |i: u32| (0..COLUMNS).map(|j| i * COLUMNS + j).collect();
    let column = |j: u32| (0..ROWS).map(|i| i * COLUMNS + j).collect();
    let rows = (0..ROWS).step_by(2).map(row);
    let strips: Vec<Mesh> = rows.chain((0..COLUMNS).step_by(2).map(column)).map(strip).collect();
    let parts: Vec<_> = strips.iter().map(|strip| (strip, ink, PrimitiveMode::LineStrip)).collect();
    let mesh = document.add_mesh_of_modes("Mexican hat in lines", &parts);
    document.add_root("Mexican hat in lines", Some(mesh), json!({}));
    document
}

/// Returns the grid points, row by row.
fn grid_points() -> impl Iterator<Item = (f64, f64)> {
    let place = |index, count| 2.0 * f64::from(index) / f64::from(count - 1) - 1.0;
    (0..ROWS).flat_map(move |i| (0..COLUMNS).map(move |j| (place(i, ROWS), place(j, COLUMNS))))
}

/// Height and slopes of the surface at a grid point.
struct HatPoint {
    height: f64,
    slope_x: f64,
    slope_z: f64,
}

impl HatPoint {
    /// Computes height and slopes: with `s = sin(R)/R`, `ds/dx = (cos R − s)/R · dR/dx` and
    /// `dR/dx = (2π)² x / R`.
    fn at(x: f64, z: f64) -> Self {
        let big_r = TAU * libm::sqrt(x * x + z * z);
        if big_r < 1e-9 {
            return Self { height: 1.0, slope_x: 0.0, slope_z: 0.0 };
        }
        let (sine, cosine) = libm::sincos(big_r);
        let height = sine / big_r;
        let slope = (cosine - height) / big_r * (TAU * TAU / big_r);
        Self { height, slope_x: slope * x, slope_z: slope * z }
    }

    fn normal(&self) -> DVec3 {
        dvec3(-HEIGHT * self.slope_x, 1.0, -HEIGHT * self.slope_z).normalize()
    }
}

/// Returns the color of a height; the ramp runs from the trough, at −0.2172, to the peak.
fn height_color(height: f64) -> [f64; 3] {
    let stops = [TEAL, SKY, CREAM, SAND, OCHRE, CLAY, BRICK];
    color_ramp(&stops.map(Color::linear), (height + 0.2172) / 1.2172)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_grid_reaches_all_four_corners() {
        let places: Vec<_> = grid_points().collect();
        assert_eq!(places.len() as u32, ROWS * COLUMNS);
        assert_eq!((places[0], *places.last().unwrap()), ((-1.0, -1.0), (1.0, 1.0)));
        assert_eq!(places[COLUMNS as usize - 1], (-1.0, 1.0));
    }

    #[test]
    fn slopes_are_the_derivatives_of_the_height() {
        let step = 1e-6;
        for (x, z) in [(0.1, 0.2), (-0.7, 0.4), (0.9, -0.9)] {
            let across = (HatPoint::at(x + step, z).height - HatPoint::at(x - step, z).height)
                / (2.0 * step);
            assert!((across - HatPoint::at(x, z).slope_x).abs() < 1e-8);
        }
    }
}
