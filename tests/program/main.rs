//! The program as a process: what it prints, what it leaves on the disk, and with which code it ends.

mod animation;
mod bench;
mod check;
mod document;
mod drawings;
mod files;
mod info;
mod messages;
mod pictures;
mod real;
mod variants;
mod vectors;
mod viewers;
