//! Termination signals: removes unfinished files before the program ends.

/// Makes SIGINT, SIGTERM and SIGHUP remove temporary files before they end the program.
///
/// Call it only in the program itself: inside another program, such as Python, signals are handled
/// by that program. Signals ignored at the start, as with `nohup`, stay ignored. If no thread can
/// be created to handle signals, they end the program at once.
#[cfg(unix)]
pub fn clean_up_on_signals() {
    use files::remove_partial_files;
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    let heard = [SIGHUP, SIGINT, SIGTERM].into_iter().filter(|signal| !is_ignored(*signal));
    let Ok(mut signals) = signal_hook::iterator::Signals::new(heard) else { return };
    let handle = signals.handle();
    let wait = move || {
        if let Some(signal) = signals.forever().next() {
            remove_partial_files(|| {
                // This acts as if there were no handler: the exit status reports the signal. It
                // does not return.
                let _ = signal_hook::low_level::emulate_default_handler(signal);
            });
        }
    };
    if std::thread::Builder::new().name("signals".to_owned()).spawn(wait).is_err() {
        handle.close();
    }
}

/// Does nothing: other systems have no such signals.
#[cfg(not(unix))]
pub const fn clean_up_on_signals() {}

/// Whether the process was started with a signal ignored. Only Linux reports this without changing
/// the signal's action; on other systems, no signal counts as ignored.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_some_and(|mask| mask & (1 << (signal - 1)) != 0)
}
