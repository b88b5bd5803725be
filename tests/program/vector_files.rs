//! Reads back the drawings that the program writes: the positions of all lines in an SVG by layer,
//! and in a PDF, in millimeters. It supports only the parts of both formats that the program uses,
//! and fails on anything else.

use std::collections::BTreeMap;

/// A point on the page in millimeters.
pub(crate) type PagePoint = [f64; 2];

/// Lines as lists of points, by layer id.
pub(crate) type Layers = BTreeMap<String, Vec<Vec<PagePoint>>>;

/// Returns the page size of an SVG, and its lines by layer.
pub(crate) fn parse_svg(text: &str) -> (PagePoint, Layers) {
    let size = ["width", "height"].map(|name| {
        let value = attribute_value(text, name).expect(name);
        value.strip_suffix("mm").and_then(|number| number.parse().ok()).expect("millimeters")
    });
    assert_eq!(attribute_value(text, "viewBox"), Some(format!("0 0 {} {}", size[0], size[1])));
    let (mut layers, mut layer) = (Layers::new(), String::new());
    let mut ids = Vec::new();
    for tag in text.split('<').filter(|tag| tag.starts_with("g ") || tag.starts_with("path ")) {
        match (attribute_value(tag, "id"), attribute_value(tag, "d")) {
            (Some(id), _) => {
                layer = id.split('.').next().unwrap_or_default().to_owned();
                ids.push(id);
            }
            (None, Some(path)) => {
                layers.entry(layer.clone()).or_default().extend(parse_path(&path));
            }
            (None, None) => panic!("expected an id or a path in {tag}"),
        }
    }
    let count = ids.len();
    ids.sort();
    ids.dedup();
    assert_eq!(ids.len(), count, "ids are unique");
    (size, layers)
}

/// Returns the first attribute with a name.
fn attribute_value(text: &str, name: &str) -> Option<String> {
    let start = text.find(&format!(" {name}=\""))? + name.len() + 3;
    Some(text[start..].split('"').next().unwrap_or_default().to_owned())
}

/// Returns the lines of a path that contains only `M m l h v z`.
fn parse_path(path: &str) -> Vec<Vec<PagePoint>> {
    let mut lines: Vec<Vec<PagePoint>> = Vec::new();
    let (mut at, mut start) = ([0.0, 0.0], [0.0, 0.0]);
    let mut rest = path;
    while let Some(command) = rest.chars().next() {
        let end = rest[1..].find(|c: char| c.is_ascii_alphabetic()).map_or(rest.len(), |n| n + 1);
        let numbers = parse_numbers(&rest[1..end]);
        rest = &rest[end..];
        match command {
            'M' | 'm' => {
                let [x, y] = numbers[..] else { panic!("expected one point in {path}") };
                at = if command == 'M' { [x, y] } else { [at[0] + x, at[1] + y] };
                start = at;
                lines.push(vec![at]);
                continue;
            }
            'z' => at = start,
            'h' | 'v' | 'l' => {}
            other => panic!("unsupported command {other}"),
        }
        let line = lines.last_mut().expect("a path begins with M");
        let steps: Vec<PagePoint> = match command {
            'h' => numbers.iter().map(|&x| [x, 0.0]).collect(),
            'v' => numbers.iter().map(|&y| [0.0, y]).collect(),
            'l' => numbers.as_chunks::<2>().0.to_vec(),
            _ => vec![],
        };
        for [x, y] in steps {
            at = [at[0] + x, at[1] + y];
            line.push(at);
        }
        if command == 'z' {
            line.push(start);
        }
    }
    lines
}

/// Parses numbers separated by spaces, or by the sign of the next number.
fn parse_numbers(text: &str) -> Vec<f64> {
    let parted = text.replace('-', " -");
    parted.split_ascii_whitespace().map(|word| word.parse().expect("a number")).collect()
}

/// Returns the lines on each page of a PDF in millimeters from its upper left corner, and the page
/// sizes.
pub(crate) fn parse_pdf(bytes: &[u8]) -> Vec<(PagePoint, Vec<Vec<PagePoint>>)> {
    let text = String::from_utf8_lossy(bytes);
    let sizes: Vec<PagePoint> = text
        .split("/MediaBox [")
        .skip(1)
        .map(|rest| {
            let numbers = parse_numbers(rest.split(']').next().expect("a box"));
            [numbers[2] * POINT, numbers[3] * POINT]
        })
        .collect();
    let contents = inflate_streams(bytes);
    assert_eq!(sizes.len(), contents.len(), "a stream for each page");
    sizes
        .into_iter()
        .zip(contents)
        .map(|(size, content)| (size, drawn_lines(&content, size[1])))
        .collect()
}

/// Millimeters per point.
const POINT: f64 = 25.4 / 72.0;

/// Returns the decompressed streams in a file; font streams are not compressed and are skipped.
fn inflate_streams(bytes: &[u8]) -> Vec<String> {
    let find = |from: usize, word: &[u8]| {
        bytes[from..].windows(word.len()).position(|part| part == word).map(|at| from + at)
    };
    let (mut streams, mut from) = (Vec::new(), 0);
    while let Some(start) = find(from, b"\nstream\n") {
        let start = start + 8;
        let end = find(start, b"\nendstream").expect("an end");
        let text = miniz_oxide::inflate::decompress_to_vec_zlib(&bytes[start..end]);
        streams.extend(text.map(|text| String::from_utf8(text).expect("text")));
        from = end;
    }
    streams
}

/// Returns the lines that a content stream draws.
fn drawn_lines(content: &str, height: f64) -> Vec<Vec<PagePoint>> {
    let mut map = [1.0, 0.0, 0.0, 1.0, 0.0, 0.0];
    let (mut lines, mut stack): (Vec<Vec<PagePoint>>, Vec<f64>) = (Vec::new(), Vec::new());
    for word in content.split_ascii_whitespace() {
        if let Ok(number) = word.parse() {
            stack.push(number);
            continue;
        }
        let point = || {
            let [.., x, y] = stack[..] else { panic!("expected a point before {word}") };
            let [a, b, c, d, e, f] = map;
            [(a * x + c * y + e) * POINT, height - (b * x + d * y + f) * POINT]
        };
        match word {
            "cm" => map = stack[..].try_into().expect("six numbers"),
            "m" => lines.push(vec![point()]),
            "l" => lines.last_mut().expect("after m").push(point()),
            "h" => {
                let line = lines.last_mut().expect("after m");
                line.push(line[0]);
            }
            _ => {}
        }
        stack.clear();
    }
    lines
}

/// Returns the minimum and maximum coordinates of the wanted layers.
pub(crate) fn layer_bounds(layers: &Layers, wanted: impl Fn(&str) -> bool) -> [PagePoint; 2] {
    let chosen = layers.iter().filter(|(id, _)| wanted(id));
    point_bounds(chosen.flat_map(|(_, lines)| lines).flatten())
}

/// Returns the minimum and maximum coordinates of points.
pub(crate) fn point_bounds<'a>(places: impl Iterator<Item = &'a PagePoint>) -> [PagePoint; 2] {
    places.fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[low, high], place| {
        let axis = |f: fn(f64, f64) -> f64, from: PagePoint| [0, 1].map(|k| f(from[k], place[k]));
        [axis(f64::min, low), axis(f64::max, high)]
    })
}
