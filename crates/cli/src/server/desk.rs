//! Where a client's wishes lie until its painter takes them. Of several the last counts.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Condvar, Mutex, PoisonError};

use super::asked::View;

/// Between a client and its painter.
#[derive(Debug, Default)]
pub struct Desk {
    tray: Mutex<Tray>,
    bell: Condvar,
    /// Whether there is something newer than what was taken last.
    newer: AtomicBool,
    closed: AtomicBool,
}

#[derive(Debug, Default)]
struct Tray {
    view: Option<View>,
}

impl Desk {
    /// Puts a wish down, in place of one that was not taken.
    pub fn put(&self, view: View) {
        let mut tray = self.tray.lock().unwrap_or_else(PoisonError::into_inner);
        tray.view = Some(view);
        self.newer.store(true, Ordering::Relaxed);
        self.bell.notify_one();
    }

    /// Ends the work.
    pub fn close(&self) {
        let _tray = self.tray.lock().unwrap_or_else(PoisonError::into_inner);
        self.closed.store(true, Ordering::Relaxed);
        self.newer.store(true, Ordering::Relaxed);
        self.bell.notify_one();
    }

    /// Waits for a wish; none once the desk is closed.
    pub fn take(&self) -> Option<View> {
        let mut tray = self.tray.lock().unwrap_or_else(PoisonError::into_inner);
        loop {
            if self.is_closed() {
                return None;
            }
            if let Some(view) = tray.view.take() {
                self.newer.store(false, Ordering::Relaxed);
                return Some(view);
            }
            tray = self.bell.wait(tray).unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Whether what was taken last is out of date.
    pub fn has_newer(&self) -> bool {
        self.newer.load(Ordering::Relaxed)
    }

    /// Whether nobody waits for anything.
    pub fn is_closed(&self) -> bool {
        self.closed.load(Ordering::Relaxed)
    }
}
