//! Variable names: `x_e`, `M_{per}`, `z'`, `\theta`, `\mathbf{t}`.

use std::fmt;

/// A name in normalized form, so that two spellings of one variable are equal.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Name {
    /// Vectors are bold: the view-up vector **t** is not the top t of a window.
    pub is_bold: bool,
    /// A letter, a Greek letter's name or a word.
    pub base: String,
    /// The letters and digits of the subscript.
    pub subscript: Vec<String>,
    pub primes: usize,
}

impl Name {
    /// Creates a plain name from a base, an optional subscript after `_`, and any primes.
    pub fn plain(text: &str) -> Self {
        let unprimed = text.trim_end_matches('\'');
        let (base, subscript) = unprimed.split_once('_').unwrap_or((unprimed, ""));
        let base = base.trim_start_matches('\\').trim_matches(['{', '}']);
        let base = if base == "varphi" { "phi" } else { base };
        let subscript = subscript.replace(['{', '}', ',', ' ', '\\'], "");
        Self {
            is_bold: false,
            base: base.to_owned(),
            subscript: Some(subscript).filter(|text| !text.is_empty()).into_iter().collect(),
            primes: text.len() - unprimed.len(),
        }
    }

    pub fn bold(text: &str) -> Self {
        Self { is_bold: true, ..Self::plain(text) }
    }

    /// Parses the form used in check lines and in the registry, such as `n_x`, `\theta` or
    /// `\mathbf{p}_n`.
    pub fn parse(text: &str) -> Self {
        let text = &text.replace("\\mathrm", "");
        let opening = ["\\mathbf{", "\\boldsymbol{", "\\vec{"].iter();
        let inner = opening.filter_map(|opening| text.strip_prefix(opening)).next();
        match inner.and_then(|inner| inner.split_once('}')) {
            Some((base, rest)) => Self::bold(&format!("{base}{rest}")),
            None => Self::plain(text),
        }
    }

    pub fn as_bold(&self) -> Self {
        Self { is_bold: true, ..self.clone() }
    }

    /// Returns the name with a number in place of the index of a sum.
    pub fn with_index(&self, index: &str, number: usize) -> Self {
        let replace = |part: &String| if part == index { number.to_string() } else { part.clone() };
        Self { subscript: self.subscript.iter().map(replace).collect(), ..self.clone() }
    }

    /// Returns the key for looking up values, with the subscripts joined.
    pub fn key(&self) -> Self {
        let joined = self.subscript.concat();
        let subscript = Some(joined).filter(|text| !text.is_empty()).into_iter().collect();
        Self { subscript, ..self.clone() }
    }
}

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_bold {
            write!(f, "\\mathbf{{{}}}", self.base)?;
        } else {
            f.write_str(&self.base)?;
        }
        let subscript = self.subscript.concat();
        match subscript.len() {
            0 => {}
            1 => write!(f, "_{subscript}")?,
            _ => write!(f, "_{{{subscript}}}")?,
        }
        f.write_str(&"'".repeat(self.primes))
    }
}

#[cfg(test)]
mod tests {
    use super::Name;

    #[test]
    fn spellings_of_one_name_are_equal() {
        assert_eq!(Name::parse("x_{w,min}"), Name::parse("x_{wmin}"));
        assert_eq!(Name::parse("\\varphi"), Name::parse("\\phi"));
        assert_eq!(Name::parse("\\mathbf{p}_n"), Name::bold("p_n"));
        assert_eq!(Name::parse("\\mathrm{rows}"), Name::plain("rows"));
        assert_ne!(Name::parse("\\mathbf{t}"), Name::parse("t"));
        assert_eq!(Name::parse("x_h'").to_string(), "x_h'");
    }
}
