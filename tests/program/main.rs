//! The program as a process: what it prints, what it leaves on the disk, and with which code it ends.

#![allow(clippy::panic, reason = "what is missing in an answer fails the test")]

mod animate;
mod animation;
mod batch;
mod bench;
mod check;
mod compare;
mod curve;
mod document;
mod drawings;
mod examples;
mod explain;
mod files;
mod info;
mod leaks;
mod light;
mod manual;
mod matrix;
mod messages;
mod mistakes;
mod outputs;
mod overlays;
mod parts;
mod pictures;
mod real;
mod reference;
mod scene;
mod sections;
mod sweep;
mod variants;
mod vectors;
mod viewers;
mod views;
