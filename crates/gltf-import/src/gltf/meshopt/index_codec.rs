//! meshopt mode TRIANGLES: most triangles share an edge with a recent triangle and take one byte.
//!
//! ```text
//!  code  X Y    X < 15: edge X, counted back from        a ───► b     edges pushed: c b, a c
//!               the newest, and a third vertex            ▲   ╱
//!        15 Y   three vertices: Y < 14 from the          c ◄╱
//!               table, else from a byte of the data
//! ```
//!
//! After an edge, Y is 0 for a new vertex, 1 to 12 for a vertex in the vertex FIFO, 13 or 14 for
//! the last explicit index −1 or +1, and 15 for an explicit index. Each half of a table entry or
//! data byte is 0 for a new vertex, 1 to 14 for a vertex in the FIFO, and 15 for an explicit index.
//! An explicit index is a zigzag-coded difference from the last explicit index.

use super::byte_stream::{ByteStream, StreamError, decode_zigzag, push_index};

/// Decodes indices of `stride` bytes, which is 2 or 4; `count` is a multiple of three.
///
/// The last 16 bytes are the table of common codes for two vertices. The time is linear in `count`.
///
/// # Errors
/// Fails if the header or the table is invalid, a code refers to an edge or vertex that is not yet
/// decoded, or the stream has the wrong length.
pub(super) fn decode_triangles(
    stream: &[u8],
    count: usize,
    stride: usize,
) -> Result<Vec<u8>, StreamError> {
    let mut data = ByteStream::new(stream);
    match data.read_byte()? {
        0xE1 => {}
        other => return Err(StreamError::Header(other)),
    }
    let table = data.take_back(16)?;
    let is_wrong = |byte: &u8| byte >> 4 == 15 || byte & 15 == 15;
    if table.iter().any(is_wrong) || table[14..] != [0, 0] {
        return Err(StreamError::Table);
    }
    // A triangle takes at least one byte, so reject short streams before allocation.
    let codes = data.take_front(count / 3)?;
    let mut triangles = TriangleDecoder {
        data,
        next_index: 0,
        last_index: 0,
        edge_fifo: RecentFifo::default(),
        vertex_fifo: RecentFifo::default(),
    };
    let mut indices = Vec::with_capacity(count * stride);
    for &code in codes {
        for index in triangles.decode_triangle(code, table)? {
            push_index(&mut indices, index, stride);
        }
    }
    triangles.data.expect_end()?;
    Ok(indices)
}

/// The decoder state.
///
/// Encoder and decoder update both FIFOs in the same order, so that positions in them identify
/// recent edges and vertices.
struct TriangleDecoder<'a> {
    data: ByteStream<'a>,
    /// The index of the next new vertex; vertices are numbered in the order of their first use.
    next_index: u32,
    /// The last explicitly stored index, which is the base of the next delta.
    last_index: u32,
    /// The last sixteen edges.
    edge_fifo: RecentFifo<(u32, u32)>,
    /// The last sixteen vertices.
    vertex_fifo: RecentFifo<u32>,
}

impl TriangleDecoder<'_> {
    /// Decodes the triangle of one code byte.
    ///
    /// The high half of the code distinguishes a shared edge from three vertices; see the figure in
    /// the module documentation.
    fn decode_triangle(&mut self, code: u8, table: &[u8]) -> Result<[u32; 3], StreamError> {
        match (code >> 4, code & 15) {
            (15, 14) => {
                let corners = self.read_corner_codes()?;
                let first = self.next_vertex();
                self.decode_free_triangle(first, corners)
            }
            (15, 15) => {
                let corners = self.read_corner_codes()?;
                let first = self.read_explicit_index()?;
                self.decode_free_triangle(first, corners)
            }
            (15, at) => {
                let first = self.next_vertex();
                self.decode_free_triangle(first, table[usize::from(at)])
            }
            (edge, third) => self.decode_edge_triangle(edge, third),
        }
    }

    /// Reads the byte that encodes the second and third vertices. Zero restarts the numbering of
    /// new vertices.
    fn read_corner_codes(&mut self) -> Result<u8, StreamError> {
        let corners = self.data.read_byte()?;
        if corners == 0 {
            self.next_index = 0;
        }
        Ok(corners)
    }

    /// Decodes a triangle on a recent edge.
    ///
    /// The two edges that the next triangle can share are pushed; the third is already shared. A
    /// vertex from the FIFO is not pushed again.
    fn decode_edge_triangle(&mut self, edge: u8, third: u8) -> Result<[u32; 3], StreamError> {
        let (a, b) = self.edge_fifo.nth_newest(edge)?;
        let c = match third {
            0 => self.next_vertex(),
            13 => self.advance_last(u32::MAX),
            14 => self.advance_last(1),
            15 => self.read_explicit_index()?,
            known => self.vertex_fifo.nth_newest(known)?,
        };
        if !(1..13).contains(&third) {
            self.vertex_fifo.push(c);
        }
        self.edge_fifo.push((c, b));
        self.edge_fifo.push((a, c));
        Ok([a, b, c])
    }

    /// Decodes a triangle without a shared edge. The two halves of `corners` encode its second and
    /// third vertices.
    ///
    /// All three edges are pushed in the opposite direction, as in a neighboring triangle.
    fn decode_free_triangle(&mut self, a: u32, corners: u8) -> Result<[u32; 3], StreamError> {
        let (second, third) = (corners >> 4, corners & 15);
        let b = self.decode_corner(second)?;
        let c = self.decode_corner(third)?;
        self.vertex_fifo.push(a);
        for (from, vertex) in [(second, b), (third, c)] {
            if matches!(from, 0 | 15) {
                self.vertex_fifo.push(vertex);
            }
        }
        for edge in [(b, a), (c, b), (a, c)] {
            self.edge_fifo.push(edge);
        }
        Ok([a, b, c])
    }

    /// Decodes a vertex, which is new, explicit or recent.
    fn decode_corner(&mut self, from: u8) -> Result<u32, StreamError> {
        match from {
            0 => Ok(self.next_vertex()),
            15 => self.read_explicit_index(),
            known => self.vertex_fifo.nth_newest(known - 1),
        }
    }

    /// Returns a vertex that has not been used before.
    fn next_vertex(&mut self) -> u32 {
        let fresh = self.next_index;
        self.next_index = fresh.wrapping_add(1);
        fresh
    }

    /// Returns the explicit index at this difference from the last explicit index.
    fn advance_last(&mut self, difference: u32) -> u32 {
        self.last_index = self.last_index.wrapping_add(difference);
        self.last_index
    }

    /// Reads an index stored as a zigzag-coded difference from the last explicit index.
    fn read_explicit_index(&mut self) -> Result<u32, StreamError> {
        let number = self.data.read_varint()?;
        Ok(self.advance_last(decode_zigzag(number)))
    }
}

