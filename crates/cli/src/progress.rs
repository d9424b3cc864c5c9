//! A bar on the terminal, and the user's wish to stop.

use indicatif::{HumanDuration, ProgressBar, ProgressState, ProgressStyle};
use std::fmt::Write;
use std::io::IsTerminal;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

static STOPPED: AtomicBool = AtomicBool::new(false);

/// Turns Ctrl-C, and a request to terminate, into a flag that work looks at. Asked a second time, the
/// program ends at once.
pub fn stop_flag() -> &'static AtomicBool {
    // Fails only if a handler is set already: by an earlier call.
    let _ = ctrlc::set_handler(|| {
        if STOPPED.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
    });
    &STOPPED
}

/// A bar that counts rays, with their rate and the time left; nothing unless standard error is a terminal.
pub fn bar(rays: u64) -> ProgressBar {
    if !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(rays);
    let rate = |state: &ProgressState, w: &mut dyn Write| {
        let _ = write!(w, "{:.2} M rays/s", state.per_sec() / 1e6);
    };
    let left = |state: &ProgressState, w: &mut dyn Write| {
        let _ = write!(w, "{} left", HumanDuration(state.eta()));
    };
    let style = ProgressStyle::with_template("{wide_bar} {percent:>3}%  {rate}  {left}");
    if let Ok(style) = style {
        bar.set_style(style.with_key("rate", rate).with_key("left", left));
    }
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}

/// A line that says what is being done; nothing unless standard error is a terminal.
pub fn message(quiet: bool) -> ProgressBar {
    if quiet || !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new_spinner();
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}

/// A bar that counts pictures, with the time left; nothing unless standard error is a terminal.
pub fn count(pictures: u64, quiet: bool) -> ProgressBar {
    if quiet || !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(pictures);
    let left = |state: &ProgressState, w: &mut dyn Write| {
        let _ = write!(w, "{} left", HumanDuration(state.eta()));
    };
    if let Ok(style) = ProgressStyle::with_template("{wide_bar} {pos}/{len}  {left}") {
        bar.set_style(style.with_key("left", left));
    }
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}
