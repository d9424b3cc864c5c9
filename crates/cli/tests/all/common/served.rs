//! A live page that is served, and clients of it.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use tungstenite::client::IntoClientRequest;
use tungstenite::{Message, WebSocket};

/// How long anything may take.
const PATIENCE: Duration = Duration::from_mins(2);

/// `kerrscope view`, until it is dropped.
pub struct Served {
    pub child: Child,
    /// The first line that it printed.
    pub address: String,
    pub port: u16,
}

impl Drop for Served {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Served {
    pub fn start(folder: &Path, arguments: &[&str]) -> Self {
        let all = [&["view", "--no-open"], arguments].concat();
        let mut command = super::program(folder, &all);
        let mut child =
            command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn().expect("the program starts");
        let mut line = String::new();
        let output = child.stdout.take().expect("it is a pipe");
        BufReader::new(output).read_line(&mut line).expect("it prints a line");
        let address = line.trim_end().to_owned();
        let place =
            address.strip_prefix("http://").and_then(|rest| rest.split('/').next()).unwrap_or_default();
        let port = place.rsplit(':').next().and_then(|port| port.parse().ok());
        Self { child, port: port.unwrap_or_else(|| panic!("no address: {line:?}")), address }
    }

    /// Sends a request as it stands, and gives the status and everything that came back.
    pub fn raw(&self, request: &str) -> (u16, String) {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).expect("the server is there");
        stream.set_read_timeout(Some(PATIENCE)).expect("a timeout can be set");
        stream.write_all(request.as_bytes()).expect("it takes the request");
        let mut bytes = Vec::new();
        let _ = stream.read_to_end(&mut bytes);
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let status = text.split(' ').nth(1).and_then(|status| status.parse().ok()).unwrap_or(0);
        (status, text)
    }

    /// Asks for a path, with further lines of the head, each with its line end.
    pub fn get(&self, path: &str, lines: &str) -> (u16, String) {
        let host = format!("127.0.0.1:{}", self.port);
        self.raw(&format!("GET {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n{lines}\r\n"))
    }

    pub fn connect(&self) -> Result<Client, tungstenite::Error> {
        self.connect_to("socket")
    }

    pub fn connect_to(&self, path: &str) -> Result<Client, tungstenite::Error> {
        let stream = TcpStream::connect(("127.0.0.1", self.port))?;
        stream.set_read_timeout(Some(PATIENCE))?;
        let request = format!("ws://127.0.0.1:{}/{path}", self.port).into_client_request()?;
        match tungstenite::client(request, stream) {
            Ok((socket, _)) => Ok(Client { socket }),
            Err(tungstenite::HandshakeError::Failure(error)) => Err(error),
            Err(tungstenite::HandshakeError::Interrupted(_)) => Err(tungstenite::Error::ConnectionClosed),
        }
    }
}

/// What came from the server.
pub enum Came {
    Notice(String, Value),
    Bytes(Vec<u8>),
}

pub struct Client {
    pub socket: WebSocket<TcpStream>,
}

impl Client {
    pub fn send(&mut self, message: &Value) {
        self.socket.send(Message::text(message.to_string())).expect("the server listens");
    }

    pub fn next(&mut self) -> Result<Came, tungstenite::Error> {
        loop {
            match self.socket.read()? {
                Message::Text(text) => {
                    let mut value: Value = serde_json::from_str(&text).expect("notices are JSON");
                    let kind = value["kind"].as_str().unwrap_or_default().to_owned();
                    return Ok(Came::Notice(kind, value["content"].take()));
                }
                Message::Binary(bytes) => return Ok(Came::Bytes(bytes.to_vec())),
                _ => {}
            }
        }
    }

    /// The next notice of a kind.
    pub fn notice(&mut self, wanted: &str) -> Value {
        let begin = Instant::now();
        while begin.elapsed() < PATIENCE {
            if let Came::Notice(kind, content) = self.next().expect("the server answers")
                && kind == wanted
            {
                return content;
            }
        }
        panic!("no {wanted} came");
    }

    /// The next message whose first bytes are these.
    pub fn bytes(&mut self, magic: &[u8]) -> Vec<u8> {
        let begin = Instant::now();
        while begin.elapsed() < PATIENCE {
            match self.next().expect("the server answers") {
                Came::Bytes(bytes) if bytes.starts_with(magic) => return bytes,
                Came::Notice(kind, content) if kind.starts_with("fault") || kind == "unsaved" => {
                    panic!("{kind}: {content}")
                }
                _ => {}
            }
        }
        panic!("nothing came");
    }

    /// The finished picture of a generation.
    pub fn finished(&mut self, generation: u32) -> Vec<u8> {
        loop {
            let frame = self.bytes(b"KSF1");
            if frame[4..8] == generation.to_le_bytes() && frame[20] == 1 {
                return frame;
            }
        }
    }
}

/// A view of the scene given.
pub fn view(generation: u32, set: &Value, size: [u32; 2], samples: u32) -> Value {
    json!({"generation": generation, "set": set, "size": size, "samples": samples})
}

/// The wish to see it.
pub fn show(generation: u32, set: &Value, size: [u32; 2], samples: u32) -> Value {
    let mut message = view(generation, set, size, samples);
    message["kind"] = json!("show");
    message
}
