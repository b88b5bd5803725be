//! Accessors: where the numbers of an attribute lie, checked once so that reading them cannot fail.
//!
//! An accessor says: from this byte on, so many elements, each of so many components of such a type, one element every
//! so many bytes. All of that is the file's claim. [`Source::elements`] checks it in 64-bit arithmetic against the
//! bytes there are; nothing is allocated before that, and an accessor without bytes (zeros, by the specification) is
//! counted against a limit of its own.

use super::buffers::{Buffers, slice};
use super::elements::Elements;
use super::error::Fault;
use super::limits::Limits;
use gltf::json::Root;
use gltf::json::accessor::{Accessor, ComponentType, IndexComponentType, Type, sparse};
use gltf::json::validation::Checked;
use std::cell::Cell;

/// The file's accessors, and what reading them has cost so far.
pub(super) struct Source<'a> {
    pub(super) root: &'a Root,
    pub(super) buffers: &'a Buffers<'a>,
    pub(super) limits: &'a Limits,
    elements: Cell<u64>,
    zeros: Cell<u64>,
}

/// A run of elements in bytes: every element has at least its size, and only the last one may have less than the
/// stride.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run<'a> {
    pub(super) bytes: &'a [u8],
    pub(super) stride: usize,
}

impl<'a> Source<'a> {
    pub(super) fn new(root: &'a Root, buffers: &'a Buffers<'a>, limits: &'a Limits) -> Self {
        Self { root, buffers, limits, elements: Cell::new(0), zeros: Cell::new(0) }
    }

    /// The elements of an accessor. `user` is the pointer to the member that names it.
    pub(super) fn elements(&self, accessor: usize, user: &str) -> Result<Elements<'_>, Fault> {
        let Some(json) = self.root.accessors.get(accessor) else {
            return Err(Fault::unresolved(user, "accessor", accessor, self.root.accessors.len()));
        };
        let pointer = format!("/accessors/{accessor}");
        let (component, shape) = format(json, &pointer)?;
        self.charge(json, &pointer)?;
        let count = usize::try_from(json.count.0).unwrap_or(usize::MAX);
        let size = element_size(component, shape);
        let run = match json.buffer_view {
            None => None,
            Some(view) => {
                let user = format!("{pointer}/bufferView");
                let offset = json.byte_offset.unwrap_or_default().0;
                Some(self.run(
                    view.value(),
                    &user,
                    offset,
                    Block { pointer: &pointer, count, size },
                )?)
            }
        };
        let sparse =
            json.sparse.as_ref().map(|s| self.sparse(s, &pointer, count, size)).transpose()?;
        Ok(Elements { run, sparse, count, component, shape, normalized: json.normalized })
    }

    /// Counts what is read; see [`Limits::elements`] and [`Limits::zero_elements`].
    fn charge(&self, json: &Accessor, pointer: &str) -> Result<(), Fault> {
        let sparse = json.sparse.as_ref().map_or(0, |sparse| sparse.count.0);
        let spend = |spent: &Cell<u64>, count: u64, limit: &str, allowed: u64| {
            spent.set(spent.get().saturating_add(count));
            if spent.get() > allowed {
                let what = format!("{} elements are read up to here", spent.get());
                return Err(Fault::limit(&format!("{pointer}/count"), &what, limit, allowed));
            }
            Ok(())
        };
        let count = json.count.0.saturating_add(sparse);
        spend(&self.elements, count, "elements", self.limits.elements)?;
        let zeros = if json.buffer_view.is_none() { json.count.0 } else { 0 };
        spend(&self.zeros, zeros, "zero_elements", self.limits.zero_elements)
    }

    fn run(
        &self,
        view: usize,
        user: &str,
        offset: u64,
        block: Block<'_>,
    ) -> Result<Run<'_>, Fault> {
        let view = self.buffers.view(view, user)?;
        let stride = view.stride.unwrap_or(block.size);
        if stride < block.size && block.count > 1 {
            let problem = format!("the stride is {stride}, an element has {} bytes", block.size);
            return Err(Fault::invalid(&format!("{}/byteStride", view.pointer), problem));
        }
        let stride = stride.max(block.size);
        let gaps = (block.count as u64).saturating_sub(1).saturating_mul(stride as u64);
        let length = if block.count == 0 { 0 } else { gaps.saturating_add(block.size as u64) };
        match slice(view.bytes, offset, length) {
            Some(bytes) => Ok(Run { bytes, stride }),
            None => {
                let problem = format!(
                    "{} elements from byte {offset} on need {length} bytes, and {} has {}",
                    block.count,
                    view.pointer,
                    view.bytes.len()
                );
                Err(Fault::invalid(block.pointer, problem))
            }
        }
    }

    /// The elements that replace some of the accessor's own.
    fn sparse(
        &self,
        json: &sparse::Sparse,
        accessor: &str,
        count: usize,
        size: usize,
    ) -> Result<Sparse<'_>, Fault> {
        let replaced = usize::try_from(json.count.0).unwrap_or(usize::MAX);
        let part = |name: &str| format!("{accessor}/sparse/{name}");
        let Checked::Valid(IndexComponentType(component)) = json.indices.component_type else {
            let problem = "the component type is not one of 5121, 5123 and 5125";
            return Err(Fault::invalid(&part("indices/componentType"), problem));
        };
        let (at, user) = (part("indices"), part("indices/bufferView"));
        let block = Block { pointer: &at, count: replaced, size: component.size() };
        let (view, offset) = (json.indices.buffer_view.value(), json.indices.byte_offset.0);
        let run = self.run(view, &user, offset, block)?;
        let shape = Type::Scalar;
        let indices = Elements {
            run: Some(run),
            sparse: None,
            count: replaced,
            component,
            shape,
            normalized: false,
        };
        let indices = indices.indices();
        if let Some(&index) = indices.iter().find(|&&index| index as usize >= count) {
            let problem = format!("element {index} is to be replaced and there are {count}");
            return Err(Fault::invalid(&at, problem));
        }
        let (at, user) = (part("values"), part("values/bufferView"));
        let block = Block { pointer: &at, count: replaced, size };
        let (view, offset) = (json.values.buffer_view.value(), json.values.byte_offset.0);
        Ok(Sparse { indices, values: self.run(view, &user, offset, block)? })
    }
}

