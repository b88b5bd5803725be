//! The files in a folder with their SHA-256 digests, and the differences between two folders.

use sha2::{Digest, Sha256};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

/// The files that one target wrote.
#[derive(Clone, Default, Debug)]
pub struct Outputs {
    digests: BTreeMap<String, [u8; 32]>,
    bytes: u64,
}

impl Outputs {
    /// Reads the files in a folder.
    ///
    /// # Errors
    /// Fails if a file cannot be read.
    pub fn read(folder: &Path) -> Result<Self, String> {
        let with_path = |error| format!("{}: {error}", folder.display());
        let mut outputs = Self::default();
        for entry in fs::read_dir(folder).map_err(with_path)? {
            let entry = entry.map_err(with_path)?;
            let bytes = fs::read(entry.path()).map_err(with_path)?;
            outputs.insert(entry.file_name().to_string_lossy().into_owned(), &bytes);
        }
        Ok(outputs)
    }

    fn insert(&mut self, name: String, bytes: &[u8]) {
        self.bytes += bytes.len() as u64;
        self.digests.insert(name, Sha256::digest(bytes).into());
    }

    /// Returns the number of files.
    pub fn file_count(&self) -> usize {
        self.digests.len()
    }

    /// Returns the total size of the files.
    pub fn byte_count(&self) -> u64 {
        self.bytes
    }

    /// Returns the SHA-256 of the list of file names and their digests, sorted by name.
    pub fn digest(&self) -> String {
        let mut all = Sha256::new();
        for (name, digest) in &self.digests {
            all.update(format!("{} {name}\n", hexadecimal(digest)));
        }
        hexadecimal(&all.finalize())
    }

    /// Returns the files, by name, that differ or are in only one of the two folders.
    pub fn differences(&self, other: &Self) -> Vec<String> {
        let names: BTreeSet<&String> = self.digests.keys().chain(other.digests.keys()).collect();
        let differs = |name: &&&String| self.digests.get(**name) != other.digests.get(**name);
        names.iter().filter(differs).map(|name| (*name).clone()).collect()
    }
}

fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outputs(files: &[(&str, &str)]) -> Outputs {
        let mut outputs = Outputs::default();
        for (name, text) in files {
            outputs.insert((*name).to_owned(), text.as_bytes());
        }
        outputs
    }

    #[test]
    fn changed_and_missing_files_are_differences() {
        let one = outputs(&[("a", "1"), ("b", "2"), ("c", "3")]);
        let other = outputs(&[("a", "1"), ("b", "4"), ("d", "3")]);
        assert_eq!(one.differences(&other), ["b", "c", "d"]);
        assert_eq!(one.differences(&one), [""; 0]);
        assert_ne!(one.digest(), other.digest());
        assert_eq!((one.file_count(), one.byte_count()), (3, 3));
    }

    #[test]
    fn the_digest_matches_sha256sum() {
        // printf 'ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad a\n' | sha256sum
        let expected = "f558893557ef8db5b3b643b8d470746c03217e6e78870cf099dcc84a5e67c255";
        assert_eq!(outputs(&[("a", "abc")]).digest(), expected);
    }
}
