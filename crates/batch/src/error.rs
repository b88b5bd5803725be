//! Errors that end a batch. Errors in individual jobs are recorded in the report instead.

use files::OutputError;

/// An error that ends a batch, such as an unreadable list or an unwritable output folder.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BatchError {
    /// A file of the batch could not be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The rest of the merged report could not be written.
    #[error(transparent)]
    Flush(#[from] std::io::Error),
    /// A list, a folder or a report is unusable, or no worker can be started; the message says why.
    #[error("{0}")]
    Unusable(String),
}
