//! Reads and writes tar archives (POSIX.1-1988 `ustar`) of regular files.
//!
//! A file is a header of 512 bytes, then its content, padded to a multiple of 512 bytes; two blocks
//! of zeros end the archive. A name that is too long for the header is stored in a separate record
//! before the header (POSIX.1-2001 `pax`, type `x`). Owner, permissions and time are the same for
//! all files, so that the same files give the same bytes.

use std::io::{Error, ErrorKind, Read, Result, Write};
use std::ops::Range;

/// The unit of length in an archive.
const BLOCK_BYTES: usize = 512;
/// The maximum length of a `pax` record that is read.
const MAX_NAME_RECORD: u64 = 1 << 16;

/// The fields of a header.
const NAME: Range<usize> = 0..100;
const MODE: Range<usize> = 100..108;
const USER: Range<usize> = 108..116;
const GROUP: Range<usize> = 116..124;
const SIZE: Range<usize> = 124..136;
const TIME: Range<usize> = 136..148;
const CHECKSUM: Range<usize> = 148..156;
const TYPE: usize = 156;
const MAGIC: Range<usize> = 257..265;
const PREFIX: Range<usize> = 345..500;

/// Appends a file to an archive.
///
/// # Errors
/// Returns an error if writing to the archive fails, or if the file has 8 GiB or more.
pub(super) fn append_file(writer: &mut impl Write, name: &str, content: &[u8]) -> Result<()> {
    let mut header = [0; BLOCK_BYTES];
    if let Some((prefix, name)) = split_name(name) {
        header[NAME][..name.len()].copy_from_slice(name.as_bytes());
        header[PREFIX][..prefix.len()].copy_from_slice(prefix.as_bytes());
    } else {
        let record = pax_record("path", name);
        let mut before = [0; BLOCK_BYTES];
        before[NAME][..9].copy_from_slice(b"PaxHeader");
        append_block(writer, before, b'x', record.as_bytes())?;
        // This name is for readers that do not understand the record.
        let cut =
            name.char_indices().map(|(at, c)| at + c.len_utf8()).take_while(|end| *end <= 100);
        let cut = cut.last().unwrap_or(0);
        header[NAME][..cut].copy_from_slice(&name.as_bytes()[..cut]);
    }
    append_block(writer, header, b'0', content)
}

/// Finishes an archive.
///
/// # Errors
/// Returns an error if writing to the archive fails.
pub(super) fn finish_archive(writer: &mut impl Write) -> Result<()> {
    writer.write_all(&[0; 2 * BLOCK_BYTES])
}

/// Completes a header that has a name and writes it with the content.
fn append_block(
    writer: &mut impl Write,
    mut header: [u8; BLOCK_BYTES],
    kind: u8,
    content: &[u8],
) -> Result<()> {
    let size = format!("{:011o}\0", content.len());
    // The format has eleven octal digits for a size.
    if size.len() != SIZE.len() {
        return Err(Error::new(
            ErrorKind::FileTooLarge,
            "files in a tar archive must be smaller than 8 GiB",
        ));
    }
    header[SIZE].copy_from_slice(size.as_bytes());
    // Mode, owner and time are fixed, so that equal pictures give equal archives.
    header[MODE].copy_from_slice(b"0000644\0");
    header[USER].copy_from_slice(b"0000000\0");
    header[GROUP].copy_from_slice(b"0000000\0");
    header[TIME].copy_from_slice(b"00000000000\0");
    header[TYPE] = kind;
    header[MAGIC].copy_from_slice(b"ustar\x0000");
    // POSIX: six octal digits, a zero byte and a space.
    let sum = format!("{:06o}\0 ", header_sum(&header));
    header[CHECKSUM].copy_from_slice(sum.as_bytes());
    writer.write_all(&header)?;
    writer.write_all(content)?;
    let padding = content.len().next_multiple_of(BLOCK_BYTES) - content.len();
    writer.write_all(&[0; BLOCK_BYTES][..padding])
}

/// Returns the checksum of a header: the sum of its bytes, with spaces in the checksum field.
fn header_sum(header: &[u8; BLOCK_BYTES]) -> u32 {
    let spaces = CHECKSUM.len() as u32 * u32::from(b' ');
    let all: u32 = header.iter().map(|byte| u32::from(*byte)).sum();
    let own: u32 = header[CHECKSUM].iter().map(|byte| u32::from(*byte)).sum();
    all - own + spaces
}

/// Splits a name into the two fields of a header, which are joined by a slash; returns `None` if
/// the name is too long.
fn split_name(name: &str) -> Option<(&str, &str)> {
    if name.len() <= NAME.len() {
        return Some(("", name));
    }
    let fits = |prefix: &str, rest: &str| prefix.len() <= PREFIX.len() && rest.len() <= NAME.len();
    let slashes = name.match_indices('/').map(|(at, _)| (&name[..at], &name[at + 1..]));
    slashes.into_iter().find(|(prefix, rest)| fits(prefix, rest) && !rest.is_empty())
}

/// Returns a `pax` record, which consists of its own length in decimal, a space, `KEY=VALUE` and a
/// line break.
fn pax_record(key: &str, value: &str) -> String {
    let rest = format!(" {key}={value}\n");
    let mut length = rest.len();
    // The length includes its own digits.
    while length != rest.len() + length.to_string().len() {
        length = rest.len() + length.to_string().len();
    }
    format!("{length}{rest}")
}

