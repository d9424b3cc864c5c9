//! Scenes that can be seen: that of the command line and those shipped with the program, and what may be changed in them.

use std::fmt::Write;
use std::path::Path;

use kerrscope::scene::{Draft, Faults, Scene};
use serde_json::Value;

use super::asked::View;

/// Keys that may be set, or sections of which all may. None holds a path: no message leads to a file.
const OPEN: &[&str] = &[
    "spacetime.name",
    "spacetime.spin",
    "spacetime.parameters",
    "observer",
    "screen",
    "disk.model",
    "disk.inner",
    "disk.outer",
    "disk.tilt",
    "disk.node",
    "disk.color",
    "disk.brightness",
    "disk.opacity",
    "disk.turns",
    "disk.optically_thin",
    "disk.orders",
    "disk.doppler",
    "disk.gravitational",
    "disk.beaming",
    "disk.index",
    "disk.light",
    "disk.limb",
    "disk.temperature",
    "disk.color_correction",
    "disk.time",
    "disk.seed",
    "sky.kind",
    "sky.color",
    "sky.zenith",
    "sky.brightness",
    "sky.spacing",
    "sky.frame",
    "sky.longitude",
    "sky.rotation",
    "other_sky.kind",
    "other_sky.brightness",
    "other_sky.spacing",
    "render.engine",
    "render.max_crossings",
    "render.seed",
    "camera.display",
    "units",
];

/// Keys set at a time at most.
const MOST: usize = 100;

/// Bytes of a value as TOML at most.
const LONGEST: usize = 1000;

macro_rules! shipped {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("../../../../scenes/", $name, ".toml")))),*]
    };
}

/// Scenes that come with the program.
const SHIPPED: &[(&str, &str)] = shipped![
    "thesis-3.2",
    "thesis-4.2",
    "thesis-4.3",
    "thesis-4.5",
    "thesis-4.6",
    "thesis-4.8",
    "thesis-4.8-physics",
    "thesis-5.1a",
    "thesis-5.1b",
    "gallery/disk",
    "wormhole",
    "earth",
    "balls",
    "room",
    "well",
    "two-holes",
];

/// Why a wish makes no scene.
#[derive(Debug)]
pub enum Refusal {
    /// The scene is wrong.
    Scene(Faults),
    /// It asks for what is not to be had.
    Wish(String),
}

impl From<Faults> for Refusal {
    fn from(faults: Faults) -> Self {
        Self::Scene(faults)
    }
}

/// All scenes that can be seen.
#[derive(Debug)]
pub struct Stock {
    given: Draft,
}

impl Stock {
    /// With the scene of the command line.
    pub fn new(given: Draft) -> Self {
        Self { given }
    }

    /// Names of the scenes that come with the program.
    pub fn names() -> impl Iterator<Item = &'static str> {
        SHIPPED.iter().map(|(name, _)| *name)
    }

    /// A scene as it is asked for.
    ///
    /// # Errors
    /// Everything that is wrong with it.
    pub fn scene(&self, view: &View, samples: u32) -> Result<Scene, Refusal> {
        let mut draft = self.draft(&view.base)?;
        if view.set.len() > MOST {
            return Err(Refusal::Wish(format!("{} keys are set: set {MOST} at most", view.set.len())));
        }
        for (key, value) in &view.set {
            let text = written(key, value)?;
            match text {
                Some(text) => draft.overrides.push(format!("{key}={text}")),
                None => draft.unset(key),
            }
        }
        let [width, height] = view.size;
        for (key, number) in [("width", width), ("height", height), ("samples", samples)] {
            draft.overrides.push(format!("render.{key}={number}"));
        }
        Ok(draft.scene()?)
    }

    fn draft(&self, base: &str) -> Result<Draft, Refusal> {
        if base.is_empty() {
            return Ok(self.given.clone());
        }
        if base == "built-in" {
            return Ok(Draft::new("", Path::new("")));
        }
        let named = SHIPPED.iter().find(|(name, _)| *name == base);
        let (name, text) = named.ok_or_else(|| {
            let names: Vec<&str> = Self::names().collect();
            Refusal::Wish(format!("no scene is called {base:?}: choose built-in, {}", names.join(", ")))
        })?;
        Ok(Draft { name: (*name).to_owned(), ..Draft::new(*text, Path::new("")) })
    }
}

/// The value of a key that may be set, as TOML; none if its default shall count.
fn written(key: &str, value: &Value) -> Result<Option<String>, Refusal> {
    let within =
        |open: &str| key.strip_prefix(open).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'));
    // What comes before the first `=` is the key, to those who read it next.
    if !OPEN.iter().any(|open| within(open)) || key.contains(['=', '\n', '\r']) {
        let shown: String = key.chars().take(60).collect();
        return Err(Refusal::Wish(format!(
            "{shown:?} cannot be set from the page: write it in a scene file"
        )));
    }
    if value.is_null() {
        return Ok(None);
    }
    let mut text = String::new();
    if !write_toml(value, &mut text) || text.len() > LONGEST {
        return Err(Refusal::Wish(format!(
            "{key}: give a number, a word, true or false, or a short list of these"
        )));
    }
    Ok(Some(text))
}

