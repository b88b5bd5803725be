//! The program as a process: what it prints, what it leaves on the disk, and with which code it ends.

#![allow(clippy::panic, reason = "what is missing in an answer fails the test")]

mod animate;
mod animation;
mod batch;
mod bench;
mod check;
mod document;
mod drawings;
mod explain;
mod files;
mod info;
mod matrix;
mod messages;
mod overlays;
mod parts;
mod pictures;
mod real;
mod variants;
mod vectors;
mod viewers;
