//! PDF: pages as a Portable Document Format file, in millimetres.
//!
//! The unit of a page is brought from points to millimetres once, at its beginning, and y is turned down; from there on its numbers
//! are those of the SVG. Layers are optional content, so that a reader can switch them. Nothing in the file depends on the day or
//! on chance: no dates, no identifiers.

use super::fixed::thousandths;
use super::page::{Cap, Ink, Join, Layer, Page, Pasted, Pen, Place, Polyline};
use pdf_writer::{Dict, Filter, Finish, Name, Pdf, Rect, Ref, TextStr};
use shade::Picture;

/// Points in a millimetre: an inch has 72.
const POINTS: f64 = 72.0 / viewport::MILLIMETRES_PER_INCH;

/// How hard streams are compressed, of 10: beyond this it takes longer and gains little.
const EFFORT: u8 = 6;

/// The longest name of a layer that is written, in characters.
const LONGEST_NAME: usize = 200;

/// The numbers of the objects of a file: three at the beginning, two for each page, one for each layer, two for each picture.
struct Numbers {
    pages: usize,
    layers: usize,
}

impl Numbers {
    const CATALOG: Ref = Ref::new(1);
    const TREE: Ref = Ref::new(2);
    const INFO: Ref = Ref::new(3);

    fn page(number: usize) -> Ref {
        Ref::new(4 + 2 * number as i32)
    }

    fn content(number: usize) -> Ref {
        Ref::new(5 + 2 * number as i32)
    }

    fn layer(&self, number: usize) -> Ref {
        Ref::new(4 + 2 * self.pages as i32 + number as i32)
    }

    /// A picture's colours and its alpha.
    fn picture(&self, number: usize) -> [Ref; 2] {
        let first = 4 + 2 * self.pages + self.layers + 2 * number;
        [first, first + 1].map(|number| Ref::new(number as i32))
    }
}

/// The pages as a PDF file; its title is that of the first.
#[must_use]
pub fn to_pdf(pages: &[Page]) -> Vec<u8> {
    let mut pdf = Pdf::new();
    let layers = pages.iter().map(|page| page.layers.len()).sum();
    let numbers = Numbers { pages: pages.len(), layers };
    let (mut layers, mut pictures) = (0, 0);
    for (number, page) in pages.iter().enumerate() {
        write_page(&mut pdf, &numbers, number, page, [layers, pictures]);
        for (at, pasted) in page.pictures.iter().enumerate() {
            write_picture(&mut pdf, numbers.picture(pictures + at), &pasted.picture);
        }
        pictures += page.pictures.len();
        for (at, layer) in page.layers.iter().enumerate() {
            let mut group = pdf.indirect(numbers.layer(layers + at)).dict();
            group.pair(Name(b"Type"), Name(b"OCG"));
            let name: String = layer.title.chars().take(LONGEST_NAME).collect();
            group.pair(Name(b"Name"), TextStr(&name));
        }
        layers += page.layers.len();
    }
    let kids = (0..pages.len()).map(Numbers::page);
    pdf.pages(Numbers::TREE).kids(kids).count(pages.len() as i32);
    let mut catalog = pdf.catalog(Numbers::CATALOG);
    catalog.pages(Numbers::TREE);
    if layers > 0 {
        write_layer_list(&mut catalog, (0..layers).map(|layer| numbers.layer(layer)));
    }
    catalog.finish();
    let mut info = pdf.document_info(Numbers::INFO);
    info.title(TextStr(pages.first().map_or("", |page| &page.title)));
    info.producer(TextStr("alberti"));
    info.finish();
    pdf.finish()
}

fn write_layer_list(catalog: &mut Dict<'_>, layers: impl Iterator<Item = Ref> + Clone) {
    let mut properties = catalog.insert(Name(b"OCProperties")).dict();
    properties.insert(Name(b"OCGs")).array().items(layers.clone());
    let mut usual = properties.insert(Name(b"D")).dict();
    usual.insert(Name(b"Order")).array().items(layers);
}

