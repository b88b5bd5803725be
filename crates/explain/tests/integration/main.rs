//! Tests of the public interface of `explain`, linked once.

mod chapter;