/// Writes a value as TOML; false if it is of no kind that a key has.
fn write_toml(value: &Value, to: &mut String) -> bool {
    match value {
        Value::Bool(_) | Value::Number(_) => write!(to, "{value}").is_ok(),
        // JSON cannot say it otherwise.
        Value::String(text) if text == "inf" => write!(to, "inf").is_ok(),
        Value::String(text) => {
            text.len() <= LONGEST && !text.contains('\u{7f}') && write!(to, "{value}").is_ok()
        }
        Value::Array(items) => {
            to.push('[');
            let all = items.len() <= LONGEST
                && items.iter().enumerate().all(|(place, item)| {
                    if place > 0 {
                        to.push(',');
                    }
                    !item.is_array_of_arrays() && write_toml(item, to)
                });
            to.push(']');
            all
        }
        Value::Null | Value::Object(_) => false,
    }
}

/// Lists in lists in lists are no values of keys, and would be read level by level.
trait Depth {
    fn is_array_of_arrays(&self) -> bool;
}

impl Depth for Value {
    fn is_array_of_arrays(&self) -> bool {
        self.as_array().is_some_and(|items| items.iter().any(Value::is_array))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn view(base: &str, set: &Value) -> View {
        let set = set.as_object().unwrap().clone().into_iter().collect();
        View {
            generation: 1,
            base: base.to_owned(),
            set,
            size: [64, 36],
            samples: 1,
            moving: false,
            overlays: Vec::new(),
        }
    }

    #[test]
    fn keys_are_set() {
        let stock = Stock::new(Draft::new("spacetime.spin = 0.5", ""));
        let set = json!({
            "observer.inclination": 17, "disk.orders": [0, 1], "disk.doppler": true, "observer.motion": "zamo",
            "disk.color": [1, 0.5, 0.25], "disk.model": "page-thorne",
        });
        let scene = stock.scene(&view("", &set), 9).unwrap();
        assert_eq!(scene.spacetime.spin(), Some(0.5));
        assert_eq!((scene.render.width, scene.render.height, scene.render.samples), (64, 36, 9));
        assert!((scene.observer.place.theta - 17f64.to_radians()).abs() < 1e-12);
        assert_eq!(scene.disk.unwrap().orders, Some(vec![0, 1]));
        assert!(matches!(stock.scene(&view("", &json!({"spacetime.spin": 2})), 1), Err(Refusal::Scene(_))));
        let far = json!({"observer.distance": "inf", "screen.kind": "impact"});
        assert_eq!(stock.scene(&view("", &far), 1).unwrap().observer.place.r, f64::INFINITY);
        let usual = stock.scene(&view("", &json!({"spacetime.spin": null})), 1).unwrap();
        assert_eq!(usual.spacetime.spin(), Some(0.99));
    }

    #[test]
    fn no_key_leads_to_a_file() {
        let stock = Stock::new(Draft::new("", ""));
        for key in [
            "disk.image",
            "sky.image",
            "other_sky.image",
            "spacetime.file",
            "spacetime",
            "disk",
            "sky",
            "object",
            "render.width",
            "observer=1\nsky.image",
            "units = 1 #",
            "",
        ] {
            for value in [json!("/etc/passwd"), json!(1)] {
                let refused = stock.scene(&view("", &json!({key: value})), 1);
                assert!(matches!(refused, Err(Refusal::Wish(_) | Refusal::Scene(_))), "{key}");
                if let Err(Refusal::Scene(faults)) = refused {
                    assert!(!faults.to_string().contains("passwd"), "{key}: {faults}");
                }
            }
        }
        for value in [json!({"a": 1}), json!([[[1]]]), json!("x".repeat(2000))] {
            let refused = stock.scene(&view("", &json!({"observer.motion": value})), 1);
            assert!(matches!(refused, Err(Refusal::Wish(_))));
        }
    }

    #[test]
    fn every_scene_shipped_can_be_seen() {
        let stock = Stock::new(Draft::new("", ""));
        for name in Stock::names().chain(["built-in"]) {
            let scene = stock.scene(&view(name, &json!({})), 1);
            assert!(scene.is_ok(), "{name}: {:?}", scene.err());
        }
        for name in ["../scenes/room", "/etc/passwd", "room.toml"] {
            assert!(matches!(stock.scene(&view(name, &json!({})), 1), Err(Refusal::Wish(_))), "{name}");
        }
    }
}
