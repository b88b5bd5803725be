//! The viewing pipeline from a glTF model to a picture.

pub mod model;
