//! What loading says of a file, without what the check has said already.

use super::codes;
use super::diagnostics::Diagnostics;
use super::report::Severity;
use crate::Model;
use crate::import::error::{Diagnostic, ImportErrorKind};

/// Adds the outcome of loading to the findings; gives the reason if the file was refused.
pub(super) fn add_load_outcome(
    loaded: Result<Model, Diagnostic>,
    findings: &Diagnostics,
) -> Option<Diagnostic> {
    let model = match loaded {
        Ok(model) => model,
        Err(fault) => {
            add_refusal(&fault, findings);
            return Some(fault);
        }
    };
    for warning in &model.warnings {
        if findings.has_at_or_below(Severity::Warning, &warning.pointer) {
            continue;
        }
        let is_extension = warning.pointer.starts_with("/extensions");
        let code = if is_extension { &codes::NOT_SHOWN } else { &codes::LEFT_OUT };
        findings.add(code, &warning.pointer, &warning.message);
    }
    None
}

fn add_refusal(fault: &Diagnostic, findings: &Diagnostics) {
    let is_known = findings.has_at_or_below(Severity::Error, &fault.location);
    let has_errors = findings.has_errors();
    let code = match fault.kind {
        ImportErrorKind::Extension => &codes::UNSUPPORTED_REQUIRED_EXTENSION,
        ImportErrorKind::Limit => &codes::LIMIT_EXCEEDED,
        ImportErrorKind::Format if has_errors => return,
        ImportErrorKind::Format => &codes::NOT_GLTF,
        _ if is_known || fault.location.is_empty() && has_errors => return,
        ImportErrorKind::Unreadable | ImportErrorKind::Forbidden => &codes::IO_ERROR,
        ImportErrorKind::Version => &codes::UNSUPPORTED_VERSION,
        ImportErrorKind::Invalid | ImportErrorKind::NoData | ImportErrorKind::NotFound => {
            &codes::NOT_LOADED
        }
    };
    findings.add_with_help(code, &fault.location, &fault.message, &fault.help);
}
