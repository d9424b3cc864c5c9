//! Disks that what is lit may be of.

use crate::fit::Image;
use crate::model::{Cancelled, Freedom};
use crate::traced::{self, Fineness, Frame, Outline, Painter, Profile, Projection, Setting, Template};

const SPINS: [f64; 3] = [-0.6, 0.3, 0.9];
const INCLINATIONS: [f64; 6] = [12.0, 38.0, 58.0, 73.0, 83.0, 88.0];
/// Outer radii, M, of disks that end within the picture.
const OUTERS: [f64; 5] = [5.0, 8.0, 12.0, 20.0, 35.0];
/// Widths of a picture in which a disk does not end, M, and by what a disk's may differ from what its outer radius makes it.
const WIDTHS: (f64, f64, i32) = (12.0, 1.35, 9);
const STRETCHES: [f64; 3] = [0.9, 1.0, 1.12];

/// All parameters of a disk's silhouette, the likeliest first. `freedoms` are theirs: what is known is kept.
pub fn find(
    image: &Image,
    outline: &Outline,
    projection: Projection,
    freedoms: &[Freedom],
    cancelled: Cancelled<'_>,
) -> Vec<Vec<f64>> {
    let known = |k: usize, usual: &[f64]| match freedoms.get(k) {
        Some(Freedom::Fixed(value)) => vec![*value],
        _ => usual.to_vec(),
    };
    let [width, height] = image.size;
    let outers = known(8, &OUTERS);
    let distance = known(6, &[1000.0])[0];
    let inner = known(7, &[0.7])[0];
    let inclination = |i: f64| if i > 90.0 { 180.0 - i } else { i };
    let mut templates = Vec::new();
    for spin in known(0, &SPINS) {
        for i in known(1, &INCLINATIONS) {
            for outer in &outers {
                let widths: Vec<f64> = if outer.is_finite() {
                    // About 1 M is added to a radius by the bending of its light.
                    let pixels = 2.0 * (outer + 1.0) / longest(image);
                    STRETCHES.map(|stretch| stretch * pixels * width.max(height) as f64).to_vec()
                } else {
                    (0..WIDTHS.2).map(|k| WIDTHS.0 * WIDTHS.1.powi(k)).collect()
                };
                for width in widths {
                    let setting = Setting {
                        spin,
                        inclination: inclination(i).to_radians(),
                        u: distance.recip(),
                        inner,
                        outer: *outer,
                        profile: Profile::Even,
                        frame: Frame { size: image.size, scale: 1.0, center: [0.0; 2], position_angle: 0.0 },
                    };
                    templates.push(Template { setting, width });
                }
            }
        }
    }
    let painter = Painter::new(projection, true, outline.fineness(Fineness::SKETCH));
    let found = traced::among(&image.values, image.size, &painter, &templates, cancelled);
    let bins = outline.bins;
    found
        .into_iter()
        .map(|start| {
            vec![
                start.spin,
                start.inclination,
                start.position_angle,
                start.scale / bins.factor,
                start.center[0] * bins.factor + bins.shift[0],
                start.center[1] * bins.factor + bins.shift[1],
                distance,
                inner,
                templates[start.template].setting.outer,
                0.0,
            ]
        })
        .collect()
}

/// Directions in which the longest is looked for.
const DIRECTIONS: usize = 36;

/// The length of what is lit across its longest direction, pixels.
fn longest(image: &Image) -> f64 {
    let [width, _] = image.size;
    let places: Vec<[f64; 2]> = (0..image.values.len())
        .filter(|pixel| image.values[*pixel] > 0.5)
        .map(|pixel| [(pixel % width) as f64, (pixel / width) as f64])
        .collect();
    (0..DIRECTIONS)
        .map(|k| {
            let (sin, cos) = (std::f64::consts::PI * k as f64 / DIRECTIONS as f64).sin_cos();
            let along = places.iter().map(|[x, y]| x * cos + y * sin);
            let (low, high) =
                along.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
            high - low + 1.0
        })
        .fold(1.0, f64::max)
}
