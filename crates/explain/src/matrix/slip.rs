//! Misprints in words: their steps in the report, and the verdict.

use super::Step;
use super::meaning::{describe_meaning, is_mirrored};
use homog::{Clip, Projective, View};
use recognition::{MatrixReading, Misprint, Recognition, Suspicion, SuspicionStrength, recognize};

type Rows = [[f64; 4]; 4];

/// Returns the reading of the corrected matrix, with its title, if it is clearly more likely and
/// the matrix as given has no meaning worth reporting.
pub(super) fn corrected_reading(found: &Recognition) -> Option<(MatrixReading, &'static str)> {
    let slip = found.misprint()?;
    let title = match slip.misprint {
        Misprint::Transposed => {
            "Most likely reading, transposed: the matrix is for row vectors, or stored by columns"
        }
        Misprint::LastRowNegated => "Most likely reading, with the last row negated",
        Misprint::WrongSign => "Most likely reading, with one sign flipped",
        Misprint::RowNegated => "Most likely reading, with one row negated",
        Misprint::EntriesExchanged => "Most likely reading, with two entries exchanged",
        Misprint::RowsExchanged => "Most likely reading, with two rows exchanged",
        Misprint::ColumnsExchanged => "Most likely reading, with two columns exchanged",
        _ => return None,
    };
    Some((recognize(slip.remedied?).first(), title))
}

/// Returns the rows and columns, counted from 0, of the entries that the remedy changes.
fn changed_entries(rows: Rows, slip: &Suspicion) -> Vec<[usize; 2]> {
    let Some(remedied) = slip.remedied else { return Vec::new() };
    let places = (0..16).map(|at| [at / 4, at % 4]);
    places.filter(|&[row, column]| rows[row][column] != remedied[row][column]).collect()
}

/// Describes a position in a matrix, counted from 1.
fn place_words([row, column]: [usize; 2]) -> String {
    format!("row {}, column {}", row + 1, column + 1)
}

/// Returns the two rows or columns, counted from 1, in which entries change: `3 and 4`.
fn lines_words(changed: &[[usize; 2]], axis: usize) -> String {
    let lines: Vec<usize> = changed.iter().map(|place| place[axis] + 1).collect();
    match (lines.iter().min(), lines.iter().max()) {
        (Some(first), Some(last)) => format!("{first} and {last}"),
        _ => String::new(),
    }
}

/// Describes where the remedy changes the matrix: `row 3, column 4` or `rows 3 and 4`.
fn changed_words(rows: Rows, slip: &Suspicion) -> String {
    let changed = changed_entries(rows, slip);
    match (slip.misprint, &changed[..]) {
        (Misprint::RowsExchanged, _) => format!("rows {}", lines_words(&changed, 0)),
        (Misprint::ColumnsExchanged, _) => format!("columns {}", lines_words(&changed, 1)),
        (Misprint::LastRowNegated, _) => "row 4".to_owned(),
        (Misprint::RowNegated, [[row, _], ..]) => format!("row {}", row + 1),
        (_, [first, second]) => format!("{}, and {}", place_words(*first), place_words(*second)),
        (_, [first, ..]) => place_words(*first),
        (_, []) => "one entry".to_owned(),
    }
}

/// Describes a step that undoes the misprint: `the sign of row 3, column 4 flipped`.
fn undone_words(rows: Rows, slip: &Suspicion) -> String {
    let place = changed_words(rows, slip);
    match slip.misprint {
        Misprint::LastRowNegated => "its last row negated".to_owned(),
        Misprint::RowNegated => format!("{place} negated"),
        Misprint::WrongSign => format!("the sign of {place} flipped"),
        Misprint::EntriesExchanged => format!("the entries in {place}, exchanged"),
        _ => format!("{place} exchanged"),
    }
}

/// Describes the remedy as a command: `flip the sign of row 3, column 4`.
fn remedy_words(rows: Rows, slip: &Suspicion) -> String {
    let place = changed_words(rows, slip);
    match slip.misprint {
        Misprint::LastRowNegated => "negate the last row".to_owned(),
        Misprint::RowNegated => format!("negate {place}"),
        Misprint::WrongSign => format!("flip the sign of {place}"),
        Misprint::EntriesExchanged => format!("exchange the entries in {place}"),
        Misprint::RowsExchanged | Misprint::ColumnsExchanged => format!("exchange {place}"),
        other => other.remedy().to_owned(),
    }
}

/// Returns the steps with the possible misprints. The first has the id `misprint`; later ones have
/// `other_misprint`.
pub(super) fn misprint_steps(rows: Rows, found: &Recognition) -> impl Iterator<Item = Step> {
    (0..).zip(&found.suspicions).map(move |(at, slip)| misprint_step(at, rows, slip))
}

