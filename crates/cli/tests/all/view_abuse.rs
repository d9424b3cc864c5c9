//! The live page's server, asked as nobody should ask it.

use super::common::served::{Came, Client, Served, show};
use serde_json::json;
use std::thread;
use std::time::{Duration, Instant};
use tempfile::tempdir;
use tungstenite::{Bytes, Message};

/// A client that is as it should be still gets its pictures.
fn works(client: &mut Client, generation: u32) {
    client.send(&show(generation, &json!({}), [64, 36], 1));
    client.finished(generation);
}

/// Numbers that look like chance, the same each time.
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        self.0 >> 33
    }
}

/// Memory of a process in MB, where the system tells.
fn memory(id: u32) -> Option<f64> {
    let text = std::fs::read_to_string(format!("/proc/{id}/status")).ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    Some(line.trim().strip_suffix(" kB")?.trim().parse::<f64>().ok()? / 1024.0)
}

#[test]
fn strangers_are_refused_everywhere() {
    let folder = tempdir().unwrap();
    let served = Served::start(folder.path(), &[]);
    let port = served.port;
    for path in ["/", "/page.js", "/socket", "/nothing"] {
        for host in [
            "evil.org".to_owned(),
            format!("evil.org:{port}"),
            format!("127.0.0.1.evil.org:{port}"),
            String::new(),
        ] {
            let (status, _) =
                served.raw(&format!("GET {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n"));
            assert!((400..500).contains(&status), "{path} {host}: {status}");
        }
        let (status, _) = served.raw(&format!("GET {path} HTTP/1.1\r\nConnection: close\r\n\r\n"));
        assert!((400..500).contains(&status), "{path} without a host: {status}");
        for origin in ["http://evil.org", "null", "https://evil.org:443", "file://", "http://127.0.0.1:1"] {
            let upgrade = "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
            let (status, _) = served.get(path, &format!("Origin: {origin}\r\n{upgrade}"));
            assert_eq!(status, 403, "{path} {origin}");
        }
    }
    for method in ["POST", "PUT", "DELETE", "OPTIONS"] {
        let request = format!(
            "{method} / HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nContent-Length: 0\r\nConnection: close\r\n\r\n"
        );
        assert_eq!(served.raw(&request).0, 405, "{method}");
    }
}

#[test]
fn no_path_leads_to_a_file() {
    let folder = tempdir().unwrap();
    std::fs::write(folder.path().join("secret.txt"), "a secret").unwrap();
    let served = Served::start(folder.path(), &[]);
    for path in [
        "/secret.txt",
        "/./secret.txt",
        "/../secret.txt",
        "/../../../../etc/passwd",
        "//etc/passwd",
        "/%2e%2e/%2e%2e/etc/passwd",
        "/..%2f..%2fetc%2fpasswd",
        "/page.js/../../secret.txt",
        "/page.js%00",
        "/Cargo.toml",
        "/web/page.js",
        "/C:/Windows/win.ini",
    ] {
        let (status, text) = served.get(path, "");
        assert!((400..500).contains(&status), "{path}: {status}");
        assert!(!text.contains("a secret") && !text.contains("root:"), "{path}");
    }
}

