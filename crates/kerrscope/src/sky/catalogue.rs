//! The catalogue of stars that the program carries: `data/stars.bin`; see the README there.

/// The file: little-endian numbers of 64 bits, one a star, the brightest first.
static FILE: &[u8] = include_bytes!("../../data/stars.bin");

/// In place of a colour index that is not known.
const UNKNOWN: u64 = 1023;

/// A star of the catalogue.
///
/// ```
/// use kerrscope::sky::Star;
/// let brightest = Star::catalogue().next().unwrap();
/// assert_eq!(brightest.magnitude, -1.44); // Sirius
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Star {
    /// Right ascension, J2000, in degrees from 0 to 360.
    pub right_ascension: f64,
    /// Declination, J2000, in degrees.
    pub declination: f64,
    /// Visual magnitude.
    pub magnitude: f64,
    /// Colour index B − V, in magnitudes, if it is known.
    pub color_index: Option<f64>,
}

impl Star {
    /// All 41,411 stars down to magnitude 8, the brightest first.
    pub fn catalogue() -> impl Iterator<Item = Self> {
        let (codes, _) = FILE.as_chunks();
        codes.iter().map(|&bytes| Self::from_code(u64::from_le_bytes(bytes)))
    }

    /// The star in 64 bits, from the lowest: 22 of right ascension and 21 of declination + 90° in
    /// units of 0.0001°, 10 of magnitude + 2 and 10 of B − V + 1 in units of 0.01, or 1023.
    pub fn code(self) -> u64 {
        let part = |x: f64, units: f64, largest: u64| ((x * units).round().max(0.0) as u64).min(largest);
        let ascension = part(self.right_ascension.rem_euclid(360.0), 1e4, u64::MAX) % 3_600_000;
        let declination = part(self.declination + 90.0, 1e4, 1_800_000);
        let magnitude = part(self.magnitude + 2.0, 100.0, 1023);
        let color = self.color_index.map_or(UNKNOWN, |index| part(index + 1.0, 100.0, UNKNOWN - 1));
        ascension | declination << 22 | magnitude << 43 | color << 53
    }

    /// The star of a [code](Self::code).
    pub fn from_code(code: u64) -> Self {
        let part = |from: u32, bits: u32| (code >> from) & ((1 << bits) - 1);
        let hundredths = |from, offset: u64| (part(from, 10) as f64 - offset as f64) / 100.0;
        Self {
            right_ascension: part(0, 22) as f64 / 1e4,
            declination: (part(22, 21) as f64 - 900_000.0) / 1e4,
            magnitude: hundredths(43, 200),
            color_index: (part(53, 10) != UNKNOWN).then(|| hundredths(53, 100)),
        }
    }
}
