//! The loader's diagnostics, except those that the validation has already reported.

use super::codes;
use super::diagnostics::Diagnostics;
use model::{Diagnostic, Model, Severity, codes as load};

/// Adds the loader's warnings or error to the diagnostics, and returns the error.
///
/// A warning is dropped if the validation already has a diagnostic at its location: both describe
/// the same defect, and the validation's code is more specific.
pub(super) fn add_load_outcome(
    loaded: Result<Model, Diagnostic>,
    diagnostics: &Diagnostics,
) -> Option<Diagnostic> {
    let model = match loaded {
        Ok(model) => model,
        Err(fault) => {
            add_refusal(&fault, diagnostics);
            return Some(fault);
        }
    };
    for warning in &model.warnings {
        if diagnostics.has_at_or_below(Severity::Warning, &warning.location) {
            continue;
        }
        let is_extension = warning.location.starts_with("/extensions");
        let code = match warning.code {
            load::MISLEADING_NAME => &codes::MISLEADING_NAME,
            _ if is_extension => &codes::NOT_SHOWN,
            _ => &codes::LEFT_OUT,
        };
        let help = warning.help.as_deref().unwrap_or(code.remedy);
        diagnostics.add_with_help(code, &warning.location, &warning.message, help);
    }
    None
}

/// Adds the loader's error with a validator code, unless an error at or below the same location
/// already explains it.
fn add_refusal(fault: &Diagnostic, diagnostics: &Diagnostics) {
    let is_known = diagnostics.has_at_or_below(Severity::Error, &fault.location);
    let has_errors = diagnostics.has_errors();
    let code = match fault.code {
        load::UNSUPPORTED_REQUIRED_EXTENSION => &codes::UNSUPPORTED_REQUIRED_EXTENSION,
        load::LIMIT_EXCEEDED => &codes::LIMIT_EXCEEDED,
        load::NOT_GLTF if has_errors => return,
        load::NOT_GLTF => &codes::NOT_GLTF,
        load::UNKNOWN_FORMAT => &codes::UNKNOWN_FORMAT,
        _ if is_known || fault.location.is_empty() && has_errors => return,
        load::IO_ERROR | load::FORBIDDEN_PATH => &codes::IO_ERROR,
        load::UNSUPPORTED_VERSION => &codes::UNSUPPORTED_VERSION,
        _ => &codes::NOT_LOADED,
    };
    diagnostics.add_with_help(
        code,
        &fault.location,
        &fault.message,
        fault.help.as_deref().unwrap_or_default(),
    );
}
