//! A Slurm cluster in network namespaces: a controller and three nodes.

use crate::cluster::node::{Node, address};
use crate::cluster::run_command;
use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// The number of nodes.
pub const NODES: usize = 3;
/// The time without a response after which the controller gives up on a node: `SlurmdTimeout`.
const NODE_TIMEOUT: Duration = Duration::from_secs(5);
/// The time that a job waits before it restarts after losing its node: `cred_expire`.
const REQUEUE_DELAY: Duration = Duration::from_secs(5);
/// The time from the loss of a node to the restart of its job.
pub const NODE_LOSS: Duration =
    Duration::from_secs(NODE_TIMEOUT.as_secs() + REQUEUE_DELAY.as_secs());
/// The time for which a node is cut off. It is much longer than the controller waits.
pub const LINK_CUT: Duration = Duration::from_secs(20);
/// The maximum time of any wait in the test.
pub const LONGEST_WAIT: Duration = Duration::from_secs(300);

/// Returns a message that names the first missing program and its Debian package, if any.
pub fn missing_program() -> Option<String> {
    let programs = [
        ("slurmctld", "slurmctld"),
        ("slurmd", "slurmd"),
        ("sbatch", "slurm-client"),
        ("munged", "munge"),
        ("ip", "iproute2"),
        ("unshare", "util-linux"),
    ];
    let is_missing = |name: &str| Command::new(name).arg("-V").output().is_err();
    let (name, package) = programs.into_iter().find(|(name, _)| is_missing(name))?;
    Some(format!("{name} is not installed (Debian: {package})"))
}

/// The running cluster.
pub struct Cluster {
    folder: PathBuf,
    nodes: Vec<Node>,
}

impl Cluster {
    /// Starts the cluster, with its files in a folder below `folder`.
    pub fn start(folder: &Path) -> Result<Self, String> {
        let folder = folder.join("slurm");
        create_folder(&folder.join("state"))?;
        run_command(Command::new("hostname").arg("controller"))?;
        for words in [
            "link set lo up".to_owned(),
            "link add bridge type bridge".to_owned(),
            format!("address add {}/24 dev bridge", address(0)),
            "link set bridge up".to_owned(),
        ] {
            run_command(Command::new("ip").args(words.split_whitespace()))?;
        }
        start_munge(&folder)?;
        write_file(&folder.join("cgroup.conf"), "CgroupPlugin=autodetect\n")?;
        write_file(&folder.join("slurm.conf"), &configuration(&folder))?;
        let nodes = (1..=NODES).map(Node::create).collect::<Result<Vec<_>, _>>()?;
        let mut cluster = Self { folder, nodes };
        let mut controller = cluster.command("slurmctld");
        controller.args(["-D", "-c"]).stdin(Stdio::null());
        controller.stdout(Stdio::null()).stderr(Stdio::null());
        controller.spawn().map_err(|error| format!("slurmctld: {error}"))?;
        cluster.start_dead_nodes()?;
        cluster.wait_for_nodes()?;
        Ok(cluster)
    }

    /// Returns a command that runs a Slurm program on this cluster.
    pub fn command(&self, program: &str) -> Command {
        let mut command = Command::new(program);
        command.env("SLURM_CONF", self.folder.join("slurm.conf"));
        command
    }

    /// Starts the daemons that are missing on the nodes.
    pub fn start_dead_nodes(&mut self) -> Result<(), String> {
        let folder = &self.folder;
        for node in self.nodes.iter_mut().filter(|node| node.is_dead) {
            create_folder(&folder.join(format!("spool-{}", node.name)))?;
            node.start_daemon(folder)?;
        }
        Ok(())
    }

    /// Waits until all nodes are idle.
    pub fn wait_for_nodes(&self) -> Result<(), String> {
        let is_idle = || -> Result<bool, String> {
            // The controller may not be listening yet.
            let states = run_command(self.command("sinfo").args(["-h", "-N", "-o", "%T"]));
            Ok(states
                .is_ok_and(|states| states.lines().filter(|line| *line == "idle").count() == NODES))
        };
        let states = || run_command(&mut self.command("sinfo")).unwrap_or_else(|error| error);
        wait_until(is_idle).map_err(|error| {
            format!("the nodes are not idle: {error}\n{}{}", states(), self.log_end())
        })
    }

    /// Kills everything on a node; returns the number of processes.
    pub fn kill_node(&mut self, index: usize) -> Result<usize, String> {
        self.nodes[index].kill_processes()
    }

