//! One client: passes its messages to its painter, and what the painter makes to the client.

use std::sync::Arc;
use std::thread;
use std::time::Duration;

use axum::body::Bytes;
use axum::extract::ws::{Message, WebSocket};
use tokio::sync::mpsc;
use tokio::time::timeout;

use super::House;
use super::asked::Asked;
use super::desk::Desk;
use super::facts::Notice;
use super::painter::Painter;

/// How long a client may take for a message before it counts as gone.
const PATIENCE: Duration = Duration::from_secs(20);

/// What goes to a client.
#[derive(Debug)]
pub enum Sent {
    /// JSON.
    Text(String),
    /// A frame.
    Frame(Vec<u8>),
}

/// Serves a client until it leaves.
pub async fn serve(mut socket: WebSocket, house: Arc<House>) {
    // One is on its way while the next is drawn; a painter that is ahead waits.
    let (send, mut made) = mpsc::channel(1);
    let desk = Arc::new(Desk::default());
    let painter = Painter::new(house, Arc::clone(&desk), send);
    if thread::Builder::new().name("painter".to_owned()).spawn(move || painter.run()).is_err() {
        let words = Notice::Fault("there are no more threads: close other pages".to_owned()).json();
        let _ = timeout(PATIENCE, socket.send(Message::Text(words.into()))).await;
        return;
    }
    loop {
        let answer = tokio::select! {
            made = made.recv() => match made {
                Some(Sent::Text(text)) => Some(Message::Text(text.into())),
                Some(Sent::Frame(bytes)) => Some(Message::Binary(Bytes::from(bytes))),
                None => break,
            },
            message = socket.recv() => match message {
                Some(Ok(Message::Text(text))) => match Asked::read(&text) {
                    Ok(Asked::Show(view)) => {
                        desk.put(view);
                        None
                    }
                    Err(fault) => Some(Message::Text(Notice::Fault(fault).json().into())),
                },
                Some(Ok(Message::Binary(_))) => {
                    let fault = "messages are JSON as text".to_owned();
                    Some(Message::Text(Notice::Fault(fault).json().into()))
                }
                Some(Ok(Message::Ping(_) | Message::Pong(_))) => None,
                Some(Ok(Message::Close(_)) | Err(_)) | None => break,
            },
        };
        if let Some(answer) = answer
            && !matches!(timeout(PATIENCE, socket.send(answer)).await, Ok(Ok(())))
        {
            break;
        }
    }
    desk.close();
}
