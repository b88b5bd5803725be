//! Lists of jobs, one per line, read on demand: JSON lines, or CSV with a header.
//!
//! ```text
//! {"input": "fox.glb", "output": "a.png", "size": "64x64", "lenient": true}
//! {"input": "fox.glb", "pictures": [{"view": "front", "output": "f.png"}, {"view": "top"}]}
//! ```
//!
//! Members other than `input`, `output`, `scene`, `bytes` and `pictures` are picture flags. An
//! invalid line becomes a job that fails; the others run.

use super::csv::CsvRecord;
use super::job::{BatchJob, JobGroup, ListLine};
use super::list_line::{LineReader, ListContext};
use super::output_names::{OutputNames, same_output_fault};
use super::picture_name::PictureName;
use crate::BatchError;
use crate::flag_table::FlagTable;
use files::{counted, visible_path, visible_text};
use serde_json::{Map, Value};
use std::fs::File;
use std::io::{BufRead, BufReader, Read as _};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The maximum length of a line in bytes.
const MAX_LINE_BYTES: u64 = 16 << 20;

/// A list that is being read.
pub(super) struct JobList {
    /// The unread rest of the list.
    reader: Box<dyn BufRead + Send>,
    /// The list's name in messages.
    name: Arc<str>,
    /// The context of the lines: folder, scene, name template and flags.
    context: ListContext,
    /// The columns of a CSV file; `None` for JSON lines.
    columns: Option<Vec<String>>,
    /// The number of the last line read.
    line: u64,
    /// The number of bytes read, and the total number if known.
    position: (u64, Option<u64>),
    /// The outputs so far, for a list that cannot be read twice.
    outputs: Option<OutputNames>,
}

impl JobList {
    /// Opens a list; `-` is the standard input. `flags` are the flags that lines may set.
    ///
    /// A file whose name ends in `.csv` is read as CSV, any other file as JSON lines. The standard
    /// input is read as JSON lines if it begins with a brace, otherwise as CSV.
    ///
    /// A file is read once beforehand to find lines with the same output. A pipe cannot be read
    /// twice, so there the second of two such lines becomes a job that fails.
    ///
    /// # Errors
    /// Returns an error if the list cannot be read, lacks the column `input`, or repeats an output.
    pub(super) fn open(
        path: &Path,
        scene: Option<PathBuf>,
        picture_name: Option<PictureName>,
        flags: &FlagTable,
    ) -> Result<Self, BatchError> {
        let list = Self::open_once(path, scene.clone(), picture_name.clone(), flags)?;
        if list.position.1.is_none() {
            return Ok(Self { outputs: Some(OutputNames::default()), ..list });
        }
        Self::open_once(path, scene, picture_name, flags)?.check_outputs()?;
        Ok(list)
    }

    /// Reads the list to its end and checks its outputs.
    ///
    /// # Errors
    /// Returns an error if the list cannot be read, or if two lines have the same output.
    fn check_outputs(mut self) -> Result<(), BatchError> {
        let mut outputs = OutputNames::default();
        while let Some((number, members)) = self.next_members()? {
            let group = self.group_of(number, members);
            if let Some(fault) = repeated_output(&mut outputs, &group, number) {
                return Err(BatchError::Unusable(format!("{}: {fault}", visible_text(&self.name))));
            }
        }
        Ok(())
    }

