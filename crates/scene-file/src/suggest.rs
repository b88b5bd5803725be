//! Suggestions for misspelled names.

/// The similarity above which a name is probably the intended name.
const SIMILAR: f64 = 0.8;

/// Returns the name most similar to `word`, if any is similar enough. Case is ignored.
///
/// The measure is the Jaro–Winkler similarity, which favors a common prefix. Below 0.8, a
/// suggestion would be misleading.
#[must_use]
pub fn closest_name<'a>(word: &str, names: &[&'a str]) -> Option<&'a str> {
    let similarity = |name: &str| strsim::jaro_winkler(&word.to_lowercase(), &name.to_lowercase());
    let best = names.iter().copied().max_by(|a, b| similarity(a).total_cmp(&similarity(b)))?;
    (similarity(best) > SIMILAR).then_some(best)
}

/// Returns `expected one of …` with all names, or `the only one is …`.
pub(super) fn list_names<S: AsRef<str>>(names: &[S]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("`{}`", name.as_ref())).collect();
    match names.as_slice() {
        [only] => format!("the only one is {only}"),
        names => format!("expected one of {}", names.join(", ")),
    }
}

/// Returns "did you mean", or the list of allowed names; `None` if there are no names.
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