    /// Cuts a node off the network; its processes keep running.
    pub fn cut_link(&self, index: usize) -> Result<(), String> {
        run_command(Command::new("ip").args(["link", "set", &self.nodes[index].name, "down"]))
            .map(drop)
    }

    /// Reconnects a node.
    pub fn restore_link(&self, index: usize) -> Result<(), String> {
        run_command(Command::new("ip").args(["link", "set", &self.nodes[index].name, "up"]))
            .map(drop)
    }

    /// Returns whether a job is waiting or running.
    pub fn has_job(&self, job: &str) -> Result<bool, String> {
        // Slurm forgets jobs that ended long ago and reports an error for them.
        let queue = run_command(self.command("squeue").args(["-h", "-j", job, "-o", "%i"]));
        match queue {
            Ok(queue) => Ok(!queue.trim().is_empty()),
            Err(error) if error.contains("Invalid job id") => Ok(false),
            Err(error) => Err(error),
        }
    }

    /// Returns the last lines of the controller's log.
    pub fn log_end(&self) -> String {
        let mut text = String::new();
        let log = std::fs::File::open(self.folder.join("slurmctld.log"));
        let _ = log.and_then(|mut log| log.read_to_string(&mut text));
        let lines: Vec<&str> = text.lines().collect();
        lines[lines.len().saturating_sub(40)..].join("\n")
    }
}

/// Starts the daemon that signs messages, with a key for this test.
fn start_munge(folder: &Path) -> Result<(), String> {
    let key = folder.join("munge.key");
    let mut random = [0; 1024];
    let source =
        std::fs::File::open("/dev/urandom").and_then(|mut file| file.read_exact(&mut random));
    source.map_err(|error| format!("/dev/urandom: {error}"))?;
    std::fs::write(&key, random).map_err(|error| format!("{}: {error}", key.display()))?;
    run_command(Command::new("chmod").arg("400").arg(&key))?;
    let path = |name: &str, file: &str| format!("--{name}={}", folder.join(file).display());
    let mut munged = Command::new("munged");
    // The daemon rejects a socket in the temporary folder unless it is forced to accept it.
    munged.arg("--force").args([
        path("key-file", "munge.key"),
        path("socket", "munge.socket"),
        path("pid-file", "munge.pid"),
        path("log-file", "munge.log"),
        path("seed-file", "munge.seed"),
    ]);
    // The daemon keeps its inherited streams open.
    munged.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let status = munged.status().map_err(|error| format!("munged: {error}"))?;
    if status.success() { Ok(()) } else { Err(format!("munged failed ({status})")) }
}

/// Returns the configuration shared by the nodes and the controller.
fn configuration(folder: &Path) -> String {
    let mut text = format!(
        "ClusterName=test
SlurmctldHost=controller({})
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket,cred_expire={}
SlurmUser=root
SlurmdUser=root
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool-%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd-%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SchedulerType=sched/builtin
SchedulerParameters=batch_sched_delay=0,sched_interval=1
SlurmdTimeout={}
MessageTimeout=3
TCPTimeout=1
KillWait=1
ReturnToService=2
JobRequeue=1
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
MailProg=/bin/true
PartitionName=all Nodes=ALL Default=YES State=UP
",
        address(0),
        REQUEUE_DELAY.as_secs(),
        NODE_TIMEOUT.as_secs(),
        folder = folder.display(),
    );
    for number in 1..=NODES {
        text +=
            &format!("NodeName=n{number} NodeAddr={} CPUs=1 RealMemory=1000\n", address(number));
    }
    text
}

/// Waits until a condition holds.
///
/// # Errors
/// Returns an error if the wait takes too long or the condition cannot be checked.
pub fn wait_until(mut is_so: impl FnMut() -> Result<bool, String>) -> Result<(), String> {
    let start = Instant::now();
    while !is_so()? {
        if start.elapsed() > LONGEST_WAIT {
            return Err(format!("waited for {} s", LONGEST_WAIT.as_secs()));
        }
        std::thread::sleep(Duration::from_millis(100));
    }
    Ok(())
}

/// Creates a folder and its parents.
pub fn create_folder(path: &Path) -> Result<(), String> {
    std::fs::create_dir_all(path).map_err(|error| format!("{}: {error}", path.display()))
}

/// Writes a file.
pub fn write_file(path: &Path, text: &str) -> Result<(), String> {
    std::fs::write(path, text).map_err(|error| format!("{}: {error}", path.display()))
}
