//! URI resolution within a sandbox of folders: finds the file that a URI refers to, and checks
//! whether it may be read.
//!
//! A model is untrusted input, and so are its URIs. Apart from `data:` URIs, they may only be
//! relative paths to files below one folder, the root. Absolute paths, other schemes, `..` above
//! the root, symbolic links that lead out of it, devices, pipes, and files larger than the limit
//! are rejected. Everything is checked before a file is opened, and a path that would leave the
//! root is rejected without checking whether it exists. The user may allow other folders
//! ([`ImportOptions::allow_outside`]); `..` and symbolic links may then also lead there.

use super::ImportOptions;
use super::limits::Limits;
use super::memory_folder::{MemoryFolder, normalize_path};
use super::percent_encoding::{percent_decode, percent_decode_bytes};
use base64::Engine;
use base64::alphabet;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use model::{Diagnostic, codes};
use std::cell::Cell;
use std::fs::File;
use std::io::Read;
use std::path::{Component, Path, PathBuf};

/// Reads the files and data URIs that a file refers to.
#[derive(Debug)]
pub struct UriResolver<'a> {
    /// The allowed location of files.
    source: AssetSource<'a>,
    /// The limits in effect.
    pub limits: &'a Limits,
    /// Whether a missing file causes only a warning; see [`ImportOptions::lenient`].
    pub lenient: bool,
    /// The number of bytes read so far.
    bytes_read: Cell<u64>,
}

/// The allowed location of referenced files.
#[derive(Debug)]
enum AssetSource<'a> {
    /// No files are allowed, because the referring file is in memory and has no folder.
    Nowhere,
    /// In folders on disk.
    Disk(AssetSandbox),
    /// In a folder in memory, relative to the folder of the referring file.
    Memory(&'a MemoryFolder, String),
}

/// The folders that may contain referenced files.
///
/// The path of a file is canonicalized before it is compared with them, so `..` and symbolic links
/// make no difference.
#[derive(Debug)]
struct AssetSandbox {
    /// The folder that paths are relative to.
    folder: PathBuf,
    /// Canonical folder paths; every file must be below one of them.
    roots: Vec<PathBuf>,
}

