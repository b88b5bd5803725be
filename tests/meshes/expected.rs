//! What is found in a file, and the files that differ from the manifest for a reason.

/// Triangles and bounds of a mesh.
#[derive(Clone, PartialEq, Debug)]
pub struct MeshFacts {
    pub triangles: usize,
    /// Least and greatest corner of the bounding box; `None` without anything to draw.
    pub bounds: Option<[f64; 6]>,
}

/// What a file that differs from the manifest must be.
pub enum Outcome {
    /// A mesh.
    Mesh(MeshFacts),
    /// An error with this part.
    Refused(&'static str),
}

/// Files of the known folder that differ from its manifest, and why.
pub const DIFFERENCES: &[(&str, Outcome, &str)] = &[
    (
        "obj/box.obj",
        Outcome::Mesh(MeshFacts { triangles: 12, bounds: Some([-1.0, -1.0, -1.0, 1.0, 1.0, 1.0]) }),
        "the manifest lists two files of this name, and the folder has the second",
    ),
    (
        "3mf/production_components.3mf",
        Outcome::Mesh(MeshFacts { triangles: 8, bounds: Some([0.0, 0.0, 0.0, 25.0, 10.0, 10.0]) }),
        "objects of two parts have the same id; the other reader shows both at each component",
    ),
];

impl MeshFacts {
    /// Compares with what was found; bounds agree in the six digits of the manifest, relative to
    /// the size of the mesh.
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

impl Outcome {
    /// Compares with what was found, or the error; `reason` is that of the difference.
    pub fn compare(&self, found: &Result<MeshFacts, String>, reason: &str) -> Result<(), String> {
        match (self, found) {
            (Self::Mesh(wanted), Ok(found)) => {
                wanted.compare(found).map_err(|error| format!("{error} ({reason})"))
            }
            (Self::Refused(part), Err(error)) if error.contains(part) => Ok(()),
            (_, found) => Err(format!("{found:?} ({reason})")),
        }
    }
}
