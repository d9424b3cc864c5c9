//! The screen.

use kerrscope_spacetime::observer::{Motion, Place};

use super::Builder;
use crate::scene::file;
use crate::scene::valid::{Observer, Screen, ScreenKind, Spacetime};

impl Builder<'_> {
    pub(super) fn screen(
        &mut self,
        file: &file::Screen,
        spacetime: &Spacetime,
        observer: Observer,
    ) -> Screen {
        let height = file.field_of_view.unwrap_or_default();
        let mut too_high = |what: &str, mend: &str| {
            let what = format!("{what} cannot be {height}° high");
            self.fault(&["screen.field_of_view", "screen.kind"], what, mend);
        };
        let kind = match file.kind {
            file::ScreenKind::Pinhole => {
                if height >= 180.0 {
                    let mend = "give less than 180, or choose `screen.kind = \"angular\"`";
                    too_high("the flat picture of a pinhole", mend);
                }
                ScreenKind::Pinhole { height: height.to_radians() }
            }
            file::ScreenKind::Angular => {
                if height > 180.0 {
                    too_high("an angular picture", "give 180 or less");
                }
                ScreenKind::Angular { height: height.to_radians() }
            }
            file::ScreenKind::Impact => {
                // At infinity every observer has to be static; that is said of the observer.
                if observer.motion != Motion::Static && observer.place.r.is_finite() {
                    self.fault(
                        &["observer.motion", "screen.kind"],
                        "the impact parameters of `screen.kind = \"impact\"` are those that a static observer sees",
                        "set `observer.motion = \"static\"`, or choose `screen.kind` \"pinhole\" or \"angular\"",
                    );
                }
                if spacetime.text().is_some() && observer.place.r.is_finite() {
                    self.fault(
                        &["screen.kind", "observer.distance", "spacetime.name"],
                        "in a metric as text impact parameters are known at infinity only",
                        "set `observer.distance = inf`, or choose `screen.kind` \"pinhole\" or \"angular\"",
                    );
                }
                ScreenKind::Impact { height }
            }
        };
        if let Some(point) = file.look_at {
            self.look_at(file.kind, point, spacetime, observer.place);
        }
        Screen { kind, roll: file.roll.to_radians(), look_at: file.look_at }
    }

    fn look_at(&mut self, kind: file::ScreenKind, point: [f64; 3], spacetime: &Spacetime, place: Place) {
        if kind == file::ScreenKind::Impact {
            self.fault(
                &["screen.look_at", "screen.kind"],
                "`screen.look_at` has no meaning with `kind = \"impact\"`, which looks at the hole",
                "remove it, or choose `screen.kind` \"pinhole\" or \"angular\"",
            );
            return;
        }
        // Falling observers can be wherever there are any; of no place, nothing more is said.
        let motion = if spacetime.text().is_some() { Motion::ZeroAngularMomentum } else { Motion::Fall };
        let Ok(observer) = spacetime.observer(place, motion) else {
            return;
        };
        let eye = observer.position();
        let distance = (0..3).map(|i| (point[i] - eye[i]).powi(2)).sum::<f64>().sqrt();
        if distance <= 1e-9 * place.r.max(1.0) {
            self.fault(
                &[
                    "screen.look_at",
                    "observer.position",
                    "observer.distance",
                    "observer.inclination",
                    "observer.azimuth",
                    "spacetime.spin",
                    "spacetime.name",
                ],
                "`screen.look_at` is the observer's own place",
                "give another point, or remove it to look at the hole",
            );
        }
    }
}