/// A FIFO of the last sixteen items in a sequence.
///
/// It is a ring buffer: `newest` is the index of the last item, and older items precede it, modulo
/// 16.
#[derive(Default)]
struct RecentFifo<T> {
    /// The items; `None` if not yet written.
    items: [Option<T>; 16],
    /// Index of the newest item.
    newest: usize,
}

impl<T: Copy> RecentFifo<T> {
    /// Adds an item, dropping the oldest.
    fn push(&mut self, item: T) {
        self.newest = (self.newest + 1) % 16;
        self.items[self.newest] = Some(item);
    }

    /// Returns the item that was pushed `steps` before the newest.
    ///
    /// # Errors
    /// Returns [`StreamError::Unwritten`] if fewer items have been pushed.
    fn nth_newest(&self, steps: u8) -> Result<T, StreamError> {
        let at = (self.newest + 16 - usize::from(steps % 16)) % 16;
        self.items[at].ok_or(StreamError::Unwritten)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A table as written by encoders, with one custom entry for two recent vertices.
    const TABLE: [u8; 16] =
        [0x00, 0x76, 0x87, 0x56, 0x67, 0x78, 0xA9, 0x86, 0x65, 0x89, 0x68, 0x98, 0x01, 0x69, 0, 0];

    fn stream(codes: &[u8], data: &[u8]) -> Vec<u8> {
        [&[0xE1], codes, data, &TABLE].concat()
    }

    fn triangles(codes: &[u8], data: &[u8]) -> Result<Vec<[u8; 3]>, StreamError> {
        let bytes = decode_triangles(&stream(codes, data), 3 * codes.len(), 4)?;
        let indices: Vec<u8> = bytes.chunks(4).map(|index| index[0]).collect();
        Ok(indices.as_chunks().0.to_vec())
    }

    #[test]
    fn every_code_is_decoded() {
        type Row<'a> = (&'a [u8], &'a [u8], &'a [[u8; 3]]);
        let table: [Row<'_>; 8] = [
            (&[0xF0], &[], &[[0, 1, 2]]),
            // Edge 0 is the newest, a c; edge 1 is the second newest, c b.
            (&[0xF0, 0x00], &[], &[[0, 1, 2], [0, 2, 3]]),
            (&[0xF0, 0x10], &[], &[[0, 1, 2], [2, 1, 3]]),
            // A recent vertex: 1 is the vertex before the newest.
            (&[0xF0, 0x01], &[], &[[0, 1, 2], [0, 2, 1]]),
            // One above the last explicit index, then one below.
            (&[0xF0, 0x0F, 0x0E, 0x0D], &[20], &[[0, 1, 2], [0, 2, 10], [0, 10, 11], [0, 11, 10]]),
            // From the table, with the newest vertex as the third corner.
            (&[0xF0, 0xFC], &[], &[[0, 1, 2], [3, 4, 2]]),
            // All vertices are explicit; then the numbering restarts.
            (&[0xFF], &[0xFF, 14, 2, 1], &[[7, 8, 7]]),
            (&[0xF0, 0xFE], &[0], &[[0, 1, 2], [0, 1, 2]]),
        ];
        for (codes, data, expected) in table {
            assert_eq!(triangles(codes, data).unwrap(), expected, "{codes:x?}");
        }
    }

    #[test]
    fn invalid_streams_are_rejected() {
        assert_eq!(triangles(&[0x00], &[]), Err(StreamError::Unwritten));
        assert_eq!(triangles(&[0xF0, 0x09], &[]), Err(StreamError::Unwritten));
        assert_eq!(triangles(&[0xFF], &[0xFF, 14]), Err(StreamError::Short));
        assert_eq!(triangles(&[0xF0], &[1]), Err(StreamError::Long(1)));
        let mut wrong = stream(&[0xF0], &[]);
        wrong[3] = 0xF1;
        assert_eq!(decode_triangles(&wrong, 3, 2), Err(StreamError::Table));
        wrong[0] = 0xE0;
        assert_eq!(decode_triangles(&wrong, 3, 2), Err(StreamError::Header(0xE0)));
        assert_eq!(decode_triangles(&stream(&[0xF0], &[]), usize::MAX, 2), Err(StreamError::Short));
        let whole = stream(&[0xF0, 0x0F, 0xFF], &[20, 0xFF, 14, 2, 1]);
        assert!(decode_triangles(&whole, 9, 2).is_ok());
        for end in 0..whole.len() {
            let cut = decode_triangles(&whole[..end], 9, 2).unwrap_err();
            assert!(matches!(cut, StreamError::Short | StreamError::Table), "at {end}: {cut}");
        }
    }
}
