//! What a run of the program means for a file.

use crate::manifest::Row;
use crate::program::Run;
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

/// The outcome of one file.
pub enum Verdict {
    /// A picture was made, and something is to be seen in it.
    Drawn,
    /// A picture was made, and all of its pixels are the same.
    Blank,
    /// The file was refused with this reason.
    Refused(String),
    /// The program did what it must never do.
    Broken(String),
}

/// Judges a run that was to draw `row` into `picture`.
pub fn judge_run(row: &Row, run: &Run, picture: &Path, size: (u32, u32)) -> Verdict {
    let said = run.stderr.trim();
    if run.hung {
        return Verdict::Broken("it takes longer than 30 s".to_owned());
    }
    if said.contains("panicked at") {
        return Verdict::Broken(format!("panic: {said}"));
    }
    match run.code {
        Some(0) => match picture_has_content(picture, size) {
            Ok(true) => Verdict::Drawn,
            Ok(false) => Verdict::Blank,
            Err(problem) => Verdict::Broken(problem),
        },
        Some(1) if picture.exists() => {
            Verdict::Broken("it failed and left a picture behind".to_owned())
        }
        Some(1) => match refusal_reason(said, row.file_name()) {
            Some(reason) => Verdict::Refused(reason),
            None => Verdict::Broken(format!("the message does not name the file: {said:?}")),
        },
        Some(code) => Verdict::Broken(format!("exit code {code}: {said}")),
        None => Verdict::Broken(format!("ended by a signal: {said}")),
    }
}

/// What the message says besides the file's name; `None` if it lacks the name or says nothing else.
fn refusal_reason(message: &str, file: &str) -> Option<String> {
    let errors = message.lines().skip_while(|line| !line.starts_with("error"));
    let error = errors.collect::<Vec<_>>().join("\n");
    let (before, after) = error.split_once(file)?;
    let after = after.trim_start_matches([':', ' ']);
    let before = before.lines().next().unwrap_or("");
    let before = before.rsplit_once(": /").map_or(before, |(before, _)| before);
    let text = if before.starts_with("error: ") && before.len() > 12 { before } else { after };
    let text = text.trim_start_matches("error: ").lines().next().unwrap_or("").trim();
    (text.len() > 5).then(|| text.to_owned())
}

/// Whether anything is to be seen in the picture, which must be a PNG of the given size.
fn picture_has_content(picture: &Path, size: (u32, u32)) -> Result<bool, String> {
    let file = File::open(picture).map_err(|error| format!("there is no picture: {error}"))?;
    let broken = |error: png::DecodingError| format!("the picture is no PNG: {error}");
    let mut reader = png::Decoder::new(BufReader::new(file)).read_info().map_err(broken)?;
    let mut pixels = vec![0; reader.output_buffer_size().ok_or("the picture is too large")?];
    let frame = reader.next_frame(&mut pixels).map_err(broken)?;
    if (frame.width, frame.height) != size {
        return Err(format!("the picture has {} x {} pixels", frame.width, frame.height));
    }
    let bytes = pixels.len() / (size.0 * size.1) as usize;
    let mut all = pixels.chunks_exact(bytes.max(1));
    let first = all.next();
    Ok(all.any(|pixel| Some(pixel) != first))
}
