//! A disk around a Kerr hole as the light of a picture.

use super::canvas::CHANNELS;
use super::matter::Profile;
use super::picture::{Fineness, Painter, Setting, Unseen};
use super::screen::Projection;
use crate::model::{Cancelled, Freedom, Parameter, Prediction, Source, Unpredictable};
use crate::prior::Prior;

/// What a disk's parameters are called.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Kind {
    /// Page & Thorne's flux.
    PageThorne,
    /// r^−q.
    PowerLaw,
}

impl Kind {
    /// F(r), with the index of a power law.
    pub(super) fn profile(self, index: f64) -> Profile {
        match self {
            Self::PageThorne => Profile::PageThorne,
            Self::PowerLaw => Profile::PowerLaw { index },
        }
    }
}

/// A thin disk on circular geodesics, in the light of all frequencies, I = g⁴F/π.
#[derive(Debug)]
pub struct Disk {
    kind: Kind,
    painter: Painter,
}

/// The closest that a hole's spin comes to 1.
const MOST_SPIN: f64 = 0.998;

/// Up to this inclination, radians, turning the axis about the line of sight changes less than what lines are off by; the change is
/// that of pictures this far to both sides, radians.
const FACE_ON: f64 = 5e-3;
const ASIDE: f64 = 1e-2;

impl Disk {
    /// An opaque disk, or one that holds nothing back.
    pub fn new(kind: Kind, opaque: bool, projection: Projection, fineness: Fineness) -> Self {
        Self { kind, painter: Painter::new(projection, opaque, fineness) }
    }

    fn setting(&self, values: &[f64], size: [usize; 2]) -> Result<Setting, Unpredictable> {
        let (Some([spin, common @ ..]), index) = (values.first_chunk::<9>(), values.get(9)) else {
            return Err(Unpredictable("too few parameters".to_owned()));
        };
        let profile = self.kind.profile(index.copied().unwrap_or_default());
        Ok(Setting::of(*spin, *common, profile, size))
    }

    /// The change with the position angle χ, per radian, of a disk that is seen nearly face-on: with the axis at
    /// v = 2 tan(i/2) (cos χ, sin χ) it is |v| times that with v across.
    fn turned(&self, setting: &Setting) -> Result<Vec<f64>, Unseen> {
        let reach = 2.0 * (0.5 * setting.inclination).tan();
        let (sin, cos) = setting.frame.position_angle.sin_cos();
        let aside = |step: f64| {
            let [x, y] = [reach * cos - step * sin, reach * sin + step * cos];
            let mut setting = *setting;
            setting.inclination = 2.0 * (0.5 * x.hypot(y)).atan();
            setting.frame.position_angle = y.atan2(x);
            self.painter.draw(&setting, false)
        };
        let [left, right] = [aside(ASIDE)?, aside(-ASIDE)?];
        let both = left.pixels().iter().zip(right.pixels());
        Ok(both.map(|(left, right)| reach * (left[0] - right[0]) / (2.0 * ASIDE)).collect())
    }

    /// The channel of each parameter, and the factor of its derivative.
    fn channels(&self, values: &[f64]) -> Vec<(usize, f64)> {
        let degree = 1f64.to_radians();
        let mut channels = vec![
            (1, 1.0),
            (2, degree),
            (10, degree),
            (7, 1.0),
            (8, 1.0),
            (9, 1.0),
            (3, -values[6].powi(-2)),
            (4, 1.0),
            (5, 1.0),
        ];
        if self.kind == Kind::PowerLaw {
            channels.push((6, 1.0));
        }
        channels
    }
}

