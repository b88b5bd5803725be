//! The test's namespaces: separate processes, network, host name and mounts.
//!
//! The first process of the namespaces is killed with the test, and all others with the first one.
//! Network devices disappear with their namespaces, so there is nothing to clean up.

use std::path::Path;
use std::process::Command;

/// The namespaces that `unshare` creates.
const NAMESPACES: [&str; 6] = ["--net", "--uts", "--mount", "--pid", "--fork", "--mount-proc"];

/// Returns a program in new namespaces; callers append its arguments.
pub fn isolated_command(program: &Path) -> Command {
    let mut command = Command::new("setpriv");
    command.args(["--pdeathsig", "KILL", "unshare"]).args(NAMESPACES).arg("--kill-child");
    // The shell is the first process: it collects the orphans.
    command.args(["--", "sh", "-c", "\"$@\"; exit $?", "sh"]).arg(program);
    command
}

/// The cluster's network: a bridge, and pairs of devices.
const DEVICES: &str = "ip link add bridge type bridge && ip link add n type veth peer name p";

/// Says why namespaces, or a network in them, cannot be created.
pub fn missing_right() -> Option<String> {
    let output = isolated_command(Path::new("sh")).args(["-c", DEVICES]).output();
    match output {
        Ok(output) if output.status.success() => None,
        Ok(output) => {
            let said = String::from_utf8_lossy(&output.stderr);
            Some(format!("no namespaces with a network, which need root ({})", said.trim()))
        }
        Err(error) => Some(format!("setpriv of util-linux: {error}")),
    }
}
