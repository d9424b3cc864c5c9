//! The Milky Way's glow: `data/milky-way.bin`; see the README there.

use super::cube::{self, Place};

/// The file: brightness from 0 to 255 at [`Glow::directions`].
static FILE: &[u8] = include_bytes!("../../data/milky-way.bin");

/// Intervals between samples along an edge of the cube.
const STEPS: usize = 128;

/// Samples along an edge of the cube. The outermost lie on it, so that faces join.
const SIDE: usize = STEPS + 1;

/// The light of the Milky Way's unresolved stars, in equatorial coordinates.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub struct Glow;

impl Glow {
    /// The directions, in equatorial coordinates, of the map's samples in their order.
    pub fn directions() -> impl Iterator<Item = [f64; 3]> {
        let along = |i: usize| 2.0 * i as f64 / STEPS as f64 - 1.0;
        (0..6 * SIDE * SIDE).map(move |k| {
            let at = [along(k % SIDE), along(k / SIDE % SIDE)];
            cube::direction(Place { face: k / (SIDE * SIDE), at })
        })
    }

    /// Brightness from 0 to 1 towards a unit vector in equatorial coordinates.
    pub fn brightness(n: [f64; 3]) -> f64 {
        let Place { face, at } = cube::place(n);
        let [(i, f), (j, g)] = at.map(|a| {
            let x = (a + 1.0) * (0.5 * STEPS as f64);
            let i = (x as usize).min(STEPS - 1);
            (i, x - i as f64)
        });
        let row = |j: usize| {
            let at = (face * SIDE + j) * SIDE + i;
            f64::from(FILE[at]) * (1.0 - f) + f64::from(FILE[at + 1]) * f
        };
        (row(j) * (1.0 - g) + row(j + 1) * g) / 255.0
    }
}