/// Returns the step with a known misprint, its correction, and the meaning of the corrected matrix.
///
/// The corrected matrix is shown only if the sixteen entries determine it.
fn misprint_step(at: usize, rows: Rows, slip: &Suspicion) -> Step {
    let step = Step::new(
        if at == 0 { "misprint" } else { "other_misprint" },
        misprint_title(at, slip),
        None,
    )
    .with_item("finding", "finding", slip.misprint.description());
    let step = if slip.misprint.takes_one_step() {
        step.with_item("remedy", "remedy", remedy_words(rows, slip))
    } else {
        step.with_item("remedy", "remedy", slip.misprint.remedy())
    };
    // If the report is on the corrected matrix, it already has its reading.
    let is_corrected = slip.misprint.takes_one_step() || slip.misprint == Misprint::Transposed;
    let is_read = at == 0 && slip.strength == SuspicionStrength::Likely && is_corrected;
    match slip.remedied {
        Some(remedied) if is_read => step.with_item("remedied", "then", remedied),
        Some(remedied) => step.with_item("remedied", "then", remedied).with_item(
            "remedied_reading",
            "meaning",
            describe_meaning(&recognize(remedied).first()),
        ),
        None => step,
    }
}

fn misprint_title(at: usize, slip: &Suspicion) -> String {
    let known = slip.misprint.id().unwrap_or("unnumbered");
    let is_likely = slip.strength == SuspicionStrength::Likely;
    match slip.misprint {
        Misprint::Transposed if is_likely && at == 0 => {
            "It looks like a matrix for row vectors, or one stored by columns".to_owned()
        }
        Misprint::Transposed if is_likely => {
            "It may also be a matrix for row vectors, or one stored by columns".to_owned()
        }
        Misprint::Transposed => {
            "It may also be a matrix for row vectors: the numbers are the same".to_owned()
        }
        misprint if misprint.takes_one_step() && at > 0 => "Another possible repair".to_owned(),
        Misprint::EntriesExchanged => "Two entries seem to be exchanged".to_owned(),
        Misprint::RowsExchanged => "Two rows seem to be exchanged".to_owned(),
        Misprint::ColumnsExchanged => "Two columns seem to be exchanged".to_owned(),
        misprint if misprint.takes_one_step() => "It looks like a sign error".to_owned(),
        _ if is_likely => format!("It looks like a known misprint ({known})"),
        _ => format!("It may also be a known misprint ({known}): the numbers are the same"),
    }
}

/// States the result in a sentence: the first reading, and the misprint if it is more plausible.
pub(super) fn matrix_verdict(map: Projective<View, Clip>, found: &Recognition) -> String {
    let first = found.first();
    let what = if first.meaning.is_named() {
        format!("It is {}.", describe_meaning(&first))
    } else {
        format!("It is {}, but not a named transform or projection.", map.classify())
    };
    match (corrected_reading(found), found.misprint()) {
        (Some((reading, _)), Some(slip)) if slip.misprint == Misprint::Transposed => {
            let turned = describe_meaning(&reading);
            let as_given = what.replacen("It is", "As given, for column vectors, it is", 1);
            format!(
                "Transposed, it is {turned}. The matrix is for row vectors, or stored by columns. \
                 {as_given}"
            )
        }
        (Some((reading, _)), Some(slip)) => one_step_verdict(map.rows(), found, slip, &reading),
        (None, Some(slip)) => {
            format!("{what} But it looks like a misprint in which {}.", slip.misprint.description())
        }
        _ => add_same_numbers(what, found),
    }
}

/// States that one step gives a more likely matrix, and names other steps that may be meant.
fn one_step_verdict(
    rows: Rows,
    found: &Recognition,
    slip: &Suspicion,
    reading: &MatrixReading,
) -> String {
    let undone = undone_words(rows, slip);
    let corrected = describe_meaning(reading);
    let verdict = format!("It looks like a misprint. With {undone}, it is {corrected}.");
    let others: Vec<String> =
        found.suspicions.iter().skip(1).map(|other| remedy_words(rows, other)).collect();
    let others = match &others[..] {
        [] => String::new(),
        [other] => format!(" Another repair is possible: {other}."),
        _ => format!(" Other repairs are possible: {}.", others.join("; ")),
    };
    let first = found.first();
    let is_window = changed_entries(rows, slip).iter().all(|place| place[0] < 2);
    let as_given = if is_window && is_mirrored(&first) {
        format!(" As given, it is {}.", describe_meaning(&first))
    } else {
        String::new()
    };
    verdict + &others + &as_given
}

/// Adds a misprint with the same numbers to a verdict.
fn add_same_numbers(what: String, found: &Recognition) -> String {
    match found.suspicions.first() {
        Some(slip) if slip.misprint == Misprint::Transposed => {
            let turned = slip.remedied.map(|matrix| describe_meaning(&recognize(matrix).first()));
            let turned = turned.unwrap_or_default();
            format!("{what} For row vectors, the same numbers are {turned}.")
        }
        Some(slip) => {
            let id = slip.misprint.id().map_or(String::new(), |id| format!(" ({id})"));
            format!(
                "{what} A known misprint{id} has the same numbers; in it, {}.",
                slip.misprint.description()
            )
        }
        None => what,
    }
}
