//! Colour maps, measured in colour spaces in which distances are what the eye sees.

use kerrscope::display::{Colormap, NO_VALUE, srgb};

const SEQUENTIAL: [Colormap; 6] = [
    Colormap::Viridis,
    Colormap::Magma,
    Colormap::Inferno,
    Colormap::Plasma,
    Colormap::Cividis,
    Colormap::Grey,
];

fn times(matrix: [[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// XYZ, 100 for white, of a colour in the encoding of sRGB (IEC 61966-2-1).
fn xyz(color: [f64; 3]) -> [f64; 3] {
    const FROM_RGB: [[f64; 3]; 3] = [[41.24, 35.76, 18.05], [21.26, 71.52, 7.22], [1.93, 11.92, 95.05]];
    times(FROM_RGB, color.map(srgb::decode))
}

/// CIELAB (CIE 15:2004, eq. 8.3 to 8.11).
fn lab(color: [f64; 3]) -> [f64; 3] {
    let (xyz, white) = (xyz(color), xyz([1.0; 3]));
    let [x, y, z] = std::array::from_fn(|i| {
        let ratio: f64 = xyz[i] / white[i];
        if ratio > (24.0_f64 / 116.0).powi(3) {
            ratio.cbrt()
        } else {
            (841.0 * ratio + 16.0 * 108.0 / 116.0) / 108.0
        }
    });
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// Lightness J, colourfulness M and hue angle of CIECAM02 (CIE 159:2004) in an average surround, on a
/// background of 20.
fn cam02(xyz: [f64; 3], white: [f64; 3], adapting: f64) -> [f64; 3] {
    const CAT02: [[f64; 3]; 3] =
        [[0.7328, 0.4296, -0.1624], [-0.7036, 1.6975, 0.0061], [0.0030, 0.0136, 0.9834]];
    const CAT02_INVERSE: [[f64; 3]; 3] =
        [[1.096124, -0.278869, 0.182745], [0.454369, 0.473533, 0.072098], [-0.009628, -0.005698, 1.015326]];
    const HPE: [[f64; 3]; 3] = [[0.38971, 0.68898, -0.07868], [-0.22981, 1.18340, 0.04641], [0.0, 0.0, 1.0]];

    let degree = 1.0 - (-(adapting + 42.0) / 92.0).exp() / 3.6;
    let k4 = (1.0 / (5.0 * adapting + 1.0)).powi(4);
    let level = 0.2 * k4 * 5.0 * adapting + 0.1 * (1.0 - k4).powi(2) * (5.0 * adapting).cbrt();
    let n = 20.0 / white[1];
    let (induction, z) = (0.725 * n.powf(-0.2), 1.48 + n.sqrt());
    let cone_white = times(CAT02, white);
    let response = |xyz: [f64; 3]| {
        let cone = times(CAT02, xyz);
        let adapted = std::array::from_fn(|i| (white[1] * degree / cone_white[i] + 1.0 - degree) * cone[i]);
        times(HPE, times(CAT02_INVERSE, adapted)).map(|c| {
            let power = (level * c.abs() / 100.0).powf(0.42);
            400.0 * power / (power + 27.13) * c.signum() + 0.1
        })
    };
    let achromatic = |[r, g, b]: [f64; 3]| (2.0 * r + g + b / 20.0 - 0.305) * induction;
    let [r, g, b] = response(xyz);
    let (red, yellow) = (r - 12.0 * g / 11.0 + b / 11.0, (r + g - 2.0 * b) / 9.0);
    let hue = yellow.atan2(red);
    let eccentricity = 0.25 * ((hue + 2.0).cos() + 3.8);
    let t = 50000.0 / 13.0 * induction * eccentricity * red.hypot(yellow) / (r + g + 1.05 * b);
    let lightness = 100.0 * (achromatic([r, g, b]) / achromatic(response(white))).powf(0.69 * z);
    let chroma = t.powf(0.9) * (lightness / 100.0).sqrt() * (1.64 - 0.29_f64.powf(n)).powf(0.73);
    [lightness, chroma * level.powf(0.25), hue]
}

/// CAM02-UCS (Luo, Cui & Li 2006) under the viewing conditions of sRGB: the space in which viridis and its
/// sisters were made.
fn ucs(color: [f64; 3]) -> [f64; 3] {
    let [j, m, hue] = cam02(xyz(color), xyz([1.0; 3]), 64.0 / std::f64::consts::PI / 5.0);
    let m = (1.0 + 0.0228 * m).ln() / 0.0228;
    [1.7 * j / (1.0 + 0.007 * j), m * hue.cos(), m * hue.sin()]
}

/// Oklab, forwards (Ottosson 2020, with the matrices of 2021).
fn oklab(color: [f64; 3]) -> [f64; 3] {
    const TO_CONES: [[f64; 3]; 3] = [
        [0.4122214708, 0.5363325363, 0.0514459929],
        [0.2119034982, 0.6806995451, 0.1073969566],
        [0.0883024619, 0.2817188376, 0.6299787005],
    ];
    const FROM_CONES: [[f64; 3]; 3] = [
        [0.2104542553, 0.7936177850, -0.0040720468],
        [1.9779984951, -2.4285922050, 0.4505937099],
        [0.0259040371, 0.7827717662, -0.8086757660],
    ];
    times(FROM_CONES, times(TO_CONES, color.map(srgb::decode)).map(f64::cbrt))
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
}

/// Lengths of equal steps along a map, the smallest and the largest as parts of the mean.
fn spread(map: Colormap, steps: u32, space: fn([f64; 3]) -> [f64; 3]) -> [f64; 2] {
    let at = |k: u32| space(map.color(f64::from(k) / f64::from(steps)));
    let lengths: Vec<f64> = (0..steps).map(|k| distance(at(k), at(k + 1))).collect();
    let mean = lengths.iter().sum::<f64>() / f64::from(steps);
    [
        lengths.iter().copied().fold(f64::INFINITY, f64::min) / mean,
        lengths.iter().copied().fold(0.0, f64::max) / mean,
    ]
}

#[test]
fn the_ruler_agrees_with_its_standard() {
    // CIE 159:2004, worked example.
    let [j, m, hue] = cam02([19.01, 20.0, 21.78], [95.05, 100.0, 108.88], 318.31);
    assert!((j - 41.73).abs() < 0.005 && (m - 0.1088).abs() < 5e-5, "{j} {m}");
    assert!((hue.to_degrees() + 360.0 - 219.05).abs() < 0.01, "{}", hue.to_degrees());
}

#[test]
fn viridis_and_its_sisters_are_uniform() {
    for map in [Colormap::Viridis, Colormap::Magma, Colormap::Inferno, Colormap::Plasma] {
        // 17 steps end at published colours (255 = 17 · 15). They were made uniform to 2 %, and rounded to
        // 8 bits: half a step of three components is 0.25 of CAM02-UCS, at either end of a length of 7 to 9.
        let [low, high] = spread(map, 17, ucs);
        assert!(low > 0.95 && high < 1.05, "{map:?} {low} {high}");
    }
    // As published, its darkest quarter has steps 25 % shorter; the fit lengthens others by 18 %.
    let [low, high] = spread(Colormap::Cividis, 17, ucs);
    assert!(low > 0.74 && high < 1.18, "{low} {high}");
}

#[test]
fn grey_is_uniform_in_lightness() {
    let [low, high] = spread(Colormap::Grey, 100, lab);
    // The matrix of sRGB has four digits.
    assert!(low > 0.999 && high < 1.001, "{low} {high}");
    assert!((lab(Colormap::Grey.color(0.5))[0] - 65.0).abs() < 1e-3);
}

#[test]
fn hue_is_a_circle_of_constant_lightness_and_chroma() {
    for k in 0..720 {
        let t = f64::from(k) / 720.0;
        let color = Colormap::Hue.color(t);
        assert!(color.iter().all(|c| (0.0..=1.0).contains(c)), "{t} {color:?}");
        let [l, a, b] = oklab(color);
        // The matrices there and back have ten digits.
        assert!((l - 0.75).abs() < 1e-7 && (a.hypot(b) - 0.127).abs() < 1e-7, "{t} {l} {}", a.hypot(b));
    }
    let [low, high] = spread(Colormap::Hue, 360, oklab);
    assert!(low > 0.99999 && high < 1.00001, "{low} {high}");
    assert_eq!(Colormap::Hue.color(0.0), Colormap::Hue.color(1.0));
    assert!(distance(Colormap::Hue.color(-1e-300), Colormap::Hue.color(0.0)) < 1e-12);
}

#[test]
fn order_is_seen_without_colour() {
    for map in SEQUENTIAL {
        for k in 0..51 {
            let at = |k: u32| ucs(map.color(f64::from(k) / 51.0))[0];
            assert!(at(k + 1) > at(k) + 0.8, "{map:?} {k}: {} {}", at(k), at(k + 1));
        }
    }
}

#[test]
fn ends_are_those_that_were_published() {
    // https://bids.github.io/colormap, and CIE for the white.
    for (map, first, last) in [
        (Colormap::Viridis, [0.267004, 0.004874, 0.329415], [0.993248, 0.906157, 0.143936]),
        (Colormap::Magma, [0.001462, 0.000466, 0.013866], [0.987053, 0.991438, 0.749504]),
        (Colormap::Inferno, [0.001462, 0.000466, 0.013866], [0.988362, 0.998364, 0.644924]),
        (Colormap::Plasma, [0.050383, 0.029803, 0.527975], [0.940015, 0.975158, 0.131326]),
        (Colormap::Grey, [0.278, 0.278, 0.278], [1.0, 1.0, 1.0]),
    ] {
        for (t, published) in [(0.0, first), (1.0, last)] {
            let color = map.color(t);
            // Half a step of 8 bits.
            assert!((0..3).all(|i| (color[i] - published[i]).abs() < 0.5 / 255.0), "{map:?} {color:?}");
        }
    }
}

#[test]
fn maps_are_continuous() {
    for map in SEQUENTIAL.into_iter().chain([Colormap::Hue]) {
        for k in 0..10000 {
            let (a, b) = (map.color(f64::from(k) / 10000.0), map.color(f64::from(k + 1) / 10000.0));
            // No component changes by more than 9 of its 256 steps between two listed colours.
            assert!((0..3).all(|i| (a[i] - b[i]).abs() <= 9.0 / 10000.0 + 1e-12), "{map:?} {k}");
        }
    }
}

#[test]
fn any_number_has_a_colour() {
    for map in SEQUENTIAL {
        assert_eq!(map.color(f64::NEG_INFINITY), map.color(0.0));
        assert_eq!(map.color(-1e300), map.color(0.0));
        assert_eq!(map.color(f64::INFINITY), map.color(1.0));
        assert_eq!(map.color(1.0 + 1e-16), map.color(1.0));
        assert_eq!(map.color(f64::NAN), NO_VALUE);
    }
    for nowhere in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(Colormap::Hue.color(nowhere), NO_VALUE);
    }
    for far in [1e300, -1e300, f64::MAX, f64::MIN_POSITIVE] {
        assert!(Colormap::Hue.color(far).iter().all(|c| (0.0..=1.0).contains(c)));
    }
}

#[test]
fn no_value_looks_like_no_value_of_the_map() {
    for map in SEQUENTIAL.into_iter().chain([Colormap::Hue]) {
        for k in 0..=1000 {
            let difference = distance(lab(map.color(f64::from(k) / 1000.0)), lab(NO_VALUE));
            assert!(difference > 12.0, "{map:?} {k} {difference}");
        }
    }
}

#[test]
fn scenes_spell_them_in_lower_case() {
    for (map, word) in [(Colormap::Viridis, "\"viridis\""), (Colormap::Hue, "\"hue\"")] {
        assert_eq!(serde_json::to_string(&map).unwrap(), word);
        assert_eq!(serde_json::from_str::<Colormap>(word).unwrap(), map);
    }
    assert_eq!(Colormap::default(), Colormap::Viridis);
}
