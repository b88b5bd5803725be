//! Streams from a real encoder: the sample box that ships with glTF-Transform, with 24 vertices and
//! 12 triangles.

use super::*;
use gltf::json::buffer::View;
use serde_json::json;

const NORMALS: [u8; 71] = [
    0xA0, 0x05, 0x00, 0x00, 0xC0, 0xC0, 0xFE, 0xFD, 0xC0, 0xC0, 0x00, 0x00, 0xFD, 0xFE, 0x05, 0x00,
    0xC0, 0x00, 0x00, 0xFD, 0x00, 0xC0, 0x00, 0x00, 0xFD, 0x05, 0x00, 0xC0, 0xC0, 0xC0, 0xFE, 0xFD,
    0xFD, 0xC0, 0x00, 0x00, 0x00, 0xFE, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0x7F, 0x00, 0x00,
];
const POSITIONS: [u8; 124] = [
    0xA0, 0x05, 0x19, 0x26, 0x40, 0x99, 0x80, 0x04, 0x00, 0x00, 0x05, 0x3F, 0x3F, 0xC0, 0xFF, 0x7E,
    0x7D, 0x7E, 0x7D, 0x7E, 0x7D, 0x7E, 0x7D, 0x7E, 0x7D, 0x7E, 0xC0, 0x0C, 0x00, 0x00, 0x7D, 0x7E,
    0x05, 0x00, 0x08, 0x48, 0x48, 0x48, 0x00, 0x00, 0x00, 0x05, 0x00, 0x0C, 0xCC, 0xCC, 0x7D, 0x7E,
    0x7D, 0x7E, 0x7D, 0xCC, 0x00, 0x00, 0x00, 0x7E, 0x7D, 0x05, 0x08, 0x40, 0x99, 0x80, 0x66, 0x66,
    0x00, 0x00, 0x05, 0x0C, 0xC0, 0xFF, 0xC0, 0x7D, 0x7E, 0x7D, 0x7E, 0x7D, 0x7E, 0x7D, 0xFF, 0xFF,
    0x00, 0x00, 0x7E, 0x7D, 0x7E, 0x7D, 0x7E, 0x7D, 0x7E, 0x7D, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0xFF, 0x3F, 0xFF, 0x3F, 0x00, 0x00,
];
const TRIANGLES: [u8; 29] = [
    0xE1, 0xF0, 0x10, 0xF0, 0x10, 0xF0, 0x10, 0xF0, 0x10, 0xF0, 0x10, 0xF0, 0x10, 0x00, 0x76, 0x87,
    0x56, 0x67, 0x78, 0xA9, 0x86, 0x65, 0x89, 0x68, 0x98, 0x01, 0x69, 0x00, 0x00,
];

fn parse_extension(extension: &Value, length: usize) -> Result<Option<CompressedView>, Diagnostic> {
    let extensions = json!({"EXT_meshopt_compression": extension});
    let view = json!({"buffer": 1, "byteLength": length, "extensions": extensions});
    let view: View = serde_json::from_value(view).unwrap();
    CompressedView::from_view(&view, "/bufferViews/7")
}

fn compressed_view(mode: &str, count: usize, stride: usize) -> CompressedView {
    let extension =
        json!({"buffer": 0, "byteLength": 9, "count": count, "byteStride": stride, "mode": mode});
    parse_extension(&extension, count * stride).unwrap().unwrap()
}

