//! The Planckian locus: luminance and colour of black bodies, from a table.
//!
//! The table has ln Y, X/Y and Z/Y at 513 temperatures, equally far apart in ln T from 500 K to 10⁹ K, with their
//! derivatives, d ln B/d ln T = x/(1 − e⁻ˣ) under the sums; between these cubic Hermite interpolation. Against the sums
//! it errs by less than 1e-7 of the luminance.
//!
//! Beyond the table stand the limits. Hotter than 10⁹ K the visible is the tail of Rayleigh and Jeans, B_λ = 2ckT/λ⁴:
//! luminance in proportion to T and one colour, which at the table's end is 2e-5 away. Colder than 500 K it is Wien's:
//! ln Y is taken as linear in 1/T, and the colour, a red that the display has not, as that of 500 K; no eye sees it.

use std::sync::LazyLock;

use super::{observer, planck, rgb};

const COLDEST: f64 = 500.0;
const HOTTEST: f64 = 1e9;
const INTERVALS: usize = 512;

/// How a black body looks.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Glow {
    /// Luminance, cd m⁻².
    pub luminance: f64,
    /// Colour: linear red, green and blue (see [`rgb`]) of luminance 1, none of them negative.
    pub rgb: [f64; 3],
}

/// ln Y, X/Y and Z/Y.
type Values = [f64; 3];

/// Values at a temperature, and their derivatives by ln T.
struct Node {
    values: Values,
    slopes: Values,
}

static TABLE: LazyLock<Vec<Node>> =
    LazyLock::new(|| (0..=INTERVALS).map(|k| node(COLDEST * (k as f64 * step()).exp())).collect());

/// From node to node in ln T.
fn step() -> f64 {
    (HOTTEST / COLDEST).ln() / INTERVALS as f64
}

fn node(temperature: f64) -> Node {
    let radiance = |wavelength| planck::per_wavelength(wavelength, temperature);
    let [x, y, z] = observer::tristimulus(radiance);
    let slope = |wavelength| radiance(wavelength) * planck::slope(wavelength, temperature);
    let [dx, dy, dz] = observer::tristimulus(slope);
    Node { values: [y.ln(), x / y, z / y], slopes: [dy / y, (dx - x / y * dy) / y, (dz - z / y * dy) / y] }
}

/// How a black body of a temperature in K looks; one that is not above absolute zero is dark.
///
/// ```
/// use kerrscope::spectrum::locus;
/// // As hot as the Sun: 1.84e9 cd/m².
/// let sun = locus::glow(5772.0);
/// assert!((sun.luminance / 1.84e9 - 1.0).abs() < 0.01);
/// // A little redder than D65.
/// let [red, green, blue] = sun.rgb;
/// assert!(red > green && green > blue);
/// ```
pub fn glow(temperature: f64) -> Glow {
    if !(temperature > 0.0) {
        return Glow::default();
    }
    let [ln_y, x, z] = values(temperature.min(f64::MAX));
    let rgb = rgb::into_gamut(rgb::of_tristimulus([x, 1.0, z]));
    // As the table's matrix has rounded it.
    let unit = rgb::luminance(rgb);
    Glow { luminance: ln_y.exp().min(f64::MAX), rgb: rgb.map(|c| c / unit) }
}

/// Lumen in a watt of the light of a black body of a temperature in K: π times the luminance over σT⁴. None has more
/// than 96.
pub fn efficacy(temperature: f64) -> f64 {
    let glow = glow(temperature);
    if glow.luminance > 0.0 { glow.luminance / planck::bolometric(temperature) } else { 0.0 }
}

fn values(temperature: f64) -> Values {
    let (step, u) = (step(), (temperature / COLDEST).ln());
    let table = &TABLE;
    if u <= 0.0 {
        let Node { values: [ln_y, x, z], slopes: [slope, ..] } = table[0];
        // ln Y = a − b/T with this slope, b/T, at the table's end.
        return [ln_y - slope * (COLDEST / temperature - 1.0), x, z];
    }
    let place = u / step;
    if place >= INTERVALS as f64 {
        let Node { values: [ln_y, x, z], .. } = table[INTERVALS];
        return [ln_y + (temperature / HOTTEST).ln(), x, z];
    }
    let (k, t) = (place as usize, place.fract());
    let (from, to) = (&table[k], &table[k + 1]);
    std::array::from_fn(|i| {
        let (a, b) = (from.values[i], to.values[i]);
        let (da, db) = (from.slopes[i] * step, to.slopes[i] * step);
        // Hermite's cubic by its values and slopes at 0 and 1.
        let bend = 2.0 * (a - b) + da + db;
        a + t * (da + t * (3.0 * (b - a) - 2.0 * da - db + t * bend))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn summed(temperature: f64) -> [f64; 3] {
        observer::tristimulus(|wavelength| planck::per_wavelength(wavelength, temperature))
    }

    #[test]
    fn the_table_is_the_sum() {
        let mut worst = 0_f64;
        for k in 0..5000 {
            let temperature = COLDEST * ((f64::from(k) + 0.37) / 5000.0 * (HOTTEST / COLDEST).ln()).exp();
            let xyz = summed(temperature);
            let glow = glow(temperature);
            let exact = rgb::into_gamut(rgb::of_tristimulus(xyz.map(|c| c / xyz[1])));
            worst = worst.max((glow.luminance / xyz[1] - 1.0).abs());
            worst = (0..3).fold(worst, |worst, k| worst.max((glow.rgb[k] - exact[k]).abs()));
        }
        assert!(worst < 1e-7, "{worst:e}");
    }

    #[test]
    fn limits() {
        // At the ends the table and what is beyond meet, and the sums go on as these.
        for end in [COLDEST, HOTTEST] {
            let [below, above] = [end * (1.0 - 1e-9), end * (1.0 + 1e-9)].map(glow);
            assert!((below.luminance / above.luminance - 1.0).abs() < 1e-7);
            assert!((0..3).all(|k| (below.rgb[k] - above.rgb[k]).abs() < 1e-7));
        }
        for temperature in [2e9, 1e12] {
            let [x, y, z] = summed(temperature);
            let exact = rgb::of_tristimulus([x / y, 1.0, z / y]);
            let glow = glow(temperature);
            assert!((glow.luminance / y - 1.0).abs() < 1e-4, "{temperature}");
            assert!((0..3).all(|k| (glow.rgb[k] - exact[k]).abs() < 1e-4), "{temperature}");
        }
        // From 500 to 400 K the luminance falls by a factor of 13,000, which is true to 3 % of its logarithm.
        let [there, here, exact] = [glow(500.0).luminance, glow(400.0).luminance, summed(400.0)[1]];
        assert!(((here / exact).ln() / (there / exact).ln()).abs() < 0.03);
        assert_eq!([0.0, -1.0, f64::NAN].map(glow), [Glow::default(); 3]);
        assert_eq!(glow(1e-300).luminance, 0.0);
        assert!(glow(f64::INFINITY).luminance.is_finite());
        assert_eq!(efficacy(0.0), 0.0);
    }

    #[test]
    fn the_most_efficient_black_body() {
        // 95.43 lm/W at 6640 K: the sums over the whole table, independently with NumPy.
        let of = |k: u32| efficacy(f64::from(10 * k));
        let best = (500..900).max_by(|&a, &b| of(a).total_cmp(&of(b))).unwrap();
        assert!(best.abs_diff(664) <= 1 && (of(best) - 95.428).abs() < 1e-3, "{best} {}", of(best));
    }
}
