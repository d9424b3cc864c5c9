//! Rendering: every pixel's rays, in parallel, the same for any number of threads.

mod film;
mod sampling;
mod stage;

pub use film::{Film, Moments, Tally};
pub use sampling::Sampler;
pub use stage::{Replay, Stage, StageError, tracer};

use crate::light::Light;
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};

/// Edge of the square tiles that threads take, in pixels.
const TILE: u32 = 16;

/// The instructions that the rays are traced with: part of what a picture depends on.
pub const fn instruction_level() -> &'static str {
    if cfg!(target_feature = "avx512f") {
        "avx512"
    } else if cfg!(target_feature = "avx2") {
        "avx2"
    } else {
        "baseline"
    }
}

/// Draws a scene with the threads of the current rayon pool.
///
/// `progress` is told of each batch of rays that is done, from any thread. If `cancelled`
/// becomes true the render stops soon and nothing is returned.
///
/// ```
/// use kerrscope::render::{Stage, draw};
/// use kerrscope::scene::Scene;
/// # use std::path::Path;
/// # use std::sync::atomic::AtomicBool;
/// let scene = Scene::from_toml("[render]\nwidth = 16\nheight = 9\nsamples = 1", Path::new(""))?;
/// let stage = Stage::new(&scene)?;
/// let film = draw(&stage, &AtomicBool::new(false), &|_| {}).expect("not cancelled");
/// assert_eq!(film.pixels.len(), 144);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn draw(stage: &Stage, cancelled: &AtomicBool, progress: &(dyn Fn(u64) + Sync)) -> Option<Film> {
    let [width, height] = stage.size();
    let (columns, rows) = (width.div_ceil(TILE), height.div_ceil(TILE));
    let tiles: Vec<Option<Tile>> = (0..columns * rows)
        .into_par_iter()
        .map(|number| {
            if cancelled.load(Ordering::Relaxed) {
                return None;
            }
            let tile = Tile::draw(stage, number % columns * TILE, number / columns * TILE);
            progress(tile.tally.rays);
            Some(tile)
        })
        .collect();
    let mut pixels = vec![Light::DARK; width as usize * height as usize];
    let mut tally = Tally::default();
    for tile in tiles {
        let tile = tile?;
        tally.add(&tile.tally);
        for (row, line) in tile.pixels.chunks_exact(tile.width).enumerate() {
            let start = (tile.top + row) * width as usize + tile.left;
            pixels[start..start + tile.width].copy_from_slice(line);
        }
    }
    Some(Film { width, height, pixels, tally })
}

/// A finished tile.
struct Tile {
    left: usize,
    top: usize,
    width: usize,
    pixels: Vec<Light>,
    tally: Tally,
}

impl Tile {
    fn draw(stage: &Stage, left: u32, top: u32) -> Self {
        let [width, height] = stage.size();
        let (right, bottom) = ((left + TILE).min(width), (top + TILE).min(height));
        let mut replay = Replay::default();
        let mut tally = Tally::default();
        let mut pixels = Vec::with_capacity((TILE * TILE) as usize);
        for y in top..bottom {
            for x in left..right {
                pixels.push(stage.pixel([x, y], &mut replay, &mut tally));
            }
        }
        Self { left: left as usize, top: top as usize, width: (right - left) as usize, pixels, tally }
    }
}