/// The colours of a picture, and its alpha as a mask.
fn write_picture(pdf: &mut Pdf, [color, mask]: [Ref; 2], picture: &Picture) {
    let (width, height) = (picture.width as i32, picture.height as i32);
    let packed = |bytes: Vec<u8>| miniz_oxide::deflate::compress_to_vec_zlib(&bytes, EFFORT);
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

/// A page; its first layer and its first picture have these numbers.
fn write_page(
    pdf: &mut Pdf,
    numbers: &Numbers,
    number: usize,
    page: &Page,
    [layers, pictures]: [usize; 2],
) {
    let [width, height] = page.size.to_array().map(|side| (side * POINTS) as f32);
    let mut entry = pdf.page(Numbers::page(number));
    entry.media_box(Rect::new(0.0, 0.0, width, height));
    entry.parent(Numbers::TREE);
    entry.contents(Numbers::content(number));
    let mut resources = entry.resources();
    if !page.layers.is_empty() {
        let mut properties = resources.insert(Name(b"Properties")).dict();
        for at in 0..page.layers.len() {
            let name = format!("L{at}");
            properties.pair(Name(name.as_bytes()), numbers.layer(layers + at));
        }
    }
    if !page.pictures.is_empty() {
        let mut objects = resources.x_objects();
        for at in 0..page.pictures.len() {
            objects.pair(Name(format!("P{at}").as_bytes()), numbers.picture(pictures + at)[0]);
        }
    }
    resources.finish();
    entry.finish();
    let content = miniz_oxide::deflate::compress_to_vec_zlib(&content(page), EFFORT);
    pdf.stream(Numbers::content(number), &content).filter(Filter::FlateDecode);
}

/// The commands that draw a page.
fn content(page: &Page) -> Vec<u8> {
    let mut out = Content(Vec::new());
    let height = page.size.y * POINTS;
    out.text(&format!("{POINTS:.9} 0 0 -{POINTS:.9} 0 {height:.6} cm\n"));
    if let Some(paper) = page.paper {
        let [x, y] = super::page::micrometres(page.size);
        out.ink(paper, "rg");
        out.text("0 0 ");
        out.pair([x, y]);
        out.text("re f\n");
    }
    for (at, Pasted { corner, size, .. }) in page.pictures.iter().enumerate() {
        // The unit square of pictures has y up.
        out.text("q ");
        out.pair([size[0], 0]);
        out.pair([0, -size[1]]);
        out.pair([corner[0], corner[1] + size[1]]);
        out.text(&format!("cm /P{at} Do Q\n"));
    }
    for (at, layer) in page.layers.iter().enumerate() {
        out.text(&format!("/OC /L{at} BDC\n"));
        out.layer(layer);
        out.text("EMC\n");
    }
    out.0
}

/// A content stream being written.
struct Content(Vec<u8>);

impl Content {
    fn text(&mut self, text: &str) {
        self.0.extend_from_slice(text.as_bytes());
    }

    fn number(&mut self, thousandth: i64) {
        thousandths(&mut self.0, thousandth);
        self.0.push(b' ');
    }

    fn length(&mut self, millimetres: f64) {
        self.number(libm::round(millimetres * 1000.0) as i64);
    }

    fn pair(&mut self, [x, y]: Place) {
        self.number(x.into());
        self.number(y.into());
    }

    fn ink(&mut self, ink: Ink, command: &str) {
        for channel in ink {
            self.number((i64::from(channel) * 1000 + 127) / 255);
        }
        self.text(command);
        self.0.push(b'\n');
    }

    fn layer(&mut self, layer: &Layer) {
        self.pen(&layer.pen);
        for group in &layer.groups {
            if layer.pen.dashes.is_empty() {
                group.strokes.iter().for_each(|line| self.path(line));
                self.text(if group.strokes.is_empty() { "" } else { "S\n" });
            } else {
                group.strokes.iter().for_each(|line| self.dashed(line, &layer.pen));
            }
            if !group.fills.is_empty() {
                group.fills.iter().for_each(|line| self.path(line));
                self.text("f*\n");
            }
        }
    }

    fn pen(&mut self, pen: &Pen) {
        self.ink(pen.ink, "RG");
        self.ink(pen.ink, "rg");
        self.length(pen.width);
        self.text("w\n");
        self.dashes(&[]);
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
        self.text(&format!("{cap} J {join} j 4 M\n"));
    }

    fn dashes(&mut self, dashes: &[f64]) {
        self.text("[");
        dashes.iter().for_each(|&dash| self.length(dash));
        self.text("] 0 d\n");
    }

    /// A line by itself, with dashes that fit it.
    fn dashed(&mut self, line: &Polyline, pen: &Pen) {
        self.dashes(&pen.fitted_dashes(line));
        self.path(line);
        self.text("S\n");
    }

    fn path(&mut self, line: &Polyline) {
        for (at, point) in line.points.iter().enumerate() {
            self.pair(*point);
            self.text(if at == 0 { "m\n" } else { "l\n" });
        }
        if line.closed {
            self.text("h\n");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::page::{Group, Layer};
    use super::*;
    use glam::DVec2;

    #[test]
    fn a_page_says_what_is_on_it() {
        let mut page = Page::new(DVec2::new(210.0, 297.0), "A (page) \\ Ä", Some([255, 128, 0]));
        let mut pen = Pen::of_width(0.25, [0; 3]);
        pen.dashes = vec![3.0, 0.75];
        let mut layer = Layer::new("a", "b", pen);
        let strokes =
            vec![Polyline { points: vec![[10_000, -500], [110_000, 500]], closed: false }];
        layer.groups.push(Group { strokes, ..Group::default() });
        page.layers.push(layer);
        let text = String::from_utf8(content(&page)).expect("text");
        let expected = "2.834645669 0 0 -2.834645669 0 841.889764 cm\n1 .502 0 rg\n0 0 210 297 re f\n/OC /L0 BDC\n\
            0 0 0 RG\n0 0 0 rg\n.25 w\n[] 0 d\n1 J 1 j 4 M\n[2.985 .746 ] 0 d\n10 -.5 m\n110 .5 l\nS\nEMC\n";
        assert_eq!(text, expected);
        let file = to_pdf(&[page.clone(), page]);
        assert!(file.starts_with(b"%PDF-1.7") && file.ends_with(b"%%EOF"));
        let holds = |word: &[u8]| file.windows(word.len()).any(|part| part == word);
        assert!(holds(b"/Count 2") && holds(b"/OCG") && !holds(b"/ID") && !holds(b"Date"));
    }
}
