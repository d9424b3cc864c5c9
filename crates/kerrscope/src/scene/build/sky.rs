//! The sky.

use super::Builder;
use crate::scene::file::{self, ImageFrame, SKY_USES, SkyKind};
use crate::scene::valid::{Sky, SkyPicture, Spacetime};
use crate::sky::{Frame, Orientation};

impl Builder<'_> {
    /// The sky on the other side of a throat; like this one if nothing is said of it.
    pub(super) fn other_sky(&mut self, scene: &file::SceneFile, spacetime: &Spacetime) -> Option<Sky> {
        let file = scene.other_sky.as_ref();
        if spacetime.has_throat() {
            return Some(
                self.sky(file.unwrap_or(&scene.sky), if file.is_some() { "other_sky" } else { "sky" }),
            );
        }
        if file.is_some() {
            self.fault(
                &["other_sky", "spacetime.name"],
                "[other_sky] is that on the other side of a wormhole, and this spacetime has none",
                "remove it, or choose a `spacetime.name` such as \"ellis\"",
            );
        }
        None
    }

    /// The sky of a section.
    pub(super) fn sky(&mut self, file: &file::Sky, section: &str) -> Sky {
        self.unused_of_sky(file, section);
        let key = |key: &str| format!("{section}.{key}");
        let color = file.color.unwrap_or_default();
        let picture = match file.kind {
            SkyKind::Black => SkyPicture::Black,
            SkyKind::Uniform => SkyPicture::Uniform { color },
            SkyKind::Gradient => {
                SkyPicture::Gradient { horizon: color, zenith: file.zenith.unwrap_or_default() }
            }
            SkyKind::Grid => SkyPicture::Grid { color, spacing: self.spacing(file, section).to_radians() },
            SkyKind::Panorama => SkyPicture::Panorama {
                path: self.picture(&key("image"), &key("kind"), "panorama", file.image.as_deref()),
                orientation: orientation(
                    file,
                    match file.image_frame.unwrap_or_default() {
                        ImageFrame::Scene => None,
                        ImageFrame::Galactic => Some(Frame::Galactic),
                        ImageFrame::Equatorial => Some(Frame::Equatorial),
                    },
                ),
            },
            SkyKind::Stars => SkyPicture::Stars { orientation: orientation(file, Some(Frame::Equatorial)) },
        };
        Sky { picture, brightness: file.brightness.unwrap_or(1.0) }
    }

    /// What is typed and has no effect.
    fn unused_of_sky(&mut self, file: &file::Sky, section: &str) {
        // A sky that is put away keeps its keys; with other kinds they may be a slip.
        if file.kind == SkyKind::Black {
            return;
        }
        for (key, kinds) in SKY_USES {
            let key = format!("{section}.{key}");
            if self.root.at(&key).is_some() && !kinds.contains(&file.kind) {
                self.unused(&key, &format!("{section}.kind"), kinds);
            }
        }
        if file.kind == SkyKind::Panorama
            && file.image_frame == Some(ImageFrame::Scene)
            && file.frame.is_some()
        {
            let drawn = [ImageFrame::Galactic, ImageFrame::Equatorial];
            self.unused(&format!("{section}.frame"), &format!("{section}.image_frame"), &drawn);
        }
    }

    /// The angle between the lines of a grid.
    fn spacing(&mut self, file: &file::Sky, section: &str) -> f64 {
        let spacing = file.spacing.unwrap_or_default();
        let lines = 90.0 / spacing;
        if (lines - lines.round()).abs() > 1e-9 * lines {
            // 90 divided by these is written with few digits, as 90/13 is not.
            let short = |lines: &u32| 9_000_000 % lines == 0;
            let below = (lines.ceil() as u32..=900).find(short).unwrap_or(900);
            let above = (1..=lines.floor() as u32).rev().find(short).unwrap_or(1);
            let [below, above] = [below, above].map(|lines| 90.0 / f64::from(lines));
            self.fault(
                &[&format!("{section}.spacing"), &format!("{section}.kind")],
                format!("lines {spacing}° apart do not divide 90° into equal parts"),
                format!("give a divisor of 90 such as {below} or {above}"),
            );
        }
        spacing
    }
}

/// How a sky stands that is known in coordinates of its own, or in those of the scene.
fn orientation(file: &file::Sky, known: Option<Frame>) -> Orientation {
    let azimuth = file.longitude.unwrap_or_default().to_radians();
    known
        .map_or(Orientation::upright(azimuth), |known| {
            Orientation::celestial(known, file.frame.unwrap_or_default(), azimuth)
        })
        .turned(file.rotation.unwrap_or_default().map(f64::to_radians))
}
