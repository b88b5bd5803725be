//! Vertex welding: merges equal positions into one vertex.

use std::collections::BTreeMap;

/// Finds equal positions with an open-addressing hash table.
///
/// Positions are equal if their bits are equal, after −0 has been replaced by 0; positions that are
/// merely close are not welded. Vertices are numbered in order of first appearance.
#[derive(Debug, Default)]
pub(crate) struct VertexWelder {
    /// Positions of the vertices.
    positions: Vec<[f32; 3]>,
    /// The hash table: a vertex or [`EMPTY`] in each slot. The number of slots is a power of two,
    /// and at most half of them are used.
    slots: Vec<u32>,
    /// Vertices for which all probed slots were full, by the bits of their positions.
    crowded: BTreeMap<[u32; 3], u32>,
}

/// The value of a slot without a vertex.
const EMPTY: u32 = u32::MAX;
/// Number of slots to probe before the ordered map is used. With this limit, contrived collisions
/// cost a logarithmic factor instead of quadratic time.
const PROBES: usize = 32;
/// Number of positions in a batch, whose slots are read ahead of use.
const BATCH: usize = 192;
/// Number of slots in the smallest table.
const LEAST_SLOTS: usize = 64;

impl VertexWelder {
    /// Creates a welder with space for this number of vertices before it has to grow.
    pub(crate) fn with_capacity(vertices: usize) -> Self {
        let slots = (2 * vertices).next_power_of_two().max(LEAST_SLOTS);
        Self {
            positions: Vec::with_capacity(vertices),
            slots: vec![EMPTY; slots],
            crowded: BTreeMap::new(),
        }
    }

    /// Returns the vertices at these positions, adding new vertices for new positions. There must
    /// be fewer than 2³² − 1 vertices.
    ///
    /// The slots and vertices of a batch are read before they are needed, because memory latency
    /// takes most of the time, and independent reads overlap.
    pub(crate) fn weld_all(&mut self, positions: &[[f32; 3]]) -> Vec<u32> {
        let mut vertices = Vec::with_capacity(positions.len());
        let mut hashes = [0; BATCH];
        for batch in positions.chunks(BATCH) {
            let hashes = &mut hashes[..batch.len()];
            for (hash, position) in hashes.iter_mut().zip(batch) {
                *hash = hash_bits(canonical(*position).map(f32::to_bits));
            }
            std::hint::black_box(self.read_ahead(hashes));
            let hashed = batch.iter().zip(hashes);
            vertices.extend(hashed.map(|(place, hash)| self.weld_hashed(*place, *hash)));
        }
        vertices
    }

    /// Returns the vertex at a position, adding it if necessary.
    #[cfg(test)]
    fn weld(&mut self, position: [f32; 3]) -> u32 {
        self.weld_hashed(position, hash_bits(canonical(position).map(f32::to_bits)))
    }

    /// Loads the first slot of each hash and then the vertices in these slots into the cache. The
    /// result only keeps the reads from being optimized away.
    #[inline]
    fn read_ahead(&self, hashes: &[usize]) -> u32 {
        let mask = self.slots.len().wrapping_sub(1);
        let slots = hashes.iter().filter_map(|hash| self.slots.get(hash & mask));
        let first = slots.clone().fold(0u32, |sum, slot| sum.wrapping_add(*slot));
        let vertices = slots.filter_map(|slot| self.positions.get(*slot as usize));
        vertices.fold(first, |sum, place| sum.wrapping_add(place[0].to_bits()))
    }

    /// Returns the vertex at a position with this hash, adding it if necessary.
    #[inline]
    fn weld_hashed(&mut self, position: [f32; 3], start: usize) -> u32 {
        let position = canonical(position);
        if 2 * self.positions.len() >= self.slots.len() {
            self.grow();
        }
        let key = position.map(f32::to_bits);
        let mask = self.slots.len() - 1;
        for probe in 0..PROBES {
            let slot = (start + probe) & mask;
            let vertex = self.slots[slot];
            if vertex == EMPTY {
                let vertex = self.push(position);
                self.slots[slot] = vertex;
                return vertex;
            }
            if self.positions[vertex as usize].map(f32::to_bits) == key {
                return vertex;
            }
        }
        // A file can be crafted so that all hashes collide. An ordered map keeps that case fast.
        if let Some(vertex) = self.crowded.get(&key) {
            return *vertex;
        }
        let vertex = self.push(position);
        self.crowded.insert(key, vertex);
        vertex
    }

