//! Long work beside a Python that goes on: other threads of it run, and Ctrl-C is heard.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

/// How often Python's signals are looked for.
const PATIENCE: Duration = Duration::from_millis(50);

/// What work and those who wait for it tell each other.
#[derive(Default)]
pub struct Signals {
    /// Becomes true when the work shall stop.
    pub cancelled: AtomicBool,
    /// How much is done.
    pub done: AtomicU64,
    /// What is being done.
    pub message: Mutex<Option<String>>,
}

/// What is told of work that goes on.
pub enum Told<'py> {
    /// Nothing.
    Nothing,
    /// `callable(done, total)`.
    Count(&'py Py<PyAny>, u64),
    /// `callable(text)`, when the text changes.
    Words(&'py Py<PyAny>),
}

/// A pool of threads: as many as asked for, or one for each processor. It is made anew each time, as one of the whole process would be
/// dead in a child that `fork` made.
///
/// # Errors
/// If there are to be none, or there can be no such many.
pub fn pool(threads: Option<usize>) -> PyResult<ThreadPool> {
    if threads == Some(0) {
        return Err(PyValueError::new_err(
            "threads is 0: give 1 or more, or None for one for each processor",
        ));
    }
    let pool = ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0)).build();
    pool.map_err(|e| PyRuntimeError::new_err(format!("no threads: {e}; give fewer with threads=")))
}

/// Does work in a pool of threads, without the interpreter's lock.
///
/// # Errors
/// `KeyboardInterrupt`, or whatever a signal's handler or the callable raises; and if the work panics.
pub fn run<T: Send>(
    py: Python<'_>,
    threads: Option<usize>,
    told: &Told<'_>,
    work: impl FnOnce(&Signals) -> T + Send,
) -> PyResult<T> {
    let pool = pool(threads)?;
    let signals = Signals::default();
    let mut raised = None;
    let outcome = py.detach(|| {
        thread::scope(|scope| {
            let (send, receive) = channel();
            let (pool, signals) = (&pool, &signals);
            scope.spawn(move || {
                let outcome = catch_unwind(AssertUnwindSafe(|| pool.install(|| work(signals))));
                // Whoever waits, waits until now.
                let _ = send.send(outcome);
            });
            loop {
                let waited = receive.recv_timeout(PATIENCE);
                if let Ok(outcome) = waited {
                    break Some(outcome);
                }
                if waited.is_err_and(|error| error == RecvTimeoutError::Disconnected) {
                    break None;
                }
                if raised.is_none()
                    && let Err(error) =
                        Python::attach(|py| py.check_signals().and_then(|()| tell(py, told, signals)))
                {
                    raised = Some(error);
                    signals.cancelled.store(true, Ordering::Relaxed);
                }
            }
        })
    });
    if let Some(error) = raised {
        return Err(error);
    }
    match outcome {
        Some(Ok(done)) => {
            tell(py, told, &signals)?;
            Ok(done)
        }
        Some(Err(panic)) => Err(fault(&*panic)),
        None => Err(fault(&"a thread ended")),
    }
}

/// Does work that is short in this thread.
///
/// # Errors
/// If it panics.
pub fn shortly<T>(work: impl FnOnce() -> T) -> PyResult<T> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|panic| fault(&*panic))
}

fn fault(panic: &(dyn Any + Send)) -> PyErr {
    let words = panic.downcast_ref::<&str>().map(|words| (*words).to_owned());
    let words = words.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_default();
    PyRuntimeError::new_err(format!(
        "a fault of kerrscope itself, please report it with what led to it: {words}"
    ))
}

fn tell(py: Python<'_>, told: &Told<'_>, signals: &Signals) -> PyResult<()> {
    match told {
        Told::Nothing => Ok(()),
        Told::Count(callable, total) => {
            callable.call1(py, (signals.done.load(Ordering::Relaxed), *total)).map(|_| ())
        }
        Told::Words(callable) => {
            let message = signals.message.lock().unwrap_or_else(PoisonError::into_inner).take();
            message.map_or(Ok(()), |message| callable.call1(py, (message,)).map(|_| ()))
        }
    }
}