impl<'a> UriResolver<'a> {
    /// Creates a resolver for the assets of `file`, in its own folder or in folders named in the
    /// options.
    ///
    /// The file itself has already been read; its `length` counts against the limit.
    ///
    /// # Errors
    /// Fails if the folder of the file, or a folder named in the options, does not exist.
    pub fn new(file: &Path, length: usize, options: &'a ImportOptions) -> Result<Self, Diagnostic> {
        let parent = match file.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent,
            _ => Path::new("."),
        };
        let folder = canonical_folder(parent)?;
        let root = options.root.as_deref().map_or_else(|| Ok(folder.clone()), canonical_folder)?;
        Self::with_sandbox(Some((folder, root)), length, options)
    }

    /// Creates a resolver for a file in memory, with assets below the root. Without a root, assets
    /// cannot be files.
    ///
    /// # Errors
    /// Fails if a folder that the options name does not exist.
    pub fn in_memory(length: usize, options: &'a ImportOptions) -> Result<Self, Diagnostic> {
        let root = options.root.as_deref().map(canonical_folder).transpose()?;
        Self::with_sandbox(root.map(|root| (root.clone(), root)), length, options)
    }

    /// Creates a resolver for a file in an in-memory folder, with assets in the same folder.
    pub fn in_memory_folder(
        folder: &'a MemoryFolder,
        path: &str,
        length: usize,
        options: &'a ImportOptions,
    ) -> Self {
        let base = path.rsplit_once('/').map_or("", |(base, _)| base).to_owned();
        let ImportOptions { limits, lenient, .. } = options;
        let (source, bytes_read) = (AssetSource::Memory(folder, base), Cell::new(length as u64));
        Self { source, limits, lenient: *lenient, bytes_read }
    }

    /// Creates a resolver for assets whose paths are relative to a folder and stay below a root.
    ///
    /// # Errors
    /// Fails if an allowed folder does not exist.
    fn with_sandbox(
        sandbox: Option<(PathBuf, PathBuf)>,
        length: usize,
        options: &'a ImportOptions,
    ) -> Result<Self, Diagnostic> {
        let ImportOptions { limits, lenient, allow_outside, .. } = options;
        let further = allow_outside.iter().map(|folder| canonical_allowed_folder(folder));
        let further: Vec<PathBuf> = further.collect::<Result<_, _>>()?;
        let source = sandbox.map_or(AssetSource::Nowhere, |(folder, root)| {
            let roots = std::iter::once(root).chain(further).collect();
            AssetSource::Disk(AssetSandbox { folder, roots })
        });
        Ok(Self { source, limits, lenient: *lenient, bytes_read: Cell::new(length as u64) })
    }

    /// Reads the bytes that a URI refers to; `pointer` is the location of the URI.
    ///
    /// # Errors
    /// Fails if the file does not exist, is outside the sandbox or is too large, or if the data URI
    /// is malformed.
    pub fn read_uri(&self, uri: &str, pointer: &str) -> Result<Vec<u8>, Diagnostic> {
        let bytes = match uri.split_once(':') {
            Some((scheme, data)) if scheme.eq_ignore_ascii_case("data") => {
                decode_data_uri(data, pointer)?
            }
            _ => self.read_asset(uri, pointer)?,
        };
        self.bytes_read.set(self.bytes_read.get().saturating_add(bytes.len() as u64));
        if self.bytes_read.get() > self.limits.total_bytes {
            let what = format!("{} bytes have been read so far", self.bytes_read.get());
            return Err(Diagnostic::limit_exceeded(
                pointer,
                &what,
                "total_bytes",
                self.limits.total_bytes,
            ));
        }
        Ok(bytes)
    }

    /// Returns the number of bytes in all files read so far.
    pub fn total_bytes(&self) -> u64 {
        self.bytes_read.get()
    }

    /// Reads the file that a URI refers to. The URI is tried literally, then percent-decoded, then
    /// with each `\` replaced by `/`.
    ///
    /// Exporters disagree about escaping, and some write Windows paths, so the first existing
    /// candidate is used. Each candidate is checked against the sandbox.
    ///
    /// # Errors
    /// Fails if the URI is empty, if the path leaves the sandbox, if no candidate exists, or if the
    /// file is too large.
    fn read_asset(&self, uri: &str, pointer: &str) -> Result<Vec<u8>, Diagnostic> {
        if uri.is_empty() {
            return Err(Diagnostic::invalid(pointer, "the URI is empty"));
        }
        let decoded = percent_decode(uri);
        let candidates =
            [Some(uri.to_owned()), decoded.clone(), decoded.map(|d| d.replace('\\', "/"))];
        for candidate in candidates.into_iter().flatten() {
            if let Some(bytes) = self.read_candidate(&candidate, uri, pointer)? {
                return Ok(bytes);
            }
        }
        Err(match uri_scheme(uri) {
            Some(scheme) => {
                let message = format!("the scheme {scheme:?} of {uri:?} is not supported");
                forbidden_path(pointer, &message)
            }
            None => missing_file(pointer, uri),
        })
    }

    /// Reads the file at a relative path. Returns `None` if it does not exist.
    ///
    /// # Errors
    /// Fails if the path leaves the sandbox, or if the file is too large or is not a regular file.
    fn read_candidate(
        &self,
        path: &str,
        uri: &str,
        pointer: &str,
    ) -> Result<Option<Vec<u8>>, Diagnostic> {
        match &self.source {
            AssetSource::Nowhere => {
                let message = format!("a model in memory cannot refer to the file {uri:?}");
                let help = "load the model from its own file, or export it as a .glb, which \
                            contains everything";
                Err(Diagnostic::error(codes::FORBIDDEN_PATH, pointer, message, help))
            }
            AssetSource::Disk(sandbox) => {
                // Canonical paths contain no symbolic links that could lead out of the folder.
                let Ok(path) = sandbox.path_below_root(path, pointer)?.canonicalize() else {
                    return Ok(None);
                };
                let path = sandbox.check_path(path, uri, pointer)?;
                read_file(&path, self.limits, pointer).map(Some)
            }
            AssetSource::Memory(folder, base) => {
                let outside =
                    || forbidden_path(pointer, &format!("{path:?} is outside the model's folder"));
                let path = normalize_path(base, path).ok_or_else(outside)?;
                Ok(folder.file(&path).map(<[u8]>::to_vec))
            }
        }
    }
}

