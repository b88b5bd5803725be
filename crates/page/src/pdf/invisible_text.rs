//! Searchable PDF text: invisible glyphs over the strokes, for finding, selecting and copying text.
//!
//! ```text
//!   Group with content Text ─► its strokes, drawn       the visible text
//!                           └► BT /F0 1 Tf … Tm <0A0B> Tj ET      the searchable text
//! ```
//!
//! The fonts are Type 3 fonts (ISO 32000-1, 9.6.5), whose glyphs are content streams. Here the
//! streams are empty, so nothing is drawn in any viewer and no font file is needed. Widths match
//! the stroke font, so a selection covers the characters. ToUnicode maps the codes to characters,
//! including characters that the stroke font lacks.

use crate::page::{GroupContent, PageContent, TextLine};
use crate::stroke_font::advance_width;
use pdf_writer::types::{SystemInfo, UnicodeCmap};
use pdf_writer::{Finish, Name, Pdf, Rect, Ref, Str};
use std::collections::{BTreeMap, BTreeSet};

/// The maximum number of characters in a font. Their codes are 1 to 255.
const FONT_CHARACTERS: usize = 255;

/// The size of a glyph unit in text units. A text unit is one capital height.
const UNIT: f32 = 0.1;

/// Returns the name of a glyph from its width in thousandths. Glyphs differ only in width.
fn glyph_name(width: i32) -> String {
    format!("w{width}")
}

/// The characters in the text of the pages, divided among fonts.
pub(super) struct TextFonts {
    /// The characters in the order of their codes.
    characters: Vec<char>,
    /// The distinct widths of the characters, in thousandths of a glyph unit.
    widths: BTreeSet<i32>,
}

/// Returns the searchable form of a character: a space for white space, `None` for control
/// characters.
fn searched(character: char) -> Option<char> {
    match character {
        c if c.is_whitespace() => Some(' '),
        c if c.is_control() => None,
        c => Some(c),
    }
}

/// Returns the advance width of a character in thousandths of a glyph unit.
fn width_of(character: char) -> i32 {
    libm::round(advance_width(character) * 1000.0) as i32
}

/// Returns the lines of text in a page's layer groups.
fn texts_of(page: PageContent<'_>) -> impl Iterator<Item = &TextLine> {
    let groups = page.layers.iter().flat_map(|layer| &layer.groups);
    groups.filter_map(|group| match &group.content {
        GroupContent::Text(line) => Some(line),
        _ => None,
    })
}

