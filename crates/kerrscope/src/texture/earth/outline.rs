//! Outlines of the Earth's land and lakes: `data/earth.bin`; see the README there.

/// The file, as [`Outlines::encode`] writes it.
static FILE: &[u8] = include_bytes!("../../../data/earth.bin");

/// Units of an outline's coordinates in a degree: a unit is 1.1 km at most.
pub const UNITS: i32 = 100;

/// A closed outline.
#[derive(Clone, Debug, Eq, PartialEq)]
pub struct Ring {
    /// Its corners: longitude, positive to the east, and latitude, positive to the north, in degrees
    /// times [`UNITS`]. From corner to corner, and from the last to the first, longitude goes the
    /// shorter way around, so that an outline may cross ±180° and may go around a pole.
    pub corners: Vec<[i32; 2]>,
}

/// Outlines of the Earth's land and lakes.
///
/// A place is inside the outlines of one kind when an odd number of their edges lies due north of
/// it: the north pole is outside. Edges are straight in longitude and latitude. Land is what is
/// inside the outlines of land and outside those of lakes.
#[derive(Clone, Debug, Default, Eq, PartialEq)]
pub struct Outlines {
    /// Coasts, and those of inland seas.
    pub land: Vec<Ring>,
    /// Shores of lakes, and of islands in them.
    pub lakes: Vec<Ring>,
}

impl Ring {
    /// The edges, from corner to corner, in the corners' units. Where an edge crosses ±180°, the longitude
    /// of its end goes on beyond.
    pub fn edges(&self) -> impl Iterator<Item = [[i32; 2]; 2]> {
        let next = self.corners.iter().cycle().skip(1);
        self.corners.iter().zip(next).map(|(&from, &to)| [from, [from[0] + turn(from[0], to[0]), to[1]]])
    }

    /// The share of the sphere's area inside, of what does not contain the north pole:
    ///
    /// ```text
    /// area / 4π = |∮ (1 + sin φ) dλ| / 4π,   along an edge   ∫ sin φ dλ = Δλ (cos φ₀ − cos φ₁) / Δφ
    /// ```
    pub fn area(&self) -> f64 {
        let sum: f64 = self
            .edges()
            .map(|edge| {
                let [[x0, y0], [x1, y1]] = edge.map(|corner| corner.map(|x| degrees(x).to_radians()));
                // (cos φ₀ − cos φ₁) / Δφ, which has the limit sin φ.
                let (middle, half) = (0.5 * (y0 + y1), 0.5 * (y1 - y0));
                let sinc = if half == 0.0 { 1.0 } else { half.sin() / half };
                (x1 - x0) * (1.0 + middle.sin() * sinc)
            })
            .sum();
        sum.abs() / (4.0 * std::f64::consts::PI)
    }

    /// Whether a place, in degrees, is inside. Places on an edge belong to one side or the other.
    pub fn contains(&self, longitude: f64, latitude: f64) -> bool {
        // How far east of the place a corner is, from −180° to 180°: the same number for both its edges, so
        // that no ray to the north slips through between them.
        let east = |corner: [i32; 2]| (degrees(corner[0]) - longitude + 180.0).rem_euclid(360.0) - 180.0;
        let crossed = |(&from, &to): (&[i32; 2], &[i32; 2])| {
            let [a, b] = [from, to].map(east);
            // Otherwise it goes by on the other side of the Earth.
            let here = (a < 0.0) != (b < 0.0) && (b - a).abs() < 180.0;
            here && degrees(from[1]) - a * (degrees(to[1]) - degrees(from[1])) / (b - a) > latitude
        };
        let next = self.corners.iter().cycle().skip(1);
        self.corners.iter().zip(next).filter(|&edge| crossed(edge)).count() % 2 == 1
    }
}

impl Outlines {
    /// The outlines that the program carries: Natural Earth's at a scale of 1 : 50 million.
    pub fn built_in() -> Self {
        // A test holds that the file is whole.
        Self::decode(FILE).unwrap_or_default()
    }

