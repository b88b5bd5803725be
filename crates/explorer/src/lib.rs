#![doc = include_str!("../README.md")]

mod catalogue;
mod error;
mod explorer;
mod facts;
mod lesson;
mod lesson_state;
mod lessons;
mod model_store;
mod number_text;
mod outside_view;
mod pane_picture;
mod query;
mod request;
mod scene_description;
mod state_answer;
mod triangle_survey;
mod words;

pub use error::ExplorerError;
pub use explorer::{Answer, Explorer};
