//! Sorts lines by output with little memory: sorts chunks, writes them to a temporary file, and
//! merges them while reading.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::fs::{File, OpenOptions};
use std::io::{BufWriter, Error, ErrorKind, Read as _, Seek as _, SeekFrom, Write as _};
use std::path::{Path, PathBuf};

/// The size of the buffer from which a chunk is read.
const READ_BYTES: usize = 1 << 16;

/// A report line with its sort key.
#[derive(PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) struct SortedLine {
    /// The output of the record.
    pub(super) output: Vec<u8>,
    /// The chunk number, which keeps lines with the same output in run order.
    chunk: usize,
    /// The line without its line break.
    pub(super) line: Vec<u8>,
}

/// Lines that are being collected.
pub(super) struct Chunks {
    /// The folder of the temporary file.
    folder: PathBuf,
    /// The size at which a chunk is written to the temporary file.
    chunk_bytes: usize,
    /// The output and the line of each record of this chunk, one after the other.
    text: Vec<u8>,
    /// The positions of this chunk's records in `text`.
    spans: Vec<Span>,
    /// The temporary file, if any.
    file: Option<File>,
    /// The ranges of the chunks in the temporary file.
    ranges: Vec<[u64; 2]>,
}

/// The position of a record in the text of a chunk.
#[derive(Clone, Copy)]
pub(super) struct Span {
    start: usize,
    /// The length of the output, which precedes the line.
    output: u32,
    /// The length of the line.
    line: u32,
}

impl Span {
    fn output(self, text: &[u8]) -> &[u8] {
        &text[self.start..][..self.output as usize]
    }

    fn line(self, text: &[u8]) -> &[u8] {
        &text[self.start + self.output as usize..][..self.line as usize]
    }
}

impl Chunks {
    /// Creates an empty collection. The temporary file, if needed, is created in `folder`.
    pub(super) fn new(folder: &Path, chunk_bytes: usize) -> Self {
        let (text, spans) = (Vec::new(), Vec::new());
        Self { folder: folder.to_owned(), chunk_bytes, text, spans, file: None, ranges: Vec::new() }
    }

    /// Adds a line.
    pub(super) fn add_line(&mut self, output: &str, line: &[u8]) -> std::io::Result<()> {
        let length = |bytes: &[u8]| u32::try_from(bytes.len()).map_err(Error::other);
        let (start, output) = (self.text.len(), output.as_bytes());
        self.spans.push(Span { start, output: length(output)?, line: length(line)? });
        self.text.extend_from_slice(output);
        self.text.extend_from_slice(line);
        if self.text.len() + self.spans.len() * size_of::<Span>() >= self.chunk_bytes {
            self.write_chunk()?;
        }
        Ok(())
    }

    /// Returns the sorted lines.
    pub(super) fn into_sorted(mut self) -> std::io::Result<SortedLines> {
        if self.file.is_some() && !self.spans.is_empty() {
            self.write_chunk()?;
        }
        self.sort_chunk();
        let Some(file) = self.file else {
            let (text, spans) = (self.text, self.spans.into_iter());
            return Ok(SortedLines::Memory { text, spans });
        };
        let chunks = self.ranges.into_iter().map(ChunkReader::new);
        let mut files = FileLines { file, chunks: chunks.collect(), next: BinaryHeap::new() };
        (0..files.chunks.len()).try_for_each(|chunk| files.read_from(chunk))?;
        Ok(SortedLines::File(files))
    }

    /// Sorts the lines of this chunk; lines with the same output keep their order.
    fn sort_chunk(&mut self) {
        let text = &self.text;
        self.spans.sort_by(|a, b| a.output(text).cmp(b.output(text)));
    }

    /// Appends this chunk to the temporary file: for each record, both lengths, then the output and
    /// the line.
    fn write_chunk(&mut self) -> std::io::Result<()> {
        self.sort_chunk();
        let mut file = match self.file.take() {
            Some(file) => file,
            None => temporary_file(&self.folder)?,
        };
        let begin = file.stream_position()?;
        let mut writer = BufWriter::with_capacity(READ_BYTES, &mut file);
        for span in &self.spans {
            writer.write_all(&span.output.to_le_bytes())?;
            writer.write_all(&span.line.to_le_bytes())?;
            writer.write_all(span.output(&self.text))?;
            writer.write_all(span.line(&self.text))?;
        }
        writer.flush()?;
        drop(writer);
        self.ranges.push([begin, file.stream_position()?]);
        self.file = Some(file);
        self.text.clear();
        self.spans.clear();
        Ok(())
    }
}

