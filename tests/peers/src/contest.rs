//! Runs the contests: all contestants draw every scene that they support. Then the limits and the
//! threads are measured.

use crate::clock::{Took, timed};
use crate::gl::Context;
use crate::limits::{Clearing, Kernel};
use crate::measure::{Contestant, Series, Spread, rounds};
use crate::peer::{Euc, Llvmpipe, Peer, Raster, Render};
use crate::report;
use crate::scene::{Order, Scene, assets, floor, helmet, layers, sphere};
use raster::Samples;
use std::rc::Rc;

/// The measurements to make.
pub struct Options {
    /// The number of rounds.
    pub rounds: usize,
    /// The measurements to make, by parts of their names; if empty, all are made.
    pub only: Vec<String>,
}

impl Options {
    /// Returns whether to measure something with this name.
    pub fn wants(&self, name: &str) -> bool {
        self.only.is_empty() || self.only.iter().any(|part| name.contains(part.as_str()))
    }
}

/// The measurements for a scene.
pub struct Heat {
    /// The scene's name.
    pub scene: &'static str,
    /// A description of the scene.
    pub about: String,
    /// The times of all contestants, ours first.
    pub series: Vec<Series>,
    /// The distances of our picture from the peers' pictures.
    pub agreements: Vec<Agreement>,
}

/// The distance between two pictures.
pub struct Agreement {
    /// The peer whose picture was compared with ours.
    pub peer: String,
    /// The number of pixels that only one of the two drew.
    pub coverage: usize,
    /// The number of pixels that both drew but whose colors differ by more than 3 of 255.
    pub color: usize,
    /// The number of pixels we drew.
    pub drawn: usize,
}

/// A scene's name and the function that creates it.
type Recipe = (&'static str, fn(&'static str) -> Result<Scene, String>);

/// The name and constructor of each scene. The helmet needs the shared models.
const SCENES: [Recipe; 9] = [
    ("sphere-1m", |name| sphere(name, 500, false)),
    ("sphere-4m", |name| sphere(name, 1000, false)),
    ("helmet", |name| {
        helmet(name, &assets().ok_or("the folder of shared models was not found (set ASSETS)")?)
    }),
    ("layers-back-to-front-flat", |name| layers(name, 50, Order::BackToFront, false)),
    ("layers-front-to-back-flat", |name| layers(name, 50, Order::FrontToBack, false)),
    ("layers-back-to-front-textured", |name| layers(name, 50, Order::BackToFront, true)),
    ("layers-front-to-back-textured", |name| layers(name, 50, Order::FrontToBack, true)),
    ("floor", floor),
    // Like `sphere-1m`, but for a rasterizer that does not cull back faces.
    ("sphere-1m-both-sides", |name| sphere(name, 500, true)),
];

/// The scenes with edges, which are also drawn with four samples.
const WITH_SAMPLES: [&str; 4] = ["sphere-1m", "helmet", "layers-back-to-front-flat", "floor"];

/// Draws the scenes one after another and prints a table for each, with a note if something cannot
/// be drawn.
pub fn scenes(gl: Option<&Rc<Context>>, options: &Options) -> Result<Vec<Heat>, String> {
    let mut heats = Vec::new();
    for (name, make) in SCENES {
        if !options.wants(name) {
            continue;
        }
        match make(name) {
            Ok(scene) => {
                let heat = heat(&scene, gl, options.rounds)?;
                println!("{}", report::scene(&heat));
                heats.push(heat);
            }
            Err(reason) => println!("{name}: skipped: {reason}"),
        }
    }
    Ok(heats)
}

fn heat(scene: &Scene, gl: Option<&Rc<Context>>, count: usize) -> Result<Heat, String> {
    eprintln!("{}: {}", scene.name, scene.about);
    let mut peers = peers(scene, gl)?;
    let mut contestants: Vec<Contestant<'_>> = peers
        .iter_mut()
        .map(|peer| Contestant { name: peer.name(), work: Box::new(|| peer.draw()) })
        .collect();
    let series = rounds(&mut contestants, count);
    drop(contestants);
    let ours = peers[0].pixels();
    let others = peers[1..].iter_mut().filter(|peer| peer.is_comparable());
    let agreements = others.map(|peer| agreement(peer.name(), &ours, &peer.pixels())).collect();
    Ok(Heat { scene: scene.name, about: scene.about.clone(), series, agreements })
}

/// Returns all contestants that can draw the scene.
fn peers<'a>(
    scene: &'a Scene,
    gl: Option<&Rc<Context>>,
) -> Result<Vec<Box<dyn Peer + 'a>>, String> {
    let mut peers: Vec<Box<dyn Peer + 'a>> = vec![
        Box::new(Raster::new(scene, Samples::One, 1)?),
        Box::new(Render::new(scene, Samples::One, 1)?),
    ];
    if let Some(gl) = gl {
        peers.push(Box::new(Llvmpipe::new(gl, scene, 1)?));
    }
    // euc does not clip: it would also draw things behind the eye.
    if !scene.behind_the_eye {
        peers.push(Box::new(Euc::new(scene)));
    }
    peers.push(Box::new(Raster::new(scene, Samples::One, 1)?.baseline()));
    if WITH_SAMPLES.contains(&scene.name) {
        peers.push(Box::new(Raster::new(scene, Samples::Four, 1)?));
        peers.push(Box::new(Render::new(scene, Samples::Four, 1)?));
        if let Some(gl) = gl {
            peers.push(Box::new(Llvmpipe::new(gl, scene, 4)?));
        }
    }
    Ok(peers)
}

