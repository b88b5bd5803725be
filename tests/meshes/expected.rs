//! The compared properties, and the files that intentionally differ from the manifest.

/// The triangles and bounds of a mesh.
#[derive(Clone, PartialEq, Debug)]
pub struct MeshFacts {
    pub triangles: usize,
    /// The minimum and maximum corners of the bounding box, or `None` if there is nothing to draw.
    pub bounds: Option<[f64; 6]>,
}

/// Files in the known folder that differ from its manifest, with the reason.
pub const DIFFERENCES: &[(&str, MeshFacts, &str)] = &[
    (
        "obj/box.obj",
        MeshFacts { triangles: 12, bounds: Some([-1.0, -1.0, -1.0, 1.0, 1.0, 1.0]) },
        "the manifest lists two files with this name, and the folder has the second",
    ),
    (
        "3mf/production_components.3mf",
        MeshFacts { triangles: 8, bounds: Some([0.0, 0.0, 0.0, 25.0, 10.0, 10.0]) },
        "objects in two parts have the same id, and the other reader shows both for each component",
    ),
];

impl MeshFacts {
    /// Compares with the properties found. Bounds must agree to the six digits of the manifest,
    /// relative to the mesh size.
    pub fn compare(&self, found: &Self) -> Result<(), String> {
        if self.triangles != found.triangles {
            return Err(format!("{} triangles instead of {}", found.triangles, self.triangles));
        }
        let agree = match (self.bounds, found.bounds) {
            (None, None) => true,
            (Some(wanted), Some(found)) => {
                let size = wanted.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
                wanted.iter().zip(found).all(|(a, b)| (a - b).abs() <= 1e-5 * size)
            }
            _ => false,
        };
        let difference = || format!("bounds {:?} instead of {:?}", found.bounds, self.bounds);
        if agree { Ok(()) } else { Err(difference()) }
    }
}
