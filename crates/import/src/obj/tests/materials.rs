//! Tests of material libraries and their textures, in temporary folders.

use super::{SQUARE, primitives, warnings};
use crate::load;
use gltf_import::{ImageLoading, ImportOptions};
use model::{AlphaMode, Material, Model, TextureInfo, WrapMode};
use std::path::{Path, PathBuf};

/// A folder that is removed with its contents when dropped.
struct Folder(PathBuf);

impl Folder {
    /// Creates an empty folder with a name that is unique to the test.
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("obj-{name}-{}", std::process::id()));
        std::fs::remove_dir_all(&path).ok();
        std::fs::create_dir_all(path.join("sub")).unwrap();
        Self(path)
    }

    /// Writes a file.
    fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        std::fs::write(self.0.join(name), bytes).unwrap();
    }

    /// Writes a PNG of one row.
    fn write_png(&self, name: &str, row: &[[u8; 4]]) {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, row.len() as u32, 1);
        encoder.set_color(png::ColorType::Rgba);
        encoder.write_header().unwrap().write_image_data(row.as_flattened()).unwrap();
        self.write(name, bytes);
    }

    /// Loads an OBJ file.
    fn load(&self, name: &str) -> Model {
        load(&self.0.join(name), &ImportOptions::default()).unwrap()
    }

    /// Returns the path of the folder.
    fn path(&self) -> &Path {
        &self.0
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        std::fs::remove_dir_all(&self.0).ok();
    }
}

/// Returns a textured square with the material `m` from the library `a.mtl`.
fn square() -> String {
    format!("mtllib a.mtl\nusemtl m\n{SQUARE}vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n")
}

/// Returns a model of the square whose material has these statements.
fn model_of(name: &str, statements: &str) -> Model {
    let folder = Folder::new(name);
    folder.write("a.mtl", format!("newmtl m\n{statements}\n"));
    folder.write("a.obj", square());
    folder.load("a.obj")
}

/// Returns the material described by these statements.
fn material_of(name: &str, statements: &str) -> Material {
    let mut model = model_of(name, statements);
    assert_eq!(model.materials.len(), 1);
    model.materials.remove(0)
}

/// Returns whether two numbers differ only by rounding.
fn is_near(a: f32, b: f64) -> bool {
    (f64::from(a) - b).abs() < 1e-5
}

#[test]
fn phong_becomes_metallic_roughness() {
    let material = material_of("phong", "Kd 1 0.5 0\nKs 0.5 0.5 0.5\nNs 30\nillum 2\nd 1.0");
    let [r, g, b, a] = material.base_color;
    assert!(is_near(r, 1.0) && is_near(g, 0.214_041) && b == 0.0 && a == 1.0);
    // α² = 2 / 32, so α is 1/4, and the roughness √α is 1/2.
    assert!(is_near(material.roughness, 0.5), "{}", material.roughness);
    assert_eq!((material.metallic, material.alpha_mode), (0.0, AlphaMode::Opaque));
    assert!(material.double_sided && !material.unlit);
    assert_eq!(material.extensions.specular, None, "4% is the default");
    assert_eq!(material.name.as_deref(), Some("m"));

    let strong = material_of("strong", "Kd 0.5 0.5 0.5\nKs 1 0.5 0");
    let layer = strong.extensions.specular.unwrap();
    assert_eq!((layer.factor, layer.color), (1.0, [2.0, 1.0, 0.0]));
    let weak = material_of("weak", "Kd 0.5 0.5 0.5\nKs 0.25 0.25 0.125");
    let layer = weak.extensions.specular.unwrap();
    assert_eq!((layer.factor, layer.color), (0.5, [1.0, 1.0, 0.5]));
    let metal = material_of("metal", "Kd 0 0 0\nKs 1 0.5 0\nNs 1000");
    assert_eq!((metal.metallic, metal.base_color[0]), (1.0, 1.0));
    assert!(is_near(metal.base_color[1], 0.214_041));
    let matte = material_of("matte", "illum 1\nKd 1 1 1\nKs 1 1 1\nNs 1000");
    assert_eq!((matte.roughness, matte.extensions.specular.unwrap().factor), (1.0, 0.0));
    assert!(material_of("unlit", "illum 0\nKd 1 1 1").unlit);
    let gray = material_of("gray", "KD 1\nns -5\n");
    assert_eq!((gray.base_color, gray.roughness), ([1.0; 4], 1.0));
}

