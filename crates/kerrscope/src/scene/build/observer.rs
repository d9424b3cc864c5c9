//! The observer: a place and a motion that is possible there.

use kerrscope_spacetime::observer::{Motion, ObserverError, Place, check};

use super::{Builder, SPACETIME, coordinates, readable};
use crate::scene::file::{self, MotionName, RelativeTo, SceneFile, ScreenKind};
use crate::scene::valid::{Observer, Spacetime};

/// The keys that fix where the observer is.
const PLACE: [&str; 4] =
    ["observer.distance", "observer.position", "observer.inclination", "observer.azimuth"];

impl Builder<'_> {
    pub(super) fn observer(&mut self, file: &SceneFile, spacetime: &Spacetime) -> Observer {
        let place = self.place(&file.observer, spacetime);
        if place.r.is_infinite() && file.screen.kind != ScreenKind::Impact {
            let kind = if file.screen.kind == ScreenKind::Pinhole { "pinhole" } else { "angular" };
            self.fault(
                &["observer.distance", "screen.kind"],
                format!(
                    "from an infinite distance everything has the angle 0, \
                     and `screen.kind = \"{kind}\"` shows nothing"
                ),
                "set `screen.kind = \"impact\"` and `screen.field_of_view` in M, \
                 or give a finite distance",
            );
        }
        let motion = match &file.observer.motion {
            file::Motion::Named(MotionName::Static) => Motion::Static,
            file::Motion::Named(MotionName::Zamo) => Motion::ZeroAngularMomentum,
            file::Motion::Named(MotionName::Orbit) => Motion::Orbit,
            file::Motion::Named(MotionName::Fall) => Motion::Fall,
            file::Motion::Velocity(velocity) => Motion::Velocity(*velocity),
            file::Motion::Relative(file::Velocity { velocity, relative_to }) => match relative_to {
                RelativeTo::Zamo => Motion::Velocity(*velocity),
                RelativeTo::Fall => Motion::VelocityFromFall(*velocity),
            },
        };
        self.motion(spacetime, place, motion);
        Observer { place, motion }
    }

    fn place(&mut self, file: &file::Observer, spacetime: &Spacetime) -> Place {
        let Some(position) = file.position else {
            return Place {
                r: file.distance.unwrap_or_default(),
                theta: file.inclination.unwrap_or_default().to_radians(),
                phi: file.azimuth.unwrap_or_default().to_radians(),
            };
        };
        let others =
            [("distance", file.distance), ("inclination", file.inclination), ("azimuth", file.azimuth)];
        let others: Vec<String> =
            others.iter().filter(|(_, value)| value.is_some()).map(|(key, _)| format!("`{key}`")).collect();
        if !others.is_empty() {
            self.fault(
                &["observer.position"],
                format!("`observer.position` and {} both say where the observer is", others.join(", ")),
                "keep either `position`, or `distance`, `inclination` and `azimuth`",
            );
        }
        coordinates::from_kerr_schild(spacetime.spin(), position)
    }

    fn motion(&mut self, spacetime: &Spacetime, place: Place, motion: Motion) {
        let with = |first: &[&'static str]| [first, &PLACE, &["observer.motion"], &SPACETIME].concat();
        if spacetime.spin().is_none() && place.r == 0.0 {
            self.fault(
                &with(&[]),
                "the observer is at the origin of the coordinates",
                "move it: the origin has no inward direction to look in",
            );
            return;
        }
        let checked = match spacetime {
            Spacetime::Text(element) if place.r.is_infinite() && element.outer().is_finite() => {
                Err(ObserverError::OutOfReach { r: place.r, outer: element.outer() })
            }
            Spacetime::Text(_) if place.r.is_finite() => spacetime.observer(place, motion).map(|_| ()),
            _ => check(spacetime.spin(), &place, &motion),
        };
        let Err(error) = checked else {
            return;
        };
        let (keys, mend) = match &error {
            ObserverError::StaticInErgosphere { limit, .. } => {
                let limit = readable(*limit);
                let mend = format!(
                    "move the observer beyond r = {limit}, \
                     or set `observer.motion` to \"zamo\" or \"fall\""
                );
                (with(&[]), mend)
            }
            ObserverError::InsideHorizon { horizon, .. } => {
                let horizon = readable(*horizon);
                let mend =
                    format!("move the observer beyond r = {horizon}, or set `observer.motion = \"fall\"`");
                (with(&[]), mend)
            }
            ObserverError::InsideInnerHorizon { inner_horizon, .. } => {
                let mend = format!("move the observer beyond r = {}", readable(*inner_horizon));
                (with(&[]), mend)
            }
            ObserverError::OrbitOffPlane { .. } => {
                let mend = match self.root.at("observer.position") {
                    Some(_) => "set z = 0 in `observer.position`, or choose another motion",
                    None => "set `observer.inclination = 90`, or choose another motion",
                };
                (with(&["observer.motion"]), mend.to_owned())
            }
            ObserverError::NoOrbit { photon, .. } => {
                let mend =
                    format!("move the observer beyond r = {}, or choose another motion", readable(*photon));
                (with(&["observer.motion"]), mend)
            }
            ObserverError::FasterThanLight { .. } => {
                let mend = "give a velocity [r, θ, φ] in units of c whose length is below 1";
                (vec!["observer.motion.velocity", "observer.motion"], mend.to_owned())
            }
            ObserverError::NothingToOrbit => {
                let mend = "choose another motion, such as \"static\"";
                (vec!["observer.motion", "spacetime.name"], mend.to_owned())
            }
            ObserverError::MovingAtInfinity => {
                let mend = "set `observer.motion = \"static\"`, or give a finite distance";
                (with(&["observer.motion"]), mend.to_owned())
            }
            ObserverError::NotStatic { .. } => {
                let mend = "move the observer outwards, or set `observer.motion = \"zamo\"`".to_owned();
                (with(&[]), mend)
            }
            ObserverError::NoTetrad { .. } | ObserverError::InsideThroat { .. } => {
                (with(&[]), "move the observer outwards".to_owned())
            }
            ObserverError::OutOfReach { outer, .. } => {
                (with(&[]), format!("move the observer within r = {}", readable(*outer)))
            }
            ObserverError::OnlyAroundKerr => {
                let mend = "choose \"static\" or \"zamo\", or a velocity [r, θ, φ] in units of c";
                (vec!["observer.motion", "spacetime.name"], mend.to_owned())
            }
            // Told of single photons and of directions, which are not asked for here.
            ObserverError::NoSuchPhoton { .. } | ObserverError::AtInfinity => {
                (with(&[]), "move the observer".to_owned())
            }
        };
        self.fault(&keys, error.to_string(), mend);
    }
}
