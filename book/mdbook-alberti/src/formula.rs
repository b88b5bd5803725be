//! Converts formulas from LaTeX to MathML when the book is built.

use math_core::{LatexToMathML, MathCoreConfig, MathDisplay};

/// A converter from LaTeX to MathML.
pub struct Formulas(LatexToMathML);

impl Formulas {
    /// Creates a converter without macros.
    pub fn new() -> Result<Self, String> {
        let converter = LatexToMathML::new(MathCoreConfig::default());
        converter.map(Self).map_err(|error| format!("{error:?}"))
    }

    /// Converts an inline formula, and escapes Markdown's special characters in the result.
    pub fn inline(&self, latex: &str) -> Result<String, String> {
        Ok(escape_markdown(&self.convert(latex, MathDisplay::Inline)?))
    }

    /// Converts a display formula to an HTML element on a single line.
    pub fn block(&self, latex: &str, id: Option<&str>) -> Result<String, String> {
        let math = self.convert(&without_comments(latex), MathDisplay::Block)?;
        Ok(match id {
            None => format!("<div class=\"formula\">{math}</div>"),
            Some(id) => format!(
                "<div class=\"formula\" id=\"{id}\">{math}\
                 <a class=\"formula-id\" href=\"#{id}\">{id}</a></div>"
            ),
        })
    }

    fn convert(&self, latex: &str, display: MathDisplay) -> Result<String, String> {
        let math = self.0.convert_with_local_state(latex.trim(), display);
        let math = math.map_err(|error| format!("`{}`: {error}", latex.trim()))?;
        Ok(math.mathml.replace('\n', " "))
    }
}

/// Removes LaTeX comments, which specify how a formula is checked.
fn without_comments(latex: &str) -> String {
    let line = |line: &str| {
        let comment = line.match_indices('%').find(|(at, _)| !line[..*at].ends_with('\\'));
        line[..comment.map_or(line.len(), |(at, _)| at)].to_owned()
    };
    latex.lines().map(line).collect::<Vec<_>>().join("\n")
}

/// Escapes Markdown's special characters in the text between tags.
fn escape_markdown(html: &str) -> String {
    let mut out = String::new();
    let mut in_tag = false;
    for letter in html.chars() {
        match letter {
            '<' => in_tag = true,
            '>' => in_tag = false,
            '*' | '_' | '[' | ']' | '~' | '|' | '\\' | '`' | '!' | '\'' if !in_tag => {
                out.push_str(&format!("&#{};", u32::from(letter)));
                continue;
            }
            _ => {}
        }
        out.push(letter);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn matrices_fractions_and_functions_become_mathml() {
        let formulas = Formulas::new().unwrap();
        let html = formulas
            .block("P = \\begin{bmatrix} n & 0 \\\\ 0 & \\frac{1}{n'} \\end{bmatrix}\n% check n=1 : PE-1", Some("PE-1"))
            .unwrap();
        assert!(
            html.contains("<mtable") && html.contains("<mfrac>") && html.contains("id=\"PE-1\"")
        );
        assert!(!html.contains("check") && !html.contains('\n'), "{html}");
        let latex = r"\operatorname{atan2}(y, x) \cdot \cot\theta \le \sqrt{x_e^2} \mathrm{per} \begin{aligned} a &= b \\ c &= d \end{aligned}";
        formulas.block(latex, None).unwrap();
    }

    #[test]
    fn markdown_is_escaped_in_inline_formulas() {
        let html = Formulas::new().unwrap().inline("a * b_{|c|} [d]").unwrap();
        let text: String =
            html.split('<').filter_map(|part| part.split_once('>')).map(|(_, text)| text).collect();
        assert!(!text.contains(['*', '_', '|', '[']), "{html}");
    }

    #[test]
    fn errors_quote_the_formula() {
        let error = Formulas::new().unwrap().inline(r"\nosuchcommand x").unwrap_err();
        assert!(error.contains("nosuchcommand"), "{error}");
    }
}