#[test]
fn opacity_comes_from_d_or_else_tr() {
    for (name, statements, alpha, mode) in [
        ("d", "d 0.25", 0.25, AlphaMode::Blend),
        ("halo", "d -halo 0.5", 0.5, AlphaMode::Blend),
        ("tr", "Tr 0.25", 0.75, AlphaMode::Blend),
        ("both", "Tr 1\nd 1", 1.0, AlphaMode::Opaque),
        ("tr1", "Tr 1", 1.0, AlphaMode::Opaque),
        ("d0", "d 0", 0.0, AlphaMode::Blend),
        ("beyond", "d 7", 1.0, AlphaMode::Opaque),
        ("nan", "d nan", 1.0, AlphaMode::Opaque),
    ] {
        let model = model_of(name, statements);
        assert_eq!(model.materials[0].base_color[3], alpha, "{statements}");
        assert_eq!(model.materials[0].alpha_mode, mode, "{statements}");
        let told = warnings(&model);
        match statements {
            "Tr 1" => assert!(told.contains("it is shown opaque"), "{told}"),
            "d 0" => assert!(told.contains("is invisible"), "{told}"),
            _ => assert!(!told.contains("opaque"), "{told}"),
        }
    }
}

#[test]
fn physically_based_keys_are_used_unchanged() {
    let material = material_of(
        "pbr",
        "Kd 1 1 1\nKs 1 0 0\nNs 3\nPr 0.3\nPm 0.75\nPs 0.5\nPc 0.6\nPcr 0.1\naniso 0.4\nanisor 0.25\n\
         Ni 1.33\nKe 4 2 0",
    );
    assert_eq!((material.roughness, material.metallic), (0.3, 0.75));
    let layers = material.extensions;
    assert_eq!((layers.ior, layers.specular), (1.33, None));
    assert_eq!(layers.sheen.unwrap().color, [0.5; 3]);
    let coat = layers.clearcoat.unwrap();
    assert_eq!((coat.factor, coat.roughness), (0.6, 0.1));
    let anisotropy = layers.anisotropy.unwrap();
    assert_eq!(anisotropy.strength, 0.4);
    assert!(is_near(anisotropy.rotation, std::f64::consts::FRAC_PI_2));
    assert_eq!((material.emission.strength, material.emission.color[0]), (4.0, 1.0));
    assert!(is_near(material.emissive[1], 4.0 * 0.214_041));
}

#[test]
fn supported_texture_options_are_applied() {
    let folder = Folder::new("options");
    folder.write_png("my picture.png", &[[255, 0, 0, 255]]);
    folder.write("a.obj", square());
    folder.write(
        "a.mtl",
        "newmtl m\nKd 0 0 0\nmap_Kd -s 2 4 1 -o 0.5 0.25 -clamp on -blendu on -mm 0 1 my picture.png\n\
         map_Ke -boost 2 -t 1 1 1 my picture.png\nmap_Ks other.png\nmap_Ka ambient.png\n",
    );
    let model = folder.load("a.obj");
    let info = model.materials[0].base_color_texture.unwrap();
    // With v up, u' = 2 u + 0.5 and v' = 4 v + 0.25. At the lower left, here (0, 1), v' is 0.25.
    let at = |[u, v]: [f32; 2]| info.uv_matrix.map(|[x, y, z]| x * u + y * v + z);
    assert_eq!(at([0.0, 1.0]), [0.5, 0.75]);
    assert_eq!(at([1.0, 0.0]), [2.5, -3.25]);
    let sampler = model.textures[info.texture].sampler;
    assert_eq!((sampler.wrap_u, sampler.wrap_v), (WrapMode::ClampToEdge, WrapMode::ClampToEdge));
    let emissive = model.materials[0].emissive_texture.unwrap();
    assert_eq!(emissive.uv_matrix, TextureInfo::IDENTITY_UV);
    assert_eq!(model.materials[0].emissive, [1.0; 3], "black would hide the emissive texture");
    assert_eq!(model.materials[0].base_color, [1.0; 4], "black would hide the color texture");
    assert_eq!(model.images.len(), 1, "both textures use one file");
    assert_eq!(model.images[0].as_ref().unwrap().rgba, [[255, 0, 0, 255]]);
    let told = warnings(&model);
    for expected in ["`-boost`", "`-t`", "`map_Ks`"] {
        assert!(told.contains(&format!("{expected} is ignored")), "{told}");
    }
    assert_eq!(told.lines().count(), 3, "{told}");
    assert!(told.starts_with("a.mtl: line 4, column 8: "), "{told}");
}

