//! A parser for material libraries (MTL).
//!
//! Sources: Alias|Wavefront, *MTL material format*, Advanced Visualizer manual; for `Pr`, `Pm`,
//! `Ps`, `Pc`, `Pcr`, `aniso`, `anisor` and `norm`, *Extending Wavefront MTL for Physically-Based
//! Rendering*, Exocortex 2012.

use super::statements::StatementReader;
use crate::text::{LineCounter, Token, parse_f32};
use gltf_import::ImportWarnings;
use std::collections::BTreeMap;

/// A material as described in the library, with `None` for anything it does not specify.
#[derive(Clone, Debug, Default)]
pub(super) struct MtlMaterial<'a> {
    /// The name after `newmtl`.
    pub(super) name: &'a [u8],
    /// Diffuse color, `Kd`.
    pub(super) diffuse: Option<[f32; 3]>,
    /// Specular color, `Ks`.
    pub(super) specular: Option<[f32; 3]>,
    /// Emitted light, `Ke`.
    pub(super) emission: Option<[f32; 3]>,
    /// Single numbers, keyed by supported keyword: `Ns`, `Ni`, `d`, `Tr`, `illum`, `Pr` ….
    pub(super) numbers: BTreeMap<&'static str, f32>,
    /// Textures, keyed by normalized keyword.
    pub(super) textures: BTreeMap<&'static str, MtlTexture<'a>>,
}

/// A texture statement: options, followed by a file name.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct MtlTexture<'a> {
    /// Name of the file.
    pub(super) file: Token<'a>,
    /// Offset of the texture, `-o u v`.
    pub(super) offset: [f32; 2],
    /// Scale of the texture coordinates, `-s u v`.
    pub(super) scale: [f32; 2],
    /// Whether the texture does not repeat, `-clamp on`.
    pub(super) is_clamped: bool,
    /// Strength of a bump or normal map, `-bm`.
    pub(super) bump: f32,
    /// The channel of a scalar texture, `-imfchan`: one of `rgbmlz`.
    pub(super) channel: Option<u8>,
}

/// Supported keywords for numbers.
const NUMBERS: [&str; 12] =
    ["Ns", "Ni", "d", "Tr", "illum", "Pr", "Pm", "Ps", "Pc", "Pcr", "aniso", "anisor"];

/// Keywords for textures with their normalized spelling, which is empty for keywords that are not
/// read.
const TEXTURES: [(&str, &str); 23] = [
    ("map_kd", "map_Kd"),
    ("map_d", "map_d"),
    ("map_opacity", "map_d"),
    ("map_ke", "map_Ke"),
    ("map_emissive", "map_Ke"),
    ("bump", "bump"),
    ("map_bump", "bump"),
    ("map_kn", "norm"),
    ("norm", "norm"),
    ("map_norm", "norm"),
    ("map_pr", "map_Pr"),
    ("map_pm", "map_Pm"),
    ("map_ks", ""),
    ("map_ns", ""),
    ("map_tr", ""),
    ("map_ps", ""),
    ("map_rma", ""),
    ("map_orm", ""),
    ("map_refl", ""),
    ("refl", ""),
    ("disp", ""),
    ("map_disp", ""),
    ("decal", ""),
];

/// Statements that are ignored because the scene sets the ambient light and the renderer sets the
/// filters.
const IGNORED: [&str; 5] = ["Ka", "map_Ka", "map_aat", "sharpness", "Tf"];

/// Parses a material library; `name` precedes the locations of warnings.
pub(super) fn parse_mtl<'a>(
    text: &'a [u8],
    name: &str,
    warnings: &mut ImportWarnings,
) -> Vec<MtlMaterial<'a>> {
    let mut parser = MtlParser {
        reader: StatementReader::new(text),
        materials: Vec::new(),
        unread: BTreeMap::new(),
    };
    while let Some(keyword) = parser.reader.next_statement() {
        parser.read_statement(keyword);
    }
    let mut lines = LineCounter::new(text);
    let mut unread: Vec<_> = parser.unread.into_iter().collect();
    unread.sort_by_key(|(_, at)| at.1);
    for (what, (count, offset)) in unread {
        let location = format!("{name}: {}", lines.locate(offset));
        let times = if count == 1 { String::new() } else { format!(" ({count} times)") };
        warnings.push_warning(&location, format!("{what} is ignored{times}"));
    }
    parser.materials
}

/// The parser, with the statements skipped so far.
struct MtlParser<'a> {
    reader: StatementReader<'a>,
    materials: Vec<MtlMaterial<'a>>,
    /// Statements and options that are not read, with their count and the offset of the first.
    unread: BTreeMap<String, (usize, usize)>,
}

/// Maximum number of different statements and options that are counted by name.
const MAX_NAMED_STATEMENTS: usize = 32;

impl<'a> MtlParser<'a> {
    /// Reads one statement. Statements before the first `newmtl` do not belong to any material.
    fn read_statement(&mut self, keyword: Token<'a>) {
        if keyword.is_keyword("newmtl") {
            let name = self.reader.rest_of_line().bytes;
            self.materials.push(MtlMaterial { name, ..MtlMaterial::default() });
        } else if keyword.is_keyword("kd") {
            self.read_color(keyword, |material, color| material.diffuse = Some(color));
        } else if keyword.is_keyword("ks") {
            self.read_color(keyword, |material, color| material.specular = Some(color));
        } else if keyword.is_keyword("ke") {
            self.read_color(keyword, |material, color| material.emission = Some(color));
        } else if let Some(name) = NUMBERS.iter().find(|name| keyword.is_keyword(name)) {
            self.read_number(keyword, name);
        } else if let Some((_, name)) = TEXTURES.iter().find(|at| keyword.is_keyword(at.0)) {
            self.read_texture(keyword, name);
        } else if !IGNORED.iter().any(|name| keyword.is_keyword(name)) {
            self.count_unread(&keyword.to_text(), keyword.offset);
        }
    }

