//! Saves a picture as a file of the browser's: drawn anew at any size, by the code that `render` has.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::thread;
use std::time::Duration;

use kerrscope::output::{Format, Provenance, exr, png};
use kerrscope::render::{Film, Stage, Watch, draw};
use kerrscope::scene::Scene;
use kerrscope::spacetime::Level;
use tokio::sync::mpsc::Sender;
use tokio::sync::mpsc::error::TrySendError;

use super::House;
use super::asked::{Kept, View};
use super::client::Sent;
use super::facts::{Notice, Progress};
use super::stock::Refusal;

/// How a message with a file begins; its generation and its bytes follow.
const MAGIC: [u8; 4] = *b"KSV1";

/// How often it is told how far it is.
const PATIENCE: Duration = Duration::from_millis(100);

/// Saves a view and sends it, until told to stop. Blocks.
pub fn save(house: &House, view: &View, kept: Kept, stop: &AtomicBool, send: &Sender<Sent>) {
    let generation = view.generation;
    let answer = made(house, view, kept, stop, send);
    let sent = match answer {
        Ok(file) => {
            let mut bytes = Vec::with_capacity(8 + file.len());
            bytes.extend(MAGIC);
            bytes.extend(generation.to_le_bytes());
            bytes.extend(file);
            Sent::Frame(bytes)
        }
        Err(refusal) => Sent::Text(Notice::unsaved(generation, &refusal).json()),
    };
    // Nobody may be there any more.
    let _ = send.blocking_send(sent);
}

fn made(
    house: &House,
    view: &View,
    kept: Kept,
    stop: &AtomicBool,
    send: &Sender<Sent>,
) -> Result<Vec<u8>, Refusal> {
    let scene = house.stock.scene(view, view.samples)?;
    let wrong = |message: String| Refusal::Wish(message);
    let format = match kept {
        Kept::Toml => return Ok(scene.to_toml().into_bytes()),
        Kept::Png => Format::Png,
        Kept::Exr => Format::Exr,
    };
    // One at a time for all: a large picture needs much memory.
    let Ok(_turn) = house.saving.try_acquire() else {
        return Err(wrong("another picture is being saved: wait until it is done".to_owned()));
    };
    let stage = house.pool.install(|| Stage::with_props(&scene, Level::best(), &house.props));
    let stage = stage.map_err(|e| wrong(e.to_string()))?;
    let film = draw_and_tell(house, &stage, view.generation, stop, send)?;
    house.pool.install(|| written(&scene, &film, format)).map_err(|e| wrong(e.to_string()))
}

/// Ends the thread that tells how far it is.
struct End<'a> {
    over: &'a AtomicBool,
    teller: &'a thread::Thread,
}

impl Drop for End<'_> {
    fn drop(&mut self) {
        self.over.store(true, Ordering::Relaxed);
        self.teller.unpark();
    }
}

fn draw_and_tell(
    house: &House,
    stage: &Stage,
    generation: u32,
    stop: &AtomicBool,
    send: &Sender<Sent>,
) -> Result<Film, Refusal> {
    let done = AtomicU64::new(0);
    let over = AtomicBool::new(false);
    let total = stage.rays();
    let film = thread::scope(|scope| {
        let teller = scope.spawn(|| {
            while !over.load(Ordering::Relaxed) {
                let progress = Progress { generation, done: done.load(Ordering::Relaxed), total };
                let told = send.try_send(Sent::Text(Notice::Progress(progress).json()));
                if matches!(told, Err(TrySendError::Closed(_))) {
                    stop.store(true, Ordering::Relaxed);
                }
                thread::park_timeout(PATIENCE);
            }
        });
        // However the drawing ends.
        let _end = End { over: &over, teller: teller.thread() };
        let count = |rays| {
            done.fetch_add(rays, Ordering::Relaxed);
        };
        let watch = Watch { cancelled: stop, progress: &count, checkpoint: None };
        house.pool.install(|| draw(stage, &watch))
    });
    film.map_err(|_| Refusal::Wish("saving was stopped".to_owned()))
}

/// The bytes of a file as `render` writes it.
fn written(scene: &Scene, film: &Film, format: Format) -> std::io::Result<Vec<u8>> {
    let made = Provenance::of(scene, film);
    let mut bytes = Vec::new();
    match format {
        Format::Exr => exr::encode(&mut bytes, film, &made)?,
        _ => png::encode(&mut bytes, &scene.display.picture(film), scene.display.depth, &made)?,
    }
    Ok(bytes)
}