#[test]
fn opacity_roughness_and_metalness_images_are_combined() {
    let folder = Folder::new("combined");
    folder.write_png("color.png", &[[10, 20, 30, 255], [40, 50, 60, 255]]);
    folder.write_png("mask.png", &[[255, 255, 255, 255], [0, 0, 0, 255]]);
    folder.write_png("leaf.png", &[[1, 2, 3, 0], [4, 5, 6, 255]]);
    folder.write_png("rough.png", &[[70, 70, 70, 255], [80, 80, 80, 255]]);
    folder.write_png("metal.png", &[[90, 90, 90, 255]]);
    folder.write("a.obj", square());
    folder.write(
        "a.mtl",
        "newmtl m\nmap_Kd color.png\nmap_d mask.png\nmap_Pr rough.png\nmap_Pm metal.png\n",
    );
    let model = folder.load("a.obj");
    let material = &model.materials[0];
    let texels = |info: Option<TextureInfo>| {
        let image = model.textures[info.unwrap().texture].image.unwrap();
        model.images[image].clone().unwrap().rgba
    };
    assert_eq!(texels(material.base_color_texture), [[10, 20, 30, 255], [40, 50, 60, 0]]);
    assert_eq!(
        texels(material.metallic_roughness_texture),
        [[255, 70, 90, 255], [255, 80, 90, 255]]
    );
    assert_eq!((material.roughness, material.metallic), (1.0, 1.0));
    assert_eq!(material.alpha_mode, AlphaMode::Blend);

    // A file with both color and opacity is used unchanged; a mask without color is put on white.
    folder.write("a.mtl", "newmtl m\nmap_Kd leaf.png\nmap_d leaf.png\n");
    let model = folder.load("a.obj");
    assert_eq!(model.images.len(), 1);
    folder.write("a.mtl", "newmtl m\nmap_d -imfchan b leaf.png\n");
    let model = folder.load("a.obj");
    let image =
        model.textures[model.materials[0].base_color_texture.unwrap().texture].image.unwrap();
    assert_eq!(
        model.images[image].as_ref().unwrap().rgba,
        [[255, 255, 255, 3], [255, 255, 255, 6]]
    );
    let headers = ImportOptions { images: ImageLoading::Headers, ..ImportOptions::default() };
    let model = load(&folder.path().join("a.obj"), &headers).unwrap();
    assert!(model.images.iter().all(Option::is_none));
}

#[test]
fn bump_maps_are_used_only_if_they_are_normal_maps() {
    let folder = Folder::new("bump");
    folder.write_png("normal.png", &[[128, 128, 255, 255]]);
    folder.write_png("height.png", &[[7, 7, 7, 255]]);
    folder.write("a.obj", square());
    for (statement, expected) in [
        ("map_Bump -bm 0.5 normal.png", Some(0.5)),
        ("bump normal.png", Some(1.0)),
        ("norm height.png", Some(1.0)),
        ("map_bump height.png", None),
    ] {
        folder.write("a.mtl", format!("newmtl m\n{statement}\n"));
        let model = folder.load("a.obj");
        assert_eq!(
            model.materials[0].normal_texture.map(|normal| normal.scale),
            expected,
            "{statement}"
        );
        assert_eq!(warnings(&model).contains("height map"), expected.is_none(), "{statement}");
    }
}

#[test]
fn mtllib_accepts_one_or_several_names() {
    let folder = Folder::new("libraries");
    folder.write("my library.mtl", "newmtl m\nKd 1 1 1\n");
    folder.write("one.mtl", "newmtl other\nnewmtl  two words  \nKd 0 0 0\n");
    folder.write("two.mtl", "\u{FEFF}newmtl m\nPr 0.125\n");
    for (library, name, roughness) in [
        ("my library.mtl", "m", 1.0),
        ("one.mtl two.mtl", "m", 0.125),
        ("my library.mtl\nmtllib two.mtl", "m", 1.0),
        ("one.mtl", "two words", 1.0),
    ] {
        let text =
            square().replace("a.mtl", library).replace("usemtl m", &format!("usemtl {name}"));
        folder.write("a.obj", text);
        let model = folder.load("a.obj");
        assert_eq!(model.materials[0].name.as_deref(), Some(name));
        assert_eq!(model.materials[0].roughness, roughness, "{library}");
        assert_eq!(warnings(&model), "", "{library}");
    }
    // Both the missing file and the undefined material are reported.
    folder.write("a.obj", square().replace("a.mtl", "gone.mtl"));
    let model = folder.load("a.obj");
    assert!(
        warnings(&model).contains("the file \"gone.mtl\" does not exist; the default material")
    );
    assert!(warnings(&model).contains("no material library defines \"m\""));
    assert_eq!((model.materials[0].name.as_deref(), model.materials[0].metallic), (Some("m"), 0.0));
}

