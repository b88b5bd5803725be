//! PDF output: writes pages as a Portable Document Format 1.7 file (ISO 32000-1), in millimeters.
//!
//! ```text
//!   1 catalog ─► 2 page tree ─► 4 page ─► 5 content stream      (two objects for each page)
//!       │                         │
//!       │ OCProperties            └─ resources ─► layers, images
//!       ▼
//!   optional content groups, one for each layer;  3 document information
//! ```
//!
//! Each page's content starts with a matrix that changes the unit from points to millimeters and
//! flips y. After that, the coordinates are the same as in the SVG. Layers are optional content
//! groups, which viewers can switch on and off. Streams are compressed with DEFLATE.
//!
//! Text is drawn as strokes, with invisible glyphs over them for searching and copying.
//!
//! The file has no dates or random identifiers: identical pages give identical bytes on every
//! machine.

mod invisible_text;

use super::fixed_decimal::write_thousandths;
use super::page::{
    Cap, GroupContent, Ink, Join, Layer, Page, PageContent, PagePoint, Pen, PlacedImage, Polyline,
};
use invisible_text::TextFonts;
use pdf_writer::{Dict, Filter, Finish, Name, Pdf, Rect, Ref, TextStr};
use picture::Picture;

/// Points per millimeter. An inch has 72 points.
const POINTS_PER_MILLIMETER: f64 = 72.0 / super::page::MILLIMETERS_PER_INCH;

/// The compression level of streams (0 to 10). Higher levels are slower for little gain.
const DEFLATE_LEVEL: u8 = 6;

/// The maximum length of a layer name, in characters.
const MAX_LAYER_NAME: usize = 200;

/// The ids of a file's indirect objects: three fixed ids, two for each page, one for each layer,
/// two for each image, then the fonts.
///
/// Ids depend only on counts, so objects can refer to objects that have not been written yet.
struct ObjectIds {
    pages: usize,
    layers: usize,
    images: usize,
}

impl ObjectIds {
    const CATALOG: Ref = Ref::new(1);
    const PAGE_TREE: Ref = Ref::new(2);
    const INFO: Ref = Ref::new(3);

    /// Returns the id of a page object.
    fn page_id(index: usize) -> Ref {
        Ref::new(4 + 2 * index as i32)
    }

    /// Returns the id of a page's content stream.
    fn content_id(index: usize) -> Ref {
        Ref::new(5 + 2 * index as i32)
    }

    /// Returns the id of a layer's optional content group.
    fn layer_id(&self, index: usize) -> Ref {
        Ref::new(4 + 2 * self.pages as i32 + index as i32)
    }

    /// Returns the ids of an image's color object and of its alpha object, the soft mask.
    fn image_ids(&self, index: usize) -> [Ref; 2] {
        let first = 4 + 2 * self.pages + self.layers + 2 * index;
        [first, first + 1].map(|id| Ref::new(id as i32))
    }

    /// Returns the id of the first font object.
    fn first_of_fonts(&self) -> usize {
        4 + 2 * self.pages + self.layers + 2 * self.images
    }
}

/// Returns the pages as one PDF, titled after the first page.
///
/// ```
/// use page::{Page, to_pdf};
/// use glam::DVec2;
///
/// let a4: Page = Page::new(DVec2::new(210.0, 297.0), "empty", Some([255; 3]));
/// let file = to_pdf(&[a4]);
/// assert!(file.starts_with(b"%PDF-1.7"));
/// ```
#[must_use]
pub fn to_pdf<W>(pages: &[Page<W>]) -> Vec<u8> {
    let pages: Vec<PageContent<'_>> = pages.iter().map(Page::content).collect();
    write_file(&pages)
}

