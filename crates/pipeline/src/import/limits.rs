//! Bounds on everything a file can declare, so that a small file cannot demand a large amount of work.

/// The largest sizes that are accepted. What exceeds one is an error that names the field.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Limits {
    /// Bytes of any one file. Default: 512 MiB.
    pub file_bytes: u64,
    /// Levels of brackets in the JSON, at most 127. Default: 120.
    pub json_depth: usize,
    /// Values in the JSON. Default: 8 million.
    pub json_values: usize,
    /// Elements (vertices, indices, matrices) of all accessors that are read. Default: 100 million.
    pub elements: u64,
    /// Elements of all accessors that have no data in the file (zeros). Default: 2 million.
    pub zero_elements: u64,
    /// Width and height of an image. Default: 16,384.
    pub image_side: u32,
    /// Texels of all images that are decoded. Default: 256 million.
    pub image_texels: u64,
    /// Nodes. Default: 1 million.
    pub nodes: usize,
    /// Levels of the node tree. Default: 1,024.
    pub node_depth: usize,
    /// Points, lines and triangles of the shown scene, each counted as often as it is shown. Default: 200 million.
    pub scene_items: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            file_bytes: 512 << 20,
            json_depth: 120,
            json_values: 8_000_000,
            elements: 100_000_000,
            zero_elements: 2_000_000,
            image_side: 16_384,
            image_texels: 256 << 20,
            nodes: 1_000_000,
            node_depth: 1_024,
            scene_items: 200_000_000,
        }
    }
}
