//! Texts made to harm, and texts that are no scenes: faults, soon, and never a panic.

use std::path::Path;
use std::time::{Duration, Instant};

use kerrscope::scene::{Faults, Scene};
use proptest::prelude::*;
use proptest::sample;

/// Reads a text that is wrong, on a stack as small as threads have, in little time.
fn faults(text: String) -> Faults {
    let start = Instant::now();
    let read = move || Scene::from_toml(&text, Path::new("")).unwrap_err();
    let thread = std::thread::Builder::new().stack_size(256 << 10).spawn(read).unwrap();
    let faults = thread.join().expect("no panic");
    let took = start.elapsed();
    assert!(took < Duration::from_secs(20), "{took:?}");
    faults
}

fn first(text: String) -> String {
    faults(text)[0].to_string()
}

#[test]
fn depth() {
    let deep = "too many levels within one another\n  \
                help: a scene has sections, keys, and lists of numbers, and nothing deeper";
    let n = 100_000;
    for (text, column) in [
        (format!("a = {}", "[".repeat(n)), 37),
        (format!("a = {}{}", "[".repeat(n), "]".repeat(n)), 37),
        (format!("a = {}1{}", "{a = ".repeat(n), "}".repeat(n)), 165),
        (format!("a = {}", "{a=".repeat(n)), 101),
        (format!("{}a = 1", "a.".repeat(500_000)), 66),
        (format!("[{}a]", "a.".repeat(500_000)), 65),
        (format!("[[{}a]]", "a . ".repeat(200_000)), 125),
        (format!("x = {}1", format!("{{{}a = ", "a.".repeat(9)).repeat(n / 4)), 78),
    ] {
        let shown = &text[..40];
        let expected = format!("scene:1:{column}: {deep}");
        assert_eq!(first(text.clone()), expected, "{shown}");
    }
}

#[test]
fn depth_of_overrides() {
    for text in [
        format!("screen.look_at={}", "[".repeat(100_000)),
        format!("screen={}", "{a=".repeat(100_000)),
        format!("{}a=1", "a.".repeat(500_000)),
    ] {
        assert_eq!(Scene::load(None, &[text]).unwrap_err().len(), 1);
    }
}

#[test]
fn size() {
    let full = format!("# {}\n", "x".repeat((8 << 20) - 3));
    assert!(Scene::from_toml(&full, Path::new("")).is_ok());
    let expected = "scene: it is larger than 8 MiB\n  \
                    help: a scene is some kilobytes of text, with a hundred thousand things some megabytes: \
                    check that this is the right file";
    assert_eq!(first(full + "\n"), expected);
}

/// As many faults as fit, of each sort.
#[test]
fn many_faults() {
    for line in [
        "=\n",
        "a\n",
        "a=\n",
        "a=1\n",
        "[a]\n",
        "[a\n",
        "[[a]]\n",
        "\"\n",
        "'",
        "{",
        "}",
        "]",
        "[",
        ",",
        ".",
        "a.",
        "a={\n",
        "a=[\n",
        "\"\"\"",
        "\\",
        "\u{0}",
        "é=1\n",
        "a=1_\n",
        "x=\"\\q\"\n",
        "spacetime.spin=2\n",
        "[disk]\ncolor=[9,9,9]\n",
        "_=1\n",
        "[_]\n[b\n",
    ] {
        let faults = faults(line.repeat((1 << 20) / line.len()));
        assert!(!faults.is_empty(), "{line:?}");
        assert!(faults.len() <= Faults::MAX, "{line:?}");
        assert!(faults.to_string().len() < 100_000, "{line:?}");
    }
    let keys: Vec<String> = (0..80_000).map(|i| format!("k{i} = 1\n")).collect();
    let keys = keys.concat();
    assert_eq!(faults(keys).omitted(), 80_000 - Faults::MAX);
    let list = format!("screen.look_at = [{}]", "1,".repeat(500_000));
    assert_eq!(faults(list)[0].message, "`screen.look_at` has 500000 values");
    let path = format!("disk.model = 'image'\ndisk.image = '{}'", "p/".repeat(500_000));
    assert!(faults(path).to_string().len() < 1000);
    let key = "k".repeat(1_000_000);
    assert!(faults(format!("[{key}]\n{key} = '{key}'"))[0].message.len() < 200);
}

