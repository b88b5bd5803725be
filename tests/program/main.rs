//! The program as a process: what it prints, what it leaves on the disk, and with which code it ends.

mod bench;
mod files;
mod info;
mod messages;
mod pictures;
