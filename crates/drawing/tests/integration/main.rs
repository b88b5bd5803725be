//! Tests of the public interface of `drawing`, linked once.

mod hidden_lines;