impl AssetSandbox {
    /// Returns whether a path is below one of the roots.
    fn contains_path(&self, path: &Path) -> bool {
        self.roots.iter().any(|root| path.starts_with(root))
    }

    /// Joins a relative path to the folder if the result is below a root.
    ///
    /// This is the first of two checks, before any file system access: a model that refers to
    /// `../../secret` cannot even reveal whether that file exists. The second,
    /// [`check_path`](Self::check_path), checks the canonical path and catches symbolic links.
    ///
    /// With a single root, the path never leaves it. With several, `..` must be able to lead from
    /// one root to another.
    fn path_below_root(&self, name: &str, pointer: &str) -> Result<PathBuf, Diagnostic> {
        let outside =
            || Err(forbidden_path(pointer, &format!("{name:?} is outside the model's folder")));
        let has_drive_letter = cfg!(windows) && name.contains(':');
        if name.starts_with(['/', '\\']) || name.contains('\0') || has_drive_letter {
            return outside();
        }
        let (mut path, has_several_roots) = (self.folder.clone(), self.roots.len() > 1);
        for part in Path::new(name).components() {
            match part {
                Component::Normal(part) => path.push(part),
                Component::CurDir => {}
                Component::ParentDir
                    if (has_several_roots || path != self.roots[0]) && path.pop() => {}
                _ => return outside(),
            }
        }
        if self.contains_path(&path) { Ok(path) } else { outside() }
    }

    /// Checks that an existing canonical path is a regular file inside the sandbox, even if it was
    /// reached through symbolic links.
    fn check_path(&self, path: PathBuf, uri: &str, pointer: &str) -> Result<PathBuf, Diagnostic> {
        if !self.contains_path(&path) {
            return Err(forbidden_path(
                pointer,
                &format!("{uri:?} points outside the model's folder"),
            ));
        }
        if !path.is_file() {
            return Err(forbidden_path(pointer, &format!("{uri:?} is not a regular file")));
        }
        Ok(path)
    }
}

/// Reads a whole regular file, up to the limit.
///
/// The size is checked before reading, and the read itself is limited, because a file may grow in
/// the meantime and special files report a size of 0. One byte more than the limit is read, to
/// detect a file that exceeds it.
///
/// # Errors
/// Fails if the file does not exist, cannot be read, is not a regular file, or is too large.
pub fn read_file(path: &Path, limits: &Limits, pointer: &str) -> Result<Vec<u8>, Diagnostic> {
    let to_diagnostic = |error: std::io::Error| unreadable_file(pointer, path, &error);
    let metadata = path.metadata().map_err(to_diagnostic)?;
    if !metadata.is_file() {
        let message =
            if metadata.is_dir() { "this is a folder" } else { "this is not a regular file" };
        return Err(Diagnostic::error(
            codes::IO_ERROR,
            pointer,
            message.to_owned(),
            "specify a regular file",
        ));
    }
    let allowed = limits.file_bytes;
    let mut bytes = Vec::new();
    if metadata.len() <= allowed {
        // With one spare byte, `read_to_end` detects the end without a second allocation.
        bytes.reserve_exact(usize::try_from(metadata.len()).unwrap_or(0).saturating_add(1));
        let file = File::open(path).map_err(to_diagnostic)?;
        file.take(allowed.saturating_add(1)).read_to_end(&mut bytes).map_err(to_diagnostic)?;
    }
    let length = metadata.len().max(bytes.len() as u64);
    if length > allowed {
        let what = format!("the file has {length} bytes");
        return Err(Diagnostic::limit_exceeded(pointer, &what, "file_bytes", allowed));
    }
    Ok(bytes)
}

