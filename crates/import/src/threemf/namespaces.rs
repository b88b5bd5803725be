//! 3MF namespaces: the core specification, its extensions, and the level of support for each.

use super::xml::Element;
use gltf_import::ImportWarnings;
use model::{Diagnostic, codes};

/// The level of support for a namespace.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Support {
    /// Its elements are read.
    Read,
    /// Its elements do not affect the picture.
    Ignored,
    /// Its elements are skipped, with a warning.
    LeftOut,
    /// Without its elements the content cannot be shown as intended.
    Refused,
}

/// Namespaces, each with part of its URI, its name in messages, and its level of support.
const EXTENSIONS: [(&str, &str, Support); 11] = [
    ("3dmanufacturing/core/", "the core specification", Support::Read),
    ("3dmanufacturing/2013/", "the core specification", Support::Read),
    ("3dmanufacturing/material/", "materials and properties", Support::Read),
    ("3dmanufacturing/production/", "production", Support::Read),
    ("3dmanufacturing/trianglesets/", "triangle sets", Support::Ignored),
    ("3dmanufacturing/slice/", "slices", Support::LeftOut),
    ("3dmanufacturing/beamlattice/", "beam lattices", Support::LeftOut),
    ("3dmanufacturing/displacement/", "displacement", Support::LeftOut),
    ("3dmanufacturing/booleanoperations/", "Boolean operations", Support::LeftOut),
    ("3dmanufacturing/volumetric/", "volumetric data", Support::LeftOut),
    ("3dmanufacturing/securecontent/", "secure content (encryption)", Support::Refused),
];

/// The namespaces that a model part declares.
#[derive(Debug, Default)]
pub(super) struct Namespaces<'a> {
    /// Each prefix with its URI.
    prefixes: Vec<(&'a [u8], &'a [u8])>,
}

impl<'a> Namespaces<'a> {
    /// Reads the namespaces that the root element of a part declares.
    pub(super) fn from_root(root: &Element<'a>) -> Self {
        let declared = root.attributes().filter_map(|(prefix, local, uri)| match (prefix, local) {
            (b"xmlns", prefix) => Some((prefix, uri)),
            (b"", b"xmlns") => Some((&b""[..], uri)),
            _ => None,
        });
        // A part has only a few prefixes; a long list would make each lookup slow.
        Self { prefixes: declared.take(64).collect() }
    }

    /// Returns the name, for messages, and the level of support of a prefix's namespace. Elements
    /// with an undeclared prefix are read.
    pub(super) fn support_of(&self, prefix: &[u8]) -> (&'static str, Support) {
        let Some(uri) = self.prefixes.iter().find(|(p, _)| *p == prefix).map(|(_, uri)| *uri)
        else {
            return ("", Support::Read);
        };
        let uri = String::from_utf8_lossy(uri).to_ascii_lowercase();
        let known = EXTENSIONS.iter().find(|(part, ..)| uri.contains(part));
        known.map_or(("", Support::Ignored), |&(_, name, support)| (name, support))
    }

    /// Returns whether an element is read, which depends on its prefix.
    pub(super) fn is_read(&self, element: &Element<'_>) -> bool {
        // This is a fast path: every element is checked here, and most have no prefix.
        element.prefix().is_empty() || self.support_of(element.prefix()).1 == Support::Read
    }

    /// Checks the extensions that a part requires.
    ///
    /// # Errors
    /// Fails if an extension is unknown or encrypts the content; in lenient mode, it is ignored.
    pub(super) fn check_required(
        &self,
        root: &Element<'_>,
        location: &str,
        warnings: &mut ImportWarnings,
    ) -> Result<(), Diagnostic> {
        let required = root.text_attribute("requiredextensions").unwrap_or_default();
        // Each prefix may cause a warning, so the number of prefixes is limited.
        for prefix in required.split_ascii_whitespace().take(64) {
            let (name, support) = self.support_of(prefix.as_bytes());
            match support {
                Support::Read | Support::Refused | Support::Ignored if name.is_empty() => {
                    let message = format!("unknown required extension {prefix:?}");
                    let help = "export the file without it";
                    let code = codes::UNSUPPORTED_REQUIRED_EXTENSION;
                    let fault = Diagnostic::error(code, location, message, help);
                    warnings.downgrade_if_lenient(fault, "it is ignored")?;
                }
                Support::Refused => {
                    let message = format!("the file requires {name}, which is not supported");
                    let help = "export the file without it";
                    let code = codes::UNSUPPORTED_REQUIRED_EXTENSION;
                    let fault = Diagnostic::error(code, location, message, help);
                    warnings.downgrade_if_lenient(fault, "it is ignored")?;
                }
                Support::LeftOut => {
                    let message = format!("skipped {name}, which the file requires");
                    warnings.push_warning(location, message);
                }
                _ => {}
            }
        }
        Ok(())
    }
}
