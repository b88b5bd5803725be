//! Watches an output folder while pictures are written to it.
//!
//! A picture that is drawn again gets a new inode, because it replaces the old file by renaming. A
//! file with the name of a picture must be complete at all times.

use std::collections::BTreeMap;
use std::os::unix::fs::DirEntryExt as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

/// Pictures by file name.
pub type Pictures = BTreeMap<String, Vec<u8>>;

/// The observations.
pub struct Seen {
    /// The number of times each picture was drawn.
    pub draws: BTreeMap<String, usize>,
    /// Files that should not have existed.
    pub faults: Vec<String>,
}

/// A thread that watches a folder.
pub struct Watcher {
    thread: JoinHandle<Seen>,
    count: Arc<AtomicUsize>,
    is_over: Arc<AtomicBool>,
}

impl Watcher {
    /// Watches a folder for pictures.
    pub fn start(folder: &Path, expected: Pictures) -> Self {
        let (count, is_over) = (Arc::new(AtomicUsize::new(0)), Arc::new(AtomicBool::new(false)));
        let mut watch = FolderWatch {
            folder: folder.to_owned(),
            expected,
            inodes: BTreeMap::new(),
            seen: Seen { draws: BTreeMap::new(), faults: Vec::new() },
        };
        let (counted, ended) = (Arc::clone(&count), Arc::clone(&is_over));
        let thread = std::thread::spawn(move || {
            while !ended.load(Ordering::Relaxed) {
                watch.look();
                counted.store(watch.inodes.len(), Ordering::Relaxed);
                std::thread::sleep(Duration::from_millis(5));
            }
            watch.look();
            watch.seen
        });
        Self { thread, count, is_over }
    }

    /// Returns the number of pictures.
    pub fn count(&self) -> usize {
        self.count.load(Ordering::Relaxed)
    }

    /// Stops watching and returns the observations.
    pub fn stop(self) -> Result<Seen, String> {
        self.is_over.store(true, Ordering::Relaxed);
        self.thread.join().map_err(|_| "the watcher panicked".to_owned())
    }
}

/// The state of the watching thread.
struct FolderWatch {
    folder: PathBuf,
    expected: Pictures,
    /// The inodes of the pictures when they were last seen.
    inodes: BTreeMap<String, u64>,
    seen: Seen,
}

impl FolderWatch {
    /// Scans the folder once. The folder may be missing until the run begins.
    fn look(&mut self) {
        for entry in std::fs::read_dir(&self.folder).into_iter().flatten().flatten() {
            let name = entry.file_name().to_string_lossy().into_owned();
            if !name.ends_with(".png") || self.inodes.get(&name) == Some(&entry.ino()) {
                continue;
            }
            self.inodes.insert(name.clone(), entry.ino());
            *self.seen.draws.entry(name.clone()).or_default() += 1;
            let content = std::fs::read(entry.path()).unwrap_or_default();
            match self.expected.get(&name) {
                Some(expected) if *expected == content => {}
                Some(expected) => self.seen.faults.push(format!(
                    "{name} had {} bytes that differ from the {} of the picture",
                    content.len(),
                    expected.len()
                )),
                None => self.seen.faults.push(format!("{name} is not a picture in the list")),
            }
        }
    }
}
