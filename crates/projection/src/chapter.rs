//! The matrices P, M_orth and M_per of the textbook (Shirley and Marschner, ch. 8), with its signs
//! and names.
//!
//! Here `n` and `f` are *z coordinates*, not distances: the camera looks along −z, so 0 > n > f.
//! Near maps to +1 and far to −1. After P and M_per, a visible point has w = z < 0. For clipping,
//! use [`m_per_positive`] (PE-3), the same map with the sign of w flipped. It follows
//! [`Convention::CHAPTER`].
//!
//! ```
//! use homog::Point;
//! use projection::chapter;
//! // Exercises 8 and 9: P for n = 1 and f = 2 maps (x, y, z, 1) to (x, y, 3z − 2, z).
//! let p = chapter::p(1.0, 2.0)?;
//! let image = p.transform_point(Point::new(1.0, 2.0, 4.0));
//! assert_eq!(<[f64; 4]>::from(image), [1.0, 2.0, 10.0, 4.0]);
//! # Ok::<(), projection::ProjectionError>(())
//! ```

use crate::error::{check_finite, check_positive};
use crate::matrix::{check_representable, from_rows};
use crate::{Convention, Fov, Frustum, Orthographic, ProjectionError, Window};
use homog::{Affine, Clip, Projective, View};

/// Returns P, which preserves z on the planes z = n and z = f and divides x and y by z/n (PE-1;
/// C22, C24).
///
/// ```text
/// [ n 0  0    0  ]
/// [ 0 n  0    0  ]      (x, y, z) ↦ (n x/z, n y/z, n + f − f n/z)
/// [ 0 0 n+f  −fn ]
/// [ 0 0  1    0  ]
/// ```
///
/// # Errors
/// Returns an error if n or f is 0 or not finite, if n = f, or if they are on different sides of
/// the eye.
pub fn p(n: f64, f: f64) -> Result<Projective<View, View>, ProjectionError> {
    check_same_side(n, f)?;
    let rows =
        [[n, 0.0, 0.0, 0.0], [0.0, n, 0.0, 0.0], [0.0, 0.0, n + f, -f * n], [0.0, 0.0, 1.0, 0.0]];
    p_inverse(n, f)?;
    Ok(Projective::from_raw(check_representable(from_rows(rows), "depth range")?))
}

/// Returns the exact inverse of [`p`] (C25).
///
/// # Errors
/// See [`p`].
pub fn p_inverse(n: f64, f: f64) -> Result<Projective<View, View>, ProjectionError> {
    check_same_side(n, f)?;
    let nf = n * f;
    let rows = [
        [1.0 / n, 0.0, 0.0, 0.0],
        [0.0, 1.0 / n, 0.0, 0.0],
        [0.0, 0.0, 0.0, 1.0],
        [0.0, 0.0, -1.0 / nf, (n + f) / nf],
    ];
    Ok(Projective::from_raw(check_representable(from_rows(rows), "depth range")?))
}

/// Returns nf · P⁻¹, which contains no fractions. It is the same projective map as P⁻¹ (exercise 6,
/// M14).
///
/// # Errors
/// See [`p`].
pub fn p_inverse_scaled(n: f64, f: f64) -> Result<Projective<View, View>, ProjectionError> {
    check_same_side(n, f)?;
    let nf = n * f;
    let rows =
        [[f, 0.0, 0.0, 0.0], [0.0, f, 0.0, 0.0], [0.0, 0.0, 0.0, nf], [0.0, 0.0, -1.0, n + f]];
    Ok(Projective::from_raw(check_representable(from_rows(rows), "depth range")?))
}

fn check_same_side(n: f64, f: f64) -> Result<(), ProjectionError> {
    for (parameter, value) in [("n", n), ("f", f)] {
        if check_finite(parameter, value)? == 0.0 {
            let allowed = "nonzero, because the plane z = 0 passes through the eye";
            return Err(ProjectionError::OutOfRange { parameter, value, allowed });
        }
    }
    if n == f {
        return Err(ProjectionError::EmptyDepth { value: n });
    }
    if (n > 0.0) != (f > 0.0) {
        let allowed = "on the same side of the eye as `n`";
        return Err(ProjectionError::OutOfRange { parameter: "f", value: f, allowed });
    }
    Ok(())
}

