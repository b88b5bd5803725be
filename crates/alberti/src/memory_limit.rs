//! Memory limits: the importer's, derived from a total, and the system's.

use import::Limits;

/// Returns the importer's limits for a program with this much memory.
///
/// | part | purpose |
/// | --- | --- |
/// | 1/4 | files, as stored |
/// | 1/2 | arrays: vertices, indices, contents of 3MF archives |
/// | 1/3 | texels of 4 bytes; their mip levels need a third as much in addition (1/9) |
///
/// The limits on nodes, JSON values and triangles follow from their maximum sizes: 2,048, 256 and
/// 64 bytes each. The parts add up to more than the total, because no model needs the maximum of
/// everything; the system stops a model that was crafted to do so.
pub(crate) fn import_limits(usual: &Limits, memory: u64) -> Limits {
    let count = |usual: usize, bytes: u64| {
        usize::try_from(memory / bytes).map_or(usual, |most| usual.min(most))
    };
    Limits {
        file_bytes: usual.file_bytes.min(memory / 4),
        total_bytes: usual.total_bytes.min(memory / 4),
        array_bytes: usual.array_bytes.min(memory / 2),
        image_texels: usual.image_texels.min(memory / 12),
        json_values: count(usual.json_values, 256),
        nodes: count(usual.nodes, 2_048),
        scene_items: usual.scene_items.min(memory / 64),
        scene_bytes: usual.scene_bytes.min(memory / 2),
        ..usual.clone()
    }
}

/// Limits the process to this much private memory (heap and stacks, not the program itself); a
/// larger allocation aborts.
#[cfg(target_os = "linux")]
pub(crate) fn limit_process_memory(memory: u64) {
    use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};
    let maximum = getrlimit(Resource::Data).maximum;
    let current = Some(maximum.map_or(memory, |most| most.min(memory)));
    // If the system forbids this, the importer's limits still apply.
    let _ = setrlimit(Resource::Data, Rlimit { current, maximum });
}

/// Does nothing: other systems have no such limit, so the importer's limits must suffice.
#[cfg(not(target_os = "linux"))]
pub(crate) fn limit_process_memory(_memory: u64) {}

/// Parses a memory limit, which must leave enough memory for the program itself.
///
/// # Errors
/// Returns an error if the text is not a size, or if the size is less than 64 MiB.
pub(crate) fn parse_memory_size(text: &str) -> Result<u64, String> {
    let size = crate::load_options::parse_byte_size(text)?;
    if size >= 64 << 20 { Ok(size) } else { Err("the program needs at least 64MiB".to_owned()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_shrink_with_the_memory_and_never_exceed_the_defaults() {
        let usual = Limits::default();
        assert_eq!(import_limits(&usual, u64::MAX), usual);
        let small = import_limits(&usual, 64 << 20);
        assert_eq!((small.file_bytes, small.array_bytes), (16 << 20, 32 << 20));
        assert_eq!((small.json_values, small.nodes), (1 << 18, 1 << 15));
        assert_eq!(small.image_side, usual.image_side);
        assert!(small.total_bytes + small.array_bytes < 64 << 20);
    }
}
