//! The live page's server, asked as its page asks it.

use super::common::run;
use super::common::served::{Served, show, view};
use serde_json::json;
use std::fs;
use std::process::Command;
use tempfile::tempdir;

const SCENE: &str = "[spacetime]\nspin = 0.7\n[observer]\ninclination = 70\n";

#[test]
fn the_page_is_whole() {
    let folder = tempdir().unwrap();
    let served = Served::start(folder.path(), &[]);
    assert_eq!(served.address, format!("http://127.0.0.1:{}/", served.port));
    let (status, page) = served.get("/", "");
    assert_eq!(status, 200);
    assert!(page.contains("<canvas"), "the canvas stands in the page");
    assert!(page.to_lowercase().contains("content-security-policy: default-src 'self'"));
    assert!(!page.contains("<script>") && !page.contains("style=\""), "nothing inline");
    // All that it and its scripts name is there.
    let mut named: Vec<String> = Vec::new();
    let names = |text: &str, mark: &str| -> Vec<String> {
        text.split(mark).skip(1).filter_map(|rest| rest.split('"').next()).map(str::to_owned).collect()
    };
    named.extend(names(&page, "href=\"/"));
    named.extend(names(&page, "src=\"/"));
    let mut known = 0;
    while known < named.len() {
        let (status, file) = served.get(&format!("/{}", named[known]), "");
        assert_eq!(status, 200, "{}", named[known]);
        for name in names(&file, "from \"./") {
            if !named.contains(&name) {
                named.push(name);
            }
        }
        known += 1;
    }
    assert!(known > 8, "{named:?}");
    assert!(!page.contains("https://"), "nothing is fetched from elsewhere");
}

#[test]
fn a_finished_frame_is_what_render_draws() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("scene.toml"), SCENE).unwrap();
    let served = Served::start(folder.path(), &["scene.toml", "--set", "disk.outer=12"]);
    let mut client = served.connect().unwrap();
    client.send(&show(5, &json!({"observer.inclination": 60, "camera.display.exposure": 0.5}), [96, 54], 4));
    let facts = client.notice("facts");
    assert_eq!(facts["generation"], 5);
    assert_eq!(facts["scene"]["spacetime"]["spin"], 0.7);
    assert!((facts["hole"]["isco"].as_f64().unwrap() - 3.393128).abs() < 1e-5);
    let frame = client.finished(5);
    assert_eq!(frame.len(), 40 + 4 * 96 * 54);
    let sets = ["disk.outer=12", "observer.inclination=60", "camera.display.exposure=0.5", "render.width=96"];
    let mut arguments = vec!["render", "scene.toml", "-o", "drawn.png", "--set", "render.height=54"];
    arguments.extend(sets.iter().flat_map(|set| ["--set", set]));
    assert!(run(folder.path(), &arguments).status.success());
    let drawn = image::open(folder.path().join("drawn.png")).unwrap().into_rgba8();
    assert!(frame[40..] == drawn.as_raw()[..], "the live picture is another than that of render");
}

#[test]
fn a_saved_picture_is_what_render_makes_of_the_saved_scene() {
    let folder = tempdir().unwrap();
    let served = Served::start(folder.path(), &[]);
    let mut client = served.connect().unwrap();
    let set = json!({"spacetime.spin": 0.5, "disk.model": "page-thorne", "sky.kind": "grid"});
    let mut saved = |format: &str| {
        client.send(&json!({"kind": "save", "format": format, "view": view(3, &set, [90, 60], 4)}));
        let bytes = client.bytes(b"KSV1");
        assert_eq!(bytes[4..8], 3u32.to_le_bytes());
        fs::write(folder.path().join(format!("saved.{format}")), &bytes[8..]).unwrap();
    };
    saved("toml");
    saved("png");
    saved("exr");
    let drawn = run(folder.path(), &["render", "saved.toml", "-o", "drawn.png", "-o", "drawn.exr"]);
    assert!(drawn.status.success());
    for format in ["png", "exr"] {
        let [saved, drawn] =
            ["saved", "drawn"].map(|name| fs::read(folder.path().join(format!("{name}.{format}"))).unwrap());
        assert!(saved == drawn, "{format}");
    }
}

