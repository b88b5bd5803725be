//! Stroke font: characters drawn as single pen strokes, designed for this program.
//!
//! Labels need no font file, and their output is identical on every machine.
//!
//! ```text
//!   10 ┌ ─ ╱╲ ─ ─ ─ ─ ┐ cap height              strokes are 0.1 wide, letters 0.24
//!    7 ├ ─╱─ ╲ ╭──╮ ─ ┤ x-height                and words 0.64 apart, in cap heights,
//!      │ ╱────╲│  │   │                         similar to ISO 3098, lettering B
//!    0 └╱─ ─ ─ ╰──╯╲ ─┘ baseline
//!   −3                  descenders
//! ```
//!
//! A glyph is a string of commands. `m x,y` moves the pen without drawing, and `l x,y` draws a
//! straight line. `h x,y` draws a quarter of an ellipse that starts horizontally and ends
//! vertically, and `v x,y` the reverse. `c x,y x,y x,y` draws a cubic Bézier curve. Round letters
//! consist of four quarters joined by lines.

mod accents;
mod glyphs;
mod greek;
mod han;

use glam::DVec2;

/// The height of capitals in glyph units.
pub(super) const CAP_HEIGHT: f64 = 10.0;

/// The gap between letters, in glyph units.
const LETTER_SPACING: f64 = 2.4;

/// The width of a space. With the letter spacing on both sides, it gives the distance between
/// words.
const SPACE_WIDTH: f64 = 1.6;

/// The number of line segments that approximate a quarter ellipse or a cubic.
const CURVE_STEPS: u32 = 6;

/// A character or a line of characters as strokes, with x from its left side and y up from the
/// baseline.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Glyph {
    /// The advance width without letter spacing.
    pub(super) width: f64,
    /// The strokes as polylines.
    pub(super) strokes: Vec<Vec<DVec2>>,
}

/// Typesets a line of text as strokes, with x from its start and y up from the baseline.
///
/// There is no kerning. Each character becomes one glyph, and combining characters become boxes.
pub(super) fn typeset_line(text: &str) -> Glyph {
    let mut line = Glyph { width: 0.0, strokes: Vec::new() };
    let mut x = 0.0;
    for character in text.chars() {
        let glyph = glyph_for_char(character);
        let shift = DVec2::new(x, 0.0);
        let moved = |stroke: Vec<DVec2>| stroke.into_iter().map(|point| point + shift).collect();
        line.strokes.extend(glyph.strokes.into_iter().map(moved));
        line.width = x + glyph.width;
        x = line.width + LETTER_SPACING;
    }
    line
}

/// Returns the distance from the start of a character to the start of the next.
pub(super) fn advance_width(character: char) -> f64 {
    glyph_for_char(character).width + LETTER_SPACING
}

/// Returns the characters of a string that the font lacks, without duplicates, in order of
/// appearance.
pub fn missing_glyphs(text: &str) -> String {
    let mut missing = String::new();
    for character in text.chars().filter(|character| !has_glyph(*character)) {
        if !missing.contains(character) {
            missing.push(character);
        }
    }
    missing
}

/// Whether the font has a glyph for a character. White space has an empty glyph.
fn has_glyph(character: char) -> bool {
    character.is_whitespace()
        || plain_glyph(character).is_some()
        || accents::accented_glyph(character).is_some()
        || han::GLYPHS.iter().any(|(c, _)| *c == character)
}

/// Returns the width and path of a character without an accent.
fn plain_glyph(character: char) -> Option<(f64, &'static str)> {
    let wanted = greek::look_alike(character);
    let all = glyphs::GLYPHS.iter().chain(greek::GLYPHS);
    all.into_iter().find(|(c, ..)| *c == wanted).map(|(_, width, path)| (*width, *path))
}

/// Returns the glyph of a character, or a box if the font lacks it.
fn glyph_for_char(character: char) -> Glyph {
    if character.is_whitespace() {
        return Glyph { width: SPACE_WIDTH, strokes: Vec::new() };
    }
    if let Some((width, path)) = plain_glyph(character) {
        return Glyph { width, strokes: parse_strokes(path) };
    }
    if let Some((_, path)) = han::GLYPHS.iter().find(|(c, _)| *c == character) {
        return Glyph { width: han::WIDTH, strokes: parse_strokes(path) };
    }
    accents::accented_glyph(character)
        .unwrap_or_else(|| Glyph { width: 5.0, strokes: parse_strokes(glyphs::MISSING_GLYPH) })
}

/// Parses a glyph's path into strokes, with curves as polylines.
fn parse_strokes(path: &str) -> Vec<Vec<DVec2>> {
    let mut strokes: Vec<Vec<DVec2>> = Vec::new();
    let mut words = path.split_ascii_whitespace();
    while let Some(command) = words.next() {
        let mut point = || parse_point(words.next().unwrap_or_default());
        let to = point();
        if command == "m" {
            strokes.push(vec![to]);
            continue;
        }
        let Some(stroke) = strokes.last_mut() else { continue };
        let from = stroke[stroke.len() - 1];
        match command {
            "h" => stroke.extend(quarter_ellipse(from, to, DVec2::new(from.x, to.y))),
            "v" => stroke.extend(quarter_ellipse(from, to, DVec2::new(to.x, from.y))),
            "c" => stroke.extend(cubic_bezier(from, to, point(), point())),
            _ => stroke.push(to),
        }
    }
    strokes
}

