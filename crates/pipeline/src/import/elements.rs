//! Reading elements into arrays of plain numbers.
//!
//! Tightly packed floats, by far the most common case, become one loop over words that the compiler turns into a copy;
//! the other types and strides go element by element, with the type decided outside of the loop.

use super::accessor::{Run, Sparse};
use gltf::json::accessor::{ComponentType, Type};

/// The elements of one accessor, whose bytes are known to be there.
#[derive(Debug)]
pub(super) struct Elements<'a> {
    /// The elements' bytes; `None` for zeros.
    pub(super) run: Option<Run<'a>>,
    pub(super) sparse: Option<Sparse<'a>>,
    pub(super) count: usize,
    pub(super) component: ComponentType,
    pub(super) shape: Type,
    pub(super) normalized: bool,
}

impl Elements<'_> {
    /// The first `N` components of every element as floats. Normalised integers become numbers in [0, 1] or [−1, 1]
    /// (glTF 2.0 §3.11), other integers keep their value.
    pub(super) fn floats<const N: usize>(&self) -> Vec<[f32; N]> {
        use ComponentType::{F32, I8, I16, U8, U16, U32};
        match (self.component, self.normalized) {
            (F32, _) => self.read(|x: f32| x),
            (I8, true) => self.read(|x: i8| (f32::from(x) / 127.0).max(-1.0)),
            (U8, true) => self.read(|x: u8| f32::from(x) / 255.0),
            (I16, true) => self.read(|x: i16| (f32::from(x) / 32_767.0).max(-1.0)),
            (U16, true) => self.read(|x: u16| f32::from(x) / 65_535.0),
            (I8, false) => self.read(|x: i8| f32::from(x)),
            (U8, false) => self.read(|x: u8| f32::from(x)),
            (I16, false) => self.read(|x: i16| f32::from(x)),
            (U16, false) => self.read(|x: u16| f32::from(x)),
            (U32, _) => self.read(|x: u32| x as f32),
        }
    }

    /// The first `N` components of every element, of unsigned bytes or shorts; others saturate.
    pub(super) fn shorts<const N: usize>(&self) -> Vec<[u16; N]> {
        match self.component {
            ComponentType::U8 => self.read(|x: u8| u16::from(x)),
            ComponentType::U16 => self.read(|x: u16| x),
            _ => self.floats::<N>().into_iter().map(|v| v.map(|x| x as u16)).collect(),
        }
    }

    /// The elements as indices. They must be unsigned; others saturate.
    pub(super) fn indices(&self) -> Vec<u32> {
        let words: Vec<[u32; 1]> = match self.component {
            ComponentType::U8 => self.read(|x: u8| u32::from(x)),
            ComponentType::U16 => self.read(|x: u16| u32::from(x)),
            ComponentType::U32 => self.read(|x: u32| x),
            _ => self.floats::<1>().into_iter().map(|v| v.map(|x| x as u32)).collect(),
        };
        // Arrays of one are laid out as their element: this collects in place.
        words.into_iter().map(|[word]| word).collect()
    }

    fn read<const N: usize, C: Component, T: Copy + Default>(
        &self,
        convert: impl Fn(C) -> T,
    ) -> Vec<[T; N]> {
        let mut elements = vec![[T::default(); N]; self.count];
        match self.run {
            Some(run) if run.stride == N * size_of::<C>() => {
                for (to, word) in elements.as_flattened_mut().iter_mut().zip(C::words(run.bytes)) {
                    *to = convert(C::read(word));
                }
            }
            Some(run) => {
                for (to, from) in elements.iter_mut().zip(run.bytes.chunks(run.stride)) {
                    copy(to, from, &convert);
                }
            }
            None => {}
        }
        if let Some(sparse) = &self.sparse {
            let values = sparse.values.bytes.chunks(sparse.values.stride);
            for (&index, from) in sparse.indices.iter().zip(values) {
                copy(&mut elements[index as usize], from, &convert);
            }
        }
        elements
    }
}

fn copy<const N: usize, C: Component, T>(to: &mut [T; N], from: &[u8], convert: impl Fn(C) -> T) {
    for (to, word) in to.iter_mut().zip(C::words(from)) {
        *to = convert(C::read(word));
    }
}

/// A number as it lies in a buffer, little-endian.
trait Component: Copy {
    /// The number's bytes.
    type Word: Copy;
    /// The words of a run of bytes; a rest that is no word is left out.
    fn words(bytes: &[u8]) -> &[Self::Word];
    /// The number.
    fn read(word: &Self::Word) -> Self;
}

macro_rules! component {
    ($($number:ty)*) => {$(
        impl Component for $number {
            type Word = [u8; size_of::<$number>()];
            fn words(bytes: &[u8]) -> &[Self::Word] {
                bytes.as_chunks().0
            }
            fn read(word: &Self::Word) -> Self {
                Self::from_le_bytes(*word)
            }
        }
    )*};
}

component!(i8 u8 i16 u16 u32 f32);
