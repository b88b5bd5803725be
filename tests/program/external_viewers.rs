//! Drawings as other programs show them: an SVG in Chromium and a PDF in Poppler must look like the
//! PNG that `alberti` draws for the same page.
//!
//! Each program antialiases edges a little differently, so pictures are compared with a tolerance
//! of a pixel: where one has ink, the other must have some there or in an adjacent pixel. The tests
//! are reported as skipped if the programs are not installed; `.ci/run` installs them if it can.

use crate::sandbox::Sandbox;
use alberti_tests::skip::report_skip;
use std::path::Path;
use std::process::Command;

/// Returns the path of a program with one of these names, or reports a skip and returns `None` if
/// it is not installed.
fn installed(names: &[&str]) -> Option<String> {
    let answers = |name: &&&str| Command::new(name).arg("--version").output().is_ok();
    if let Some(name) = names.iter().find(answers) {
        return Some((*name).to_owned());
    }
    report_skip("viewers", &format!("{} is not installed", names.join(" or ")));
    None
}

/// The ink in each pixel, from 0 to 1, with the width and height of the picture.
struct InkMap {
    size: [usize; 2],
    ink: Vec<f64>,
}

impl InkMap {
    /// Measures the ink of a picture on white paper.
    fn from_picture((width, height, pixels): (u32, u32, Vec<[u8; 4]>)) -> Self {
        let ink = |[r, g, b, alpha]: &[u8; 4]| {
            let light = (u32::from(*r) + u32::from(*g) + u32::from(*b)) as f64 / 765.0;
            (1.0 - light) * f64::from(*alpha) / 255.0
        };
        Self { size: [width as usize, height as usize], ink: pixels.iter().map(ink).collect() }
    }

    fn total_ink(&self) -> f64 {
        self.ink.iter().sum()
    }

    /// Returns the maximum ink in a pixel and its neighbors.
    fn max_ink_around(&self, x: usize, y: usize) -> f64 {
        let [width, height] = self.size;
        let rows = y.saturating_sub(1)..(y + 2).min(height);
        let columns = x.saturating_sub(1)..(x + 2).min(width);
        let row = |y: usize| columns.clone().map(move |x| self.ink[y * width + x]);
        rows.flat_map(row).fold(0.0, f64::max)
    }

    /// Counts the pixels that have a lot of ink in this picture but hardly any in or next to the
    /// same pixel of `other`.
    fn missing_ink(&self, other: &Self) -> usize {
        let [width, height] = self.size;
        let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        places
            .filter(|&(x, y)| self.ink[y * width + x] > 0.5 && other.max_ink_around(x, y) < 0.15)
            .count()
    }
}

#[track_caller]
fn assert_alike(ours: &InkMap, theirs: &InkMap, tolerance: f64, what: &str) {
    assert_eq!(ours.size, theirs.size, "{what}");
    let (missing, extra) = (ours.missing_ink(theirs), theirs.missing_ink(ours));
    let inked = ours.ink.iter().filter(|ink| **ink > 0.5).count();
    assert!(inked > 500, "{what}: only {inked} pixels have ink");
    assert!(
        missing * 500 <= inked && extra * 500 <= inked,
        "{what}: {missing} missing, {extra} extra of {inked}"
    );
    let ratio = ours.total_ink() / theirs.total_ink();
    assert!((ratio - 1.0).abs() < tolerance, "{what}: {ratio} times the ink");
}

/// Returns the drawings to compare: their flags and picture sizes.
fn drawings() -> Vec<(Vec<&'static str>, [u32; 2])> {
    let render = |style, projection| {
        let flags = vec!["render", "house.glb", "--size", "640x480", "--background", "#fff"];
        ([flags, vec!["--style", style, "--projection", projection]].concat(), [640, 480])
    };
    vec![
        render("lines", "perspective"),
        render("technical", "cavalier"),
        render("wireframe", "isometric"),
        render("depth-cued", "perspective"),
        // The default resolution is 150 dots per inch.
        (vec!["sheet", "house.glb", "--paper", "a4", "--author", "Ä. Ŷ, ⌀ 3 × 4°"], [1240, 1754]),
    ]
}