/// Parses a point written as `x,y`.
fn parse_point(word: &str) -> DVec2 {
    let number = |text: &str| text.parse().unwrap_or(0.0);
    word.split_once(',').map_or(DVec2::ZERO, |(x, y)| DVec2::new(number(x), number(y)))
}

/// Returns a quarter of an ellipse about `center`, without its first point.
///
/// The curve is center + (from − center) cos φ + (to − center) sin φ for φ from 0 to 90°.
fn quarter_ellipse(from: DVec2, to: DVec2, center: DVec2) -> impl Iterator<Item = DVec2> {
    (1..=CURVE_STEPS).map(move |step| {
        let angle = core::f64::consts::FRAC_PI_2 * f64::from(step) / f64::from(CURVE_STEPS);
        let (sin, cos) = libm::sincos(angle);
        if step == CURVE_STEPS { to } else { center + (from - center) * cos + (to - center) * sin }
    })
}

/// Returns a cubic Bézier curve without its first point, by de Casteljau's algorithm.
fn cubic_bezier(a: DVec2, b: DVec2, c: DVec2, d: DVec2) -> impl Iterator<Item = DVec2> {
    (1..=CURVE_STEPS).map(move |step| {
        let t = f64::from(step) / f64::from(CURVE_STEPS);
        let (ab, bc, cd) = (a.lerp(b, t), b.lerp(c, t), c.lerp(d, t));
        if step == CURVE_STEPS { d } else { ab.lerp(bc, t).lerp(bc.lerp(cd, t), t) }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn glyphs_stay_within_their_width_and_line_height() {
        let known = |word: &str| {
            let is_number = |text: &str| text.parse::<f64>().is_ok();
            let is_point = word.split_once(',').is_some_and(|(x, y)| is_number(x) && is_number(y));
            "mlhvc".contains(word) || is_point
        };
        for (character, width, path) in glyphs::GLYPHS.iter().chain(greek::GLYPHS) {
            let words = path.split_ascii_whitespace();
            assert!(words.clone().all(known), "{character}: {path}");
            let points: Vec<DVec2> = parse_strokes(path).concat();
            for point in &points {
                assert!((-0.3..=width + 0.3).contains(&point.x), "{character}: {point}");
                assert!((-3.0..=11.0).contains(&point.y), "{character}: {point}");
            }
            let reaches = points.iter().fold(-1.0, |most, point| point.x.max(most));
            assert!(width - reaches < 0.9, "{character}: {reaches} of {width}");
        }
        for (character, path) in han::GLYPHS {
            let points: Vec<DVec2> = parse_strokes(path).concat();
            assert!(!path.split_ascii_whitespace().any(|word| !known(word)), "{character}");
            for point in &points {
                assert!((-0.4..=10.4).contains(&point.x), "{character}: {point}");
                assert!((-0.6..=10.4).contains(&point.y), "{character}: {point}");
            }
        }
        let all = glyphs::GLYPHS.iter().chain(greek::GLYPHS);
        let mut characters: Vec<char> = all.map(|(c, ..)| *c).collect();
        characters.sort_unstable();
        assert!(characters.windows(2).all(|pair| pair[0] != pair[1]), "a character has two glyphs");
    }

    #[test]
    fn ascii_and_latin_letters_have_glyphs() {
        let tofu = parse_strokes(glyphs::MISSING_GLYPH);
        let latin =
            (0xa1..=0xff).filter(|c| ![0xa4, 0xa6, 0xa8, 0xad, 0xaf, 0xb4, 0xb8].contains(c));
        let more = "ĀāăćČčďĐđēěğıŁłńňőœŒřśŠšťůűźŻżŽž⌀−–—…‘’“”„".chars().map(u32::from);
        let greek = (0x391..=0x3a9).chain(0x3b1..=0x3c9).filter(|code| *code != 0x3a2);
        let signs = "↑↓↔→←⇒∞≈≤≥≠√⊥∥′″∠∆∑Ω".chars().map(u32::from);
        for code in (0x21..0x7f).chain(latin).chain(more).chain(greek).chain(signs) {
            let character = char::from_u32(code).expect("a character");
            let glyph = glyph_for_char(character);
            assert!(glyph.strokes != tofu && !glyph.strokes.is_empty(), "{character}");
        }
        assert_eq!(glyph_for_char('漢').strokes, tofu);
        assert_eq!(missing_glyphs("Öl 漢 字 漢é"), "漢字");
    }

    #[test]
    fn line_width_is_letter_widths_plus_spacing() {
        let [a, i] = ["A", "i"].map(|text| typeset_line(text).width);
        assert_eq!(typeset_line("AiA").width, 2.0 * a + i + 4.8);
        assert_eq!(typeset_line("A A").width, 2.0 * a + 6.4);
        assert_eq!(typeset_line("").width, 0.0);
    }
}