#[test]
fn a_new_wish_ends_the_one_at_work() {
    let folder = tempdir().unwrap();
    let served = Served::start(folder.path(), &[]);
    let mut client = served.connect().unwrap();
    // Hours of work, if it were finished.
    client.send(&show(1, &json!({"render.engine": "integrator"}), [4000, 4000], 64));
    client.notice("facts");
    client.send(&show(2, &json!({}), [64, 36], 1));
    client.finished(2);
}

#[test]
fn faults_come_with_their_places() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("scene.toml"), SCENE).unwrap();
    let served = Served::start(folder.path(), &["scene.toml"]);
    let mut client = served.connect().unwrap();
    client.send(&show(8, &json!({"spacetime.spin": 1.5, "observer.distance": 0.1}), [64, 36], 1));
    let faults = client.notice("faults");
    assert_eq!(faults["generation"], 8);
    let places: Vec<&str> =
        faults["faults"].as_array().unwrap().iter().filter_map(|fault| fault["place"].as_str()).collect();
    assert!(places.contains(&"spacetime.spin"), "{faults}");
    assert!(faults.to_string().contains("give a number from -1 to 1"), "{faults}");
    // It goes on.
    client.send(&show(9, &json!({}), [64, 36], 1));
    client.finished(9);
}

#[test]
fn a_ray_and_lines_are_told() {
    let folder = tempdir().unwrap();
    let served = Served::start(folder.path(), &["--set", "observer.inclination=80"]);
    let mut client = served.connect().unwrap();
    client.send(&json!({"kind": "inspect", "view": view(4, &json!({}), [96, 54], 1), "at": [0.3, 0.5]}));
    let told = client.notice("ray");
    let traced = super::common::json(
        folder.path(),
        &[
            "trace",
            "--set",
            "observer.inclination=80",
            "--set",
            "render.width=960",
            "--set",
            "render.height=540",
            "--pixel",
            "288,270",
            "--format",
            "json",
        ],
    );
    assert_eq!(told["ray"]["fate"], traced["fate"]);
    let first = |value: &serde_json::Value| value["crossings"][0]["r"].as_f64().unwrap();
    // The pixel's centre is half a pixel of 960 away.
    assert!((first(&told["ray"]) / first(&traced) - 1.0).abs() < 0.02, "{told} {traced}");
    assert!(told["ray"]["path"].as_array().unwrap().len() > 100);
    let mut wish = show(5, &json!({}), [96, 54], 1);
    wish["overlays"] = json!(["critical", "equator"]);
    client.send(&wish);
    let lines = client.notice("overlay");
    assert_eq!(lines["generation"], 5);
    assert!(lines["lines"][0]["pieces"].as_array().unwrap().len() > 20);
    assert!(lines["lines"][1]["pieces"].as_array().unwrap().len() > 100);
}

#[test]
fn other_machines_need_a_token() {
    let folder = tempdir().unwrap();
    let refused = run(folder.path(), &["view", "--no-open", "--host", "0.0.0.0"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&refused.stderr).contains("--token"));
    assert_eq!(run(folder.path(), &["view", "--no-open", "--token", "short"]).status.code(), Some(2));
    let served = Served::start(folder.path(), &["--token", "correct-horse"]);
    assert!(served.address.ends_with("/?token=correct-horse"), "{}", served.address);
    assert_eq!(served.get("/", "").0, 401);
    assert_eq!(served.get("/page.js", "").0, 401);
    assert_eq!(served.get("/?token=correct-horsf", "").0, 401);
    let (status, page) = served.get("/?token=correct-horse", "");
    assert_eq!(status, 200);
    assert!(page.to_lowercase().contains("set-cookie: kerrscope=correct-horse; httponly; samesite=strict"));
    assert_eq!(served.get("/page.js", "Cookie: kerrscope=correct-horse\r\n").0, 200);
    assert!(served.connect().is_err(), "a socket without the token");
}

#[cfg(unix)]
#[test]
fn an_interrupt_ends_it() {
    let folder = tempdir().unwrap();
    let mut served = Served::start(folder.path(), &[]);
    let _client = served.connect().unwrap();
    let sent = Command::new("kill").args(["-INT", &served.child.id().to_string()]).status().unwrap();
    assert!(sent.success());
    assert_eq!(served.child.wait().unwrap().code(), Some(130));
}
