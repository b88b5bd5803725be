//! Checks JPEG frame headers, and rejects chroma subsampling that the decoder does not expect.
//!
//! ```text
//!  FF C0..C2 │ length │ depth │ height │ width │ n │ n times: id, sampling factors, table
//! ```
//! Source: ITU-T T.81 (1992), §B.2.2.

/// Rejects files in which a later component is sampled more finely than the first. The decoder
/// sizes its buffers for the rows of the first component, and panics if another component needs
/// more. No camera or program is known to write such files.
///
/// Everything that looks like a frame header is checked, anywhere in the file. Entropy-coded data
/// cannot contain the marker, and it is not known which header the decoder will find in a broken
/// file.
pub(super) fn check_chroma_sampling(file: &[u8]) -> Result<(), String> {
    let headers = file.windows(2).enumerate().filter(|(_, mark)| is_frame_marker(mark));
    for (at, _) in headers {
        let Some((first, later)) =
            component_samplings(&file[at + 2..]).and_then(|all| all.split_first())
        else {
            continue;
        };
        let [across, down] = split_nibbles(first[1]);
        if later
            .iter()
            .map(|component| split_nibbles(component[1]))
            .any(|[h, v]| h > across || v > down)
        {
            return Err("the JPEG has more samples for color than for brightness; save it with a \
                        common subsampling (4:4:4, 4:2:2 or 4:2:0)"
                .to_owned());
        }
    }
    Ok(())
}

/// Returns whether a marker starts a frame: SOF0 (baseline), SOF1 (extended) or SOF2 (progressive).
fn is_frame_marker(mark: &[u8]) -> bool {
    matches!(mark, [0xFF, 0xC0..=0xC2])
}

/// Returns the components of a frame header (id, sampling factors, table) if its length matches
/// their number.
///
/// `header` starts at the length, after the marker. Bytes that merely look like a marker rarely
/// have a length that matches the number of components.
fn component_samplings(header: &[u8]) -> Option<&[[u8; 3]]> {
    let &[high, low, _, _, _, _, _, count] = header.first_chunk()?;
    let length = usize::from(u16::from_be_bytes([high, low]));
    let components = header.get(8..length)?.as_chunks().0;
    (length == 8 + 3 * usize::from(count)).then_some(components)
}

/// Returns the horizontal and vertical sampling factors.
fn split_nibbles(byte: u8) -> [u8; 2] {
    [byte >> 4, byte & 15]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame_header(samplings: &[u8]) -> Vec<u8> {
        let count = samplings.len() as u8;
        let mut bytes = vec![0xFF, 0xD8, 0xFF, 0xC2, 0, 8 + 3 * count, 8, 0, 16, 0, 16, count];
        (1..).zip(samplings).for_each(|(name, &sampling)| bytes.extend([name, sampling, 0]));
        bytes
    }

    #[test]
    fn first_component_must_have_the_finest_sampling() {
        for supported in [&[0x11][..], &[0x11; 3], &[0x22, 0x11, 0x11], &[0x21, 0x11, 0x11]] {
            assert_eq!(check_chroma_sampling(&frame_header(supported)), Ok(()), "{supported:x?}");
        }
        for unsupported in [[0x11, 0x11, 0x22], [0x21, 0x12, 0x11], [0x12, 0x11, 0x21]] {
            let message = check_chroma_sampling(&frame_header(&unsupported)).unwrap_err();
            assert!(message.starts_with("the JPEG has more samples"), "{unsupported:x?}");
        }
    }

    #[test]
    fn truncated_or_mismatched_headers_are_ignored() {
        let whole = frame_header(&[0x11, 0x11, 0x22]);
        for end in 0..whole.len() {
            assert_eq!(check_chroma_sampling(&whole[..end]), Ok(()), "truncated at {end}");
        }
        let mut longer = whole.clone();
        longer[5] += 1;
        assert_eq!(check_chroma_sampling(&longer), Ok(()));
        let message = check_chroma_sampling(&[longer, whole].concat()).unwrap_err();
        assert!(message.starts_with("the JPEG has more samples"), "both headers count");
    }
}
