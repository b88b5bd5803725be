//! Colors for scalar vertex attributes such as temperature, stress or scan quality.
//!
//! The importers of formats with such attributes read the values of the attribute that the options
//! name. This module maps them to vertex colors. The surfaces get a plain white material, so that
//! shading shows their shape and no texture hides the colors.

use super::srgb::linear_from_srgb;
use super::warnings::ImportWarnings;
use model::{Colormap, Diagnostic, codes};

/// Coloring by a scalar vertex attribute, instead of by the materials in a file.
///
/// In glTF, the attribute is a custom attribute with accessors of type `SCALAR`, such as
/// `_TEMPERATURE`. In PLY, it is a vertex property without a predefined meaning, such as `quality`.
/// Primitives without the attribute keep their materials. Non-finite values are gray, with a
/// warning.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct ScalarColors {
    /// The name of the attribute; for glTF, the leading underscore is optional. Case is ignored if
    /// the file has no exact match.
    pub attribute: String,
    /// The colormap. Default: Viridis.
    pub colormap: Colormap,
    /// The values that map to the first and last color; values outside the range get the color of
    /// the nearer limit. If the first value is larger, the colors are reversed. Default: the
    /// smallest and largest finite values in the model. If both limits are equal, every finite
    /// value gets the middle color.
    pub range: Option<[f64; 2]>,
}

/// The gray for non-finite values, as an sRGB code scaled to [0, 1].
const NOT_FINITE_CODE: f32 = 0.5;

impl ScalarColors {
    /// Finds the attribute among the names in a file.
    ///
    /// # Errors
    /// Returns [`NO_SUCH_ITEM`](codes::NO_SUCH_ITEM), with a list of the names, if none of them
    /// matches.
    pub fn find_among(&self, names: &[String], location: &str) -> Result<usize, Diagnostic> {
        let wanted = self.attribute.as_str();
        let bare_wanted = bare_name(wanted);
        let find = |is_wanted: &dyn Fn(&str) -> bool| names.iter().position(|name| is_wanted(name));
        let found = find(&|name| name == wanted)
            .or_else(|| find(&|name| bare_name(name) == bare_wanted))
            .or_else(|| find(&|name| bare_name(name).eq_ignore_ascii_case(bare_wanted)));
        found.ok_or_else(|| {
            let list: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
            let (message, help) = match list.as_slice() {
                [] => (
                    format!("the vertices have no scalar attributes, so there is no `{wanted}`"),
                    "render the model without scalars".to_owned(),
                ),
                list => (
                    format!("the vertices have no scalar attribute `{wanted}`"),
                    format!("choose one of {}", list.join(", ")),
                ),
            };
            Diagnostic::error(codes::NO_SUCH_ITEM, location, message, &help)
        })
    }

    /// Returns the error for a format without scalar attributes; `format` is its name.
    #[must_use]
    pub fn unsupported_in(&self, format: &str) -> Diagnostic {
        let attribute = &self.attribute;
        let message =
            format!("vertices in {format} have no scalar attributes such as `{attribute}`");
        let help = "convert the model to PLY or glTF, and include the attribute";
        Diagnostic::error(codes::NO_SUCH_ITEM, "", message, help)
    }

    /// Returns the linear color of each value, with alpha 1. All arrays share one range.
    ///
    /// A warning reports the number of non-finite values.
    pub fn color_arrays<T: Copy + Into<f64>>(
        &self,
        arrays: &[&[T]],
        location: &str,
        warnings: &mut ImportWarnings,
    ) -> Vec<Vec<[f32; 4]>> {
        let values = || arrays.iter().copied().flatten().map(|&value| -> f64 { value.into() });
        let finite = || values().filter(|value| value.is_finite());
        let [min, max] = self.range.unwrap_or_else(|| {
            [finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max)]
        });
        let (all, others) = (values().count(), values().count() - finite().count());
        if others > 0 {
            let attribute = &self.attribute;
            let message = format!(
                "{others} of {all} values of `{attribute}` are not finite; they are drawn gray"
            );
            warnings.push_warning(location, message);
        }
        let color = |&value: &T| self.linear_color(value.into(), [min, max]);
        arrays.iter().map(|values| values.iter().map(color).collect()).collect()
    }

    /// Returns the linear color of a value, with alpha 1.
    fn linear_color(&self, value: f64, [min, max]: [f64; 2]) -> [f32; 4] {
        let codes = if !value.is_finite() {
            [NOT_FINITE_CODE; 3]
        } else if min == max {
            self.colormap.srgb_at(0.5)
        } else {
            self.colormap.srgb_at(((value - min) / (max - min)) as f32)
        };
        let [r, g, b] = codes.map(linear_from_srgb);
        [r, g, b, 1.0]
    }
}