    /// Opens a list.
    fn open_once(
        path: &Path,
        scene: Option<PathBuf>,
        picture_name: Option<PictureName>,
        flags: &FlagTable,
    ) -> Result<Self, BatchError> {
        let is_stdin = path.as_os_str() == "-";
        let (reader, length): (Box<dyn BufRead + Send>, _) = if is_stdin {
            (Box::new(BufReader::new(std::io::stdin())), None)
        } else {
            let fault = |cause| {
                BatchError::Unusable(format!("cannot read {}: {cause}", visible_path(path)))
            };
            let file = File::open(path).map_err(fault)?;
            let length = file.metadata().map_err(fault)?;
            // A pipe has no length, so its progress has no percentage.
            (Box::new(BufReader::new(file)), length.is_file().then_some(length.len()))
        };
        let folder = if is_stdin { Path::new("") } else { path.parent().unwrap_or(path) };
        let name = if is_stdin { "<stdin>".into() } else { path.to_string_lossy() };
        let context =
            ListContext { folder: folder.to_owned(), scene, picture_name, flags: flags.clone() };
        let mut list = Self {
            reader,
            name: visible_text(&name).into(),
            context,
            columns: None,
            line: 0,
            position: (0, length),
            outputs: None,
        };
        // The standard input has no extension, but JSON lines begin with a brace.
        let has_brace = |list: &mut Self| -> Result<bool, BatchError> {
            let start = list.reader.fill_buf().map_err(|cause| list_error(&list.name, &cause))?;
            Ok(start.trim_ascii_start().first().is_none_or(|byte| *byte == b'{'))
        };
        let ends_in_csv = path.extension().is_some_and(|end| end.eq_ignore_ascii_case("csv"));
        if ends_in_csv || (is_stdin && !has_brace(&mut list)?) {
            list.read_columns()?;
        }
        Ok(list)
    }

    /// Returns the fraction of the list read so far, from 0 to 1, if its length is known.
    pub(super) fn fraction(&self) -> Option<f64> {
        let (read, all) = self.position;
        all.map(|all| if all == 0 { 1.0 } else { read as f64 / all as f64 })
    }

    /// Reads the header of a CSV file.
    fn read_columns(&mut self) -> Result<(), BatchError> {
        let header = match self.next_line()? {
            Some(line) => self.read_record(line)?,
            None => Ok(Vec::new()),
        };
        let fault = |what: &str| {
            BatchError::Unusable(format!(
                "{}:1: {what}\n  = help: name the columns in the first line: input and, if needed, \
                 output, scene and flags such as size",
                self.name
            ))
        };
        let columns = header.map_err(|what| fault(&what))?;
        let columns: Vec<String> = columns
            .iter()
            // Spreadsheet programs write a byte order mark.
            .map(|column| column.trim_start_matches('\u{feff}').trim().to_owned())
            .collect();
        if !columns.iter().any(|column| column == "input") {
            return Err(fault("missing column `input`"));
        }
        for (at, column) in columns.iter().enumerate() {
            if let Err(what) = self.context.check_member(column) {
                return Err(fault(&what));
            }
            if columns[..at].contains(column) {
                return Err(fault(&format!("duplicate column `{column}`")));
            }
        }
        self.columns = Some(columns);
        Ok(())
    }

    /// Returns the next line with its line break, or `None` at the end.
    ///
    /// # Errors
    /// Returns an error if the list cannot be read, or if the line is too long.
    fn next_line(&mut self) -> Result<Option<Vec<u8>>, BatchError> {
        let mut line = Vec::new();
        let mut limited = self.reader.by_ref().take(MAX_LINE_BYTES + 1);
        let read = limited.read_until(b'\n', &mut line);
        let length = read.map_err(|cause| list_error(&self.name, &cause))?;
        self.line += 1;
        self.position.0 += length as u64;
        if length as u64 > MAX_LINE_BYTES {
            return Err(BatchError::Unusable(format!(
                "{}:{}: the line is too long; at most {MAX_LINE_BYTES} bytes are allowed",
                self.name, self.line
            )));
        }
        Ok((length > 0).then_some(line))
    }

    /// Returns the fields of the CSV record that begins with this line; an inner error means that
    /// the record is invalid.
    fn read_record(&mut self, first: Vec<u8>) -> Result<Result<Vec<String>, String>, BatchError> {
        let (mut record, mut line) = (CsvRecord::default(), first);
        loop {
            let Ok(text) = std::str::from_utf8(&line) else {
                return Ok(Err("the line is not UTF-8".to_owned()));
            };
            match record.add_line(text) {
                Err(what) => return Ok(Err(what)),
                Ok(true) => return Ok(Ok(record.into_fields())),
                Ok(false) => {}
            }
            line = match self.next_line()? {
                Some(line) => line,
                None => return Ok(Err("a quoted field is not closed".to_owned())),
            };
        }
    }

