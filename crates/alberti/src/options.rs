//! Flag values, parsed from the library's lists.
//!
//! The library declares every option once, as a [`NamedOption`] with its names and descriptions;
//! scene files, flags, the help and the reference all use that declaration.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use scene_file::options::NamedOption;

/// Value names that are shorter in flags than in scene files.
///
/// The first name of a pair is [`NamedOption::flag_name`], in kebab case; the second is the only
/// name that flags accept. Scene files keep the long name, because they are read more often than
/// typed.
const SHORT_NAMES: [(&str, &str); 10] = [
    ("ag-x", "agx"),
    ("open-cv", "opencv"),
    ("open-gl", "opengl"),
    ("meter", "m"),
    ("centimeter", "cm"),
    ("millimeter", "mm"),
    ("micrometer", "um"),
    ("inch", "in"),
    ("foot", "ft"),
    ("foot-inch", "ft-in"),
];

/// Returns the flag name of a value.
///
/// It is in lower case with hyphens between words, or it is the short name from [`SHORT_NAMES`]:
/// `LengthUnit::Centimeter` is `cm`.
fn flag_name<T: NamedOption>(value: T) -> String {
    let name = value.flag_name();
    let short = SHORT_NAMES.iter().find(|(long, _)| *long == name);
    short.map_or(name, |(_, short)| (*short).to_owned())
}

/// Parses an option's value by its flag name; help and completions list all values.
///
/// clap rejects a wrong value before the command runs, with the list of possible values and exit
/// code 2. The final period of a summary is removed, because help lines are phrases, while
/// reference entries are sentences.
///
/// ```text
/// --unit <UNIT>   [possible values: um, mm, cm, m, in, ft]
/// ```
pub(super) fn option_parser<T>() -> impl TypedValueParser<Value = T>
where
    T: NamedOption + Send + Sync,
{
    let value = |value: &T| {
        let name = flag_name(*value);
        // Names in capitals are also accepted, as printed on drawings: A4, MM.
        let capitals = name.to_uppercase();
        PossibleValue::new(name).alias(capitals).help(value.summary().trim_end_matches('.'))
    };
    PossibleValuesParser::new(T::ALL.iter().map(value).collect::<Vec<_>>()).try_map(|name| {
        let is_named = |value: &T| flag_name(*value).eq_ignore_ascii_case(&name);
        let found = T::ALL.iter().copied().find(is_named);
        found.ok_or_else(|| format!("unknown value `{name}`"))
    })
}

/// Parses a number of threads.
pub(crate) fn parse_thread_count(text: &str) -> Result<u16, String> {
    let count = text.parse().ok().filter(|count| (1..=256).contains(count));
    count.ok_or_else(|| {
        "expected a whole number from 1 to 256; omit the flag to use all processors".to_owned()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use model::LengthUnit;
    use pipeline::shade::ToneMapping;

    #[test]
    fn names_are_lower_case_and_units_are_abbreviated() {
        let names: Vec<String> = LengthUnit::ALL.iter().map(|unit| flag_name(*unit)).collect();
        assert_eq!(names, ["um", "mm", "cm", "m", "in", "ft"]);
        assert_eq!(flag_name(ToneMapping::AgX), "agx");
    }
}
