//! Colors from scalar vertex attributes in a scene file.

use crate::number::Finite;
use crate::schema::scene_struct;
use model::Colormap;

scene_struct! {
    /// Colors of a model from a scalar attribute of its vertices, instead of its materials.
    /// Surfaces without the attribute keep their materials. Values that are not finite are gray.
    pub struct ScalarsFile as "Scalars" {
        /// The name of the attribute: a custom one in glTF, such as `_TEMPERATURE`, with or without
        /// the underscore; a vertex property in PLY, such as `quality`.
        pub attribute: String,
        /// The colormap. Default: `Viridis`.
        pub colormap: Colormap = Colormap::Viridis,
        /// The values of the first and last color; values outside this range get the color of its
        /// nearer end. Default: the smallest and the largest value of the model.
        pub range: Option<(Finite, Finite)> = None,
    }
}
