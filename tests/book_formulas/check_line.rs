//! Check lines: `row 2 n=-1 g=(0,3/5,-4/5) P=PE-1 : PE-2[2][3]`.

use crate::book_formulas::name::Name;
use crate::book_formulas::value::Value;

/// A parsed check line.
#[derive(Clone, PartialEq, Debug)]
pub struct Check {
    /// The row number, from 1.
    pub row: Option<usize>,
    pub givens: Vec<(Name, Given)>,
    pub target: Reference,
}

/// The value of a name.
#[derive(Clone, PartialEq, Debug)]
pub enum Given {
    Value(Value),
    Reference(Reference),
}

/// A name in the registry, or an entry of its matrix or column.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Reference {
    pub name: String,
    pub index: Vec<usize>,
}

impl Check {
    /// Returns the registry names in the line.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        let behind = self.givens.iter().filter_map(|(_, given)| match given {
            Given::Reference(reference) => Some(reference),
            Given::Value(_) => None,
        });
        behind.chain([&self.target]).map(|reference| reference.name.as_str())
    }
}

impl Reference {
    fn parse(text: &str) -> Result<Self, String> {
        let (name, index) = text.split_once('[').unwrap_or((text, ""));
        let parts = index.split(['[', ']']).filter(|part| !part.is_empty());
        let index = parts.map(str::parse).collect::<Result<Vec<usize>, _>>();
        let index = index.map_err(|_| format!("`{text}`: an index must be 0, 1, 2 …"))?;
        Ok(Self { name: name.to_owned(), index })
    }

    /// Returns the entry at the index, or the whole value.
    pub fn select(&self, value: &Value) -> Result<Value, String> {
        let [rows, columns] = value.shape();
        match self.index[..] {
            [] => Ok(value.clone()),
            [row] if row < rows && columns == 1 => Ok(Value::number(value.at(row, 0))),
            [row, column] if row < rows && column < columns => {
                Ok(Value::number(value.at(row, column)))
            }
            _ => Err(format!("`{}` is {}, which has no such entry", self.name, value.describe())),
        }
    }
}

/// Parses the text after `% check`.
pub fn parse_check(text: &str) -> Result<Check, String> {
    let (givens, target) =
        text.rsplit_once(':').ok_or("a check line must have the form `VAR=VALUE … : NAME`")?;
    let mut words = split_words(givens).into_iter().peekable();
    let mut row = None;
    if words.next_if(|word| word == "row").is_some() {
        let number = words.next().and_then(|word| word.parse().ok()).filter(|&row: &usize| row > 0);
        row = Some(number.ok_or("`row` must be followed by 1, 2, 3 …")?);
    }
    let mut all: Vec<(Name, Given)> = Vec::new();
    for word in words {
        let (name, value) = word.split_once('=').ok_or(format!("`{word}` is not VAR=VALUE"))?;
        let given = parse_given(value)?;
        // Vectors are bold.
        let is_vector = matches!(&given, Given::Value(value) if value.is_column());
        let name = Name::parse(name).key();
        let name = if is_vector { name.as_bold() } else { name };
        if all.iter().any(|(other, _)| *other == name) {
            return Err(format!("duplicate value for `{name}`"));
        }
        all.push((name, given));
    }
    let target = target.trim();
    if target.is_empty() || target.contains(' ') {
        return Err("expected one NAME after the colon".to_owned());
    }
    Ok(Check { row, givens: all, target: Reference::parse(target)? })
}

/// Splits the text at spaces outside brackets.
fn split_words(text: &str) -> Vec<String> {
    let (mut words, mut depth) = (vec![String::new()], 0_i32);
    for letter in text.chars() {
        depth += match letter {
            '(' | '[' | '{' => 1,
            ')' | ']' | '}' => -1,
            _ => 0,
        };
        match words.last_mut() {
            Some(word) if depth > 0 || letter != ' ' => word.push(letter),
            _ => words.push(String::new()),
        }
    }
    words.retain(|word| !word.is_empty());
    words
}

fn parse_given(text: &str) -> Result<Given, String> {
    if text.starts_with(|first: char| first.is_ascii_alphabetic()) {
        return Ok(Given::Reference(Reference::parse(text)?));
    }
    parse_value(text).map(Given::Value)
}

/// Parses a number, `(1, 2, 3)` or `[1 2; 3 4]`.
fn parse_value(text: &str) -> Result<Value, String> {
    let inside = |open, close| text.strip_prefix(open).and_then(|text| text.strip_suffix(close));
    if let Some(column) = inside('(', ')') {
        return Ok(Value::column(&parse_numbers(column)?));
    }
    if let Some(rows) = inside('[', ']') {
        let rows: Vec<Vec<f64>> = rows.split(';').map(parse_numbers).collect::<Result<_, _>>()?;
        return Value::from_rows(&rows);
    }
    parse_number(text).map(Value::number)
}

fn parse_numbers(text: &str) -> Result<Vec<f64>, String> {
    text.split([',', ' ']).filter(|part| !part.is_empty()).map(parse_number).collect()
}

/// Parses a decimal number or a fraction.
fn parse_number(text: &str) -> Result<f64, String> {
    let decimal = |text: &str| text.parse::<f64>().ok().filter(|number| number.is_finite());
    let number = match text.split_once('/') {
        Some((above, below)) => decimal(above).zip(decimal(below)).map(|(a, b)| a / b),
        None => decimal(text),
    };
    number.filter(|number| number.is_finite()).ok_or(format!("`{text}` is not a number"))
}

#[cfg(test)]
mod tests {
    use super::{Given, parse_check};
    use crate::book_formulas::name::Name;
    use crate::book_formulas::value::Value;

    #[test]
    fn values_are_numbers_columns_matrices_and_names() {
        let text = "row 2 n=-80/21 t=(0, 1,0) t=2.5 M=[1 2; 3 4] P=PE-1 : PE-2[2][3]";
        let check = parse_check(text).unwrap();
        assert_eq!((check.row, check.target.name.as_str()), (Some(2), "PE-2"));
        assert_eq!(check.target.index, [2, 3]);
        assert_eq!(check.givens[0].1, Given::Value(Value::number(-80.0 / 21.0)));
        assert_eq!(check.givens[1].0, Name::bold("t"));
        assert_eq!(check.givens[2].0, Name::plain("t"));
        assert_eq!(check.givens[3].1, Given::Value(Value::matrix([[1.0, 2.0], [3.0, 4.0]])));
        assert!(matches!(&check.givens[4].1, Given::Reference(name) if name.name == "PE-1"));
        assert!(parse_check(": MV-1").unwrap().givens.is_empty());
    }

    #[test]
    fn malformed_lines_are_rejected() {
        for wrong in
            ["n=1", "n=1 :", "n : A", "n=1 n=2 : A", "n=x/ : A[b]", "row n=1 : A", "n=1/0 : A"]
        {
            assert!(parse_check(wrong).is_err(), "{wrong}");
        }
    }
}
