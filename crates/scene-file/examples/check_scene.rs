//! Checks a scene file and the files it includes, without loading any models.
//!
//! Run it with `cargo run -p alberti-scene-file --example check_scene -- scene.ron`.
#![allow(clippy::print_stdout, reason = "examples print their results")]

use scene_file::SceneSource;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args_os().nth(1).ok_or("pass the path of a scene file")?;
    let (source, file) = SceneSource::read(path.as_ref())?.parse_with_includes(&[])?;
    let (models, included) = (file.models.len(), source.included_texts().count());
    println!("{}: {models} models, {included} included files", source.file);
    Ok(())
}
