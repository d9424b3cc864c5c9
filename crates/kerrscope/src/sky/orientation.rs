//! How the sky stands in a scene.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Coordinates of the sky. Seen from inside, with north up, longitude grows to the left, as
/// azimuth does in a scene.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Frame {
    /// Along the Milky Way, from the centre of the Galaxy.
    #[default]
    Galactic,
    /// Along the celestial equator of J2000: right ascension and declination.
    Equatorial,
}

/// From equatorial (ICRS) to galactic components.
///
/// ESA 1997, The Hipparcos and Tycho Catalogues, volume 1, equation 1.5.11. Its rows are the
/// directions of the galactic centre, of longitude 90° and of the north galactic pole.
const GALACTIC: [[f64; 3]; 3] = [
    [-0.0548755604162154, -0.8734370902348850, -0.4838350155487132],
    [0.4941094278755837, -0.4448296299600112, 0.7469822444972189],
    [-0.8676661490190047, -0.1980763734312015, 0.4559837761750669],
];

const IDENTITY: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// How a sky that is known in coordinates of its own stands in a scene: a rotation.
///
/// With longitude ℓ and latitude b in the sky's own coordinates, its unit vectors are
/// (cos b cos ℓ, cos b sin ℓ, sin b), as (sin θ cos φ, sin θ sin φ, cos θ) are the scene's.
///
/// ```
/// use kerrscope::sky::{Frame, Orientation};
/// // The Milky Way level, its centre at azimuth 180°, and a catalogue in equatorial coordinates.
/// let stands = Orientation::celestial(Frame::Equatorial, Frame::Galactic, 180_f64.to_radians());
/// // Sagittarius A*: right ascension 266.4168°, declination −29.0078°.
/// let [theta, phi] = stands.scene_angles([266.4168_f64, -29.0078].map(f64::to_radians));
/// assert!((theta.to_degrees() - 90.046).abs() < 0.001);
/// assert!((phi.to_degrees() - 179.944).abs() < 0.001);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orientation {
    /// From the scene's components to the sky's own.
    inwards: [[f64; 3]; 3],
}

impl Orientation {
    /// North along +z, and longitude 0 at an azimuth.
    pub fn upright(azimuth: f64) -> Self {
        Self { inwards: about(2, -azimuth) }
    }

    /// The sky known in the coordinates `known`, when the north of `upright` is along +z and its
    /// longitude 0 at an azimuth.
    pub fn celestial(known: Frame, upright: Frame, azimuth: f64) -> Self {
        let between = match (known, upright) {
            (Frame::Equatorial, Frame::Galactic) => transposed(GALACTIC),
            (Frame::Galactic, Frame::Equatorial) => GALACTIC,
            (Frame::Equatorial, Frame::Equatorial) | (Frame::Galactic, Frame::Galactic) => IDENTITY,
        };
        Self { inwards: product(between, Self::upright(azimuth).inwards) }
    }

    /// The same, turned about the scene's x axis, then about its y axis, then about its z axis,
    /// each by a right-handed angle. The axes stand still.
    pub fn turned(self, [x, y, z]: [f64; 3]) -> Self {
        let back = product(about(0, -x), product(about(1, -y), about(2, -z)));
        Self { inwards: product(self.inwards, back) }
    }

    /// The sky's own unit vector towards a direction of the scene.
    pub fn inwards(&self, n: [f64; 3]) -> [f64; 3] {
        self.inwards.map(|row| row[0] * n[0] + row[1] * n[1] + row[2] * n[2])
    }

    /// The direction (θ, φ) in the scene of a longitude and latitude of the sky's own.
    pub fn scene_angles(&self, [longitude, latitude]: [f64; 2]) -> [f64; 2] {
        let n = vector(longitude, latitude);
        let [x, y, z] = transposed(self.inwards).map(|row| row[0] * n[0] + row[1] * n[1] + row[2] * n[2]);
        [x.hypot(y).atan2(z), y.atan2(x)]
    }
}

/// The unit vector of a longitude and a latitude.
pub(super) fn vector(longitude: f64, latitude: f64) -> [f64; 3] {
    let ((sin_l, cos_l), (sin_b, cos_b)) = (longitude.sin_cos(), latitude.sin_cos());
    [cos_b * cos_l, cos_b * sin_l, sin_b]
}

/// Turns vectors about an axis, from the next axis towards the one after it.
fn about(axis: usize, angle: f64) -> [[f64; 3]; 3] {
    let (sin, cos) = angle.sin_cos();
    let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut m = [[0.0; 3]; 3];
    m[axis][axis] = 1.0;
    (m[next][next], m[next][last]) = (cos, -sin);
    (m[last][next], m[last][last]) = (sin, cos);
    m
}

fn product(a: [[f64; 3]; 3], b: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    a.map(|row| std::array::from_fn(|j| (0..3).map(|k| row[k] * b[k][j]).sum()))
}

fn transposed(m: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| m[j][i]))
}