#[test]
fn nonsense_harms_nobody() {
    let folder = tempdir().unwrap();
    let served = Served::start(folder.path(), &[]);
    let mut good = served.connect().unwrap();
    works(&mut good, 1);
    let before = memory(served.child.id());
    let valid = show(7, &json!({"spacetime.spin": 0.5, "disk.orders": [0, 1]}), [64, 36], 1).to_string();
    let mut dice = Dice(1);
    let mut bad = served.connect().unwrap();
    let mut answered = 0;
    for number in 0..1000_u64 {
        let message = match number % 8 {
            0 => Message::binary((0..dice.roll() % 200).map(|_| dice.roll() as u8).collect::<Vec<u8>>()),
            1 => Message::text(valid[..dice.roll() as usize % valid.len()].to_owned()),
            2 => Message::text("[".repeat(dice.roll() as usize % 60_000)),
            3 => Message::text(json!({"kind": "show", "generation": -1, "size": [1e99, "x"], "samples": null}).to_string()),
            4 => Message::text(show(1, &json!({"sky.image": "/etc/passwd"}), [64, 36], 1).to_string()),
            5 => Message::text(show(1, &json!({}), [u32::MAX, 0], u32::MAX).to_string()),
            6 => Message::text(json!({"kind": "save", "format": "png", "view": {"generation": 1, "size": [16384, 16384], "samples": 1024}}).to_string()),
            _ => {
                let mut bytes = valid.clone().into_bytes();
                let place = dice.roll() as usize % bytes.len();
                bytes[place] = b' ' + (dice.roll() % 90) as u8;
                Message::text(String::from_utf8(bytes).unwrap())
            }
        };
        bad.socket.send(message).expect("nonsense alone ends no connection");
        // What comes back is read, or the server would wait.
        if number % 8 != 4 && number % 8 != 7 {
            match bad.next().unwrap() {
                Came::Notice(kind, _) if kind == "fault" => answered += 1,
                _ => {}
            }
        }
    }
    assert!(answered > 300, "{answered}");
    // What it asked for that was wrong is answered before.
    bad.send(&show(100_000, &json!({}), [64, 36], 1));
    loop {
        match bad.next().unwrap() {
            Came::Bytes(frame) if frame[4..8] == 100_000_u32.to_le_bytes() && frame[20] == 1 => break,
            _ => {}
        }
    }
    works(&mut good, 2);
    if let (Some(before), Some(after)) = (before, memory(served.child.id())) {
        assert!(after < before + 150.0, "{before} MB became {after} MB");
    }
}

#[test]
fn what_is_too_large_ends_its_own_connection_alone() {
    let folder = tempdir().unwrap();
    let served = Served::start(folder.path(), &[]);
    let mut good = served.connect().unwrap();
    works(&mut good, 1);
    for size in [(64 << 10) + 1, 1 << 20, 40 << 20] {
        let mut bad = served.connect().unwrap();
        // The server may hang up before all is sent.
        let sent = bad.socket.send(Message::Binary(Bytes::from(vec![b' '; size])));
        let ended = sent.is_err() || (0..10).any(|_| bad.next().is_err());
        assert!(ended, "{size} bytes were taken");
        works(&mut good, 2);
    }
}

#[test]
fn two_hundred_clients_are_too_many() {
    let folder = tempdir().unwrap();
    let served = Served::start(folder.path(), &[]);
    let mut good = served.connect().unwrap();
    works(&mut good, 1);
    let mut open = Vec::new();
    let mut refused = 0;
    for _ in 0..200 {
        match served.connect() {
            Ok(client) => open.push(client),
            Err(tungstenite::Error::Http(response)) => {
                assert_eq!(response.status(), 503);
                refused += 1;
            }
            Err(error) => panic!("{error}"),
        }
    }
    assert_eq!(open.len(), 15);
    assert_eq!(refused, 185);
    works(&mut good, 2);
    drop(open);
    // Seats are free again once the server has noticed.
    let begin = Instant::now();
    let mut next = loop {
        match served.connect() {
            Ok(client) => break client,
            Err(_) if begin.elapsed() < Duration::from_secs(20) => thread::sleep(Duration::from_millis(50)),
            Err(error) => panic!("{error}"),
        }
    };
    works(&mut next, 3);
    works(&mut good, 3);
}

#[test]
fn pictures_that_are_none_are_refused() {
    let folder = tempdir().unwrap();
    let served = Served::start(folder.path(), &[]);
    let mut good = served.connect().unwrap();
    works(&mut good, 1);
    let mut dice = Dice(7);
    let noise: Vec<u8> = (0..5000).map(|_| dice.roll() as u8).collect();
    let starts: [&[u8]; 4] =
        [b"", b"\x89PNG\r\n\x1a\n", b"SIMPLE  =                    T", &[0x76, 0x2f, 0x31, 0x01]];
    for start in starts {
        let mut client = served.connect_to("observation?model=ring").unwrap();
        client.socket.send(Message::Binary(Bytes::from([start, &noise].concat()))).unwrap();
        let fault = client.notice("fault");
        assert!(fault["text"].as_str().is_some_and(|text| text.len() > 10), "{fault}");
    }
    assert!(served.connect_to("observation?model=../../etc/passwd").is_err());
    let mut large = served.connect_to("observation").unwrap();
    let sent = large.socket.send(Message::Binary(Bytes::from(vec![0; (32 << 20) + 1])));
    assert!(sent.is_err() || large.next().is_err(), "more than 32 MiB were taken");
    works(&mut good, 2);
}
