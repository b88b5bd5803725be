//! Draws the lines of a model or scene: `cargo run --example lines MODEL.glb [SCENE.ron …] > drawing.svg`, and tells
//! on the standard error how many there are and how long it took.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a program speaks")]

use pipeline::drawing::{EdgeClass, LineDrawing, Options, draw, verify};
use pipeline::scene::ResolveOptions;
use pipeline::{Origin, Scene};
use std::path::Path;
use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let input = arguments.next().ok_or("name a model or a scene")?;
    let input = Path::new(&input);
    let is_scene = input.extension().is_some_and(|ending| ending == "ron");
    let (origin, mut file) =
        if is_scene { Origin::read(input)? } else { Origin::bare_model(input) };
    let mut options = Options::hidden_removed();
    let mut check = false;
    for argument in arguments {
        match argument.as_str() {
            "kept" => options = Options::hidden_kept(),
            "verify" => check = true,
            "wireframe" => options = Options::wireframe(),
            "silhouettes" => options = Options::silhouettes(),
            width => file.image.size = (width.parse()?, (3 * width.parse::<u32>()?).div_ceil(4)),
        }
    }
    let scene = Scene::resolve(&origin, &file, &ResolveOptions::default())?;
    let start = Instant::now();
    let drawing = draw(&scene, &options, 2)?;
    let took = start.elapsed();
    eprintln!("{} lines of {} objects in {took:?}", drawing.lines.len(), drawing.objects.len());
    if check {
        let agreement = verify(&scene, &drawing)?;
        eprintln!(
            "{:.4} % of {:.0} px disagree",
            agreement.disagreement() * 100.0,
            agreement.visible
        );
        for (place, length) in agreement.places.iter().take(20) {
            eprintln!("  {length:.2} px of {:?}", drawing.lines[*place]);
        }
    }
    print!("{}", svg(&drawing));
    Ok(())
}

/// The plainest SVG: an element for each piece.
fn svg(drawing: &LineDrawing) -> String {
    let size = drawing.size;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" fill=\"none\" stroke-linecap=\"round\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
        size.x, size.y
    );
    for line in &drawing.lines {
        let color = match line.class {
            EdgeClass::Silhouette => "black",
            EdgeClass::Boundary => "blue",
            EdgeClass::Tangent => "orange",
            EdgeClass::Crease => "#444",
            EdgeClass::Intersection => "red",
            _ => "green",
        };
        let (width, dash) =
            if line.visible { (1.0, "") } else { (0.5, " stroke-dasharray=\"3 2\"") };
        let [a, b] = line.ends;
        svg += &format!(
            "<path d=\"M{:.3} {:.3}L{:.3} {:.3}\" stroke=\"{color}\" stroke-width=\"{width}\"{dash}/>\n",
            a.x, a.y, b.x, b.y
        );
    }
    svg + "</svg>\n"
}