    /// Counts a statement or option that is not read.
    fn count_unread(&mut self, what: &str, offset: usize) {
        let mut what: String = format!("`{}`", what.chars().take(32).collect::<String>());
        if self.unread.len() >= MAX_NAMED_STATEMENTS && !self.unread.contains_key(&what) {
            "another statement".clone_into(&mut what);
        }
        self.unread.entry(what).or_insert((0, offset)).0 += 1;
    }

    /// Reads `Kd r g b`, or `Kd r` for gray. Spectral curves and CIE XYZ are not supported.
    fn read_color(&mut self, keyword: Token<'a>, set: impl FnOnce(&mut MtlMaterial<'a>, [f32; 3])) {
        let numbers = self.read_numbers::<3>();
        let color = match numbers.as_slice() {
            [r, g, b] => Some([*r, *g, *b]),
            [gray, ..] => Some([*gray; 3]),
            [] => None,
        };
        match (color, self.materials.last_mut()) {
            (Some(color), Some(material)) => set(material, color),
            (None, _) => {
                self.count_unread(
                    &format!("{} without numbers", keyword.to_text()),
                    keyword.offset,
                );
            }
            _ => {}
        }
    }

    /// Reads a statement with one number. The option `-halo` of `d` is not supported.
    fn read_number(&mut self, keyword: Token<'a>, name: &'static str) {
        let mut argument = self.reader.next_argument();
        if argument.is_some_and(|token| token.is_keyword("-halo")) {
            self.count_unread("-halo", keyword.offset);
            argument = self.reader.next_argument();
        }
        let number = argument.and_then(|token| parse_f32(token.bytes)).filter(|x| x.is_finite());
        match (number, self.materials.last_mut()) {
            (Some(number), Some(material)) => {
                material.numbers.insert(name, number);
            }
            (None, _) => {
                self.count_unread(
                    &format!("{} without a number", keyword.to_text()),
                    keyword.offset,
                );
            }
            _ => {}
        }
    }

    /// Reads up to `N` finite numbers.
    fn read_numbers<const N: usize>(&mut self) -> Vec<f32> {
        let mut numbers = Vec::with_capacity(N);
        let mut ahead = self.reader;
        while numbers.len() < N
            && let Some(token) = ahead.next_argument()
            && let Some(number) = parse_f32(token.bytes).filter(|x| x.is_finite())
        {
            numbers.push(number);
            self.reader = ahead;
        }
        numbers
    }

    /// Reads `map_Kd -s 2 2 file name.png`: options, then the file name in the rest of the line.
    fn read_texture(&mut self, keyword: Token<'a>, name: &'static str) {
        let mut texture = MtlTexture {
            file: keyword,
            offset: [0.0; 2],
            scale: [1.0; 2],
            is_clamped: false,
            bump: 1.0,
            channel: None,
        };
        let mut ahead = self.reader;
        while let Some(option) = ahead.next_argument().filter(|token| token.bytes.starts_with(b"-"))
        {
            let before = self.reader;
            self.reader = ahead;
            if !self.read_option(option, &mut texture) {
                // A file name that begins with a minus sign.
                self.reader = before;
                break;
            }
            ahead = self.reader;
        }
        texture.file = self.reader.rest_of_line();
        if name.is_empty() {
            self.count_unread(&keyword.to_text(), keyword.offset);
        } else if texture.file.bytes.is_empty() {
            self.count_unread(&format!("{} without a file", keyword.to_text()), keyword.offset);
        } else if let Some(material) = self.materials.last_mut() {
            material.textures.insert(name, texture);
        }
    }

    /// Reads the arguments of a texture option. Returns `false` if there is no such option.
    fn read_option(&mut self, option: Token<'a>, texture: &mut MtlTexture<'a>) -> bool {
        let is = |name: &str| option.is_keyword(name);
        if is("-o") || is("-s") || is("-t") {
            // The third number is for 3D textures.
            let numbers = self.read_numbers::<3>();
            let pair = |default: f32| [0, 1].map(|at| numbers.get(at).copied().unwrap_or(default));
            match option.bytes {
                b"-o" | b"-O" => texture.offset = pair(0.0),
                b"-s" | b"-S" => texture.scale = pair(1.0),
                _ => self.count_unread("-t", option.offset),
            }
        } else if is("-bm") {
            texture.bump = self.read_numbers::<1>().first().copied().unwrap_or(1.0);
        } else if is("-clamp") {
            let word = self.reader.next_argument();
            texture.is_clamped = word.is_some_and(|word| word.is_keyword("on"));
        } else if is("-imfchan") {
            let word = self.reader.next_argument();
            texture.channel = word.and_then(|word| word.bytes.first().copied());
        } else if is("-mm") {
            // `-mm 0 1` changes nothing.
            if self.read_numbers::<2>() != [0.0, 1.0] {
                self.count_unread("-mm", option.offset);
            }
        } else if is("-boost") || is("-texres") {
            self.read_numbers::<1>();
            self.count_unread(&option.to_text(), option.offset);
        } else if is("-blendu") || is("-blendv") || is("-cc") || is("-type") || is("-colorspace") {
            let word = self.reader.next_argument();
            // Blending is on and color correction off by default, so these values change nothing.
            let is_default =
                option.bytes.starts_with(b"-blend") == word.is_some_and(|w| w.is_keyword("on"));
            if !is_default || is("-type") || is("-colorspace") {
                self.count_unread(&option.to_text(), option.offset);
            }
        } else {
            return false;
        }
        true
    }
}
