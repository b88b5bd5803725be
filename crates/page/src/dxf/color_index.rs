//! AutoCAD color index: the 255 colors of R2000, and the color nearest to an ink.
//!
//! ```text
//!   1 … 6      red, yellow, green, cyan, blue, magenta
//!   7          black on white screens, white on black screens
//!   8, 9       grays
//!   10 … 249   24 hues, each in five values and two saturations
//!   250 … 255  grays
//! ```

use crate::page::Ink;

/// The color that contrasts with the screen.
const CONTRAST: u8 = 7;

/// Inks whose channels differ by less than this are gray.
const MAX_GRAY_SPREAD: u8 = 32;
/// Grays with all channels below this become black.
const MAX_BLACK: u8 = 64;
/// Grays with all channels above this become white.
const MIN_WHITE: u8 = 224;

/// Returns the index of the color nearest to an ink. Grays stay gray, even if a brown of the same
/// brightness is nearer.
pub(super) fn color_index(ink: Ink) -> u8 {
    let [least, most] = ink.iter().fold([255, 0], |[low, high], &c| [c.min(low), c.max(high)]);
    let is_gray = most - least < MAX_GRAY_SPREAD;
    if is_gray && (most < MAX_BLACK || least > MIN_WHITE) {
        return CONTRAST;
    }
    let distance = |index: &u8| -> u32 {
        let other = index_color(*index);
        (0..3).map(|k| u32::from(ink[k].abs_diff(other[k])).pow(2)).sum()
    };
    let grays = (250..=255).chain([8, 9]);
    let nearest = if is_gray {
        grays.min_by_key(distance)
    } else {
        (1..=6).chain(10..=255).min_by_key(distance)
    };
    nearest.unwrap_or(CONTRAST)
}

/// Returns the color of an index other than 7.
fn index_color(index: u8) -> Ink {
    match index {
        0..=6 => {
            let bits = [0, 0b001, 0b011, 0b010, 0b110, 0b100, 0b101][usize::from(index)];
            [0, 1, 2].map(|channel| if bits >> channel & 1 == 1 { 255 } else { 0 })
        }
        8 => [128; 3],
        9 => [192; 3],
        250..=255 => {
            [[51; 3], [91; 3], [132; 3], [173; 3], [214; 3], [255; 3]][usize::from(index - 250)]
        }
        _ => hue_color(u32::from(index) - 10),
    }
}

/// Returns a hue color by its index minus 10: ten per hue, in five values and two saturations.
fn hue_color(number: u32) -> Ink {
    let value = [255, 189, 129, 104, 79][(number % 10 / 2) as usize];
    let (sector, quarter) = (number / 10 / 4, number / 10 % 4);
    // A pale color is one third saturated.
    let channel = |quarters: u32| {
        let full = value * quarters / 4;
        (if number % 2 == 1 { (2 * value + full) / 3 } else { full }) as u8
    };
    let (high, rising, falling, low) =
        (channel(4), channel(quarter), channel(4 - quarter), channel(0));
    match sector {
        0 => [high, rising, low],
        1 => [falling, high, low],
        2 => [low, high, rising],
        3 => [low, falling, high],
        4 => [rising, low, high],
        _ => [high, low, falling],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn well_known_colors_have_their_indices() {
        let named = [
            ([255, 0, 0], 1),
            ([255, 255, 0], 2),
            ([0, 255, 0], 3),
            ([0, 255, 255], 4),
            ([0, 0, 255], 5),
            ([255, 0, 255], 6),
            ([0, 0, 0], 7),
            ([255, 255, 255], 7),
            ([20, 24, 30], 7),
            ([255, 127, 0], 30),
            ([130, 130, 130], 252),
            // A brown would be nearer.
            ([163, 163, 163], 253),
            ([186, 190, 194], 9),
        ];
        for (ink, index) in named {
            assert_eq!(color_index(ink), index, "{ink:?}");
        }
    }

    #[test]
    fn every_color_is_its_own_nearest_color() {
        for index in (10..=249).step_by(2) {
            let color = index_color(index);
            assert_eq!(index_color(color_index(color)), color, "{index}");
        }
    }
}