impl Source for Disk {
    fn parameters(&self) -> Vec<Parameter> {
        let free = Freedom::Free;
        let parameter = |name, unit: &'static str, meaning, bounds, usual| {
            let pixels = match unit {
                "px" => 1,
                "M/px" => -1,
                _ => 0,
            };
            Parameter { name, unit, meaning, bounds, pixels, usual }
        };
        let mut parameters = vec![
            parameter(
                "spin",
                "",
                "a, the disk turning about +z: below 0 it goes against the hole",
                [-MOST_SPIN, MOST_SPIN],
                free(Prior::Uniform(-MOST_SPIN, MOST_SPIN)),
            ),
            parameter(
                "inclination",
                "deg",
                "from the axis that the disk turns about to the observer: beyond 90 it turns clockwise",
                [0.0, 180.0],
                free(Prior::Isotropic(0.0, 180.0)),
            ),
            parameter(
                "position_angle",
                "deg",
                "of the projected axis, East of North: anticlockwise from up",
                [0.0, 360.0],
                free(Prior::Uniform(0.0, 360.0)),
            ),
            parameter(
                "scale",
                "M/px",
                "M in a pixel, at the hole's distance",
                [1e-4, 1e3],
                free(Prior::LogUniform(1e-4, 1e3)),
            ),
            parameter(
                "center_x",
                "px",
                "the direction of the hole, to the right of the picture's middle",
                [-1e4, 1e4],
                free(Prior::Uniform(-1e4, 1e4)),
            ),
            parameter("center_y", "px", "the same, up", [-1e4, 1e4], free(Prior::Uniform(-1e4, 1e4))),
            // Not known unless it is given: to where pictures no longer change with it.
            parameter(
                "distance",
                "M",
                "r of the observer",
                [20.0, f64::INFINITY],
                free(Prior::LogUniform(40.0, 1e4)),
            ),
            parameter(
                "inner",
                "r_ISCO",
                "inner radius, in that of the last stable orbit",
                [1.0, 50.0],
                Freedom::Fixed(1.0),
            ),
            parameter("outer", "M", "outer radius", [1.0, f64::INFINITY], Freedom::Fixed(f64::INFINITY)),
        ];
        if self.kind == Kind::PowerLaw {
            parameters.push(parameter(
                "index",
                "",
                "q of the flux r^−q",
                [-2.0, 10.0],
                free(Prior::Uniform(0.0, 6.0)),
            ));
        }
        parameters
    }

    fn draw(&self, values: &[f64], size: [usize; 2], derivatives: bool) -> Result<Prediction, Unpredictable> {
        let setting = self.setting(values, size)?;
        let unseen = |_| {
            let [spin, inclination, scale, distance] = [0, 1, 3, 6].map(|k| values[k]);
            Unpredictable(format!(
                "a disk of spin {spin:.4}, seen from {inclination:.3}°, {distance} M away, {scale:.4} M a pixel"
            ))
        };
        let canvas = self.painter.draw(&setting, derivatives).map_err(unseen)?;
        let channel = |channel: usize, factor: f64| -> Vec<f64> {
            debug_assert!(channel < CHANNELS);
            canvas.pixels().iter().map(|pixel| factor * pixel[channel]).collect()
        };
        let mut prediction = Prediction { values: channel(0, 1.0), derivatives: Vec::new() };
        if derivatives {
            prediction.derivatives =
                self.channels(values).into_iter().map(|(at, factor)| channel(at, factor)).collect();
            if setting.inclination < FACE_ON {
                let turned = self.turned(&setting).map_err(unseen)?;
                prediction.derivatives[2] = turned.into_iter().map(|t| t * 1f64.to_radians()).collect();
            }
        }
        if prediction.values.iter().all(|value| value.is_finite()) {
            Ok(prediction)
        } else {
            Err(unseen(Unseen))
        }
    }

    fn starts(&self, values: &[f64], size: [usize; 2], cancelled: Cancelled<'_>) -> Vec<Vec<f64>> {
        super::start::find(values, size, cancelled)
            .into_iter()
            .map(|found| {
                let mut start = vec![
                    found.spin,
                    found.inclination,
                    found.position_angle,
                    found.scale,
                    found.center[0],
                    found.center[1],
                    1000.0,
                    1.0,
                    f64::INFINITY,
                ];
                if self.kind == Kind::PowerLaw {
                    start.push(3.0);
                }
                start
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The change with the roll near face-on, which is that of pictures aside, goes over into that of the lines: over the inclination both
    /// are the same to what lines are off by, 1e-3 of the brightest over 5e-3 rad and less in the mean.
    #[test]
    fn turning_is_smooth_towards_face_on() {
        let disk = Disk::new(Kind::PageThorne, true, Projection::Angular, Fineness::default());
        let turned = |inclination: f64| {
            let values = [0.6, inclination, 25.0, 0.9, 0.3, -0.2, 1000.0, 1.0, f64::INFINITY];
            let drawn = disk.draw(&values, [32, 32], true).unwrap();
            drawn.derivatives[2].iter().map(|d| d / inclination).collect::<Vec<f64>>()
        };
        let limit = FACE_ON.to_degrees();
        let [aside, lines, far] = [0.98 * limit, 1.02 * limit, 1e-3 * limit].map(turned);
        let size = |d: &[f64]| d.iter().map(|d| d * d).sum::<f64>().sqrt();
        let off =
            |a: &[f64], b: &[f64]| size(&a.iter().zip(b).map(|(a, b)| a - b).collect::<Vec<_>>()) / size(b);
        println!("{:.1e} {:.1e}", off(&aside, &lines), off(&far, &aside));
        assert!(off(&aside, &lines) < 0.05 && off(&far, &aside) < 0.02);
    }
}
