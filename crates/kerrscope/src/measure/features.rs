//! Everything that is measured in one picture.

use serde::Serialize;

use super::shadow::Levels;
use super::{DiskEdge, Feature, Moments, Picture, PixelScale, Ring, Shadow};

/// What a picture shows. Places are right and up of its middle; lengths are in pixels, of which `pixel` tells the size.
///
/// ```
/// use kerrscope::measure::{Features, Picture};
/// // A disk of light from 20 to 40 pixels: each pixel's share of it, by 8 × 8 points.
/// let light = |x: f64, y: f64| f64::from(u8::from((20.0..40.0).contains(&x.hypot(y))));
/// let share = |k: usize| -> f64 {
///     let at = |k: usize, n: usize| k as f64 - 50.0 + (n as f64 + 0.5) / 8.0;
///     (0..64).map(|n| light(at(k % 100, n % 8), at(k / 100, n / 8))).sum::<f64>() / 64.0
/// };
/// let picture = Picture::of_values(100, 100, (0..10_000).map(share).collect())?;
/// let features = Features::of(&picture);
/// let shadow = features.shadow.found().unwrap();
/// assert!((shadow.diameter.value - 40.0).abs() < 0.05);
/// let disk = features.disk.found().unwrap();
/// assert!((disk.right.value - 40.0).abs() < 0.1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Features {
    /// Width and height in pixels.
    pub size: [usize; 2],
    /// How large a pixel is, as far as it is known.
    pub pixel: PixelScale,
    /// Whether ratios of values are ratios of light.
    pub trusted_brightness: bool,
    /// The dark region within the light.
    pub shadow: Feature<Shadow>,
    /// The ring of light.
    pub ring: Feature<Ring>,
    /// The outer edge of the disk.
    pub disk: Feature<DiskEdge>,
}

impl Features {
    /// Measures a picture.
    pub fn of(picture: &Picture) -> Self {
        let levels = Levels::of(picture);
        let objection = levels.objection(picture);
        let shadow = match &objection {
            Some(why) => Err(why.clone()),
            None => Shadow::of(picture, levels),
        };
        let ring = match (&objection, &shadow) {
            (Some(why), _) => Err(why.clone()),
            // What has no shadow may still be a blurred ring with some light within; noise is none.
            (None, Err(why)) => Err(format!("there is no shadow for it to be around: {why}")),
            (None, Ok(shadow)) => {
                let start = shadow.centre.map(|c| c.value);
                Ring::of(picture, levels, start, 0.25 * shadow.diameter.value)
            }
        };
        let disk = match &shadow {
            Ok(shadow) => DiskEdge::of(picture, levels, shadow),
            Err(_) => Err("there is no shadow to measure it from".to_owned()),
        };
        Self {
            size: [picture.width, picture.height],
            pixel: picture.pixel,
            trusted_brightness: picture.trusted_brightness,
            shadow: shadow.into(),
            ring: ring.into(),
            disk: disk.into(),
        }
    }

    /// Place and widths of all the light above zero, for pictures without any other feature.
    pub fn moments(picture: &Picture) -> Option<Moments> {
        let size = [picture.width, picture.height].map(|n| u32::try_from(n).unwrap_or(u32::MAX));
        Moments::of(size, 1.0, |pixel| picture.values[pixel].max(0.0))
    }
}
