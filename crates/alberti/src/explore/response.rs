//! Responses: a status, a type and bytes, and the headers that every one of them has.

use std::borrow::Cow;
use std::io::{self, Write};

/// The resources that a page of this server may load: none of any other host.
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
    /// A response with the bytes that were asked for.
    pub(super) fn ok(
        content_type: impl Into<Cow<'a, str>>,
        bytes: impl Into<Cow<'a, [u8]>>,
    ) -> Self {
        Self { status: 200, content_type: content_type.into(), bytes: bytes.into() }
    }

    /// A sentence.
    pub(super) fn text(status: u16, text: &'a str) -> Self {
        let content_type = "text/plain; charset=utf-8".into();
        Self { status, content_type, bytes: Cow::Borrowed(text.as_bytes()) }
    }

    /// Writes the response, without its bytes if only the headers were asked for.
    ///
    /// # Errors
    /// If the connection is closed or too slow.
    pub(super) fn write_to(&self, stream: &mut impl Write, is_head: bool) -> io::Result<()> {
        let reason = match self.status {
            200 => "OK",
            404 => "Not Found",
            405 => "Method Not Allowed\r\nAllow: GET, HEAD",
            421 => "Misdirected Request",
            431 => "Request Header Fields Too Large",
            403 => "Forbidden",
            503 => "Service Unavailable",
            _ => "Bad Request",
        };
        let head = format!(
            "HTTP/1.1 {} {reason}\r\nContent-Type: {}\r\nContent-Length: {}\r\n\
             Content-Security-Policy: {CONTENT_SECURITY_POLICY}\r\nCache-Control: no-store\r\n\
             X-Content-Type-Options: nosniff\r\nCross-Origin-Resource-Policy: same-origin\r\n\
             Referrer-Policy: no-referrer\r\nConnection: close\r\n\r\n",
            self.status,
            self.content_type,
            self.bytes.len()
        );
        stream.write_all(head.as_bytes())?;
        if !is_head {
            stream.write_all(&self.bytes)?;
        }
        stream.flush()
    }
}
