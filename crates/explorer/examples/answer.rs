//! Answers a request with the models in a folder and writes the answer to standard output.
//!
//! ```sh
//! cargo run -p alberti-explorer --example answer -- scenes 'what=world&lesson=frustum&format=png' > world.png
//! ```
//! Several requests are answered in turn. The time for each is written to standard error.

use explorer::Explorer;
use std::error::Error;
use std::io::Write;
use std::path::Path;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let folder = arguments
        .next()
        .ok_or("usage: answer FOLDER REQUEST..., where FOLDER contains `models`")?;
    let mut explorer = Explorer::new();
    for entry in std::fs::read_dir(Path::new(&folder).join("models"))? {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        explorer.add_file(&format!("models/{name}"), std::fs::read(&path)?)?;
    }
    for query in arguments {
        let start = Instant::now();
        let answer = explorer.answer(&query)?;
        let milliseconds = start.elapsed().as_secs_f64() * 1000.0;
        writeln!(std::io::stderr(), "{milliseconds:.2} ms, {}", answer.content_type)?;
        std::io::stdout().write_all(&answer.bytes)?;
    }
    Ok(())
}
