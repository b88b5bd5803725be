//! What loading says of a file, without what the check has said already.

use super::codes;
use super::findings::Findings;
use super::report::Severity;
use crate::Model;
use crate::import::error::{Fault, FaultKind};

/// Adds the outcome of loading to the findings; gives the reason if the file was refused.
pub(super) fn tell(loaded: Result<Model, Fault>, findings: &Findings) -> Option<Fault> {
    let model = match loaded {
        Ok(model) => model,
        Err(fault) => {
            tell_refusal(&fault, findings);
            return Some(fault);
        }
    };
    for warning in &model.warnings {
        if findings.knows(Severity::Warning, &warning.pointer) {
            continue;
        }
        let is_extension = warning.pointer.starts_with("/extensions");
        let code = if is_extension { &codes::NOT_SHOWN } else { &codes::LEFT_OUT };
        findings.add(code, &warning.pointer, &warning.message);
    }
    None
}

fn tell_refusal(fault: &Fault, findings: &Findings) {
    let is_told = findings.knows(Severity::Error, &fault.pointer);
    let has_errors = findings.has_errors();
    let code = match fault.kind {
        FaultKind::Extension => &codes::UNSUPPORTED_REQUIRED_EXTENSION,
        FaultKind::Limit => &codes::LIMIT_EXCEEDED,
        FaultKind::Format if has_errors => return,
        FaultKind::Format => &codes::NOT_GLTF,
        _ if is_told || fault.pointer.is_empty() && has_errors => return,
        FaultKind::Unreadable | FaultKind::Forbidden => &codes::IO_ERROR,
        FaultKind::Version => &codes::UNSUPPORTED_VERSION,
        FaultKind::Invalid | FaultKind::NoData | FaultKind::Choice => &codes::NOT_LOADED,
    };
    findings.add_with(code, &fault.pointer, &fault.problem, &fault.remedy);
}