    /// Returns the positions of the vertices in order.
    pub(crate) fn into_positions(self) -> Vec<[f32; 3]> {
        self.positions
    }

    /// Adds a vertex and returns its index.
    fn push(&mut self, position: [f32; 3]) -> u32 {
        self.positions.push(position);
        (self.positions.len() - 1) as u32
    }

    /// Doubles the table and reinserts all vertices.
    #[cold]
    fn grow(&mut self) {
        let slots = (2 * self.slots.len()).max(LEAST_SLOTS);
        self.slots.clear();
        self.slots.resize(slots, EMPTY);
        self.crowded.clear();
        for (vertex, position) in self.positions.iter().enumerate() {
            let key = position.map(f32::to_bits);
            let start = hash_bits(key);
            let mut probes = (0..PROBES).map(|probe| (start + probe) & (slots - 1));
            match probes.find(|&slot| self.slots[slot] == EMPTY) {
                Some(slot) => self.slots[slot] = vertex as u32,
                None => {
                    self.crowded.insert(key, vertex as u32);
                }
            }
        }
    }
}

/// Replaces −0 with 0 in a position; the addition leaves all other values unchanged.
#[inline]
fn canonical(position: [f32; 3]) -> [f32; 3] {
    position.map(|x| x + 0.0)
}

/// Hashes three words by multiplying by odd constants, which mixes the upper bits well.
#[inline]
fn hash_bits([x, y, z]: [u32; 3]) -> usize {
    let pair = u64::from(x) | u64::from(y) << 32;
    let mixed = (pair ^ pair >> 29).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let sum = (mixed ^ mixed >> 32 ^ u64::from(z)).wrapping_mul(0xD6E8_FEB8_6659_FD93);
    (sum >> 20) as usize & (usize::MAX >> 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_positions_and_signed_zeros_are_welded() {
        let mut welder = VertexWelder::default();
        let next = f32::from_bits(1f32.to_bits() + 1);
        let places = [[0.0, 1.0, -0.0], [-0.0, 1.0, 0.0], [0.0, next, 0.0], [0.0, 1.0, 0.0]];
        assert_eq!(places.map(|place| welder.weld(place)), [0, 0, 1, 0]);
        let positions = welder.into_positions();
        assert_eq!(positions, [[0.0, 1.0, 0.0], [0.0, next, 0.0]]);
        assert!(positions.as_flattened().iter().all(|x| x.is_sign_positive()));
    }

    #[test]
    fn growing_tables_keep_their_vertices() {
        let place = |at: u32| [at as f32, (at % 7) as f32, -(at as f32)];
        let mut welder = VertexWelder::with_capacity(1);
        for round in 0..2 {
            for at in 0..50_000 {
                assert_eq!(welder.weld(place(at)), at, "{round}");
            }
        }
        assert_eq!(welder.into_positions().len(), 50_000);
    }

    #[test]
    fn collisions_do_not_take_quadratic_time() {
        // z is chosen so that the sum before the last multiplication is the same for all positions.
        let colliding = |x: u32| {
            let pair = u64::from(x);
            let mixed = (pair ^ pair >> 29).wrapping_mul(0x9E37_79B9_7F4A_7C15);
            [x, 0, (mixed ^ mixed >> 32) as u32]
        };
        let mut welder = VertexWelder::default();
        let keys: Vec<[u32; 3]> = (0..200_000).map(colliding).collect();
        let vertices: Vec<u32> =
            keys.iter().map(|key| welder.weld(key.map(f32::from_bits))).collect();
        let again: Vec<u32> = keys.iter().map(|key| welder.weld(key.map(f32::from_bits))).collect();
        assert_eq!(vertices, again);
    }
}
