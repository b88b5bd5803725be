//! Accented letters of the stroke font: a base letter with a mark above, below or beside it.
//!
//! Marks are combined with letters at run time, so the glyph table does not need a shape for each
//! accented letter. A mark is drawn around x = 0 and moved to the middle of its letter. The mark's
//! y is measured from the top of the letter or, for a cedilla, from the baseline.

use super::{Glyph, glyph_for_char, parse_strokes};
use glam::DVec2;

/// The marks as paths around x = 0. The y coordinate is measured from the top of the letter or, for
/// marks below it, from the baseline.
const ACUTE: &str = "m -0.7,1.2 l 0.9,2.9";
const GRAVE: &str = "m 0.7,1.2 l -0.9,2.9";
const CIRCUMFLEX: &str = "m -1.5,1.2 l 0,2.8 l 1.5,1.2";
const CARON: &str = "m -1.5,2.8 l 0,1.2 l 1.5,2.8";
const DIAERESIS: &str = "m -1.2,2 l -1.2,2.2 m 1.2,2 l 1.2,2.2";
const DOUBLE_ACUTE: &str = "m -1.5,1.2 l -0.4,2.9 m 0.5,1.2 l 1.6,2.9";
const TILDE: &str = "m -1.9,1.5 c -1.5,2.5 -0.8,2.5 0,2 c 0.8,1.5 1.5,1.5 1.9,2.5";
const RING: &str = "m 0,3.2 h -1.1,2.1 v 0,1 h 1.1,2.1 v 0,3.2";
const MACRON: &str = "m -1.6,2 l 1.6,2";
const BREVE: &str = "m -1.5,2.8 v 0,1.3 h 1.5,2.8";
const DOT: &str = "m 0,2 l 0,2.2";
const CEDILLA: &str = "m 0,0 l 0,-0.7 h 1.1,-1.6 v 0,-2.5 l -0.9,-2.5";
const APOSTROPHE: &str = "m 0.4,0 l 0,-1.8";

/// The letters for each mark, as pairs of an accented letter and its base letter.
const MARKED_LETTERS: &[(&str, &str)] = &[
    (ACUTE, "ÁAÉEÍIÓOÚUÝYĆCŃNŚSŹZŔRĹLáaéeíıóoúuýyćcńnśsźzŕr"),
    (GRAVE, "ÀAÈEÌIÒOÙUàaèeìıòoùu"),
    (CIRCUMFLEX, "ÂAÊEÎIÔOÛUĈCĜGĤHŜSŴWŶYâaêeîıôoûuĉcĝgŝsŵwŷy"),
    (CARON, "ČCĎDĚEŇNŘRŠSŤTŽZǍAčcěeňnřršsžzǎa"),
    (DIAERESIS, "ÄAËEÏIÖOÜUŸYäaëeïıöoüuÿy"),
    (DOUBLE_ACUTE, "ŐOŰUőoűu"),
    (TILDE, "ÃAÑNÕOĨIŨUãañnõoĩıũu"),
    (RING, "ÅAŮUåaůu"),
    (MACRON, "ĀAĒEĪIŌOŪUāaēeīıōoūu"),
    (BREVE, "ĂAĞGĬIŬUăağgŭu"),
    (DOT, "ŻZĖEİIĠGżzėeġg"),
    (CEDILLA, "ÇCŞSŢTçcşsţt"),
];

/// Letters whose caron is written as an apostrophe next to them, paired with their base letters
/// (Czech and Slovak usage).
const APOSTROPHE_CARON_LETTERS: &str = "ďdťtľlĽL";

/// Returns the glyph of an accented letter, or `None` for any other character.
///
/// The caron of d, t, l and L is an apostrophe at the upper right corner. It widens the letter.
pub(super) fn accented_glyph(character: char) -> Option<Glyph> {
    for (mark, letters) in MARKED_LETTERS {
        if let Some(letter) = base_letter(letters, character) {
            return Some(glyph_with_mark(letter, mark));
        }
    }
    let letter = base_letter(APOSTROPHE_CARON_LETTERS, character)?;
    let mut glyph = glyph_for_char(letter);
    let corner = DVec2::new(glyph.width + 1.2, 10.0);
    glyph.width += 1.6;
    add_strokes(&mut glyph, APOSTROPHE, corner);
    Some(glyph)
}

/// Finds the base letter of an accented letter in a list of pairs.
fn base_letter(letters: &str, character: char) -> Option<char> {
    let mut pairs = letters.chars();
    while let (Some(marked), Some(letter)) = (pairs.next(), pairs.next()) {
        if marked == character {
            return Some(letter);
        }
    }
    None
}

/// Composes a letter with a mark above its middle, or a cedilla below it.
///
/// A letter without width, such as the dotless i, is widened so that its mark does not overlap its
/// neighbors.
fn glyph_with_mark(letter: char, mark: &str) -> Glyph {
    let mut glyph = glyph_for_char(letter);
    let is_below = mark == CEDILLA;
    let top = glyph.strokes.iter().flatten().fold(0.0, |top: f64, point| point.y.max(top));
    let middle = glyph.width * 0.5;
    // A letter that is a single vertical stroke is moved to the right to center it under its mark.
    if middle == 0.0 {
        glyph.strokes.iter_mut().flatten().for_each(|point| point.x += 0.8);
        glyph.width = 1.6;
    }
    // Marks are slightly lower over tall letters, so that lines of text do not touch.
    let base = if is_below { 0.0 } else { top - if top > 8.0 { 0.2 } else { 0.1 } };
    let at = DVec2::new(glyph.width * 0.5, base);
    add_strokes(&mut glyph, mark, at);
    glyph
}

/// Adds the strokes of a path to a glyph, moved by `at`.
fn add_strokes(glyph: &mut Glyph, path: &str, at: DVec2) {
    let moved = parse_strokes(path).into_iter();
    glyph.strokes.extend(moved.map(|stroke| stroke.into_iter().map(|point| point + at).collect()));
}
