//! URIs of buffers and images: their syntax, and the bytes they refer to.

use super::codes;
use super::diagnostics::Diagnostics;
use gltf_import::UriResolver;
use model::{Diagnostic, codes as load};

/// Returns the media type of a data URI in lowercase, or `None` for other URIs.
///
/// The type is empty for `data:,`, which is text/plain according to RFC 2397.
pub(super) fn media_type(uri: &str) -> Option<String> {
    let (scheme, rest) = uri.split_once(':')?;
    let kind = rest.split([';', ',']).next()?;
    scheme.eq_ignore_ascii_case("data").then(|| kind.to_ascii_lowercase())
}

/// Checks the syntax of any URI.
///
/// Data URIs are discouraged in a GLB. Absolute URIs are discouraged everywhere, because they break
/// when the file is moved.
pub(super) fn check_uri(uri: &str, pointer: &str, is_binary: bool, diagnostics: &Diagnostics) {
    let is_data = media_type(uri).is_some();
    if is_data && is_binary {
        diagnostics.add(&codes::DATA_URI_GLB, pointer, "the GLB file contains a data URI");
    }
    let kind = uri.split(',').next().filter(|_| is_data);
    if kind.is_some_and(|kind| kind.split(';').skip(1).any(str::is_empty)) {
        diagnostics.add(&codes::INVALID_URI, pointer, "the data URI has an empty parameter");
    }
    let letters = |scheme: &str| {
        scheme.len() > 1 && scheme.bytes().all(|b| b.is_ascii_alphanumeric() || b"+-.".contains(&b))
    };
    let has_scheme = uri.split_once(':').is_some_and(|(scheme, _)| letters(scheme));
    if !is_data && (has_scheme || uri.starts_with('/')) {
        diagnostics.add(
            &codes::NON_RELATIVE_URI,
            pointer,
            format_args!("{uri:?} is not a relative path"),
        );
    }
}

/// Checks the syntax of a buffer's URI, and its media type if it is a data URI.
///
/// glTF 2.0 §3.6.1.1 allows two media types for buffers.
pub(super) fn check_buffer_uri(
    uri: &str,
    pointer: &str,
    is_binary: bool,
    diagnostics: &Diagnostics,
) {
    check_uri(uri, pointer, is_binary, diagnostics);
    if let Some(kind) = media_type(uri)
        && !["application/octet-stream", "application/gltf-buffer"].contains(&kind.as_str())
    {
        let message = format_args!("{kind:?} is not an allowed media type for a buffer");
        diagnostics.add(&codes::BUFFER_DATA_URI_MIME_TYPE_INVALID, pointer, message);
    }
}

/// Reads the bytes that a URI refers to. If this fails, reports a diagnostic and returns `None`.
///
/// Only files inside the allowed folders are read, and only within the limits.
pub(super) fn read_uri(
    resolver: &UriResolver<'_>,
    uri: &str,
    pointer: &str,
    diagnostics: &Diagnostics,
) -> Option<Vec<u8>> {
    if uri.starts_with(':') {
        let message = format_args!("{uri:?} starts with a colon");
        diagnostics.add(&codes::INVALID_URI, pointer, message);
        return None;
    }
    resolver.read_uri(uri, pointer).map_err(|fault| add_read_error(&fault, diagnostics)).ok()
}

/// Reports why a URI could not be read, under one of the validator's codes.
fn add_read_error(fault: &Diagnostic, diagnostics: &Diagnostics) {
    let code = match fault.code {
        load::INVALID_DATA => &codes::INVALID_URI,
        load::LIMIT_EXCEEDED => &codes::LIMIT_EXCEEDED,
        _ => &codes::IO_ERROR,
    };
    diagnostics.add_with_help(
        code,
        &fault.location,
        &fault.message,
        fault.help.as_deref().unwrap_or_default(),
    );
}
