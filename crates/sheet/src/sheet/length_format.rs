//! Lengths as text: units, decimals, and feet with inches.
//!
//! | unit | 1234.5 mm | decimals |
//! | --- | --- | --- |
//! | millimeters | 1234 (but 234.5 below a meter) | at most 2, none from one meter up |
//! | inches | 48.602 | at most 3 |
//! | feet and inches | 4'-0 5/8" | sixteenths of an inch |

use viewport::MILLIMETERS_PER_INCH;

/// The unit of lengths on a sheet. The paper itself is always measured in millimeters.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum DimensionUnit {
    /// Millimeters.
    #[default]
    Millimeter,
    /// Inches, as decimals.
    Inch,
    /// Feet and inches, with fractions of an inch: 4'-0 5/8".
    FootInch,
}

/// The decimal separator.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum DecimalMark {
    /// 12.5, as in English.
    #[default]
    Point,
    /// 12,5, as in ISO 129 and most languages.
    Comma,
}

/// The number format of a sheet.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct NumberFormat {
    /// The maximum number of decimals, up to [`MAX_DECIMALS`](Self::MAX_DECIMALS); trailing zeros
    /// are omitted. `None` means the default of the unit, which is fractions for feet and inches.
    pub decimals: Option<u8>,
    /// The decimal separator.
    pub decimal_mark: DecimalMark,
}

impl NumberFormat {
    /// The upper limit for `decimals`. Six decimals express a micrometer in meters.
    pub const MAX_DECIMALS: u8 = 6;

    /// Formats a number with at most `most` decimals, without trailing zeros.
    pub(super) fn decimal(self, number: f64, most: usize) -> String {
        let text = format!("{number:.most$}");
        let short = if text.contains('.') {
            text.trim_end_matches('0').trim_end_matches('.')
        } else {
            &text
        };
        let short = if short == "-0" { "0" } else { short };
        match self.decimal_mark {
            DecimalMark::Point => short.to_owned(),
            DecimalMark::Comma => short.replace('.', ","),
        }
    }
}

impl DimensionUnit {
    /// Returns the length of the unit in millimeters; for feet and inches, the length of an inch.
    #[must_use]
    pub const fn in_millimeters(self) -> f64 {
        match self {
            Self::Millimeter => 1.0,
            Self::Inch | Self::FootInch => MILLIMETERS_PER_INCH,
        }
    }

    /// Returns the symbol of the unit.
    #[must_use]
    pub const fn symbol(self) -> &'static str {
        match self {
            Self::Millimeter => "mm",
            Self::Inch => "in",
            Self::FootInch => "ft-in",
        }
    }
}

/// The length format of a sheet.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(super) struct LengthFormat {
    pub(super) unit: DimensionUnit,
    pub(super) numbers: NumberFormat,
}

impl LengthFormat {
    /// Sets the maximum number of decimals, if specified.
    pub(super) fn with_decimals(self, decimals: Option<u32>) -> Self {
        let Some(decimals) = decimals else { return self };
        let most = u8::try_from(decimals).unwrap_or(NumberFormat::MAX_DECIMALS);
        Self { numbers: NumberFormat { decimals: Some(most), ..self.numbers }, ..self }
    }

    /// Formats a length, given in millimeters, for a dimension line. Only feet and inches are
    /// marked with their unit.
    pub(super) fn text(self, millimeters: f64) -> String {
        let length = millimeters / self.unit.in_millimeters();
        let own = self.numbers.decimals.map(|most| most.min(NumberFormat::MAX_DECIMALS).into());
        match self.unit {
            DimensionUnit::Millimeter => {
                let usual = if length < 1000.0 { 2 } else { 0 };
                self.numbers.decimal(length, own.unwrap_or(usual))
            }
            DimensionUnit::Inch => self.numbers.decimal(length, own.unwrap_or(3)),
            DimensionUnit::FootInch => match own {
                Some(most) => self.feet_and_decimals(length, most),
                None => feet_and_sixteenths(length),
            },
        }
    }

    /// Formats a length with its unit for the scale bar. Long metric lengths are in m or km.
    pub(super) fn text_with_unit(self, length: f64) -> String {
        let number = |length: f64| {
            let text = length.to_string();
            match self.numbers.decimal_mark {
                DecimalMark::Point => text,
                DecimalMark::Comma => text.replace('.', ","),
            }
        };
        match self.unit {
            DimensionUnit::Millimeter if length >= 1e6 => format!("{} km", number(length / 1e6)),
            DimensionUnit::Millimeter if length >= 1e3 => format!("{} m", number(length / 1e3)),
            DimensionUnit::Millimeter => format!("{} mm", number(length)),
            DimensionUnit::Inch | DimensionUnit::FootInch => format!("{} in", number(length)),
        }
    }

