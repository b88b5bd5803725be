//! ASCII STL: solids made of facets, written as keywords and decimal numbers.
//!
//! ```text
//!  solid NAME
//!    facet normal 0 0 1
//!      outer loop
//!        vertex 0 0 0
//!        vertex 1 0 0
//!        vertex 0 1 0
//!      endloop
//!    endfacet
//!  endsolid NAME
//! ```
//!
//! Keywords may be in upper or lower case, and any white space may separate them.

use super::solid::Solid;
use super::truncated;
use crate::text::{LineCounter, TextScanner, Token, parse_f32};
use gltf_import::ImportWarnings;
use gltf_import::Limits;
use model::{Diagnostic, codes};

/// Reads the solids in a text file.
///
/// # Errors
/// Fails if the text has unexpected words or facets that are not triangles, or ends within a facet;
/// in lenient mode such statements are skipped. Also fails if there are more solids than the limit
/// on nodes allows.
pub(super) fn read_solids(
    text: &[u8],
    limits: &Limits,
    warnings: &mut ImportWarnings,
) -> Result<Vec<Solid>, Diagnostic> {
    let mut reader = SolidReader {
        text,
        scanner: TextScanner::new(text),
        lines: LineCounter::new(text),
        limits,
        warnings,
        solids: Vec::new(),
        current: Solid::default(),
        is_open: false,
    };
    while let Some(token) = reader.scanner.next_token() {
        if let Err(diagnostic) = reader.read_statement(token) {
            let consequence = "it is skipped";
            reader.warnings.downgrade_if_lenient(diagnostic, consequence)?;
        }
    }
    if reader.is_open {
        let message = "the last solid lacks endsolid; the file may be truncated";
        let location = reader.lines.locate(text.len());
        reader.warnings.push_warning(&location, message);
    }
    reader.finish_solid()?;
    Ok(reader.solids)
}

/// Reads the statements of a text file.
struct SolidReader<'a, 'w> {
    text: &'a [u8],
    scanner: TextScanner<'a>,
    lines: LineCounter<'a>,
    limits: &'a Limits,
    warnings: &'w mut ImportWarnings,
    /// The completed solids, except for those without triangles.
    solids: Vec<Solid>,
    /// The solid being read.
    current: Solid,
    /// Whether its `solid` has been read but not yet its `endsolid`.
    is_open: bool,
}