/// Returns M_orth, which maps the box [l, r] × [b, t] × [f, n] to [−1, 1]³ (OR-1; C7, C8).
///
/// # Errors
/// Returns an error if a number is not finite, if two opposite sides coincide, or if n ≤ f.
pub fn m_orth(
    l: f64,
    r: f64,
    b: f64,
    t: f64,
    n: f64,
    f: f64,
) -> Result<Affine<View, Clip>, ProjectionError> {
    let raw = signed_box(l, r, b, t, n, f)?.view_to_clip(Convention::CHAPTER).raw();
    Affine::from_raw(raw).ok_or(ProjectionError::Unrepresentable { what: "box" })
}

/// Returns the inverse of [`m_orth`].
///
/// # Errors
/// See [`m_orth`].
pub fn m_orth_inverse(
    l: f64,
    r: f64,
    b: f64,
    t: f64,
    n: f64,
    f: f64,
) -> Result<Affine<Clip, View>, ProjectionError> {
    let raw = signed_box(l, r, b, t, n, f)?.clip_to_view(Convention::CHAPTER).raw();
    Affine::from_raw(raw).ok_or(ProjectionError::Unrepresentable { what: "box" })
}

fn signed_box(
    l: f64,
    r: f64,
    b: f64,
    t: f64,
    n: f64,
    f: f64,
) -> Result<Orthographic, ProjectionError> {
    let volume = Orthographic::new(l, r, b, t, -n, -f)?;
    if n < f {
        return Err(ProjectionError::FarNotBeyondNear { near: n, far: f });
    }
    Ok(volume)
}

/// Returns M_per = M_orth P as in the textbook, with w = z, which is negative in front of the eye
/// (PE-2; C27, C29).
///
/// # Errors
/// Returns an error if a number is not finite, if the window on z = n is empty, or if 0 > n > f
/// does not hold.
pub fn m_per(
    l: f64,
    r: f64,
    b: f64,
    t: f64,
    n: f64,
    f: f64,
) -> Result<Projective<View, Clip>, ProjectionError> {
    Ok(Projective::from_raw(-m_per_positive(l, r, b, t, n, f)?.raw()))
}

/// Returns −M_per, the same map as [`m_per`] but with w = −z, which is positive in front of the eye
/// (PE-3).
///
/// # Errors
/// See [`m_per`].
pub fn m_per_positive(
    l: f64,
    r: f64,
    b: f64,
    t: f64,
    n: f64,
    f: f64,
) -> Result<Projective<View, Clip>, ProjectionError> {
    Ok(signed_frustum(l, r, b, t, n, f)?.view_to_clip(Convention::CHAPTER))
}

/// Returns the inverse of [`m_per`].
///
/// # Errors
/// See [`m_per`].
pub fn m_per_inverse(
    l: f64,
    r: f64,
    b: f64,
    t: f64,
    n: f64,
    f: f64,
) -> Result<Projective<Clip, View>, ProjectionError> {
    let positive = signed_frustum(l, r, b, t, n, f)?.clip_to_view(Convention::CHAPTER);
    Ok(Projective::from_raw(-positive.raw()))
}

fn signed_frustum(
    l: f64,
    r: f64,
    b: f64,
    t: f64,
    n: f64,
    f: f64,
) -> Result<Frustum, ProjectionError> {
    for (parameter, value) in [("n", n), ("f", f)] {
        if check_finite(parameter, value)? >= 0.0 {
            let allowed = "below 0, because the camera looks along −z";
            return Err(ProjectionError::OutOfRange { parameter, value, allowed });
        }
    }
    Frustum::new(l, r, b, t, -n, -f)
}

/// Returns the window on z = n for a vertical field of view `theta` and an image of nx × ny square
/// pixels (FOV-1, C33): t = |n| tan(θ/2), r = t nx/ny.
///
/// # Errors
/// Returns an error if theta is not between 0 and π, if nx or ny is not positive, if n is not
/// negative, or if a number is not finite.
pub fn window_from_fov(theta: f64, nx: f64, ny: f64, n: f64) -> Result<Window, ProjectionError> {
    let aspect = check_positive("nx", nx)? / check_positive("ny", ny)?;
    let distance = -n;
    check_positive("−n", distance)?;
    let half = Fov::Vertical(theta).half_slopes(aspect)?;
    let (right, top) = (half.x * distance, half.y * distance);
    Window::new(-right, right, -top, top)
}

/// Returns the vertical field of view of the symmetric window whose top edge is at `t` on z = n: θ
/// = 2 atan(t/|n|) (FOV-1).
///
/// # Errors
/// Returns an error if t is not positive, if n is not negative, or if either is not finite.
pub fn fov_from_window(t: f64, n: f64) -> Result<f64, ProjectionError> {
    let distance = -n;
    Ok(2.0 * libm::atan2(check_positive("t", t)?, check_positive("−n", distance)?))
}