#[test]
fn the_sample_box_is_decoded() {
    let positions = compressed_view("ATTRIBUTES", 24, 8).decompress(&POSITIONS).unwrap();
    let positions: Vec<[u16; 3]> = positions
        .chunks(8)
        .map(|p| [0, 2, 4].map(|at| u16::from_le_bytes([p[at], p[at + 1]])))
        .collect();
    assert!(positions.iter().flatten().all(|x| [0, 16_383].contains(x)), "{positions:?}");
    let normals = compressed_view("ATTRIBUTES", 24, 4).decompress(&NORMALS).unwrap();
    let normals: Vec<[i8; 3]> =
        normals.chunks(4).map(|n| [n[0], n[1], n[2]].map(u8::cast_signed)).collect();
    let indices = compressed_view("TRIANGLES", 36, 2).decompress(&TRIANGLES).unwrap();
    let indices: Vec<usize> =
        indices.chunks(2).map(|i| usize::from(u16::from_le_bytes([i[0], i[1]]))).collect();
    let mut area = 0;
    for corners in indices.chunks(3) {
        let at = |corner: usize| positions[corners[corner]].map(|x| i64::from(x / 16_383));
        let ([a, b, c], normal) = ([at(0), at(1), at(2)], normals[corners[0]]);
        let side = |to: [i64; 3]| [to[0] - a[0], to[1] - a[1], to[2] - a[2]];
        let (u, v) = (side(b), side(c));
        let cross =
            [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        assert_eq!(
            cross.map(|x| 127 * x),
            normal.map(i64::from),
            "the face points along its normal"
        );
        area += 1;
    }
    assert_eq!(area, 12);
}

#[test]
fn truncated_streams_are_rejected() {
    for (stream, packed) in [
        (&NORMALS[..], compressed_view("ATTRIBUTES", 24, 4)),
        (&POSITIONS, compressed_view("ATTRIBUTES", 24, 8)),
        (&TRIANGLES, compressed_view("TRIANGLES", 36, 2)),
    ] {
        assert!(packed.decompress(stream).is_ok());
        for end in 0..stream.len() {
            let diagnostic = packed.decompress(&stream[..end]).unwrap_err();
            assert_eq!(diagnostic.location, "/bufferViews/7/extensions/EXT_meshopt_compression");
        }
        let longer = [stream, &[0]].concat();
        let message = packed.decompress(&longer).unwrap_err().message;
        let expected = [
            "extra bytes at the end of the stream: 1",
            "the stream refers to an edge or vertex that is not yet decoded",
        ];
        assert!(expected.contains(&&*message), "{message}");
    }
}

#[test]
fn modified_bytes_do_not_panic() {
    let mut seed = 1u64;
    let mut random = || {
        seed ^= seed << 13;
        seed ^= seed >> 7;
        seed ^= seed << 17;
        seed as usize
    };
    for (stream, count, stride) in
        [(&NORMALS[..], 24, 4usize), (&POSITIONS, 24, 8), (&TRIANGLES, 36, 2)]
    {
        for _ in 0..4_000 {
            let mut changed = stream.to_vec();
            for _ in 0..=random() % 4 {
                let at = random() % changed.len();
                changed[at] = random() as u8;
            }
            // The first byte selects the version, and version 1 interprets the bytes differently.
            for (mode, first) in
                [("ATTRIBUTES", 0xA0), ("ATTRIBUTES", 0xA1), ("TRIANGLES", 0xE1), ("INDICES", 0xD1)]
            {
                changed[0] = first;
                let stride = if first < 0xD0 { stride.next_multiple_of(4) } else { 2 };
                if let Ok(bytes) = compressed_view(mode, count, stride).decompress(&changed) {
                    assert_eq!(bytes.len(), count * stride);
                }
            }
        }
    }
}

#[test]
fn extension_members_are_validated() {
    let good =
        json!({"buffer": 0, "byteLength": 9, "count": 6, "byteStride": 8, "mode": "ATTRIBUTES"});
    let plain: View = serde_json::from_value(json!({"buffer": 1, "byteLength": 48})).unwrap();
    assert!(CompressedView::from_view(&plain, "").unwrap().is_none());
    for (changes, length, diagnostic) in [
        (json!({}), 48, None),
        (json!({"filter": "COLOR"}), 48, None),
        (json!({"mode": "INDICES", "byteStride": 2}), 12, None),
        (
            json!({}),
            49,
            Some("/byteLength: 6 compressed elements of 8 bytes do not match a byteLength of 49"),
        ),
        (json!({"mode": "TRIANGLES"}), 48, Some("/byteStride: the stride is 8 but must be 2 or 4")),
        (
            json!({"mode": "TRIANGLES", "byteStride": 2, "count": 4}),
            8,
            Some("/count: the number of indices, 4, is not a multiple of 3"),
        ),
        (
            json!({"mode": "EDGES"}),
            48,
            Some("/mode: the mode must be ATTRIBUTES, TRIANGLES or INDICES, not \"EDGES\""),
        ),
        (json!({"filter": "SMALL"}), 48, Some("/filter: unknown filter \"SMALL\"")),
        (
            json!({"filter": "QUATERNION", "byteStride": 4}),
            24,
            Some("/byteStride: the stride is 4 but must be 8"),
        ),
        (
            json!({"mode": "INDICES", "byteStride": 4, "filter": "COLOR"}),
            24,
            Some("/filter: only the mode ATTRIBUTES may have a filter"),
        ),
        (json!({"count": "six"}), 48, Some("/count: expected an integer")),
        (json!({"byteOffset": -1}), 48, Some("/byteOffset: expected an integer")),
        (
            json!({"byteStride": 260}),
            1560,
            Some("/byteStride: the stride is 260 but must be a multiple of 4 from 4 to 256"),
        ),
    ] {
        let mut extension = good.clone();
        extension.as_object_mut().unwrap().extend(changes.as_object().unwrap().clone());
        let actual = parse_extension(&extension, length)
            .err()
            .map(|diagnostic| format!("{}: {}", diagnostic.location, diagnostic.message));
        let ends =
            |actual: &String| diagnostic.is_some_and(|diagnostic| actual.ends_with(diagnostic));
        assert!(actual.as_ref().map_or(diagnostic.is_none(), ends), "{changes}: {actual:?}");
    }
}
