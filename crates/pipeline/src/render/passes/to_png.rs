//! Passes as 16-bit PNG files, for image viewers and for tools that support no other format.
//!
//! | pass | meaning of a code c from 0 to 65,535 |
//! | --- | --- |
//! | depth, distance | 0: background; else min + (c − 1) / 65,534 · (max − min), gray |
//! | position, uv | likewise for each of red, green and blue; all 0 for background pixels |
//! | normal, view-normal | c / 65,535 · 2 − 1; all 0 for background pixels |
//! | barycentric, coverage | c / 65,535 |
//! | integers | the value in gray; if any value exceeds 65,535, its high 16 bits in red and its low 16 bits in green |
//!
//! min and max are the minimum and maximum of each channel. The text chunk `Description` records
//! them, with the pass and its unit.

use super::buffer::{PassBuffer, PassValues};
use png::{BitDepth, ColorType, Compression, Encoder};
use scene_file::Pass;
use std::fmt::Write;

/// The maximum code.
const MAX_CODE: f64 = 65_535.0;

impl PassBuffer {
    /// Encodes the pass as a PNG file with 16 bits per channel: gray if one channel suffices,
    /// otherwise RGB.
    #[must_use]
    pub fn to_png(&self) -> Vec<u8> {
        match &self.values {
            PassValues::Floats(values) => self.floats_to_png(values),
            PassValues::Integers(values) => self.integers_to_png(values),
        }
    }

    /// Encodes floating-point values, with a separate range for each channel.
    fn floats_to_png(&self, values: &[f32]) -> Vec<u8> {
        let count = self.pass.channels();
        let mut text = format!("{}: {}", self.pass.name(), unit_description(self.pass));
        let ranges: Vec<CodeRange> =
            (0..count).map(|k| self.code_range(values, k, &mut text)).collect();
        let mut codes = Vec::with_capacity(values.len() / count * 3);
        for pixel in values.chunks_exact(count) {
            let is_empty = pixel.iter().all(|value| *value == self.pass.empty_value());
            let code = |(value, range): (&f32, &CodeRange)| {
                if is_empty { 0 } else { range.encode_value(f64::from(*value)) }
            };
            codes.extend(pixel.iter().zip(&ranges).map(code));
            codes.extend((count == 2).then_some(0));
        }
        self.write_png16(
            &codes,
            if count == 1 { ColorType::Grayscale } else { ColorType::Rgb },
            &text,
        )
    }

    /// Returns the range of values that the codes of a channel span, and adds it to the
    /// description.
    fn code_range(&self, values: &[f32], channel: usize, text: &mut String) -> CodeRange {
        match self.pass {
            Pass::Normal | Pass::ViewNormal => {
                return CodeRange { min: -1.0, max: 1.0, first_code: 0.0 };
            }
            Pass::Barycentric | Pass::Coverage => {
                return CodeRange { min: 0.0, max: 1.0, first_code: 0.0 };
            }
            _ => {}
        }
        let count = self.pass.channels();
        let pixels = values.chunks_exact(count);
        let covered = pixels.filter(|pixel| pixel.iter().any(|v| *v != self.pass.empty_value()));
        let empty = (f32::INFINITY, f32::NEG_INFINITY);
        let (from, to) = covered
            .map(|pixel| pixel[channel])
            .fold(empty, |(least, most), value| (least.min(value), most.max(value)));
        let (from, to) = if from <= to { (from, to) } else { (0.0, 0.0) };
        // Writing to a String cannot fail.
        let _ = write!(text, "; channel {}: 1 is {from}, 65535 is {to}", channel + 1);
        CodeRange { min: from.into(), max: to.into(), first_code: 1.0 }
    }

    /// Encodes integers in one channel, or in two if a value exceeds 16 bits.
    fn integers_to_png(&self, values: &[u32]) -> Vec<u8> {
        let text = format!("{}: {}", self.pass.name(), unit_description(self.pass));
        if values.iter().all(|value| *value <= 65_535) {
            let codes: Vec<u16> = values.iter().map(|value| *value as u16).collect();
            return self.write_png16(&codes, ColorType::Grayscale, &text);
        }
        let codes = values.iter().flat_map(|value| [(value >> 16) as u16, *value as u16, 0]);
        let text = format!("{text}; value is red * 65536 + green");
        self.write_png16(&codes.collect::<Vec<_>>(), ColorType::Rgb, &text)
    }