/// Creates a file that disappears when it is closed.
fn temporary_file(folder: &Path) -> std::io::Result<File> {
    let mut number = 0_u32;
    loop {
        let path = folder.join(format!(".merge.{}.{number}.part", std::process::id()));
        match OpenOptions::new().read(true).write(true).create_new(true).open(&path) {
            Ok(file) => {
                // An open file outlives its name. If the system refuses to remove the name, the
                // file remains.
                let _ = std::fs::remove_file(&path);
                return Ok(file);
            }
            Err(cause) if cause.kind() == ErrorKind::AlreadyExists && number < 1000 => number += 1,
            Err(cause) => return Err(cause),
        }
    }
}

/// Lines sorted by output; lines with the same output are in run order.
pub(super) enum SortedLines {
    /// One chunk in memory.
    Memory {
        /// The text of the chunk.
        text: Vec<u8>,
        /// The positions of the remaining lines.
        spans: std::vec::IntoIter<Span>,
    },
    /// Chunks in a temporary file.
    File(FileLines),
}

impl SortedLines {
    /// Returns the next line, or `None` after the last.
    pub(super) fn next_line(&mut self) -> std::io::Result<Option<SortedLine>> {
        match self {
            Self::Memory { text, spans } => Ok(spans.next().map(|span| SortedLine {
                output: span.output(text).to_vec(),
                chunk: 0,
                line: span.line(text).to_vec(),
            })),
            Self::File(files) => files.next_line(),
        }
    }
}

/// The sorted chunks of a temporary file.
pub(super) struct FileLines {
    file: File,
    chunks: Vec<ChunkReader>,
    /// The first line of each unfinished chunk; the smallest is on top.
    next: BinaryHeap<Reverse<SortedLine>>,
}

impl FileLines {
    fn next_line(&mut self) -> std::io::Result<Option<SortedLine>> {
        let Some(Reverse(line)) = self.next.pop() else { return Ok(None) };
        self.read_from(line.chunk)?;
        Ok(Some(line))
    }

    /// Queues the next line of a chunk, if there is one.
    fn read_from(&mut self, chunk: usize) -> std::io::Result<()> {
        let reader = &mut self.chunks[chunk];
        let Some(lengths) = reader.read_bytes(&mut self.file, 8)? else { return Ok(()) };
        let mut word = [0; 4];
        word.copy_from_slice(&lengths[..4]);
        let output = u32::from_le_bytes(word) as usize;
        word.copy_from_slice(&lengths[4..]);
        let line = u32::from_le_bytes(word) as usize;
        let truncated = || Error::from(ErrorKind::UnexpectedEof);
        let mut output = reader.read_bytes(&mut self.file, output + line)?.ok_or_else(truncated)?;
        let line = output.split_off(output.len() - line);
        self.next.push(Reverse(SortedLine { output, chunk, line }));
        Ok(())
    }
}

/// A reader for a chunk of the temporary file, from front to back.
struct ChunkReader {
    /// The part of the file that has not been read yet.
    range: [u64; 2],
    /// The bytes that were read from the file.
    buffer: Vec<u8>,
    /// The number of used bytes in `buffer`.
    used: usize,
}

impl ChunkReader {
    const fn new(range: [u64; 2]) -> Self {
        Self { range, buffer: Vec::new(), used: 0 }
    }

    /// Returns the next bytes of the chunk, or `None` at its end.
    fn read_bytes(&mut self, file: &mut File, count: usize) -> std::io::Result<Option<Vec<u8>>> {
        if self.buffer.len() - self.used < count {
            self.buffer.drain(..self.used);
            self.used = 0;
            let [begin, end] = self.range;
            let wanted = (end - begin).min((count.max(READ_BYTES) - self.buffer.len()) as u64);
            file.seek(SeekFrom::Start(begin))?;
            let read = file.take(wanted).read_to_end(&mut self.buffer)?;
            self.range[0] += read as u64;
        }
        let Some(bytes) = self.buffer.get(self.used..self.used + count) else { return Ok(None) };
        self.used += count;
        Ok(Some(bytes.to_vec()))
    }
}