    /// Returns the number and the members of the next line that is not empty, or `None` at the end.
    fn next_members(&mut self) -> Result<Option<(u64, Members)>, BatchError> {
        loop {
            let Some(line) = self.next_line()? else { return Ok(None) };
            let number = self.line;
            if line.trim_ascii().is_empty() {
                continue;
            }
            if self.columns.is_none() {
                return Ok(Some((number, json_members(&line))));
            }
            let fields = self.read_record(line)?;
            let members = fields.and_then(|fields| self.csv_members(fields));
            return Ok(Some((number, members)));
        }
    }

    /// Returns the members of a CSV record; an empty field is treated as absent.
    fn csv_members(&self, fields: Vec<String>) -> Members {
        let columns = self.columns.as_deref().unwrap_or_default();
        if fields.len() != columns.len() {
            return Err(format!(
                "the line has {}, but the header has {}",
                counted(fields.len(), "field", "fields"),
                columns.len()
            ));
        }
        let given = columns.iter().zip(fields).filter(|(_, field)| !field.is_empty());
        let value = |(column, field): (&String, String)| {
            let is_bytes = column == "bytes";
            let number = field.parse::<u64>().ok().filter(|_| is_bytes);
            let value = match (number, field.as_str()) {
                (Some(number), _) => Value::from(number),
                (None, "true") => Value::Bool(true),
                (None, "false") => Value::Bool(false),
                (None, _) => Value::String(field),
            };
            (column.clone(), value)
        };
        Ok(given.map(value).collect())
    }

    /// Returns the jobs of a line.
    fn group_of(&self, number: u64, members: Members) -> JobGroup {
        let line = ListLine { list: Arc::clone(&self.name), number };
        let reader = LineReader { context: &self.context, line: &line };
        let group = members.and_then(|members| reader.read_group(&members));
        group.unwrap_or_else(|fault| wrong_line(line, &fault))
    }
}

impl Iterator for JobList {
    type Item = Result<JobGroup, BatchError>;

    fn next(&mut self) -> Option<Self::Item> {
        match self.next_members() {
            Ok(None) => None,
            Ok(Some((number, members))) => {
                let group = self.group_of(number, members);
                let outputs = self.outputs.as_mut();
                Some(Ok(match outputs.and_then(|all| repeated_output(all, &group, number)) {
                    Some(fault) => {
                        wrong_line(ListLine { list: Arc::clone(&self.name), number }, &fault)
                    }
                    None => group,
                }))
            }
            Err(error) => Some(Err(error)),
        }
    }
}

/// Returns an error if an earlier line has one of this line's outputs.
fn repeated_output(outputs: &mut OutputNames, group: &JobGroup, line: u64) -> Option<String> {
    let jobs = group.jobs.iter().filter(|job| job.fault.is_none());
    let claims = jobs.map(|job| (&job.output, outputs.claim(&job.output, line)));
    let repeated = claims.filter_map(|(output, claim)| Some((output, claim.err()?))).next();
    repeated.map(|(output, earlier)| same_output_fault([earlier, line], output))
}

/// The members of a line, or the error in it.
type Members = Result<Map<String, Value>, String>;

/// Parses the members of a JSON line.
fn json_members(line: &[u8]) -> Members {
    match serde_json::from_slice(line) {
        Ok(Value::Object(members)) => Ok(members),
        Ok(_) => Err("the line is not a JSON object such as {\"input\": \"fox.glb\"}".to_owned()),
        Err(error) => {
            let text = error.to_string();
            let what = text.split(" at line ").next().unwrap_or_default();
            Err(format!("the line is not JSON: {what} at column {}", error.column()))
        }
    }
}

/// Returns the job for an invalid line, which fails under the line's name.
fn wrong_line(line: ListLine, fault: &str) -> JobGroup {
    let job = BatchJob {
        input: PathBuf::new(),
        output: line.to_string(),
        scene: None,
        flags: Vec::new(),
        fault: Some(format!("{line}: {fault}")),
        line: Some(line),
    };
    JobGroup { jobs: vec![job], bytes: Some(0) }
}

/// Returns the error for a list that cannot be read.
fn list_error(name: &str, cause: &std::io::Error) -> BatchError {
    BatchError::Unusable(format!("cannot read {name}: {cause}"))
}