fn draw_file(sandbox: &Sandbox, flags: &[&str], output: &str) {
    let run = sandbox.run(&[flags, &["-o", output]].concat());
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{flags:?}");
}

#[test]
fn chromium_matches_the_png() {
    let Some(chromium) = installed(&["chromium", "chromium-browser", "google-chrome"]) else {
        return;
    };
    let sandbox = Sandbox::new("chromium");
    sandbox.copy_model("house.glb");
    for (flags, [width, height]) in drawings() {
        draw_file(&sandbox, &flags, "ours.png");
        draw_file(&sandbox, &flags, "drawing.svg");
        // A sheet is laid out for 96 pixels per inch.
        let factor = if flags[0] == "sheet" { 150.0 / 96.0 } else { 1.0 };
        let [columns, rows] = [width, height].map(|side| (f64::from(side) / factor).ceil());
        let url = format!("file://{}", sandbox.path_of("drawing.svg").display());
        let status = Command::new(&chromium)
            .args(["--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars"])
            .arg(format!("--user-data-dir={}", sandbox.path_of("profile").display()))
            .arg(format!("--force-device-scale-factor={factor}"))
            .arg(format!("--window-size={columns},{rows}"))
            .arg(format!("--screenshot={}", sandbox.path_of("theirs.png").display()))
            .arg(url)
            .output()
            .expect("Chromium starts");
        assert!(status.status.success(), "{}", String::from_utf8_lossy(&status.stderr));
        let ours = InkMap::from_picture(sandbox.read_picture("ours.png"));
        let theirs = cropped(sandbox.read_picture("theirs.png"), ours.size);
        assert_alike(&ours, &InkMap::from_picture(theirs), 0.1, &format!("{flags:?}"));
    }
}

/// Crops a picture, which may be up to two pixels too large, to its upper-left `columns` × `rows`
/// pixels.
fn cropped(
    (width, height, pixels): (u32, u32, Vec<[u8; 4]>),
    [columns, rows]: [usize; 2],
) -> (u32, u32, Vec<[u8; 4]>) {
    assert!(width as usize >= columns && height as usize >= rows, "{width} x {height}");
    assert!(width as usize <= columns + 2 && height as usize <= rows + 2, "{width} x {height}");
    let kept = pixels.chunks(width as usize).take(rows).flat_map(|row| row[..columns].to_vec());
    (columns as u32, rows as u32, kept.collect())
}

#[test]
fn poppler_matches_the_png() {
    let Some(pdftoppm) = installed(&["pdftoppm"]) else { return };
    let sandbox = Sandbox::new("poppler");
    sandbox.copy_model("house.glb");
    for (flags, [width, height]) in drawings() {
        draw_file(&sandbox, &flags, "ours.png");
        draw_file(&sandbox, &flags, "drawing.pdf");
        let sides = [("-scale-to-x", width), ("-scale-to-y", height)];
        let sides = sides.map(|(flag, side)| [flag.to_owned(), side.to_string()]).concat();
        let run = Command::new(&pdftoppm)
            .args(["-png", "-singlefile"])
            .args(sides)
            .args([sandbox.path_of("drawing.pdf"), sandbox.path_of("theirs")])
            .output()
            .expect("Poppler starts");
        let stderr = String::from_utf8_lossy(&run.stderr).into_owned();
        assert!(run.status.success() && stderr.is_empty(), "{stderr}");
        assert!(Path::new(&sandbox.path_of("theirs.png")).is_file());
        let [ours, theirs] =
            ["ours.png", "theirs.png"].map(|name| InkMap::from_picture(sandbox.read_picture(name)));
        // Poppler snaps narrow lines to whole pixels and makes them a little wider.
        assert_alike(&ours, &theirs, 0.2, &format!("{flags:?}"));
    }
}
