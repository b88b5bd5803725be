//! Draws a ten-centimeter ruler as SVG, true to scale when printed.
//!
//! ```text
//! cargo run -p alberti-page --example ruler > ruler.svg
//! ```

#![allow(clippy::print_stdout, reason = "the example writes to standard output")]

use glam::DVec2;
use page::{Group, Label, Layer, Page, Pen, Polyline, TextAlign};

fn main() {
    let mut page: Page = Page::new(DVec2::new(120.0, 25.0), "a ruler", Some([255; 3]));
    let mut layer = Layer::new("marks", "Ruler marks", Pen::solid(0.25, [0, 0, 0]));
    for millimeter in 0..=100_u32 {
        let x = 10.0 + f64::from(millimeter);
        let length = if millimeter % 10 == 0 { 8.0 } else { 4.0 };
        let mark = [DVec2::new(x, 5.0), DVec2::new(x, 5.0 + length)];
        let strokes = Polyline::through_points(&mark, false).into_iter().collect();
        layer.groups.push(Group { strokes, ..Group::default() });
        if millimeter % 10 == 0 {
            let text = (millimeter / 10).to_string();
            let label = Label::new(&text, DVec2::new(x, 18.0), 3.5).with_align(TextAlign::Middle);
            layer.groups.push(Group { strokes: label.strokes(), ..Group::default() });
        }
    }
    page.layers.push(layer);
    println!("{}", page.to_svg());
}
