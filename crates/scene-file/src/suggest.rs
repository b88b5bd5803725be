//! Names that are close to a misspelt one.

/// The similarity above which a name is probably the one that was meant.
const SIMILAR: f64 = 0.8;

/// The name that is most like `word`, if one is similar. Capitals do not count.
///
/// Similarity is that of Jaro and Winkler, which favors a common beginning; below 0.8 of it a
/// suggestion would mislead.
#[must_use]
pub fn closest_name<'a>(word: &str, names: &[&'a str]) -> Option<&'a str> {
    let similarity = |name: &str| strsim::jaro_winkler(&word.to_lowercase(), &name.to_lowercase());
    let best = names.iter().copied().max_by(|a, b| similarity(a).total_cmp(&similarity(b)))?;
    (similarity(best) > SIMILAR).then_some(best)
}

/// `expected one of …` with all names.
pub(super) fn list_names<S: AsRef<str>>(names: &[S]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("`{}`", name.as_ref())).collect();
    match names.as_slice() {
        [only] => format!("the only one is {only}"),
        names => format!("expected one of {}", names.join(", ")),
    }
}

/// "Did you mean", or the list of the names that are possible; `None` if there are none.
#[must_use]
pub fn suggest_name<S: AsRef<str>>(word: &str, names: &[S]) -> Option<String> {
    let all: Vec<&str> = names.iter().map(AsRef::as_ref).collect();
    if all.is_empty() {
        return None;
    }
    Some(
        closest_name(word, &all)
            .map_or_else(|| list_names(&all), |name| format!("did you mean `{name}`?")),
    )
}
