//! Verdicts, which classify a run of the program by exit code, message and picture.

use crate::corpus::program::Run;
use alberti_tests::manifest::Row;
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

/// The outcome of one file.
pub enum Verdict {
    /// Exit code 0 and a picture of more than one color.
    Drawn,
    /// Exit code 0 and a picture of one color.
    Blank,
    /// Exit code 1 and a message that names the file, with the reason in the message.
    Refused(String),
    /// Anything else: a panic, a hang, a wrong picture, a message without the file's name.
    Broken(String),
}

/// Classifies a run that renders `row` to `picture`.
pub fn judge_run(row: &Row, run: &Run, picture: &Path, size: (u32, u32)) -> Verdict {
    let message = run.stderr.trim();
    if run.hung {
        return Verdict::Broken("it took longer than 30 s".to_owned());
    }
    if message.contains("panicked at") {
        return Verdict::Broken(format!("panic: {message}"));
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
        Some(1) => match refusal_reason(message, row.file_name()) {
            Some(reason) => Verdict::Refused(reason),
            None => Verdict::Broken(format!("the message does not name the file: {message:?}")),
        },
        Some(code) => Verdict::Broken(format!("exit code {code}: {message}")),
        None => Verdict::Broken(format!("killed by a signal: {message}")),
    }
}

/// Returns the reason in an error message, or `None` if the message lacks the file name or has no
/// other text.
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

/// Returns whether the picture has more than one color. It must be a PNG of this size.
fn picture_has_content(picture: &Path, size: (u32, u32)) -> Result<bool, String> {
    let file = File::open(picture).map_err(|error| format!("no picture: {error}"))?;
    let broken = |error: png::DecodingError| format!("the picture is not a PNG: {error}");
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
