//! What stands on many stages and is made once: the skies of pictures that follow each other.

use std::sync::{Arc, Mutex, PoisonError};

use super::setting;
use crate::disk::Ring;
use crate::scene;
use crate::sky::Sky;
use crate::texture::TextureError;

/// Skies that are kept; each is some megabytes.
const SKIES: usize = 12;

/// Patterns of rings that are kept.
const RINGS: usize = 4;

/// Skies and patterns that were needed last. A picture made with them is the same as without.
///
/// ```
/// use kerrscope::render::{Props, Stage, Watch, draw};
/// use kerrscope::scene::Scene;
/// use kerrscope::spacetime::Level;
/// # use std::path::Path;
/// let scene = Scene::from_toml("[render]\nwidth = 16\nheight = 9\nsamples = 1", Path::new(""))?;
/// let props = Props::default();
/// let first = draw(&Stage::with_props(&scene, Level::best(), &props)?, &Watch::default())?;
/// let second = draw(&Stage::with_props(&scene, Level::best(), &props)?, &Watch::default())?;
/// assert_eq!(first, draw(&Stage::new(&scene)?, &Watch::default())?);
/// assert_eq!(first, second);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Default)]
pub struct Props {
    skies: Mutex<Vec<KeptSky>>,
    rings: Mutex<Vec<Ring>>,
}

#[derive(Debug)]
struct KeptSky {
    described: scene::Sky,
    /// The angle of a pixel, bit by bit.
    pixel: u64,
    made: Arc<Sky>,
}

impl Props {
    /// The sky of a picture whose pixels cover an angle on it if nothing bends light.
    pub(super) fn sky(&self, described: &scene::Sky, pixel: f64) -> Result<Arc<Sky>, TextureError> {
        let same = |kept: &KeptSky| kept.pixel == pixel.to_bits() && kept.described == *described;
        let found = recall(&self.skies, same, |kept| Arc::clone(&kept.made));
        if let Some(made) = found {
            return Ok(made);
        }
        // Made without the lock: others need not wait for it, and at worst make the same.
        let made = Arc::new(setting::sky(described, pixel)?);
        let kept = KeptSky { described: described.clone(), pixel: pixel.to_bits(), made: Arc::clone(&made) };
        keep(&self.skies, kept, SKIES);
        Ok(made)
    }

    /// The ring of a seed.
    pub(super) fn ring(&self, seed: u64) -> Ring {
        if let Some(ring) = recall(&self.rings, |ring| ring.seed() == seed, Clone::clone) {
            return ring;
        }
        let ring = Ring::new(seed);
        keep(&self.rings, ring.clone(), RINGS);
        ring
    }
}

/// What is kept and meant, which becomes the last to be forgotten.
fn recall<T, U>(shelf: &Mutex<Vec<T>>, same: impl Fn(&T) -> bool, give: impl Fn(&T) -> U) -> Option<U> {
    let mut shelf = shelf.lock().unwrap_or_else(PoisonError::into_inner);
    let place = shelf.iter().position(same)?;
    let kept = shelf.remove(place);
    let given = give(&kept);
    shelf.push(kept);
    Some(given)
}

/// Keeps something, and forgets what was not needed for longest if it is too much.
fn keep<T>(shelf: &Mutex<Vec<T>>, new: T, most: usize) {
    let mut shelf = shelf.lock().unwrap_or_else(PoisonError::into_inner);
    if shelf.len() >= most {
        shelf.remove(0);
    }
    shelf.push(new);
}
