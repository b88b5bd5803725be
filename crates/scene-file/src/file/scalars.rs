//! Colors by scalar attributes of vertices in a scene file.

use crate::number::Finite;
use crate::schema::scene_struct;
use model::Colormap;

scene_struct! {
    /// Colors of a model by a scalar attribute of its vertices, in place of its materials. Surfaces
    /// without the attribute keep theirs. Values that are not finite are gray.
    pub struct ScalarsFile as "Scalars" {
        /// The name of the attribute: a custom one in glTF, such as `_TEMPERATURE`, with or without
        /// the underscore; a property of the vertices in PLY, such as `quality`.
        pub attribute: String,
        /// The colormap. Default: `Viridis`.
        pub colormap: Colormap = Colormap::Viridis,
        /// The values of the first and the last color; values beyond them have these colors too.
        /// Default: the smallest and the largest value of the model.
        pub range: Option<(Finite, Finite)> = None,
    }
}
