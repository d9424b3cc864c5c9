//! Keys of a scene by the last of their names, for programs in which dots are no part of a name.

use std::sync::LazyLock;

use super::SceneFile;
use super::shape::{Shape, properties};

/// Every key of a scene but those of lists, with dots.
static KEYS: LazyLock<Vec<String>> = LazyLock::new(|| {
    let mut keys = Vec::new();
    gather(&SceneFile::schema(), "", &mut keys);
    keys
});

/// Why a name is no key.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum KeyError {
    /// There is none.
    #[error("a scene has no key `{name}`{}", near.as_ref().map_or(String::new(), |near| format!(": did you mean `{near}`?")))]
    None {
        /// The name.
        name: String,
        /// A key that is written much alike.
        near: Option<String>,
    },
    /// There are several.
    #[error(
        "`{name}` may be {}: write the one that is meant with its dots",
        super::shape::either(candidates)
    )]
    Several {
        /// The name.
        name: String,
        /// The keys.
        candidates: Vec<String>,
    },
}

/// The key that a name stands for: itself if it has dots or is a section; otherwise the only key whose last name it is.
///
/// ```
/// use kerrscope::scene::key;
/// assert_eq!(key("spin")?, "spacetime.spin");
/// assert_eq!(key("render.width")?, "render.width");
/// let error = key("distance").unwrap_err().to_string();
/// assert_eq!(error, "`distance` may be observer.distance or units.distance: write the one that is meant with its dots");
/// # Ok::<(), kerrscope::scene::KeyError>(())
/// ```
///
/// # Errors
/// If there is no such key, or more than one. What is wrong with a name with dots is found when the scene is read.
pub fn key(name: &str) -> Result<String, KeyError> {
    if name.contains('.') || KEYS.iter().any(|key| key == name) {
        return Ok(name.to_owned());
    }
    let last = |key: &&String| key.rsplit('.').next() == Some(name);
    let mut candidates: Vec<String> = KEYS.iter().filter(last).cloned().collect();
    match candidates.len() {
        1 => Ok(candidates.remove(0)),
        0 => {
            let alike =
                |key: &&String| strsim::jaro_winkler(key.rsplit('.').next().unwrap_or_default(), name);
            let near = KEYS.iter().max_by(|a, b| alike(a).total_cmp(&alike(b)));
            let near = near.filter(|near| alike(near) > 0.8).cloned();
            Err(KeyError::None { name: name.to_owned(), near })
        }
        _ => Err(KeyError::Several { name: name.to_owned(), candidates }),
    }
}

/// Adds the keys of a table, and of the tables in it.
fn gather(schema: &serde_json::Value, within: &str, keys: &mut Vec<String>) {
    for (name, schema) in properties(schema) {
        let path = if within.is_empty() { name.to_owned() } else { format!("{within}.{name}") };
        if !keys.contains(&path) {
            keys.push(path.clone());
        }
        for table in Shape::new(schema).tables() {
            gather(table, &path, keys);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_what_they_may_be() {
        assert_eq!(key("inclination").as_deref(), Ok("observer.inclination"));
        assert_eq!(key("disk").as_deref(), Ok("disk"));
        assert_eq!(key("spacetime.parameters.charge").as_deref(), Ok("spacetime.parameters.charge"));
        let Err(KeyError::Several { candidates, .. }) = key("kind") else { panic!() };
        assert!(
            candidates.contains(&"sky.kind".to_owned()) && candidates.contains(&"screen.kind".to_owned())
        );
        let near = key("inclinaton").unwrap_err();
        assert!(near.to_string().contains("did you mean `observer.inclination`?"), "{near}");
        assert_eq!(key("qqq"), Err(KeyError::None { name: "qqq".to_owned(), near: None }));
    }
}
