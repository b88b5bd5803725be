//! Elements of an OBJ file: points, lines and polygons as lists of references to vertices, and what
//! holds for them.

use model::Topology;

/// Stands for a texture coordinate or a normal that a corner does not have.
pub(super) const NONE: u32 = u32::MAX;

/// A corner of an element: indices of its position, texture coordinates and normal, from 0.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Corner {
    /// Index of the position; may be out of range until the whole file has been read.
    pub(super) position: u32,
    /// Index of the texture coordinates, or [`NONE`].
    pub(super) uv: u32,
    /// Index of the normal, or [`NONE`].
    pub(super) normal: u32,
}

/// The state that statements before an element set for it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct ElementState {
    /// Points, lines or polygons.
    pub(super) topology: Topology,
    /// The object and group, an index of [`ObjFile::groups`](super::parser::ObjFile::groups).
    pub(super) group: u32,
    /// The material, an index of
    /// [`ObjFile::material_names`](super::parser::ObjFile::material_names).
    pub(super) material: Option<u32>,
    /// The smoothing group; 0 for none.
    pub(super) smoothing: u32,
}

/// Elements in succession for which the same holds.
#[derive(Clone, Copy, Debug)]
pub(super) struct ElementRun {
    /// Index of the first element; the next run has the end.
    pub(super) first: usize,
    /// The state that holds for them.
    pub(super) state: ElementState,
}

/// All elements of a file, in its order.
#[derive(Debug, Default)]
pub(super) struct Elements {
    /// The corners of one element after the other.
    pub(super) corners: Vec<Corner>,
    /// For each element the end of its corners.
    pub(super) ends: Vec<u32>,
    /// Runs of elements.
    pub(super) runs: Vec<ElementRun>,
}

impl Elements {
    /// Makes an element of the corners that have been pushed since the last one.
    pub(super) fn finish_element(&mut self, state: ElementState) {
        if self.runs.last().is_none_or(|run| run.state != state) {
            self.runs.push(ElementRun { first: self.ends.len(), state });
        }
        self.ends.push(self.corners.len() as u32);
    }

    /// The corners of an element, as a range.
    pub(super) fn corner_range(&self, element: usize) -> std::ops::Range<usize> {
        let start = element.checked_sub(1).map_or(0, |before| self.ends[before]);
        start as usize..self.ends[element] as usize
    }

    /// Each run with the range of its elements.
    pub(super) fn runs(&self) -> impl Iterator<Item = (ElementState, std::ops::Range<usize>)> {
        let ends = self.runs.iter().skip(1).map(|run| run.first);
        let ends = ends.chain(std::iter::once(self.ends.len()));
        self.runs.iter().zip(ends).map(|(run, end)| (run.state, run.first..end))
    }
}
