//! Limits on everything a file can declare, so that a small file cannot cause a large amount of
//! work.
//!
//! A glTF file of a few hundred bytes can declare an accessor with 2³² zeros, a chain of a million
//! nodes, or a mesh that a million nodes draw. A PNG of a few kilobytes can contain a billion black
//! texels. Each of these is cheap to write and expensive to read. The defaults are far above what
//! real models need; the program has a `--max-…` flag for each limit.

/// The maximum sizes that are accepted. Exceeding one is an error that names the field.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Limits {
    /// Bytes of any one file. Default: 512 MiB.
    pub file_bytes: u64,
    /// Bytes of all files together, counted each time they are read. Default: 2 GiB.
    pub total_bytes: u64,
    /// Nesting depth of the JSON, at most 127. Default: 120.
    pub json_depth: usize,
    /// Values in the JSON; an object counts as ten because of the memory it takes. Default: 16
    /// million.
    pub json_values: usize,
    /// Bytes of all arrays that accessors are converted to. Default: 4 GiB.
    pub array_bytes: u64,
    /// Maximum size of these arrays relative to all files together, beyond the first 16 MiB.
    ///
    /// An accessor without data, or one that reuses the same data, takes memory without matching
    /// bytes in a file: a decompression bomb. Default: 64.
    pub array_growth: u64,
    /// Width and height of an image. Default: 16,384.
    pub image_side: u32,
    /// Texels of all decoded images. Default: 256 million.
    pub image_texels: u64,
    /// Nodes of the scene graph. Default: 1 million.
    pub nodes: usize,
    /// Depth of the scene graph. Default: 1,024.
    pub node_depth: usize,
    /// Points, lines and triangles in the active scene, counted for every instance. Vertices and
    /// joints of skinned meshes also count. Default: 200 million.
    pub scene_items: u64,
    /// Bytes of the arrays and images of all models in a scene, each counted once. Default: 4 GiB.
    pub scene_bytes: u64,
}

impl Default for Limits {
    /// Returns the defaults documented for each field.
    fn default() -> Self {
        Self {
            file_bytes: 512 << 20,
            total_bytes: 2 << 30,
            json_depth: 120,
            json_values: 16_000_000,
            array_bytes: 4 << 30,
            array_growth: 64,
            image_side: 16_384,
            image_texels: 256 << 20,
            nodes: 1_000_000,
            node_depth: 1_024,
            scene_items: 200_000_000,
            scene_bytes: 4 << 30,
        }
    }
}
