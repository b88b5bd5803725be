#![doc = include_str!("../README.md")]

mod catalogue;
pub mod demonstration;
mod depth_pane;
mod error;
pub mod exercise;
mod explorer;
mod facts;
mod lesson;
mod lesson_scene;
mod lesson_state;
mod lessons;
mod line_of_sight;
mod model_store;
mod number_text;
mod pane_picture;
mod pane_scene;
mod pick;
mod query;
mod request;
mod state_answer;
mod torn_picture;
mod triangle_survey;
mod volume_pane;
mod words;
mod world_pane;

pub use error::ExplorerError;
pub use explorer::{Answer, Explorer};
pub use words::{Language, Sentence, Words};
