//! `[camera.display]`: what a picture file shows.

use super::Builder;
use crate::display::{self, Depth, FalseColor};
use crate::render::Channel;
use crate::scene::file;
use crate::scene::valid::Display;

impl Builder<'_> {
    pub(super) fn display(&mut self, file: &file::Display) -> Display {
        let view = display::Display { exposure: file.exposure, tone: file.tone };
        let depth = if file.bits == 16 { Depth::Sixteen } else { Depth::Eight };
        let Some(layer) = file.layer else {
            let idle = [
                ("order", file.order.is_some()),
                ("colormap", file.colormap.is_some()),
                ("range", file.range.is_some()),
                ("legend", file.legend.is_some()),
            ];
            for (key, _) in idle.into_iter().filter(|(_, given)| *given) {
                self.fault(
                    &[&format!("camera.display.{key}"), "camera.display.layer"],
                    format!("`camera.display.{key}` is for a data layer, and none is shown"),
                    format!("choose `camera.display.layer`, or remove `camera.display.{key}`"),
                );
            }
            return Display { view, layer: None, depth };
        };
        if file.order.is_some() && !layer.has_orders() {
            self.fault(
                &["camera.display.order", "camera.display.layer"],
                format!("the layer \"{}\" has no image orders", layer.word()),
                "remove `camera.display.order`, or choose \"r\", \"phi\", \"t\" or \"g\"",
            );
        }
        let order = layer.has_orders().then_some(file.order.unwrap_or_default());
        let shown = FalseColor {
            channel: Channel { layer, order },
            colormap: file.colormap,
            range: file.range,
            legend: file.legend.unwrap_or(true),
        };
        if let Err(wrong) = shown.check() {
            self.fault(&["camera.display.range", "camera.display.layer"], wrong.to_string(), wrong.mend());
        }
        Display { view, layer: Some(shown), depth }
    }
}