/// Returns the name of an attribute without the leading underscore of custom glTF attributes.
pub(crate) fn bare_name(name: &str) -> &str {
    name.strip_prefix('_').unwrap_or(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn colors_of(colors: &ScalarColors, values: &[f64]) -> Vec<[f32; 4]> {
        let mut warnings = ImportWarnings::new(false);
        colors.color_arrays(&[values], "", &mut warnings).concat()
    }

    fn linear(colormap: Colormap, t: f32) -> [f32; 4] {
        let [r, g, b] = colormap.srgb_at(t).map(linear_from_srgb);
        [r, g, b, 1.0]
    }

    #[test]
    fn range_limits_get_the_first_and_last_color() {
        let colormap = Colormap::Turbo;
        let own = ScalarColors { colormap, ..ScalarColors::default() };
        let at = |t| linear(colormap, t);
        assert_eq!(colors_of(&own, &[-3.0, 1.0, 5.0]), [at(0.0), at(0.5), at(1.0)]);
        assert_eq!(colors_of(&own, &[7.0, 7.0]), [at(0.5); 2], "equal values");
        let fixed = ScalarColors { range: Some([0.0, 4.0]), ..own.clone() };
        assert_eq!(colors_of(&fixed, &[-3.0, 1.0, 5.0]), [at(0.0), at(0.25), at(1.0)]);
        let reverse = ScalarColors { range: Some([4.0, 0.0]), ..own };
        assert_eq!(colors_of(&reverse, &[0.0, 1.0]), [at(1.0), at(0.75)]);
    }

    #[test]
    fn non_finite_values_are_gray_and_counted() {
        let colors = ScalarColors { attribute: "t".to_owned(), ..ScalarColors::default() };
        let mut warnings = ImportWarnings::new(false);
        let arrays: [&[f32]; 2] = [&[f32::NAN, 2.0], &[f32::INFINITY, 4.0]];
        let colored = colors.color_arrays(&arrays, "", &mut warnings);
        let gray = linear(Colormap::Grayscale, 0.5);
        let [low, high] = [0.0, 1.0].map(|t| linear(Colormap::Viridis, t));
        assert_eq!(colored, [[gray, low], [gray, high]]);
        let [warning] = &warnings.into_list()[..] else { panic!("expected one warning") };
        assert_eq!(warning.message, "2 of 4 values of `t` are not finite; they are drawn gray");
        assert_eq!(colors_of(&colors, &[f64::NAN]), [gray], "no value is finite");
    }

    #[test]
    fn exact_names_take_precedence_over_looser_matches() {
        let names = ["_heat", "_HEAT", "_Load"].map(str::to_owned);
        let find = |attribute: &str| {
            let colors =
                ScalarColors { attribute: attribute.to_owned(), ..ScalarColors::default() };
            let found = colors.find_among(&names, "");
            found.map(|index| names[index].as_str()).map_err(|error| error.sentence())
        };
        for (wanted, found) in
            [("_HEAT", "_HEAT"), ("HEAT", "_HEAT"), ("heat", "_heat"), ("LOAD", "_Load")]
        {
            assert_eq!(find(wanted), Ok(found));
        }
        let missing = "the vertices have no scalar attribute `mass`; \
                       choose one of `_heat`, `_HEAT`, `_Load`";
        assert_eq!(find("mass").unwrap_err(), missing);
    }
}
