//! Parity with glam's builders, where they exist (C93).
//!
//! Two builders of glam 0.34 are compared only for centered windows. Its left-handed `frustum` uses
//! the sign of the right-handed offset, and its Vulkan `orthographic` does not flip the y offset.
//! Corners of off-center windows therefore do not map to corners of the canonical volume. Tests in
//! `builders` check our builders.

use super::samples::{self, distance, frustum, orthographic, perspective};
use glam::DMat4;
use glam::dcamera::{lh, rh};
use projection::{Convention, Frustum, Orthographic, Perspective, Window};
use proptest::prelude::*;

fn agree(ours: homog::Projective<homog::View, homog::Clip>, theirs: DMat4) {
    assert!(distance(ours.raw(), theirs) < 1e-12, "ours\n{}\nglam\n{theirs}", ours.raw());
}

type Six = fn(f64, f64, f64, f64, f64, f64) -> DMat4;
type Four = fn(f64, f64, f64, f64) -> DMat4;
type Three = fn(f64, f64, f64) -> DMat4;

fn by_window(f: Frustum, c: Convention, glam: Six) {
    let (w, far) = (f.window(), if f.far().is_finite() { f.far() } else { 9.0 * f.near() });
    let f = Frustum::from_window(w, f.near(), far).expect("valid");
    agree(f.view_to_clip(c), glam(w.left(), w.right(), w.bottom(), w.top(), f.near(), far));
}

fn by_box(o: Orthographic, c: Convention, glam: Six) {
    let w = o.window();
    agree(o.view_to_clip(c), glam(w.left(), w.right(), w.bottom(), w.top(), o.near(), o.far()));
}

fn centered(f: Frustum) -> Frustum {
    let w = f.window();
    let window = Window::centered(w.width(), w.height()).expect("not empty");
    Frustum::from_window(window, f.near(), f.far()).expect("valid")
}

fn centered_box(o: Orthographic) -> Orthographic {
    let w = o.window();
    let window = Window::centered(w.width(), w.height()).expect("not empty");
    Orthographic::from_window(window, o.near(), o.far()).expect("valid")
}

fn by_angle(p: Perspective, c: Convention, glam: Four) {
    if p.far().is_finite() {
        agree(p.view_to_clip(c), glam(p.fov_y(), p.aspect(), p.near(), p.far()));
    }
}

fn endless(p: Perspective, c: Convention, glam: Three) {
    let fov = projection::Fov::Vertical(p.fov_y());
    let lens = Perspective::new(fov, p.aspect(), p.near(), f64::INFINITY).expect("valid");
    agree(lens.view_to_clip(c), glam(p.fov_y(), p.aspect(), p.near()));
}

proptest! {
    #![proptest_config(samples::cases(64))]

    /// C93.
    #[test]
    fn frusta_agree_with_glam(f in frustum()) {
        by_window(f, Convention::OPENGL, rh::proj::opengl::frustum);
        by_window(f, Convention::VULKAN, rh::proj::vulkan::frustum);
        by_window(f, Convention::WEBGPU, rh::proj::directx::frustum);
        by_window(centered(f), Convention::OPENGL.left_handed(), lh::proj::opengl::frustum);
        by_window(centered(f), Convention::VULKAN.left_handed(), lh::proj::vulkan::frustum);
        by_window(centered(f), Convention::DIRECT3D, lh::proj::directx::frustum);
    }

    /// C93.
    #[test]
    fn boxes_agree_with_glam(o in orthographic()) {
        by_box(o, Convention::OPENGL, rh::proj::opengl::orthographic);
        by_box(centered_box(o), Convention::VULKAN, rh::proj::vulkan::orthographic);
        by_box(o, Convention::METAL, rh::proj::directx::orthographic);
        by_box(o, Convention::OPENGL.left_handed(), lh::proj::opengl::orthographic);
        by_box(centered_box(o), Convention::VULKAN.left_handed(), lh::proj::vulkan::orthographic);
        by_box(o, Convention::DIRECT3D, lh::proj::directx::orthographic);
    }

    /// C93, C60.
    #[test]
    fn perspectives_agree_with_glam(p in perspective()) {
        by_angle(p, Convention::OPENGL, rh::proj::opengl::perspective);
        by_angle(p, Convention::VULKAN, rh::proj::vulkan::perspective);
        by_angle(p, Convention::WEBGPU, rh::proj::directx::perspective);
        by_angle(p, Convention::DIRECT3D, lh::proj::directx::perspective);
    }

    /// C93, C30.
    #[test]
    fn infinite_and_reversed_perspectives_agree_with_glam(p in perspective()) {
        endless(p, Convention::VULKAN, rh::proj::vulkan::perspective_infinite);
        endless(p, Convention::WEBGPU, rh::proj::directx::perspective_infinite);
        endless(p, Convention::DIRECT3D, lh::proj::directx::perspective_infinite);
        endless(p, Convention::VULKAN.reversed(), rh::proj::vulkan::perspective_infinite_reverse);
        endless(p, Convention::WEBGPU.reversed(), rh::proj::directx::perspective_infinite_reverse);
        endless(
            p,
            Convention::DIRECT3D.reversed(),
            lh::proj::directx::perspective_infinite_reverse,
        );
    }
}