#[test]
fn libraries_and_textures_may_be_data_uris() {
    let library = "data:;base64,bmV3bXRsIG0KUHIgMC4yNQpuZXcKbWFwX0tkIGRhdGE6LC8vLwo=";
    let model = super::read(square().replace("a.mtl", library)).unwrap();
    assert_eq!(model.materials[0].roughness, 0.25);
    assert_eq!(model.image_infos[0].uri.as_deref(), Some("data:"));
    let told = warnings(&model);
    assert!(told.contains("texture data:,///: ") && told.contains("`new` is ignored"), "{told}");
    let long = "x".repeat(100_000);
    let model =
        super::read(square().replace("a.mtl", &format!("data:,newmtl%20m%0A{long}%0A{long}")))
            .unwrap();
    assert!(warnings(&model).len() < 1000);
}

#[test]
fn textures_are_found_only_in_the_model_folder() {
    let folder = Folder::new("paths");
    folder.write_png("a.png", &[[1, 1, 1, 255]]);
    folder.write_png("sub/b.png", &[[2, 2, 2, 255]]);
    let outside = folder.path().with_extension("secret.png");
    std::fs::copy(folder.path().join("a.png"), &outside).unwrap();
    let secret = outside.file_name().unwrap().to_str().unwrap().to_owned();
    folder.write("a.obj", square().replace("a.mtl", "sub\\a.mtl"));
    let absolute = outside.to_str().unwrap().to_owned();
    for (name, expected) in [
        ("b.png", Some(2)),
        ("../a.png", Some(1)),
        ("sub\\b.png", Some(2)),
        ("a.png", Some(1)),
        ("C:\\Users\\me\\a.png", Some(1)),
        ("C:\\Users\\me\\gone.png", None),
        (&*absolute, None),
        (&*format!("../../{secret}"), None),
        (&*format!("..\\..\\{secret}"), None),
        ("/dev/zero", None),
        ("http://example.org/x.png", None),
    ] {
        folder.write("sub/a.mtl", format!("newmtl m\nmap_Kd {name}\n"));
        let model = folder.load("a.obj");
        let read = model.images[0].as_ref().map(|image| image.rgba[0][0]);
        assert_eq!(read, expected, "{name}");
        assert_eq!(
            warnings(&model).is_empty(),
            expected.is_some() && !name.contains("Users"),
            "{name}"
        );
    }
    // Libraries are restricted to the same sandbox.
    std::fs::write(&outside, "newmtl m\nPr 0.5\n").unwrap();
    for name in [absolute.clone(), format!("../{secret}"), format!("..\\{secret}")] {
        folder.write("a.obj", square().replace("a.mtl", &name));
        let expected = "the default material is used";
        assert!(warnings(&folder.load("a.obj")).contains(expected), "{name}");
    }
    std::fs::remove_file(outside).unwrap();
}

#[test]
fn missing_texture_coordinates_are_reported() {
    let folder = Folder::new("bare");
    folder.write_png("a.png", &[[1, 1, 1, 255]]);
    folder.write("a.mtl", "newmtl m\nmap_Kd a.png\n");
    folder.write("a.obj", format!("mtllib a.mtl\nusemtl m\n{SQUARE}f 1 2 3 4\nusemtl\nf 1 2 3\n"));
    let model = folder.load("a.obj");
    assert!(warnings(&model).contains("1 surface has textures but no texture coordinates"));
    let [textured, plain] = primitives(&model)[..] else { panic!() };
    assert_eq!((textured.material, plain.material), (Some(0), Some(1)));
    assert_eq!(model.materials[1], Material::plain());
}

#[test]
fn modified_bytes_do_not_panic() {
    let folder = Folder::new("mutants");
    folder.write_png("a.png", &[[1, 1, 1, 255]]);
    folder.write("a.obj", square());
    let text = "newmtl m\nKd 1 0.5 0\nKs 0.5 0.5 0.5\nNs 30\nd -halo 0.5\nKe 2 0 0\nPr 0.5\nPc 1\naniso 1\n\
                map_Kd -s 2 4 1 -o 0.5 -clamp on a.png\nmap_d -imfchan g a.png\nbump -bm 2 a.png\nnewmtl n\n";
    let mut state = 7_u64;
    let mut random = |below: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (state >> 33) as usize % below
    };
    for _ in 0..500 {
        let mut bytes = text.as_bytes().to_vec();
        for _ in 0..=random(4) {
            let at = random(bytes.len());
            bytes[at] = [random(256) as u8, b"0123456789-/.\\\n\r #e"[random(19)]][random(2)];
        }
        folder.write("a.mtl", &bytes);
        let model = folder.load("a.obj");
        for material in &model.materials {
            let factors = [material.roughness, material.metallic, material.emission.strength];
            assert!(factors.iter().chain(&material.base_color).all(|x| x.is_finite()));
            assert!((0.0..=1.0).contains(&material.roughness));
            assert!(material.all_textures().all(|(_, info)| info.texture < model.textures.len()));
        }
        assert!(model.textures.iter().all(|texture| texture.image.unwrap() < model.images.len()));
    }
}
