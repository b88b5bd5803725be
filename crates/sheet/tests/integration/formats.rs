//! Readers for sheets in SVG, PDF and DXF, which return the lines and text of one layer.

use glam::DVec2;
use page::{DxfOptions, to_pdf};
use sheet::SheetPage;

/// The straight lines of a layer, in millimeters on paper with y down, and its text.
#[derive(Debug, Default)]
pub struct ReadLayer {
    pub lines: Vec<Vec<DVec2>>,
    pub texts: Vec<String>,
}

/// Reads the lines and text of a layer in an SVG file, without its filled areas.
pub fn read_svg(page: &SheetPage, layer: &str) -> ReadLayer {
    let svg = page.to_svg();
    let mut read = ReadLayer::default();
    let mut is_inside = false;
    for line in svg.lines() {
        if let Some(rest) = line.strip_prefix("<g id=\"") {
            let id = rest.split('"').next().expect("an id");
            is_inside = id == layer || id.starts_with(&format!("{layer}."));
        }
        if !is_inside {
            continue;
        }
        if let Some(title) = line.strip_prefix("<title>") {
            read.texts.push(title.trim_end_matches("</title>").to_owned());
        }
        if let Some(rest) = line.strip_prefix("<path d=\"")
            && !rest.contains("fill=")
        {
            read.lines.extend(path_lines(rest.split('"').next().expect("a path")));
        }
    }
    // The first title belongs to the layer.
    read.texts.remove(0);
    read
}

/// Returns the polylines of path data with M, m, l, h, v and z.
fn path_lines(data: &str) -> Vec<Vec<DVec2>> {
    let mut lines: Vec<Vec<DVec2>> = Vec::new();
    let mut at = DVec2::ZERO;
    let mut rest = data;
    while let Some(command) = rest.chars().next() {
        rest = &rest[1..];
        let end = rest.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(rest.len());
        let numbers = svg_numbers(&rest[..end]);
        rest = &rest[end..];
        match command {
            'M' | 'm' => {
                let [x, y] = numbers[..] else { panic!("{data}") };
                at = if command == 'M' { DVec2::new(x, y) } else { at + DVec2::new(x, y) };
                lines.push(vec![at]);
            }
            'z' => at = lines.last().expect("a line")[0],
            _ => {
                let steps: Vec<DVec2> = match command {
                    'h' => numbers.iter().map(|x| DVec2::new(*x, 0.0)).collect(),
                    'v' => numbers.iter().map(|y| DVec2::new(0.0, *y)).collect(),
                    _ => numbers.chunks(2).map(|pair| DVec2::new(pair[0], pair[1])).collect(),
                };
                for step in steps {
                    at += step;
                    lines.last_mut().expect("a line").push(at);
                }
            }
        }
    }
    lines
}

/// Parses numbers separated by spaces or by their minus signs.
fn svg_numbers(text: &str) -> Vec<f64> {
    let spaced = text.replace('-', " -");
    spaced.split_whitespace().map(|number| number.parse().expect("a number")).collect()
}

/// Reads the lines of a layer in a PDF file, without its filled areas, from the operators `m` and
/// `l` up to each `S`.
pub fn read_pdf(page: &SheetPage, layer: &str) -> Vec<Vec<DVec2>> {
    let index = page.layers.iter().position(|other| other.id == layer).expect("a layer");
    let bytes = to_pdf(std::slice::from_ref(page));
    let content = pdf_streams(&bytes).into_iter().find(|text| text.contains("BDC")).expect("lines");
    let (_, from) = content.split_once(&format!("/OC /L{index} BDC\n")).expect("the layer");
    let mut lines: Vec<Vec<DVec2>> = Vec::new();
    let mut path: Vec<Vec<DVec2>> = Vec::new();
    for operation in from.split("EMC").next().expect("its content").lines() {
        let mut words: Vec<&str> = operation.split(' ').collect();
        let operator = words.pop().expect("an operator");
        let point = || DVec2::new(words[0].parse().unwrap(), words[1].parse().unwrap());
        match operator {
            "m" => path.push(vec![point()]),
            "l" => path.last_mut().expect("a path").push(point()),
            "S" => lines.append(&mut path),
            "f*" => path.clear(),
            _ => {}
        }
    }
    lines
}

/// Returns the text of the compressed streams in a PDF file.
fn pdf_streams(bytes: &[u8]) -> Vec<String> {
    let find = |from: usize, word: &[u8]| {
        bytes[from..].windows(word.len()).position(|part| part == word).map(|at| from + at)
    };
    let (mut streams, mut at) = (Vec::new(), 0);
    while let Some(start) = find(at, b"stream\n") {
        let start = start + 7;
        let end = find(start, b"\nendstream").expect("an end");
        let content = miniz_oxide::inflate::decompress_to_vec_zlib(&bytes[start..end]);
        streams.extend(content.ok().and_then(|content| String::from_utf8(content).ok()));
        at = end + 10;
    }
    streams
}

/// Reads the lines and text of a layer in a DXF file of a page, and flips y so that it points down.
pub fn read_dxf(page: &SheetPage, layer: &str) -> ReadLayer {
    let bytes = page.to_dxf(&DxfOptions::on_paper(page));
    let text = String::from_utf8(bytes).expect("ASCII");
    let words: Vec<&str> = text.lines().map(str::trim).collect();
    let tags: Vec<(&str, &str)> = words.chunks(2).map(|pair| (pair[0], pair[1])).collect();
    let mut read = ReadLayer::default();
    for entity in tags.split(|(code, _)| *code == "0").zip(kinds(&tags)) {
        let (body, kind) = entity;
        let value = |wanted: &str| body.iter().find(|(code, _)| *code == wanted).map(|tag| tag.1);
        if value("8") != Some(layer) {
            continue;
        }
        let number = |code: &str| value(code).expect("a number").parse::<f64>().unwrap();
        let point = |x: &str, y: &str| DVec2::new(number(x), page.size.y - number(y));
        match kind {
            "LINE" => read.lines.push(vec![point("10", "20"), point("11", "21")]),
            "TEXT" => read.texts.push(value("1").expect("text").replace("\\U+00D8", "Ø")),
            _ => {}
        }
    }
    read
}

/// Returns the kind of each entity, which begins at a tag with code 0. The part before the first
/// entity has an empty kind.
fn kinds<'a>(tags: &[(&'a str, &'a str)]) -> Vec<&'a str> {
    let kinds = tags.iter().filter(|(code, _)| *code == "0").map(|(_, kind)| *kind);
    core::iter::once("").chain(kinds).collect()
}
