//! What is interpolated: the answers of traced rays as smooth numbers.
//!
//! Of each crossing 1/r and the unit vector to it within the plane, of light that escapes the unit vector to
//! where it comes from. Unlike r itself, 1/r is smooth where a crossing goes off to infinity, and unlike angles vectors are
//! smooth across the axis and once around.

use crate::disk::Plane;
use crate::render::tally::worse;
use crate::sky::towards;
use crate::spacetime::geodesic::{Fate, Path};
use crate::spacetime::tensor::dot;

/// Numbers of a crossing: 1/r, then cosine and sine of its azimuth in the plane.
pub(super) const CROSSING: usize = 3;

/// Rays are interpolated among those of one kind.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub(super) enum Kind {
    /// No photon arrives at this point of the picture.
    Nothing,
    /// Given up on, or never like another.
    Unknown,
    /// It escapes, after so many crossings of the plane; whether to the side of the plane's normal, and whether behind a
    /// wormhole.
    Escaped { crossings: u8, above: bool, other_side: bool },
    /// It is captured, after so many crossings.
    Captured { crossings: u8 },
}

impl Kind {
    /// How many crossings there are.
    pub(super) fn crossings(self) -> usize {
        match self {
            Self::Nothing | Self::Unknown => 0,
            Self::Escaped { crossings, .. } | Self::Captured { crossings } => usize::from(crossings),
        }
    }

    /// Where the numbers of the direction begin, if the light escapes.
    pub(super) fn direction(self) -> Option<usize> {
        matches!(self, Self::Escaped { .. }).then(|| CROSSING * self.crossings())
    }

    /// Whether the light comes from the other side of a wormhole.
    pub(super) fn is_other_side(self) -> bool {
        matches!(self, Self::Escaped { other_side: true, .. })
    }

    /// How many numbers are interpolated.
    pub(super) fn numbers(self) -> usize {
        CROSSING * self.crossings() + if self.direction().is_some() { 3 } else { 0 }
    }
}

/// Traced rays, each of a kind and with its numbers.
#[derive(Clone, Debug, Default)]
pub(super) struct Knots {
    kinds: Vec<Kind>,
    /// Where the numbers of each begin.
    starts: Vec<u32>,
    numbers: Vec<f64>,
}

impl Knots {
    pub(super) fn count(&self) -> usize {
        self.kinds.len()
    }

    /// Adds a ray that was traced; none if no photon arrives there.
    pub(super) fn push(&mut self, path: Option<&Path>, plane: &Plane) {
        self.starts.push(self.numbers.len() as u32);
        self.kinds.push(path.map_or(Kind::Nothing, |path| kind(path, plane)));
        let Some(path) = path else { return };
        for crossing in &path.crossings {
            let along = plane.components(crossing.position);
            let inverse = along[0].hypot(along[1]).recip();
            self.numbers.push(crossing.r.recip());
            self.numbers.extend(along.map(|c| c * inverse));
        }
        self.numbers.extend(path.direction.iter().flat_map(|&[theta, phi]| towards(theta, phi)));
    }

    /// Adds a ray of a kind with its numbers.
    pub(super) fn push_numbers(&mut self, kind: Kind, numbers: &[f64]) {
        self.starts.push(self.numbers.len() as u32);
        self.kinds.push(kind);
        self.numbers.extend(numbers);
    }

    pub(super) fn kind(&self, knot: u32) -> Kind {
        self.kinds[knot as usize]
    }

    /// The numbers of a ray, as many as its kind has.
    pub(super) fn numbers(&self, knot: u32) -> &[f64] {
        &self.numbers[self.starts[knot as usize] as usize..]
    }
}

/// The largest difference between two rays of a kind: relative in the radii of crossings, radians in their
/// azimuths and in the direction.
pub(super) fn difference(kind: Kind, exact: &[f64], found: &[f64]) -> f64 {
    // Between vectors, of which the exact one has the length 1.
    let angle = |first: usize, components: usize| {
        let (exact, found) = (&exact[first..first + components], &found[first..first + components]);
        let inverse = found.iter().map(|c| c * c).sum::<f64>().sqrt().recip();
        let chord = exact.iter().zip(found).map(|(a, b)| (b * inverse - a).powi(2)).sum::<f64>();
        chord.sqrt()
    };
    let radius = |first: usize| (exact[first] / found[first] - 1.0).abs();
    let crossings = (0..kind.crossings()).map(|k| CROSSING * k);
    let errors = crossings.flat_map(|first| [radius(first), angle(first + 1, 2)]);
    errors.chain(kind.direction().map(|first| angle(first, 3))).fold(0.0, worse)
}

fn kind(path: &Path, plane: &Plane) -> Kind {
    let Ok(crossings) = u8::try_from(path.crossings.len()) else { return Kind::Unknown };
    let known = path.crossings.iter().all(|c| c.r > 0.0 && c.position.iter().all(|c| c.is_finite()));
    match (path.fate, path.direction) {
        (Fate::Escaped, Some([theta, phi])) if known && theta.is_finite() && phi.is_finite() => {
            let above = dot(&towards(theta, phi), &plane.normal()) > 0.0;
            Kind::Escaped { crossings, above, other_side: path.other_side }
        }
        (Fate::Captured, _) if known => Kind::Captured { crossings },
        _ => Kind::Unknown,
    }
}
