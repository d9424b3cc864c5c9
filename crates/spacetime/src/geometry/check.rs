//! Whether a metric is what it should be, looked at in random points.

use super::trajectory::cyclic;
use super::{Coordinate, Curvature, Geometry, Nature, eigenvalues, matrix};

/// Numbers of negative and positive eigenvalues.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Signature {
    /// Negative ones: 1 in spacetime.
    pub negative: usize,
    /// Positive ones.
    pub positive: usize,
}

/// What was found. "Largest" is over all points.
#[derive(Clone, Debug, PartialEq)]
pub struct Findings<const N: usize> {
    /// Points looked at.
    pub points: usize,
    /// Points at which the metric is not finite or has no inverse, and the first such.
    pub singular: usize,
    /// The first of those.
    pub singular_at: Option<[f64; N]>,
    /// Largest |g_{μν} − g_{νμ}|, relative to the largest component.
    pub asymmetry: f64,
    /// Signatures met, each with a point where it is so.
    pub signatures: Vec<(Signature, [f64; N])>,
    /// Largest |g_{μα}g^{αν} − δ|.
    pub inverse: f64,
    /// Largest |R^μ_ν|: zero, but for rounding, in a vacuum.
    pub matter: f64,
    /// Where it is so large.
    pub matter_at: [f64; N],
    /// Largest √|R_{ρσμν}R^{ρσμν}|, to compare `matter` with.
    pub curvature: f64,
    /// Largest √|R_{ρσμν}R^{ρσμν}| r² at points whose unlimited coordinates are of the size r = 10⁴ or more; none if no
    /// coordinate but time is unlimited.
    pub far_curvature: Option<f64>,
    /// Coordinates on which the metric does not depend.
    pub cyclic: [bool; N],
}

/// Relative sizes that rounding may have.
const ROUNDING: f64 = 1e-8;
const FAR: f64 = 1e4;

impl<const N: usize> Findings<N> {
    /// g_{μν} = g_{νμ} everywhere.
    pub fn is_symmetric(&self) -> bool {
        self.asymmetry < ROUNDING
    }
    /// The same signature everywhere, with no more than one time.
    pub fn has_good_signature(&self) -> bool {
        matches!(&self.signatures[..], [(s, _)] if s.negative <= 1 && s.negative + s.positive == N)
    }
    /// Without matter: R_{μν} is zero to a share of 1e-8 of the curvature, and of 1 everywhere.
    pub fn is_vacuum(&self) -> bool {
        self.matter < ROUNDING * (1.0 + self.curvature)
    }
    /// Flat far away, like the field of a mass or better: curvature falls off faster than 1/r².
    pub fn is_asymptotically_flat(&self) -> Option<bool> {
        self.far_curvature.map(|c| c < 0.01)
    }
    /// Nothing is wrong with it: finite, symmetric, invertible, of one signature.
    pub fn is_good(&self) -> bool {
        self.singular == 0 && self.is_symmetric() && self.has_good_signature() && self.inverse < 1e-6
    }
}

/// Looks at a metric in `count` points chosen by `seed` within the ranges of its coordinates and inside its margin: of
/// unlimited coordinates half are within about 3 of their lower end or zero, the rest up to some 100.
pub fn check<G: Geometry<N>, const N: usize>(geometry: &G, count: usize, seed: u64) -> Findings<N> {
    let coordinates = geometry.coordinates();
    let mut random = Random(seed);
    let mut found = Findings {
        points: 0,
        singular: 0,
        singular_at: None,
        asymmetry: 0.0,
        signatures: Vec::new(),
        inverse: 0.0,
        matter: 0.0,
        matter_at: [f64::NAN; N],
        curvature: 0.0,
        far_curvature: None,
        cyclic: [true; N],
    };
    // Some points may be inside a horizon.
    for _ in 0..count.saturating_mul(20) {
        if found.points >= count {
            break;
        }
        let x = std::array::from_fn(|i| place(&coordinates[i], random.next(), random.next()));
        if geometry.margin(&x) > 0.0 {
            found.points += 1;
            found.look(geometry, &x);
        }
    }
    let unlimited: Vec<usize> = (0..N)
        .filter(|i| coordinates[*i].nature != Nature::Time && coordinates[*i].range[1].is_infinite())
        .collect();
    if !unlimited.is_empty() {
        for _ in 0..count.min(64) {
            let mut x: [f64; N] =
                std::array::from_fn(|i| place(&coordinates[i], random.next(), random.next()));
            let mut square = 0.0;
            for i in &unlimited {
                let sign =
                    if coordinates[*i].range[0].is_infinite() && random.next() < 0.5 { -1.0 } else { 1.0 };
                x[*i] = sign * FAR * (1.0 + 9.0 * random.next());
                square += x[*i] * x[*i];
            }
            let size = Curvature::of(geometry, &x).kretschmann.abs().sqrt() * square;
            let worst = found.far_curvature.unwrap_or(0.0);
            // NaN stays, and is not small.
            found.far_curvature = Some(if size > worst || size.is_nan() { size } else { worst });
        }
    }
    found
}

impl<const N: usize> Findings<N> {
    fn look<G: Geometry<N>>(&mut self, geometry: &G, x: &[f64; N]) {
        let g = geometry.metric(x);
        let inverse = matrix::invert(&g);
        let finite = |m: &[[f64; N]; N]| m.as_flattened().iter().all(|c| c.is_finite());
        if !finite(&g) || !finite(&inverse) {
            self.singular += 1;
            self.singular_at.get_or_insert(*x);
            return;
        }
        let largest = g.as_flattened().iter().fold(0.0_f64, |a, b| a.max(b.abs()));
        for m in 0..N {
            for n in 0..N {
                self.asymmetry = self.asymmetry.max((g[m][n] - g[n][m]).abs() / largest);
                let unit: f64 = (0..N).map(|a| g[m][a] * inverse[a][n]).sum();
                self.inverse = self.inverse.max((unit - if m == n { 1.0 } else { 0.0 }).abs());
            }
        }
        let values = eigenvalues(&g);
        let signature = Signature {
            negative: values.iter().filter(|v| **v < 0.0).count(),
            positive: values.iter().filter(|v| **v > 0.0).count(),
        };
        if !self.signatures.iter().any(|(s, _)| *s == signature) {
            self.signatures.push((signature, *x));
        }
        let curvature = Curvature::of(geometry, x);
        if curvature.matter() > self.matter || self.matter_at[0].is_nan() {
            (self.matter, self.matter_at) = (curvature.matter(), *x);
        }
        self.curvature = self.curvature.max(curvature.kretschmann.abs().sqrt());
        for (kept, here) in self.cyclic.iter_mut().zip(cyclic(geometry, x)) {
            *kept &= here;
        }
    }
}

/// A value of a coordinate from numbers in (0, 1).
fn place(coordinate: &Coordinate, u: f64, side: f64) -> f64 {
    let [low, high] = coordinate.range;
    let far = 3.0 * u / (1.0 - 0.97 * u);
    match (low.is_finite(), high.is_finite()) {
        (true, true) => low + (high - low) * u,
        (true, false) => low + far,
        (false, true) => high - far,
        (false, false) => {
            if side < 0.5 {
                -far
            } else {
                far
            }
        }
    }
}

/// Numbers in (0, 1) that look like chance (Steele, Lea & Flood 2014, SplitMix64).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        ((z >> 11) as f64 + 0.5) / (1u64 << 53) as f64
    }
}
