//! The disk.

use kerrscope_spacetime::kerr::Orbits;

use super::{Builder, readable};
use crate::scene::file::{self, DiskModel, Inner};
use crate::scene::valid::{Disk, Spacetime, Surface};

impl Builder<'_> {
    pub(super) fn disk(&mut self, file: &file::Disk, spacetime: &Spacetime) -> Option<Disk> {
        let surface = match file.model {
            // A disk that is put away keeps its picture.
            DiskModel::None => return None,
            DiskModel::Ring => {
                for (key, given) in
                    [("disk.image", file.image.is_some()), ("disk.mapping", file.mapping.is_some())]
                {
                    if given {
                        self.unused(key, "disk.model", &["image"]);
                    }
                }
                Surface::Ring { seed: file.seed }
            }
            DiskModel::Image => Surface::Picture {
                path: self.picture("disk.image", "disk.model", "image", file.image.as_deref()),
                mapping: file.mapping.unwrap_or_default(),
            },
        };
        Some(Disk {
            inner: self.inner_edge(file, spacetime),
            outer: file.outer,
            tilt: file.tilt.to_radians(),
            node: file.node.to_radians(),
            surface,
            color: file.color,
            brightness: file.brightness,
            opacity: file.opacity,
        })
    }

    fn inner_edge(&mut self, file: &file::Disk, spacetime: &Spacetime) -> f64 {
        let orbits = spacetime.spin().map(Orbits::new);
        let inner = match (file.inner, orbits) {
            (Inner::Radius(inner), _) => inner,
            (Inner::Isco(_), Some(orbits)) => orbits.isco,
            (Inner::Isco(_), None) if spacetime.text().is_some() => {
                self.fault(
                    &["disk.inner", "disk.model", "spacetime.name"],
                    "`disk.inner = \"isco\"` is known around Kerr holes only, and this spacetime is a text",
                    "give `disk.inner` a radius in M, or set `disk.model = \"none\"`",
                );
                return 0.0;
            }
            (Inner::Isco(_), None) => {
                self.fault(
                    &["disk.inner", "disk.model", "spacetime.name"],
                    "in flat space there is no innermost stable orbit for `disk.inner = \"isco\"`",
                    "give `disk.inner` a radius in M, or set `disk.model = \"none\"`",
                );
                return 0.0;
            }
        };
        let horizon = match spacetime {
            Spacetime::Text(element) if !element.has_throat() => Some(element.horizon()),
            _ => orbits.map(|orbits| orbits.horizon),
        };
        if let (Inner::Radius(_), Some(horizon)) = (file.inner, horizon)
            && inner <= horizon
        {
            let horizon = readable(horizon);
            self.fault(
                &["disk.inner", "spacetime.spin", "spacetime.name"],
                format!("the disk's inner edge {inner} is not outside the horizon at r = {horizon}"),
                format!("give `disk.inner` more than {horizon}, or \"isco\""),
            );
        }
        if inner >= file.outer {
            let shown = readable(inner);
            let named = if let Inner::Isco(_) = file.inner { ", the isco" } else { "" };
            self.fault(
                &["disk.outer", "disk.inner", "spacetime.spin", "spacetime.name"],
                format!("the disk's outer edge {} is not outside its inner edge {shown}{named}", file.outer),
                format!("give `disk.outer` more than {shown}, or a smaller `disk.inner`"),
            );
        }
        inner
    }
}
