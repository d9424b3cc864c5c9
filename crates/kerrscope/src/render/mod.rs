//! Rendering: every pixel's rays, in parallel, the same for any number of threads.

mod adaptive;
mod continuum;
mod film;
mod layer;
mod legs;
mod probe;
mod props;
mod sampling;
mod setting;
mod stage;
mod tally;
mod tile;
mod tracer;

pub use continuum::continuum;
pub use film::{Film, Plane};
pub use layer::{Channel, Layer, ORDERS};
pub use props::Props;
pub use sampling::Sampler;
pub use setting::world;
pub use stage::{Replay, Stage, StageError};
pub use tally::{Interpolation, Tally};
pub use tracer::{hole_tracer, obstacle_tracer, tracer};

use crate::checkpoint::Checkpoint;
use crate::output::FileError;
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use tile::{Tile, Tiling};

/// What goes on beside the drawing of a picture.
#[derive(Clone, Copy)]
pub struct Watch<'a> {
    /// Becomes true when the render shall stop.
    pub cancelled: &'a AtomicBool,
    /// Is told of each batch of rays that is done, from any thread.
    pub progress: &'a (dyn Fn(u64) + Sync),
    /// Where finished tiles are kept, and those of an earlier try are found.
    pub checkpoint: Option<&'a Checkpoint>,
}

impl Default for Watch<'_> {
    /// Nothing: the render goes on to its end.
    fn default() -> Self {
        static NEVER: AtomicBool = AtomicBool::new(false);
        Self { cancelled: &NEVER, progress: &|_| {}, checkpoint: None }
    }
}

/// Why a picture was not finished.
#[derive(Debug, thiserror::Error)]
pub enum Stopped {
    /// It was asked to stop.
    #[error("the render was stopped")]
    Cancelled,
    /// The checkpoint cannot be written or read.
    #[error(transparent)]
    Checkpoint(#[from] FileError),
}

/// Draws a scene with the threads of the current rayon pool.
///
/// ```
/// use kerrscope::render::{Stage, Watch, draw};
/// use kerrscope::scene::Scene;
/// # use std::path::Path;
/// let scene = Scene::from_toml("[render]\nwidth = 16\nheight = 9\nsamples = 1", Path::new(""))?;
/// let stage = Stage::new(&scene)?;
/// let film = draw(&stage, &Watch::default())?;
/// assert_eq!(film.light.len(), 144);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If it is stopped, or the checkpoint cannot be used. What was finished by then is in the checkpoint.
pub fn draw(stage: &Stage, watch: &Watch<'_>) -> Result<Film, Stopped> {
    let tiling = Tiling::of(stage);
    let mut film = Film::blank(stage.size(), stage.radiance(), stage.channels(), stage.level());
    let mut done = vec![false; tiling.count() as usize];
    if let Some(checkpoint) = watch.checkpoint {
        let mut rays = 0;
        checkpoint.parts(|number, contents| {
            if let Some(done @ false) = done.get_mut(number as usize) {
                let area = tiling.area(number);
                if let Some(tile) =
                    Tile::decode(contents, area, stage.channels().len(), stage.radiance().is_some())
                {
                    film.place(&tile, area);
                    *done = true;
                    rays += area.rays(stage);
                }
            }
        })?;
        (watch.progress)(rays);
    }
    let film = Mutex::new(film);
    // As many as there are threads, each used again and again.
    let replays = Mutex::new(Vec::new());
    let outcome = (0..tiling.count()).into_par_iter().filter(|&n| !done[n as usize]).try_for_each(|number| {
        if watch.cancelled.load(Ordering::Relaxed) {
            return Err(Stopped::Cancelled);
        }
        let area = tiling.area(number);
        let mut replay = lock(&replays).pop().unwrap_or_default();
        let tile = Tile::draw(stage, area, &mut replay);
        lock(&replays).push(replay);
        if let Some(checkpoint) = watch.checkpoint {
            checkpoint.keep(number, &tile.encode())?;
        }
        lock(&film).place(&tile, area);
        (watch.progress)(area.rays(stage));
        Ok(())
    });
    if let (Err(Stopped::Cancelled), Some(checkpoint)) = (&outcome, watch.checkpoint) {
        checkpoint.flush()?;
    }
    outcome.map(|()| film.into_inner().unwrap_or_else(PoisonError::into_inner))
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
