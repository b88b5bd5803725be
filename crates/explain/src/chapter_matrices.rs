//! The matrices as printed in the textbook, with its signs and order: P, M_orth, M_per and the
//! products with M_vp and M_cam (PL-1, PE-2, OR-1).
//!
//! ```text
//!  perspective   M = M_vp M_orth P M_cam = M_vp M_per M_cam     w = z < 0 ahead of the eye
//!  parallel      M = M_vp M_orth M_cam                          w = 1
//! ```
//! Clipping needs w > 0 and uses −M_per (PE-3), the same map.

use super::Step;
use homog::{Affine, Clip, HPoint, Ndc, Projective, Screen, View, World};
use projection::{Convention, Decomposed, Window, chapter, decompose};

/// The textbook's factors of a perspective or an orthographic projection.
#[derive(Clone, Copy, Debug)]
pub(super) struct ChapterMatrices {
    /// The window on the plane z = n: l, r, b, t.
    window: Window,
    /// The z-coordinates n and f of the near and far planes.
    planes: [f64; 2],
    /// P, for a perspective projection.
    p: Option<Projective<View, View>>,
    /// M_orth.
    m_orth: Affine<View, Clip>,
    /// M_per for a perspective projection, M_orth for a parallel one.
    projection: Projective<View, Clip>,
}

impl ChapterMatrices {
    /// Returns the factors of a projection to the textbook's canonical volume; `None` for other
    /// kinds of projection, and if the far plane is at infinity.
    pub(super) fn from_projection(view_to_clip: Projective<View, Clip>) -> Option<Self> {
        let kind = decompose(view_to_clip, Convention::CHAPTER).ok()?.kind;
        let (window, n, f) = match kind {
            Decomposed::Frustum(frustum) => (frustum.window(), -frustum.near(), -frustum.far()),
            Decomposed::Orthographic(volume) => (volume.window(), -volume.near(), -volume.far()),
            _ => return None,
        };
        let [l, r, b, t] = [window.left(), window.right(), window.bottom(), window.top()];
        let m_orth = chapter::m_orth(l, r, b, t, n, f).ok()?;
        let (p, projection) = match kind {
            Decomposed::Frustum(_) => {
                (Some(chapter::p(n, f).ok()?), chapter::m_per(l, r, b, t, n, f).ok()?)
            }
            _ => (None, m_orth.into()),
        };
        Some(Self { window, planes: [n, f], p, m_orth, projection })
    }

    /// Returns the ids of the formulas for the factors.
    pub(super) const fn formula(&self) -> &'static str {
        if self.p.is_some() { "OR-1, PE-1, PE-2, PE-3" } else { "OR-1" }
    }

    /// Adds the window, the planes and the factors, each matrix with its name in the textbook.
    pub(super) fn add_factors(&self, step: &mut Step) {
        let w = self.window;
        let [n, f] = self.planes;
        step.add_item("window", "l, r, b, t", [w.left(), w.right(), w.bottom(), w.top()]);
        step.add_item("n", "n, a z-coordinate", n);
        step.add_item("f", "f, a z-coordinate", f);
        if let Some(p) = self.p {
            step.add_item("p", "P", p.rows());
        }
        step.add_item("m_orth", "M_orth", self.m_orth.rows());
        if self.p.is_some() {
            step.add_item("m_per", "M_per = M_orth P", self.projection.rows());
        }
    }

    /// Adds the products with the viewport matrix: M_vp M_orth, and M of the whole chain.
    pub(super) fn add_products(
        &self,
        step: &mut Step,
        world_to_view: Affine<World, View>,
        ndc_to_screen: Affine<Ndc, Screen>,
    ) {
        let viewport = ndc_to_screen.raw();
        let with_orth = Projective::<View, Screen>::from_raw(viewport * self.m_orth.raw());
        step.add_item("m_vp_m_orth", "M_vp M_orth", with_orth.rows());
        let whole = viewport * self.projection.raw() * world_to_view.raw();
        let whole = Projective::<World, Screen>::from_raw(whole);
        let name = if self.p.is_some() {
            "M = M_vp M_orth P M_cam = M_vp M_per M_cam"
        } else {
            "M = M_vp M_orth M_cam"
        };
        step.add_item("m", name, whole.rows());
    }

    /// Whether w is negative ahead of the eye in the textbook's matrix, as in M_per.
    pub(super) const fn turns_w(&self) -> bool {
        self.p.is_some()
    }

    /// Converts a clip-space point with w > 0 to the textbook's signs: M_per gives w = z.
    pub(super) fn page_clip(&self, clip: HPoint<Clip>) -> HPoint<Clip> {
        if self.p.is_some() { HPoint::from_raw(-clip.raw()) } else { clip }
    }
}
