use crate::{ImportOptions, load};
#[test]
fn zz_assets() {
    let dir = std::path::Path::new("/tmp/M/obj/shared/assets/meshes");
    let manifest = std::fs::read_to_string(dir.join("MANIFEST.tsv")).unwrap();
    for line in manifest.lines().filter(|l| l.starts_with("obj/")) {
        let c: Vec<&str> = line.split('\t').collect();
        match load(&dir.join(c[0]), &ImportOptions::default()) {
            Ok(m) => {
                let t: usize =
                    m.scene_primitives()
                        .map(|(_, p)| {
                            if p.topology == crate::Topology::Triangles {
                                p.item_count()
                            } else {
                                0
                            }
                        })
                        .sum();
                let b = m.bounds().map(|b| format!("{:?}", b));
                let ok = c[2] == t.to_string();
                println!(
                    "{} {} {t} want {} | {:?} want {} | nodes {} mats {} imgs {}",
                    if ok { "ok " } else { "BAD" },
                    c[0],
                    c[2],
                    b,
                    c[3],
                    m.nodes.len(),
                    m.materials.len(),
                    m.images.len()
                );
                for w in &m.warnings {
                    println!("      {w}");
                }
            }
            Err(e) => println!("ERR {} {e} want {}", c[0], c[4]),
        }
    }
}
