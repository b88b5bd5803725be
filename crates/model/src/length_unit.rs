//! Length units used in files.

/// The unit of a file's coordinates.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Default)]
pub enum LengthUnit {
    /// 0.001 mm.
    Micrometer,
    /// 1 mm: the default unit of 3MF files and, by convention, the unit of STL files.
    Millimeter,
    /// 10 mm.
    Centimeter,
    /// 1 m: the unit of glTF, also assumed for OBJ and PLY files, whose formats do not define a
    /// unit.
    #[default]
    Meter,
    /// 25.4 mm.
    Inch,
    /// 304.8 mm.
    Foot,
}

impl LengthUnit {
    /// All units, metric units first.
    pub const ALL: [Self; 6] =
        [Self::Micrometer, Self::Millimeter, Self::Centimeter, Self::Meter, Self::Inch, Self::Foot];

    /// Returns the length of the unit in millimeters.
    #[must_use]
    pub const fn in_millimeters(self) -> f64 {
        match self {
            Self::Micrometer => 0.001,
            Self::Millimeter => 1.0,
            Self::Centimeter => 10.0,
            Self::Meter => 1000.0,
            Self::Inch => 25.4,
            Self::Foot => 304.8,
        }
    }

    /// Returns the symbol: `µm`, `mm`, `cm`, `m`, `in` or `ft`.
    #[must_use]
    pub const fn symbol(self) -> &'static str {
        match self {
            Self::Micrometer => "µm",
            Self::Millimeter => "mm",
            Self::Centimeter => "cm",
            Self::Meter => "m",
            Self::Inch => "in",
            Self::Foot => "ft",
        }
    }
}
