//! The test's namespaces: separate processes, network, host name and mounts.
//!
//! The first process in the namespaces is killed with the test, and all others with the first.
//! Network devices disappear with their namespaces, so there is nothing to clean up.

use std::path::Path;
use std::process::Command;

/// The namespaces that `unshare` creates.
const NAMESPACES: [&str; 6] = ["--net", "--uts", "--mount", "--pid", "--fork", "--mount-proc"];

/// Returns a command that runs a program in new namespaces; callers append its arguments.
pub fn isolated_command(program: &Path) -> Command {
    let mut command = Command::new("setpriv");
    command.args(["--pdeathsig", "KILL", "unshare"]).args(NAMESPACES).arg("--kill-child");
    // The shell is the first process and reaps orphans.
    command.args(["--", "sh", "-c", "\"$@\"; exit $?", "sh"]).arg(program);
    command
}

/// The cluster's network: a bridge, and pairs of devices.
const DEVICES: &str = "ip link add bridge type bridge && ip link add n type veth peer name p";

/// Returns the reason why namespaces with a network cannot be created, or `None` if they can.
pub fn missing_right() -> Option<String> {
    let output = isolated_command(Path::new("sh")).args(["-c", DEVICES]).output();
    match output {
        Ok(output) if output.status.success() => None,
        Ok(output) => {
            let said = String::from_utf8_lossy(&output.stderr);
            Some(format!("namespaces with a network need root ({})", said.trim()))
        }
        Err(error) => Some(format!("setpriv of util-linux: {error}")),
    }
}
