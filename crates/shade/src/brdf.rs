//! The BRDF of glTF materials: a base with diffuse and GGX specular reflection, and layers on top.
//!
//! ```text
//!  clearcoat          smooth dielectric of index 1.5     KHR_materials_clearcoat
//!  sheen              fibers, Charlie distribution       KHR_materials_sheen
//!  base specular      GGX, isotropic or anisotropic,     glTF 2.0, KHR_materials_specular, _ior,
//!                     bare or under a thin film          _anisotropy, _iridescence
//!  base diffuse       Lambert                            glTF 2.0, Appendix B
//!  transmitted light  straight through, or refracted     KHR_materials_transmission, _volume,
//!                     and blurred; tinted                _ior, _dispersion
//! ```
//!
//! Each layer scales the layers below by one minus its reflectance: Fresnel reflectance for the
//! clearcoat and the base specular, and directional albedo for sheen.
//!
//! | file | term |
//! | --- | --- |
//! | `microfacet` (`ggx_lobe`) | GGX distribution (NDF), Smith masking-shadowing, Schlick Fresnel |
//! | `base` | dielectric and metal, energy compensation, specular-glossiness |
//! | `directional_albedo` | the second sum of the split-sum approximation, as a table |
//! | `anisotropy` | anisotropic GGX |
//! | `thin_film` | iridescence by interference in a thin film |
//! | `sheen` | Charlie distribution and its albedo |
//! | `clearcoat` | the clear layer |
//! | `layered` | the sum of all layers, over lights and environment |

mod anisotropy;
mod base;
mod clearcoat;
mod directional_albedo;
mod layered;
mod microfacet;
mod sheen;
mod thin_film;

pub(crate) use layered::LayeredBrdf;
