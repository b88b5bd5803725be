//! KTX2 images from real encoders, compared with the texels of the reference transcoder.
//!
//! Each image in `ktx2/` has 7 x 5 texels and shows a gradient with a white corner. The Basis
//! Universal 2.50 encoder wrote them, and the transcoder of the same project wrote the RGBA32
//! texels next to them. The specification defines the decoded texels exactly.

use import::{ImportOptions, decode_image, load_bytes};

/// The name, file and texels of each image.
const IMAGES: [(&str, &[u8], &[u8]); 4] = [
    ("etc1s", include_bytes!("ktx2/etc1s.ktx2"), include_bytes!("ktx2/etc1s.rgba")),
    (
        "etc1s_opaque_mips",
        include_bytes!("ktx2/etc1s_opaque_mips.ktx2"),
        include_bytes!("ktx2/etc1s_opaque_mips.rgba"),
    ),
    ("uastc", include_bytes!("ktx2/uastc.ktx2"), include_bytes!("ktx2/uastc.rgba")),
    ("uastc_zstd", include_bytes!("ktx2/uastc_zstd.ktx2"), include_bytes!("ktx2/uastc_zstd.rgba")),
];

#[test]
fn images_match_the_reference_transcoder() {
    for (name, file, texels) in IMAGES {
        let image = decode_image(file, 35).expect(name);
        assert_eq!((image.width, image.height), (7, 5), "{name}");
        assert_eq!(image.rgba.as_flattened(), texels, "{name}");
        let message = decode_image(file, 34).expect_err("one texel too many");
        assert_eq!(message, "the image has 7 x 5 texels; the limit is 34");
    }
}

#[test]
fn every_truncation_is_an_error() {
    for (name, file, _) in IMAGES {
        // The smaller mipmap levels are stored before the first level and are not read.
        for end in 0..file.len() {
            assert!(decode_image(&file[..end], 35).is_err(), "{name} truncated at {end}");
        }
    }
}

#[test]
fn extension_textures_take_precedence_over_fallbacks() {
    let base64 = |bytes: &[u8]| {
        use base64::Engine as _;
        base64::engine::general_purpose::STANDARD.encode(bytes)
    };
    let [_, _, (_, file, texels), _] = IMAGES;
    let positions: Vec<u8> = [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]
        .iter()
        .flat_map(|x| x.to_le_bytes())
        .collect();
    let document = format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}],
        "extensionsUsed": ["KHR_texture_basisu"], "extensionsRequired": ["KHR_texture_basisu"],
        "buffers": [{{"byteLength": 36, "uri": "data:application/octet-stream;base64,{}"}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 36}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3,
            "min": [0, 0, 0], "max": [1, 1, 0]}},
            {{"componentType": 5126, "type": "VEC2", "count": 3}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0, "TEXCOORD_0": 1}}, "material": 0}}]}}],
        "materials": [{{"pbrMetallicRoughness": {{"baseColorTexture": {{"index": 0}}}}}}],
        "textures": [{{"source": 1, "extensions": {{"KHR_texture_basisu": {{"source": 0}}}}}}],
        "images": [{{"mimeType": "image/ktx2", "uri": "data:image/ktx2;base64,{}"}},
            {{"uri": "missing.png"}}]}}"#,
        base64(&positions),
        base64(file)
    );
    let model =
        load_bytes("model.gltf", document.as_bytes(), &ImportOptions::default()).expect("a model");
    assert_eq!(model.warnings, []);
    let image = model.images[0].as_ref().expect("an image");
    assert_eq!(image.rgba.as_flattened(), texels);
    let header = model.image_infos[0].header.as_ref().expect("a header");
    assert_eq!((header.format, header.width, header.height), ("ktx2", 7, 5));
}