/// Reads an archive written by [`append_file`]: `visit` receives the name and content of each file
/// and need not read the content to the end.
///
/// # Errors
/// Returns an error if the archive cannot be read, is truncated, or has a damaged header.
pub(super) fn read_archive(
    reader: &mut impl Read,
    mut visit: impl FnMut(&str, &mut dyn Read) -> Result<()>,
) -> Result<()> {
    let damaged = |what: &str| Error::new(ErrorKind::InvalidData, what.to_owned());
    let mut long_name = None;
    loop {
        let mut header = [0; BLOCK_BYTES];
        reader.read_exact(&mut header)?;
        // Two zero blocks end an archive; the first one is enough.
        if header == [0; BLOCK_BYTES] {
            return Ok(());
        }
        let number = |field: Range<usize>| {
            let text = std::str::from_utf8(&header[field]).ok()?;
            u64::from_str_radix(text.trim_end_matches(['\0', ' ']), 8).ok()
        };
        if number(CHECKSUM) != Some(header_sum(&header).into()) {
            return Err(damaged("a header has a wrong checksum"));
        }
        let size = number(SIZE).ok_or_else(|| damaged("a size is not a number"))?;
        let mut content = reader.take(size);
        if header[TYPE] == b'x' && size <= MAX_NAME_RECORD {
            let mut record = String::new();
            content.read_to_string(&mut record)?;
            let path = record.split_once(" path=").and_then(|(_, path)| path.strip_suffix('\n'));
            long_name = path.map(str::to_owned);
        } else {
            let name = long_name.take().unwrap_or_else(|| header_name(&header));
            visit(&name, &mut content)?;
        }
        let padding = size.next_multiple_of(BLOCK_BYTES as u64) - size;
        let rest = content.limit() + padding;
        if std::io::copy(&mut reader.take(rest), &mut std::io::sink())? != rest {
            return Err(ErrorKind::UnexpectedEof.into());
        }
    }
}

/// Returns the name in the two fields of a header.
fn header_name(header: &[u8; BLOCK_BYTES]) -> String {
    let text = |field: Range<usize>| {
        let bytes = header[field].split(|byte| *byte == 0).next().unwrap_or_default();
        String::from_utf8_lossy(bytes).into_owned()
    };
    match text(PREFIX) {
        prefix if prefix.is_empty() => text(NAME),
        prefix => format!("{prefix}/{}", text(NAME)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the names and contents in an archive.
    fn files_in(mut archive: &[u8]) -> Result<Vec<(String, Vec<u8>)>> {
        let mut files = Vec::new();
        read_archive(&mut archive, |name, content| {
            let mut bytes = Vec::new();
            content.read_to_end(&mut bytes)?;
            files.push((name.to_owned(), bytes));
            Ok(())
        })?;
        Ok(files)
    }

    /// Returns names with lengths around the field limits, and contents around the block size.
    fn test_files() -> Vec<(String, Vec<u8>)> {
        let deep =
            |folder: usize, name: usize| format!("{}/{}", "f".repeat(folder), "n".repeat(name));
        let names = [
            "a.png".to_owned(),
            "n".repeat(100),
            "n".repeat(101),
            deep(155, 100),
            deep(156, 100),
            deep(20, 300),
            format!("{}/ä.json", "ä".repeat(60)),
            "ö".repeat(90),
        ];
        let lengths = [0, 1, 511, 512, 513, 1024, 4000, 2].into_iter();
        names.into_iter().zip(lengths.map(|length| vec![7; length])).collect()
    }

    fn archive_of(files: &[(String, Vec<u8>)]) -> Vec<u8> {
        let mut archive = Vec::new();
        for (name, content) in files {
            append_file(&mut archive, name, content).unwrap();
        }
        finish_archive(&mut archive).unwrap();
        archive
    }

    #[test]
    fn archives_are_read_as_they_were_written() {
        let files = test_files();
        let archive = archive_of(&files);
        assert_eq!(archive.len() % BLOCK_BYTES, 0);
        assert_eq!(files_in(&archive).unwrap(), files);
        assert_eq!(files_in(&archive_of(&[])).unwrap(), []);
    }

    #[test]
    fn fields_are_at_the_offsets_of_the_standard() {
        let archive = archive_of(&[("folder/a.png".to_owned(), b"12345678".to_vec())]);
        assert_eq!(archive.len(), 4 * 512);
        let text = |range: Range<usize>| std::str::from_utf8(&archive[range]).unwrap();
        assert_eq!(text(0..13), "folder/a.png\0");
        assert_eq!((text(124..136), text(136..148)), ("00000000010\0", "00000000000\0"));
        assert_eq!((text(156..157), text(257..265)), ("0", "ustar\x0000"));
        // Computed by hand: the header text, and 8 spaces for the sum itself.
        let words =
            "folder/a.png0000644000000000000000000000001000000000000".to_owned() + "0ustar00";
        let sum = words.bytes().map(u32::from).sum::<u32>() + 8 * 32;
        assert_eq!(text(148..156), format!("{sum:06o}\0 "));
        assert_eq!(text(512..520), "12345678");
        assert!(archive[520..].iter().all(|byte| *byte == 0));
    }

    #[test]
    fn pax_records_count_their_own_length() {
        // 98 bytes and 2 digits make 100 bytes, which needs a third digit.
        for length in 85..100 {
            let record = pax_record("path", &"n".repeat(length));
            let digits = record.split(' ').next().unwrap();
            assert_eq!(digits.parse(), Ok(record.len()), "{record}");
        }
    }

    #[test]
    fn damage_is_detected() {
        let archive = archive_of(&test_files());
        for cut in [0, 100, 512, 513, archive.len() / 2, archive.len() - 1024] {
            assert!(files_in(&archive[..cut]).is_err(), "{cut}");
        }
        let mut changed = archive;
        changed[3] ^= 1;
        assert!(files_in(&changed).is_err());
    }
}
