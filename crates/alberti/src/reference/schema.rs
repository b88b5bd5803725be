//! The JSON Schemas (draft 2020-12) of the program's JSON output.

use clap::ValueEnum;

/// A schema, named like `schema.name` in its documents but without the prefix `alberti-`.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub(super) enum SchemaName {
    /// `alberti render --json`
    Render,
    /// `alberti info --json`
    Info,
    /// `alberti check --json`
    Check,
    /// `alberti scene check --json`
    SceneCheck,
    /// `alberti explain --json` and `alberti matrix --json`
    Explain,
    /// The table of `alberti curve depth -o FILE.json`
    DepthCurve,
    /// `alberti sheet --parts-list=FILE.json`
    PartsList,
    /// `alberti exercise --json`
    Exercise,
    /// A line of an `alberti batch` report
    BatchRecord,
    /// The lessons of `alberti explore`
    ExploreLessons,
    /// The state of a lesson in `alberti explore`
    ExploreState,
    /// A picked pixel in `alberti explore`
    ExplorePick,
    /// An error from `alberti explore`
    ExploreError,
}

impl SchemaName {
    /// Returns the schema as stored in the repository.
    pub(super) fn schema_text(self) -> &'static str {
        match self {
            Self::Render => include_str!("../../schemas/render.schema.json"),
            Self::Info => include_str!("../../schemas/info.schema.json"),
            Self::Check => include_str!("../../schemas/check.schema.json"),
            Self::SceneCheck => include_str!("../../schemas/scene-check.schema.json"),
            Self::Explain => include_str!("../../schemas/explain.schema.json"),
            Self::DepthCurve => include_str!("../../schemas/depth-curve.schema.json"),
            Self::PartsList => include_str!("../../schemas/parts-list.schema.json"),
            Self::Exercise => include_str!("../../schemas/exercise.schema.json"),
            Self::BatchRecord => include_str!("../../schemas/batch-record.schema.json"),
            Self::ExploreLessons => include_str!("../../schemas/explore-lessons.schema.json"),
            Self::ExploreState => include_str!("../../schemas/explore-state.schema.json"),
            Self::ExplorePick => include_str!("../../schemas/explore-pick.schema.json"),
            Self::ExploreError => include_str!("../../schemas/explore-error.schema.json"),
        }
    }
}
