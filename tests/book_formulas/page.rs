//! The formulas on a page of the book: fenced blocks `formula ID` with `% check` lines.

/// One fenced block.
#[derive(Clone, PartialEq, Debug)]
pub struct Formula {
    /// The line of the fence, counted from 1.
    pub line: usize,
    /// The id, such as `PE-1`, if the formula is numbered.
    pub id: Option<String>,
    /// The block without comments, but with its line breaks, so that lines can be counted.
    pub latex: String,
    pub checks: Vec<CheckText>,
}

/// The text after `% check`.
#[derive(Clone, PartialEq, Debug)]
pub struct CheckText {
    pub line: usize,
    pub text: String,
}

/// Returns all formulas on a Markdown page.
pub fn find_formulas(markdown: &str) -> Vec<Formula> {
    let mut formulas: Vec<Formula> = Vec::new();
    let mut fence: Option<Fence> = None;
    for (index, line) in markdown.lines().enumerate() {
        // A fence may be inside a list or a quotation.
        let text = line.trim_start_matches([' ', '>']);
        match &fence {
            None => {
                fence = Fence::opened_by(text);
                if let Some(open) = fence.as_ref().filter(|open| open.is_formula) {
                    let id = open.id.clone();
                    let (latex, checks) = (String::new(), Vec::new());
                    formulas.push(Formula { line: index + 1, id, latex, checks });
                }
            }
            Some(open) if open.is_closed_by(text) => fence = None,
            Some(open) if open.is_formula => {
                if let Some(formula) = formulas.last_mut() {
                    formula.add_line(index + 1, text);
                }
            }
            Some(_) => {}
        }
    }
    formulas
}

impl Formula {
    fn add_line(&mut self, line: usize, text: &str) {
        let (latex, comment) = text.split_once('%').unwrap_or((text, ""));
        self.latex.push_str(latex);
        self.latex.push('\n');
        if let Some(check) = comment.trim_start().strip_prefix("check") {
            self.checks.push(CheckText { line, text: check.trim().to_owned() });
        }
    }
}

struct Fence {
    mark: char,
    length: usize,
    is_formula: bool,
    id: Option<String>,
}

impl Fence {
    fn opened_by(text: &str) -> Option<Self> {
        let mark = text.chars().next().filter(|mark| matches!(mark, '`' | '~'))?;
        let info = text.trim_start_matches(mark);
        let length = text.len() - info.len();
        // A line such as ```a``` is a code span.
        if length < 3 || (mark == '`' && info.contains('`')) {
            return None;
        }
        let mut words = info.split_whitespace();
        let is_formula = words.next() == Some("formula");
        Some(Self { mark, length, is_formula, id: words.next().map(str::to_owned) })
    }

    fn is_closed_by(&self, text: &str) -> bool {
        let rest = text.trim_start_matches(self.mark);
        text.len() - rest.len() >= self.length && rest.trim().is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::{CheckText, find_formulas};

    #[test]
    fn blocks_are_found_with_their_ids_and_checks() {
        let page = "# T\n\n```formula PE-1\nP = n % a comment\n% check n=2 : PE-1\n```\n\
                    ````text\n```formula\nno\n```\n````\n> ```formula\n> x\n> ```\n";
        let formulas = find_formulas(page);
        assert_eq!(formulas.len(), 2);
        assert_eq!(formulas[0].id.as_deref(), Some("PE-1"));
        assert_eq!((formulas[0].line, formulas[0].latex.trim()), (3, "P = n"));
        let check = CheckText { line: 5, text: "n=2 : PE-1".to_owned() };
        assert_eq!(formulas[0].checks, [check]);
        assert_eq!((&formulas[1].id, formulas[1].line), (&None, 12));
        assert_eq!(formulas[1].latex, "x\n");
    }
}