fn write_file(pages: &[PageContent<'_>]) -> Vec<u8> {
    let mut pdf = Pdf::new();
    let layers = pages.iter().map(|page| page.layers.len()).sum();
    let images = pages.iter().map(|page| page.images.len()).sum();
    let ids = ObjectIds { pages: pages.len(), layers, images };
    let fonts = TextFonts::new(pages);
    let (mut layers, mut pictures) = (0, 0);
    for (index, page) in pages.iter().enumerate() {
        write_page(&mut pdf, &ids, &fonts, index, *page, [layers, pictures]);
        for (at, pasted) in page.images.iter().enumerate() {
            write_image(&mut pdf, ids.image_ids(pictures + at), &pasted.picture);
        }
        pictures += page.images.len();
        for (at, layer) in page.layers.iter().enumerate() {
            let mut group = pdf.indirect(ids.layer_id(layers + at)).dict();
            group.pair(Name(b"Type"), Name(b"OCG"));
            let name: String = layer.title.chars().take(MAX_LAYER_NAME).collect();
            group.pair(Name(b"Name"), TextStr(&name));
        }
        layers += page.layers.len();
    }
    fonts.write(&mut pdf, ids.first_of_fonts());
    let kids = (0..pages.len()).map(ObjectIds::page_id);
    pdf.pages(ObjectIds::PAGE_TREE).kids(kids).count(pages.len() as i32);
    let mut catalog = pdf.catalog(ObjectIds::CATALOG);
    catalog.pages(ObjectIds::PAGE_TREE);
    if layers > 0 {
        write_optional_content(&mut catalog, (0..layers).map(|layer| ids.layer_id(layer)));
    }
    catalog.finish();
    let mut info = pdf.document_info(ObjectIds::INFO);
    info.title(TextStr(pages.first().map_or("", |page| page.title)));
    info.producer(TextStr("alberti"));
    info.finish();
    pdf.finish()
}

/// Writes `OCProperties`, the catalog's list of layers in drawing order, with its required default
/// configuration `D`.
fn write_optional_content(catalog: &mut Dict<'_>, layers: impl Iterator<Item = Ref> + Clone) {
    let mut properties = catalog.insert(Name(b"OCProperties")).dict();
    properties.insert(Name(b"OCGs")).array().items(layers.clone());
    let mut default_config = properties.insert(Name(b"D")).dict();
    default_config.insert(Name(b"Order")).array().items(layers);
}

/// Writes an image as two XObjects: the RGB colors, and the alpha channel as a soft mask.
///
/// PDF does not support interleaved alpha. Separate channels also compress better.
fn write_image(pdf: &mut Pdf, [color, mask]: [Ref; 2], picture: &Picture) {
    let (width, height) = (picture.width as i32, picture.height as i32);
    let packed = |bytes: Vec<u8>| miniz_oxide::deflate::compress_to_vec_zlib(&bytes, DEFLATE_LEVEL);
    let colors = packed(picture.pixels.iter().flat_map(|[r, g, b, _]| [*r, *g, *b]).collect());
    let mut image = pdf.image_xobject(color, &colors);
    image.width(width).height(height).bits_per_component(8).s_mask(mask);
    image.color_space().device_rgb();
    image.filter(Filter::FlateDecode);
    image.finish();
    let alphas = packed(picture.pixels.iter().map(|pixel| pixel[3]).collect());
    let mut image = pdf.image_xobject(mask, &alphas);
    image.width(width).height(height).bits_per_component(8);
    image.color_space().device_gray();
    image.filter(Filter::FlateDecode);
}

/// Writes the page object, its resources and its content stream.
///
/// `layers` and `pictures` are the numbers of layers and images on earlier pages. Object ids depend
/// on them.
fn write_page(
    pdf: &mut Pdf,
    ids: &ObjectIds,
    fonts: &TextFonts,
    index: usize,
    page: PageContent<'_>,
    [layers, pictures]: [usize; 2],
) {
    let [width, height] = page.size.to_array().map(|side| (side * POINTS_PER_MILLIMETER) as f32);
    let mut entry = pdf.page(ObjectIds::page_id(index));
    entry.media_box(Rect::new(0.0, 0.0, width, height));
    entry.parent(ObjectIds::PAGE_TREE);
    entry.contents(ObjectIds::content_id(index));
    let mut resources = entry.resources();
    if !page.layers.is_empty() {
        let mut properties = resources.insert(Name(b"Properties")).dict();
        for at in 0..page.layers.len() {
            let name = format!("L{at}");
            properties.pair(Name(name.as_bytes()), ids.layer_id(layers + at));
        }
    }
    if !page.images.is_empty() {
        let mut objects = resources.x_objects();
        for at in 0..page.images.len() {
            objects.pair(Name(format!("P{at}").as_bytes()), ids.image_ids(pictures + at)[0]);
        }
    }
    if fonts.count() > 0 {
        let mut list = resources.fonts();
        for font in 0..fonts.count() {
            let id = TextFonts::font_id(ids.first_of_fonts(), font);
            list.pair(Name(TextFonts::name(font).as_bytes()), id);
        }
    }
    resources.finish();
    entry.finish();
    let content = page_content(page, fonts);
    let content = miniz_oxide::deflate::compress_to_vec_zlib(&content, DEFLATE_LEVEL);
    pdf.stream(ObjectIds::content_id(index), &content).filter(Filter::FlateDecode);
}

/// Returns the uncompressed content stream of a page.
///
/// ```text
///   2.83… 0 0 −2.83… 0 height cm      points to millimeters, y down
///   1 1 1 rg  0 0 210 297 re f        the paper
///   q  w 0 0 −h x y+h cm  /P0 Do  Q   an image
///   /OC /L0 BDC  …  EMC               a layer
/// ```
fn page_content(page: PageContent<'_>, fonts: &TextFonts) -> Vec<u8> {
    let mut out = ContentStream(Vec::new());
    let height = page.size.y * POINTS_PER_MILLIMETER;
    out.push_text(&format!(
        "{POINTS_PER_MILLIMETER:.9} 0 0 -{POINTS_PER_MILLIMETER:.9} 0 {height:.6} cm\n"
    ));
    if let Some(paper) = page.paper {
        let [x, y] = super::page::to_micrometers(page.size);
        out.set_color(paper, "rg");
        out.push_text("0 0 ");
        out.push_point([x, y]);
        out.push_text("re f\n");
    }
    for (at, PlacedImage { corner, size, .. }) in page.images.iter().enumerate() {
        // PDF draws images in the unit square with y up.
        out.push_text("q ");
        out.push_point([size[0], 0]);
        out.push_point([0, -size[1]]);
        out.push_point([corner[0], corner[1] + size[1]]);
        out.push_text(&format!("cm /P{at} Do Q\n"));
    }
    for (at, layer) in page.layers.iter().enumerate() {
        out.push_text(&format!("/OC /L{at} BDC\n"));
        out.draw_layer(layer);
        for group in &layer.groups {
            if let GroupContent::Text(line) = &group.content {
                out.0.extend(fonts.show(line));
            }
        }
        out.push_text("EMC\n");
    }
    out.0
}

/// A content stream under construction: operands in postfix order, one operator per line.
struct ContentStream(Vec<u8>);

impl ContentStream {
    /// Appends text, such as an operator.
    fn push_text(&mut self, text: &str) {
        self.0.extend_from_slice(text.as_bytes());
    }

    /// Appends a number given in thousandths, followed by a space.
    fn push_number(&mut self, thousandth: i64) {
        write_thousandths(&mut self.0, thousandth);
        self.0.push(b' ');
    }

    /// Appends a length in millimeters.
    fn push_length(&mut self, millimeters: f64) {
        self.push_number(libm::round(millimeters * 1000.0) as i64);
    }

    /// Appends a point in millimeters from its coordinates in micrometers.
    fn push_point(&mut self, [x, y]: PagePoint) {
        self.push_number(x.into());
        self.push_number(y.into());
    }

    /// Sets a color with `RG` for strokes or `rg` for fills. The channels are written as numbers
    /// from 0 to 1, rounded to thousandths.
    fn set_color(&mut self, ink: Ink, command: &str) {
        for channel in ink {
            self.push_number((i64::from(channel) * 1000 + 127) / 255);
        }
        self.push_text(command);
        self.0.push(b'\n');
    }

    /// Draws the strokes and fills of a layer.
    ///
    /// All continuous strokes of a group share one path and one `S` operator; each dashed stroke
    /// has its own pattern. Fills use the even-odd rule (`f*`).
    fn draw_layer(&mut self, layer: &Layer) {
        self.set_pen(&layer.pen);
        for group in &layer.groups {
            if layer.pen.dashes.is_empty() {
                group.strokes.iter().for_each(|line| self.push_path(line));
                self.push_text(if group.strokes.is_empty() { "" } else { "S\n" });
            } else {
                group.strokes.iter().for_each(|line| self.stroke_dashed(line, &layer.pen));
            }
            if !group.fills.is_empty() {
                group.fills.iter().for_each(|line| self.push_path(line));
                self.push_text("f*\n");
            }
        }
    }

    /// Sets the colors, line width, cap, join and miter limit of a pen.
    fn set_pen(&mut self, pen: &Pen) {
        self.set_color(pen.ink, "RG");
        self.set_color(pen.ink, "rg");
        self.push_length(pen.width);
        self.push_text("w\n");
        self.set_dashes(&[]);
        let cap = match pen.cap {
            Cap::Butt => 0,
            Cap::Round => 1,
            Cap::Square => 2,
        };
        let join = match pen.join {
            Join::Miter => 0,
            Join::Round => 1,
            Join::Bevel => 2,
        };
        self.push_text(&format!("{cap} J {join} j 4 M\n"));
    }

    /// Sets the dash pattern.
    fn set_dashes(&mut self, dashes: &[f64]) {
        self.push_text("[");
        dashes.iter().for_each(|&dash| self.push_length(dash));
        self.push_text("] 0 d\n");
    }

    /// Strokes one line with dashes fitted to its length.
    fn stroke_dashed(&mut self, line: &Polyline, pen: &Pen) {
        self.set_dashes(&pen.fitted_dashes(line));
        self.push_path(line);
        self.push_text("S\n");
    }

    /// Appends a path.
    fn push_path(&mut self, line: &Polyline) {
        for (at, point) in line.points.iter().enumerate() {
            self.push_point(*point);
            self.push_text(if at == 0 { "m\n" } else { "l\n" });
        }
        if line.closed {
            self.push_text("h\n");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::page::{Group, Layer};
    use super::*;
    use glam::DVec2;

    #[test]
    fn a_page_has_the_expected_content_stream() {
        let mut page: Page =
            Page::new(DVec2::new(210.0, 297.0), "A (page) \\ Ä", Some([255, 128, 0]));
        let mut pen = Pen::solid(0.25, [0; 3]);
        pen.dashes = vec![3.0, 0.75];
        let mut layer = Layer::new("a", "b", pen);
        let strokes =
            vec![Polyline { points: vec![[10_000, -500], [110_000, 500]], closed: false }];
        layer.groups.push(Group { strokes, ..Group::default() });
        page.layers.push(layer);
        let text =
            String::from_utf8(page_content(page.content(), &TextFonts::new(&[]))).expect("text");
        let expected = "2.834645669 0 0 -2.834645669 0 841.889764 cm\n1 .502 0 rg\n0 0 210 297 re f\n/OC /L0 BDC\n\
            0 0 0 RG\n0 0 0 rg\n.25 w\n[] 0 d\n1 J 1 j 4 M\n[2.985 .746 ] 0 d\n10 -.5 m\n110 .5 l\nS\nEMC\n";
        assert_eq!(text, expected);
        let file = to_pdf(&[page.clone(), page]);
        assert!(file.starts_with(b"%PDF-1.7") && file.ends_with(b"%%EOF"));
        let holds = |word: &[u8]| file.windows(word.len()).any(|part| part == word);
        assert!(holds(b"/Count 2") && holds(b"/OCG") && !holds(b"/ID") && !holds(b"Date"));
    }
}
