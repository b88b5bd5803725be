//! Bounds on everything a file can declare, so that a small file cannot demand a large amount of work.

/// The largest sizes that are accepted. What exceeds one is an error that names the field.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Limits {
    /// Bytes of any one file. Default: 512 MiB.
    pub file_bytes: u64,
    /// Bytes of all files together, each as often as it is read. Default: 2 GiB.
    pub total_bytes: u64,
    /// Levels of brackets in the JSON, at most 127. Default: 120.
    pub json_depth: usize,
    /// Values in the JSON, where an object counts as ten, for it takes so much room. Default: 16 million.
    pub json_values: usize,
    /// Bytes of all arrays that are made of accessors. Default: 4 GiB.
    pub array_bytes: u64,
    /// How many times larger than all files together these arrays may be, beyond the first 16 MiB: an accessor without
    /// data, or the same data used over and over, takes room that no file has paid for. Default: 64.
    pub array_growth: u64,
    /// Width and height of an image. Default: 16,384.
    pub image_side: u32,
    /// Texels of all images that are decoded. Default: 256 million.
    pub image_texels: u64,
    /// Nodes. Default: 1 million.
    pub nodes: usize,
    /// Levels of the node tree. Default: 1,024.
    pub node_depth: usize,
    /// Points, lines and triangles of the shown scene, each counted as often as it is shown; the vertices and joints of
    /// skinned meshes count as well. Default: 200 million.
    pub scene_items: u64,
}

impl Default for Limits {
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
        }
    }
}
