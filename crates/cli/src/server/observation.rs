//! An observation: a picture that a client sends is measured and fitted, and told of as it goes on.
//!
//! One socket takes one picture, so that its large message is let in nowhere else, and closing it ends the work. One picture
//! at a time is worked on, whoever sends it: decoded it may take half a gigabyte.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::Mutex;
use std::sync::PoisonError;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use axum::extract::ws::{Message, WebSocket};
use kerrscope::display::Picture as Shown;
use kerrscope::display::srgb;
use kerrscope::measure::{Features, Picture};
use kerrscope_fit::fit::{Image, Interim};
use kerrscope_fit::models::{Choice, Name};
use kerrscope_fit::summary::Estimate;
use kerrscope_fit::task::{Report, Task, TaskError, Watch};
use serde::Serialize;
use tokio::sync::mpsc::{self, Sender};
use tokio::time::timeout;

use super::House;
use super::client::Sent;
use super::frame::{self, Label};

/// The largest file, in bytes.
pub const LARGEST: usize = 32 << 20;

/// How long a client may take to send it, and for each message.
const PATIENCE: Duration = Duration::from_secs(30);

/// Pixels along the longer edge of what is shown of a picture.
const LONGEST: usize = 1024;

/// Rounds of draws at most, as `kerrscope fit` has them.
const ROUNDS: u64 = 30;