    /// Encodes codes as a PNG file with a description.
    fn write_png16(&self, codes: &[u16], color: ColorType, text: &str) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = Encoder::new(&mut bytes, self.width, self.height);
        encoder.set_color(color);
        encoder.set_depth(BitDepth::Sixteen);
        encoder.set_compression(Compression::Fast);
        let text_result = encoder.add_text_chunk("Description".to_owned(), text.to_owned());
        let data: Vec<u8> = codes.iter().flat_map(|code| code.to_be_bytes()).collect();
        let written = text_result
            .and_then(|()| encoder.write_header())
            .and_then(|mut writer| writer.write_image_data(&data));
        debug_assert!(written.is_ok(), "a pass must have width x height pixels: {written:?}");
        bytes
    }
}

/// The values that the first and last codes represent.
struct CodeRange {
    /// The value of the first code.
    min: f64,
    /// The value of the last code, 65,535.
    max: f64,
    /// The first code used for a value: 0, or 1 if 0 marks background pixels.
    first_code: f64,
}

impl CodeRange {
    /// Returns the code of a value, clamped to the range and rounded to nearest.
    fn encode_value(&self, value: f64) -> u16 {
        let width = self.max - self.min;
        let fraction = if width > 0.0 { (value - self.min) / width } else { 0.0 };
        (self.first_code + fraction.clamp(0.0, 1.0) * (MAX_CODE - self.first_code) + 0.5) as u16
    }
}

/// Returns the description of a pass's values.
const fn unit_description(pass: Pass) -> &'static str {
    match pass {
        Pass::Depth => "scene units from the eye along the view axis; 0 is background",
        Pass::Distance => "scene units from the eye; 0 is background",
        Pass::Normal => "unit normal in world space; 0 is -1, 65535 is 1",
        Pass::ViewNormal => "unit normal in view space; 0 is -1, 65535 is 1",
        Pass::Position => "world position in scene units",
        Pass::Uv => "texture coordinates TEXCOORD_0",
        Pass::Barycentric => "barycentric weights of the three corners; 65535 is 1",
        Pass::Id => "point, line or triangle of the scene, from 1; 0 is background",
        Pass::Model => "model of the scene, from 1; 0 is background",
        Pass::Object => "object of the scene, from 1; 0 is background",
        Pass::Node => "node of the scene, from 1; 0 is background",
        Pass::Mesh => "mesh of the scene, from 1; 0 is background",
        Pass::Material => "material of the scene, from 1; 0 is background or the default",
        Pass::Overdraw => "fragments that cover the pixel's center",
        Pass::Coverage => "fraction of the pixel's samples covered; 65535 is 1",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decode_png(bytes: &[u8]) -> (Vec<u16>, ColorType, String) {
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().expect("a PNG");
        let mut data = vec![0; reader.output_buffer_size().expect("a small file")];
        reader.next_frame(&mut data).expect("pixels");
        let text = reader.info().uncompressed_latin1_text[0].text.clone();
        let codes = data.as_chunks::<2>().0.iter().map(|&pair| u16::from_be_bytes(pair));
        (codes.collect(), reader.info().color_type, text)
    }

    #[test]
    fn depths_span_codes_1_to_65535_and_background_is_0() {
        let values = PassValues::Floats(vec![f32::INFINITY, 2.0, 6.0, 3.0]);
        let buffer = PassBuffer { pass: Pass::Depth, width: 2, height: 2, values };
        let (codes, color, text) = decode_png(&buffer.to_png());
        assert_eq!(codes, [0, 1, 65_535, 1 + 65_534 / 4 + 1]);
        assert_eq!(color, ColorType::Grayscale);
        assert!(text.ends_with("channel 1: 1 is 2, 65535 is 6"), "{text}");
    }

    #[test]
    fn normals_and_large_integers_use_three_channels() {
        let values = PassValues::Floats(vec![-1.0, 0.0, 1.0]);
        let buffer = PassBuffer { pass: Pass::Normal, width: 1, height: 1, values };
        assert_eq!(decode_png(&buffer.to_png()).0, [0, 32_768, 65_535]);
        let values = PassValues::Integers(vec![65_536 * 3 + 7]);
        let buffer = PassBuffer { pass: Pass::Id, width: 1, height: 1, values };
        assert_eq!(decode_png(&buffer.to_png()).0, [3, 7, 0]);
    }
}
