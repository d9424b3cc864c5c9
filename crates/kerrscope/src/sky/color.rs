//! The colours of stars.

/// The colour of a star of colour index B − V: linear light of luminance 1.
///
/// That of a black body of the temperature by Ballesteros 2012 (EPL 97, 34008), eq. 14, through
/// the colour matching functions of CIE 1931 as fitted by Wyman, Sloan & Shirley 2013 (JCGT 2(2)),
/// eq. 4. What is redder than the primaries of sRGB can show has no blue.
pub(super) fn of_index(index: f64) -> [f64; 3] {
    let temperature = 4600.0 * (1.0 / (0.92 * index + 1.7) + 1.0 / (0.92 * index + 0.62));
    black_body(temperature)
}

/// The colour of a black body of a temperature in K: linear light of luminance 1.
fn black_body(temperature: f64) -> [f64; 3] {
    let mut xyz = [0.0; 3];
    for nm in (360..=830).step_by(5).map(f64::from) {
        // Planck's law but for a factor; hc/k = 0.01438777 m K.
        let radiance = nm.powi(-5) / (1.438777e7 / (nm * temperature)).exp_m1();
        for (sum, weight) in xyz.iter_mut().zip(matching(nm)) {
            *sum += radiance * weight;
        }
    }
    // IEC 61966-2-1.
    let rgb = [[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.2040, 1.0570]]
        .map(|row: [f64; 3]| (0..3).map(|k| row[k] * xyz[k]).sum::<f64>().max(0.0));
    let luminance = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
    rgb.map(|c| c / luminance)
}

/// The colour matching functions x̄, ȳ, z̄ at a wavelength in nm.
fn matching(nm: f64) -> [f64; 3] {
    let lobe = |height: f64, middle: f64, below: f64, above: f64| {
        let t = (nm - middle) * if nm < middle { below } else { above };
        height * (-0.5 * t * t).exp()
    };
    [
        lobe(1.056, 599.8, 0.0264, 0.0323) + lobe(0.362, 442.0, 0.0624, 0.0374)
            - lobe(0.065, 501.1, 0.0490, 0.0382),
        lobe(0.821, 568.8, 0.0213, 0.0247) + lobe(0.286, 530.9, 0.0613, 0.0322),
        lobe(1.217, 437.0, 0.0845, 0.0278) + lobe(0.681, 459.0, 0.0385, 0.0725),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_is_about_6500_kelvin() {
        // The Planckian locus passes D65 at 6504 K, a little on the purple side of it:
        // (0.3135, 0.3237) against (0.3127, 0.3290).
        let [r, g, b] = black_body(6504.0);
        assert!((r - 1.03).abs() < 0.02 && (g - 0.99).abs() < 0.02 && (b - 1.03).abs() < 0.03, "{r} {g} {b}");
    }

    #[test]
    fn the_sun_and_extremes() {
        // B − V = 0.65 is the Sun's: 5778 K, by the formula 5780.
        let (sun, same) = (of_index(0.65), black_body(5778.0));
        assert!((0..3).all(|k| (sun[k] - same[k]).abs() < 0.005), "{sun:?} {same:?}");
        for index in [-0.4, 0.0, 1.5, 5.46] {
            let [r, g, b] = of_index(index);
            assert!((0.2126 * r + 0.7152 * g + 0.0722 * b - 1.0).abs() < 1e-12);
            assert_eq!(r > b, index > 0.3, "{index}");
        }
    }
}