const SCENE: &str = r#"# A scene with a bit of everything.
[spacetime]
name = "kerr"
spin = 0.9
[observer]
position = [
    30, # x
    -1.5e1,
    0.25,
]
motion = { velocity = [0.1, 0, -2e-1], relative_to = 'fall' }
[screen]
kind = "angular"
look_at = [0, 0, 0]
[disk]
inner = "isco"
color = [1, 0.5, 0]
[sky]
"kind" = """grid"""
spacing = 15
[render]
width = 1_000
seed = 0xff
jitter = true
[camera]
display = { exposure = +1.0, bits = 16 }
"#;

/// Faulty headers are no keys that could be given twice.
#[test]
fn byte_order_mark_within_the_text() {
    let found = faults("[\n[1, 2]\n[\u{feff}[[\n[sky]\nkind = \"grid\"\n".to_owned());
    assert!(found.iter().all(|fault| !fault.message.contains("twice")), "{found}");
    assert_sound(Err(found));
}

#[test]
fn the_scene_that_is_edited_is_right() {
    Scene::from_toml(SCENE, Path::new("")).unwrap();
}

/// Text of pieces that mean something to a parser.
fn soup() -> impl Strategy<Value = String> {
    let pieces = vec![
        "[",
        "]",
        "[[",
        "]]",
        "{",
        "}",
        "=",
        " = ",
        ".",
        ",",
        "\n",
        "\r\n",
        "\r",
        " ",
        "\t",
        "#",
        "\"",
        "'",
        "\"\"\"",
        "'''",
        "\\",
        "\\u{1}",
        "\\x",
        "-",
        "+",
        "_",
        "0",
        "1",
        "9e9",
        "0x",
        "inf",
        "nan",
        "true",
        "1979-05-27T07:32:00Z",
        "07:32",
        "é",
        "\u{feff}",
        "\u{0}",
        "\u{7f}",
        "spacetime",
        "observer",
        "screen",
        "camera",
        "display",
        "name",
        "spin",
        "motion",
        "velocity",
        "position",
        "a",
        "b",
        "\"kerr\"",
        "[1, 2, 3]",
        "[observer]\n",
    ];
    prop::collection::vec(sample::select(pieces), 0..60).prop_map(|pieces| pieces.concat())
}

/// Faults have places within their texts, and can be shown.
fn assert_sound(result: Result<Scene, Faults>) {
    match result {
        Ok(scene) => assert!(Scene::from_toml(&scene.to_toml(), Path::new("")).is_ok()),
        Err(faults) => {
            assert!(!faults.is_empty());
            for fault in &faults {
                let span = fault.span.clone().unwrap_or(0..0);
                assert!(fault.source.text.get(span).is_some(), "{fault}");
                assert!(!fault.message.is_empty() && !fault.help.is_empty(), "{fault}");
                assert!(!fault.message.contains('\n'), "{fault}");
            }
            let _ = faults.to_string();
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn any_text(text in any::<String>()) {
        assert_sound(Scene::from_toml(&text, Path::new("")));
    }

    #[test]
    fn any_soup(text in soup()) {
        assert_sound(Scene::from_toml(&text, Path::new("")));
    }

    #[test]
    fn any_bytes(bytes in any::<Vec<u8>>()) {
        let text = String::from_utf8_lossy(&bytes);
        assert_sound(Scene::from_toml(&text, Path::new("")));
    }

    /// A right scene with parts cut out, put in, and moved.
    #[test]
    fn any_edit(edits in prop::collection::vec((any::<sample::Index>(), 0..20_usize, soup()), 1..4)) {
        let mut text = SCENE.to_owned();
        for (at, length, insert) in edits {
            let start = text.floor_char_boundary(at.index(text.len() + 1));
            let end = text.floor_char_boundary((start + length).min(text.len()));
            text.replace_range(start..end.max(start), &insert);
        }
        assert_sound(Scene::from_toml(&text, Path::new("")));
    }

    #[test]
    fn any_override(overrides in prop::collection::vec(prop_oneof![soup(), any::<String>()], 0..4)) {
        assert_sound(Scene::load(None, &overrides));
    }

    #[test]
    fn any_value(value in soup(), key in sample::select(vec!["spacetime.spin", "observer.motion", "sky"])) {
        assert_sound(Scene::load(None, &[format!("{key}={value}")]));
    }
}