impl TextFonts {
    /// Creates the fonts for the text of the pages.
    pub(super) fn new(pages: &[PageContent<'_>]) -> Self {
        let lines = pages.iter().copied().flat_map(texts_of);
        let characters: BTreeSet<char> =
            lines.flat_map(|line| line.text.chars().filter_map(searched)).collect();
        let widths = characters.iter().map(|character| width_of(*character)).collect();
        Self { characters: characters.into_iter().collect(), widths }
    }

    /// Returns the number of fonts.
    pub(super) fn count(&self) -> usize {
        self.characters.len().div_ceil(FONT_CHARACTERS)
    }

    /// Returns the name of a font in the resources of pages.
    pub(super) fn name(font: usize) -> String {
        format!("F{font}")
    }

    /// Returns the id of a font object if font ids start at `first`.
    pub(super) fn font_id(first: usize, font: usize) -> Ref {
        Ref::new((first + 2 * font) as i32)
    }

    /// Writes the fonts, their character tables and their glyphs as objects starting at `first`.
    pub(super) fn write(&self, pdf: &mut Pdf, first: usize) {
        let procedures = first + 2 * self.count();
        let numbered = self.widths.iter().zip(procedures..);
        let procedures: BTreeMap<i32, Ref> =
            numbered.map(|(width, id)| (*width, Ref::new(id as i32))).collect();
        for (index, characters) in self.characters.chunks(FONT_CHARACTERS).enumerate() {
            let id = Self::font_id(first, index);
            let table = Ref::new(id.get() + 1);
            write_font(pdf, id, table, characters, &procedures);
            let info =
                SystemInfo { registry: Str(b"Alberti"), ordering: Str(b"Text"), supplement: 0 };
            let mut cmap: UnicodeCmap<u8> = UnicodeCmap::new(Name(b"Alberti-Text"), info);
            characters.iter().zip(1..).for_each(|(character, code)| cmap.pair(code, *character));
            pdf.cmap(table, &cmap.finish());
        }
        for (width, id) in procedures {
            // An empty glyph of this width.
            let width = f64::from(width) / 1000.0;
            pdf.stream(id, format!("{width} 0 d0").as_bytes());
        }
    }

    /// Returns the operators that show a line of text, in page millimeters.
    pub(super) fn show(&self, line: &TextLine) -> Vec<u8> {
        let mut out = Vec::new();
        let [[x, y], [end_x, end_y]] = line.baseline;
        let along =
            glam::DVec2::new(f64::from(end_x) - f64::from(x), f64::from(end_y) - f64::from(y));
        let along = along.normalize_or(glam::DVec2::X) * f64::from(line.height);
        let codes: Vec<(usize, u8)> =
            line.text.chars().filter_map(searched).filter_map(|one| self.code(one)).collect();
        if codes.is_empty() {
            return out;
        }
        // Text runs along the baseline with y up; on the page, y points down.
        let [a, b] = along.to_array().map(|part| libm::round(part) as i64);
        let matrix = [a, b, b, -a, i64::from(x), i64::from(y)];
        out.extend_from_slice(b"BT\n");
        for (at, run) in codes.chunk_by(|one, next| one.0 == next.0).enumerate() {
            out.extend_from_slice(format!("/{} 1 Tf\n", Self::name(run[0].0)).as_bytes());
            if at == 0 {
                for number in matrix {
                    crate::fixed_decimal::write_thousandths(&mut out, number);
                    out.push(b' ');
                }
                out.extend_from_slice(b"Tm\n");
            }
            out.push(b'<');
            run.iter()
                .for_each(|(_, code)| out.extend_from_slice(format!("{code:02X}").as_bytes()));
            out.extend_from_slice(b"> Tj\n");
        }
        out.extend_from_slice(b"ET\n");
        out
    }

    /// Returns the font and code of a character.
    fn code(&self, character: char) -> Option<(usize, u8)> {
        let at = self.characters.binary_search(&character).ok()?;
        Some((at / FONT_CHARACTERS, u8::try_from(at % FONT_CHARACTERS + 1).ok()?))
    }
}

/// Writes the dictionary of a font. Codes begin at 1.
fn write_font(
    pdf: &mut Pdf,
    id: Ref,
    table: Ref,
    characters: &[char],
    procedures: &BTreeMap<i32, Ref>,
) {
    let names: Vec<String> =
        characters.iter().map(|character| glyph_name(width_of(*character))).collect();
    let mut font = pdf.type3_font(id);
    font.bbox(Rect::new(0.0, -3.0, 10.0, 11.0));
    font.matrix([UNIT, 0.0, 0.0, UNIT, 0.0, 0.0]);
    let mut glyphs = font.char_procs();
    for (width, procedure) in procedures {
        glyphs.pair(Name(glyph_name(*width).as_bytes()), *procedure);
    }
    glyphs.finish();
    let mut encoding = font.encoding_custom();
    encoding.differences().consecutive(1, names.iter().map(|name| Name(name.as_bytes())));
    encoding.finish();
    font.first_char(1).last_char(characters.len() as u8);
    font.widths(characters.iter().map(|character| width_of(*character) as f32 / 1000.0));
    font.resources();
    font.to_unicode(table);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Page;
    use crate::{Label, Layer, Pen};
    use glam::DVec2;

    /// Returns a page with these lines of text.
    fn page_of(texts: &[&str]) -> Page {
        let mut page: Page = Page::new(DVec2::splat(100.0), "texts", None);
        let mut layer = Layer::new("text", "text", Pen::solid(0.25, [0; 3]));
        let labels = texts.iter().map(|text| Label::new(text, DVec2::new(10.0, 20.0), 5.0));
        layer.groups.extend(labels.map(|label| label.group()));
        page.layers.push(layer);
        page
    }

    #[test]
    fn text_is_shown_along_its_baseline() {
        let page = page_of(&["BA"]);
        let fonts = TextFonts::new(&[page.content()]);
        let line = texts_of(page.content()).next().expect("text");
        let shown = String::from_utf8(fonts.show(line)).expect("text");
        assert_eq!(shown, "BT\n/F0 1 Tf\n5 0 0 -5 10 20 Tm\n<0201> Tj\nET\n");
        let up = TextLine { baseline: [[0, 0], [0, -9000]], ..line.clone() };
        let shown = String::from_utf8(fonts.show(&up)).expect("text");
        assert!(shown.contains("\n0 -5 -5 0 0 0 Tm\n"), "{shown}");
    }

    #[test]
    fn more_than_255_characters_need_a_second_font() {
        let all: String = ('\u{4e00}'..'\u{4f00}').collect();
        let fonts = TextFonts::new(&[page_of(&[&all, "\u{7}\t"]).content()]);
        // 256, plus the space that replaces the tab. The control character is dropped.
        assert_eq!((fonts.characters.len(), fonts.count()), (257, 2));
        assert_eq!(fonts.code('\u{4eff}'), Some((1, 2)));
        assert_eq!(TextFonts::new(&[page_of(&["\u{7}", ""]).content()]).count(), 0);
    }
}
