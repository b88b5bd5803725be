//! The program `alberti`: see the library of the same name.

use std::process::ExitCode;

fn main() -> ExitCode {
    alberti::clean_up_on_signals();
    ExitCode::from(alberti::run_program(std::env::args_os()))
}
