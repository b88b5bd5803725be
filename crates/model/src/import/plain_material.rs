//! The material of surfaces for which a file has none.

use crate::Material;

impl Material {
    /// The material of models in formats without materials: light gray, matte and double-sided.
    ///
    /// The default of glTF is a metal, which mirrors whatever is around it. Both sides are drawn,
    /// as many files in these formats have triangles of either winding.
    #[must_use]
    pub fn plain() -> Self {
        Self {
            base_color: [0.6, 0.6, 0.6, 1.0],
            metallic: 0.0,
            roughness: 0.6,
            double_sided: true,
            ..Self::default()
        }
    }
}