    /// Formats inches as feet and decimal inches. Rounds first, so that 12 inches become a foot.
    fn feet_and_decimals(self, inches: f64, most: usize) -> String {
        let step = libm::pow(10.0, -(most as f64));
        let rounded = libm::round(inches / step) * step;
        let feet = libm::floor((rounded + 0.5 * step) / 12.0);
        let rest = (rounded - 12.0 * feet).max(0.0);
        let rest = format!("{}\"", self.numbers.decimal(rest, most));
        if feet > 0.0 { format!("{feet}'-{rest}") } else { rest }
    }
}

/// Formats inches as feet, inches and sixteenths of an inch, with the fraction in lowest terms.
fn feet_and_sixteenths(inches: f64) -> String {
    let sixteenths = libm::round(inches * 16.0);
    let (feet, rest) = (libm::floor(sixteenths / 192.0), sixteenths % 192.0);
    let (whole, mut part) = (libm::floor(rest / 16.0), (rest % 16.0) as u32);
    let mut denominator = 16;
    while part > 0 && part % 2 == 0 {
        (part, denominator) = (part / 2, denominator / 2);
    }
    let inches = match (whole > 0.0, part) {
        (_, 0) => format!("{whole}\""),
        (true, _) => format!("{whole} {part}/{denominator}\""),
        (false, _) if feet > 0.0 => format!("0 {part}/{denominator}\""),
        (false, _) => format!("{part}/{denominator}\""),
    };
    if feet > 0.0 { format!("{feet}'-{inches}") } else { inches }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_have_no_trailing_zeros() {
        let millimeters = LengthFormat::default();
        for (length, text) in [
            (150.0, "150"),
            (12.5, "12.5"),
            (0.126, "0.13"),
            (99.999, "100"),
            (12_345.6, "12346"),
            (4520.31, "4520"),
            (999.996, "1000"),
            (123.45, "123.45"),
            (100.0, "100"),
        ] {
            assert_eq!(millimeters.text(length), text);
        }
        let inches = LengthFormat { unit: DimensionUnit::Inch, ..millimeters };
        for (length, text) in [(1.0, "1"), (0.125, "0.125"), (2.5, "2.5"), (1200.0, "1200")] {
            assert_eq!(inches.text(length * 25.4), text);
        }
    }

    #[test]
    fn decimals_and_decimal_mark_are_configurable() {
        let format = |decimals, decimal_mark| LengthFormat {
            unit: DimensionUnit::Millimeter,
            numbers: NumberFormat { decimals, decimal_mark },
        };
        for (decimals, text) in [(0, "1235"), (1, "1234.6"), (2, "1234.57"), (4, "1234.5678")] {
            let point = format(Some(decimals), DecimalMark::Point).text(1234.5678);
            let comma = format(Some(decimals), DecimalMark::Comma).text(1234.5678);
            assert_eq!((point.as_str(), comma), (text, text.replace('.', ",")));
        }
        // Cases with too many decimals, and with trailing zeros.
        assert_eq!(format(Some(9), DecimalMark::Comma).text(0.25), "0,25");
        assert_eq!(format(None, DecimalMark::Comma).text_with_unit(500.0), "500 mm");
        assert_eq!(format(None, DecimalMark::Comma).text_with_unit(2500.0), "2,5 m");
        let inch = LengthFormat { unit: DimensionUnit::Inch, ..LengthFormat::default() };
        assert_eq!(inch.text_with_unit(0.5), "0.5 in");
    }

    #[test]
    fn feet_and_inches_carry() {
        let format = |decimals| LengthFormat {
            unit: DimensionUnit::FootInch,
            numbers: NumberFormat { decimals, ..NumberFormat::default() },
        };
        for (inches, fractions, decimals) in [
            (0.0, "0\"", "0\""),
            (0.5, "1/2\"", "0.5\""),
            (6.0, "6\"", "6\""),
            (11.99, "1'-0\"", "11.99\""),
            (12.0, "1'-0\"", "1'-0\""),
            (12.125, "1'-0 1/8\"", "1'-0.13\""),
            (63.5, "5'-3 1/2\"", "5'-3.5\""),
            (71.999, "6'-0\"", "6'-0\""),
            (1203.0625, "100'-3 1/16\"", "100'-3.06\""),
        ] {
            assert_eq!(format(None).text(inches * 25.4), fractions);
            assert_eq!(format(Some(2)).text(inches * 25.4), decimals);
        }
    }
}