    /// Whether a place, in degrees, is land and no lake.
    ///
    /// ```
    /// use kerrscope::texture::earth::Outlines;
    /// let outlines = Outlines::built_in();
    /// assert!(outlines.is_land(25.0, 50.0)); // Ukraine
    /// assert!(!outlines.is_land(-25.0, 50.0)); // the Atlantic
    /// ```
    pub fn is_land(&self, longitude: f64, latitude: f64) -> bool {
        let inside =
            |rings: &[Ring]| rings.iter().filter(|r| r.contains(longitude, latitude)).count() % 2 == 1;
        inside(&self.land) && !inside(&self.lakes)
    }

    /// The outlines in few bytes: for land, then for lakes, the number of outlines, and for each the
    /// number of its corners and each corner's longitude and latitude, less those of the corner
    /// before it (of the outline before it for the first, at first 0).
    ///
    /// Numbers are in base 128, the lowest digit first; all bytes but a number's last have 128 added.
    /// Differences d, which may be negative, are written as 2 d or −2 d − 1.
    pub fn encode(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut last = [0; 2];
        for rings in [&self.land, &self.lakes] {
            put(&mut bytes, rings.len() as u64);
            for ring in rings {
                put(&mut bytes, ring.corners.len() as u64);
                for &corner in &ring.corners {
                    let across = turn(last[0], corner[0]);
                    for d in [across, corner[1] - last[1]].map(i64::from) {
                        put(&mut bytes, if d < 0 { -2 * d - 1 } else { 2 * d }.cast_unsigned());
                    }
                    last = corner;
                }
            }
        }
        bytes
    }

    /// The outlines that [`encode`](Self::encode) wrote, with longitudes from −180° to below 180°.
    /// None where the bytes are not as it writes them.
    pub fn decode(mut bytes: &[u8]) -> Option<Self> {
        let mut last = [0_i64; 2];
        let mut rings = || -> Option<Vec<Ring>> {
            let mut corner = |bytes: &mut &[u8]| {
                for x in &mut last {
                    let code = take(bytes)?;
                    let half = (code >> 1).cast_signed();
                    *x = x.checked_add(if code % 2 == 1 { -half - 1 } else { half })?;
                }
                let longitude = (last[0] + 180 * i64::from(UNITS)).rem_euclid(360 * i64::from(UNITS));
                last[0] = longitude - 180 * i64::from(UNITS);
                let latitude = i32::try_from(last[1]).ok().filter(|y| y.abs() <= 90 * UNITS)?;
                Some([last[0] as i32, latitude])
            };
            // Collected from what is there: a number alone takes no memory.
            (0..take(&mut bytes)?)
                .map(|_| {
                    let corners =
                        (0..take(&mut bytes)?).map(|_| corner(&mut bytes)).collect::<Option<_>>()?;
                    Some(Ring { corners })
                })
                .collect()
        };
        let (land, lakes) = (rings()?, rings()?);
        bytes.is_empty().then_some(Self { land, lakes })
    }
}

fn degrees(x: i32) -> f64 {
    f64::from(x) / f64::from(UNITS)
}

/// How far it is from a longitude to another, the shorter way around, to the east if both are as far.
fn turn(from: i32, to: i32) -> i32 {
    let half = 180 * UNITS;
    half - (half + from - to).rem_euclid(2 * half)
}

fn put(bytes: &mut Vec<u8>, mut number: u64) {
    while number > 127 {
        bytes.push(number as u8 | 128);
        number >>= 7;
    }
    bytes.push(number as u8);
}

fn take(bytes: &mut &[u8]) -> Option<u64> {
    let mut number = 0;
    for place in (0..63).step_by(7) {
        let (&byte, rest) = bytes.split_first()?;
        *bytes = rest;
        number |= u64::from(byte & 127) << place;
        if byte < 128 {
            return Some(number);
        }
    }
    None
}
