//! Elements of an OBJ file: points, lines and polygons as lists of vertex references with state.

use model::Topology;

/// Marks missing texture coordinates or a missing normal of a corner.
pub(super) const NONE: u32 = u32::MAX;

/// A corner of an element: the zero-based indices of its position, texture coordinates and normal.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Corner {
    /// Index of the position, which may be out of range until the whole file has been read.
    pub(super) position: u32,
    /// Index of the texture coordinates, or [`NONE`].
    pub(super) uv: u32,
    /// Index of the normal, or [`NONE`].
    pub(super) normal: u32,
}

/// The state that preceding statements set for an element.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct ElementState {
    /// Points, lines or polygons.
    pub(super) topology: Topology,
    /// The object and group, as an index into [`ObjFile::groups`](super::parser::ObjFile::groups).
    pub(super) group: u32,
    /// The material, as an index into
    /// [`ObjFile::material_names`](super::parser::ObjFile::material_names).
    pub(super) material: Option<u32>,
    /// The smoothing group, or 0 for none.
    pub(super) smoothing: u32,
}

/// Consecutive elements with the same state.
#[derive(Clone, Copy, Debug)]
pub(super) struct ElementRun {
    /// Index of the first element; the run ends where the next run begins.
    pub(super) first: usize,
    /// The state of these elements.
    pub(super) state: ElementState,
}

/// All elements of a file, in file order.
#[derive(Debug, Default)]
pub(super) struct Elements {
    /// The corners of all elements, one element after another.
    pub(super) corners: Vec<Corner>,
    /// The end of each element's corners, as an index into `corners`.
    pub(super) ends: Vec<u32>,
    /// Runs of elements with the same state.
    pub(super) runs: Vec<ElementRun>,
}

impl Elements {
    /// Creates an element from the corners pushed since the last element.
    pub(super) fn finish_element(&mut self, state: ElementState) {
        if self.runs.last().is_none_or(|run| run.state != state) {
            self.runs.push(ElementRun { first: self.ends.len(), state });
        }
        self.ends.push(self.corners.len() as u32);
    }

    /// Returns the range of an element's corners.
    pub(super) fn corner_range(&self, element: usize) -> std::ops::Range<usize> {
        let start = element.checked_sub(1).map_or(0, |before| self.ends[before]);
        start as usize..self.ends[element] as usize
    }

    /// Returns the state of each run with the range of its elements.
    pub(super) fn runs(&self) -> impl Iterator<Item = (ElementState, std::ops::Range<usize>)> {
        let ends = self.runs.iter().skip(1).map(|run| run.first);
        let ends = ends.chain(std::iter::once(self.ends.len()));
        self.runs.iter().zip(ends).map(|(run, end)| (run.state, run.first..end))
    }
}
