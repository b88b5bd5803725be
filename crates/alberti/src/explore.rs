//! `alberti explore`: the explorer in a browser, served only to this machine.
//!
//! ```text
//!  browser ─► connections ─► request ─► site: page, lesson models, the model given
//!             few at once    checked     └──► lanes: the explorer's answers
//! ```
//! The server listens on the loopback address. Other pages in the same browser can reach it too, so
//! requests from other pages are refused. Other users of the machine can also reach it, so every
//! path must begin with a token that only the printed address contains. No request names a file on
//! disk: everything that is served is in memory before the first request.

mod companions;
mod connections;
pub(crate) mod embedded;
mod lane;
mod request;
mod response;
mod site;
mod token;

use super::CliError;
use super::{print_note, print_stdout};
use site::Site;
use std::net::{Ipv4Addr, TcpListener};
use std::path::PathBuf;
use std::process::{Command, Stdio};
use token::new_token;

/// Arguments of `alberti explore`.
#[derive(Debug, clap::Args)]
pub(crate) struct ExploreArgs {
    /// Scene (.ron) or model (.gltf, .glb, .stl, .obj, .ply, .3mf) to explore
    ///
    /// The files that it refers to are served too. Without a model, the page starts with the first
    /// lesson; you can also drop files onto it.
    input: Option<PathBuf>,
    /// Port to listen on [default: a free port]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    port: Option<u16>,
    /// Open the page in the default browser
    ///
    /// The address, which contains a secret, is passed to another program as an argument, so other
    /// users of the machine may be able to see it.
    #[arg(long)]
    open: bool,
    /// Compute in this program, not in the browser (faster, identical output)
    #[arg(long)]
    native: bool,
}

/// Prints the explorer's address and serves the explorer until the program is interrupted.
///
/// # Errors
/// Returns an error if the model cannot be read or shown, or the port is in use.
pub(crate) fn run(args: &ExploreArgs) -> Result<(), CliError> {
    let token = new_token()?;
    let query = if args.native { "?native" } else { "" };
    let path = format!("{token}/{query}");
    let site = Site::prepare(args.input.as_deref(), token)?;
    let (listener, port) = listen(args.port.unwrap_or(0))?;
    let address = format!("http://127.0.0.1:{port}/{path}");
    print_stdout(format!("{address}\n").as_bytes())?;
    print_note("note: open this address in a browser; Ctrl+C stops the server");
    if args.open {
        open_browser(&address);
    }
    connections::serve(&listener, port, site)
}

/// Listens on the loopback address and returns the port; if `port` is 0, the system chooses it.
fn listen(port: u16) -> Result<(TcpListener, u16), CliError> {
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port))
        .and_then(|listener| listener.local_addr().map(|address| (listener, address.port())));
    listener.map_err(|error| {
        CliError::Usage(format!(
            "cannot listen on 127.0.0.1:{port}: {error}\n  = help: choose another --port, or omit \
             the flag to use a free one"
        ))
    })
}

/// Opens an address in the default browser; prints a note if that fails.
fn open_browser(address: &str) {
    let opener = if cfg!(target_os = "macos") {
        "open"
    } else if cfg!(windows) {
        "explorer"
    } else {
        "xdg-open"
    };
    let mut command = Command::new(opener);
    command.arg(address).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    if let Err(error) = command.spawn() {
        print_note(&format!("note: cannot run {opener} ({error}); open the address yourself"));
    }
}
