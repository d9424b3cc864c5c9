//! The files of the page. They are in the program, as they stand in `web/`.

use axum::http::header;
use axum::response::{IntoResponse, Response};

/// A file of the page.
pub struct Asset {
    pub path: &'static str,
    kind: &'static str,
    contents: &'static str,
}

impl Asset {
    pub fn response(&self) -> Response {
        ([(header::CONTENT_TYPE, self.kind)], self.contents).into_response()
    }
}

const HTML: &str = "text/html; charset=utf-8";
const CSS: &str = "text/css; charset=utf-8";
const SCRIPT: &str = "text/javascript; charset=utf-8";
const SVG: &str = "image/svg+xml";

macro_rules! asset {
    ($path:literal, $file:literal, $kind:expr) => {
        Asset { path: $path, kind: $kind, contents: include_str!(concat!("../../../../web/", $file)) }
    };
}

/// All of them.
pub static ALL: &[Asset] = &[
    asset!("/", "index.html", HTML),
    asset!("/style.css", "style.css", CSS),
    asset!("/icon.svg", "icon.svg", SVG),
    asset!("/page.js", "page.js", SCRIPT),
    asset!("/settings.js", "settings.js", SCRIPT),
    asset!("/state.js", "state.js", SCRIPT),
    asset!("/link.js", "link.js", SCRIPT),
    asset!("/panel.js", "panel.js", SCRIPT),
    asset!("/hands.js", "hands.js", SCRIPT),
    asset!("/readouts.js", "readouts.js", SCRIPT),
    asset!("/picture.js", "picture.js", SCRIPT),
    asset!("/lines.js", "lines.js", SCRIPT),
    asset!("/key.js", "key.js", SCRIPT),
    asset!("/save.js", "save.js", SCRIPT),
    asset!("/ray.js", "ray.js", SCRIPT),
    asset!("/observation.js", "observation.js", SCRIPT),
];