/// Returns the canonical path of a folder in which the user allows files.
fn canonical_allowed_folder(folder: &Path) -> Result<PathBuf, Diagnostic> {
    folder.canonicalize().map_err(|error| {
        let message = format!("cannot use the allowed folder {}: {error}", folder.display());
        Diagnostic::error(codes::IO_ERROR, "", message, "specify an existing folder")
    })
}

/// Returns the canonical path of a folder that must exist.
fn canonical_folder(folder: &Path) -> Result<PathBuf, Diagnostic> {
    folder.canonicalize().map_err(|error| unreadable_file("", folder, &error))
}

/// Returns the error for a file that cannot be opened or read.
///
/// The two common cases, a missing file and denied permission, have specific messages and advice.
fn unreadable_file(pointer: &str, path: &Path, error: &std::io::Error) -> Diagnostic {
    // An empty pointer means the model file itself, whose path precedes the message.
    let name = if pointer.is_empty() { "the file".to_owned() } else { path.display().to_string() };
    let (message, help) = match error.kind() {
        std::io::ErrorKind::NotFound => (format!("{name} does not exist"), "check the name"),
        std::io::ErrorKind::PermissionDenied => {
            (format!("{name} cannot be read: permission denied"), "check its permissions")
        }
        _ => (format!("{name} cannot be read: {error}"), "check the file"),
    };
    Diagnostic::error(codes::IO_ERROR, pointer, message, help)
}

/// Returns the error for a missing file.
pub fn missing_file(pointer: &str, name: &str) -> Diagnostic {
    let message = format!("the file {name:?} does not exist");
    Diagnostic::error(codes::IO_ERROR, pointer, message, "put it next to the model")
}

/// Checks the size of a file in memory.
///
/// # Errors
/// Fails if the file is larger than the limit.
pub fn check_file_size(length: usize, limits: &Limits) -> Result<(), Diagnostic> {
    let (length, allowed) = (length as u64, limits.file_bytes);
    if length <= allowed {
        return Ok(());
    }
    Err(Diagnostic::limit_exceeded(
        "",
        &format!("the file has {length} bytes"),
        "file_bytes",
        allowed,
    ))
}

/// Returns the error for a path outside the sandbox.
fn forbidden_path(pointer: &str, message: &str) -> Diagnostic {
    let help = "copy the file next to the model and refer to it by a relative path, or allow its \
                folder with --allow-outside DIR";
    Diagnostic::error(codes::FORBIDDEN_PATH, pointer, message.to_owned(), help)
}

/// Returns the scheme of a URI (RFC 3986 §3.1), if any.
fn uri_scheme(uri: &str) -> Option<&str> {
    let (scheme, _) = uri.split_once(':')?;
    let mut letters = scheme.chars();
    let first = letters.next()?.is_ascii_alphabetic();
    let rest = letters.all(|c| c.is_ascii_alphanumeric() || "+-.".contains(c));
    (first && rest).then_some(scheme)
}

/// Base64 with or without padding; stray bits in the last digit are accepted.
const LENIENT_BASE64: GeneralPurposeConfig = GeneralPurposeConfig::new()
    .with_decode_allow_trailing_bits(true)
    .with_decode_padding_mode(DecodePaddingMode::Indifferent);

/// Decodes a data URI (RFC 2397) whose scheme has been removed. Both base64 alphabets are accepted.
fn decode_data_uri(data: &str, pointer: &str) -> Result<Vec<u8>, Diagnostic> {
    let Some((kind, data)) = data.split_once(',') else {
        return Err(Diagnostic::invalid(pointer, "the data URI has no comma before its data"));
    };
    if !kind.to_ascii_lowercase().ends_with(";base64") {
        let message =
            "the data URI is neither base64 nor percent-encoded with two digits after every %";
        return percent_decode_bytes(data).ok_or_else(|| Diagnostic::invalid(pointer, message));
    }
    let standard = GeneralPurpose::new(&alphabet::STANDARD, LENIENT_BASE64).decode(data);
    let bytes = standard.or_else(|error| {
        GeneralPurpose::new(&alphabet::URL_SAFE, LENIENT_BASE64).decode(data).map_err(|_| error)
    });
    bytes.map_err(|error| {
        Diagnostic::invalid(pointer, format!("the data URI is not base64: {error}"))
    })
}
