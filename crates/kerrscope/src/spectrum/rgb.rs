//! From tristimulus values to the linear light of a display.
//!
//! The display has the primaries of Rec. 709 and the white of D65 (IEC 61966-2-1): chromaticities (0.64, 0.33),
//! (0.30, 0.60), (0.15, 0.06) and (0.3127, 0.3290). Its white stays D65: nothing is adapted, so a black body of 6500 K is
//! nearly white, and what is hotter is blue.

/// Rows: red, green and blue of X, Y and Z; the inverse of what the four chromaticities give.
const FROM_XYZ: [[f64; 3]; 3] = [
    [3.2409699419045226, -1.5373831775700939, -0.4986107602930034],
    [-0.9692436362808796, 1.8759675015077202, 0.0415550574071756],
    [0.0556300796969936, -0.2039769588889766, 1.0569715142428786],
];

/// Y of red, green and blue.
pub const LUMINANCE: [f64; 3] = [0.2126390058715103, 0.7151686787677559, 0.0721923153607337];

/// Linear red, green and blue of tristimulus values: as much light as these, component for component. Colours that the
/// display does not have get a negative component: see [`into_gamut`].
///
/// ```
/// use kerrscope::spectrum::{observer, rgb};
/// let white = rgb::of_tristimulus([0.3127 / 0.3290, 1.0, 0.3583 / 0.3290]);
/// assert!(white.iter().all(|c| (c - 1.0).abs() < 1e-12));
/// // Yellow light of one wavelength is more saturated than any display.
/// let sodium = observer::tristimulus(|wavelength| if (wavelength - 590e-9).abs() < 1e-10 { 1.0 } else { 0.0 });
/// assert!(rgb::of_tristimulus(sodium)[2] < 0.0);
/// ```
pub fn of_tristimulus(xyz: [f64; 3]) -> [f64; 3] {
    FROM_XYZ.map(|row| row[0] * xyz[0] + row[1] * xyz[1] + row[2] * xyz[2])
}

/// Y of linear red, green and blue.
pub fn luminance(rgb: [f64; 3]) -> f64 {
    (0..3).map(|k| LUMINANCE[k] * rgb[k]).sum()
}

/// The colour that a display shows for one that it does not have: white of the same luminance is mixed in until no
/// component is negative. Hue (the line towards white in the chromaticity diagram) and luminance stay.
/// What is dark, or not a number, is black.
///
/// ```
/// use kerrscope::spectrum::rgb;
/// let shown = rgb::into_gamut([1.0, 0.5, -0.2]);
/// assert!((rgb::luminance(shown) - rgb::luminance([1.0, 0.5, -0.2])).abs() < 1e-15);
/// assert_eq!(shown[2], 0.0);
/// ```
pub fn into_gamut(rgb: [f64; 3]) -> [f64; 3] {
    let least = rgb[0].min(rgb[1]).min(rgb[2]);
    if least >= 0.0 {
        return rgb;
    }
    let white = luminance(rgb);
    if !(white > 0.0) {
        return [0.0; 3];
    }
    // White + share (rgb − white) is 0 for the least component.
    let share = white / (white - least);
    rgb.map(|c| (white + share * (c - white)).max(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The matrix from its definition: columns are the primaries, as strong as makes white of their sum.
    #[test]
    fn primaries_and_white() {
        let xyz = |[x, y]: [f64; 2]| [x / y, 1.0, (1.0 - x - y) / y];
        for (k, primary) in [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]].into_iter().enumerate() {
            let rgb = of_tristimulus(xyz(primary).map(|c| c * LUMINANCE[k]));
            for (j, c) in rgb.into_iter().enumerate() {
                assert!((c - f64::from(u8::from(j == k))).abs() < 1e-13, "{k} {j}: {c}");
            }
        }
        assert!((LUMINANCE.iter().sum::<f64>() - 1.0).abs() < 1e-14);
        assert_eq!(into_gamut([-1.0, 0.0, 0.0]), [0.0; 3]);
        assert_eq!(into_gamut([f64::NAN, -1.0, 1.0]), [0.0; 3]);
    }
}