/// Elements that replace others.
#[derive(Debug)]
pub(super) struct Sparse<'a> {
    /// Which elements, each below the number of elements.
    pub(super) indices: Vec<u32>,
    /// Their new values.
    pub(super) values: Run<'a>,
}

/// What a run must hold.
#[derive(Clone, Copy)]
struct Block<'a> {
    pointer: &'a str,
    count: usize,
    size: usize,
}

fn format(json: &Accessor, pointer: &str) -> Result<(ComponentType, Type), Fault> {
    let Checked::Valid(component) = json.component_type else {
        let problem = "the component type is not one of 5120, 5121, 5122, 5123, 5125 and 5126";
        return Err(Fault::invalid(&format!("{pointer}/componentType"), problem));
    };
    let Checked::Valid(shape) = json.type_ else {
        let problem = "the type is not one of SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 and MAT4";
        return Err(Fault::invalid(&format!("{pointer}/type"), problem));
    };
    Ok((component.0, shape))
}

/// The bytes of an element. Columns of matrices begin at multiples of four (glTF 2.0 §3.6.2.4), which makes a
/// difference for small matrices of small integers.
fn element_size(component: ComponentType, shape: Type) -> usize {
    let column = |rows: usize| (rows * component.size()).next_multiple_of(4);
    match shape {
        Type::Scalar => component.size(),
        Type::Vec2 => 2 * component.size(),
        Type::Vec3 => 3 * component.size(),
        Type::Vec4 => 4 * component.size(),
        Type::Mat2 => 2 * column(2),
        Type::Mat3 => 3 * column(3),
        Type::Mat4 => 4 * column(4),
    }
}
