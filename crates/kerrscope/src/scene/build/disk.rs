//! The disk.

use std::sync::Arc;

use kerrscope_spacetime::emitter::{Circular, CircularError, Sense};
use kerrscope_spacetime::kerr::Orbits;
use kerrscope_spacetime::metric::Text;

use super::{Builder, readable};
use crate::disk::{Glow, Profile, Shifts};
use crate::scene::file::{self, DISK_USES, DiskModel, Inner, Shown, Turns};
use crate::scene::valid::{Disk, Spacetime, Surface};
use crate::units::Units;

const SPACETIME: [&str; 3] = ["spacetime.spin", "spacetime.name", "spacetime.parameters"];

impl Builder<'_> {
    pub(super) fn disk(&mut self, file: &file::Disk, spacetime: &Spacetime, units: Units) -> Option<Disk> {
        // A disk that is put away keeps what it has.
        if file.model == DiskModel::None {
            return None;
        }
        for (key, models) in DISK_USES {
            let key = format!("disk.{key}");
            if !models.contains(&file.model) && self.root.at(&key).is_some() {
                self.unused(&key, "disk.model", models);
            }
        }
        let shifts = Shifts {
            doppler: file.doppler.unwrap_or_default(),
            gravitational: file.gravitational.unwrap_or_default(),
            beaming: file.beaming.unwrap_or_default(),
        };
        let needed = file.model.shines()
            || !shifts.is_none()
            || file.time.is_some()
            || matches!(file.inner, Inner::Isco(_));
        let orbits = if needed { self.orbits(file, spacetime) } else { None };
        let inner = self.inner_edge(file, spacetime, orbits.as_deref());
        let surface = match file.model {
            DiskModel::None | DiskModel::Ring => Surface::Ring { seed: file.seed },
            DiskModel::Image => Surface::Picture {
                path: self.picture("disk.image", "disk.model", "image", file.image.as_deref()),
                mapping: file.mapping.unwrap_or_default(),
            },
            DiskModel::PageThorne | DiskModel::PowerLaw | DiskModel::Profile => {
                let profile = self.profile(file, orbits.as_ref(), spacetime)?;
                let glow = self.glow(file, &profile, [inner, file.outer], units)?;
                Surface::Shining { profile, limb: file.limb.unwrap_or_default(), glow }
            }
        };
        Some(Disk {
            inner,
            outer: file.outer,
            tilt: file.tilt.to_radians(),
            node: file.node.to_radians(),
            surface,
            color: file.color,
            brightness: file.brightness,
            opacity: file.opacity,
            thin: file.optically_thin,
            orbits,
            shifts,
            orders: file.orders.clone(),
            time: file.time,
        })
    }

    /// The circular orbits in the disk's plane. None in flat space, or if there are none, which is told.
    fn orbits(&mut self, file: &file::Disk, spacetime: &Spacetime) -> Option<Arc<Circular>> {
        let sense = match file.turns {
            Turns::Prograde => Sense::Prograde,
            Turns::Retrograde => Sense::Retrograde,
        };
        let level = file.tilt == 0.0 || file.tilt == 180.0;
        let upright = if file.tilt > 90.0 { -1.0 } else { 1.0 };
        let moves = file.model.shines()
            || file.time.is_some()
            || [file.doppler, file.gravitational].contains(&Some(true));
        if !level && moves && !spacetime.is_flat() && spacetime.spin() != Some(0.0) {
            self.fault(
                &["disk.tilt", "disk.model", "spacetime.name"],
                "matter goes in circles in the equatorial plane only, and the disk is tilted",
                "leave out `disk.tilt`, or draw it as it is: `disk.model = \"ring\"` without shifts",
            );
            return None;
        }
        match spacetime {
            Spacetime::Minkowski => None,
            // In a tilted plane around a hole that turns only the radius of the equator's last orbit is used.
            Spacetime::Schwarzschild => Some(Arc::new(Circular::kerr(0.0, sense))),
            Spacetime::Kerr { spin } => Some(Arc::new(Circular::kerr(spin * upright, sense))),
            Spacetime::Text(element) => {
                let sense = if upright > 0.0 { sense } else { sense.other() };
                match Circular::of(&Text::new(element), sense, file.outer) {
                    Ok(orbits) => Some(Arc::new(orbits)),
                    Err(reason) => {
                        let mend = match reason {
                            CircularError::NoOrbits { .. } => {
                                "give `disk.outer` a larger radius, or draw the disk: `disk.model = \"ring\"` with `disk.inner` a radius in M"
                            }
                            _ => {
                                "draw the disk, `disk.model = \"ring\"`, with `disk.inner` a radius in M, or leave it out"
                            }
                        };
                        self.fault(&["disk.model", "disk.inner", "spacetime.name"], reason.to_string(), mend);
                        self.removed.push("disk".to_owned());
                        None
                    }
                }
            }
        }
    }

    fn profile(
        &mut self,
        file: &file::Disk,
        orbits: Option<&Arc<Circular>>,
        spacetime: &Spacetime,
    ) -> Option<Profile> {
        match (file.model, orbits, &file.profile) {
            (DiskModel::PowerLaw, ..) => Some(Profile::PowerLaw { index: file.index.unwrap_or_default() }),
            (DiskModel::PageThorne, Some(orbits), _) => {
                if orbits.isco().is_none() {
                    self.fault(
                        &["disk.model", "spacetime.name"],
                        "all circular orbits are stable here, so that matter need not give its energy away to fall",
                        "choose another model, such as `disk.model = \"power-law\"`",
                    );
                    return None;
                }
                Some(Profile::PageThorne(Arc::clone(orbits)))
            }
            (DiskModel::PageThorne, None, _) => {
                if spacetime.is_flat() {
                    self.fault(
                        &["disk.model", "spacetime.name"],
                        "nothing orbits in flat space, and `disk.model = \"page-thorne\"` shines by what falls",
                        "choose another model, such as `disk.model = \"power-law\"`",
                    );
                }
                None
            }
            (_, _, Some(knots)) => {
                if knots.windows(2).any(|pair| pair[1][0] <= pair[0][0]) {
                    self.fault(
                        &["disk.profile"],
                        "the radii of `disk.profile` do not grow",
                        "order its points [r, F] by their radii, each larger than the one before",
                    );
                    return None;
                }
                Some(Profile::Knots(knots.clone()))
            }
            (_, _, None) => {
                self.fault(
                    &["disk.model"],
                    "`disk.model = \"profile\"` needs `disk.profile`",
                    "give it points, such as disk.profile = [[6, 0], [9, 1], [20, 0.1]]",
                );
                None
            }
        }
    }

    fn glow(
        &mut self,
        file: &file::Disk,
        profile: &Profile,
        [inner, outer]: [f64; 2],
        units: Units,
    ) -> Option<Glow> {
        if file.light != Some(Shown::Blackbody) {
            // Whoever looks at all of the light keeps the temperature for when colours are looked at again.
            return Some(Glow::Bolometric);
        }
        let hottest = match (file.temperature, file.accretion_rate) {
            (Some(_), Some(_)) => {
                self.fault(
                    &["disk.accretion_rate", "disk.temperature"],
                    "`disk.accretion_rate` and `disk.temperature` both say how hot the disk is",
                    "keep one of the two",
                );
                return None;
            }
            (Some(temperature), None) => temperature,
            (None, Some(rate)) => {
                let Some(temperature) = units.temperature(profile.peak(inner, outer), rate) else {
                    self.fault(
                        &["disk.accretion_rate"],
                        "how hot a rate of accretion makes the disk depends on the mass of the hole",
                        "give `units.mass` in solar masses, or `disk.temperature` instead",
                    );
                    return None;
                };
                temperature
            }
            (None, None) => return None,
        };
        let correction = file.color_correction.unwrap_or(1.0);
        Some(Glow::Blackbody { hottest, correction, frequency: units.frequency })
    }

    fn inner_edge(&mut self, file: &file::Disk, spacetime: &Spacetime, orbits: Option<&Circular>) -> f64 {
        let inner = match (file.inner, orbits.map(Circular::isco)) {
            (Inner::Radius(inner), _) => inner,
            (Inner::Isco(_), Some(Some(isco))) => isco,
            (Inner::Isco(_), None) if !spacetime.is_flat() => return 0.0,
            (Inner::Isco(_), found) => {
                let what = if found.is_some() {
                    "all circular orbits are stable here: there is no last one for `disk.inner = \"isco\"`"
                } else {
                    "in flat space there is no innermost stable orbit for `disk.inner = \"isco\"`"
                };
                self.fault(
                    &["disk.inner", "disk.model", "spacetime.name"],
                    what,
                    "give `disk.inner` a radius in M, or set `disk.model = \"none\"`",
                );
                return 0.0;
            }
        };
        let horizon = match spacetime {
            Spacetime::Text(element) if !element.has_throat() => Some(element.horizon()),
            _ => spacetime.spin().map(|spin| Orbits::new(spin).horizon),
        };
        if let (Inner::Radius(_), Some(horizon)) = (file.inner, horizon)
            && inner <= horizon
        {
            let horizon = readable(horizon);
            self.fault(
                &[&["disk.inner"][..], &SPACETIME].concat(),
                format!("the disk's inner edge {inner} is not outside the horizon at r = {horizon}"),
                format!("give `disk.inner` more than {horizon}, or \"isco\""),
            );
        }
        if inner >= file.outer {
            let shown = readable(inner);
            let named = if let Inner::Isco(_) = file.inner { ", the isco" } else { "" };
            self.fault(
                &[&["disk.outer", "disk.inner"][..], &SPACETIME].concat(),
                format!("the disk's outer edge {} is not outside its inner edge {shown}{named}", file.outer),
                format!("give `disk.outer` more than {shown}, or a smaller `disk.inner`"),
            );
        }
        inner
    }
}
