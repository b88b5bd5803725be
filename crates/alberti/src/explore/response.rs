//! Responses: a status, a type, bytes, and the headers common to all responses.

use std::borrow::Cow;

/// The resources that a page of this server may load: none from any other host.
const CONTENT_SECURITY_POLICY: &str = "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; \
    img-src 'self' blob:; object-src 'none'; base-uri 'none'; form-action 'none'; \
    frame-ancestors 'none'";

/// The answer to a request.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Response<'a> {
    pub(super) status: u16,
    content_type: Cow<'a, str>,
    bytes: Cow<'a, [u8]>,
}

impl<'a> Response<'a> {
    /// Returns a response with the requested bytes.
    pub(super) fn ok(
        content_type: impl Into<Cow<'a, str>>,
        bytes: impl Into<Cow<'a, [u8]>>,
    ) -> Self {
        Self { status: 200, content_type: content_type.into(), bytes: bytes.into() }
    }

    /// Returns a plain-text response with one sentence.
    pub(super) fn text(status: u16, text: &'a str) -> Self {
        let content_type = "text/plain; charset=utf-8".into();
        Self { status, content_type, bytes: Cow::Borrowed(text.as_bytes()) }
    }

    /// Returns the bytes after the headers.
    pub(super) fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Returns the number of bytes held in memory only for this response.
    pub(super) fn owned_bytes(&self) -> usize {
        match &self.bytes {
            Cow::Owned(bytes) => bytes.len(),
            Cow::Borrowed(_) => 0,
        }
    }

    /// Returns the first line and the headers.
    pub(super) fn head(&self) -> String {
        let reason = match self.status {
            200 => "OK",
            403 => "Forbidden",
            404 => "Not Found",
            405 => "Method Not Allowed\r\nAllow: GET, HEAD",
            421 => "Misdirected Request",
            431 => "Request Header Fields Too Large",
            500 => "Internal Server Error",
            503 => "Service Unavailable",
            _ => "Bad Request",
        };
        format!(
            "HTTP/1.1 {} {reason}\r\nContent-Type: {}\r\nContent-Length: {}\r\n\
             Content-Security-Policy: {CONTENT_SECURITY_POLICY}\r\nCache-Control: no-store\r\n\
             X-Content-Type-Options: nosniff\r\nCross-Origin-Resource-Policy: same-origin\r\n\
             Referrer-Policy: no-referrer\r\nConnection: close\r\n\r\n",
            self.status,
            self.content_type,
            self.bytes.len()
        )
    }
}