/// Draws one scene repeatedly, with only the crate or with the whole pipeline.
pub fn repeat(name: &str, frames: usize, whole: bool, samples: u32) -> Result<(), String> {
    let known = SCENES.iter().find(|(known, _)| *known == name);
    let (name, make) = known.ok_or_else(|| format!("unknown scene `{name}`"))?;
    let scene = make(name)?;
    let samples = Samples::from_count(samples).ok_or("use 1, 4, 8 or 16 samples")?;
    let mut peer: Box<dyn Peer + '_> = if whole {
        Box::new(Render::new(&scene, samples, 1)?)
    } else {
        Box::new(Raster::new(&scene, samples, 1)?)
    };
    (0..frames).for_each(|_| peer.draw());
    Ok(())
}

fn agreement(peer: String, ours: &[[u8; 4]], theirs: &[[u8; 4]]) -> Agreement {
    let mut found = Agreement { peer, coverage: 0, color: 0, drawn: 0 };
    for (a, b) in ours.iter().zip(theirs) {
        let differs = (0..3).any(|k| a[k].abs_diff(b[k]) > 3);
        match (a[3] > 0, b[3] > 0) {
            (true, true) => found.color += usize::from(differs),
            (false, false) => {}
            _ => found.coverage += 1,
        }
        found.drawn += usize::from(a[3] > 0);
    }
    found
}

/// Returns the limits, measured in the same rounds as the scenes that are compared with them. The
/// first kernel is called `kernel`; the others have their instructions' names.
pub fn bounds(count: usize) -> Result<Vec<Series>, String> {
    eprintln!("limits: clearing, the innermost loop, layers");
    let back = layers("back to front, flat", 50, Order::BackToFront, false)?;
    let front = layers("front to back, flat", 50, Order::FrontToBack, false)?;
    let textured = layers("back to front, textured", 50, Order::BackToFront, true)?;
    let mut contestants: Vec<Contestant<'_>> = Vec::new();
    let mut enter = |name: &str, work| {
        contestants.push(Contestant { name: name.into(), work });
    };
    let (mut memory, mut cache) = (Clearing::new(false), Clearing::new(true));
    enter("clear", Box::new(move || memory.run()));
    enter("clear, in the cache", Box::new(move || cache.run()));
    for (number, mut kernel) in Kernel::all().into_iter().enumerate() {
        if number == 0 {
            let mut plain = kernel.clone();
            enter("kernel, plain loop", Box::new(move || plain.plain()));
        }
        let level = if number == 0 { String::new() } else { format!(", {}", kernel.level()) };
        enter(&format!("kernel{level}"), Box::new(move || kernel.vectors()));
    }
    for scene in [&back, &front, &textured] {
        let mut ours = Raster::new(scene, Samples::One, 1)?;
        enter(scene.name, Box::new(move || ours.draw()));
    }
    Ok(rounds(&mut contestants, count))
}

/// The gain from a second thread in a scene.
pub struct Threads {
    /// The renderer: `raster` (only the crate) or `render` (the whole pipeline).
    pub peer: &'static str,
    /// The scene's name.
    pub scene: &'static str,
    /// The wall time with two threads relative to one thread, in the rounds in which each had its
    /// processors to itself.
    pub wall: Option<Spread>,
    /// The ratio of CPU time to wall time with two threads, in all rounds.
    pub parallel: Option<Spread>,
    /// The number of rounds that counted.
    pub counted: usize,
    /// Whether the pictures were equal.
    pub same: bool,
}

/// The minimum ratio of CPU time to wall time of a single thread. Below it, the thread was
/// disturbed, and the round does not count.
const ALONE: f64 = 0.97;

/// Measures one and two threads in turn.
pub fn threads(options: &Options) -> Result<Vec<Threads>, String> {
    let mut found = Vec::new();
    for (name, make) in [SCENES[0], SCENES[2], SCENES[3]] {
        let Ok(scene) = make(name) else { continue };
        eprintln!("threads: {name}");
        let raster = |threads| Raster::new(&scene, Samples::One, threads);
        let render = |threads| Render::new(&scene, Samples::One, threads);
        let rounds = options.rounds;
        found.push(two_threads("raster", &scene, [&mut raster(1)?, &mut raster(2)?], rounds));
        found.push(two_threads("render", &scene, [&mut render(1)?, &mut render(2)?], rounds));
    }
    Ok(found)
}

fn two_threads(
    peer: &'static str,
    scene: &Scene,
    [one, two]: [&mut dyn Peer; 2],
    count: usize,
) -> Threads {
    one.draw();
    two.draw();
    let same = one.pixels() == two.pixels();
    let pairs: Vec<(Took, Took)> =
        (0..count).map(|_| (timed(|| one.draw()), timed(|| two.draw()))).collect();
    let parallel = |took: &Took| took.cpu.as_secs_f64() / took.wall.as_secs_f64();
    let quiet = pairs.iter().filter(|(one, _)| parallel(one) > ALONE);
    let ratios: Vec<f64> =
        quiet.map(|(one, two)| two.wall.as_secs_f64() / one.wall.as_secs_f64()).collect();
    Threads {
        peer,
        scene: scene.name,
        wall: Spread::of(ratios.iter().copied()),
        parallel: Spread::of(pairs.iter().map(|(_, two)| parallel(two))),
        counted: ratios.len(),
        same,
    }
}