/// What is told.
#[derive(Debug, Serialize)]
#[serde(tag = "kind", content = "content", rename_all = "kebab-case")]
enum Told<'a> {
    /// What is measured; places in pixels from the middle of a picture of this size.
    Measured { size: [usize; 2], features: &'a Features },
    /// What is being done.
    Fitting { text: &'a str },
    /// What is known of the parameters by then.
    Estimated { parameters: &'a [Estimate] },
    /// The fit.
    Fitted { report: &'a Report<'a> },
    /// Why it ends.
    Fault { text: &'a str },
}

impl Told<'_> {
    fn send(&self, to: &Sender<Sent>) {
        let text = serde_json::to_string(self).unwrap_or_default();
        // Nobody may be there any more; then the work is stopped.
        let _ = to.blocking_send(Sent::Text(text));
    }
}

/// Which picture a frame is.
#[derive(Clone, Copy)]
enum Which {
    Observed = 0,
    Model = 1,
    Residual = 2,
}

/// Takes a picture from a client, and works on it until the client leaves.
pub async fn serve(mut socket: WebSocket, house: Arc<House>, model: Option<Name>) {
    let (send, mut told) = mpsc::channel(4);
    let Ok(Some(Ok(Message::Binary(bytes)))) = timeout(PATIENCE, socket.recv()).await else { return };
    let stop = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&stop);
    tokio::task::spawn_blocking(move || {
        let work = AssertUnwindSafe(|| observe(&house, &bytes, model, &flag, &send));
        let outcome = catch_unwind(work)
            .unwrap_or_else(|_| Err("a fault of kerrscope itself, please report it".to_owned()));
        if let Err(text) = outcome {
            Told::Fault { text: &text }.send(&send);
        }
    });
    loop {
        let message = tokio::select! {
            told = told.recv() => match told {
                Some(Sent::Text(text)) => Message::Text(text.into()),
                Some(Sent::Frame(bytes)) => Message::Binary(bytes.into()),
                None => break,
            },
            message = socket.recv() => match message {
                Some(Ok(Message::Ping(_) | Message::Pong(_))) => continue,
                // There is nothing more to say.
                _ => break,
            },
        };
        if !matches!(timeout(PATIENCE, socket.send(message)).await, Ok(Ok(()))) {
            break;
        }
    }
    stop.store(true, Ordering::Relaxed);
    let _ = timeout(PATIENCE, socket.send(Message::Close(None))).await;
}

fn observe(
    house: &House,
    bytes: &[u8],
    model: Option<Name>,
    stop: &AtomicBool,
    send: &Sender<Sent>,
) -> Result<(), String> {
    let Ok(_turn) = house.observing.try_acquire() else {
        return Err("another picture is being fitted: close its page, or wait".to_owned());
    };
    let begin = Instant::now();
    let picture = Picture::decode(bytes).map_err(|fault| format!("{fault}; {}", fault.mend()))?;
    let size = [picture.width, picture.height];
    let bright = brightest(&picture.values);
    show(send, Which::Observed, size, |pixel| grey(picture.values[pixel] / bright));
    let features = house.pool.install(|| Features::of(&picture));
    Told::Measured { size, features: &features }.send(send);
    // A tone curve may have been at work: edges hold, brightness may not.
    let usual = if picture.trusted_brightness { Name::PageThorne } else { Name::Silhouette };
    let name = model.unwrap_or(usual);
    let task =
        Task { choice: Choice { name, ..Choice::default() }, seed: 1, rounds: ROUNDS, ..Task::default() };
    let image = Image { size, pixel: picture.pixel.microarcseconds, values: picture.values };
    let ready = task.with(image).map_err(|error| match error {
        TaskError::Asked(faults) => faults.join("; "),
        TaskError::Picture(error) => error.to_string(),
    })?;
    let last = Mutex::new(None::<Instant>);
    let progress = |text: &str| {
        let mut last = last.lock().unwrap_or_else(PoisonError::into_inner);
        if last.is_none_or(|last| last.elapsed() > Duration::from_millis(150)) {
            *last = Some(Instant::now());
            Told::Fitting { text }.send(send);
        }
    };
    let cancelled = || stop.load(Ordering::Relaxed);
    let image = ready.image();
    let bright = brightest(&image.values);
    let interim = |known: Interim<'_>| match known {
        Interim::Best(values) if values.len() == image.values.len() => {
            show(send, Which::Model, image.size, |pixel| grey(values[pixel] / bright));
        }
        Interim::Best(_) => {}
        Interim::Estimates(parameters) => Told::Estimated { parameters }.send(send),
    };
    let watch = Watch { progress: &progress, interim: Some(&interim), cancelled: &cancelled, keeper: None };
    let found = house.pool.install(|| ready.run(&watch)).map_err(|error| error.to_string())?;
    let best = &found.fit.best.values;
    if best.len() == image.values.len() {
        show(send, Which::Model, image.size, |pixel| grey(best[pixel] / bright));
        show(send, Which::Residual, image.size, |pixel| {
            let deviation =
                (image.values[pixel] - best[pixel]) / found.fit.errors.get(pixel).copied().unwrap_or(bright);
            // Red where there is more light than the model has, blue where there is less; full at 5 standard deviations.
            let strength = (deviation / 5.0).clamp(-1.0, 1.0) as f32;
            [strength.max(0.0), 0.25 * strength.abs(), (-strength).max(0.0)]
        });
    }
    let report = Report::of(ready.task(), &found, None, begin.elapsed().as_secs_f64());
    Told::Fitted { report: &report }.send(send);
    Ok(())
}

/// The brightest of some values, or 1 if none is above 0.
fn brightest(values: &[f64]) -> f64 {
    let most = values.iter().copied().fold(0.0, f64::max);
    if most > 0.0 { most } else { 1.0 }
}

fn grey(light: f64) -> [f32; 3] {
    [srgb::encode(light.clamp(0.0, 1.0)) as f32; 3]
}

/// Sends a picture, of a large one only some of the pixels.
fn show(send: &Sender<Sent>, which: Which, [width, height]: [usize; 2], color: impl Fn(usize) -> [f32; 3]) {
    let step = width.max(height).div_ceil(LONGEST).max(1);
    let [columns, rows] = [width.div_ceil(step), height.div_ceil(step)];
    let places = (0..rows).flat_map(|y| (0..columns).map(move |x| y * step * width + x * step));
    let picture = Shown { width: columns as u32, height: rows as u32, pixels: places.map(color).collect() };
    let label = Label {
        generation: which as u32,
        wanted: [width as u32, height as u32],
        samples: 1,
        last: true,
        milliseconds: 0.0,
        rate: 0.0,
        error: f64::NAN,
        given_up: 0,
    };
    let _ = send.blocking_send(Sent::Frame(frame::encode(&picture, &label)));
}
