//! A compute node: a network namespace with a host name and a daemon.

use crate::cluster::run_command;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

/// A compute node.
pub struct Node {
    /// The name of the node.
    pub name: String,
    /// The process that keeps the namespaces alive when everything else in them dies.
    holder: Child,
    /// Whether the node's daemon was killed.
    pub is_dead: bool,
}

impl Node {
    /// Creates the namespaces of node `number` and links them to the bridge.
    pub fn create(number: usize) -> Result<Self, String> {
        let name = format!("n{number}");
        let mut holder = Command::new("unshare");
        holder.args(["--net", "--uts", "sleep", "infinity"]).stdin(Stdio::null());
        let holder = holder.spawn().map_err(|error| format!("unshare: {error}"))?;
        let node = Self { name, holder, is_dead: true };
        node.wait_for_namespaces()?;
        let (name, id) = (&node.name, node.holder.id().to_string());
        let ip =
            |words: &str| run_command(Command::new("ip").args(words.split_whitespace())).map(drop);
        ip(&format!("link add {name} type veth peer name eth0 netns {id}"))?;
        ip(&format!("link set {name} master bridge up"))?;
        let inside = format!(
            "hostname {name} && ip link set lo up && ip address add {}/24 dev eth0 && ip link set eth0 up",
            address(number)
        );
        run_command(node.command("sh").args(["-c", &inside]))?;
        Ok(node)
    }

    /// Waits until the holder has left the test's namespaces.
    fn wait_for_namespaces(&self) -> Result<(), String> {
        let own = namespace(Path::new("/proc/self"));
        for _ in 0..500 {
            let its = namespace(&self.process_folder());
            if its.is_some() && its != own {
                return Ok(());
            }
            std::thread::sleep(std::time::Duration::from_millis(10));
        }
        Err(format!("{} has no namespaces", self.name))
    }

    fn process_folder(&self) -> PathBuf {
        PathBuf::from(format!("/proc/{}", self.holder.id()))
    }

    /// Returns a command that runs a program on the node.
    fn command(&self, program: &str) -> Command {
        let mut command = Command::new("nsenter");
        let id = self.holder.id().to_string();
        // `ip netns exec` would mount another /sys, in which slurmd finds no control groups.
        command.args(["--target", &id, "--net", "--uts", program]);
        command
    }

    /// Starts the daemon; `folder` holds the configuration.
    pub fn start_daemon(&mut self, folder: &Path) -> Result<(), String> {
        let log = folder.join(format!("slurmd-{}.out", self.name));
        let log = File::create(&log).map_err(|error| format!("{}: {error}", log.display()))?;
        let mut daemon = self.command("slurmd");
        daemon.args(["-D", "-N", &self.name, "-f"]).arg(folder.join("slurm.conf"));
        daemon.stdin(Stdio::null()).stdout(Stdio::null()).stderr(log);
        daemon.spawn().map_err(|error| format!("slurmd: {error}"))?;
        self.is_dead = false;
        Ok(())
    }

    /// Kills everything on the node, as a power failure would, and returns the number of processes.
    pub fn kill_processes(&mut self) -> Result<usize, String> {
        self.is_dead = true;
        let mut count = 0;
        // Processes that start during this round are killed in the next.
        loop {
            let processes = self.processes();
            if processes.is_empty() {
                return Ok(count);
            }
            count += processes.len();
            // A process may end before it is killed.
            let _ = Command::new("kill").arg("-KILL").args(&processes).output();
            std::thread::sleep(std::time::Duration::from_millis(20));
        }
    }

    /// Returns the IDs of the node's live processes.
    pub fn processes(&self) -> Vec<String> {
        let own = namespace(&self.process_folder());
        let holder = self.holder.id().to_string();
        let entries = std::fs::read_dir("/proc").into_iter().flatten().flatten();
        let is_on_node = |entry: &std::fs::DirEntry| namespace(&entry.path()) == own;
        let ids = entries.filter(is_on_node);
        let ids = ids.map(|entry| entry.file_name().to_string_lossy().into_owned());
        ids.filter(|id| id.bytes().all(|byte| byte.is_ascii_digit()) && *id != holder).collect()
    }
}

/// Returns the address of the controller (0) or of a node.
pub fn address(number: usize) -> String {
    format!("10.99.0.{}", number + 1)
}

/// Returns the network namespace of a process, or `None` if it has ended.
fn namespace(process: &Path) -> Option<PathBuf> {
    std::fs::read_link(process.join("ns/net")).ok()
}