impl<'a> SolidReader<'a, '_> {
    /// Reads the statement that starts with a keyword: a facet, or the beginning or end of a solid.
    fn read_statement(&mut self, keyword: Token<'a>) -> Result<(), Diagnostic> {
        if keyword.is_keyword("facet") {
            return self.read_facet(keyword);
        }
        if keyword.is_keyword("solid") {
            self.finish_solid()?;
            self.current.name = Some(self.read_name());
            self.is_open = true;
            return Ok(());
        }
        if keyword.is_keyword("endsolid") {
            self.is_open = false;
            self.read_name();
            return self.finish_solid();
        }
        self.scanner.next_line();
        Err(self.unexpected(keyword, "facet"))
    }

    /// Reads a name: the rest of the line, up to any facet or `endsolid`, because some files have
    /// no line ends.
    fn read_name(&mut self) -> String {
        let mut rest = self.scanner.clone();
        let Some(line) = rest.next_line() else { return String::new() };
        let mut tokens = line.tokens();
        while let Some(token) = tokens.next() {
            let is_facet = token.is_keyword("facet")
                && tokens.clone().next().is_some_and(|next| next.is_keyword("normal"));
            if is_facet || token.is_keyword("endsolid") {
                let length = token.offset - line.offset;
                let name = Token { bytes: &line.bytes[..length], offset: line.offset };
                self.scanner = TextScanner::starting_at(self.text, token.offset);
                return name.trim().to_text();
            }
        }
        self.scanner = rest;
        line.trim().to_text()
    }

    /// Reads a facet from its normal to its end, and adds its triangle.
    ///
    /// After an error, skips to the next facet or to the beginning or end of a solid.
    fn read_facet(&mut self, keyword: Token<'a>) -> Result<(), Diagnostic> {
        if let Some(corners) = self.read_usual_corners() {
            let lines = &mut self.lines;
            self.current.push_triangle(corners, || lines.locate(keyword.offset));
            return Ok(());
        }
        let corners = self.read_corners();
        if corners.is_err() {
            self.skip_facet();
        }
        let lines = &mut self.lines;
        self.current.push_triangle(corners?, || lines.locate(keyword.offset));
        Ok(())
    }

    /// Reads the corners of a facet in the usual lowercase form. Returns `None`, without consuming
    /// anything, for any other form.
    fn read_usual_corners(&mut self) -> Option<[[f32; 3]; 3]> {
        let mut scanner = self.scanner.clone();
        let skip = |scanner: &mut TextScanner<'a>, tokens: &[&[u8]]| {
            tokens.iter().all(|token| scanner.skip_token(token)).then_some(())
        };
        skip(&mut scanner, &[b"normal"])?;
        for _ in 0..3 {
            scanner.next_token()?;
        }
        skip(&mut scanner, &[b"outer", b"loop"])?;
        let mut corners = [[0.0; 3]; 3];
        for corner in &mut corners {
            skip(&mut scanner, &[b"vertex"])?;
            for number in corner {
                *number = scanner.next_simple_number()?;
            }
        }
        skip(&mut scanner, &[b"endloop", b"endfacet"])?;
        self.scanner = scanner;
        Some(corners)
    }

    /// Reads the corners of a facet. Its normal is skipped, even if it is malformed.
    fn read_corners(&mut self) -> Result<[[f32; 3]; 3], Diagnostic> {
        let mut token = self.require("normal")?;
        if token.is_keyword("normal") {
            // Stop at the keyword `outer`, because the normal may have too few numbers.
            for _ in 0..4 {
                token = self.require("outer")?;
                if token.is_keyword("outer") {
                    break;
                }
            }
        }
        self.check_keyword(token, "outer")?;
        self.expect_keyword("loop")?;
        let mut corners = [[0.0; 3]; 3];
        for corner in &mut corners {
            self.expect_keyword("vertex")?;
            for number in corner {
                let token = self.require("a number")?;
                *number =
                    parse_f32(token.bytes).ok_or_else(|| self.unexpected(token, "a number"))?;
            }
        }
        self.expect_keyword("endloop")?;
        self.expect_keyword("endfacet")?;
        Ok(corners)
    }

    /// Returns the next token; `wanted` describes the expected token.
    fn require(&mut self, wanted: &str) -> Result<Token<'a>, Diagnostic> {
        self.scanner.next_token().ok_or_else(|| {
            let location = self.lines.locate(self.text.len());
            truncated(&location, format!("the file ends where {wanted} is expected"))
        })
    }

    /// Reads the next token, which must be this keyword.
    fn expect_keyword(&mut self, wanted: &str) -> Result<(), Diagnostic> {
        let token = self.require(wanted)?;
        self.check_keyword(token, wanted)
    }

    /// Checks that a token is the expected keyword.
    fn check_keyword(&mut self, token: Token<'a>, wanted: &str) -> Result<(), Diagnostic> {
        if token.is_keyword(wanted) { Ok(()) } else { Err(self.unexpected(token, wanted)) }
    }

    /// Skips tokens up to the next facet or the beginning or end of a solid.
    fn skip_facet(&mut self) {
        loop {
            let before = self.scanner.clone();
            let Some(token) = self.scanner.next_token() else { return };
            if ["facet", "solid", "endsolid"].iter().any(|keyword| token.is_keyword(keyword)) {
                self.scanner = before;
                return;
            }
        }
    }

    /// Adds the current solid to the completed solids, unless it is empty.
    fn finish_solid(&mut self) -> Result<(), Diagnostic> {
        let solid = std::mem::take(&mut self.current);
        solid.warn_of_omissions(self.warnings);
        if solid.triangle_count() == 0 {
            return Ok(());
        }
        self.solids.push(solid);
        if self.solids.len() > self.limits.nodes {
            let what = format!("the file has at least {} solids", self.solids.len());
            let location = self.lines.locate(self.scanner.offset());
            let limit = self.limits.nodes as u64;
            return Err(Diagnostic::limit_exceeded(&location, &what, "nodes", limit));
        }
        Ok(())
    }

    /// Returns the error for an unexpected token.
    fn unexpected(&mut self, token: Token<'_>, wanted: &str) -> Diagnostic {
        let shown = token.bytes.get(..40).unwrap_or(token.bytes);
        let message = format!("expected {wanted}, found {:?}", String::from_utf8_lossy(shown));
        let location = self.lines.locate(token.offset);
        Diagnostic::error(codes::INVALID_DATA, &location, message, "export the file again")
    }
}
